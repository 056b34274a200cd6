# SPDX-License-Identifier: Apache-2.0
"""make_api_page.py: prints docs/python-api.md from the docstrings of the installed package.

python -P bindings/python/make_api_page.py > docs/python-api.md"""

from __future__ import annotations

import inspect
import re
from typing import Any

import asperity
import asperity.plot

GROUPS = {
    "Surfaces": ["surface", "read", "from_array", "Surface"],
    "Measuring": ["measure", "merge", "load", "Measurement", "Progress"],
    "BSDFs": ["bsdf", "Bsdf", "OwnBsdf", "compare", "Comparison", "fit", "Fit", "FitReport"],
    "Other programs, pictures": ["Export", "Fidelity", "render", "light", "tonemap"],
    "Sweeps": ["sweep", "Sweep"],
    "What there is": ["settings", "surface_kinds", "bsdf_models", "bsdf_formats", "heights_formats", "materials",
                      "scene_models"],
    "Errors": ["Error", "ErrorCode", "StoppedWarning"],
}
HEAD = """# The Python package, name by name

Made from the docstrings by `bindings/python/make_api_page.py`; [python.md](python.md) tells how it goes together. Beside
these names there is a function for each kind of surface, such as `asperity.gaussian(alpha=0.3, size=256)`, with the settings
of that kind as keywords: [reference.md](reference.md) lists kinds and settings.
"""


def signature(name: str, function: Any) -> str:
    text = str(inspect.signature(function)).replace('"', "'")
    text = re.sub(r"(: |-> )'([^=]*?)'(?=[,)= ]|$)", r"\1\2", text).replace("''", "'")
    text = re.sub(r"'?Unpack\[\w+\]'?", "settings", text)
    text = re.sub(r"\(self(, )?", "(", text)
    text = text.replace("npt.NDArray[np.float64]", "Array").replace("npt.", "")
    return f"{name}{text}"


def paragraphs(doc: str | None) -> str:
    text = inspect.cleandoc(doc or "")
    return text.replace("_i ", r"\_i ").replace("_o ", r"\_o ").replace("theta_", r"theta\_").replace("phi_", r"phi\_")


def member(name: str, value: Any) -> list[str]:
    if inspect.isfunction(value):
        return [f"- `{signature(name, value)}`", *indented(value.__doc__)]
    inner = getattr(value, "func", None) or getattr(value, "fget", None)
    return [f"- `{name}`", *indented(value.__doc__ or getattr(inner, "__doc__", None))]


def indented(doc: str | None) -> list[str]:
    return ["  " + line if line else "" for line in paragraphs(doc).splitlines()]


def entry(prefix: str, name: str, value: Any) -> list[str]:
    if not inspect.isclass(value):
        return [f"### `{prefix}{signature(name, value)}`", "", paragraphs(value.__doc__), ""]
    lines = [f"### `{prefix}{name}`", "", paragraphs(value.__doc__), ""]
    for key, inner in vars(value).items():
        if key.startswith("_") or not getattr(inner, "__doc__", None) or inspect.isclass(inner):
            continue
        if inspect.isfunction(inner) or isinstance(inner, property) or hasattr(inner, "func"):
            lines += member(key, inner)
    return [*lines, ""]


def main() -> None:
    lines = [HEAD]
    for title, names in GROUPS.items():
        lines += [f"## {title}", ""]
        for name in names:
            lines += entry("asperity.", name, getattr(asperity, name))
    lines += ["## Plots", ""]
    for name in ("lobe", "hemisphere", "albedo", "surface", "normals", "curves", "style", "use_style"):
        lines += entry("asperity.plot.", name, getattr(asperity.plot, name))
    print("\n".join(line.rstrip() for line in "\n".join(lines).split("\n")).rstrip())


main()
