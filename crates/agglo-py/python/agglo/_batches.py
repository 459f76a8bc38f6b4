"""Simulations on their way to workers: short ones travel together."""

from __future__ import annotations

import math
import os
import pickle
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
    """Sends simulations to an executor: at once while workers are free, else as many at a time as fill a tenth of a second."""

    def __init__(self, executor: Executor, workers: int, function: Function | None) -> None:
        self._executor = executor
        self._workers = workers
        self._function = function
        self._lock = threading.Lock()
        self._waiting: deque[tuple[Job, Future[Outcome]]] = deque()
        # Batches that are sent, and simulations in them.
        self._under_way = 0
        self._sent = 0
        # How long a simulation takes [s], by the last ones: the very first ones wait for imports.
        self._each_s = _BATCH_S

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
                count = self._count()
                if count == 0:
                    return
                batch = [self._waiting.popleft() for _ in range(count)]
                batch = [(job, future) for job, future in batch if future.set_running_or_notify_cancel()]
                if not batch:
                    continue
                self._under_way += 1
                self._sent += len(batch)
            try:
                sent = self._executor.submit(outcomes, self._function, _packed([job for job, _ in batch]))
            except BaseException as error:  # noqa: BLE001 - those who wait for the batch raise it
                self._end(batch, error)
                continue
            sent.add_done_callback(partial(self._take, batch))

    def _count(self) -> int:
        """How many go together now; 0 if they had better wait for others."""
        waiting = len(self._waiting)
        if waiting == 0 or self._under_way >= 2 * self._workers:
            return 0
        most = max(1, round(_BATCH_S / max(self._each_s, 1e-6)))
        if self._under_way < self._workers:
            return min(most, math.ceil(waiting / self._workers))
        # All workers are busy. Those whose batch has ended ask for more one after another: they are sent when they fill a part
        # of all that are under way, two parts for each worker, and not each by itself.
        full = min(most, math.ceil((waiting + self._sent) / (2 * self._workers)))
        return full if waiting >= full else 0

    def _take(self, batch: list[tuple[Job, Future[Outcome]]], done: Future[tuple[list[Outcome], float]]) -> None:
        try:
            found, took_s = done.result()
        except BaseException as error:  # noqa: BLE001 - those who wait for the batch raise it
            self._end(batch, error)
            return
        with self._lock:
            self._under_way -= 1
            self._sent -= len(batch)
            self._each_s += 0.5 * (took_s / len(batch) - self._each_s)
        for (_, future), outcome in zip(batch, found):
            future.set_result(outcome)
        self._send()

    def _end(self, batch: list[tuple[Job, Future[Outcome]]], error: BaseException) -> None:
        with self._lock:
            self._under_way -= 1
            self._sent -= len(batch)
        for _, future in batch:
            future.set_exception(error)


def _packed(jobs: list[Job]) -> bytes:
    """Jobs as bytes, for which executors have least to do; replicates of a candidate have their text in common."""
    texts: dict[str, str] = {}
    return pickle.dumps([job._replace(text=texts.setdefault(job.text, job.text)) for job in jobs])
