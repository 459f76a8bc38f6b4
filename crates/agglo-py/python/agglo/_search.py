"""Searches and studies: the program's own, and those that are led from here or run elsewhere."""

from __future__ import annotations

import os
import queue
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, Future
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from agglo import _agglo, _html, _search_plots
from agglo._agglo import Campaign
from agglo._batches import Batches, Outcome
from agglo._errors import InputError
from agglo._fitness import Fitness
from agglo._guests import name_of
from agglo._replicate import Function, Job, outcome
from agglo._recorded import Recorded
from agglo._results import Run
from agglo._types import Folder, Progress

Told = Callable[[Progress], object]


class Method(Protocol):
    """What proposes points. One that may be stopped and gone on with proposes the same when it is told the same."""

    def ask(self) -> npt.ArrayLike:
        """Points [n, parameters] to be evaluated next, as parts of the ranges from 0 to 1; none to end the search."""

    def tell(self, fitness: Fitness, /) -> object:
        """How good the points are that were asked for last."""


class Search(Recorded):
    """The folder of a search or study: what was asked for, summary, tables, and the run of the best."""

    _kind = ("campaign", "search or study")

    @property
    def campaign(self) -> Campaign:
        """What was asked for, with all defaults."""
        return Campaign.from_file(self._asked)

    @property
    def best(self) -> Run | None:
        """The run of the best, with frames; None where there is none, as of a study."""
        folder = Path(_agglo.best_run(self.folder))
        return Run(folder) if _agglo.what_is_in(folder) is not None else None

    def plot(self, quantities: Sequence[str] | None = None) -> Any:
        """Charts as a Figure of matplotlib, which the caller shows or saves.

        Of a search: the costs of all candidates, and the best so far with its standard error; with two objectives one
        against the other as well. Of a study: means with their standard errors over its parameters.

        Args:
            quantities: Which columns of a study's table "measures", in their order. If none are named, all where one
                parameter varies, else the first.

        Raises:
            PackageError: matplotlib is not installed.
            InputError: There is no such quantity, or nothing to draw: no candidate yet, a study that has not come to its
                end or is a part.
        """
        return _search_plots.plot(self, quantities)

    def _repr_html_(self) -> str:
        return _html.search(self)


def search(
    campaign: Campaign,
    folder: Folder,
    *,
    executor: Executor | None = None,
    at_once: int | None = None,
    method: Method | None = None,
    function: Function | None = None,
    progress: Told | None = None,
) -> Search:
    """Conducts a search or study into a folder. What it comes to has the same bits wherever its simulations run.

    Args:
        campaign: What to look for. If `method` is given, it is one that is `led`.
        folder: Where its files go; it must be empty, or not be there.
        executor: Runs the simulations: one of concurrent.futures, `client.get_executor()` of Dask, an MPIPoolExecutor of
            mpi4py. Without one they run on threads of this process, which needs no copies of anything, and none waits for
            another.
        at_once: How many simulations are under way at once; all processors, or twice the workers of an executor. Simulations
            that take less than a tenth of a second travel to workers together where there are more, such as 20 for each.
        method: Proposes the points instead of the methods of agglo: `GaussianProcess`, or an object with `ask` and `tell`.
        function: Gives the quantities of a simulation from its scenario instead of a run. With a process pool or on a
            cluster it must be one that can be pickled. What it raises is why a replicate failed. The search goes on with a
            function of the same name alone.
        progress: Called about ten times a second; what it raises stops the search, and `resume` goes on from there.

    Raises:
        ScenarioError: The campaign or its base has faults.
        InputError: The folder is in use, or a method is given to a campaign that has one.
        RunError: No candidate could be evaluated, or a file could not be written.
        KeyboardInterrupt: At Ctrl-C; `resume` goes on from there.
    """
    sender, places = _sender(executor, function)
    _agglo.conduct(campaign, Path(folder), at_once or places, sender, method, progress)
    return Search(folder)


def go_on(
    folder: Path,
    executor: Executor | None,
    at_once: int | None,
    method: Method | None,
    function: Function | None,
    progress: Told | None,
) -> Search:
    """Goes on with the search or study in a folder."""
    sender, places = _sender(executor, function)
    _agglo.conduct(None, folder, at_once or places, sender, method, progress)
    return Search(folder)


_Submit = Callable[[str, Path, int, list[str]], "Future[Outcome]"]


def _sender(
    executor: Executor | None, function: Function | None
) -> tuple[tuple[_Submit, str | None] | None, int]:
    """What sends a simulation to the workers, with the name of the function; and how many to have under way."""
    name = None if function is None else name_of(function)
    if executor is not None:
        workers = _workers(executor)
        return (Batches(executor, workers, function).submit, name), 2 * workers
    return None if function is None else (_here(function), name), _agglo.processors()


def _here(function: Function) -> _Submit:
    """Runs a function on the thread that asks for it."""

    def submit(text: str, base: Path, seed: int, columns: list[str]) -> Future[Outcome]:
        done: Future[Outcome] = Future()
        done.set_result(outcome(function, Job(text, os.path.abspath(base), seed, tuple(columns))))
        return done

    return submit


def _workers(executor: Executor) -> int:
    """How many simulations an executor runs at a time, where it says so; else as many as this machine."""
    for name in ("_max_workers", "num_workers"):
        workers = getattr(executor, name, None)
        if isinstance(workers, int) and workers > 0:
            return workers
    client = getattr(executor, "_client", None)
    if client is not None:
        return max(1, int(sum(client.nthreads().values())))
    return _agglo.processors()


class _Ended(Exception):
    """Nobody asks for points any more."""


class _Asked:
    """Points that somebody hands in one batch after another, as a method."""

    def __init__(self) -> None:
        self.points: queue.SimpleQueue[npt.ArrayLike | None | BaseException] = queue.SimpleQueue()
        self.found: queue.SimpleQueue[Fitness | None] = queue.SimpleQueue()

    def ask(self) -> npt.ArrayLike:
        given = self.points.get()
        if isinstance(given, BaseException):
            raise given
        return np.empty((0, 0)) if given is None else given

    def tell(self, fitness: Fitness, /) -> None:
        self.found.put(fitness)


class Evaluator:
    """A search that a loop of one's own leads: it is called with points, and says how good they are.

    >>> import agglo, pathlib, tempfile
    >>> quick = {"settings": ["time.end=1 ms", "grains.0.size.length_ratio.count=20", "grains.0.placement.fill.count=20"],
    ...          "ensemble.until": {"fixed": {"replicates": 1}}, "confirm.candidates": 0}
    >>> campaign = agglo.Campaign.template("search", quick).led(evaluations=4)
    >>> folder = pathlib.Path(tempfile.mkdtemp()) / "search"
    >>> with agglo.Evaluator(campaign, folder) as evaluate:
    ...     found = evaluate([[0.5] * 10, [0.2] * 10])
    >>> found.costs.shape
    (2, 1)
    >>> evaluate.result.summary["evaluations"]
    2

    Args:
        campaign: What to look for; its method must be `led`. Where the folder holds it already, None goes on with it: the
            loop hands in the same points again, and those that are known are answered at once.
        folder, executor, at_once, function, progress: As in `search`.

    Attributes:
        result: The `Search`, once the block has come to its end.
    """

    def __init__(
        self,
        campaign: Campaign | None,
        folder: Folder,
        *,
        executor: Executor | None = None,
        at_once: int | None = None,
        function: Function | None = None,
        progress: Told | None = None,
    ) -> None:
        self.folder = Path(folder)
        self.result: Search | None = None
        self._method = _Asked()
        self._failure: BaseException | None = None
        sender, places = _sender(executor, function)

        def conduct() -> None:
            try:
                _agglo.conduct(campaign, self.folder, at_once or places, sender, self._method, progress)
            except BaseException as error:  # noqa: BLE001 - whatever it is, the caller's thread raises it
                self._failure = error
            self._method.found.put(None)

        self._thread = threading.Thread(target=conduct, daemon=True)

    def __enter__(self) -> Evaluator:
        self._thread.start()
        return self

    def __call__(self, points: npt.ArrayLike) -> Fitness:
        """How good points [n, parameters] are, as parts of the ranges from 0 to 1.

        Raises:
            InputError: They are no such points, or the search has come to its end.
            RunError: None could be evaluated, or a file could not be written.
        """
        points = np.atleast_2d(np.asarray(points, dtype=np.float64))
        if points.size == 0:
            raise InputError("there are no points; an array [n, parameters] is wanted")
        if self._thread.is_alive():
            self._method.points.put(points)
            found = self._method.found.get()
            if found is not None:
                return found
        self._thread.join()
        if self._failure is not None:
            raise self._failure
        raise InputError("the search has come to its end: it has evaluated as many points as the campaign allows")

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._method.points.put(None if error is None else _Ended())
        self._thread.join()
        if error is not None:
            return
        if self._failure is not None:
            raise self._failure
        self.result = Search(self.folder)


def read(folder: Folder) -> Run | Search:
    """What stands in the folder of a run, or of a search or study.

    Raises:
        InputError: It holds neither.
    """
    found = _agglo.what_is_in(Path(folder))
    if found is None:
        raise InputError(f"{folder} holds no run, search or study")
    return Run(folder) if found[0] == "run" else Search(folder)
