"""A simulation of a search, as workers elsewhere run it. It is light to import: NumPy and the module in Rust."""

from __future__ import annotations

import pickle
import time
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import NamedTuple, Union

from agglo import _agglo
from agglo._agglo import Scenario

Function = Callable[[Scenario], Mapping[str, float]]
"""A candidate's scenario, with the seed of a replicate, to the quantities that the search asks for."""


def _read(text: str, base: str) -> Scenario:
    return Scenario(text, None, base)


# Replicates of a candidate have the same scenario, but for the seed.
_known = lru_cache(maxsize=64)(_read)


class Job(NamedTuple):
    """A simulation: the candidate's scenario, the folder of its files, the seed, and which quantities are wanted."""

    text: str
    base: str
    seed: int
    columns: tuple[str, ...]


def outcomes(function: Function | None, packed: bytes) -> tuple[list[Union[list[float], str]], float]:
    """What came of simulations, and how long they took [s]; they are jobs, pickled."""
    jobs: list[Job] = pickle.loads(packed)
    began = time.perf_counter()
    found = [outcome(function, job) for job in jobs]
    return found, time.perf_counter() - began


def outcome(function: Function | None, job: Job) -> Union[list[float], str]:
    """The quantities of a simulation, one for each column; or the reason why it failed."""
    scenario = _known(job.text, job.base)
    if function is None:
        return _agglo.replicate(scenario, job.seed, list(job.columns))
    try:
        found = function(scenario.seeded(job.seed))
        missing = [name for name in job.columns if name not in found]
        if missing:
            return f"the function gave no {missing[0]}; the search asks for {', '.join(job.columns)}"
        return [float(found[name]) for name in job.columns]
    except Exception as error:  # noqa: BLE001 - whatever a function of the user's raises is why its simulation failed
        return f"{type(error).__name__}: {error}"
