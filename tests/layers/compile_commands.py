# SPDX-License-Identifier: Apache-2.0
"""How the build compiles the sources of a folder, and many such commands run side by side."""

import json
import os
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor

# What says where to write, and what was read beforehand
OUTPUT = re.compile(r"\s(-MD|-M[TF] \S+|-o \S+)(?=\s|$)")
PRECOMPILED = re.compile(r"\s-Winvalid-pch\s-include \S+/cmake_pch\.hxx(?=\s|$)")


def sources(path, folder):
    """file -> (folder to run in, command, whether the build reads headers beforehand for it) of the
    sources below `folder`. The command writes nothing and reads all headers itself."""
    found = {}
    for entry in json.load(open(path, encoding="utf-8")):
        if entry["file"].startswith(folder + "/"):
            command, precompiled = PRECOMPILED.subn("", OUTPUT.sub("", entry["command"]))
            found[entry["file"]] = entry["directory"], command, precompiled > 0
    return found


def refused(jobs):
    """Runs jobs, (name, folder to run in, command, standard input); prints the errors of those that
    fail and gives their number."""
    def run(job):
        name, directory, command, text = job
        done = subprocess.run(command, shell=True, cwd=directory, input=text, capture_output=True,
                              text=True)
        return name, done

    wrong = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, done in pool.map(run, jobs):
            if done.returncode != 0:
                wrong += 1
                print(f"{name}:\n{done.stderr}")
    return wrong
