# SPDX-License-Identifier: Apache-2.0
"""Readers of topographies that nobody here wrote, and ours, all with one answer: a dict

    nx, ny        samples
    dx, dy        spacing [m where unit is "m", else as the file counts]; None: not said
    unit          "m", or "" where the file has no unit of length
    heights       array [ny, nx], NaN where nothing was measured

or {"refused": why}."""
import hashlib
import json
import os
import re
import shutil
import subprocess
import tempfile
import zipfile

import gwyfile
import numpy as np
import surfalize
import x3pio
from SurfaceTopography import open_topography

METRES = {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "um": 1e-6, "nm": 1e-9, "pm": 1e-12}


def answer(heights, dx, dy, unit):
    heights = np.asarray(heights, dtype=float)
    return {"nx": heights.shape[1], "ny": heights.shape[0], "dx": dx, "dy": dy, "unit": unit, "heights": heights}


def ours(program, path):
    with tempfile.TemporaryDirectory() as folder:
        out = subprocess.run([program, path, f"{folder}/h"], check=True, capture_output=True, text=True).stdout
        found = json.loads(out)
        if "refused" in found:
            return found
        heights = np.fromfile(f"{folder}/h").reshape(found["ny"], found["nx"])
    known = found["dx"] > 0
    result = answer(heights, found["dx"] if known else None, found["dy"] if known else None,
                    "m" if found["unit"] == "m" else "")
    return result | {key: found[key] for key in ("format", "found", "assumed")}


def surface_topography(path):
    file = open_topography(path)
    number = next((k for k, c in enumerate(file.channels) if c.dim == 2 and not isinstance(c.unit, tuple)), None)
    if number is None:
        raise ValueError("no channel of heights over an area")
    t = file.topography(channel_index=number)
    scale = METRES[t.unit] if t.unit else 1.0
    heights = np.ma.filled(np.ma.asarray(t.heights(), dtype=float), np.nan).T * scale
    size = [s * scale for s in t.physical_sizes]
    return answer(heights, size[0] / heights.shape[1], size[1] / heights.shape[0], "m" if t.unit else "")


def gwyddion(path):
    """The first channel; its mask says what is missing."""
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/out.gwy"
        if path.endswith(".gwy"):
            shutil.copy(path, out)
        else:
            subprocess.run(["gwyddion", "--no-splash", f"--convert-to-gwy={out}", path], capture_output=True,
                           timeout=60, env=os.environ | {"HOME": folder})
        if not os.path.exists(out):
            raise ValueError("no module of it reads the file")
        fields = gwyfile.load(out)
    key = min((k for k in fields if re.fullmatch(r"/\d+/data", k)), key=lambda k: int(k.split("/")[1]))
    field = fields[key]
    heights = np.array(field["data"], dtype=float).reshape(field["yres"], field["xres"])
    if (mask := fields.get(key.replace("data", "mask"))) is not None:
        heights[np.asarray(mask["data"]).reshape(heights.shape) > 0.5] = np.nan
    unit = field.get("si_unit_z")
    return answer(heights, field["xreal"] / field["xres"], field["yreal"] / field["yres"],
                  "m" if unit is not None and unit["unitstr"] == "m" else "")


def surfalize_surface(path):
    s = surfalize.Surface.load(path)
    return answer(s.data * 1e-6, s.step_x * 1e-6, s.step_y * 1e-6, "m")


def on_grid(x, y, z):
    """Points on a grid, y grows with the row."""
    columns, rows = np.unique(np.round(x, 12)), np.unique(np.round(y, 12))
    if len(columns) * len(rows) > 2 * x.size:
        raise ValueError("points of no grid")
    heights = np.full((len(rows), len(columns)), np.nan)
    heights[np.searchsorted(rows, np.round(y, 12)), np.searchsorted(columns, np.round(x, 12))] = z
    return answer(heights, np.ptp(columns) / (len(columns) - 1), np.ptp(rows) / (len(rows) - 1), "m")


def x3p(path):
    """A matrix with its first row on top; points, and rows of a y of their own, on their grid."""
    file = x3pio.read(path)
    layer = file.layers[0]
    z = np.where(layer.valid, layer.z + file.placement.offset[2], np.nan)
    if isinstance(file, x3pio.Surface) and layer.is_regular_grid:
        x, y = layer.x_values, layer.y_values
        return answer(z, (x[-1] - x[0]) / (len(x) - 1), (y[-1] - y[0]) / (len(y) - 1), "m")
    x = layer.x_values[None, :] if layer.x is None else layer.x
    y = layer.y_values[:, None] if layer.y is None else layer.y
    x, y, valid = (np.broadcast_to(np.asarray(a), z.shape).ravel() for a in (x, y, layer.valid))
    return on_grid(x[valid], y[valid], z.ravel()[valid])


def mended_x3p(path):
    """The same of an archive whose top folder, root element, revision and checksum were put right."""
    with zipfile.ZipFile(path) as file:
        main = next(n for n in file.namelist() if n.endswith("main.xml") and "__MACOSX" not in n)
        top = main[:-len("main.xml")]
        parts = {n[len(top):]: file.read(n) for n in file.namelist() if n.startswith(top) and not n.endswith("/")}
    text = parts["main.xml"].decode("utf-8-sig")
    name = "http://www.opengps.eu/2008/ISO5436_2"
    text = re.sub(r"<(\w+:)?ISO5436(_2)?(\s[^>]*)?>", f'<p:ISO5436_2 xmlns:p="{name}">', text, count=1)
    text = re.sub(r"</(\w+:)?ISO5436(_2)?\s*>", "</p:ISO5436_2>", text)
    text = re.sub(r"<Revision>.*?</Revision>", "<Revision>ISO5436 - 2000</Revision>", text)
    for kind in ("PointData", "ValidPoints"):
        if link := re.search(rf"<{kind}Link>(.*?)</{kind}Link>", text):
            sum_of = hashlib.md5(parts[link[1].strip().lstrip("/")]).hexdigest()
            text = re.sub(rf"<MD5Checksum{kind}>.*?</", f"<MD5Checksum{kind}>{sum_of}</", text)
    parts["main.xml"] = text.encode()
    parts["md5checksum.hex"] = f"{hashlib.md5(parts['main.xml']).hexdigest()} *main.xml\n".encode()
    with tempfile.TemporaryDirectory() as folder:
        with zipfile.ZipFile(f"{folder}/a.x3p", "w") as file:
            for part, data in parts.items():
                file.writestr(part, data)
        return x3p(f"{folder}/a.x3p")


def tried(read, path):
    try:
        return read(path)
    except Exception as error:  # whatever a reader has against a file
        return {"refused": str(error).split("\n")[0] or repr(error)}


def judges():
    readers = {"SurfaceTopography": surface_topography, "surfalize": surfalize_surface}
    if shutil.which("gwyddion"):
        readers = {"Gwyddion": gwyddion} | readers
    return readers


def read_all(program, path):
    """By reader's name, ours first."""
    answers = {"Asperity": ours(program, path)}
    for name, read in judges().items():
        answers[name] = tried(read, path)
    if path.endswith(".x3p"):
        answers["x3pio"] = tried(x3p, path)
        if "refused" in answers["x3pio"]:
            answers["x3pio, mended"] = tried(mended_x3p, path)
    return answers
