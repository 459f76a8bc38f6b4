"""Grains and their history as objects of other packages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from agglo._errors import InputError
from agglo._optional import need
from agglo._tables import Table
from agglo._types import Columns

Graph: TypeAlias = Any
"""A DiGraph of networkx."""


def to_pyvista(grains: Columns, bonds: npt.NDArray[np.uint32] | None = None) -> Any:
    """Grains as a mesh of PyVista: a point each, with all other columns as point data.

    Spheres of them are `mesh.glyph(scale="radius_m", geom=pyvista.Sphere(radius=1.0), orient=False)`.

    Args:
        grains: Columns as `Simulation.grains()` gives them.
        bonds: Pairs of ids [m, 2], as `Simulation.bonds()` gives them: then the mesh has a line for each.

    Raises:
        PackageError: PyVista is not installed.
        InputError: A bond names a grain that is not there.
    """
    mesh = need("pyvista", "to_pyvista").PolyData(np.ascontiguousarray(grains["position_m"]))
    for name, values in grains.items():
        if name != "position_m":
            mesh.point_data[name] = values
    if bonds is not None:
        ids = grains["id"]
        ends = np.searchsorted(ids, bonds).clip(max=max(len(ids) - 1, 0))
        if len(bonds) and not np.array_equal(ids[ends], bonds):
            raise InputError("bonds: an id is not among the grains; give both of the same moment")
        mesh.verts = np.empty(0, dtype=np.int64)
        mesh.lines = np.column_stack([np.full(len(ends), 2), ends]).ravel().astype(np.int64)
    return mesh


def to_ase(grains: Columns, length_unit_m: float = 1.0, time_s: float | None = None) -> Any:
    """Grains as `Atoms` of ASE, one each, with the symbol X.

    Positions are in units of `length_unit_m`, meters if none is given; ASE's own unit would be 1e-10. All other columns are
    arrays in SI units under their names (`radius_m`, `velocity_m_s`, `id`, ...), and `info` has `length_unit_m` and `time_s`.
    ASE's own masses and velocities are left alone, since they are in units of atoms.

    Raises:
        PackageError: ASE is not installed.
        InputError: `length_unit_m` is not above 0.
    """
    if not length_unit_m > 0.0:
        raise InputError(f"length_unit_m is {length_unit_m}; a length above 0 is wanted")
    place = grains["position_m"] / length_unit_m
    atoms = need("ase", "to_ase").Atoms(f"X{len(place)}", positions=place)
    for name, values in grains.items():
        if name != "position_m":
            atoms.set_array(name, values)
    atoms.info["length_unit_m"] = length_unit_m
    if time_s is not None:
        atoms.info["time_s"] = time_s
    return atoms


def sizes(grains: Columns, lower: Sequence[int] | None = None) -> Table:
    """How large they are, by classes of primaries that begin at `lower`, or 1, 2, 4, ...; classes without any are left out.

    Hard spheres are made of primaries; of soft ones a cluster is what is counted, and its grains are its primaries.
    """
    if "primaries" in grains:
        primaries, masses = grains["primaries"].astype(np.int64), grains["mass_kg"]
    else:
        primaries = np.bincount(grains["cluster"].astype(np.int64))
        masses = np.bincount(grains["cluster"].astype(np.int64), weights=grains["mass_kg"])
    # Numbers of primaries have 32 binary digits.
    bounds = 2 ** np.arange(33) if lower is None else np.append(np.asarray(lower, dtype=np.float64), np.nan)
    begins, ends = bounds[:-1], bounds[1:] - 1
    classes = np.searchsorted(begins, primaries, side="right") - 1
    found = np.unique(classes)
    mass = np.array([masses[classes == one].sum() for one in found])
    return Table(
        lower_primaries=begins[found].astype(np.int64),
        upper_primaries=ends[found],
        grains=np.array([np.count_nonzero(classes == one) for one in found]),
        mass_kg=mass,
        mass_fraction=mass / masses.sum(),
    )


def genealogy(events: Table, parents: Table, start: Columns) -> Graph:
    """Who became part of whom: see `Run.genealogy`."""
    graph = need("networkx", "Run.genealogy").DiGraph()
    now: dict[int, tuple[int, int]] = {}
    for grain, mass, primaries in zip(*(start[name].tolist() for name in ("id", "mass_kg", "primaries"))):
        now[grain] = (grain, 0)
        graph.add_node(now[grain], **_node(grain, 0.0, primaries, mass))
    rows = zip(events["event"].tolist(), events["time_s"].tolist(), events["kind"].tolist())
    told = {int(event): (time, kind) for event, time, kind in rows}
    links = [parents[name].tolist() for name in ("event", "parent", "child", "primaries", "mass_kg")]
    for event, of_event in _by_event(zip(*links)).items():
        time, kind = told[event]
        before = {parent: now.pop(parent) for parent in {row[0] for row in of_event}}
        for node in before.values():
            graph.nodes[node]["ended_s"] = time
        for parent, child, primaries, mass in of_event:
            now[child] = (child, event)
            if now[child] not in graph:
                graph.add_node(now[child], **_node(child, time, 0, 0.0))
            graph.nodes[now[child]]["primaries"] += primaries
            graph.nodes[now[child]]["mass_kg"] += mass
            told_of_edge = {"event": event, "time_s": time, "kind": kind, "primaries": primaries, "mass_kg": mass}
            graph.add_edge(before[parent], now[child], **told_of_edge)
    return graph


def _node(grain: int, born_s: float, primaries: int, mass_kg: float) -> Mapping[str, Any]:
    return {"grain": grain, "born_s": born_s, "ended_s": np.nan, "primaries": primaries, "mass_kg": mass_kg}


def _by_event(rows: Any) -> dict[int, list[tuple[int, int, int, float]]]:
    """Parents, children, primaries and masses of each event, in their order."""
    grouped: dict[int, list[tuple[int, int, int, float]]] = {}
    for event, parent, child, primaries, mass in rows:
        grouped.setdefault(int(event), []).append((int(parent), int(child), int(primaries), mass))
    return grouped
