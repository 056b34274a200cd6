#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""judge_genuine.py PROGRAM: genuine files of topographies beside other readers of them.

Reads every file of $ASPERITY_SAMPLES/topography with Asperity (PROGRAM is heights_figures), Gwyddion (where it is
installed), SurfaceTopography, surfalize and x3pio, and compares sides, spacing, missing points and every height. A
difference that is not told below fails, one told below that is not there any more likewise; so does a file that we
refuse without a word here, and one whose spacing or whose heights nobody else has as we do. Prints the table of docs/validation.md, between
its two marks in $ASPERITY_TABLE, and fails where the page has another one. Exits 77 without the files."""
import os
import pathlib
import sys
import warnings

import numpy as np

import genuine_readers

MARK = "<!-- genuine topographies, from tests/exchange/judge_genuine.py -->"
LETTERS = "abcdefghijklmnopqrstuvwxyz"

# What we do not read, why, and a part of what we say of it.
REFUSED = {
    "csv-1.csv": ("a profile: two columns, distance and height", "profile, not a surface"),
    "nonsense_txt_file.txt": ("no numbers: nobody reads it", "no numbers"),
    "point_cloud_int16_binary.x3p": ("scattered points of no grid", "lie on no regular grid"),
}

# What another reader makes of a file that we read otherwise: in what, and who is right.
TOLD = {
    ("bcrf-1.bcrf", "Gwyddion"): (
        "heights", "Gwyddion shifts the heights so that the lowest is the header's zmin, written with 7 digits: "
        "3e-13 m; the shape is the same"),
    ("metropro-1.dat", "surfalize"): (
        "heights", "8 times too high: takes the phase resolution 1 for 4096 counts a turn, the format has 32768"),
    ("nms-1.nms", "SurfaceTopography"): (
        "spacing", "160 m wide: takes the header's spacing for mm; 312.5 nm a pixel is the 160 um field of the "
        "instrument's 100x lens"),
    ("nms-1.nms", "surfalize"): ("heights", "adds zmax where the count 0 is zmin: all are zmax - zmin too high"),
    ("plu-1.plu", "surfalize"): (
        "heights", "begins two numbers too early, in the words for the size: its two first heights are 1e-42 um"),
    ("sur-2.sur", "Gwyddion"): (
        "missing", "does not know this file's missing points, the count zmin - 2: 117 pits of one depth"),
    ("sur-3.sur", "Gwyddion"): (
        "missing", "does not know the missing points, as of sur-2; adds the header's offset z0 to all heights, which we leave out and name: no figure of ours counts from there"),
    ("sur-3.sur", "surfalize"): ("heights", "adds the header's z0 of -0.0034 in um in place of m"),
    ("tmd-1.tmd", "surfalize"): (
        "spacing heights", "takes the format's mm for um: the patch would be 19 um wide, of 300 samples"),
    ("xyz-1.txt", "surfalize"): ("spacing heights unit", ""),
    ("xyz-1-different-order.txt", "surfalize"): ("spacing unit", ""),
    ("xyz-2.txt", "surfalize"): ("spacing missing unit", ""),
}
XYZ = "divides the width by the samples, not the steps between them, takes numbers without a unit for um, and swaps x and y"
for name in ("xyz-1.txt", "xyz-1-different-order.txt", "xyz-2.txt"):
    TOLD[name, "surfalize"] = (TOLD[name, "surfalize"][0], XYZ)


def far(a, b, relative):
    return a is not None and b is not None and abs(a - b) > relative * abs(b)


def differences(ours, other):
    """Words for what differs, in order."""
    if (ours["nx"], ours["ny"]) != (other["nx"], other["ny"]):
        return "samples"
    found = []
    if far(ours["dx"], other["dx"], 1e-9) or far(ours["dy"], other["dy"], 1e-9):
        found.append("spacing")
    a, b = ours["heights"], other["heights"]
    span = np.nanmax(a) - np.nanmin(a) + 1e-9 * np.nanmax(np.abs(a))

    def alike(z):
        return np.array_equal(np.isnan(a), np.isnan(z)) and not np.nanmax(np.abs(a - z)) > 1e-9 * span

    if not alike(b):
        if alike(b[::-1]):
            found.append("mirrored")
        else:
            found.append("heights" if np.array_equal(np.isnan(a), np.isnan(b)) else "missing")
    if ours["unit"] != other["unit"]:
        found.append("unit")
    return " ".join(found)


def figure(value, unit):
    """In a unit that suits it, four digits."""
    if unit != "m":
        return f"{value:.4g}"
    for name, scale in (("m", 1), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9)):
        if abs(value) >= scale or name == "nm":
            return f"{value / scale:.4g} {name}"


class Notes:
    def __init__(self):
        self.texts = []

    def mark(self, text):
        if text not in self.texts:
            self.texts.append(text)
        return f"({LETTERS[self.texts.index(text)]})"


def row(name, answers, notes, faults):
    ours = answers["Asperity"]
    if "refused" in ours:
        why, word = REFUSED.get(name, ("", ""))
        if not why or word not in ours["refused"]:
            faults.append(f"{name}: we refuse it: {ours['refused']}")
        cells = ["", "not read " + notes.mark(why), "", "", ""]
    else:
        if name in REFUSED:
            faults.append(f"{name}: is read, and told here as refused")
        z, unit = ours["heights"], ours["unit"]
        wide = (figure(n * step, unit) if step else "?" for n, step in ((ours["nx"], ours["dx"]), (ours["ny"], ours["dy"])))
        cells = [ours["format"], f"{ours['nx']} × {ours['ny']}", " × ".join(wide), str(np.isnan(z).sum()),
                 figure(np.nanstd(z), unit)]
    agreed = set()
    for judge in ("Gwyddion", "SurfaceTopography", "surfalize", "x3pio"):
        other = answers.get(judge, {"refused": ""})
        mended = "refused" in other and "x3pio, mended" in answers and judge == "x3pio"
        if mended:
            other = answers["x3pio, mended"]
        if "refused" in other:
            cells.append("–")
        elif "refused" in ours:
            cells.append("reads it")
        else:
            found = differences(ours, other)
            told, why = TOLD.get((name, judge), ("", ""))
            if found != told:
                faults.append(f"{name}: {judge} differs in '{found}', told is '{told}'")
            agreed |= {"spacing"} if "spacing" not in found else set()
            agreed |= {"heights"} if found in ("", "spacing") else set()
            cells.append((notes.mark(why) if found else "=") + (" mended" if mended else ""))
    # Some files only Gwyddion reads
    if "refused" not in ours and len(agreed) < 2 and "Gwyddion" in answers:
        faults.append(f"{name}: nobody agrees with us in spacing and heights")
    return f"| {name} | " + " | ".join(cells) + " |"


def main(program):
    folder = pathlib.Path(os.environ["ASPERITY_SAMPLES"]) / "topography"
    files = sorted(p for p in folder.glob("*") if p.is_file()) if folder.is_dir() else []
    if not files:
        print(f"skipped: no genuine files in {folder}")
        return 77
    notes, faults = Notes(), []
    lines = ["| file | format | samples | size | missing | rms height | Gwyddion | SurfaceTopography | surfalize | x3pio |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    for path in files:
        lines.append(row(path.name, genuine_readers.read_all(program, str(path)), notes, faults))
    lines += [""] + [f"({LETTERS[k]}) {text}.\n" for k, text in enumerate(notes.texts)]
    table = "\n".join(lines).rstrip() + "\n"
    print(table)
    if "Gwyddion" not in genuine_readers.judges():
        print("Gwyddion is not installed: its column is empty, and the page is not compared")
    else:
        page = pathlib.Path(os.environ["ASPERITY_TABLE"]).read_text(encoding="utf-8")
        if MARK not in page or page.split(MARK)[1].strip() != table.strip():
            faults.append("the table of docs/validation.md is another one")
    for fault in faults:
        print("FAR", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    sys.exit(main(sys.argv[1]))
