"""Tables as columns."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from agglo import _agglo, _html
from agglo._errors import InputError
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
    """A table of a folder. A last line that is being written is passed over."""
    return Table({name: np.asarray(values) for name, values in _agglo.read_table(file).items()})


def table_of(folder: Path, name: str) -> Table:
    """The table of this name in a folder.

    Raises:
        InputError: There is none.
    """
    files = dict(_agglo.tables(folder))
    if name not in files:
        raise InputError(f"there is no table {name!r} in {folder}; there are {', '.join(files) or 'none'}")
    return read_table(Path(files[name]))
