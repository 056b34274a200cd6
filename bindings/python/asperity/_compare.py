# SPDX-License-Identifier: Apache-2.0
"""How far two BRDFs lie apart."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _settings
from ._bsdf import handle_of
from ._errors import Error
from ._run import thread_count
from ._surface import html_table

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Comparison:
    """Distances of two BRDFs, channels averaged; arrays are [layer].

    l1: integral of |fa - fb| cos(theta_o) over cell means, 0 equal, 2 apart; l1_noise: what it would be from the
    error bars alone; rms: root mean square of the same difference over the hemisphere [1/sr]. Names with _stderr are
    standard errors, from batches (docs/theory.md, "Sums of cells"): nan where a result does not hold what they come
    from, 0 between models.
    """

    name_a: str
    name_b: str
    theta_deg: Floats
    phi_deg: Floats
    albedo_a: Floats
    albedo_b: Floats
    l1: Floats
    l1_stderr: Floats
    l1_noise: Floats
    rms: Floats
    rms_stderr: Floats
    mean_l1: float
    mean_l1_stderr: float
    mean_rms: float
    mean_rms_stderr: float
    max_albedo_difference: float

    def _rows(self) -> list[list[str]]:
        columns = (self.theta_deg, self.phi_deg, self.albedo_a, self.albedo_b, self.l1, self.l1_noise, self.rms)
        return [[f"{row[0]:.4g}", f"{row[1]:.4g}", f"{row[2]:.5f}", f"{row[3]:.5f}", f"{row[4]:.4f}",
                 f"{row[5]:.4f}", f"{row[6]:.4g}"] for row in zip(*columns)]

    _HEAD = ("theta_i", "phi_i", "albedo A", "albedo B", "L1", "noise", "RMS")

    def __str__(self) -> str:
        table = [list(self._HEAD), *self._rows()]
        widths = [max(len(row[k]) for row in table) for k in range(len(self._HEAD))]
        lines = [f"A: {self.name_a}", f"B: {self.name_b}"]
        lines += ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in table]
        return "\n".join([*lines, f"mean L1 {self.mean_l1:.4f}, mean RMS {self.mean_rms:.4g} 1/sr, "
                                  f"largest albedo difference {self.max_albedo_difference:.5f}"])

    def _repr_html_(self) -> str:
        return html_table(self._rows(), self._HEAD)


def name_of(source: Any) -> str:
    """What a comparison or a legend calls a side."""
    return str(getattr(source, "surface_name", None) or getattr(source, "name", None) or
               (source if isinstance(source, str) else type(source).__name__))


def compare(a: Any, b: Any, *, threads: int | None = None, **settings: Any) -> Comparison:
    """Compares two BRDFs: measurements, BSDFs, specifications, files, or objects of yours with a vectorised
    eval(wi, wo).

    Measurements must have the same detector and light. A model beside a measurement is averaged over the same
    cells. Two models are compared over cells and incidences of the settings: theta_deg, layers, resolution ...
    """
    from ._measurement import Measurement

    sides = [handle_of(a, "a"), handle_of(b, "b")]
    measured = [isinstance(s, _core.Measurement) for s in sides]
    if any(measured) and settings:
        raise Error("a measurement brings its own light and detector; settings are for two models",
                    place=next(iter(settings)))
    texts = _settings.texts_of(settings, _settings.keywords(("Light", "Detector")))
    own = [isinstance(s, _core.OwnBsdf) for s in sides]
    if all(own):
        raise Error("of two BSDFs of your own neither is the library's: measure or export one", place="b")
    swap = (measured[1] and not measured[0]) or (own[0] and not own[1])
    if swap:
        sides.reverse()
    d = _core.compare(sides[0], sides[1], texts, thread_count(threads))
    first, second = ("albedo_b", "albedo_a") if swap else ("albedo_a", "albedo_b")
    names = (name_of(a) if isinstance(a, (str, Measurement)) else name_of(a), name_of(b))
    return Comparison(*names, np.degrees(d["theta"]), np.degrees(d["phi"]), d[first], d[second],
                      **{name: d[name] for name in ("l1", "l1_stderr", "l1_noise", "rms", "rms_stderr", "mean_l1",
                                                    "mean_l1_stderr", "mean_rms", "mean_rms_stderr",
                                                    "max_albedo_difference")})
