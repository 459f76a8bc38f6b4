"""Starts from arrays."""

from __future__ import annotations

import csv
import warnings
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from agglo._agglo import Scenario
from agglo._errors import InputError
from agglo._types import Columns, Folder

# Columns that are taken, besides names and ids.
_VECTORS = ("position_m", "velocity_m_s", "angular_velocity_rad_s")
_SCALARS = ("radius_m", "temperature_K", "charge_C", "polarity")
# What a table cannot hold for each grain, but an entry of a scenario for all of its grains: the column, the key, the unit.
_SHARED = [
    ("charge_C", "charge", "C"),
    ("polarity", "polarity", ""),
]


@overload
def start(
    grains: Any,
    folder: Folder,
    scenario: Scenario,
    *,
    material: str | None = None,
    bonds: npt.ArrayLike | None = None,
    length_unit_m: float | None = None,
) -> Scenario: ...


@overload
def start(
    grains: Any,
    folder: Folder,
    scenario: None = None,
    *,
    material: str | None = None,
    bonds: None = None,
    length_unit_m: float | None = None,
) -> list[dict[str, Any]]: ...


def start(
    grains: Any,
    folder: Folder,
    scenario: Scenario | None = None,
    *,
    material: str | None = None,
    bonds: npt.ArrayLike | None = None,
    length_unit_m: float | None = None,
) -> Scenario | list[dict[str, Any]]:
    """A start from grains that are there already, in place of a scenario's own; without one, the entries of `[[grains]]`.

    Grains are written as tables `grains-0.csv` ..., one for each material, into the folder, which the scenario names from
    then on (a run copies them). Their ids are those of a column `id`, or 0, 1, ... in the given order.

    Args:
        grains: Columns by their names, as `Simulation.grains()` and `Run.grains()` give them: `position_m` [n, 3] and
            `radius_m` [n], and, if wanted, `velocity_m_s` [n, 3], `angular_velocity_rad_s` [n, 3], `temperature_K` [n],
            `material` [n] (names, or their places in alphabetical order) and `id` [n]; `Atoms` of ASE or a PolyData of
            PyVista with such arrays besides the positions. Charges and polarities are taken where all of a material have the
            same, and left out with a warning where they differ.
        folder: Where the tables go; it may be there, but not hold any yet.
        scenario: What the grains are put into. Keys that they do not set come from its first grains of the same material.
        bonds: Pairs [n, 2] of grains that are bonded, by the column `id`, or by their places where there is none; as
            `Simulation.bonds()` gives them. Bonds are at rest as the grains are. The scenario has `[bonds.beam]`, which bonds
            neighbors if they are not given.
        material: The name of the material of all; not needed where the scenario has one alone, or there is a column.
        length_unit_m: The unit [m] of the positions of `Atoms` or a PolyData; if not given, meters or what `agglo.to_ase`
            noted.

    Raises:
        InputError: A column is missing, of another shape or not finite, a material or a bonded grain is not known, or the
            folder holds tables.
        ScenarioError: The scenario does not take the grains.
    """
    if bonds is not None and scenario is None:
        raise InputError("bonds: a scenario is wanted that says how they hold, in [bonds.beam]")
    columns = _columns(grains, length_unit_m)
    names = _materials(columns, scenario, material)
    pairs = None if bonds is None else _pairs(bonds, columns["id"])
    place = Path(folder).absolute()
    place.mkdir(parents=True, exist_ok=True)
    known = scenario.to_dict() if scenario is not None else {}
    entries = []
    # Materials in the order in which they come first.
    for number, name in enumerate(dict.fromkeys(names.tolist())):
        of_name = {key: values[names == name] for key, values in columns.items()}
        entry = next(
            (dict(entry) for entry in known.get("grains", []) if entry["material"] == name), {"material": name}
        )
        file = place / f"grains-{number}.csv"
        _write(of_name, file)
        entries.append(_entry(entry, of_name, file))
    if scenario is None:
        return entries
    begin = {key: value for key, value in known.get("start", {}).items() if key != "bonds"}
    if pairs is not None:
        file = place / "bonds.csv"
        _put(file, ["grain_i", "grain_j"], pairs.tolist())
        begin["bonds"] = str(file)
    return Scenario.from_dict({**known, "start": begin, "grains": entries}, base=scenario.base)


def _pairs(bonds: npt.ArrayLike, ids: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Bonds as whole numbers [n, 2] that are ids of grains."""
    pairs = np.asarray(bonds)
    if pairs.size == 0:
        return np.empty((0, 2), dtype=np.int64)
    if pairs.ndim != 2 or pairs.shape[1] != 2 or pairs.dtype.kind not in "iu":
        raise InputError(f"bonds: found {pairs.dtype} of the shape {pairs.shape}; whole numbers [n, 2] are wanted")
    strange = pairs[~np.isin(pairs, ids)]
    if len(strange):
        raise InputError(f"bonds: there is no grain {strange[0]}")
    return pairs


def _columns(grains: Any, length_unit_m: float | None) -> Columns:
    """The columns of grains of any kind that is taken, in the order of ids; ids are their places where there are none."""
    if hasattr(grains, "get_positions") and hasattr(grains, "arrays"):
        unit = grains.info.get("length_unit_m", 1.0) if length_unit_m is None else length_unit_m
        given = {**grains.arrays, "position_m": grains.get_positions() * unit}
    elif hasattr(grains, "points") and hasattr(grains, "point_data"):
        unit = 1.0 if length_unit_m is None else length_unit_m
        given = {name: grains.point_data[name] for name in grains.point_data.keys()}
        given["position_m"] = np.asarray(grains.points) * unit
    elif isinstance(grains, Mapping):
        given = dict(grains)
    else:
        wanted = "columns in a dict, Atoms of ASE or a PolyData of PyVista are wanted"
        raise InputError(f"grains: found {type(grains).__name__}; {wanted}")
    if "position_m" not in given or "radius_m" not in given:
        raise InputError(f"grains: position_m and radius_m are wanted; found {', '.join(map(str, given)) or 'nothing'}")
    count = len(np.asarray(given["position_m"]))
    if count == 0:
        raise InputError("grains: there are none")
    columns: Columns = {name: _numbers(given[name], name, (count, 3)) for name in _VECTORS if name in given}
    columns |= {name: _numbers(given[name], name, (count,)) for name in _SCALARS if name in given}
    columns |= {name: np.asarray(given[name]) for name in ("material", "id") if name in given}
    for name in ("material", "id"):
        if name in columns and columns[name].shape != (count,):
            raise InputError(f"{name}: found the shape {columns[name].shape}; ({count},) is wanted")
    ids = columns.setdefault("id", np.arange(count))
    if ids.dtype.kind not in "iuf" or np.any(ids != np.floor(ids)) or ids.min() < 0:
        raise InputError("id: whole numbers from 0 on are wanted")
    columns["id"] = ids.astype(np.int64)
    order = np.argsort(columns["id"], kind="stable")
    columns = {name: values[order] for name, values in columns.items()}
    if len(np.unique(columns["id"])) < count:
        raise InputError("id: two grains have the same one")
    return columns


def _numbers(values: Any, name: str, shape: tuple[int, ...]) -> npt.NDArray[np.float64]:
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(f"{name}: numbers are wanted") from None
    if array.shape != shape:
        raise InputError(f"{name}: found the shape {array.shape}; {shape} is wanted")
    strange = np.argwhere(~np.isfinite(array))
    if len(strange):
        raise InputError(
            f"{name}: found {array[tuple(strange[0])]} at grain {strange[0][0]}; finite numbers are wanted"
        )
    return array


def _materials(columns: Columns, scenario: Scenario | None, material: str | None) -> npt.NDArray[np.str_]:
    """The name of each grain's material; the column is taken out."""
    known = sorted(scenario.to_dict().get("materials", {})) if scenario is not None else None
    given = columns.pop("material", None)
    if material is not None:
        names = np.full(len(columns["radius_m"]), material)
    elif given is not None and given.dtype.kind in "US":
        names = given.astype(str)
    elif given is not None and known is not None:
        places = given.astype(np.int64)
        if places.min() < 0 or places.max() >= len(known):
            wrong = places.max() if places.min() >= 0 else places.min()
            raise InputError(f"material: found {wrong}; the scenario has 0 to {len(known) - 1}: {', '.join(known)}")
        names = np.array(known)[places]
    elif known is not None and len(known) == 1:
        names = np.full(len(columns["radius_m"]), known[0])
    else:
        there = f"; the scenario has {', '.join(known)}" if known else ""
        raise InputError(f"material: a name for all or a column of names is wanted{there}")
    strange = sorted(set(names.tolist()) - set(known)) if known is not None else []
    if strange:
        raise InputError(f"material: found {strange[0]!r}; the scenario has {', '.join(known or [])}")
    return names


def _write(columns: Columns, file: Path) -> None:
    parts = [("id", columns["id"])]
    parts += [(f"{axis}_m", columns["position_m"][:, at]) for at, axis in enumerate("xyz")]
    parts.append(("radius_m", columns["radius_m"]))
    for column, letter, unit in [("velocity_m_s", "v", "m_s"), ("angular_velocity_rad_s", "w", "rad_s")]:
        if column in columns:
            parts += [(f"{letter}{axis}_{unit}", columns[column][:, at]) for at, axis in enumerate("xyz")]
    if "temperature_K" in columns:
        parts.append(("temperature_K", columns["temperature_K"]))
    # Python writes the digits that bring back the same double.
    _put(file, [name for name, _ in parts], zip(*(values.tolist() for _, values in parts)))


def _put(file: Path, names: Sequence[str], rows: Iterable[Iterable[Any]]) -> None:
    try:
        with file.open("x", encoding="utf-8", newline="") as lines:
            table = csv.writer(lines, lineterminator="\n")
            table.writerow(names)
            table.writerows(rows)
    except FileExistsError:
        raise InputError(f"{file} is there already; name another folder, or move it away") from None


def _entry(entry: dict[str, Any], columns: Columns, file: Path) -> dict[str, Any]:
    """An entry of `[[grains]]` for a table, with what else it says of its grains."""
    entry["size"] = {"constant": {"radius": f"{columns['radius_m'][0].item()!r} m"}}
    entry["placement"] = {"table": {"file": str(file)}}
    overridden = [key for column, keys in _OVERRIDDEN.items() if column in columns for key in keys]
    entry = {key: value for key, value in entry.items() if key not in overridden}
    for column, key, unit in _SHARED:
        values = columns.get(column)
        if values is None:
            continue
        if np.all(values == values[0]):
            entry[key] = _quantity(values[0].tolist(), unit)
        else:
            warnings.warn(f"{column} is left out: a table of grains does not hold it", stacklevel=3)
    return entry


# Keys that have no meaning beside a column of the table.
_OVERRIDDEN = {
    "velocity_m_s": ["velocity", "velocity_spread"],
    "angular_velocity_rad_s": ["angular_velocity"],
    "temperature_K": ["temperature"],
}


def _quantity(value: Any, unit: str) -> Any:
    if isinstance(value, Sequence):
        return [_quantity(part, unit) for part in value]
    return f"{value!r} {unit}" if unit else int(value)
