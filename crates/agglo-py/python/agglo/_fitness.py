"""How good points are."""

from __future__ import annotations

from typing import NamedTuple

from agglo._types import Floats


class Fitness(NamedTuple):
    """How good n points are, by the means over their replicates.

    Attributes:
        costs: [n, objectives], to be small: minus the value of what is to be large; not a number of those that failed.
        standard_errors: [n, objectives], of the costs; 0 where they are not known.
        violations: [n], by how much limits are missed, as sums of parts; 0 of those that keep them, infinite of those that
            failed.
    """

    costs: Floats
    standard_errors: Floats
    violations: Floats
