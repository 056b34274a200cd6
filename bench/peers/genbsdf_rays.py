#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""genbsdf_rays.py PROGRAM: Radiance's genBSDF samples the heightfields of `asperity` on a Klems basis.

Polygons of a mirror, all 145 directions of the full Klems basis from above and from below, one
process; a run with few samples is taken off, as reading the scene is no tracing. Ours on one thread,
at 45 degrees, likewise. CPU time, medians of turns. What it finds is a patch with edges, not an
endless surface, so figures are not compared but for the energy that comes back. Runs in a virtual
environment that has pyradiance and numpy (tests/exchange/run_judge.py). Figures go into the file that
ASPERITY_PEERS_JSON names, if it is set."""
import io
import json
import os
import resource
import subprocess
import sys
import tempfile

import numpy as np
import pyradiance

program = sys.argv[1]
SIZE, TURNS, DIRECTIONS = 128, 3, 145
SAMPLES, FEW_SAMPLES = 600, 50
OWN_RAYS, FEW_RAYS = 1 << 22, 1 << 10
SURFACES = {"thesis noise 0.2": "thesis:roughness=0.2", "Gaussian 0.3": "gaussian:alpha=0.424264"}


def children_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def cpu(work):
    begin = children_seconds()
    result = work()
    return children_seconds() - begin, result


def scene(heights):
    """Two triangles a cell, all below z = 0, normals up."""
    out = io.StringIO()
    out.write("void mirror silver\n0\n0\n3 1 1 1\n")
    z = heights - heights.max() - 1e-3
    number = 0
    for j in range(z.shape[0] - 1):
        for i in range(z.shape[1] - 1):
            a, b = (i, j, z[j, i]), (i + 1, j, z[j, i + 1])
            c, d = (i, j + 1, z[j + 1, i]), (i + 1, j + 1, z[j + 1, i + 1])
            for triangle in ((a, b, c), (b, d, c)):
                numbers = " ".join(f"{v:.7g}" for corner in triangle for v in corner)
                out.write(f"silver polygon p{number}\n0\n0\n9 {numbers}\n")
                number += 1
    return out.getvalue().encode()


def own(spec, rays, seed):
    command = [program, "simulate", "--surface", spec, "--size", str(SIZE), "--theta", "45", "--phi",
               "30", "--rays", str(rays), "--threads", "1", "--seed", str(seed), "--reference", "none",
               "--quiet"]
    return cpu(lambda: subprocess.run(command, check=True))[0]


def race(folder, name, spec):
    heights = f"{folder}/heights.txt"
    subprocess.run([program, "surface", spec, "--size", str(SIZE), "-o", heights, "--quiet"],
                   check=True)
    device = f"{folder}/device.rad"
    with open(device, "wb") as file:
        file.write(scene(np.loadtxt(heights)))

    def sample(samples):
        return cpu(lambda: pyradiance.generate_bsdf(device, nsamp=samples, nproc=1, basis="kf"))

    theirs, ours, ratios = [], [], []
    for turn in range(1, TURNS + 1):
        few, (many, found) = sample(FEW_SAMPLES)[0], sample(SAMPLES)
        theirs.append(2 * DIRECTIONS * (SAMPLES - FEW_SAMPLES) / (many - few))
        few = own(spec, FEW_RAYS, turn)
        ours.append((OWN_RAYS - FEW_RAYS) / (own(spec, OWN_RAYS, turn) - few))
        ratios.append(ours[-1] / theirs[-1])
    assert found.front.reflectance, "genBSDF has found no reflectance"
    row = {"surface": name, "genbsdf_rays_per_second": float(np.median(theirs)),
           "rays_per_second": float(np.median(ours)), "ratio": float(np.median(ratios))}
    print(f"{name:<18}{row['genbsdf_rays_per_second'] / 1e6:>12.3f}"
          f"{row['rays_per_second'] / 1e6:>12.1f}{row['ratio']:>8.0f}", flush=True)
    return row


print("Radiance's genBSDF beside ours, million rays per CPU second, one process and one thread\n"
      f"{'surface':<18}{'genBSDF':>12}{'ours':>12}{'ratio':>8}")
with tempfile.TemporaryDirectory() as folder:
    rows = [race(folder, name, spec) for name, spec in SURFACES.items()]
mean = float(np.exp(np.mean([np.log(row["ratio"]) for row in rows])))
print(f"geometric mean {mean:.0f}")
if out := os.environ.get("ASPERITY_PEERS_JSON"):
    figures = json.load(open(out)) if os.path.exists(out) else {}
    figures["genbsdf"] = {"geometric_mean": mean, "rows": rows}
    json.dump(figures, open(out, "w"), indent=2)
