#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plot_images.py PROGRAM ROOT [--update]: makes the plots that the docs show.

Each must look like the one in docs/images, but for what another version of the type or of Cairo changes;
--update puts the new ones there."""
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

SIMULATE = ("simulate --surface gaussian --alpha 0.3 --size 1024 --isotropic --theta 30,45 "
            "--resolution 180 --quiet -o gaussian.asperity")
MODELS = "cook-torrance:roughness=0.55,metallic=1"
PLOTS = {
    "plot-lobe.png": f"plot gaussian.asperity {MODELS} --theta 45 --labels",
    "plot-solid.png": f"plot gaussian.asperity {MODELS} --kind lobe3d --theta 30 --labels",
}
LABELS = "Simulated,Cook-Torrance with roughness 0.55"


def pixels(path):
    """Width, height and bytes of an 8-bit RGB picture."""
    data, place, packed = path.read_bytes(), 8, b""
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", data[place + 8:place + 18])
            assert (depth, colours) == (8, 2), f"{path} is not 8-bit RGB"
        if kind == b"IDAT":
            packed += data[place + 8:place + 8 + length]
        place += 12 + length
    raw, step, lines, above = zlib.decompress(packed), 3 * width, [], bytes(3 * width)
    for row in range(height):
        kind, *line = raw[row * (step + 1):(row + 1) * (step + 1)]
        for k in range(step):
            left = line[k - 3] if k >= 3 else 0
            corner = above[k - 3] if k >= 3 else 0
            if kind == 1:
                line[k] += left
            elif kind == 2:
                line[k] += above[k]
            elif kind == 3:
                line[k] += (left + above[k]) // 2
            elif kind == 4:
                near = left + above[k] - corner
                line[k] += min((left, above[k], corner), key=lambda c: abs(near - c))
            line[k] &= 255
        lines.append(bytes(line))
        above = lines[-1]
    return width, height, b"".join(lines)


def main():
    program, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, *SIMULATE.split()], cwd=folder, check=True)
        for name, command in PLOTS.items():
            subprocess.run([program, *command.split(), LABELS, "--pixels", "1.5", "-o", name],
                           cwd=folder, check=True)
            made, shown = pathlib.Path(folder) / name, root / "docs" / "images" / name
            if "--update" in sys.argv:
                shutil.copyfile(made, shown)
                continue
            new, old = pixels(made), pixels(shown)
            assert new[0] == old[0], f"{name} is {new[0]} wide, in the docs {old[0]}"
            assert abs(new[1] - old[1]) <= 8, f"{name} is {new[1]} high, in the docs {old[1]}"
            unlike = sum(abs(a - b) > 64 for a, b in zip(new[2], old[2])) / len(new[2])
            assert unlike < 0.02, f"{100 * unlike:.2f} % of {name} are not as in the docs"
            print(f"{name}: {100 * unlike:.3f} % of it differ")


main()
