"""Names of types."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from os import PathLike
from typing import Any, TypeAlias, TypedDict, Union

import numpy as np
import numpy.typing as npt

Floats: TypeAlias = npt.NDArray[np.float64]
"""An array of numbers."""

Columns: TypeAlias = dict[str, npt.NDArray[Any]]
"""Arrays by their names, which end with their units."""

Settings: TypeAlias = Union[Mapping[str, Any], Iterable[str], None]
"""Other values of a scenario's keys: {"time.end": "1 s"}, or ["time.end=1 s"]."""

ForceFunction: TypeAlias = Callable[[float, Floats, Floats, Floats], Union[Floats, tuple[Floats, Floats]]]
"""Time [s], positions, velocities and angular velocities [n, 3] to forces [n, 3] [N], or to forces and torques [N m]."""

Folder: TypeAlias = Union[str, "PathLike[str]"]
"""Where files are."""


class Progress(TypedDict, total=False):
    """How far a run is: the simulated time and its end, steps or events so far, what happens now, and new warnings.

    Of a search or study: the stage, evaluations so far and at the most, batches, failures, simulations that ended and how many in
    a second, the best with its standard error, and the wall time that is left.
    """

    time_s: float
    end_s: float
    steps: int
    events: int
    now: str
    stage: str
    evaluations: int
    evaluations_at_most: int | None
    batches: int
    failures: int
    runs: int
    runs_per_s: float
    best: float | None
    best_standard_error: float | None
    left_s: float | None
    warnings: list[str]
