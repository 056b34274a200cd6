#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads which CMake target links which and fails on a link that runs against the data.

GRAPH has one line for each target of src/asperity, written while CMake configures:

    asperity_render src/asperity/render asperity_bsdf;embree;fmt::fmt

A target belongs to the room its folder is in and links only targets of rooms that MAY_SEE of
check_layers names, of its own room, and libraries from outside. Since MAY_SEE is all that a room
sees, a wrong room cannot come in by way of another one. What a measurement needs must not bring the
libraries of pictures and models: see NOT_TO_MEASURE.

usage: check_links.py GRAPH        prints one line for each wrong link; exits 1 if there is one
"""

import re
import sys
from pathlib import Path

from check_layers import MAY_SEE, room

LIBRARY = "src/asperity/"

# Rooms that a program needs to make a surface, measure it and compare the result, and libraries that
# it must get by without.
MEASURES = {"core", "optics", "surface", "tracing", "gonio", "bsdf", "measured", "formats/results"}
NOT_TO_MEASURE = re.compile(r"embree|assimp|OpenEXR|Imath|PNG|Qt", re.IGNORECASE)

# $<BUILD_INTERFACE:x> and $<LINK_ONLY:x> stand for x.
WRAPPED = re.compile(r"\$<(?:BUILD_INTERFACE|LINK_ONLY):([^<>]*)>")


def read_graph(lines):
    """Returns {target: (room, [what it links])}."""
    graph = {}
    for line in lines:
        target, folder, links = (line.split(" ") + ["", ""])[:3]
        if folder.startswith(LIBRARY):
            names = [WRAPPED.sub(r"\1", name) for name in links.split(";") if name]
            graph[target] = (room(folder[len(LIBRARY):].split("/")), names)
    return graph


def reachable(graph, target):
    """All that `target` links, directly or through others."""
    found, waiting = set(), [target]
    while waiting:
        for name in graph.get(waiting.pop(), (None, []))[1]:
            if name not in found:
                found.add(name)
                waiting.append(name)
    return found


def check(graph):
    """Returns one line of complaint for each wrong link."""
    complaints = []
    for target, (module, links) in sorted(graph.items()):
        if module not in MAY_SEE:
            complaints.append(f"{target}: lies in an unknown folder '{module}'")
            continue
        for name in links:
            to = graph[name][0] if name in graph else None
            if to and to != module and to not in MAY_SEE[module]:
                complaints.append(f"{target}: links {name}: {module} does not see {to}")
        if module in MEASURES:
            for name in sorted(reachable(graph, target)):
                if NOT_TO_MEASURE.search(name):
                    complaints.append(f"{target}: needs {name}, and so would all who measure")
    return complaints


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    graph = read_graph(Path(sys.argv[1]).read_text(encoding="utf-8").splitlines())
    if not graph:
        sys.exit(f"{sys.argv[1]}: no targets of {LIBRARY}")
    complaints = check(graph)
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
