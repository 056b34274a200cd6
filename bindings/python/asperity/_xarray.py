# SPDX-License-Identifier: Apache-2.0
"""Measurements as xarray Datasets."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ._measurement import Measurement

_DEGREES = {"units": "degrees"}


def _incidence(m: "Measurement") -> tuple[tuple[str, ...], tuple[int, ...], dict[str, Any]]:
    """Names and lengths of the axes that the layers make, and their coordinates: theta_i x phi_i where every
    pair was measured, else one axis of layers."""
    thetas, phis = np.unique(m.theta_deg), np.unique(m.phi_deg)
    order = np.lexsort((m.phi_deg, m.theta_deg))
    full = m.layers == thetas.size * phis.size and np.array_equal(order, np.arange(m.layers))
    names = {"theta_i": "polar angle the light comes from", "phi_i": "azimuth the light comes from"}
    if full and m.layers:
        values = {"theta_i": thetas, "phi_i": phis}
        return ("theta_i", "phi_i"), (thetas.size, phis.size), {
            name: (name, values[name], {**_DEGREES, "long_name": names[name]}) for name in values}
    return ("layer",), (m.layers,), {
        name: ("layer", values, {**_DEGREES, "long_name": names[name]})
        for name, values in (("theta_i", m.theta_deg), ("phi_i", m.phi_deg))}


def to_xarray(m: "Measurement") -> Any:
    """See Measurement.to_xarray()."""
    import xarray  # type: ignore[import-not-found,unused-ignore]

    axes, lengths, coordinates = _incidence(m)
    theta, phi = m.theta_edges_deg, m.phi_edges_deg
    coordinates["theta_o"] = ("theta_o", (theta[1:] + theta[:-1]) / 2,
                              {**_DEGREES, "long_name": "outgoing polar angle, middle of the cell"})
    coordinates["phi_o"] = ("phi_o", (phi[1:] + phi[:-1]) / 2,
                            {**_DEGREES, "long_name": "outgoing azimuth, middle of the cell"})
    coordinates["channel"] = ("channel", m.channel_names)
    wavelengths = [re.fullmatch(r"([0-9.]+) ?nm", name) for name in m.channel_names]
    if all(wavelengths):
        coordinates["wavelength"] = ("channel", [float(w.group(1)) for w in wavelengths if w], {"units": "nm"})
    coordinates["order"] = ("order", np.arange(1, m.brdf_by_order.shape[1] + 1),
                            {"long_name": "reflections, the last one holds all higher ones"})
    coordinates["bounce"] = ("bounce", np.arange(1, m.albedo_by_bounce.shape[2] + 1), {"long_name": "reflections"})
    coordinates["projected_solid_angle"] = ("theta_o", m.projected_solid_angle,
                                            {"units": "sr", "long_name": "of a cell of the row"})

    def variable(values: Any, rest: tuple[str, ...], name: str, units: str = "1") -> Any:
        return ((*axes, *rest), values.reshape(*lengths, *values.shape[1:]), {"units": units, "long_name": name})

    cells = ("channel", "theta_o", "phi_o")
    per_sr = "sr-1"
    return xarray.Dataset({
        "brdf": variable(m.brdf, cells, "BRDF, the cosine-weighted mean over the cell", per_sr),
        "stderr": variable(m.stderr, cells, "standard error of brdf", per_sr),
        "brdf_by_order": variable(m.brdf_by_order, ("order", *cells), "BRDF by number of reflections", per_sr),
        "albedo": variable(m.albedo, ("channel",), "directional albedo"),
        "albedo_stderr": variable(m.albedo_stderr, ("channel",), "standard error of albedo"),
        "albedo_by_bounce": variable(m.albedo_by_bounce, ("channel", "bounce"), "albedo by number of reflections"),
        "albedo_by_bounce_stderr": variable(m.albedo_by_bounce_stderr, ("channel", "bounce"),
                                            "standard error of albedo_by_bounce"),
        "absorbed": variable(m.absorbed, ("channel",), "share of the light absorbed"),
        "rays": variable(m.rays.astype(np.int64), (), "rays launched"),
    }, coords=coordinates, attrs={
        "surface": m.surface_name, "checksum": m.checksum, "asperity_version": m.version,
        "isotropic": int(m.isotropic), "notes": "; ".join(m.notes),
        "experiment": "\n".join(f"{key} = {value}" for key, value in m.experiment.items())})
