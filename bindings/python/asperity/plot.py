# SPDX-License-Identifier: Apache-2.0
"""Plots with matplotlib (the extra [plot]).

Every function draws into `ax`, or into axes of its own, gives the artists it made, and never calls show().
`style("light")` and `style("dark")` are for `with` or for good; colours are told apart by most colour-blind
eyes (Okabe and Ito), widths are for a column of a paper.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

import matplotlib
import numpy as np
import numpy.typing as npt
from cycler import cycler
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection, QuadMesh
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D

from . import _core
from ._bsdf import handle_of
from ._compare import name_of
from ._errors import Error
from ._measurement import Measurement
from ._surface import Surface

__all__ = ["albedo", "curves", "hemisphere", "lobe", "normals", "style", "surface", "use_style"]

Overlays = Union[Any, Sequence[Any], Mapping[str, Any]]

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
_DARK = {"axes.edgecolor": "#9aa3af", "axes.labelcolor": "#d6dae0", "text.color": "#eceef1",
         "xtick.color": "#9aa3af", "ytick.color": "#9aa3af", "grid.color": "#3a414c", "figure.facecolor": "#101217",
         "axes.facecolor": "#101217", "savefig.facecolor": "#101217", "legend.edgecolor": "#3a414c",
         "axes.prop_cycle": cycler(color=["#56b4e9", "#e69f00", "#35c79a", "#e79bc4", "#f0e442", "#d6dae0"])}
_LIGHT = {"axes.edgecolor": "#4a4f57", "grid.color": "#d9dce1", "axes.prop_cycle": cycler(color=list(COLOURS))}
_BOTH = {"axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.linewidth": 0.6,
         "axes.axisbelow": True, "lines.linewidth": 1.4, "legend.frameon": False, "font.size": 9,
         "axes.titlesize": 10, "figure.dpi": 120, "savefig.dpi": 200, "figure.constrained_layout.use": True}


@contextlib.contextmanager
def style(name: str = "light") -> Iterator[None]:
    """with asperity.plot.style("dark"): ... draws what is made within for a light or a dark page."""
    with matplotlib.rc_context(_style(name)):
        yield


def use_style(name: str = "light") -> None:
    """The same for good."""
    matplotlib.rcParams.update(_style(name))


def _style(name: str) -> dict[Any, Any]:
    if name not in ("light", "dark"):
        raise Error(f"{name!r} is none of light, dark", place="style")
    return {**_BOTH, **(_DARK if name == "dark" else _LIGHT)}


def _axes(ax: Axes | None, polar: bool = False) -> Axes:
    if ax is not None:
        if polar != (ax.name == "polar"):
            raise Error(f"these axes are {ax.name}, the plot needs {'polar' if polar else 'straight'} ones",
                        place="ax")
        return ax
    with matplotlib.rc_context(_style("light") if _is_plain() else {}):
        return pyplot.figure(figsize=(4.8, 3.6)).add_subplot(projection="polar" if polar else None)


def _is_plain() -> bool:
    """matplotlib as it comes: whoever chose a style keeps it."""
    return bool(matplotlib.rcParams["axes.prop_cycle"] == matplotlib.rcParamsDefault["axes.prop_cycle"])


def _channel(m: Measurement, channel: "int | str | None") -> int:
    """The library's number of a channel: -1 is the mean of all."""
    if channel is None:
        return -1
    if isinstance(channel, str):
        if channel not in m.channel_names:
            raise Error(f"{channel!r} is none of {', '.join(m.channel_names)}", place="channel")
        return m.channel_names.index(channel)
    return channel


def _named(overlays: "Overlays | None") -> dict[str, Any]:
    """Label -> what is drawn."""
    if overlays is None:
        return {}
    if isinstance(overlays, Mapping):
        return dict(overlays)
    if isinstance(overlays, str) or not isinstance(overlays, (list, tuple)):
        overlays = [overlays]
    return {name_of(o): o for o in overlays}


def _layer(m: Measurement, theta_deg: float | None, phi_deg: float | None, layer: int | None) -> int:
    if layer is not None:
        if not 0 <= layer < m.layers:
            raise Error(f"{layer} is outside 0 .. {m.layers - 1}", place="layer")
        return layer
    return m.layer(float(m.theta_deg[0]) if theta_deg is None else theta_deg, phi_deg)


def lobe(m: Measurement, theta_deg: "float | Sequence[float] | None" = None, *, phi_deg: float | None = None,
         overlays: "Overlays | None" = None, channel: "int | str | None" = None, cosine: bool = False,
         scale: str = "linear", polar: bool = False, sigmas: float = 1, ax: Axes | None = None,
         label: str | None = None) -> list[Union[Line2D, PolyCollection]]:
    """The lobe in the plane of incidence, with a band of `sigmas` standard errors.

    `theta_deg` is an angle of the measurement, or several; `overlays` are measurements of the same light and
    detector, BSDFs, specifications ("ggx:alpha=0.3"), or objects of yours with eval(wi, wo), in a list or by
    label: a model is averaged over the same cells, so that the two may be compared point by point. theta_o is
    negative on the side the light comes from. `channel` by number or name, None for the mean; `cosine` draws
    f cos(theta_o); `scale` is "linear" or "log"; `polar` draws the radius along theta_o.
    """
    if scale not in ("linear", "log"):
        raise Error(f"{scale!r} is none of linear, log", place="scale")
    axes = _axes(ax, polar)
    angles = [theta_deg] if theta_deg is None or np.ndim(theta_deg) == 0 else list(theta_deg)  # type: ignore[arg-type]
    values = "f_cos" if cosine else "f"
    artists: list[Union[Line2D, PolyCollection]] = []
    number, seen = _channel(m, channel), []
    for angle in angles:
        k = _layer(m, angle, phi_deg, None)  # type: ignore[arg-type]
        slice_ = _core.lobe(m._handle, k, number)
        theta = slice_["theta"] if polar else np.degrees(slice_["theta"])
        f, error = slice_[values], slice_[values + "_stderr"]
        name = f"{m.theta_deg[k]:.4g}°" if len(angles) > 1 else label or "measured"
        line, = axes.plot(theta, f, label=name, zorder=3)
        artists.append(line)
        seen.append(f)
        if np.all(np.isfinite(error)) and np.any(error > 0):
            least = f[f > 0].min() / 1e3 if scale == "log" and np.any(f > 0) else 0.0
            artists.append(axes.fill_between(theta, np.maximum(f - sigmas * error, least), f + sigmas * error,
                                             alpha=0.3, color=line.get_color(), linewidth=0))
        dashes = iter(["--", ":", "-.", (0, (3, 1, 1, 1))] * 8)
        for name, other in _named(overlays).items():
            drawn = _overlay(other, m, k, number)
            first = angle == angles[0]
            colour = line.get_color() if len(angles) > 1 else None
            artists += axes.plot(theta, drawn[values], next(dashes), label=name if first else None, color=colour)
        if not polar:
            mark = axes.axvline(float(m.theta_deg[k]), color=axes.xaxis.label.get_color(), alpha=0.35, linewidth=0.8)
            mark.set_zorder(1)
            artists.append(mark)
    _lobe_axes(axes, scale, polar, cosine)
    if scale == "log" and not polar:
        _log_limits(axes, np.concatenate(seen))
    if len(artists) > 1:
        if polar:
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.06), ncols=2, frameon=False)
        else:
            axes.legend(fontsize="small")
    return artists


def _overlay(other: Any, m: Measurement, layer: int, channel: int) -> dict[str, npt.NDArray[np.float64]]:
    if isinstance(other, Measurement):
        k = other.layer(float(m.theta_deg[layer]), float(m.phi_deg[layer]))
        if not np.array_equal(other.theta_edges_deg, m.theta_edges_deg):
            raise Error("has another detector than the measurement", place="overlays")
        return _core.lobe(other._handle, k, channel)
    handle = handle_of(other, "overlays")
    one_channel = isinstance(handle, _core.Bsdf) and handle.channels == 1
    return _core.lobe(handle, m._handle, layer, -1 if one_channel else channel)


def _lobe_axes(axes: Axes, scale: str, polar: bool, cosine: bool) -> None:
    quantity = "f cos θₒ [1/sr]" if cosine else "f [1/sr]"
    if scale == "log":
        axes.set_yscale("log")
    if polar:
        axes.set_theta_zero_location("N")  # type: ignore[attr-defined]
        axes.set_theta_direction(-1)  # type: ignore[attr-defined]
        axes.set_thetamin(-90)  # type: ignore[attr-defined]
        axes.set_thetamax(90)  # type: ignore[attr-defined]
        axes.set_title(quantity)
        return
    axes.set_xlim(-90, 90)
    axes.set_xticks(range(-90, 91, 30))
    axes.set_xlabel("θₒ in the plane of incidence [°]")
    axes.set_ylabel(quantity)
    if scale == "linear":
        axes.set_ylim(bottom=0)


def _log_limits(axes: Axes, f: npt.NDArray[np.float64]) -> None:
    """What was measured decides, five decades at most: models fall off without end."""
    if np.any(f > 0):
        top = f.max()
        axes.set_ylim(max(f[f > 0].min() / 2, top / 1e5), 2 * top)


def hemisphere(m: Measurement, theta_deg: float | None = None, *, phi_deg: float | None = None,
               channel: "int | str | None" = None, layer: int | None = None, scale: str = "log",
               decades: float = 4, cmap: str = "inferno", colorbar: bool = True,
               ax: Axes | None = None) -> QuadMesh:
    """A layer as the hemisphere seen from above: radius sin(theta_o), azimuth counter-clockwise from the right.

    The dot is where the light comes from, the ring where a mirror would send it. The brightest cells, which
    together carry less than a thousandth of the energy, may lie above the colours.
    """
    axes = _axes(ax)
    k = _layer(m, theta_deg, phi_deg, layer)
    number = _channel(m, channel)
    f = m.brdf[k].mean(axis=0) if number < 0 else m.brdf[k, number]
    r = np.sin(np.radians(m.theta_edges_deg))
    phi = np.radians(m.phi_edges_deg)
    weight = f * m.projected_solid_angle[:, None]
    order = np.argsort(f, axis=None)[::-1]
    cut = int(np.searchsorted(np.cumsum(weight.ravel()[order]), 1e-3 * weight.sum()))
    top = float(f.ravel()[order[min(cut, order.size - 1)]]) or 1.0
    norm = matplotlib.colors.LogNorm(top / 10**decades, top) if scale == "log" else \
        matplotlib.colors.Normalize(0, top)
    colours = matplotlib.colormaps[cmap].with_extremes(bad="black", under="black")
    mesh = axes.pcolormesh(np.outer(r, np.cos(phi)), np.outer(r, np.sin(phi)), np.where(f > 0, f, np.nan),
                           cmap=colours, norm=norm, shading="flat", rasterized=True)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.add_patch(matplotlib.patches.Circle((0, 0), 1, fill=False, color="0.5", linewidth=0.8))
    axes.set_title(f"θᵢ = {m.theta_deg[k]:.4g}°")
    s, azimuth = np.sin(np.radians(m.theta_deg[k])), np.radians(m.phi_deg[k])
    x, y = s * np.cos(azimuth), s * np.sin(azimuth)
    axes.plot(x, y, "o", markersize=4, color="white", markeredgecolor="black", markeredgewidth=0.5)
    axes.plot(-x, -y, "o", markersize=7, fillstyle="none", color="white", markeredgewidth=1)
    if colorbar:
        axes.figure.colorbar(mesh, ax=axes, label="f [1/sr]", shrink=0.85, extend="max" if cut else "neither")
    return mesh


def albedo(m: Measurement, *, channel: "int | str | None" = None, groups: int = 4,
           overlays: "Overlays | None" = None, ax: Axes | None = None) -> list[Any]:
    """The albedo over the incident angle, by number of reflections: bands that add up to it, the last one for
    all higher orders; bars are standard errors, dashed lines the albedos of models."""
    axes = _axes(ax)
    number = _channel(m, channel)
    shares, total, error = (a.mean(axis=1) if number < 0 else a[:, number]
                            for a in (m.albedo_by_bounce, m.albedo, m.albedo_stderr))
    groups = min(groups, shares.shape[1])
    parts = np.column_stack([shares[:, :groups - 1], shares[:, groups - 1:].sum(axis=1)])
    order = np.argsort(m.theta_deg, kind="stable")
    theta = m.theta_deg[order]
    names = [f"{k + 1} reflection{'s' if k else ''}" for k in range(groups - 1)] + [f"{groups} and more"]
    colours = matplotlib.colormaps["viridis"](np.linspace(0.85, 0.25, groups))
    artists: list[Any] = list(axes.stackplot(theta, parts[order].T, labels=names, colors=colours, alpha=0.85))
    artists.append(axes.errorbar(theta, total[order], error[order], color=axes.xaxis.label.get_color(), marker="o",
                                 markersize=3, linewidth=1, capsize=2, label="albedo"))
    for dash, (name, other) in zip(["--", ":", "-."] * 4, _named(overlays).items()):
        artists += axes.plot(theta, _albedos(other, theta, number), dash, label=name,
                             color=axes.xaxis.label.get_color())
    axes.set_xlabel("θᵢ [°]")
    axes.set_ylabel("share of the light")
    axes.set_ylim(bottom=0)
    axes.margins(x=0.02)
    axes.legend(fontsize="small", loc="lower left")
    return artists


def _albedos(other: Any, theta_deg: npt.NDArray[np.float64], channel: int) -> npt.NDArray[np.float64]:
    from ._bsdf import Bsdf, bsdf

    f = other if isinstance(other, Bsdf) else bsdf(other)
    t = np.radians(theta_deg)
    a = f.albedo(np.stack([np.sin(t), np.zeros_like(t), np.cos(t)], axis=-1))
    return a.mean(axis=1) if channel < 0 or a.shape[1] == 1 else a[:, channel]


def surface(s: Surface, *, relief: bool = True, cmap: str = "cividis", colorbar: bool = True,
            scale_bar: bool = True, ax: Axes | None = None) -> AxesImage:
    """The surface seen from above, row 0 on top, coloured by height about the mean; `relief` lights it from the
    upper left; the bar tells a length."""
    axes = _axes(ax)
    h = np.asarray(s.heights, dtype=np.float64)
    h = h - h.mean()
    dx, dy = s.spacing
    rows, columns = h.shape
    width, height = columns * dx, rows * dy
    factor, unit = _length_unit(width, s.unit)
    h_factor, h_unit = _length_unit(float(np.abs(h).max()) or 1.0, s.unit)
    limit = float(np.abs(h).max()) * h_factor or 1.0
    norm = matplotlib.colors.Normalize(-limit, limit)
    extent = (0.0, width * factor, height * factor, 0.0)
    mappable = matplotlib.cm.ScalarMappable(norm, cmap)
    if relief:
        light = matplotlib.colors.LightSource(azdeg=315, altdeg=45)
        steep = np.hypot(*np.gradient(h, dy, dx)).mean()
        exaggeration = 0.5 / steep if steep > 0 else 1.0
        rgb = light.shade(h * h_factor, matplotlib.colormaps[cmap], norm=norm, blend_mode="soft", dx=dx * h_factor,
                          dy=dy * h_factor, vert_exag=exaggeration)
        image = axes.imshow(rgb, extent=extent, interpolation="nearest")
    else:
        image = axes.imshow(h * h_factor, cmap=cmap, norm=norm, extent=extent, interpolation="nearest")
    axes.set_axis_off()
    if scale_bar:
        _draw_scale_bar(axes, width * factor, height * factor, unit)
    if colorbar:
        axes.figure.colorbar(mappable, ax=axes, label=f"height [{h_unit}]", shrink=0.85)
    return image


def _length_unit(length: float, unit: str) -> tuple[float, str]:
    """Factor and unit in which a length is read best."""
    if unit != "m":
        return 1.0, "cells"
    for factor, name in ((1.0, "m"), (1e3, "mm"), (1e6, "µm")):
        if length * factor >= 1:
            return factor, name
    return 1e9, "nm"


def _draw_scale_bar(axes: Axes, width: float, height: float, unit: str) -> None:
    """A bar of a round length, a fifth to a half of the width, on a dark plate."""
    power = 10.0 ** np.floor(np.log10(width / 4))
    length = max(step * power for step in (1, 2, 5, 10) if step * power <= width / 2.5)
    x, y = 0.05 * width, 0.95 * height
    plate = matplotlib.patches.Rectangle((x - 0.02 * width, y - 0.085 * height), length + 0.04 * width, 0.105 * height,
                                         color="black", alpha=0.55, linewidth=0)
    axes.add_patch(plate)
    axes.plot([x, x + length], [y, y], color="white", linewidth=2.5, solid_capstyle="butt")
    axes.text(x + length / 2, y - 0.015 * height, f"{length:g} {unit}", color="white", ha="center", va="bottom",
              fontsize="small")
    axes.set_xlim(0, width)
    axes.set_ylim(height, 0)


def normals(s: Surface, *, bins: int = 90, laws: Sequence[str] = ("beckmann", "ggx"), alpha: float | None = None,
            scale: str = "linear", ax: Axes | None = None) -> list[Line2D]:
    """The distribution of facet normals along the polar angle, mean over the azimuth, beside Beckmann's and GGX'
    of the same `alpha` (the surface's RMS gradient where none is given)."""
    axes = _axes(ax)
    edges = np.linspace(0, 90, bins + 1)
    density = s.normal_distribution(bins, 1)[:, 0]
    artists: list[Any] = [axes.stairs(density, edges, label="facets", fill=scale == "linear", alpha=0.45)]
    width = s.statistics["rms_gradient"] if alpha is None else alpha
    middle = (edges[1:] + edges[:-1]) / 2
    for law, dash in zip(laws, ("-", "--")):
        if law not in ("beckmann", "ggx"):
            raise Error(f"{law!r} is none of beckmann, ggx", place="laws")
        if width > 0:
            artists += axes.plot(middle, _core.normal_profile_of_law(law, width, bins), dash,
                                 label=f"{'GGX' if law == 'ggx' else 'Beckmann'}, α = {width:.3g}")
    axes.set_yscale(scale)
    axes.set_xlim(0, 90)
    axes.set_xticks(range(0, 91, 15))
    axes.set_xlabel("θₘ [°]")
    axes.set_ylabel("D [1/sr]")
    axes.legend()
    return artists


def curves(sweep: Any, x: str, y: str = "albedo", *, by: str | None = None, ax: Axes | None = None) -> list[Any]:
    """A column of a sweep's table over another, a curve for each value of `by`; bars are standard errors of the
    albedo. Channels are averaged."""
    axes = _axes(ax)
    table = {name: np.asarray(column) for name, column in sweep.table.items()}
    for name in (x, y, *([by] if by else [])):
        if name not in table:
            raise Error(f"there is no column {name!r}; there are {', '.join(table)}", place="x")
    error = table.get(f"{y}_stderr")
    artists = []
    for value in (np.unique(table[by]) if by else [None]):
        rows = table[by] == value if by else np.ones(len(table[x]), dtype=bool)
        places = np.unique(table[x][rows])
        mean = [table[y][rows & (table[x] == p)].mean() for p in places]
        bars = None if error is None else [error[rows & (table[x] == p)].mean() for p in places]
        artists.append(axes.errorbar(places, mean, bars, marker="o", markersize=3, capsize=2,
                                     label=None if value is None else f"{by} = {value:g}"
                                     if isinstance(value, (float, np.floating, int, np.integer)) else f"{by} = {value}"))
    axes.set_xlabel(x.replace("_deg", " [°]").replace("_", " "))
    axes.set_ylabel(y.replace("_", " "))
    if by:
        axes.legend()
    return artists


class MeasurementPlots:
    """m.plot: the functions of this module for one measurement."""

    def __init__(self, m: "Measurement") -> None:
        self._m = m

    def lobe(self, theta_deg: "float | Sequence[float] | None" = None, **options: Any) -> list[Any]:
        return lobe(self._m, theta_deg, **options)

    def hemisphere(self, theta_deg: float | None = None, **options: Any) -> QuadMesh:
        return hemisphere(self._m, theta_deg, **options)

    def albedo(self, **options: Any) -> list[Any]:
        return albedo(self._m, **options)


MeasurementPlots.lobe.__doc__ = lobe.__doc__
MeasurementPlots.hemisphere.__doc__ = hemisphere.__doc__
MeasurementPlots.albedo.__doc__ = albedo.__doc__
