"""What the folders of runs and those of searches and studies have in common."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from agglo import _agglo
from agglo._errors import InputError
from agglo._tables import Table, table_of
from agglo._types import Folder


def report(folder: Folder) -> Path:
    """Writes report.html into the folder of a run, search or study, and gives its path.

    Raises:
        InputError: There is nothing to show.
    """
    return Path(_agglo.report(Path(folder))[0])


class Recorded:
    """A folder with a file that says what was asked for, a summary and tables."""

    # What the folder must hold, as `_agglo.what_is_in` and as messages call it.
    _kind: ClassVar[tuple[str, str]]

    def __init__(self, folder: Folder) -> None:
        self.folder = Path(folder)
        kind, words = self._kind
        found = _agglo.what_is_in(self.folder)
        if found is None or found[0] != kind:
            raise InputError(f"{self.folder} holds no {words}")
        self._asked = Path(found[1])

    @property
    def summary(self) -> Mapping[str, Any] | None:
        """What it came to; None as long as it has not reached its end."""
        return _agglo.summary(self.folder)

    @property
    def tables(self) -> list[str]:
        """Names of its tables: of a run "energy", "events" and others, of a search "evaluations" and others."""
        return [name for name, _ in _agglo.tables(self.folder)]

    def table(self, name: str) -> Table:
        """A table, such as "energy" or "evaluations".

        Raises:
            InputError: There is no such table.
        """
        return table_of(self.folder, name)

    def kernels(self) -> dict[str, Table]:
        """How often hard spheres collide, merge and break, by classes of size, once a run or study has come to its end.

        "kernels" has collisions and merges of pairs of classes [m3/s], "breakage" the rates of breaking [1/s], "daughters"
        what they broke into; of a study with `kernels = true` over all replicates of each candidate, with standard errors.

        Raises:
            InputError: There are none: of soft spheres, of another search or study, or before the end.
        """
        return {name: self.table(name) for name in ("kernels", "breakage", "daughters")}

    def report(self) -> Path:
        """Writes report.html, and gives its path."""
        return report(self.folder)

    def __repr__(self) -> str:
        state = "finished" if self.summary is not None else "not finished"
        return f"<agglo.{type(self).__name__} {str(self.folder)!r}, {state}>"
