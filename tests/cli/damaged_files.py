# SPDX-License-Identifier: Apache-2.0
"""Writes small height files in every format, and damaged ones."""
import struct
import zlib


def gsf(nx, ny, heights):
    head = f"Gwyddion Simple Field 1.0\nXRes = {nx}\nYRes = {ny}\n".encode()
    return head + b"\0" * (4 - len(head) % 4) + struct.pack(f"<{len(heights)}f", *heights)


def png(nx, ny, heights, bits=16, colour=0):
    """16-bit grey; heights 0 .. 1."""
    def chunk(kind, body):
        return (struct.pack(">I", len(body)) + kind + body +
                struct.pack(">I", zlib.crc32(kind + body)))

    rows = b"".join(b"\0" + b"".join(struct.pack(">H", round(65535 * h))
                                     for h in heights[j * nx:(j + 1) * nx])
                    for j in range(len(heights) // nx))
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">IIBBBBB", nx, ny, bits, colour, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def exr(nx, ny, heights, channel=b"Y"):
    """One scan-line part, one float channel, not compressed."""
    def attribute(name, kind, body):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(body)) + body

    channels = channel + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) + b"\0"
    window = struct.pack("<iiii", 0, 0, nx - 1, ny - 1)
    head = (b"\x76\x2f\x31\x01\x02\0\0\0" + attribute(b"channels", b"chlist", channels) +
            attribute(b"compression", b"compression", b"\0") +
            attribute(b"dataWindow", b"box2i", window) +
            attribute(b"displayWindow", b"box2i", window) +
            attribute(b"lineOrder", b"lineOrder", b"\0") +
            attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) +
            attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)) +
            attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0")
    lines = [struct.pack("<ii", j, 4 * nx) + struct.pack(f"<{nx}f", *heights[j * nx:(j + 1) * nx])
             for j in range(len(heights) // nx)]
    offsets, place = b"", len(head) + 8 * len(lines)
    for line in lines:
        offsets += struct.pack("<Q", place)
        place += len(line)
    return head + offsets + b"".join(lines)


def text(nx, ny, heights):
    rows = [heights[j * nx:(j + 1) * nx] for j in range(ny)]
    return "\n".join(" ".join(map(str, row)) for row in rows).encode() + b"\n"


def damaged(make, ending):
    """(what is wrong, bytes) of one format; `make` is one of the functions above."""
    heights = [(7 * k % 16) / 16 for k in range(64)]
    good = make(8, 8, heights)
    yield "empty", b""
    yield "one byte", good[:1]
    yield "wrong magic", b"What is this?\0\xff" + good[15:]
    if ending == "txt":
        yield "a short row", good.rstrip().rsplit(b" ", 1)[0]
        yield "oversized", (b"0 " * 40000 + b"\n") * 2
        yield "a word", good.replace(b"0.5", b"half", 1)
        yield "one row", b"1 2 3\n"
    else:
        yield "cut in the middle", good[:len(good) // 2]
        yield "cut by 20 bytes", good[:-20]
        yield "oversized", make(10 ** 9, 10 ** 9, heights)
        yield "more samples told than there are", make(8, 9, heights)
        yield "header alone", good[:60]
    if ending != "png":
        for name in ("inf", "-inf"):
            yield f"a height of {name}", make(8, 8, heights[:9] + [float(name)] + heights[10:])
    else:
        yield "8 bits", make(8, 8, heights, bits=8)
        yield "colour", make(8, 8, heights, colour=2)


FORMATS = {"gsf": gsf, "png": png, "exr": exr, "txt": text}
