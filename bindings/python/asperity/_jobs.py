# SPDX-License-Identifier: Apache-2.0
"""Experiments as values that can be sent elsewhere, named by what they are."""

from __future__ import annotations

import hashlib
import json
import os
import pickle
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from . import _core, _settings
from ._errors import Error, ErrorCode
from ._measurement import Measurement, load, measure_keywords
from ._run import StopArgument, Task
from ._surface import Surface


@dataclass(frozen=True)
class Job:
    """An experiment: settings of the surface and of the measurement as texts, the file of its result, and,
    for a surface that is an array, the file that holds it. `text` says all of it; equal experiments have equal
    texts, and the name of the file is a digest of it."""

    surface: _settings.SettingTexts
    settings: _settings.SettingTexts
    text: str
    file: str
    array: str | None = None

    def to_json(self) -> str:
        return json.dumps(asdict(self))

    @staticmethod
    def from_json(text: str) -> "Job":
        d = json.loads(text)
        return Job([tuple(p) for p in d["surface"]], [tuple(p) for p in d["settings"]], d["text"], d["file"],
                   d["array"])


def _sha(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _content_of_file(spec: str) -> str:
    """A digest of the file that a surface is read from; nothing for a kind that is made."""
    path = spec.removeprefix("file:")
    if spec.split(":")[0] in {k["name"] for k in _core.surface_kinds()} or not os.path.isfile(path):
        return ""
    with open(path, "rb") as file:
        return f"content = {hashlib.file_digest(file, 'sha256').hexdigest()}\n"


def job_of(experiment: Mapping[str, Any], folder: str) -> Job:
    """Checks an experiment and names it. Keywords are those of `measure()` and of the surface; "surface" is a
    kind, a file or a Surface."""
    given = dict(experiment)
    surface = given.pop("surface", None)
    if surface is None:
        raise Error("an experiment needs a surface: a kind, a file or a Surface", place="surface")
    surface_keywords, measure_known = _settings.keywords(("Surface",)), measure_keywords()
    for keyword in given:
        if keyword not in surface_keywords and keyword not in measure_known:
            raise _settings.unknown_keyword(keyword, [*surface_keywords, *measure_known, "surface"])
    made = {k: v for k, v in given.items() if k in surface_keywords}
    settings = _settings.texts_of({k: v for k, v in given.items() if k in measure_known}, measure_known)
    array, content = None, ""
    if isinstance(surface, Surface):
        if made:
            raise Error("the surface is there already: this setting has no effect", place=next(iter(made)))
        digest = _sha(np.ascontiguousarray(surface.heights).tobytes() + repr((surface.spacing, surface.unit,
                      surface.periodic, surface.isotropic)).encode())
        content = f"content = {digest}\n"
        texts: _settings.SettingTexts = [("surface", f"file:{surface.name}")]
        array = os.path.join(folder, "surfaces", f"{digest[:32]}.pickle")
        if not os.path.exists(array):
            os.makedirs(os.path.dirname(array), exist_ok=True)
            write_whole(array, pickle.dumps(surface))
    else:
        spec = os.fspath(surface)
        texts = [("surface", spec), *_settings.texts_of(made, surface_keywords)]
        content = _content_of_file(spec)
    text = _core.experiment_text(texts, settings) + content
    return Job(texts, settings, text, os.path.join(folder, f"{_sha(text.encode())[:32]}.asperity"), array)


def write_whole(path: str, data: bytes) -> None:
    """Writes a file whole or not at all."""
    temporary = f"{path}.{os.getpid()}.part"
    try:
        with open(temporary, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except BaseException:
        if os.path.exists(temporary):
            os.unlink(temporary)
        raise


def result_of(job: Job) -> Measurement | None:
    """The result that is there already; None for none, a damaged one, or one of another experiment."""
    if not os.path.exists(job.file):
        return None
    try:
        m = load(job.file)
    except Error:
        return None
    return m if not m.stopped and _same_experiment(job, m) else None


def _same_experiment(job: Job, m: Measurement) -> bool:
    """All but the number of rays where nobody said it: that goes by the size of the surface."""
    there = dict(line.split(" = ", 1) for line in m._handle.experiment_text.splitlines() if " = " in line)
    wanted = dict(line.split(" = ", 1) for line in job.text.splitlines() if " = " in line)
    wanted.pop("content", None)
    for name in ("jitter", "surfaces"):
        if wanted.get(name) == "auto":
            wanted[name] = there.get(name, "")
    return there == wanted


def run_job(job: Job, threads: int = 1, stop: StopArgument = None) -> bool:
    """Measures an experiment and saves it, unless its result is there. False when it was stopped: nothing is
    saved then. What is in the file depends on the experiment alone."""
    if result_of(job) is not None:
        return True
    with Task(False, stop) as task:
        if job.array:
            with open(job.array, "rb") as file:
                handle = pickle.load(file)._handle
        else:
            handle = _core.load_surface(job.surface, threads, task.callbacks)
        result, interrupted = _core.measure(handle, job.settings, threads, task.callbacks)
    if interrupted:
        raise KeyboardInterrupt
    if result.stopped:
        return False
    _save(result, job)
    return True


def _save(result: _core.Measurement, job: Job) -> None:
    """Another process, one whose sweep was killed, may be at the same experiment still: it takes the other's
    unfinished file for a remainder. Its result would be the same; what counts is that there is one."""
    for attempt in range(3):
        try:
            result.save(job.file)
            return
        except Error as error:
            if result_of(job) is not None:
                return
            if error.code != ErrorCode.INPUT_OUTPUT or attempt == 2:
                raise
