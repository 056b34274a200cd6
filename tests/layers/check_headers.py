#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each public header compiles alone, whatever stands before it where it is used.

A header that is the first include of a source is shown to do so by every build, unless that reads headers
beforehand for it; the others are compiled here, each alone, without writing anything.

usage: check_headers.py COMPILE_COMMANDS.json HEADER_LIST SOURCE_FOLDER
prints the compiler's errors and exits 1 if there are any."""

import os
import re
import sys

from compile_commands import refused, sources

FIRST_INCLUDE = re.compile(r"^\s*#\s*include\s*[<\"](.*)[>\"]", re.MULTILINE)


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
    directory, command, _ = commands[nearest]
    return directory, re.sub(r"\s-c\s.*$", " -fsyntax-only -x c++ -", command)


def main():
    folder = os.path.realpath(sys.argv[3])
    commands = sources(sys.argv[1], folder)
    headers = [line.strip() for line in open(sys.argv[2], encoding="utf-8")
               if line.startswith("asperity/")]
    if not commands or not headers:
        print("no source or no header was found: the test tests nothing")
        return 1
    shown = first_includes(file for file, (*_, precompiled) in commands.items() if not precompiled)
    jobs = [(header, *command_for(header, commands, folder), f"#include <{header}>\n")
            for header in headers if header not in shown]
    wrong = refused(jobs)
    print(f"{len(headers)} public headers, {len(jobs)} compiled alone here, {wrong} refused")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
