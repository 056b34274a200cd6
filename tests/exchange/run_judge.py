#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run_judge.py VENV JUDGE.py PROGRAM PACKAGE ...: runs a judge in a virtual environment of its own.

Makes the environment once and installs the packages; exits 77 (skipped) with a word when the package
index is out of reach."""
import pathlib
import subprocess
import sys
import venv

folder, judge, program, *packages = sys.argv[1:]
python = pathlib.Path(folder) / "bin" / "python"
ready = pathlib.Path(folder) / "ready"
if not ready.exists():
    venv.create(folder, with_pip=True, clear=True)
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
           "--retries", "1", "--timeout", "15", *packages]
    try:
        installed = subprocess.run(pip, timeout=240).returncode == 0
    except subprocess.TimeoutExpired:
        installed = False
    if not installed:
        print("skipped: no", " ".join(packages), "without a package index")
        sys.exit(77)
    ready.touch()
sys.exit(subprocess.run([python, judge, program]).returncode)
