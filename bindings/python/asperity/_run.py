# SPDX-License-Identifier: Apache-2.0
"""Progress and the wish to stop."""

from __future__ import annotations

import numbers
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import TextIO, Union

from . import _core
from ._errors import Error, StoppedWarning


@dataclass(frozen=True)
class Progress:
    """How far a task has come; what a function given as `progress` is called with.

    `stage` says what is being done ("tracing"), `done` of `total` how far, in rays, cells or samples;
    `total` may grow while a run refines until an error is reached. `seconds` since the stage began,
    `seconds_left` at the present rate.
    """

    stage: str
    done: int
    total: int
    seconds: float
    seconds_left: float

    @property
    def share(self) -> float:
        """done / total, 0 where nothing is known yet."""
        return self.done / self.total if self.total else 0.0


ProgressArgument = Union[bool, Callable[[Progress], None]]
StopArgument = Union[Callable[[], bool], None]


class _Bar:
    """One line that is written over, on a terminal or in a notebook."""

    WIDTH = 30

    def __init__(self, stream: TextIO) -> None:
        self._stream, self._length = stream, 0

    def __call__(self, progress: Progress) -> None:
        filled = round(self.WIDTH * min(1.0, progress.share))
        line = (f"{progress.stage} [{'#' * filled}{'.' * (self.WIDTH - filled)}] "
                f"{100 * progress.share:3.0f} % {progress.seconds:.0f} s")
        if progress.done < progress.total and progress.seconds > 1:
            line += f", {progress.seconds_left:.0f} s left"
        self._stream.write("\r" + line.ljust(self._length))
        self._stream.flush()
        self._length = len(line)

    def close(self) -> None:
        if self._length:
            self._stream.write("\r" + " " * self._length + "\r")
            self._stream.flush()


class Task:
    """The callbacks of a task, as a context: with Task(progress, stop) as task: ... task.callbacks"""

    def __init__(self, progress: ProgressArgument, stop: StopArgument) -> None:
        for name, value in (("progress", progress), ("stop", stop)):
            if not (callable(value) or value is None or (name == "progress" and isinstance(value, bool))):
                raise Error(f"{value!r} is not a function", place=name)
        self._bar = _Bar(sys.stderr) if progress is True else None
        listener = self._bar or (progress if callable(progress) else None)
        self.callbacks = _core.Callbacks(
            (lambda *p: listener(Progress(*p))) if listener else None, stop)

    def __enter__(self) -> "Task":
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar:
            self._bar.close()


class Counting:
    """Progress of what is done piece by piece, and the wish to stop it, as a context."""

    def __init__(self, stage: str, total: int, progress: ProgressArgument, stop: StopArgument) -> None:
        Task(progress, stop)  # checks them
        self._bar = _Bar(sys.stderr) if progress is True else None
        self._listener = self._bar or (progress if callable(progress) else None)
        self.stop, self._stage, self._begin = stop, stage, time.monotonic()
        self.count, self.total = 0, total

    def __enter__(self) -> "Counting":
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar:
            self._bar.close()

    def expect(self, more: int) -> None:
        self.total += more

    def done(self) -> None:
        self.count += 1
        if self._listener:
            seconds = time.monotonic() - self._begin
            left = seconds / self.count * (self.total - self.count)
            self._listener(Progress(self._stage, self.count, self.total, seconds, left))

    def wants_stop(self) -> bool:
        return self.stop is not None and bool(self.stop())


def thread_count(threads: int | None) -> int:
    """The library's number of threads: 0 stands for as many as the machine has."""
    if threads is None:
        return 0
    if isinstance(threads, bool) or not isinstance(threads, numbers.Integral) or not 1 <= threads <= 1024:
        raise Error(f"{threads!r} is not a whole number from 1 to 1024", place="threads")
    return int(threads)


def warn_stopped() -> None:
    warnings.warn("stopped by Ctrl-C: the result holds what was complete", StoppedWarning, stacklevel=3)
