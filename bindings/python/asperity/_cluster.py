# SPDX-License-Identifier: Apache-2.0
"""One measurement on the workers of a Dask cluster: shares of its rays, added up here."""

from __future__ import annotations

import time
import uuid
from typing import Any

from . import _core, _settings
from ._errors import Error, ErrorCode
from ._measurement import Measurement
from ._run import Counting
from ._surface import Surface

_ASK_EVERY = 0.25  # seconds between two questions to the scheduler whether to stop


class _Wish:
    """What a share asks while it is measured: whether the others have stopped."""

    def __init__(self, name: str) -> None:
        import distributed

        event: Any = distributed.Event
        self._event, self._next = event(name), 0.0

    def __call__(self) -> bool:
        if time.monotonic() < self._next:
            return False
        self._next = time.monotonic() + _ASK_EVERY
        return bool(self._event.is_set())


def measure_share(surface: Surface, texts: _settings.SettingTexts, so_far: Measurement | None, part: int, parts: int,
                  threads: int, stop: str) -> Measurement:
    """What a worker does: the new rays of one share, perhaps none. `stop` is the name of the event that ends it."""
    callbacks = _core.Callbacks(None, _Wish(stop))
    handle, _ = _core.measure(surface._handle, texts, threads, callbacks, None if so_far is None else so_far._handle, part,
                               parts, True)
    return Measurement(handle)


class _Cluster:
    """A client, what its workers have been given to hold, and what they are asked to do."""

    def __init__(self, client: Any, surface: Surface, texts: _settings.SettingTexts, parts: int, threads: int) -> None:
        import distributed

        event: Any = distributed.Event
        self._client, self._texts, self._parts, self._threads = client, texts, parts, threads
        self._stop = event(f"asperity-stop-{uuid.uuid4().hex}", client=client)
        self._surface = self._everywhere(surface)
        self._shares: dict[int, Any] = {}

    def _everywhere(self, value: Any) -> Any:
        # Held by all of them, it outlives any of them
        return self._client.scatter(value, broadcast=True, hash=False)

    def begin(self, so_far: Measurement | None) -> None:
        """Hands the shares of a round out."""
        before = so_far and self._everywhere(so_far)
        self._shares = {k: self._client.submit(measure_share, self._surface, self._texts, before, k, self._parts,
                                               self._threads, self._stop.name, pure=False)
                        for k in range(1, self._parts + 1)}

    @property
    def busy(self) -> bool:
        return bool(self._shares)

    def arrived(self) -> dict[int, Measurement]:
        """Shares that are complete and were not given before. What a share raises is raised here."""
        from distributed.scheduler import KilledWorker

        there = [k for k, future in self._shares.items() if future.done()]
        try:
            return {k: self._shares.pop(k).result() for k in there}
        except KilledWorker as error:
            raise Error(f"its workers were killed again and again: {error}", ErrorCode.OUT_OF_MEMORY, "client") from error

    def stop(self) -> None:
        """Calls everything off; a share that is under way ends within a fraction of a second."""
        self._stop.set()
        self._client.cancel(list(self._shares.values()))


def _round(cluster: _Cluster, merge: _core.Merge, so_far: Measurement | None, told: Counting) -> tuple[bool, bool]:
    """Adds up a round; whether anything is there, and whether it was called off by Ctrl-C."""
    any_there, interrupted = so_far is not None, False
    cluster.begin(so_far)
    try:
        while cluster.busy and not told.wants_stop():
            for k, share in cluster.arrived().items():
                merge.add(share._handle, f"part {k}")
                any_there = any_there or share.layers > 0
                told.done()
            if cluster.busy:
                time.sleep(0.02)
    except KeyboardInterrupt:
        interrupted = True
    except BaseException:
        cluster.stop()
        raise
    return any_there, interrupted


def measure_on_cluster(surface: Surface, texts: _settings.SettingTexts, threads: int, client: Any, parts: int | None,
                       so_far: Measurement | None, told: Counting) -> tuple[Any, bool]:
    """The handle of the result, and whether it was interrupted by Ctrl-C. Rounds of shares until nothing is left."""
    _core.check_settings(surface._handle, texts)
    if parts is None:
        parts = max(1, 4 * sum(client.nthreads().values()))
    cluster = _Cluster(client, surface, texts, parts, threads)
    while True:
        told.expect(parts)
        merge = _core.Merge()
        if so_far is not None:
            merge.add_so_far(so_far._handle, surface._handle, texts)
        any_there, interrupted = _round(cluster, merge, so_far, told)
        if cluster.busy or interrupted:
            cluster.stop()
            if any_there:
                return merge.unfinished(), interrupted
            if interrupted:
                raise KeyboardInterrupt
            raise Error("stopped before anything was complete", ErrorCode.STOPPED)
        handle, complete = merge.finish()
        if complete:
            return handle, False
        so_far = Measurement(handle)
