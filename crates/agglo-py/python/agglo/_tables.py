"""Tables as columns."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from agglo import _html
from agglo._optional import need
from agglo._types import Folder


class Table(dict[str, npt.NDArray[Any]]):
    """A table: columns [n] by their names, which end with their units. Empty entries are not a number."""

    def pandas(self) -> Any:
        """The same as a DataFrame of pandas.

        Raises:
            PackageError: pandas is not installed.
        """
        return need("pandas", "Table.pandas").DataFrame(dict(self))

    def polars(self) -> Any:
        """The same as a DataFrame of polars.

        Raises:
            PackageError: polars is not installed.
        """
        return need("polars", "Table.polars").DataFrame(dict(self))

    def parquet(self, path: Folder) -> Path:
        """Writes a file of Parquet with the same columns, and gives its path. What is there is written over.

        Raises:
            PackageError: pyarrow is not installed.
            OSError: The file cannot be written.
        """
        file = Path(path)
        arrow, files = need("pyarrow", "Table.parquet"), need("pyarrow.parquet", "Table.parquet")
        files.write_table(arrow.table({name: arrow.array(values) for name, values in self.items()}), file)
        return file

    def _repr_html_(self) -> str:
        return _html.table(self)


def read_table(file: Path) -> Table:
    """A table of a run's folder. A last line that is being written is passed over."""
    with file.open(encoding="utf-8", newline="") as lines:
        rows = csv.reader(lines)
        names = next(rows, [])
        whole = [row for row in rows if len(row) == len(names)]
    return Table({name: column([row[at] for row in whole]) for at, name in enumerate(names)})


def column(texts: list[str]) -> npt.NDArray[Any]:
    """Numbers where all are; words otherwise."""
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts)
