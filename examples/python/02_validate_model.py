# SPDX-License-Identifier: Apache-2.0
"""Where does a microfacet model fail? GGX facets, traced, beside Smith's model of one reflection: what the model
lacks is the light that is reflected more than once, and it shows in the albedo."""

import asperity
import numpy as np
from matplotlib import pyplot

alphas = [0.1, 0.3, 0.6]
missing = []
for alpha in alphas:
    surface = asperity.ggx(alpha=alpha, size=256, correlation_length=6, max_slope=20)
    m = asperity.measure(surface, theta_deg=[0, 45, 75], isotropic=True, resolution=48, jitter=4)
    model = asperity.bsdf(f"ggx:alpha={alpha}")
    c = asperity.compare(m, model)
    once = m.albedo_by_bounce[:, 0, 0]
    missing.append(m.albedo[:, 0] - c.albedo_b)
    for k, theta in enumerate(m.theta_deg):
        print(f"alpha {alpha}, {theta:2.0f} degrees: albedo {m.albedo[k, 0]:.4f}, of one reflection {once[k]:.4f}, "
              f"model {c.albedo_b[k]:.4f}, L1 {c.l1[k]:.3f} (noise {c.l1_noise[k]:.3f})")

lost = np.array(missing)
assert np.all(lost[2] > lost[0]), "the rougher, the more light the model loses"

with asperity.plot.style("light"):
    figure, ax = pyplot.subplots(figsize=(4.8, 3.6))
    for theta, column in zip((0, 45, 75), lost.T):
        ax.plot(alphas, 100 * column, marker="o", label=f"{theta}°")
    ax.set_xlabel("α")
    ax.set_ylabel("light the model loses [%]")
    ax.legend()
    figure.savefig("validate_model.png")
