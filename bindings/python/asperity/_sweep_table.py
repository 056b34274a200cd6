# SPDX-License-Identifier: Apache-2.0
"""The table of a sweep: inputs and figures, a row for each experiment, layer and channel, as CSV or Parquet."""

from __future__ import annotations

import csv
import io
import os
from typing import Any

import numpy as np

from . import _core, _jobs, _settings
from ._errors import Error
from ._jobs import Job
from ._measurement import load
from ._surface import Surface

Rows = list[dict[str, Any]]

_FIGURES = ("rms_height", "rms_gradient", "alpha_x", "alpha_y", "area_ratio")
_LENGTH = "m, or cells where no file says a length"
_UNITS = {"surface_rms_height": _LENGTH, "theta_i_deg": "degrees", "phi_i_deg": "degrees"}


def check_name(path: str) -> None:
    """A table is .csv or .parquet, and that only where pyarrow is there."""
    ending = os.path.splitext(path)[1].lower()
    if ending not in (".csv", ".parquet"):
        raise Error("the name of a table ends in .csv or .parquet", place=path)
    if ending == ".parquet":
        try:
            import pyarrow  # type: ignore[import-not-found,import-untyped,unused-ignore]  # noqa: F401
        except ImportError:
            raise Error('Parquet needs pyarrow, which is not installed: pip install "asperity[sweep]"', place=path) from None


def _plain(value: Any) -> Any:
    """A value of an experiment as a cell of the table."""
    if isinstance(value, (list, tuple, np.ndarray)):
        return "/".join(str(_plain(v)) for v in np.asarray(value).tolist())
    if isinstance(value, Surface):
        return value.name
    return value.item() if isinstance(value, np.generic) else value


def rows_of(experiments: list[dict[str, Any]], jobs: list[Job], errors: list[str]) -> Rows:
    """The rows of all experiments whose result is there; each has every column."""
    names = list(dict.fromkeys(name for e in experiments for name in e))
    rows = []
    for number, (experiment, job, error) in enumerate(zip(experiments, jobs, errors)):
        if error:
            continue
        m = load(job.file)
        inputs = {name: _plain(experiment.get(name, "")) for name in names}
        figures = {f"surface_{name}": m.surface[name] for name in _FIGURES}
        for k in range(m.layers):
            for c, channel in enumerate(m.channel_names):
                rows.append({"experiment": number, **inputs, **figures, "theta_i_deg": float(m.theta_deg[k]),
                             "phi_i_deg": float(m.phi_deg[k]), "channel": channel,
                             "albedo": float(m.albedo[k, c]), "albedo_stderr": float(m.albedo_stderr[k, c]),
                             "absorbed": float(m.absorbed[k, c]), "truncated": float(m.truncated[k, c]),
                             "rays": int(m.rays[k]), "file": os.path.basename(job.file), "checksum": m.checksum})
    return rows


def write(rows: Rows, path: str) -> None:
    """Writes the table, by the ending of the name, whole or not at all."""
    check_name(path)
    _jobs.write_whole(path, _parquet(rows) if path.lower().endswith(".parquet") else _csv(rows).encode())


def _csv(rows: Rows) -> str:
    text = io.StringIO()
    if rows:
        writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return text.getvalue()


def _column(values: list[Any]) -> list[Any]:
    """Values of one type: empty ones, of experiments without this keyword, are missing; unlike ones are texts."""
    present = [v for v in values if v != ""]
    if len({type(v) for v in present} - {int}) > 1 or (any(type(v) is int for v in present) and
                                                      any(type(v) in (str, bool) for v in present)):
        return [None if v == "" else str(v) for v in values]
    real = any(type(v) is float for v in present)
    return [None if v == "" else float(v) if real else v for v in values]


def _parquet(rows: Rows) -> bytes:
    """Columns have their types; the metadata of each has its `unit`, and `doc` where it is a setting."""
    import pyarrow as pa  # type: ignore[import-not-found,import-untyped,unused-ignore]
    import pyarrow.parquet as pq  # type: ignore[import-not-found,import-untyped,unused-ignore]

    units = {_settings.keyword_of(row["name"], row["unit"]): row for row in _settings.table().values()}
    arrays, fields = [], []
    for name in rows[0] if rows else []:
        array = pa.array(_column([row[name] for row in rows]))
        setting = units.get(name)
        said = {"unit": _UNITS.get(name, ""), "doc": ""} if setting is None else {"unit": setting["unit"], "doc": setting["doc"]}
        arrays.append(array)
        fields.append(pa.field(name, array.type, metadata={key: text for key, text in said.items() if text}))
    schema = pa.schema(fields, metadata={"asperity": _core.version})
    data = io.BytesIO()
    pq.write_table(pa.Table.from_arrays(arrays, schema=schema), data)
    return data.getvalue()
