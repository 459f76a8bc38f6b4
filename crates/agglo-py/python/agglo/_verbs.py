"""What the terminal can do as well: check, run, resume, report."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from agglo import _agglo, _html
from agglo._agglo import Scenario, Simulation
from agglo._errors import InputError
from agglo._guests import Force, Measure, Stop, functions_of
from agglo._replicate import Function
from agglo._results import Run
from agglo._search import Method, Search, go_on
from agglo._types import Columns, Folder, ForceFunction, Progress


@dataclass(frozen=True)
class Plan:
    """What a scenario would ask of this machine; None where that is not known."""

    grains: int
    rays_per_pulse: int
    pulses: int
    impacts: float
    steps: float | None
    memory_B: float
    disk_B: float | None
    wall_s: float | None
    quantities: Mapping[str, str]
    notes: tuple[str, ...]
    text: str

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return _html.plan(self)


def check(scenario: Scenario) -> Plan:
    """What a run of the scenario would be: how many steps, how long, how much memory and disk, and what to keep in mind.

    Raises:
        InputError: The grains cannot be placed.
    """
    found = _agglo.check(scenario)
    found["quantities"] = {one["label"]: one["value"] for one in found["quantities"]}
    found["notes"] = tuple(found["notes"])
    return Plan(**found)


def _refuse_none(domains: int) -> None:
    if not 1 <= domains <= 256:
        raise InputError(f"domains is {domains}; a number from 1 to 256 is wanted")


def run(
    scenario: Scenario,
    folder: Folder | None = None,
    *,
    force: Force | ForceFunction | None = None,
    measures: Mapping[str, Measure] | None = None,
    stop: Stop | None = None,
    progress: Callable[[Progress], object] | None = None,
    domains: int = 1,
) -> Run | dict[str, Any]:
    """Runs a scenario into a folder, and gives what stands there. Without a folder nothing is written, and only the summary given.

    Args:
        scenario: What to run.
        folder: Where its files go; it must be empty, or not be there.
        force: Acts on soft spheres besides the laws of the scenario: a function of the time [s], positions, velocities and
            angular velocities [n, 3] that gives forces [n, 3] [N], as `Simulation.attach` takes it, or a `Force`, which
            tells the automatic step how fast it is. It gives the same for the same arguments.
        measures: Functions of the time [s] and the columns of the grains, in the order of ids, by their names, which end with
            units ("spread_m"). They are asked for every row of the tables over time; what they give stands in the table
            "own", not a number for None.
        stop: A function of the same that says whether the run is to end at this row, as if its end were there.
        progress: Called about ten times a second with the time, the steps and the warnings that are new.
        domains: Over how many domains soft spheres are spread, each with threads of its own; the results are the same to the last
            bit.

    What any of these functions raises stops the run and comes to the caller. The run has a checkpoint then, and `resume` goes on
    with the same functions; where it had not begun there is no folder.

    Raises:
        InputError: The folder is in use, the grains cannot be placed, or a function cannot take part in such a run.
        RunError: A step failed, or a file could not be written.
        KeyboardInterrupt: At Ctrl-C; `resume` goes on from there.
    """
    functions = functions_of(force, measures, stop)
    _refuse_none(domains)
    if folder is None:
        if functions is not None or domains != 1:
            raise InputError("force, measures, stop and domains take part in runs that write a folder; name one")
        return dict(json.loads(_agglo.run_quietly(scenario)))
    _agglo.run(scenario, Path(folder), progress, functions, domains)
    return Run(Path(folder))


def resume(
    folder: Folder,
    *,
    until: str | None = None,
    force: Force | ForceFunction | None = None,
    measures: Mapping[str, Measure] | None = None,
    stop: Stop | None = None,
    executor: Executor | None = None,
    at_once: int | None = None,
    method: Method | None = None,
    function: Function | None = None,
    progress: Callable[[Progress], object] | None = None,
    domains: int = 1,
) -> Run | Search:
    """Goes on with what is in a folder, wherever it was begun.

    A run goes on from its newest whole checkpoint, to another end such as "40 s" where `until` is given. Where it began with a
    force, measures or a rule to stop, it goes on with the same, which are given again; the number of `domains` may be another. A
    search or study goes on with all simulations that ended; `executor`, `at_once`, `method` and `function` are those of `agglo.search`.

    Raises:
        InputError: There is nothing to go on with, it has come to that time already, or what takes part in it is not given.
        RunError: A step failed, or a file could not be written.
    """
    place = Path(folder)
    functions = functions_of(force, measures, stop)
    _refuse_none(domains)
    found = _agglo.what_is_in(place)
    if found is not None and found[0] == "campaign":
        if until is not None or functions is not None or domains != 1:
            raise InputError(f"{place} holds a search or study; until, force, measures, stop and domains are for runs")
        return go_on(place, executor, at_once, method, function, progress)
    if executor is not None or at_once is not None or method is not None or function is not None:
        raise InputError(f"{place} holds no search or study; executor, at_once, method and function are for these")
    _agglo.resume(place, until, progress, functions, domains)
    return Run(place)


def schema() -> dict[str, Any]:
    """The JSON schema of scenarios."""
    return dict(json.loads(_agglo.schema()))


def snapshots(simulation: Simulation, every_s: float) -> Iterator[tuple[float, Columns]]:
    """The grains now and every so often [s] until the end: times [s] and columns.

    Raises:
        InputError: `every_s` is not above 0.
    """
    if not every_s > 0.0:
        raise InputError(f"every_s is {every_s}; a time above 0 is wanted")
    start, turn = simulation.time_s, 0
    yield start, simulation.grains()
    while not simulation.is_finished:
        turn += 1
        simulation.run_until(start + turn * every_s)
        yield simulation.time_s, simulation.grains()
