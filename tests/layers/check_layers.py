#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the #include lines of a source tree and fails on one that runs against the data.

    core <- params <- optics, surface, detector <- tracing <- gonio <- measured <- formats, pictures <- plots <- apps
    core <- optics, surface <- bsdf <- measured, render; measured <- fit

A room of src/asperity, a folder or the folder of a kind of format, includes only itself and what
MAY_SEE names. Formats see the data types of the others, and no room of data sees a format. render
sees neither gonio nor tracing: where a BRDF came from must not matter.
The test links (check_links.py) reads the same of what CMake links.
Programs see all of the library but no library of numerics: physics has no place in them.

usage: check_layers.py ROOT        prints one line for each wrong include; exits 1 if there is one
"""

import re
import sys
from pathlib import Path

MAY_SEE = {
    "core": set(),
    "params": {"core"},
    "optics": {"core", "params"},
    "surface": {"core", "params"},
    "detector": {"core"},
    "tracing": {"core", "optics", "surface", "detector"},
    "gonio": {"core", "params", "optics", "surface", "tracing", "detector"},
    "instruments": {"core", "optics", "surface", "tracing", "gonio", "detector", "bsdf"},
    "bsdf": {"core", "params", "optics", "surface"},
    "measured": {"core", "optics", "surface", "tracing", "gonio", "bsdf", "detector"},
    "fit": {"core", "params", "optics", "surface", "gonio", "bsdf", "measured", "detector"},
    "render": {"core", "optics", "surface", "bsdf"},
    "formats": {"core"},
    "formats/exr": {"core", "formats"},
    "formats/heights": {"core", "surface", "formats", "formats/exr"},
    "formats/images": {"core", "render", "formats", "formats/exr"},
    "formats/models": {"core", "render", "formats"},
    "formats/results": {"core", "params", "optics", "surface", "gonio", "formats", "detector"},
    "formats/bsdfs": {"core", "gonio", "bsdf", "measured", "formats", "formats/exr",
                      "formats/results", "detector"},
    "pictures": {"core", "surface", "tracing", "gonio", "bsdf", "measured", "render", "formats", "detector"},
    "plots": {"core", "params", "optics", "surface", "gonio", "bsdf", "measured", "pictures", "detector"},
    "plots/files": {"core", "params", "formats", "plots"},
}

# First folder, or the whole name, of the headers that apps must leave to the library.
NUMERICS = {"Eigen", "unsupported", "Random123", "embree3", "tbb", "oneapi", "hwy"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes(path):
    """Yields (line number, delimiter, name) for each #include line of a file."""
    lines = path.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, start=1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in (".h", ".cpp"))


def room(folders):
    """The longest beginning of a path below src/asperity that MAY_SEE knows, or its first folder."""
    for length in range(len(folders), 0, -1):
        if "/".join(folders[:length]) in MAY_SEE:
            return "/".join(folders[:length])
    return "/".join(folders[:1])


def wrong_in_library(module, delimiter, name):
    """Why a file of src/asperity/<module> must not include `name`; None if it may."""
    if delimiter == '"':
        return "is relative: write <asperity/folder/file.h>"
    parts = name.split("/")
    if parts[0] != "asperity":
        return None
    target = room(parts[1:-1])
    if target == module or target in MAY_SEE[module]:
        return None
    if target not in MAY_SEE:
        return f"lies in an unknown folder '{target}'"
    return f"runs the wrong way: {module} does not see {target}"


def wrong_in_apps(delimiter, name):
    """Why a file of apps/ must not include `name`; None if it may."""
    if name.split("/")[0] in NUMERICS:
        return "is numerics: that belongs in the library"
    return None


# What opens a file to write, past the one door that keeps errors and swaps files whole.
WRITES = re.compile(r"\b(ofstream|fopen|freopen|QSaveFile|O_WRONLY|O_RDWR|png_image_write_to_file|"
                    r"(Output|OutputPart)File \w+\([^;]*c_str)|\.save\(\w*(path|file|name)\w*,")
DOORS = ("src/asperity/formats/atomic_file.cpp",
         "apps/cli/console.cpp")  # /dev/null, in place of a closed standard stream


def writes_past_the_door(root):
    """One line of complaint for each line of a program or the library that opens a file to write."""
    complaints = []
    for folder in ("src/asperity", "apps"):
        for path in sources(root / folder):
            if "test" in path.name or str(path.relative_to(root)) in DOORS:
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if WRITES.search(line.split("//")[0]):
                    complaints.append(f"{path}:{number}: files are written through AtomicFile (formats/atomic_file.h)")
    return complaints


def check(root):
    """Returns one line of complaint for each wrong include, and the number of files read."""
    complaints, read = [], 0
    library = root / "src" / "asperity"
    unknown = set()
    for path in sources(library):
        read += 1
        module = room(path.relative_to(library).parts[:-1])
        if module and module not in MAY_SEE:
            unknown.add(module)
            continue
        for number, delimiter, name in includes(path):
            reason = wrong_in_library(module, delimiter, name) if module else None
            if reason:
                complaints.append(f"{path}:{number}: {name} {reason}")
    for module in sorted(unknown):
        complaints.append(f"{library / module}: not in the list of folders, see {__file__}")
    for path in sources(root / "apps"):
        read += 1
        for number, delimiter, name in includes(path):
            reason = wrong_in_apps(delimiter, name)
            if reason:
                complaints.append(f"{path}:{number}: {name} {reason}")
    return complaints + writes_past_the_door(root), read


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    complaints, read = check(Path(sys.argv[1]))
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    if read == 0:
        sys.exit(f"{sys.argv[1]}: no sources below src/asperity and apps")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
