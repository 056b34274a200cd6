#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run_suite.py SOURCE BUILD WORK CMAKE [options of pytest]: installs the package as pip does and tests it.

The environment is made once. The library is not compiled again: the one of BUILD, a complete build, is
installed into WORK and linked. Exits 77 (skipped) with a word when the package index is out of reach."""
import os
import pathlib
import subprocess
import sys
import venv

PACKAGES = ["numpy", "matplotlib", "xarray", "pytest", "mypy", "typing_extensions", "distributed", "pyarrow", "scikit-build-core==1.1.2",
            "nanobind==3.1.0", "ninja"]

source, build, work = (pathlib.Path(a) for a in sys.argv[1:4])
cmake, options = sys.argv[4], sys.argv[5:]
folder, prefix = work / "venv", work / "prefix"
python = folder / "bin" / "python"


def run(*command):
    """Says what a command said only where it failed."""
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}")


def pip(*arguments):
    return [python, "-m", "pip", "--disable-pip-version-check", "install", "--quiet", *arguments]


def make_environment():
    ready = folder / "ready"
    wanted = "\n".join(PACKAGES)
    if ready.exists() and ready.read_text() == wanted:
        return
    venv.create(folder, with_pip=True, clear=True)
    try:
        installed = subprocess.run(pip("--retries", "1", "--timeout", "15", *PACKAGES), timeout=240).returncode == 0
    except subprocess.TimeoutExpired:
        installed = False
    if not installed:
        print("skipped: no", " ".join(PACKAGES), "without a package index")
        sys.exit(77)
    ready.write_text(wanted)


make_environment()
for component in ("development", "cli"):
    run(cmake, "--install", build, "--prefix", prefix, "--component", component)
config = next(prefix.glob("lib*/**/AsperityConfig.cmake")).parent
os.environ["PATH"] = f"{folder / 'bin'}:{os.environ['PATH']}"
run(*pip("--no-build-isolation", "--no-deps", "--force-reinstall", f"--config-settings=build-dir={work / 'build'}",
         f"--config-settings=cmake.define.Asperity_DIR={config}",
         "--config-settings=cmake.define.ASPERITY_WARNINGS_AS_ERRORS=ON", source))
os.chdir(work)  # not where a folder of the same name lies
sys.exit(subprocess.run([python, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--durations=5",
                         source / "bindings" / "python" / "tests", *options]).returncode)
