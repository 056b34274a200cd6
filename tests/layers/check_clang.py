#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles the sources of the library with clang, warnings as errors, and writes nothing.

usage: check_clang.py COMPILE_COMMANDS.json SOURCE_FOLDER
prints clang's errors and exits 1 if there are any; exits 77 where there is no clang++."""

import os
import re
import shutil
import sys

from compile_commands import refused, sources


def jobs_of(path, folder):
    """(file, folder to run in, command, nothing to read) for each source of the library."""
    for file, (directory, command, _) in sources(path, folder).items():
        if file.endswith("_test.cpp"):
            continue
        command = re.sub(r"^.*?(?=\s-)", "clang++", command, count=1)
        command = re.sub(r"\s(-Wno-restrict|-Wdouble-promotion)(?=\s|$)", "", command)  # GCC's alone
        yield file, directory, command.replace(" -c ", " -Werror -fsyntax-only -c "), None


def main():
    if not shutil.which("clang++"):
        print("skipped: there is no clang++ here")
        return 77
    jobs = list(jobs_of(sys.argv[1], os.path.realpath(sys.argv[2])))
    if not jobs:
        print("no source was found: the test tests nothing")
        return 1
    wrong = refused(jobs)
    print(f"{len(jobs)} sources, {wrong} that clang refuses")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
