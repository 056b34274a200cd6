# SPDX-License-Identifier: Apache-2.0
"""Surfaces: made, read, or from an array."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from . import _core, _settings
from ._errors import Error
from ._run import ProgressArgument, StopArgument, Task, thread_count

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._made import FileSettings, SurfaceSettings

PathArgument = Union[str, "os.PathLike[str]"]

_UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9, "pm": 1e-12}


class Surface:
    """A microsurface: heights over a regular grid, two flat facets a cell.

    Made by `asperity.gaussian()` and the other kinds, by `asperity.read()` from a file, or by
    `asperity.from_array()`. It does not change; threads may share it. Can be pickled.
    """

    def __init__(self, handle: _core.Surface) -> None:
        self._handle = handle
        self._statistics: dict[str, float] | None = None

    @property
    def heights(self) -> npt.NDArray[np.float32]:
        """Heights, [row, column], in `unit`; a view of the library's memory, not to be written to.
        Rows go along y, columns along x; row 0 is the top row of pictures."""
        return self._handle.heights

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        return np.array(self.heights, dtype=dtype, copy=copy)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of samples."""
        rows, columns = self.heights.shape
        return rows, columns

    @property
    def spacing(self) -> tuple[float, float]:
        """Distance of samples along x and y, in `unit`."""
        return self._handle.dx, self._handle.dy

    @property
    def unit(self) -> str:
        """Of heights and spacing: "m", or "cell" where nothing says a length."""
        return self._handle.unit

    @property
    def name(self) -> str:
        """Where it comes from, a line."""
        return self._handle.name

    @property
    def source(self) -> str:
        """What was found in its file and what had to be assumed; empty for made surfaces."""
        return self._handle.source

    @property
    def tiling(self) -> str:
        """How it was made to fill the plane; empty for made surfaces."""
        return self._handle.tiling

    @property
    def periodic(self) -> bool:
        """True when it repeats without end, False for a patch with edges."""
        return self._handle.periodic

    @property
    def isotropic(self) -> bool:
        """Declared: its statistics do not depend on the azimuth."""
        return self._handle.isotropic

    @property
    def statistics(self) -> dict[str, float]:
        """Figures of ISO 25178-2 and of the slopes: rms_height (Sq), rms_gradient (Sdq), alpha_x, alpha_y
        (sqrt(2) times the RMS slope), skewness, kurtosis, mean_tilt_deg, area_ratio (1 + Sdr) and others.
        Heights in `unit`, about their mean; nothing is levelled. Computed at the first look."""
        if self._statistics is None:
            self._statistics = self._handle.statistics(thread_count(None))
        return dict(self._statistics)

    def normal_distribution(self, theta_bins: int = 90, phi_bins: int = 1) -> npt.NDArray[np.float64]:
        """The density of facet normals D [1/sr], [theta, phi], over cells equal in both angles: theta from
        0 to 90 degrees, phi from 0 to 360. The integral of D cos(theta) is 1. Walter et al. 2007, 3.1."""
        return _core.normal_distribution(self._handle, theta_bins, phi_bins, 0)

    def save(self, path: PathArgument) -> None:
        """Writes the heights, the format by the ending: .gsf (keeps all of it), .exr, .txt. The file is
        whole or not there at all."""
        self._handle.save(os.fspath(path))

    def plot(self, **options: Any) -> Any:
        """`asperity.plot.surface()` of this surface."""
        from . import plot

        return plot.surface(self, **options)

    def plot_normals(self, **options: Any) -> Any:
        """`asperity.plot.normals()` of this surface."""
        from . import plot

        return plot.normals(self, **options)

    def _rows(self) -> list[tuple[str, str]]:
        rows, columns = self.shape
        dx, dy = self.spacing
        figures = self.statistics
        unit = "cells" if self.unit == "cell" else self.unit
        table = [("name", self.name), ("samples", f"{rows} rows, {columns} columns"),
                 ("spacing", f"{dx:.6g} {unit}" if dx == dy else f"{dx:.6g} × {dy:.6g} {unit}"),
                 ("RMS height (Sq)", f"{figures['rms_height']:.4g} {unit}"),
                 ("RMS gradient (Sdq)", f"{figures['rms_gradient']:.4g}"),
                 ("alpha along x, y", f"{figures['alpha_x']:.4g}, {figures['alpha_y']:.4g}"),
                 ("fills the plane", self.tiling or ("periodic" if self.periodic else "a finite patch"))]
        return table + ([("read as", self.source)] if self.source else [])

    def __repr__(self) -> str:
        rows, columns = self.shape
        return f"<asperity.Surface {self.name!r}, {rows} x {columns}>"

    def _repr_html_(self) -> str:
        return html_table(self._rows())

    def _repr_png_(self) -> bytes:
        return png_bytes(self._handle.save_png)


def html_table(rows: Sequence[Sequence[str]], head: Sequence[str] = ()) -> str:
    """A small table for notebooks."""
    import html

    lines = ["<table>"]
    if head:
        lines.append("<tr>" + "".join(f"<th>{html.escape(c)}</th>" for c in head) + "</tr>")
    for row in rows:
        lines.append("<tr>" + "".join(f"<td>{html.escape(c)}</td>" for c in row) + "</tr>")
    return "\n".join([*lines, "</table>"])


def png_bytes(save: Any, *arguments: Any) -> bytes:
    """The bytes of the PNG that save(path, ...) writes."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.png")
        save(path, *arguments)
        with open(path, "rb") as file:
            return file.read()


def _load(texts: _settings.SettingTexts, progress: ProgressArgument, stop: StopArgument,
          threads: int | None) -> Surface:
    with Task(progress, stop) as task:
        return Surface(_core.load_surface(texts, thread_count(threads), task.callbacks))


def surface(spec: str, *, progress: ProgressArgument = False, stop: StopArgument = None,
            threads: int | None = None, **settings: "Unpack[SurfaceSettings]") -> Surface:
    """Makes or reads a surface as the command line's --surface does.

    `spec` is a kind, perhaps with settings ("gaussian:alpha=0.3,size=256"), or the name of a file. Further
    settings are keywords, see `asperity.settings()`. A setting that the kind does not use is refused.
    The same settings give the same bits for any number of threads.
    """
    known = _settings.keywords(("Surface",))
    return _load([("surface", spec), *_settings.texts_of(settings, known)], progress, stop, threads)


def file_keywords() -> dict[str, str]:
    """Keywords of `read()` -> settings."""
    names = set(_core.file_settings())
    return {k: n for k, n in _settings.keywords(("Surface",)).items() if n in names}


def read(path: PathArgument, *, progress: ProgressArgument = False, stop: StopArgument = None,
         threads: int | None = None, **settings: "Unpack[FileSettings]") -> Surface:
    """Reads a topography as instruments and programs write them; `asperity.heights_formats()` lists which.

    What was found in the file and what had to be assumed is in `Surface.source`. Keywords are the settings
    that files have: tiling, cell_size, height_scale, boundary, diagonal, format, channel, decimal and those
    of `asperity.settings()` that say so. Missing points are refused, naming how many, unless a setting says
    what to do with them. Where our readers do not know the file and the package SurfaceTopography is
    installed (extra [topography]), its readers are tried; `source` says so.
    """
    texts = _settings.texts_of(settings, file_keywords())
    name = os.fspath(path)
    try:
        return _load([("surface", f"file:{name}"), *texts], progress, stop, threads)
    except Error as error:
        other = _read_by_surface_topography(name, error, settings)
        if other is None:
            raise
        return other


def _read_by_surface_topography(path: str, error: Error, settings: Mapping[str, Any]) -> Surface | None:
    """What SurfaceTopography makes of a file that no reader of ours knows; None without it."""
    from ._errors import ErrorCode

    if error.code != ErrorCode.INVALID_INPUT or not os.path.isfile(path):
        return None
    try:
        from SurfaceTopography import open_topography  # type: ignore[import-not-found,unused-ignore]
    except ImportError:
        return None
    try:
        topography = open_topography(path).topography()
        # Theirs is [x, y], ours [row, column]; the first row of a file is the first of both
        heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan).T
        dx, dy = (float(size) / count for size, count in zip(topography.physical_sizes, topography.nb_grid_pts))
        unit = topography.unit or "cell"
    except Exception:
        return None  # what our readers said is told
    found = f"read by SurfaceTopography; heights in {unit}; spacing {dx:.6g} {unit}"
    return _of_heights(heights, (dx, dy), unit, path, False, found, settings)


def _spacing_of(spacing: float | Sequence[float]) -> tuple[float, float]:
    values = np.atleast_1d(np.asarray(spacing, dtype=np.float64))
    if values.ndim != 1 or values.size not in (1, 2):
        raise Error(f"{spacing!r} is neither a distance nor two, along x and y", place="spacing")
    if not (np.all(np.isfinite(values)) and np.all(values > 0)):
        raise Error(f"{spacing!r} is not above 0", place="spacing")
    return float(values[0]), float(values[-1])


def _scale_of(unit: str) -> float | None:
    if unit in ("cell", "cells"):
        return None
    if unit not in _UNITS:
        raise Error(f"{unit!r} is none of cell, {', '.join(sorted(set(_UNITS) - {'µm', 'μm'}))}", place="unit")
    return _UNITS[unit]


def from_array(z: npt.ArrayLike, spacing: float | Sequence[float] = 1.0, unit: str = "cell", *,
               name: str | None = None, isotropic: bool = False, **settings: "Unpack[FileSettings]") -> Surface:
    """A surface of heights of your own.

    `z` is [row, column], real numbers in `unit`; rows go along y, columns along x. `spacing` is the distance
    of samples along x, or along x and y, in the same unit: "m", "mm", "um", "nm", or "cell", where heights
    are multiples of nothing but the spacing. NaN marks a missing point, which is refused, naming how many,
    unless a setting says what to do with them. `isotropic` declares that the statistics do not depend on
    the azimuth. Settings are those of `read()` that have a meaning here: tiling, boundary, height_scale,
    diagonal and others; with tiling "auto" a patch whose opposite edges do not fit is mirrored.

    The heights are copied once, as 32-bit floats. `name` is what results call it; without one it is called
    by a digest of its heights, so that results of different arrays can be told apart.
    """
    heights = np.asarray(np.ma.filled(np.ma.asarray(z), np.nan) if isinstance(z, np.ma.MaskedArray) else z)
    if heights.dtype.kind not in "fiub" or heights.ndim != 2:
        raise Error(f"an array of {heights.dtype} of shape {heights.shape} is no grid of heights", place="z")
    for keyword in ("cell_size", "format", "channel", "decimal"):
        if settings.get(keyword) is not None:
            raise Error("is for files; say the spacing with spacing=" if keyword == "cell_size"
                        else "is for files", place=keyword)
    return _of_heights(heights, _spacing_of(spacing), unit, name, isotropic, "", settings)


def _of_heights(heights: npt.NDArray[Any], spacing: tuple[float, float], unit: str, name: str | None, isotropic: bool,
                found: str, settings: Mapping[str, Any]) -> Surface:
    (dx, dy), scale = spacing, _scale_of(unit)
    grid = np.ascontiguousarray(heights, dtype=np.float64)
    if scale is not None:
        grid, dx, dy = grid * scale, dx * scale, dy * scale
    if name is None:
        import hashlib

        digest = hashlib.sha256(grid.tobytes() + repr((grid.shape, dx, dy, unit)).encode()).hexdigest()
        name = f"array-{digest[:16]}"
    texts = _settings.texts_of(settings, file_keywords())
    return Surface(_core.surface_from_array(
        grid, (dx, dy), "cell" if scale is None else "m", name, [("surface", f"file:{name}"), *texts], isotropic,
        found))
