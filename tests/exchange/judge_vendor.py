# SPDX-License-Identifier: Apache-2.0
"""judge_vendor.py PROGRAM: a measurement in OpticStudio's format beside the vendor's own conversion of it for Speos, and
another the other way round, in the folder bsdf of ASPERITY_SAMPLES: ours are like the vendor's. Skipped (77) without them."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile

PROGRAM = os.path.abspath(sys.argv[1])
SAMPLES = pathlib.Path(os.environ.get("ASPERITY_SAMPLES", "")) / "bsdf"
ZEMAX = SAMPLES / "test_13_planesymmetric_brdf_zemax.bsdf"
SPEOS_OF_IT = SAMPLES / "test_13_planesymmetric_brdf_speos_reference.anisotropicbsdf"
SPEOS_BRDF = SAMPLES / "test_13_brdf_one_wavelength_speos.brdf"
ZEMAX_OF_IT = SAMPLES / "test_13_brdf_one_wavelength_BRDF_zemax_reference.bsdf"


def numbers(line):
    return [float(word) for word in line.split()]


def read_speos(path):
    """{incidence: (theta, phi, rows)} and the percentage at the first incidence; of one anisotropy angle."""
    lines = [line for line in path.read_text().splitlines() if line.strip()]
    # The description's length is told, so it may hold anything: count from the anisotropy vector on.
    start = next(k for k, line in enumerate(lines) if k >= 4 and numbers_or_none(line) == [0, 1, 0])
    incidences = numbers(lines[start + 6])
    percentage = numbers(lines[start + 9])[1]
    at, tables = start + 9 + int(lines[start + 8]), {}
    for incidence in incidences:
        thetas, phis = (int(word) for word in lines[at].split())
        phi = numbers(lines[at + 1])
        rows = [numbers(line) for line in lines[at + 2:at + 2 + thetas]]
        assert len(phi) == phis and all(len(row) == phis + 1 for row in rows), incidence
        tables[incidence] = ([row[0] for row in rows], phi, [row[1:] for row in rows])
        at += 2 + thetas
    return tables, percentage


def numbers_or_none(line):
    try:
        return numbers(line)
    except ValueError:
        return None


def read_zemax(path):
    """{incidence: (radial, azimuth, rows by azimuth, TIS)}, of one sample rotation."""
    lines = [line.strip() for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]
    after = {line.split()[0]: k + 1 for k, line in enumerate(lines)}
    incidences, azimuth, radial = (numbers(lines[after[name]])
                                   for name in ("AngleOfIncidence", "ScatterAzimuth", "ScatterRadial"))
    at, tables = after["DataBegin"], {}
    for incidence in incidences:
        name, tis = lines[at].split()
        assert name == "TIS", lines[at]
        rows = [numbers(line) for line in lines[at + 1:at + 1 + len(azimuth)]]
        tables[incidence] = (radial, azimuth, rows, float(tis))
        at += 1 + len(azimuth)
    return tables


def between(nodes, x):
    k = max(0, min(len(nodes) - 2, sum(node <= x for node in nodes) - 1))
    return k, (x - nodes[k]) / (nodes[k + 1] - nodes[k])


def at(table, a, b):
    """Linear between the rows `a` lies between and the columns `b` does."""
    row_nodes, column_nodes, rows = table
    (i, s), (j, t) = between(row_nodes, a), between(column_nodes, b)
    return ((1 - s) * ((1 - t) * rows[i][j] + t * rows[i][j + 1])
            + s * ((1 - t) * rows[i + 1][j] + t * rows[i + 1][j + 1]))


def shapes_differ(ours, theirs, weights):
    """L1 of two lists that are brought to one sum first, as a share of it."""
    total_ours = sum(w * a for a, w in zip(ours, weights))
    total_theirs = sum(w * b for b, w in zip(theirs, weights))
    return sum(w * abs(a / total_ours - b / total_theirs) for a, b, w in zip(ours, theirs, weights))


def export(source, target, *options):
    subprocess.run([PROGRAM, "export", source, "-o", target, *options, "--quiet"], check=True)


def to_speos(folder):
    export(ZEMAX, folder / "ours.anisotropicbsdf", "--format", "speos-anisotropic:step=5")
    (ours, level), (theirs, their_level) = (read_speos(path) for path in (folder / "ours.anisotropicbsdf", SPEOS_OF_IT))
    source = read_zemax(ZEMAX)
    assert list(theirs) == list(source) == list(ours), (list(theirs), list(ours))
    far = {}
    for incidence, (thetas, phis, rows) in theirs.items():
        # Speos counts azimuths all round; the last of ours closes the circle
        nodes = [(i, j) for i, theta in enumerate(thetas) for j, phi in enumerate(phis) if theta < 90 and phi < 360]
        mine = [at(ours[incidence], thetas[i], phis[j]) for i, j in nodes]
        weights = [math.sin(2 * math.radians(thetas[i])) for i, _ in nodes]
        far[incidence] = shapes_differ(mine, [rows[i][j] for i, j in nodes], weights)
    print("Zemax to Speos, L1 of the shape by incidence:",
          ", ".join(f"{incidence:g}°: {100 * l1:.3f} %" for incidence, l1 in far.items()))
    assert sum(l1 < 1e-3 for l1 in far.values()) >= 11 and max(far.values()) < 5e-3, far
    # The vendor takes the level from TIS, which counts light beyond the table's last polar angle
    assert abs(their_level - 100 * source[15][3]) < 0.01, their_level
    assert 0.8 * their_level < level < their_level, (level, their_level)


def to_zemax(folder):
    export(SPEOS_BRDF, folder / "ours.bsdf", "--format", "zemax")
    ours, theirs = read_zemax(folder / "ours.bsdf"), read_zemax(ZEMAX_OF_IT)
    assert list(ours) == list(theirs) == [0, 22.5, 45, 67.5], (list(ours), list(theirs))
    for incidence, (radial, azimuth, rows, tis) in theirs.items():
        assert azimuth == list(range(361))
        mine = (ours[incidence][1], ours[incidence][0], ours[incidence][2])
        # Ours is the mean of both sides of the plane of incidence, and 0 below the surface
        nodes = [(i, j) for i in range(0, 181, 5) for j, r in enumerate(radial) if r + incidence < 85]
        far = shapes_differ([at(mine, azimuth[i], radial[j]) for i, j in nodes],
                            [0.5 * (rows[i][j] + rows[360 - i][j]) for i, j in nodes],
                            [math.sin(math.radians(radial[j])) for _, j in nodes])
        # The vendor writes TIS to three places
        print(f"Speos to Zemax at {incidence:g}°: L1 of the shape {100 * far:.2f} %, "
              f"TIS {ours[incidence][3]:.4f}, the vendor's {tis:.4f}")
        assert far < 5e-3 and abs(ours[incidence][3] - tis) <= 5e-4, (far, ours[incidence][3], tis)


if not all(path.exists() for path in (ZEMAX, SPEOS_OF_IT, SPEOS_BRDF, ZEMAX_OF_IT)):
    print("skipped: the vendor's files are not at hand")
    sys.exit(77)
with tempfile.TemporaryDirectory() as name:
    to_speos(pathlib.Path(name))
    to_zemax(pathlib.Path(name))
