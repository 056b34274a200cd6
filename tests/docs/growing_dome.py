# SPDX-License-Identifier: Apache-2.0
"""growing_dome.py PROGRAM SCRIPT: the script's picture is one that moves, and holds its drawings bit by bit."""
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

PROGRAM, SCRIPT = map(os.path.abspath, sys.argv[1:])


def chunks(png):
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at = 8
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        data = png[at + 8:at + 8 + size]
        assert zlib.crc32(kind + data) == struct.unpack(">I", png[at + 8 + size:at + 12 + size])[0], kind
        yield kind, data
        at += 12 + size


def pixels(parts):
    return zlib.decompress(b"".join(parts))


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "bin").mkdir()
    (folder / "bin" / "asperity").symlink_to(PROGRAM)
    environment = dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}")
    subprocess.run([SCRIPT, folder / "out", "160"], env=environment, check=True)

    frames, numbers, count = [], [], 0
    for kind, data in chunks((folder / "out" / "dome.png").read_bytes()):
        if kind == b"acTL":
            count, plays = struct.unpack(">II", data)
            assert not frames and plays == 0, "told before the first frame, played for ever"
        if kind in (b"fcTL", b"fdAT"):
            numbers.append(struct.unpack(">I", data[:4])[0])
        if kind == b"fcTL":
            assert struct.unpack(">I", data[4:8])[0] == 160
            frames.append([])
        if kind == b"IDAT":
            assert len(frames) == 1, "readers that know no frames show the first"
            frames[0].append(data)
        if kind == b"fdAT":
            frames[-1].append(data[4:])
    assert numbers == list(range(len(numbers))) and len(frames) == count == 9, (numbers, count)
    for k, frame in enumerate(frames):
        drawing = (folder / "out" / f"dome-{64 * 4**k}.png").read_bytes()
        assert pixels(frame) == pixels(data for kind, data in chunks(drawing) if kind == b"IDAT"), k
    assert len({pixels(frame) for frame in frames}) == 9, "light comes in"
    usage = subprocess.run([SCRIPT], env=environment, text=True, capture_output=True)
    assert usage.returncode == 1 and "growing_dome.py FOLDER" in usage.stderr, usage
