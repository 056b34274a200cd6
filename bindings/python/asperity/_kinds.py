# SPDX-License-Identifier: Apache-2.0
"""A function for every kind of surface that the library knows, made from its registry."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

from . import _core, _settings
from ._run import ProgressArgument, StopArgument
from ._surface import Surface, _load

_TYPES = {"flag": "bool", "integer": "int", "natural": "int", "real": "float", "choice": "str", "text": "str",
          "list": "float | Sequence[float] | str", "pair": "float | Sequence[float]"}


def annotation_of(row: dict[str, Any]) -> str:
    """The type of a setting's keyword, as stubs write it."""
    if row["type"] == "choice":
        return "Literal[" + ", ".join(repr(c) for c in row["choices"]) + "]"
    return _TYPES[row["type"]]


def setting_lines(rows: list[dict[str, Any]]) -> list[str]:
    """What docstrings say of settings."""
    lines = []
    for row in rows:
        unit = f" [{row['unit']}]" if row["unit"] else ""
        default = row["otherwise"] or row["default"]
        lines.append(f"    {_settings.keyword_of(row['name'], row['unit'])}{unit}: {row['doc']} "
                     f"(default {default})")
    return lines


def kind_rows(kind: dict[str, Any]) -> list[dict[str, Any]]:
    """The settings that a kind uses."""
    return [_settings.table()[name] for name in kind["params"]]


def kind_doc(kind: dict[str, Any]) -> str:
    return "\n".join([f"{kind['label']}: {kind['doc']}.", "", "Settings:", *setting_lines(kind_rows(kind)), "",
                      "Same settings, same bits, for any number of threads."])


def _maker(kind: dict[str, Any]) -> Callable[..., Surface]:
    known = {_settings.keyword_of(row["name"], row["unit"]): row["name"] for row in kind_rows(kind)}

    def make(*, progress: ProgressArgument = False, stop: StopArgument = None, threads: int | None = None,
             **settings: Any) -> Surface:
        texts = _settings.texts_of(settings, known)
        return _load([("surface", kind["name"]), *texts], progress, stop, threads)

    make.__name__ = make.__qualname__ = kind["name"].replace("-", "_")
    make.__module__ = "asperity"
    make.__doc__ = kind_doc(kind)
    only = inspect.Parameter.KEYWORD_ONLY
    parameters = [inspect.Parameter(k, only, default=None) for k in known]
    parameters += [inspect.Parameter(k, only, default=d)
                   for k, d in (("progress", False), ("stop", None), ("threads", None))]
    make.__signature__ = inspect.Signature(parameters, return_annotation=Surface)  # type: ignore[attr-defined]
    return make


def makers() -> dict[str, Callable[..., Surface]]:
    """Name -> function, for every kind of the registry."""
    functions = [_maker(kind) for kind in _core.surface_kinds()]
    return {function.__name__: function for function in functions}
