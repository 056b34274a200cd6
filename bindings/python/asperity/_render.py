# SPDX-License-Identifier: Apache-2.0
"""Models that have a BRDF, in light."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _core, _settings
from ._bsdf import handle_of
from ._errors import Error
from ._run import ProgressArgument, StopArgument, Task, thread_count, warn_stopped

Colour = Union[float, Sequence[float]]
Point = Sequence[float]

_SETTINGS = ("width", "height", "spp", "depth", "strata", "seed")
_WORDS = ("integrator", "direct", "filter")
_LIGHTS = ("point", "directional", "constant", "sky")


def _triple(value: Any, place: str) -> list[float]:
    numbers = np.atleast_1d(np.asarray(value, dtype=np.float64))
    if numbers.size == 1:
        numbers = np.repeat(numbers, 3)
    if numbers.shape != (3,):
        raise Error(f"{value!r} is not three numbers", place=place)
    return [float(x) for x in numbers]


def light(kind: str, **options: Any) -> "_core.LightList":
    """A light for `render()`.

    "sky": sun_elevation_deg=45, sun_azimuth_deg=130, sun_diameter_deg=0.533, turbidity=3, scale=1.
    "point": position=(1, 1, 1), intensity=300, colour=1. "directional": direction=(1, 1, 1), intensity=3,
    colour=1. "constant": intensity=1, colour=1. "env:FILE": rotation_deg=0, scale=1, a latitude-longitude .exr
    or .hdr. Directions are to the light; x right, y up, z to the viewer.
    """
    def take(**defaults: Any) -> list[Any]:
        for name in options:
            if name not in defaults:
                raise _settings.unknown_keyword(name, defaults)
        return [options.get(name, value) for name, value in defaults.items()]

    if kind == "sky":
        return _core.sky_light(*map(float, take(sun_elevation_deg=45.0, sun_azimuth_deg=130.0,
                                                sun_diameter_deg=0.533, turbidity=3.0, scale=1.0)))
    if kind == "point":
        position, intensity, colour = take(position=(1, 1, 1), intensity=300.0, colour=1.0)
        return _core.point_light(_triple(position, "position"), float(intensity), _triple(colour, "colour"))
    if kind == "directional":
        direction, intensity, colour = take(direction=(1, 1, 1), intensity=3.0, colour=1.0)
        return _core.directional_light(_triple(direction, "direction"), float(intensity),
                                       _triple(colour, "colour"))
    if kind == "constant":
        intensity, colour = take(intensity=1.0, colour=1.0)
        return _core.constant_light([float(intensity) * c for c in _triple(colour, "colour")])
    if kind.startswith("env:"):
        rotation, scale = take(rotation_deg=0.0, scale=1.0)
        return _core.environment_light(kind.removeprefix("env:"), float(rotation), float(scale))
    raise Error(f"{kind!r} is none of {', '.join(_LIGHTS)}, env:FILE", place="light")


def _settings_of(options: dict[str, Any], until: float | None, background: Colour | None) -> Any:
    s = _core.RenderSettings()
    if until is not None:
        s.until, s.spp = float(until), 4096
    for name, value in options.items():
        if value is None:
            continue
        if name in _WORDS:
            getattr(s, f"set_{name}")(value)
        else:
            try:
                setattr(s, name, value)
            except TypeError:
                raise Error(f"{value!r} is not a whole number", place=name) from None
    if background is not None:
        s.set_background(_triple(background, "background"))
    return s


def render(model: "str | os.PathLike[str]" = "ball", brdf: Any = "cook-torrance:roughness=0.4,metallic=1", *,
           second: Any = None, split: float = 0.5, stage: Any = "lambert:albedo=0.5", floor: bool = False,
           fit: bool = True, light: "str | Any | Sequence[Any]" = "sky", background: Colour | None = None,
           camera_position: Point | None = None, camera_target: Point = (0, 0, 0),
           camera_azimuth_deg: float = 0, camera_elevation_deg: float = 0, camera_distance: float = 3.5,
           camera_fov_deg: float = 40, width: int = 512, height: int = 512, spp: int | None = None,
           until: float | None = None, depth: int = 4, integrator: str = "path", direct: str = "mis",
           filter: str = "tent", strata: int = 8, seed: int = 1, threads: int | None = None,
           progress: ProgressArgument = False, stop: StopArgument = None) -> npt.NDArray[np.float32]:
    """Renders a model: linear radiance, [row, column, RGB], row 0 on top; `tonemap()` makes it a picture.

    `model` is one of `asperity.scene_models()` or a file (.obj .ply .stl .gltf .glb .3ds). `brdf` is a
    measurement, a BSDF, a specification, a file, or an object of yours with a vectorised eval(wi, wo); one or
    three channels. `second` is assigned right of `split`, a share of the width. `light` is a name or what
    `light()` gives, or a list of them. `spp` samples a pixel (64), or as many as make the noise smaller than
    `until`. Same settings, same bits, for any number of threads; the command line's `render` makes the same.
    Stops as `measure()` does, and gives the picture as it is then.
    """
    count = thread_count(threads)
    options = {"width": width, "height": height, "spp": spp, "depth": depth, "integrator": integrator,
               "direct": direct, "filter": filter, "strata": strata, "seed": seed}
    settings = _settings_of(options, until, background)
    lights = [light] if isinstance(light, (str, _core.LightList)) else list(light)
    lists = [globals()["light"](x) if isinstance(x, str) else x for x in lights]
    position = None if camera_position is None else _triple(camera_position, "camera_position")
    camera = _core.camera(position, _triple(camera_target, "camera_target"), float(camera_azimuth_deg),
                          float(camera_elevation_deg), float(camera_distance), float(camera_fov_deg))
    sources = [(brdf, "brdf")] + ([(second, "second")] if second is not None else [])
    brdfs = [_core.ready(handle_of(source, place), count) for source, place in sources]
    scene = _core.open_model(os.fspath(model), floor, fit, count)
    with Task(progress, stop) as task:
        pixels, _, interrupted = _core.render(scene, brdfs, float(split), handle_of(stage, "stage"), lists, camera,
                                              settings, count, task.callbacks)
    if interrupted:
        warn_stopped()
    image: npt.NDArray[np.float32] = pixels
    return image


def tonemap(pixels: npt.ArrayLike, curve: str = "none", exposure: float = 0.0) -> npt.NDArray[np.uint8]:
    """Radiance [row, column, RGB] as bytes for screens (sRGB). `curve`: none (cut at white), reinhard, aces, or
    thesis; `exposure` in stops."""
    array = np.ascontiguousarray(pixels, dtype=np.float32)
    if array.ndim != 3 or array.shape[2] != 3:
        raise Error(f"shape {array.shape} is not [row, column, 3]", place="pixels")
    return _core.tonemap(array, curve, float(exposure))
