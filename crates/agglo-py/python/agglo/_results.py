"""What stands in the folder of a run."""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from agglo import _agglo
from agglo._agglo import Scenario
from agglo._errors import InputError
from agglo._types import Columns, Folder


class Table(dict[str, npt.NDArray[Any]]):
    """A table over time: columns [n] by their names, which end with their units. Empty entries are not a number."""

    def pandas(self) -> Any:
        """The same as a DataFrame of pandas, which must be installed."""
        return import_module("pandas").DataFrame(dict(self))

    def polars(self) -> Any:
        """The same as a DataFrame of polars, which must be installed."""
        return import_module("polars").DataFrame(dict(self))


class Run:
    """The folder of a run: its scenario, summary, tables over time and frames."""

    def __init__(self, folder: Folder) -> None:
        self.folder = Path(folder)
        if not (self.folder / "scenario.toml").is_file():
            raise InputError(f"{self.folder} holds no run: scenario.toml is missing")

    @property
    def scenario(self) -> Scenario:
        """What was run, with all defaults."""
        return Scenario.from_file(self.folder / "scenario.toml")

    @property
    def summary(self) -> Mapping[str, Any] | None:
        """What the run came to; None as long as it has not reached its end."""
        file = self.folder / "summary.json"
        return dict(json.loads(file.read_text(encoding="utf-8"))) if file.is_file() else None

    @property
    def tables(self) -> list[str]:
        """Names of the tables over time."""
        return sorted(file.stem for file in (self.folder / "series").glob("*.csv"))

    def table(self, name: str) -> Table:
        """A table over time, such as "energy".

        Raises:
            InputError: There is no such table.
        """
        file = self.folder / "series" / f"{name}.csv"
        if not file.is_file():
            raise InputError(f"there is no table {name!r} in {self.folder}; there are {', '.join(self.tables)}")
        with file.open(encoding="utf-8", newline="") as lines:
            rows = csv.reader(lines)
            names = next(rows, [])
            whole = [row for row in rows if len(row) == len(names)]
        return Table({name: _column([row[at] for row in whole]) for at, name in enumerate(names)})

    def frames(self, kind: str = "grains") -> list[tuple[float, Path]]:
        """Times [s] and files of the frames of "grains", "bonds" or "rays"."""
        return [(time, Path(file)) for time, file in _agglo.frames(self.folder, kind)]

    def grains(self, frame: int = -1) -> tuple[float, Columns]:
        """The time [s] and the columns of the grains of a frame; of the last one if none is named.

        Raises:
            InputError: There is no such frame.
        """
        frames = self.frames()
        try:
            time, file = frames[frame]
        except IndexError:
            raise InputError(f"there is no frame {frame} in {self.folder}; it has {len(frames)}") from None
        return time, _agglo.read_frame(file)

    def pyvista(self, frame: int = -1) -> Any:
        """The grains of a frame as a mesh of PyVista, which must be installed."""
        return import_module("pyvista").read(self.frames()[frame][1])

    def report(self) -> Path:
        """Writes report.html, and gives its path."""
        return report(self.folder)

    def __repr__(self) -> str:
        state = "finished" if self.summary is not None else "not finished"
        return f"<agglo.Run {str(self.folder)!r}, {state}>"


def _column(texts: list[str]) -> npt.NDArray[Any]:
    """Numbers where all are; words otherwise."""
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts)


def read(folder: Folder) -> Run:
    """What stands in the folder of a run.

    Raises:
        InputError: It holds none.
    """
    return Run(folder)


def report(folder: Folder) -> Path:
    """Writes report.html into the folder of a run, search or study, and gives its path.

    Raises:
        InputError: There is nothing to show.
    """
    return Path(_agglo.report(Path(folder))[0])
