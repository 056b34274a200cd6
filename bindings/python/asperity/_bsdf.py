# SPDX-License-Identifier: Apache-2.0
"""BSDFs: analytic models, files, measurements as functions, and those of a user."""

from __future__ import annotations

import os
from typing import Any, Protocol, Union, runtime_checkable

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import Error
from ._measurement import Measurement
from ._run import StopArgument, thread_count

Array = npt.NDArray[np.float64]


@runtime_checkable
class OwnBsdf(Protocol):
    """A BSDF of your own: any object with this method. Two attributes are looked at where they are there:
    `name`, and `isotropic` (False): turning wi and wo together changes nothing, which saves much time."""

    def eval(self, wi: Array, wo: Array) -> npt.ArrayLike:
        """f(wi, wo) [1/sr] without a cosine: [pair] or [pair, channel], for arrays [pair, 3] of unit vectors
        that point away from the surface, z along the normal, none below the horizon."""


class Bsdf:
    """How a surface reflects: f(wi, wo) in 1/sr, never with a cosine.

    wi and wo are unit vectors that point away from the surface, wi to where the light comes from, z along the
    normal. Arguments are arrays [..., 3] that broadcast; results have the broadcast shape, with a last axis of
    channels where f is. At or below the horizon f and pdf are 0. Large arrays are spread over threads; results
    do not depend on how many. Thread-safe, and the interpreter's lock is released.
    """

    def __init__(self, handle: _core.Bsdf, origin: str | None = None) -> None:
        self._handle, self._origin = handle, origin

    @property
    def name(self) -> str:
        """A line that names it, a specification where it is a model."""
        return self._handle.name

    @property
    def channels(self) -> int:
        """Length of the last axis of what eval() gives."""
        return self._handle.channels

    @property
    def channel_names(self) -> list[str]:
        """Names of the channels: "all", or "R", "G", "B", or wavelengths, "550nm"."""
        return list(self._handle.channel_names)

    @property
    def isotropic(self) -> bool:
        """True when turning wi and wo together changes nothing."""
        return self._handle.isotropic

    def eval(self, wi: npt.ArrayLike, wo: npt.ArrayLike, *, threads: int | None = None) -> Array:
        """f(wi, wo) [1/sr], [..., channel]. Raises Error for rows that are no unit vectors."""
        a, b, shape = _pairs(wi, wo)
        return self._handle.eval(a, b, thread_count(threads)).reshape(*shape, self.channels)

    def pdf(self, wi: npt.ArrayLike, wo: npt.ArrayLike, *, threads: int | None = None) -> Array:
        """Density of sample() [1/sr], [...]; its integral over wo is 1 less the share of no sample."""
        a, b, shape = _pairs(wi, wo)
        return self._handle.pdf(a, b, thread_count(threads)).reshape(shape)

    def sample(self, wi: npt.ArrayLike, u: npt.ArrayLike, *, threads: int | None = None) -> tuple[Array, Array]:
        """Draws wo from pairs of numbers uniform in [0, 1): `u` is [..., 2]. Gives wo [..., 3] and its density
        [...] [1/sr]; where the sample falls where f is 0 both are 0. E[f cos(theta_o) / pdf] = albedo."""
        a, shape_a = _rows(wi, 3, "wi")
        b, shape_b = _rows(u, 2, "u")
        shape = _broadcast(shape_a, shape_b, "u")
        a, b = _expand(a, shape_a, shape), _expand(b, shape_b, shape)
        wo, pdf = self._handle.sample(a, b, thread_count(threads))
        return wo.reshape(*shape, 3), pdf.reshape(shape)

    def albedo(self, wi: npt.ArrayLike, *, threads: int | None = None) -> Array:
        """Directional albedo, the integral of f cos(theta_o) over wo: [..., channel]. Models without a closed
        form are integrated, relative error below 1e-3 for alpha >= 0.05."""
        a, shape = _rows(wi, 3, "wi")
        return self._handle.albedo(a, thread_count(threads)).reshape(*shape, self.channels)

    def export(self, path: "str | os.PathLike[str]", format: str | None = None, *, threads: int | None = None,
               stop: StopArgument = None, **options: Any) -> Any:
        """Writes a file that other programs read, see `Measurement.export()`."""
        from ._export import export

        return export(self._handle, path, format, threads, stop, options)

    def __reduce__(self) -> Any:
        if self._origin is None:
            raise TypeError(f"{self!r} cannot be pickled: pickle the measurement that it was made of")
        return bsdf, (self._origin,)

    def __repr__(self) -> str:
        return f"<asperity.Bsdf {self.name!r}, {self.channels} channel{'s' if self.channels > 1 else ''}>"


def _rows(values: npt.ArrayLike, last: int, name: str) -> tuple[Array, tuple[int, ...]]:
    array = np.asarray(values)
    if array.ndim == 0 or array.shape[-1] != last or array.dtype.kind not in "fiu":
        raise Error(f"an array of {array.dtype} of shape {array.shape} is not [..., {last}]", place=name)
    return np.ascontiguousarray(array, dtype=np.float64).reshape(-1, last), array.shape[:-1]


def _broadcast(a: tuple[int, ...], b: tuple[int, ...], name: str) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(a, b)
    except ValueError:
        raise Error(f"shapes {a} and {b} do not broadcast", place=name) from None


def _expand(rows: Array, shape: tuple[int, ...], wanted: tuple[int, ...]) -> Array:
    """The rows for the broadcast shape; one row alone stays one, the library takes it for all."""
    if rows.shape[0] <= 1 or shape == wanted:
        return rows
    last = rows.shape[-1]
    return np.ascontiguousarray(np.broadcast_to(rows.reshape(*shape, last), (*wanted, last))).reshape(-1, last)


def _pairs(wi: npt.ArrayLike, wo: npt.ArrayLike) -> tuple[Array, Array, tuple[int, ...]]:
    a, shape_a = _rows(wi, 3, "wi")
    b, shape_b = _rows(wo, 3, "wo")
    shape = _broadcast(shape_a, shape_b, "wo")
    if 0 in shape:
        a, b = a[:0], b[:0]
    return _expand(a, shape_a, shape), _expand(b, shape_b, shape), shape


def bsdf(source: Union[str, "os.PathLike[str]", Measurement]) -> Bsdf:
    """A BSDF to evaluate and sample.

    `source` is a specification such as "ggx:alpha=0.3,material=Au" (`asperity.bsdf_models()` lists the models
    and their parameters), a file of a format that is read (.bsdf of RGL and others, "file:" before any name),
    a result file, or a Measurement, which is then interpolated between its layers and cells.
    """
    if isinstance(source, Measurement):
        return Bsdf(_core.Bsdf.of_measurement(source._handle))
    text = os.fspath(source)
    if _core.Bsdf.is_spec(text):
        return Bsdf(_core.Bsdf.of_spec(text), text)
    path = text.removeprefix("file:")
    if not os.path.exists(path):
        # The library says which models there are; a name with a dot or a slash can only be a file
        if "/" in path or "." in path.split(":")[0]:
            raise Error("there is no such file", 4, path)
        return Bsdf(_core.Bsdf.of_spec(text), text)
    if _core.Bsdf.can_read(path):
        return Bsdf(_core.Bsdf.of_file(path), text)
    return Bsdf(_core.Bsdf.of_measurement(_core.Measurement.load(path)), text)


def handle_of(source: Any, place: str) -> Any:
    """What the library takes for anything that can stand for a BSDF."""
    if isinstance(source, Measurement):
        return source._handle
    if isinstance(source, Bsdf):
        return source._handle
    if isinstance(source, (str, os.PathLike)):
        path = os.fspath(source)
        if os.path.exists(path) and _core.is_result(path) and not _core.Bsdf.can_read(path):
            return _core.Measurement.load(path)
        return bsdf(source)._handle
    if callable(getattr(source, "eval", None)):
        return _own(source)
    raise Error(f"a {type(source).__name__} is neither a measurement nor a BSDF: it has no eval(wi, wo)",
                place=place)


def _own(source: OwnBsdf) -> _core.OwnBsdf:
    name = str(getattr(source, "name", type(source).__name__))

    def eval_pairs(wi: Array, wo: Array) -> Array:
        f = np.asarray(source.eval(wi, wo), dtype=np.float64)
        if f.ndim == 1:
            f = f[:, None]
        if f.ndim != 2 or f.shape[0] != wi.shape[0]:
            raise Error(f"eval gave shape {f.shape} for {wi.shape[0]} pairs, not [pair] or [pair, channel]",
                        place=name)
        return np.ascontiguousarray(f)

    normal = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]])
    channels = eval_pairs(normal, normal).shape[1]
    return _core.OwnBsdf(eval_pairs, name, channels, bool(getattr(source, "isotropic", False)))
