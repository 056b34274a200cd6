# SPDX-License-Identifier: Apache-2.0
"""Models fitted to measurements and BSDFs."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _settings
from ._bsdf import Bsdf, bsdf, handle_of
from ._errors import Error
from ._run import ProgressArgument, StopArgument, Task, thread_count
from ._surface import html_table

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Fit:
    """A model fitted. `spec` is its specification; `values` and `errors` are its parameters and their standard
    errors by name ("alpha", "f0[1]"), NaN where the data do not tell or the value lies at an end of its range
    (`at_end`). `misfit` is by the metric, `chi2_per_dof` NaN where errors are not known; l1 and noise, [layer]: the
    integral of |f - f_model| cos(theta_o) as a share of the albedo, and what the errors alone would give."""

    model: str
    spec: str
    values: dict[str, float]
    errors: dict[str, float]
    at_end: tuple[str, ...]
    misfit: float
    chi2_per_dof: float
    mean_l1: float
    mean_noise: float
    max_albedo_difference: float
    theta_deg: Floats
    phi_deg: Floats
    l1: Floats
    noise: Floats

    def bsdf(self) -> Bsdf:
        """The fitted model, to evaluate, compare and render."""
        return bsdf(self.spec)

    def __getitem__(self, name: str) -> float:
        return self.values[name]

    @property
    def text(self) -> str:
        """The parameters with their errors, a line."""
        return ", ".join(f"{name} {value:.5g} ± {self.errors[name]:.2g}" if np.isfinite(self.errors[name])
                         else f"{name} {value:.5g}" for name, value in self.values.items())


@dataclass(frozen=True)
class FitReport:
    """Fits, best first, a verdict in words, and a note on what the errors do not hold, empty where they hold all: those
    of one surface are of its rays alone, and chi2_per_dof above 1 may be its speckle; `surfaces=16` has both."""

    metric: str
    fits: tuple[Fit, ...]
    verdict: str
    note: str

    @property
    def best(self) -> Fit:
        """The one that comes nearest."""
        return self.fits[0]

    def __len__(self) -> int:
        return len(self.fits)

    def __iter__(self) -> Iterator[Fit]:
        return iter(self.fits)

    def __getitem__(self, index: int) -> Fit:
        return self.fits[index]

    def _rows(self) -> list[list[str]]:
        return [[f.model, f.text, f"{f.chi2_per_dof:.4g}", f"{100 * f.mean_l1:.2f} %",
                 f"{100 * f.mean_noise:.2f} %" if f.chi2_per_dof == f.chi2_per_dof else "unknown"]
                for f in self.fits]

    _HEAD = ("model", "parameters", "chi2/dof", "L1", "noise")

    def __str__(self) -> str:
        table = [list(self._HEAD), *self._rows()]
        widths = [max(len(row[k]) for row in table) for k in range(len(self._HEAD))]
        lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in table]
        return "\n".join([*lines, self.verdict, *([self.note] if self.note else [])])

    def _repr_html_(self) -> str:
        return html_table(self._rows(), self._HEAD)


@functools.cache
def fit_keywords() -> dict[str, str]:
    """Keywords of `fit()` -> settings."""
    return {_settings.keyword_of(row["name"], row["unit"]): row["name"] for row in _core.fit_settings()}


def _fit_of(d: dict[str, Any]) -> Fit:
    params = {key if entry < 0 else f"{key}[{entry}]": (value, error, at_end)
              for key, entry, value, error, at_end in d["params"]}
    return Fit(d["model"], d["spec"], {k: p[0] for k, p in params.items()}, {k: p[1] for k, p in params.items()},
               tuple(k for k, p in params.items() if p[2]), d["misfit"], d["chi2_per_dof"], d["mean_l1"],
               d["mean_noise"], d["max_albedo_difference"], np.degrees(d["theta"]), np.degrees(d["phi"]), d["l1"],
               d["noise"])


def fit(source: Any, model: str = "all", *, progress: ProgressArgument = False, stop: StopArgument = None,
        threads: int | None = None, **settings: Any) -> FitReport:
    """Finds the parameters with which models come nearest to a measurement, a file or a BSDF.

    `model` is "all", or models between commas, keys that are given being fixed: "ggx,beckmann:alpha=0.3". Settings
    are those of the command line's fit: metric ("auto", "chi2", "l2", "log", "cube-root"), reflectance ("auto", "run",
    "f0", "ior", "conductor"), free ("alpha_y": more keys to set free), lambert (True: a
    diffuse part is added to each model, its albedo free), light ("all", or "single": what was reflected once, as
    microfacet models have it), max_theta_deg; and, for what is no measurement, the light and the cells it is
    averaged over: theta_deg, layers, resolution ... Same result for any number of threads. `progress` counts models;
    `stop` and Ctrl-C end it between two of them, with Error (ErrorCode.STOPPED) and KeyboardInterrupt.
    """
    handle = handle_of(source, "source")
    known, cells = fit_keywords(), _settings.keywords(("Light", "Detector"))
    for keyword in settings:
        if keyword not in known and keyword not in cells or keyword == "model":
            raise _settings.unknown_keyword(keyword, [*known, *cells])
    where = {k: v for k, v in settings.items() if k in cells}
    if where and isinstance(handle, _core.Measurement):
        raise Error("a measurement brings its own light and detector", place=next(iter(where)))
    texts = _settings.texts_of({"model": model, **{k: v for k, v in settings.items() if k in known}}, known)
    with Task(progress, stop) as task:
        d = _core.fit(handle, texts, _settings.texts_of(where, cells), thread_count(threads), task.callbacks)
    return FitReport(d["metric"], tuple(_fit_of(f) for f in d["fits"]), d["verdict"], d["note"])
