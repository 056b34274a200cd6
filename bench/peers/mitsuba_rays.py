#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mitsuba_rays.py PROGRAM: Mitsuba 3 traces the heightfields of `asperity` to the same histogram.

Its LLVM variant, on one thread: a mesh of two triangles a cell, tiles side by side as the paths may
leave the first one, perfect mirrors, up to 16 reflections, outgoing directions sorted into 64 x 32
equal cells; one loop of its own compiler, launch points stratified and in tiled order. Ours on one
thread, the whole program, of which a run with few rays is taken off. CPU time, medians of turns.
Runs in a virtual environment that has mitsuba and numpy (tests/exchange/run_judge.py); the name of
LLVM's library may be given in DRJIT_LIBLLVM_PATH. Figures go into the file that
ASPERITY_PEERS_JSON names, if it is set."""
import ctypes.util
import glob
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

if "DRJIT_LIBLLVM_PATH" not in os.environ:
    # Not the first one that is found: old ones do not know what is needed
    found = sorted(glob.glob("/usr/lib/*/libLLVM.so.19*") + glob.glob("/usr/lib/*/libLLVM-19.so*"))
    if not found:
        print("skipped: Mitsuba's LLVM variant needs LLVM 19 (Debian's libllvm19)")
        sys.exit(77)
    os.environ["DRJIT_LIBLLVM_PATH"] = found[0]

import drjit as dr
import mitsuba as mi

mi.set_variant("llvm_ad_rgb")
dr.set_thread_count(1)

program = sys.argv[1]
SIZE, TURNS, BOUNCES, ROWS, COLUMNS = 512, 3, 16, 32, 64
PATHS, OWN_PATHS, FEW_PATHS = 1 << 20, 1 << 25, 1 << 10
SURFACES = {"thesis noise 0.2": "thesis:roughness=0.2", "Gaussian 0.1": "gaussian:alpha=0.141421",
            "Gaussian 0.3": "gaussian:alpha=0.424264"}
THETAS, PHI = (0, 45), 30


class Peer:
    """The surface as a mesh of 3 x 3 tiles, the one in the middle from 0 to 1 tile."""

    def __init__(self, heights):
        rows, columns = heights.shape
        self.sides, self.top = (columns, rows), float(heights.max())
        y, x = np.mgrid[-rows:2 * rows + 1, -columns:2 * columns + 1]
        z = heights[y % rows, x % columns]
        wide = 3 * columns + 1
        corner = (np.arange(3 * rows)[:, None] * wide + np.arange(3 * columns)[None, :]).ravel()
        lower = np.stack([corner, corner + 1, corner + wide], axis=1)
        upper = np.stack([corner + 1, corner + wide + 1, corner + wide], axis=1)
        faces = np.concatenate([lower, upper])
        mesh = mi.Mesh("heights", z.size, len(faces))
        parameters = mi.traverse(mesh)
        parameters["vertex_positions"] = np.stack([x, y, z], axis=-1).astype(np.float32).ravel()
        parameters["faces"] = faces.astype(np.uint32).ravel()
        parameters.update()
        self.scene = mi.load_dict({"type": "scene", "mesh": mesh})

    def trace(self, paths, theta, seed):
        """Counts by cell, and reflections of all paths."""
        scene = self.scene
        t, p = np.radians(theta), np.radians(PHI)
        d = mi.Vector3f(*(float(c) for c in (-np.sin(t) * np.cos(p), -np.sin(t) * np.sin(p),
                                            -np.cos(t))))
        # A jittered point a stratum, row by row
        side = int(np.sqrt(paths))
        k = dr.arange(mi.UInt32, side * side)
        random = mi.PCG32(side * side, initstate=seed)
        width, depth = self.sides
        x = (mi.Float(k % side) + random.next_float32()) * (width / side)
        y = (mi.Float(k // side) + random.next_float32()) * (depth / side)
        # From where the light would meet the highest point over the tile
        back = 1.0
        o = mi.Point3f(x, y, self.top) - d * back
        active, bounces = mi.Bool(True), mi.UInt32(0)

        def body(o, d, active, bounces):
            hit = scene.ray_intersect_preliminary(mi.Ray3f(o, d), coherent=bounces == 0,
                                                  active=active)
            valid = active & hit.is_valid() & (bounces < BOUNCES)
            at = hit.compute_surface_interaction(mi.Ray3f(o, d), mi.RayFlags.Minimal, valid)
            n = dr.select(at.n.z < 0, -at.n, at.n)
            new = dr.normalize(d - 2 * dr.dot(d, n) * n)
            offset = 1e-4 * n
            return (dr.select(valid, at.p + offset, o), dr.select(valid, new, d), valid,
                    dr.select(valid, bounces + 1, bounces))

        o, d, active, bounces = dr.while_loop(
            (o, mi.Vector3f(d.x + 0 * x, d.y + 0 * x, d.z + 0 * x), active & (x >= 0), bounces + 0 * k),
            lambda o, d, active, bounces: active, body)
        row = dr.minimum(mi.UInt32((d.x * d.x + d.y * d.y) * ROWS), ROWS - 1)
        phi = dr.atan2(d.y, d.x)
        phi = dr.select(phi < 0, phi + dr.two_pi, phi)
        column = dr.minimum(mi.UInt32(phi * (COLUMNS / dr.two_pi)), COLUMNS - 1)
        counts = dr.zeros(mi.UInt32, ROWS * COLUMNS)
        dr.scatter_add(counts, mi.UInt32(1), row * COLUMNS + column)
        reflections = dr.sum(mi.Float64(bounces))
        dr.eval(counts, reflections)
        dr.sync_thread()
        return np.array(counts) / (side * side), float(reflections[0]) / (side * side)


def children_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def own(folder, spec, theta, paths, seed):
    """CPU seconds, shares by cell, reflections a path."""
    table = f"{folder}/layer.csv"
    begin = children_seconds()
    said = subprocess.run(
        [program, "simulate", "--surface", spec, "--theta", str(theta), "--phi", str(PHI), "--rays",
         str(paths), "--bounces", str(BOUNCES), "--detector", "equal-area", "--resolution",
         str(COLUMNS), "--orders", "1", "--threads", "1", "--seed", str(seed), "--json",
         "--reference", "none", "-o", f"{folder}/layer.asperity"],
        check=True, capture_output=True, text=True).stdout
    seconds = children_seconds() - begin
    subprocess.run([program, "export", f"{folder}/layer.asperity", "-o", table, "--format",
                    "layers-csv", "--quiet"], check=True)
    # Equal cells of projected solid angle: their shares are to each other as their BRDFs
    rows = np.loadtxt(table, delimiter=",", comments=("#", "layer"))
    return seconds, rows[:, 6] / rows[:, 6].sum(), json.loads(said)["layers"][0]["mean_bounces"]


def race(folder, name, spec, theta):
    heights = f"{folder}/heights.txt"
    subprocess.run([program, "surface", spec, "--size", str(SIZE), "-o", heights, "--quiet"],
                   check=True)
    peer = Peer(np.loadtxt(heights))
    peer.trace(PATHS, theta, 0)  # compiles
    ratios, theirs, ours = [], [], []
    for turn in range(1, TURNS + 1):
        begin = time.process_time()
        shares, reflections = peer.trace(PATHS, theta, turn)
        theirs.append(PATHS / (time.process_time() - begin))
        few = own(folder, spec, theta, FEW_PATHS, turn)[0]
        seconds, own_shares, own_reflections = own(folder, spec, theta, OWN_PATHS, turn)
        ours.append((OWN_PATHS - FEW_PATHS) / (seconds - few))
        ratios.append(ours[-1] / theirs[-1])
    row = {"surface": name, "theta_deg": theta, "mitsuba_paths_per_second": float(np.median(theirs)),
           "paths_per_second": float(np.median(ours)), "ratio": float(np.median(ratios)),
           "mitsuba_reflections": reflections, "reflections": own_reflections,
           "l1_of_histograms": float(np.abs(shares - own_shares).sum())}
    print(f"{name:<18}{theta:>4}{row['mitsuba_paths_per_second'] / 1e6:>12.2f}"
          f"{row['paths_per_second'] / 1e6:>12.1f}{row['ratio']:>8.1f}"
          f"{reflections:>14.4f}{own_reflections:>10.4f}{row['l1_of_histograms']:>8.3f}", flush=True)
    # The same light: a million paths in 2048 cells differ by some hundredths
    assert abs(reflections - own_reflections) < 0.005 * own_reflections
    assert row["l1_of_histograms"] < 0.08
    return row


print("Mitsuba 3 beside ours, million paths per CPU second, one thread each\n"
      f"{'surface':<18}{'':>4}{'Mitsuba':>12}{'ours':>12}{'ratio':>8}{'reflections':>14}{'ours':>10}{'L1':>8}")
with tempfile.TemporaryDirectory() as folder:
    rows = [race(folder, name, spec, theta) for name, spec in SURFACES.items() for theta in THETAS]
mean = float(np.exp(np.mean([np.log(row["ratio"]) for row in rows])))
print(f"geometric mean {mean:.1f}")
if out := os.environ.get("ASPERITY_PEERS_JSON"):
    figures = json.load(open(out)) if os.path.exists(out) else {}
    figures["mitsuba"] = {"geometric_mean": mean, "rows": rows}
    json.dump(figures, open(out, "w"), indent=2)
