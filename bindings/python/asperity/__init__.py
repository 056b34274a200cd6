# SPDX-License-Identifier: Apache-2.0
"""A virtual gonioreflectometer.

A microscopic rough surface goes in; light is traced onto it; what leaves is sorted by direction; out comes a
BRDF with error bars.

    import asperity

    surface = asperity.gaussian(alpha=0.3, size=256)
    m = asperity.measure(surface, material="Au", theta_deg=[0, 30, 60], until=0.01)
    print(m.albedo, m.albedo_stderr)        # [layer, channel]
    print(asperity.compare(m, "beckmann:alpha=0.3,material=Au"))
    m.export("gold.bsdf")                   # for Mitsuba

Angles are in degrees in names that say so; directions are unit vectors that point away from the surface, z along
the mean normal; a BRDF never includes the cosine.
"""

from __future__ import annotations

from . import _core

TYPE_CHECKING = False  # as in typing, which need not be loaded for it
if TYPE_CHECKING:
    from . import plot
    from ._bsdf import Bsdf, OwnBsdf, bsdf
    from ._compare import Comparison, compare
    from ._errors import Error, ErrorCode, StoppedWarning
    from ._export import Export, Fidelity
    from ._fit import Fit, FitReport, fit
    from ._made import *
    from ._measurement import Measurement, load, measure, merge
    from ._render import light, render, tonemap
    from ._run import Progress
    from ._surface import Surface, from_array, read, surface
    from ._sweep import Sweep, sweep
    from ._tables import bsdf_formats, bsdf_models, heights_formats, materials, scene_models, settings, surface_kinds

__version__: str = _core.version

__all__ = [
    "Bsdf", "Comparison", "Error", "ErrorCode", "Export", "Fidelity", "Fit", "FitReport", "Measurement", "OwnBsdf", "Progress",
    "StoppedWarning", "Surface", "Sweep", "bsdf", "bsdf_formats", "bsdf_models", "compare", "fit", "from_array",
    "heights_formats", "light", "load", "materials", "measure", "merge", "plot", "read", "render", "scene_models", "settings",
    "surface", "surface_kinds", "sweep", "tonemap"]

# Names are loaded by who uses them: the import itself loads the library and not even NumPy.
_HOMES = {
    "_bsdf": ("Bsdf", "OwnBsdf", "bsdf"), "_compare": ("Comparison", "compare"),
    "_errors": ("Error", "ErrorCode", "StoppedWarning"), "_export": ("Export", "Fidelity"),
    "_fit": ("Fit", "FitReport", "fit"), "_measurement": ("Measurement", "load", "measure", "merge"),
    "_render": ("light", "render", "tonemap"), "_run": ("Progress",),
    "_surface": ("Surface", "from_array", "read", "surface"), "_sweep": ("Sweep", "sweep"),
    "_tables": ("bsdf_formats", "bsdf_models", "heights_formats", "materials", "scene_models", "settings", "surface_kinds"),
    "_made": tuple(kind["name"].replace("-", "_") for kind in _core.surface_kinds())}
_HOME = {name: home for home, names in _HOMES.items() for name in names}

if not TYPE_CHECKING:
    __all__ += _HOMES["_made"]

    def __getattr__(name: str) -> object:
        import importlib

        if name == "plot":
            return importlib.import_module("asperity.plot")
        if name not in _HOME:
            raise AttributeError(f"module 'asperity' has no attribute {name!r}")
        value = getattr(importlib.import_module(f"asperity.{_HOME[name]}"), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return __all__
