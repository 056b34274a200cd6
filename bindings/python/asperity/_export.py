# SPDX-License-Identifier: Apache-2.0
"""Files for other programs, and how well they hold what they were made of."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._run import StopArgument, Task, thread_count
from ._settings import value_text


@dataclass(frozen=True)
class Fidelity:
    """The file read back as its format's own readers do, against its source, cell by cell, below 85 degrees.

    Per layer: theta_deg, phi_deg, l1 (the integral of |f - f_file| cos(theta_o) as a share of the albedo).
    mean_noise is what l1 would be from the error bars alone, mean_l1_isotropic what no isotropic file can fall
    below (None: the format has azimuths), max_albedo_difference the largest of file - source.
    """

    theta_deg: npt.NDArray[np.float64]
    phi_deg: npt.NDArray[np.float64]
    l1: npt.NDArray[np.float64]
    mean_l1: float
    worst_l1: float
    worst_theta_deg: float
    mean_noise: float
    mean_l1_isotropic: float | None
    max_albedo_difference: float
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Export:
    """What was written: `path`, `format`, `remarks` (what the format could not hold, a sentence each) and the
    `fidelity`, None where the format cannot be read back."""

    path: str
    format: str
    remarks: tuple[str, ...]
    fidelity: Fidelity | None

    def __str__(self) -> str:
        lines = [f"wrote {self.path} ({self.format})"]
        lines += [str(self.fidelity)] if self.fidelity else []
        return "\n".join(lines + [f"  {remark}" for remark in self.remarks])


def export(handle: Any, path: "str | os.PathLike[str]", format: str | None, threads: int | None,
           stop: StopArgument, options: dict[str, Any]) -> Export:
    text = ",".join(f"{key}={value_text(value, key)}" for key, value in options.items() if value is not None)
    name = os.fspath(path)
    with Task(False, stop) as task:
        d = _core.export_bsdf(handle, [], name, format or "", text, thread_count(threads), task.callbacks)
    f = d["fidelity"]
    fidelity = f and Fidelity(
        np.degrees(f["theta"]), np.degrees(f["phi"]), np.asarray(f["l1"]), f["mean_l1"], f["worst_l1"],
        float(np.degrees(f["worst_theta"])), f["mean_noise"], f["mean_l1_isotropic"],
        f["max_albedo_difference"], f["text"])
    return Export(name, d["format"], tuple(d["remarks"]), fidelity or None)
