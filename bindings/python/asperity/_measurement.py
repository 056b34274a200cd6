# SPDX-License-Identifier: Apache-2.0
"""The main job, and what comes out of it."""

from __future__ import annotations

import functools
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core, _settings
from ._errors import Error
from ._run import Counting, ProgressArgument, StopArgument, Task, thread_count, warn_stopped
from ._surface import PathArgument, Surface, html_table, png_bytes

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._export import Export
    from ._made import MeasureSettings
    from .plot import MeasurementPlots

Floats = npt.NDArray[np.float64]


def _frozen(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    array.setflags(write=False)
    return array


class Measurement:
    """Light that left a surface, sorted by direction: one layer for each direction the light came from.

    Axes, wherever arrays have them, in this order: layer (as `theta_deg` and `phi_deg` say, from normal
    incidence down), order (of bounces: 0 left after one reflection, the last holds all higher ones too),
    channel (`channel_names`), row (polar angle theta_o from 0 to 90 degrees, edges in `theta_edges_deg`),
    column (azimuth phi_o from 0 to 360, edges in `phi_edges_deg`). z is the mean normal; light comes from
    (theta_i, phi_i), so the mirror direction has azimuth phi_i + 180 degrees. With isotropic light outgoing
    azimuths count from that of the light. A BRDF never includes the cosine. Arrays are not to be written to.
    Standard errors come from independent batches.
    """

    def __init__(self, handle: _core.Measurement) -> None:
        self._handle = handle

    # Where the light came from

    @functools.cached_property
    def theta_deg(self) -> Floats:
        """Incident polar angles in degrees, [layer]."""
        return _frozen(np.round(np.degrees(self._handle.theta), 12))

    @functools.cached_property
    def phi_deg(self) -> Floats:
        """Azimuths the light came from in degrees, [layer]; 0 for isotropic light."""
        return _frozen(np.round(np.degrees(self._handle.phi), 12))

    @property
    def number(self) -> npt.NDArray[np.int64]:
        """Numbers of the layers, as the thesis counts them: [layer]."""
        return self._handle.number

    def layer(self, theta_deg: float, phi_deg: float | None = None) -> int:
        """The index of the layer that was lit from there, the nearest one within half a degree."""
        distance = np.abs(self.theta_deg - theta_deg)
        if phi_deg is not None:
            distance = distance + np.abs((self.phi_deg - phi_deg + 180) % 360 - 180)
        if not self.layers or not distance.min() <= 0.5:
            have = ", ".join(f"{t:g}" for t in sorted(set(self.theta_deg)))
            raise Error(f"no layer was lit from {theta_deg:g} degrees; there are {have}", place="theta_deg")
        return int(np.argmin(distance))

    # The figures

    @functools.cached_property
    def brdf(self) -> Floats:
        """f [1/sr], [layer, channel, row, column]: the cosine-weighted mean over each cell."""
        return _frozen(self._handle.brdf)

    @functools.cached_property
    def stderr(self) -> Floats:
        """Standard error of `brdf`, same shape; infinite after a single batch."""
        return _frozen(self._handle.stderr)

    @functools.cached_property
    def stderr_rays(self) -> Floats:
        """The part of `stderr` that the rays make, same shape; the rest, in squares, is between surfaces. All of
        it where one surface was measured."""
        return _frozen(self._handle.stderr_rays)

    @functools.cached_property
    def brdf_by_order(self) -> Floats:
        """f [1/sr] by bounces, [layer, order, channel, row, column]; its sum over the orders is `brdf`."""
        return _frozen(self._handle.brdf_by_order)

    def energy(self, layer: int) -> npt.NDArray[np.uint64]:
        """What a layer was counted in: [order, channel, row, column], units of 2^-32 of a launched ray. A view
        of the library's memory."""
        return self._handle.energy(layer)

    @functools.cached_property
    def albedo(self) -> Floats:
        """Share of the light that left again, [layer, channel]."""
        return _frozen(self._handle.albedo)

    @functools.cached_property
    def albedo_stderr(self) -> Floats:
        """Standard error of `albedo`, [layer, channel]."""
        return _frozen(self._handle.albedo_stderr)

    @functools.cached_property
    def albedo_stderr_rays(self) -> Floats:
        """The part of `albedo_stderr` that the rays make, likewise: [layer, channel]."""
        return _frozen(self._handle.albedo_stderr_rays)

    @functools.cached_property
    def albedo_by_bounce(self) -> Floats:
        """Share of the light that left after one reflection, two, ..., [layer, channel, bounce]."""
        return _frozen(self._handle.albedo_by_bounce)

    @functools.cached_property
    def albedo_by_bounce_stderr(self) -> Floats:
        """Standard error of `albedo_by_bounce`, same shape."""
        return _frozen(self._handle.albedo_by_bounce_stderr)

    @functools.cached_property
    def absorbed(self) -> Floats:
        """Share of the light that the facets took, [layer, channel]. With albedo, truncated and edge it makes 1."""
        return _frozen(self._handle.absorbed)

    @functools.cached_property
    def truncated(self) -> Floats:
        """Share of the light that still travelled after the last reflection allowed, [layer, channel]."""
        return _frozen(self._handle.truncated)

    @functools.cached_property
    def edge(self) -> Floats:
        """Share of the light that left through the side of a finite patch, [layer, channel]."""
        return _frozen(self._handle.edge)

    @property
    def rays(self) -> npt.NDArray[np.uint64]:
        """Rays launched, [layer]."""
        return self._handle.rays

    @property
    def batches(self) -> npt.NDArray[np.int64]:
        """Independent batches the errors come from, [layer]; of several surfaces each is one."""
        return self._handle.batches

    # The detector

    @functools.cached_property
    def theta_edges_deg(self) -> Floats:
        """Edges of the rows in degrees, [rows + 1]."""
        return _frozen(np.degrees(self._handle.theta_edges))

    @functools.cached_property
    def phi_edges_deg(self) -> Floats:
        """Edges of the columns in degrees, [columns + 1]."""
        return _frozen(np.degrees(self._handle.phi_edges))

    @property
    def projected_solid_angle(self) -> Floats:
        """Integral of cos(theta_o) over a cell of each row [sr], [row]; all cells together make pi."""
        return self._handle.projected_solid_angle

    # What it is the result of

    @property
    def layers(self) -> int:
        """Number of layers."""
        return self._handle.layers

    @property
    def channel_names(self) -> list[str]:
        """Names of the channels: "all", or "R", "G", "B", or wavelengths."""
        return list(self._handle.channel_names)

    @property
    def experiment(self) -> dict[str, str]:
        """All settings, by their names in files; the texts read back to the same bits."""
        return dict(self._handle.experiment)

    @property
    def surface(self) -> dict[str, float]:
        """Figures of the surface as it was traced, see `Surface.statistics`."""
        return dict(self._handle.surface)

    @property
    def surface_name(self) -> str:
        return self._handle.surface_name

    @property
    def isotropic(self) -> bool:
        """True when the light came from all azimuths."""
        return self._handle.isotropic

    @property
    def stopped(self) -> bool:
        """True when the run was stopped: the layers hold the batches done till then."""
        return self._handle.stopped

    @property
    def notes(self) -> list[str]:
        """What a reader should know, a sentence each."""
        return list(self._handle.notes)

    @property
    def trace_seconds(self) -> float:
        """Time of tracing [s]; no part of the checksum."""
        return self._handle.trace_seconds

    @property
    def version(self) -> str:
        """Version of the library that measured it."""
        return self._handle.version

    @functools.cached_property
    def checksum(self) -> str:
        """32 hexadecimal digits over experiment, surface and layers: the same for any number of threads, and
        from the command line."""
        return self._handle.checksum()

    # Onwards

    def save(self, path: PathArgument) -> str:
        """Writes a result file, whole or not at all; gives the checksum. `asperity.load()` reads it."""
        return self._handle.save(os.fspath(path))

    def export(self, path: PathArgument, format: str | None = None, *, threads: int | None = None,
               stop: StopArgument = None, **options: Any) -> "Export":
        """Writes a file that other programs read, reads it back, and tells how well it holds the data.

        The format is that of the ending (.bsdf for Mitsuba's `measured`, .exr, .csv, .xml, .binary, ...) or
        `format`; `asperity.bsdf_formats()` lists formats and their options, which are keywords here. Stopped by `stop`
        or Ctrl-C while it writes it leaves no file; Error (ErrorCode.STOPPED) or KeyboardInterrupt says so.
        """
        from ._export import export

        return export(self._handle, path, format, threads, stop, options)

    def to_xarray(self) -> Any:
        """An xarray Dataset: brdf, stderr, albedo, albedo_stderr and others with named axes, coordinates in
        degrees and units; needs the extra [xarray]."""
        from ._xarray import to_xarray

        return to_xarray(self)

    def save_sheet(self, path: PathArgument, *, colour_map: str = "inferno", scale: str = "log",
                   projection: str = "sky-map", decades: float = 4, channel: int | None = None) -> None:
        """Writes a PNG of all layers with one scale, as the command line's export does."""
        self._handle.save_sheet(os.fspath(path), colour_map, scale, projection, decades,
                                -1 if channel is None else channel)

    @property
    def plot(self) -> "MeasurementPlots":
        """Plots with matplotlib: m.plot.lobe(theta_deg=30), m.plot.hemisphere(), m.plot.albedo()."""
        from .plot import MeasurementPlots

        return MeasurementPlots(self)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Measurement) and self.checksum == other.checksum

    def __hash__(self) -> int:
        return hash(self.checksum)

    def __reduce__(self) -> Any:
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "m.asperity")
            self.save(path)
            with open(path, "rb") as file:
                return _from_bytes, (file.read(),)

    def __repr__(self) -> str:
        stopped = ", stopped" if self.stopped else ""
        return (f"<asperity.Measurement of {self.surface_name!r}, {self.layers} layers, "
                f"channels {', '.join(self.channel_names)}{stopped}>")

    def _repr_html_(self) -> str:
        head = ["theta_i", "phi_i", "rays"] + [f"albedo {name}" for name in self.channel_names]
        rows = []
        for k in range(self.layers):
            rows.append([f"{self.theta_deg[k]:.4g}°", f"{self.phi_deg[k]:.4g}°", f"{int(self.rays[k]):,}"] +
                        [f"{a:.5f} ± {e:.1g}" for a, e in zip(self.albedo[k], self.albedo_stderr[k])])
        return html_table(rows, head)

    def _repr_png_(self) -> bytes:
        return png_bytes(self.save_sheet)


def _from_bytes(data: bytes) -> Measurement:
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "m.asperity")
        with open(path, "wb") as file:
            file.write(data)
        return load(path)


def measure_keywords() -> dict[str, str]:
    """Keywords of `measure()` -> settings."""
    return _settings.keywords(_settings.MEASURE_GROUPS)


def measure(surface: Surface, *, so_far: Measurement | None = None, part: str | None = None, client: Any = None,
            parts: int | None = None, progress: ProgressArgument = False, stop: StopArgument = None,
            threads: int | None = None,
            **settings: "Unpack[MeasureSettings]") -> Measurement:
    """Shoots light at a surface, follows it from facet to facet, and sorts what leaves by direction.

    Settings are keywords, those of the command line with `_` for `-` and angles in names that end in `_deg`
    (`help(asperity.settings)` and docs/reference.md have them all): theta_deg=[0, 30, 60], material="Au",
    until=0.01, rays=1_000_000, resolution=64, seed=2 ... Same surface, settings and seed give the same bits
    for any number of threads, and the checksum of the command line. A setting that has no effect is refused.

    `progress` is True for a bar, or a function that is called with a `Progress` about ten times a second.
    `stop` is a function that is asked as often and says True to stop. A run that is stopped by it or by Ctrl-C
    ends within 100 ms and gives what is complete, `stopped` set; Ctrl-C also warns (`StoppedWarning`), and
    raises KeyboardInterrupt where nothing is complete. The interpreter's lock is released.

    `so_far` is a result of the same experiment, stopped perhaps, or measured to a looser `until`: what it holds is not
    done again, and the result has the bits of a run that did all of it. part="3/8" does the third of eight shares,
    counted from 1, which `asperity.merge()` adds up.

    With a Dask `client` its workers do it, in `parts` shares (four a thread of theirs where not given), each with
    `threads` (1); they are sent the surface, see no files, and may be killed. The bits are the same; `progress` counts
    shares, and who stops gets those that are complete.
    """
    if not isinstance(surface, Surface):
        raise Error(f"a {type(surface).__name__} is no Surface: asperity.from_array() makes one of heights",
                    place="surface")
    texts = _settings.texts_of(settings, measure_keywords())
    if so_far is not None and not isinstance(so_far, Measurement):
        raise Error(f"a {type(so_far).__name__} is no Measurement", place="so_far")
    if client is not None:
        if part is not None:
            raise Error("a client's workers do all parts", place="part")
        if parts is not None and (isinstance(parts, bool) or not isinstance(parts, int) or not 1 <= parts < 2**20):
            raise Error(f"{parts!r} is not a whole number from 1", place="parts")
        from ._cluster import measure_on_cluster

        with Counting("parts", 0, progress, stop) as told:
            handle, interrupted = measure_on_cluster(surface, texts, thread_count(threads or 1), client, parts, so_far, told)
    elif parts is not None:
        raise Error("is for the workers of a client; part=\"1/8\" measures a share here", place="parts")
    else:
        number, of = _share(part)
        with Task(progress, stop) as task:
            handle, interrupted = _core.measure(surface._handle, texts, thread_count(threads), task.callbacks,
                                                None if so_far is None else so_far._handle, number, of)
    if interrupted:
        warn_stopped()
    return Measurement(handle)


def _share(part: str | None) -> tuple[int, int]:
    if part is None:
        return 1, 1
    number, slash, parts = str(part).partition("/")
    if not (slash and number.isdigit() and parts.isdigit() and 1 <= int(number) <= int(parts) < 2**31):
        raise Error(f"{part!r} is not K/N with 1 <= K <= N", place="part")
    return int(number), int(parts)


def merge(parts: Iterable[Measurement]) -> Measurement:
    """Adds up the parts of one experiment, in any order, to the bits of a run that did all of it. Refuses parts of
    different experiments, one that is there twice, and names what is missing."""
    listed = list(parts)
    if not all(isinstance(p, Measurement) for p in listed):
        raise Error("takes measurements", place="parts")
    return Measurement(_core.merge([p._handle for p in listed]))


def load(path: PathArgument) -> Measurement:
    """Reads a result file, whole; a damaged or foreign one is refused with place and reason."""
    return Measurement(_core.Measurement.load(os.fspath(path)))
