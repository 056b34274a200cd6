#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""growing_dome.py FOLDER [PIXELS]: the dome of a gonioreflectometer while light comes in.

Measures rough gold lit from 45 degrees with 64 rays, then four times as many, and so on up to four million, draws what has
left into each direction, and puts the drawings together as FOLDER/dome.png, an animated PNG that browsers show. Each
drawing is PIXELS wide (480). Needs asperity on the PATH and nothing but Python's own library."""

import pathlib
import struct
import subprocess
import sys
import zlib

DRAWINGS = 9
SECONDS, SECONDS_AT_END = 0.6, 2.5


def chunks(png):
    """(kind, data) of the chunks of a PNG file."""
    at = 8
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        yield kind, png[at + 8:at + 8 + size]
        at += 12 + size


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def animated(frames, seconds):
    """PNG files of one size as one that moves, for ever (https://www.w3.org/TR/png-3/, APNG)."""
    first = dict(chunks(frames[0]))
    width, height = struct.unpack(">II", first[b"IHDR"][:8])
    parts = [frames[0][:8], chunk(b"IHDR", first[b"IHDR"]), chunk(b"acTL", struct.pack(">II", len(frames), 0))]
    number = 0
    for k, (frame, duration) in enumerate(zip(frames, seconds)):
        assert dict(chunks(frame))[b"IHDR"] == first[b"IHDR"], "drawings differ in size or kind"
        parts.append(chunk(b"fcTL", struct.pack(">IIIIIHHBB", number, width, height, 0, 0, round(1000 * duration),
                                                1000, 0, 0)))
        number += 1
        data = b"".join(data for kind, data in chunks(frame) if kind == b"IDAT")
        if k == 0:
            parts.append(chunk(b"IDAT", data))
        else:
            parts.append(chunk(b"fdAT", struct.pack(">I", number) + data))
            number += 1
    return b"".join([*parts, chunk(b"IEND", b"")])


def draw(folder, rays, pixels):
    result, drawing = folder / "dome.asperity", folder / f"dome-{rays}.png"
    subprocess.run(["asperity", "simulate", "--surface", "gaussian", "--alpha", "0.3", "--size", "256", "--seed", "1",
                    "--material", "Au", "--theta", "45", "--resolution", "64", "--rays", str(rays), "--quiet",
                    "-o", result], check=True)
    subprocess.run(["asperity", "plot", result, "--kind", "hemisphere", "--average", "1", "--theme", "dark",
                    "--title", f"{rays:,} rays", "--width", str(pixels), "--pixels", "1", "--quiet", "-o", drawing],
                   check=True)
    return drawing.read_bytes()


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    pixels = int(sys.argv[2]) if len(sys.argv) == 3 else 480
    frames = [draw(folder, 64 * 4**k, pixels) for k in range(DRAWINGS)]
    (folder / "dome.png").write_bytes(animated(frames, [SECONDS] * (DRAWINGS - 1) + [SECONDS_AT_END]))


if __name__ == "__main__":
    main()
