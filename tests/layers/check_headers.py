#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each public header compiles alone, whatever stands before it where it is used.

A header that is the first include of a source is shown to do so by every build; the others are compiled
here, each alone, without writing anything.

usage: check_headers.py COMPILE_COMMANDS.json HEADER_LIST SOURCE_FOLDER
prints the compiler's errors and exits 1 if there are any."""

import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

FIRST_INCLUDE = re.compile(r"^\s*#\s*include\s*[<\"](.*)[>\"]", re.MULTILINE)


def sources(path, folder):
    """file -> (folder to run in, command) of the library's sources."""
    entries = json.load(open(path, encoding="utf-8"))
    return {entry["file"]: (entry["directory"], entry["command"]) for entry in entries
            if entry["file"].startswith(folder + "/")}


def first_includes(files):
    found = set()
    for file in files:
        match = FIRST_INCLUDE.search(open(file, encoding="utf-8").read())
        if match:
            found.add(match.group(1))
    return found


def command_for(header, commands, folder):
    """That of the source which is nearest to the header in the tree: it has the room's own flags."""
    place = os.path.join(folder, header)
    nearest = max(commands, key=lambda file: (len(os.path.commonpath([file, place])), file))
    directory, command = commands[nearest]
    command = re.sub(r"\s(-MD|-M[TF] \S+|-o \S+)(?=\s|$)", "", command)
    return directory, re.sub(r"\s-c\s.*$", " -fsyntax-only -x c++ -", command)


def check(job):
    header, (directory, command) = job
    done = subprocess.run(command, shell=True, cwd=directory, input=f"#include <{header}>\n",
                          capture_output=True, text=True)
    return header, done.returncode, done.stderr


def main():
    folder = os.path.realpath(sys.argv[3])
    commands = sources(sys.argv[1], folder)
    headers = [line.strip() for line in open(sys.argv[2], encoding="utf-8")
               if line.startswith("asperity/")]
    if not commands or not headers:
        print("no source or no header was found: the test tests nothing")
        return 1
    shown = first_includes(commands)
    jobs = [(header, command_for(header, commands, folder)) for header in headers
            if header not in shown]
    wrong = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for header, code, errors in pool.map(check, jobs):
            if code != 0:
                wrong += 1
                print(f"{header}:\n{errors}")
    print(f"{len(headers)} public headers, {len(jobs)} compiled alone here, {wrong} refused")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
