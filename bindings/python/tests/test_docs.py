# SPDX-License-Identifier: Apache-2.0
"""What the pages and the examples show runs as it stands."""
import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
EXAMPLES = sorted((ROOT / "examples" / "python").glob("*.py"))


def run(code, folder):
    done = subprocess.run([sys.executable, "-W", "error", code], cwd=folder, capture_output=True, text=True,
                          env={**os.environ, "MPLBACKEND": "Agg"})
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda p: p.stem)
def test_an_example_runs(example, tmp_path):
    assert run(example, tmp_path)


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
def test_what_a_page_shows_runs(page, tmp_path):
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(encoding="utf-8"), re.S | re.M)
    ours = [block for block in blocks if "import asperity" in block]
    assert ours
    for number, block in enumerate(ours):
        code = tmp_path / f"block{number}.py"
        code.write_text(block, encoding="utf-8")
        run(code, tmp_path)


def test_the_page_of_names_is_made_from_the_docstrings(tmp_path):
    told = subprocess.run([sys.executable, "-P", ROOT / "bindings" / "python" / "make_api_page.py"], check=True,
                          capture_output=True, text=True).stdout
    assert told == (ROOT / "docs" / "python-api.md").read_text(encoding="utf-8"), \
        "make it anew: python -P bindings/python/make_api_page.py > docs/python-api.md"
