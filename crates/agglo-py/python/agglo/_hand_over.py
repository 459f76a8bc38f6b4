"""From hard to soft spheres and back."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

from agglo import _agglo
from agglo._agglo import Scenario
from agglo._types import Folder


class HandOver(NamedTuple):
    """A run that was handed over to the other kind of spheres.

    Attributes:
        scenario: What was written, ready to run.
        record: What was kept and what was not: motion before and after, porosities, bonds, grains that were moved.
        text: The same in words.
    """

    scenario: Scenario
    record: dict[str, Any]
    text: str

    def __str__(self) -> str:
        return self.text


def hand_over(
    grown: Folder,
    to: Folder,
    *,
    scenario: Scenario | None = None,
    porosity: float | None = None,
    seed: int | None = None,
) -> HandOver:
    """Hands a run over: agglomerates of hard spheres become packings of bonded primaries, clusters of soft ones a sphere each.

    Args:
        grown: The folder of the run, finished or not.
        to: The scenario file to write, beside which tables and a record are put; it must not be there.
        scenario: Gives all but the grains; "acoustic" for soft spheres and "reacting" for hard ones if left out.
        porosity: Pores over the whole volume of an agglomerate, from 0 and below 1; 0.6 if left out.
        seed: Of the packing; the scenario's if left out.

    Raises:
        InputError: There is no such run, the scenario is for the same kind of spheres, or a file is there already.
    """
    record, text = _agglo.hand_over(Path(grown), Path(to), scenario, porosity, seed)
    return HandOver(Scenario.from_file(to), record, text)
