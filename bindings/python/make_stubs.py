# SPDX-License-Identifier: Apache-2.0
"""make_stubs.py MADE CORE: writes the stub of asperity._made, from the library's tables, and finishes that of _core.

_made has a function for every kind of surface, and the keywords of measure() and read() with their types. What stubgen
writes of _core has containers without the types of what they hold, which strict type checkers refuse."""

from __future__ import annotations

import re
import sys
from typing import Any

from asperity import _core, _kinds, _settings
from asperity._measurement import measure_keywords
from asperity._surface import file_keywords

HEAD = '''# Made by the build from the library's tables.
from collections.abc import Sequence
from typing import Any, Literal, TypedDict

from ._run import ProgressArgument, StopArgument
from ._surface import Surface
'''


def function(kind: dict[str, Any]) -> str:
    lines = [f"def {kind['name'].replace('-', '_')}(", "    *,"]
    for row in _kinds.kind_rows(kind):
        keyword = _settings.keyword_of(row["name"], row["unit"])
        lines.append(f"    {keyword}: {_kinds.annotation_of(row)} | None = ...,")
    lines += ["    progress: ProgressArgument = ...,", "    stop: StopArgument = ...,",
              "    threads: int | None = ...,", ") -> Surface:", '    """' + _kinds.kind_doc(kind), '    """', ""]
    return "\n".join(lines)


def keywords(name: str, doc: str, known: dict[str, str]) -> str:
    lines = [f"class {name}(TypedDict, total=False):", f'    """{doc}"""', ""]
    for keyword, setting in known.items():
        row = _settings.table()[setting]
        lines += [f"    {keyword}: {_kinds.annotation_of(row)} | None", f'    """{row["doc"]}"""']
    return "\n".join([*lines, ""])


def main() -> None:
    every = _settings.keywords(("Surface",))
    names = [kind["name"].replace("-", "_") for kind in _core.surface_kinds()]
    parts = [HEAD, f"__all__ = {names!r}", *(function(kind) for kind in _core.surface_kinds()),
             keywords("MeasureSettings", "Keywords of measure().", measure_keywords()),
             keywords("FileSettings", "Keywords of read().", file_keywords()),
             keywords("SurfaceSettings", "Keywords of surface().", every)]
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write("\n\n".join(parts))
    with open(sys.argv[2], encoding="utf-8") as file:
        core = file.read()
    for bare, whole in (("dict", "dict[str, Any]"), ("list", "list[Any]"), ("tuple", "tuple[Any, ...]")):
        core = re.sub(rf"-> {bare}:", f"-> {whole}:", core)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write("from typing import Any\n" + core)


main()
