# SPDX-License-Identifier: Apache-2.0
"""What the library knows, to look things up."""

from __future__ import annotations

from typing import Any

from . import _core, _settings


def settings() -> dict[str, dict[str, Any]]:
    """Every setting of an experiment, by keyword: what it does (`doc`), `unit`, `default`, `choices`, `group`."""
    return {_settings.keyword_of(row["name"], row["unit"]): dict(row) for row in _settings.table().values()}


def surface_kinds() -> dict[str, str]:
    """Kinds of surface: each is a function of this package, and what it makes."""
    return {kind["name"]: kind["doc"] for kind in _core.surface_kinds()}


def bsdf_models() -> dict[str, dict[str, str]]:
    """Analytic models for `bsdf()`: name -> parameter -> what it is, with its default."""
    return {model["name"]: {p["name"]: f"{p['doc']} (default {p['default']})" for p in model["params"]}
            for model in _core.bsdf_models()}


def bsdf_formats() -> dict[str, dict[str, Any]]:
    """Formats of `Measurement.export()` and `bsdf()`: endings, what they hold, options."""
    return {row["name"]: row for row in _core.bsdf_formats()}


def heights_formats() -> dict[str, dict[str, Any]]:
    """Formats of `read()`: endings, whose they are."""
    return {row["name"]: row for row in _core.heights_formats()}


def materials() -> dict[str, str]:
    """Metals of a measured index: symbol -> name."""
    return dict(_core.materials())


def scene_models() -> dict[str, str]:
    """Models that `render()` shows without a file."""
    return dict(_core.scene_models())
