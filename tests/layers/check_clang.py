#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles the sources of the library with clang, warnings as errors, and writes nothing.

usage: check_clang.py COMPILE_COMMANDS.json SOURCE_FOLDER
prints clang's errors and exits 1 if there are any; exits 77 where there is no clang++."""

import json
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor


def commands(path, folder):
    """(file, folder to run in, command) for each source of the library."""
    for entry in json.load(open(path, encoding="utf-8")):
        if not entry["file"].startswith(folder + "/") or entry["file"].endswith("_test.cpp"):
            continue
        command = re.sub(r"^.*?(?=\s-)", "clang++", entry["command"], count=1)
        # What GCC alone knows, what it has read beforehand, and all that says where to write
        command = re.sub(r"\s(-Wno-restrict|-Wdouble-promotion|-Winvalid-pch|-include \S+/cmake_pch\.hxx"
                         r"|-MD|-M[TF] \S+|-o \S+)(?=\s|$)", "", command)
        yield entry["file"], entry["directory"], command.replace(" -c ", " -Werror -fsyntax-only -c ")


def check(job):
    file, directory, command = job
    done = subprocess.run(command, shell=True, cwd=directory, capture_output=True, text=True)
    return file, done.returncode, done.stderr


def main():
    if not shutil.which("clang++"):
        print("skipped: there is no clang++ here")
        return 77
    jobs = list(commands(sys.argv[1], os.path.realpath(sys.argv[2])))
    if not jobs:
        print("no source was found: the test tests nothing")
        return 1
    wrong = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for file, code, errors in pool.map(check, jobs):
            if code != 0:
                wrong += 1
                print(f"{file}:\n{errors}")
    print(f"{len(jobs)} sources, {wrong} that clang refuses")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
