"""Simulations on their way to workers: short ones travel together."""

from __future__ import annotations

import math
import os
import threading
from collections import deque
from concurrent.futures import Executor, Future
from functools import partial
from pathlib import Path
from typing import Union

from agglo._replicate import Function, Job, outcomes

Outcome = Union[list[float], str]

# A batch is to take so long [s]: what a cluster does to bring it there and back, some milliseconds, is small beside that.
_BATCH_S = 0.1


class Batches:
    """Sends simulations to an executor: one by one while workers are free, else as many at a time as fill a tenth of a second."""

    def __init__(self, executor: Executor, workers: int, function: Function | None) -> None:
        self._executor = executor
        self._workers = workers
        self._function = function
        self._lock = threading.Lock()
        self._waiting: deque[tuple[Job, Future[Outcome]]] = deque()
        self._under_way = 0
        # Simulations that ended, and the time that they took [s].
        self._ended = 0
        self._took_s = 0.0

    def submit(self, text: str, base: Path, seed: int, columns: list[str]) -> Future[Outcome]:
        """What will come of a simulation."""
        future: Future[Outcome] = Future()
        with self._lock:
            self._waiting.append((Job(text, os.path.abspath(base), seed, tuple(columns)), future))
        self._send()
        return future

    def _send(self) -> None:
        """Sends what waits, as long as workers have less than two batches each."""
        while True:
            with self._lock:
                if not self._waiting or self._under_way >= 2 * self._workers:
                    return
                batch = [self._waiting.popleft() for _ in range(self._count())]
                batch = [(job, future) for job, future in batch if future.set_running_or_notify_cancel()]
                if not batch:
                    continue
                self._under_way += 1
            try:
                sent = self._executor.submit(outcomes, self._function, [job for job, _ in batch])
            except BaseException as error:  # noqa: BLE001 - those who wait for the batch raise it
                self._end(batch, error)
                continue
            sent.add_done_callback(partial(self._take, batch))

    def _count(self) -> int:
        """How many go together now."""
        mean_s = self._took_s / self._ended if self._ended else _BATCH_S
        fair = math.ceil(len(self._waiting) / self._workers)
        return max(1, min(fair, int(_BATCH_S / max(mean_s, 1e-6))))

    def _take(self, batch: list[tuple[Job, Future[Outcome]]], done: Future[tuple[list[Outcome], float]]) -> None:
        try:
            found, took_s = done.result()
        except BaseException as error:  # noqa: BLE001 - those who wait for the batch raise it
            self._end(batch, error)
            return
        with self._lock:
            self._under_way -= 1
            self._ended += len(batch)
            self._took_s += took_s
        for (_, future), outcome in zip(batch, found):
            future.set_result(outcome)
        self._send()

    def _end(self, batch: list[tuple[Job, Future[Outcome]]], error: BaseException) -> None:
        with self._lock:
            self._under_way -= 1
        for _, future in batch:
            future.set_exception(error)
