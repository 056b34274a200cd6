# SPDX-License-Identifier: Apache-2.0
"""A surface and a BRDF of one's own: prisms from an array, beside a model written in Python."""

import asperity
import numpy as np

# Prisms along y whose sides are tilted by 10 degrees: light from above leaves at 20 degrees to both sides
columns = np.arange(64)
prisms = np.tan(np.radians(10)) * np.abs((columns % 16) - 8.0)
surface = asperity.from_array(np.tile(prisms, (32, 1)), tiling="periodic", name="prisms")
m = asperity.measure(surface, theta_deg=0, resolution=72, rays=100_000)

f_cos = m.brdf[0, 0] * m.projected_solid_angle[:, None]
rows, columns = np.nonzero(f_cos > 0.1)
middle = (m.theta_edges_deg[1:] + m.theta_edges_deg[:-1]) / 2
print("light leaves at", sorted({float(t) for t in middle[rows]}), "degrees")
assert np.all(np.abs(middle[rows] - 20) < 2.5)


class TwoLobes:
    """The same as a model: two narrow lobes about the prisms' mirror directions."""

    name = "two lobes"
    isotropic = False

    def eval(self, wi: np.ndarray, wo: np.ndarray) -> np.ndarray:
        wm = wi + wo
        wm /= np.linalg.norm(wm, axis=1, keepdims=True)
        tilt = np.radians(10)
        total = np.zeros(len(wi))
        for side in (-1, 1):
            facet = np.array([side * np.sin(tilt), 0, np.cos(tilt)])
            total += np.exp(-np.sum((wm - facet) ** 2, axis=1) / 0.02**2)
        f: np.ndarray = total / (2 * np.pi * 0.02**2) / (4 * wo[:, 2] * wi[:, 2])
        return f


print(asperity.compare(m, TwoLobes()))
