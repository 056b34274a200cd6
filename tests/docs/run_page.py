#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run_page.py PAGE.md PROGRAM: runs what a page shows, in an empty folder.

Lines of ```bash blocks that begin with `asperity` run as they stand, in order; lines that begin with
`tools/` must name an executable of the tree; any other line is an error. ```python blocks run with a small
r.asperity beside them; those that import asperity are run by bindings/python/tests. The README's ```cpp block must be the example of that name."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

page, program = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
root = pathlib.Path(__file__).resolve().parents[2]
blocks = re.findall(r"^```(\w+)\n(.*?)^```", page.read_text(), re.S | re.M)
runs = 0


def run(command, folder):
    global runs
    runs += 1
    print("+", command if len(command) < 200 else command[:80] + " ...", flush=True)
    environment = dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}")
    subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=folder, env=environment,
                   check=True, stdin=subprocess.DEVNULL)


with tempfile.TemporaryDirectory() as folder:
    os.mkdir(f"{folder}/bin")
    os.symlink(program, f"{folder}/bin/asperity")
    for language, text in blocks:
        if language == "bash":
            for line in filter(None, (l.split(" #")[0].strip() for l in text.splitlines())):
                if line.startswith("#"):
                    continue
                if line.startswith("tools/"):
                    assert os.access(root / line.split()[0], os.X_OK), f"no such door: {line}"
                    runs += 1
                else:
                    assert line.startswith("asperity "), f"not a command of ours: {line}"
                    run(line, folder)
        elif language == "python" and "import asperity" not in text:
            pathlib.Path(f"{folder}/block.py").write_text(text)
            for options in ("", "--isotropic --material Au", "--roughness 0.02 --material Cu"):
                run(f"asperity simulate --quiet --size 64 --resolution 64 --layers 3 {options} "
                    "-o r.asperity", folder)
                run("/usr/bin/python3 block.py", folder)
        elif language == "cpp":
            runs += 1
            example = re.search(r"\(examples/(\w+\.cpp)\)", page.read_text()).group(1)
            code = (root / "examples" / example).read_text()
            assert text in code, f"the page's code is not in {example}"
assert runs > 0, "the page shows nothing to run"
print(f"{runs} commands of {page.name} did what the page says")
