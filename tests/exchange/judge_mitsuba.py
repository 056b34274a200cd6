#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""judge_mitsuba.py PROGRAM: RGL files of `asperity export` in Mitsuba's own `measured` plug-in.

Evaluates models at 10,000 pairs of directions beside their closed form (the program's own `compare`
is not asked), tests that sampling follows the density (chi-square), that a white surface stays white, and
that a sphere looks as our renderer has it. Runs in a virtual environment that has mitsuba and numpy; see run_judge.py."""
import json
import subprocess
import sys
import tempfile

import mitsuba as mi
import numpy as np

PAIRS = 10_000
program = sys.argv[1]
mi.set_variant("scalar_rgb")


def export(folder, model, *options):
    path = f"{folder}/m.bsdf"
    out = subprocess.run([program, "export", model, "-o", path, "--json", *options], check=True,
                         capture_output=True, text=True).stdout
    return path, json.loads(out)


def directions(rng, count, last_deg):
    """Uniform over the cap of the hemisphere down to `last_deg` from the normal."""
    z = rng.uniform(np.cos(np.radians(last_deg)), 1, count)
    phi = rng.uniform(0, 2 * np.pi, count)
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1)


def ggx(wi, wo, alpha):
    """f cos(theta_o) of a mirror-like GGX surface with Smith's height-correlated masking."""
    wm = wi + wo
    wm /= np.linalg.norm(wm, axis=-1, keepdims=True)
    tan2 = (1 - wm[:, 2] ** 2) / wm[:, 2] ** 2
    d = 1 / (np.pi * alpha**2 * wm[:, 2] ** 4 * (1 + tan2 / alpha**2) ** 2)

    def smith(w):
        return 0.5 * (np.sqrt(1 + alpha**2 * (1 - w[:, 2] ** 2) / w[:, 2] ** 2) - 1)

    return d / (1 + smith(wi) + smith(wo)) / (4 * wi[:, 2])


def evaluate(bsdf, wi, wo):
    context, values = mi.BSDFContext(), []
    for a, b in zip(wi, wo):
        si = mi.SurfaceInteraction3f()
        si.wi = mi.Vector3f(*a)
        values.append(bsdf.eval(context, si, mi.Vector3f(*b))[1])
    return np.array(values)


def check_eval(folder):
    rng = np.random.default_rng(1)
    for alpha in (0.1, 0.3, 0.6):
        path, said = export(folder, f"ggx:alpha={alpha}")
        bsdf = mi.load_dict({"type": "measured", "filename": path})
        # Half vectors drawn wide about the lobe: uniform ones would hardly meet a sharp one.
        drawn = 2 * PAIRS
        wi, u = directions(rng, drawn, 80), rng.uniform(0, 0.95, drawn)
        tan2 = alpha**2 * u / (1 - u)
        phi, cos = rng.uniform(0, 2 * np.pi, drawn), 1 / np.sqrt(1 + tan2)
        sin = np.sqrt(1 - cos**2)
        wm = np.stack([sin * np.cos(phi), sin * np.sin(phi), cos], axis=-1)
        wo = 2 * np.sum(wi * wm, axis=-1, keepdims=True) * wm - wi
        above = (wo[:, 2] > 0.02) & (np.sum(wi * wm, axis=-1) > 0)
        wi, wo = wi[above][:PAIRS], wo[above][:PAIRS]
        assert len(wi) == PAIRS
        expected, found = ggx(wi, wo, alpha), evaluate(bsdf, wi, wo)
        l1 = np.abs(found - expected).sum() / expected.sum()
        print(f"ggx {alpha}: L1 over {len(wi)} pairs {100 * l1:.2f} %, "
              f"printed {100 * said['mean_l1']:.2f} (worst {100 * said['worst_l1']:.2f}) %")
        assert l1 < max(2 * said["worst_l1"], 0.01)
        assert said["mean_l1"] < 0.01


def check_sampling(folder):
    """Mitsuba's samples of a file beside the integral of its density: a chi-square test. Its own
    test needs the LLVM variants, which not every machine can run."""
    rows, columns, inside, count = 12, 24, 8, 20_000
    rng, context = np.random.default_rng(3), mi.BSDFContext()
    path, _ = export(folder, "ggx:alpha=0.4")
    bsdf = mi.load_dict({"type": "measured", "filename": path})
    for theta in (10, 45, 70):
        si = mi.SurfaceInteraction3f()
        si.wi = mi.Vector3f(np.sin(np.radians(theta)), 0, np.cos(np.radians(theta)))
        found = np.zeros((rows, columns))
        for u in rng.uniform(size=(count, 3)):
            wo = bsdf.sample(context, si, u[0], mi.Point2f(u[1], u[2]))[0].wo
            if wo.z > 0:
                phi = np.arctan2(wo.y, wo.x) / (2 * np.pi) % 1
                found[min(int(wo.z * rows), rows - 1), min(int(phi * columns), columns - 1)] += 1
        z = (np.arange(rows * inside) + 0.5) / (rows * inside)
        phi = 2 * np.pi * (np.arange(columns * inside) + 0.5) / (columns * inside)
        density = np.array([[bsdf.pdf(context, si, mi.Vector3f(
            np.sqrt(1 - c * c) * np.cos(p), np.sqrt(1 - c * c) * np.sin(p), c)) for p in phi]
            for c in z])
        cells = density.reshape(rows, inside, columns, inside).mean(axis=(1, 3))
        expected = count * cells * 2 * np.pi / (rows * columns)
        expected, found = expected.ravel(), found.ravel()
        rare = expected < 10
        pooled = [(expected[rare].sum(), found[rare].sum())] if expected[rare].sum() > 5 else []
        pairs = list(zip(expected[~rare], found[~rare])) + pooled
        chi2, dof = sum((f - e) ** 2 / e for e, f in pairs), len(pairs) - 1
        # Wilson and Hilferty 1931: the cube root of chi2 / dof is close to normal.
        normal = ((chi2 / dof) ** (1 / 3) - (1 - 2 / (9 * dof))) / np.sqrt(2 / (9 * dof))
        print(f"ggx at {theta} degrees: chi2 {chi2:.0f} for {dof}, {normal:+.2f} sigma, "
              f"density integrates to {expected.sum() / count:.4f}")
        assert normal < 4
        assert abs(expected.sum() / count - 1) < 0.03


def check_white(folder):
    """A white diffuse surface sends back all it gets: the albedo by Mitsuba's own sampling."""
    path, _ = export(folder, "lambert:albedo=1")
    bsdf, context = mi.load_dict({"type": "measured", "filename": path}), mi.BSDFContext()
    rng = np.random.default_rng(2)
    for theta in (0.0, 40.0, 75.0):
        si = mi.SurfaceInteraction3f()
        si.wi = mi.Vector3f(np.sin(np.radians(theta)), 0, np.cos(np.radians(theta)))
        weights = [bsdf.sample(context, si, u[0], mi.Point2f(u[1], u[2]))[1][1]
                   for u in rng.uniform(size=(4000, 3))]
        print(f"white at {theta:g} degrees: {np.mean(weights):.4f}")
        assert abs(np.mean(weights) - 1) < 0.02


def check_scene(folder):
    """The scene that --snippet writes beside the file loads and shows a lit sphere."""
    export(folder, "ggx:alpha=0.3,material=Au", "--snippet")
    scene = mi.load_file(f"{folder}/m_mitsuba.xml", resx=32, resy=32)
    image = np.array(mi.render(scene, spp=4))[:, :, :3]
    middle = image[12:20, 12:20].mean(axis=(0, 1))
    print(f"scene of the snippet: {image.shape}, red, green, blue in the middle {middle.round(3)}")
    assert np.isfinite(image).all() and (middle > 0).all()
    assert middle[0] > 1.2 * middle[2]  # gold


def check_sphere(folder):
    """A sphere in the light of the sun, rendered from the same file by Mitsuba and by Asperity, and from the model it was
    made of: pixel by pixel within the noise of both pictures and the printed fidelity."""
    path, told = export(folder, "ggx:alpha=0.3,material=Au")
    fidelity = told["mean_l1"]
    camera = mi.ScalarTransform4f().look_at([0, 0, 3.5], [0, 0, 0], [0, 1, 0])
    theirs = np.array(mi.render(mi.load_dict({
        "type": "scene", "integrator": {"type": "direct"},
        "sensor": {"type": "perspective", "fov": 40, "to_world": camera,
                   "film": {"type": "hdrfilm", "width": 48, "height": 48, "rfilter": {"type": "box"}}},
        "light": {"type": "directional", "direction": [-1, -1, -1], "irradiance": 3.0},
        "sphere": {"type": "sphere", "bsdf": {"type": "measured", "filename": path}}}), spp=64))[:, :, :3]
    lit = theirs.sum(axis=2) > 0
    # Where the edge of the sphere or of its shadow runs through a pixel, both pictures are noise
    inside = lit.copy()
    for shift in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        inside &= np.roll(lit, shift, axis=(0, 1))
    for brdf in (path, "ggx:alpha=0.3,material=Au"):
        picture = f"{folder}/sphere.exr"
        subprocess.run([program, "render", "--model", "sphere", "--brdf", brdf, "--light", "directional",
                        "--light-intensity", "3", "--width", "48", "--height", "48", "--spp", "64", "--filter", "box",
                        "--depth", "1", "--quiet", "-o", picture], check=True)
        # Beside the colours stands their error
        ours = np.array(dict(mi.Bitmap(picture).split())["<root>"])[:, :, :3]
        off = np.abs(ours - theirs)[inside].sum() / theirs[inside].sum()
        print(f"sphere of {brdf.split('/')[-1]}: {inside.sum()} pixels, mean difference {100 * off:.2f} %, "
              f"light {ours[inside].sum() / theirs[inside].sum():.4f}, fidelity {100 * fidelity:.2f} %")
        assert inside.sum() > 400
        assert off < fidelity + 0.02 and abs(ours[inside].sum() / theirs[inside].sum() - 1) < fidelity + 0.01


with tempfile.TemporaryDirectory() as folder:
    check_scene(folder)
    check_sphere(folder)
    check_eval(folder)
    check_white(folder)
    check_sampling(folder)
