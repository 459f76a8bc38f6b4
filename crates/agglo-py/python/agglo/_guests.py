"""What takes part in a run: a force, measures and a rule that ends it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, Union

from agglo._types import Columns, ForceFunction

Measure = Callable[[float, Columns], Union[float, None]]
"""Time [s] and columns of the grains to a number, or None where there is none."""

Stop = Callable[[float, Columns], bool]
"""Time [s] and columns of the grains to whether the run is to end here."""


@dataclass(frozen=True)
class Force:
    """A force on soft spheres, with what the automatic step has to know of it.

    Args:
        function: Time [s], positions [n, 3] [m], velocities [n, 3] [m/s] and angular velocities [n, 3] [rad/s], in the order of
            ids, to forces [n, 3] [N], or to forces and torques about the centers [n, 3] [N m].
        stiffness_over_mass: The largest stiffness over the mass [1/s2].
        damping_over_mass: The largest damping over the mass [1/s].
    """

    function: ForceFunction
    stiffness_over_mass: float | None = None
    damping_over_mass: float | None = None


def name_of(function: Callable[..., object]) -> str:
    """What a run or search knows a function by: what goes on with it must have the same name."""
    if isinstance(function, partial):
        return name_of(function.func)
    return str(getattr(function, "__name__", type(function).__name__))


def functions_of(
    force: Force | ForceFunction | None, measures: Mapping[str, Measure] | None, stop: Stop | None
) -> dict[str, Any] | None:
    """What is handed over to Rust; None where nothing takes part."""
    if force is None and not measures and stop is None:
        return None
    given = force if isinstance(force, Force) else None
    function = force.function if isinstance(force, Force) else force
    return {
        "force": function,
        "stiffness_over_mass": None if given is None else given.stiffness_over_mass,
        "damping_over_mass": None if given is None else given.damping_over_mass,
        "measures": list((measures or {}).items()),
        "stop": stop,
    }
