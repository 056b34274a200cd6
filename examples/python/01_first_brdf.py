# SPDX-License-Identifier: Apache-2.0
"""First BRDF: a rough surface of gold, lit from three angles, with error bars, beside the theory."""

import asperity
from matplotlib import pyplot

surface = asperity.gaussian(alpha=0.3, size=256)
m = asperity.measure(surface, material="Au", theta_deg=[0, 30, 60], resolution=64, until=(0.01, 0.1))

for theta, albedo, error in zip(m.theta_deg, m.albedo, m.albedo_stderr):
    print(f"{theta:4.0f} degrees: " + ", ".join(f"{name} {a:.5f} +- {e:.1g}"
                                                for name, a, e in zip(m.channel_names, albedo, error)))

theory = "beckmann:alpha=0.3,material=Au"
print(asperity.compare(m, theory))

with asperity.plot.style("light"):
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 3.6))
    m.plot.lobe([0, 30, 60], overlays={"Beckmann": theory}, sigmas=2, ax=axes[0])
    m.plot.hemisphere(60, ax=axes[1])
    figure.savefig("first_brdf.png")
m.save("gold.asperity")
