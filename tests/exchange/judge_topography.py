#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""judge_topography.py PROGRAM: figures of `asperity surface` beside those of surfalize and SurfaceTopography.

Five made surfaces in metres, of known kinds, read by all three as the same heights. Height parameters and the material
ratio curve must agree to rounding; where definitions differ, the difference is bounded and said here:
- Sdq, Sdr: of facets here, of each program's own differences there: alike to a part in a thousand;
- Sal: we take the mean over the part that overlaps, surfalize goes round the edges: alike to 3 %;
- the core of a sinusoid's material ratio curve lies at its upper or at its lower end, which fall alike: any of the
  two is right, so Sk, Spk and Svk are not compared there.
Runs in a virtual environment that has both; see run_judge.py."""
import json
import subprocess
import sys
import tempfile

import numpy as np
import surfalize
from SurfaceTopography import Topography

program = sys.argv[1]
STEP = 0.5  # um
N = 192


def made():
    rng = np.random.default_rng(15)
    x, y = np.meshgrid(np.arange(N) * STEP, np.arange(N) * STEP)

    def waves(count, sx, sy, amplitude):
        z = np.zeros_like(x)
        for _ in range(count):
            z += amplitude * np.cos(rng.normal(0, sx) * x + rng.normal(0, sy) * y + rng.uniform(0, 2 * np.pi))
        return z

    yield "sinusoid", 0.7 * np.cos(2 * np.pi * x / 16)
    yield "isotropic", waves(60, 0.5, 0.5, 0.05)
    yield "brushed", waves(60, 0.6, 0.06, 0.05)
    yield "plateau with pits", np.minimum(waves(60, 0.5, 0.5, 0.06), 0.1)
    yield "crossed waves", 0.2 * (np.cos(2 * np.pi * x / 12) + np.cos(2 * np.pi * y / 12))


def ours(folder, z):
    with open(f"{folder}/a.txt", "w") as file:
        file.write(f"# Width: {N * STEP} um\n# Height: {N * STEP} um\n# Value units: um\n")
        np.savetxt(file, z, fmt="%.9g")
    out = subprocess.run([program, "surface", f"{folder}/a.txt", "--level", "mean", "--tiling", "finite", "--json"],
                         check=True, capture_output=True, text=True).stdout
    return json.loads(out)["texture"]


def near(what, a, b, relative, floor=0.0):
    good = abs(a - b) <= relative * abs(b) + floor
    print(f"  {what:<18}{a:<14.6g}{b:<14.6g}{'' if good else 'FAR'}")
    return good


good = True
with tempfile.TemporaryDirectory() as folder:
    for name, z in made():
        print(name)
        figures = ours(folder, z)
        judge = surfalize.Surface(z - z.mean(), STEP, STEP)
        um = 1e6
        for key in ("Sa", "Sq", "Sp", "Sv", "Sz"):
            good &= near(key, figures[key] * um, getattr(judge, key)(), 1e-5)
        for key in ("Ssk", "Sku"):
            good &= near(key, figures[key], getattr(judge, key)(), 1e-4, 1e-5)
        good &= near("Sdq", figures["Sdq"], judge.Sdq(), 2e-3)
        good &= near("Sdr", 100 * figures["Sdr"], judge.Sdr(), 2e-3)
        for key in ("Sk", "Spk", "Svk") if name != "sinusoid" else ():
            good &= near(key, figures[key] * um, getattr(judge, key)(), 0.01, 0.005 * figures["Sz"] * um)
        if figures["Sal"] is not None and name != "sinusoid":
            good &= near("Sal", figures["Sal"] * um, judge.Sal(), 0.03)
        topography = Topography((z - z.mean()).T, (N * STEP, N * STEP))
        good &= near("rms height", figures["Sq"] * um, topography.rms_height_from_area(), 1e-5)
        good &= near("rms gradient", figures["Sdq"], topography.rms_gradient(), 3e-3)
print("all agree" if good else "some are FAR")
sys.exit(0 if good else 1)
