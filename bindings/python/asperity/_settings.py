# SPDX-License-Identifier: Apache-2.0
"""Keywords made from the library's tables of settings, and their values as text."""

from __future__ import annotations

import functools
import numbers
from collections.abc import Iterable, Mapping
from typing import Any

from . import _core
from ._errors import Error

SettingTexts = list[tuple[str, str]]


@functools.cache
def table() -> dict[str, dict[str, Any]]:
    """Every setting of an experiment by its name in files, in the order in which they are read."""
    return {row["name"]: row for row in _core.settings()}


def keyword_of(name: str, unit: str) -> str:
    """The keyword of a setting: "correlation-length" -> correlation_length; angles say their unit."""
    keyword = name.replace("-", "_")
    return f"{keyword}_deg" if unit == "degrees" else keyword


@functools.cache
def keywords(groups: tuple[str, ...]) -> dict[str, str]:
    """Keyword -> name of the setting, for the settings of these groups."""
    return {keyword_of(row["name"], row["unit"]): name for name, row in table().items()
            if row["group"] in groups and name != "surface"}


MEASURE_GROUPS = ("Light", "Optics", "Rays", "Detector")


def unknown_keyword(name: str, known: Iterable[str]) -> Error:
    """The error for a keyword that there is none of, with the one that was meant."""
    import difflib

    names = sorted(known)
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.7)
    near = near or [other for other in names if name in other.split("_")]
    near = near or difflib.get_close_matches(name, names, n=1)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    return Error(f"there is no such keyword{hint}", place=name)


def number_text(value: Any, keyword: str) -> str:
    """A number so that the library reads the same bits."""
    if isinstance(value, numbers.Integral):
        return str(int(value))
    try:
        return repr(float(value))
    except (TypeError, ValueError):
        raise Error(f"{value!r} is not a number", place=keyword) from None


def value_text(value: Any, keyword: str) -> str:
    """The text of a value as files and the command line have it."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool) or type(value).__name__ == "bool_" or type(value).__name__ == "bool":
        return "true" if value else "false"
    if isinstance(value, numbers.Number) or getattr(value, "ndim", None) == 0:
        return number_text(value, keyword)
    if isinstance(value, Mapping) or not isinstance(value, Iterable):
        raise Error(f"{value!r} is neither a number nor a text nor a list of numbers", place=keyword)
    entries = list(value)
    if not entries:
        raise Error("the list is empty", place=keyword)
    return ",".join(e if isinstance(e, str) else number_text(e, keyword) for e in entries)


def texts_of(given: Mapping[str, Any], known: Mapping[str, str]) -> SettingTexts:
    """Settings and texts of the keywords that were given, in the order of the table. None: not given."""
    for keyword in given:
        if keyword not in known:
            raise unknown_keyword(keyword, known)
    return [(name, value_text(given[keyword], keyword)) for keyword, name in known.items()
            if given.get(keyword) is not None]
