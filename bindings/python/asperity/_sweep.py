# SPDX-License-Identifier: Apache-2.0
"""Many experiments: a result file each, and a table of them all."""

from __future__ import annotations

import itertools
import os
import queue
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Union

import numpy as np

from . import _jobs, _sweep_table
from ._errors import Error, ErrorCode
from ._jobs import Job
from ._measurement import Measurement, load
from ._run import Counting, ProgressArgument, StopArgument
from ._surface import PathArgument, html_table

Experiments = Union[Mapping[str, Any], Sequence[Mapping[str, Any]]]


@dataclass
class Sweep:
    """What came of a sweep. `experiments`, `files` and `errors` go together: an error is empty where the result
    is there."""

    experiments: list[dict[str, Any]]
    files: list[str]
    errors: list[str]
    table_file: str
    _rows: list[dict[str, Any]] = field(default_factory=list, repr=False)

    def __len__(self) -> int:
        return len(self.experiments)

    def __getitem__(self, index: int) -> Measurement:
        return load(self.files[index])

    def __iter__(self) -> Iterator[Measurement]:
        return (load(file) for file, error in zip(self.files, self.errors) if not error)

    @property
    def table(self) -> dict[str, list[Any]]:
        """Inputs and figures by column, a row for each experiment, layer and channel, as in the CSV file;
        pandas.DataFrame(sweep.table) takes it."""
        names = list(self._rows[0]) if self._rows else []
        return {name: [row[name] for row in self._rows] for name in names}

    def save_table(self, path: PathArgument) -> None:
        """Writes the table once more: .csv, or .parquet, which needs pyarrow (the extra [sweep]) and has types, units
        and, where an experiment has no such keyword, missing values."""
        _sweep_table.write(self._rows, os.fspath(path))

    def __repr__(self) -> str:
        wrong = sum(1 for e in self.errors if e)
        return f"<asperity.Sweep of {len(self)} experiments{f', {wrong} failed' if wrong else ''}, {self.table_file!r}>"

    def _repr_html_(self) -> str:
        names = list(self._rows[0]) if self._rows else []
        rows = [[f"{v:.6g}" if isinstance(v, float) else str(v) for v in row.values()] for row in self._rows[:20]]
        return html_table(rows, names)


def expand(experiments: Experiments) -> list[dict[str, Any]]:
    """A list of experiments as it is; of a dict every combination of its lists, the last one fastest."""
    if not isinstance(experiments, Mapping):
        return [dict(e) for e in experiments]
    axes = [list(v) if isinstance(v, (list, tuple, range, np.ndarray)) else [v] for v in experiments.values()]
    for name, axis in zip(experiments, axes):
        if not axis:
            raise Error("the list is empty", place=name)
    return [dict(zip(experiments, values)) for values in itertools.product(*axes)]


def plan(experiments: Experiments, folder: str) -> tuple[list[dict[str, Any]], list[Job]]:
    """The experiments and their jobs; every one is checked before the first one is measured."""
    listed = expand(experiments)
    os.makedirs(folder, exist_ok=True)
    jobs = []
    for number, experiment in enumerate(listed):
        try:
            jobs.append(_jobs.job_of(experiment, folder))
        except Error as error:
            raise Error(str(error), error.code, f"experiment {number}") from None
    return listed, jobs


def sweep(experiments: Experiments, folder: PathArgument, *, processes: int = 1, threads: int | None = None,
          client: Any = None, part: str | None = None, progress: ProgressArgument = False,
          stop: StopArgument = None, on_error: str = "raise", table: str = "sweep.csv") -> Sweep:
    """Measures many experiments into `folder`: one result file for each, and a table of all.

    `experiments` is a list of dicts of keywords, or one dict, of which every list is an axis and every combination
    is measured: {"surface": "gaussian", "alpha": [0.1, 0.2], "theta_deg": [[0, 30, 60]]} is two experiments, each
    with three angles. Keywords are those of `measure()` and of the surface; "surface" is a kind, a file or a
    `Surface`. All are checked before the first is measured.

    A file is named by a digest of its experiment and appears whole or not at all. An experiment whose right result
    is there is not measured again: a sweep that was stopped, or killed, goes on where it was, and ends with the same
    files and the same table. The bits do not depend on who measures: this process, `processes` of them, each with
    `threads` (all of the machine's, shared evenly, where not given), or the workers of a Dask `client`, which
    must see the same folder. part="3/32" measures every 32nd experiment from the third on, for arrays of jobs (see
    `asperity sweep --help`), and writes no table: the whole sweep, once all parts are there, does.

    `table` is its name in the folder: "sweep.csv", or for instance "sweep.parquet", which needs pyarrow (the extra
    [sweep]); columns of Parquet have their types, and in their metadata unit and meaning.

    `progress` counts experiments. What fails does not keep the others from being measured; at the end the first
    error is raised, or with on_error="keep" told in `Sweep.errors`. Stopped by Ctrl-C it raises KeyboardInterrupt,
    by `stop` it raises Error (ErrorCode.STOPPED).
    """
    if on_error not in ("raise", "keep"):
        raise Error(f"{on_error!r} is none of raise, keep", place="on_error")
    if isinstance(processes, bool) or not isinstance(processes, int) or processes < 1:
        raise Error(f"{processes!r} is not a whole number from 1", place="processes")
    place = os.path.abspath(os.fspath(folder))
    table_file = os.path.join(place, table)
    _sweep_table.check_name(table_file)
    listed, jobs = plan(experiments, place)
    if part is not None:
        chosen = _part(part, len(jobs))
        listed, jobs = [listed[k] for k in chosen], [jobs[k] for k in chosen]
    unique = list({job.file: job for job in jobs}.values())
    with Counting("experiments", len(unique), progress, stop) as told:
        if client is not None:
            wrong = _on_dask(client, unique, threads or 1, told)
        else:
            share = threads or max(1, (os.cpu_count() or 1) // processes)
            wrong = _here(unique, share, told) if processes == 1 else _in_processes(unique, processes, share, told)
    errors = [wrong.get(job.file, "") for job in jobs]
    result = Sweep(listed, [job.file for job in jobs], errors, table_file)
    if part is None:
        result._rows = _sweep_table.rows_of(listed, jobs, errors)
        result.save_table(table_file)
    failed = [(k, e) for k, e in enumerate(errors) if e]
    if failed and on_error == "raise":
        raise Error(f"{len(failed)} of {len(jobs)} failed, the first: {failed[0][1]}", ErrorCode.INVALID_INPUT,
                    f"experiment {failed[0][0]}")
    return result


def _part(part: str, count: int) -> range:
    number, slash, parts = part.partition("/")
    if not (slash and number.isdigit() and parts.isdigit() and 1 <= int(number) <= int(parts)):
        raise Error(f"{part!r} is not K/N with 1 <= K <= N", place="part")
    return range(int(number) - 1, count, int(parts))


def _stopped(told: Counting) -> Error:
    return Error(f"stopped after {told.count} of {told.total} experiments; their results are kept", ErrorCode.STOPPED)


def _here(jobs: list[Job], threads: int, told: Counting) -> dict[str, str]:
    wrong = {}
    for job in jobs:
        try:
            if told.wants_stop() or not _jobs.run_job(job, threads, told.stop):
                raise _stopped(told)
        except Error as error:
            if error.code == ErrorCode.STOPPED:
                raise
            wrong[job.file] = str(error)
        told.done()
    return wrong


def _in_processes(jobs: list[Job], processes: int, threads: int, told: Counting) -> dict[str, str]:
    """Each worker is a process with a thread here that feeds it."""
    waiting: "queue.SimpleQueue[Job]" = queue.SimpleQueue()
    for job in jobs:
        waiting.put(job)
    answers: "queue.SimpleQueue[tuple[Job, str | None]]" = queue.SimpleQueue()
    workers = [subprocess.Popen([sys.executable, "-m", "asperity._worker", str(threads)], text=True,
                                stdin=subprocess.PIPE, stdout=subprocess.PIPE)
               for _ in range(min(processes, len(jobs)))]

    def feed(worker: "subprocess.Popen[str]") -> None:
        assert worker.stdin and worker.stdout
        while not waiting.empty():
            try:
                job = waiting.get_nowait()
            except queue.Empty:
                return
            try:
                worker.stdin.write(job.to_json() + "\n")
                worker.stdin.flush()
                line = worker.stdout.readline()
            except (OSError, ValueError):
                line = ""
            answers.put((job, line.rstrip("\n") if line else None))
            if not line:
                return

    feeders = [threading.Thread(target=feed, args=(worker,), daemon=True) for worker in workers]
    wrong: dict[str, str] = {}
    lost: list[Job] = []
    try:
        for feeder in feeders:
            feeder.start()
        done = 0
        while done < len(jobs):
            if told.wants_stop():
                raise _stopped(told)
            try:
                job, answer = answers.get(timeout=0.1)
            except queue.Empty:
                if not any(feeder.is_alive() for feeder in feeders) and answers.empty():
                    break
                continue
            done += 1
            if answer is None:
                lost.append(job)
                continue
            if answer:
                wrong[job.file] = answer
            told.done()
    finally:
        while not waiting.empty():  # feeders find nothing more to do
            try:
                lost.append(waiting.get_nowait())
            except queue.Empty:
                break
        _dismiss(workers)
    # A worker that died, out of memory or killed, must not take the sweep with it
    for job in lost:
        wrong.update(_here([job], threads, told))
    return wrong


def _dismiss(workers: "list[subprocess.Popen[str]]") -> None:
    """Closing its input ends a worker; within a second, or it is killed."""
    for worker in workers:
        if worker.stdin:
            try:
                worker.stdin.close()
            except OSError:
                pass
    for worker in workers:
        try:
            worker.wait(timeout=5)
        except subprocess.TimeoutExpired:
            worker.kill()
            worker.wait()
        if worker.stdout:
            worker.stdout.close()


def _dask_job(text: str, threads: int) -> str:
    try:
        _jobs.run_job(Job.from_json(text), threads)
        return ""
    except Error as error:
        return str(error)


def _on_dask(client: Any, jobs: list[Job], threads: int, told: Counting) -> dict[str, str]:
    from distributed.scheduler import KilledWorker

    futures = client.map(_dask_job, [job.to_json() for job in jobs], threads=threads, pure=False)
    wrong: dict[str, str] = {}
    try:
        for job, future in zip(jobs, futures):
            while not future.done():
                if told.wants_stop():
                    raise _stopped(told)
                time.sleep(0.02)
            try:
                answer = future.result()
            except KilledWorker as error:
                answer = str(error)
            if answer:
                wrong[job.file] = answer
            told.done()
    except BaseException:
        client.cancel(futures)
        raise
    return wrong
