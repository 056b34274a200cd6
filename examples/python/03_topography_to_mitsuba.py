# SPDX-License-Identifier: Apache-2.0
"""A measured topography to Mitsuba: read, look, measure, export; and, where Mitsuba is installed, render."""

import asperity
import numpy as np
from matplotlib import pyplot

# In place of an instrument: brushed steel of 128 x 96 points every 0.8 um, as a file of heights in metres
rng = np.random.default_rng(1)
grooves = 0.2 * np.cumsum(rng.normal(size=96))[:, None] + 0.1 * rng.normal(size=(96, 128))
asperity.from_array(grooves - grooves.mean(), spacing=0.8, unit="um", tiling="finite").save("steel.gsf")

surface = asperity.read("steel.gsf", tiling="mirror")
print(surface.source or "nothing had to be assumed", "-", surface.tiling)
print({name: surface.statistics[name] for name in ("rms_height", "rms_gradient", "alpha_x", "alpha_y")})
surface.plot()
pyplot.savefig("steel.png")

m = asperity.measure(surface, material="Fe", theta_deg=[0, 20, 40, 60, 75, 85], phi_deg=range(0, 360, 45),
                     resolution=32, jitter=2)
written = m.export("steel.bsdf")
print(written)

try:
    import mitsuba
except ImportError:
    print("Mitsuba is not installed: nothing is rendered")
else:
    mitsuba.set_variant("scalar_rgb")
    scene = mitsuba.load_dict({
        "type": "scene", "integrator": {"type": "path", "max_depth": 4},
        "light": {"type": "constant"}, "lamp": {"type": "directional", "direction": [-1, -1, -2]},
        "sensor": {"type": "perspective", "fov": 30, "film": {"type": "hdrfilm", "width": 96, "height": 96},
                   "to_world": mitsuba.ScalarTransform4f().look_at([0, -5, 1], [0, 0, 0], [0, 0, 1])},
        "ball": {"type": "sphere", "bsdf": {"type": "measured", "filename": "steel.bsdf"}}})
    image = mitsuba.render(scene, spp=16)
    assert np.isfinite(np.array(image)).all()
    mitsuba.util.write_bitmap("steel_mitsuba.png", image)
