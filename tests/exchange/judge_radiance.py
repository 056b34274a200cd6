#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""judge_radiance.py PROGRAM: Klems and tensor tree files of `asperity export` in Radiance's own loader.

Queries models at pairs of directions beside their closed form (the program's own readers are not
asked), the hemispherical reflectance, and the Helmholtz figure of Radiance's checkBSDF. Runs in a
virtual environment that has pyradiance and numpy; see run_judge.py."""
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
import pyradiance
from pyradiance import bsdf

program = sys.argv[1]


def export(folder, model, spec):
    path = f"{folder}/m.xml"
    subprocess.run([program, "export", model, "-o", path, "--format", spec, "--quiet"], check=True)
    return path


def direction(theta, phi):
    t, p = np.radians(theta), np.radians(phi)
    return np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1)


def ggx(wi, wo, ax, ay):
    """f of mirror-like GGX facets with Smith's height-correlated masking."""
    wm = wi + wo
    wm /= np.linalg.norm(wm, axis=-1, keepdims=True)
    slopes = (wm[:, 0] / ax) ** 2 + (wm[:, 1] / ay) ** 2
    d = 1 / (np.pi * ax * ay * (slopes + wm[:, 2] ** 2) ** 2)

    def smith(w):
        return 0.5 * (np.sqrt(1 + ((ax * w[:, 0]) ** 2 + (ay * w[:, 1]) ** 2) / w[:, 2] ** 2) - 1)

    return d / (1 + smith(wi) + smith(wo)) / (4 * wi[:, 2] * wo[:, 2])


def check_query(folder, model, spec, widths, most):
    rng = np.random.default_rng(1)
    count = 3000
    theta_i, phi_i = rng.uniform(0, 75, count), rng.uniform(0, 360, count)
    # Uniform in projected solid angle, so that the mean of |difference| is an L1 of f cos.
    theta_o = np.degrees(np.arcsin(np.sqrt(rng.uniform(0, 0.98, count))))
    phi_o = rng.uniform(0, 360, count)
    expected = ggx(direction(theta_i, phi_i), direction(theta_o, phi_o), *widths)
    sd = bsdf.load_file(export(folder, model, spec))
    found = np.array([bsdf.query(sd, *angles)[1]
                      for angles in zip(theta_i, phi_i, theta_o, phi_o)])
    l1 = np.abs(found - expected).sum() / expected.sum()
    total = found.sum() / expected.sum()
    print(f"{model} as {spec}: L1 of f cos {100 * l1:.1f} %, energy {total:.4f}")
    assert l1 < most
    assert abs(total - 1) < 0.03
    return sd


def check_albedo(folder, spec):
    sd = bsdf.load_file(export(folder, "lambert:albedo=0.6", spec))
    for theta in (5, 40, 70):
        found = bsdf.direct_hemi(sd, theta, 20, bsdf.SAMPLE_ALL)
        print(f"lambert 0.6 as {spec} at {theta} degrees: {found:.4f}")
        assert abs(found - 0.6) < 0.003


def check_reciprocity(folder, model, spec):
    tool = pathlib.Path(pyradiance.__file__).parent / "bin" / "checkBSDF"
    said = subprocess.run([tool, export(folder, model, spec)], check=True, capture_output=True,
                          text=True).stdout
    figures = re.search(r"Reciprocity Error.*\nInterior Refl\s+(\S+)\s+(\S+)\s+(\S+)", said)
    assert figures, said
    mean, largest = float(figures[2]), float(figures[3])
    print(f"{model} as {spec}: checkBSDF's reciprocity error {mean} % on average, {largest} % at most")
    assert 0 <= mean < 2


with tempfile.TemporaryDirectory() as folder:
    check_query(folder, "ggx:alpha=0.4", "tensortree:levels=5", (0.4, 0.4), 0.06)
    check_query(folder, "ggx:alpha=0.5,alpha_y=0.35", "tensortree:rank=4", (0.5, 0.35), 0.15)
    check_query(folder, "ggx:alpha=0.6", "klems:basis=half", (0.6, 0.6), 0.2)
    check_albedo(folder, "tensortree:levels=4")
    check_albedo(folder, "klems:basis=quarter")
    check_reciprocity(folder, "ggx:alpha=0.6", "klems:basis=quarter")
