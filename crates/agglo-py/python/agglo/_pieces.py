"""Pieces for teaching and tests: laws over arrays, rays among given spheres."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from agglo import _agglo
from agglo._agglo import Scenario
from agglo._errors import InputError
from agglo._types import Columns

Material = Union[str, int]


class Trace(NamedTuple):
    """What became of the rays of a pulse.

    Attributes:
        hits: Columns of all hits: `sphere` [h], `point_m`, `normal`, `direction_in`, `direction_out` [h, 3], `power_in_W` and the part
            that is `reflected` [h], and what the hit does to the sphere: `impulse_N_s` [h, 3], or `force_N` where the law of the
            scenario gives forces. Those of one ray are in the order of time.
        pulse: Its counts and powers.
    """

    hits: Columns
    pulse: dict[str, Any]


def contact(
    scenario: Scenario,
    overlap_m: npt.ArrayLike,
    separation_m_s: npt.ArrayLike = 0.0,
    *,
    radii_m: Sequence[float],
    materials: Sequence[Material] | None = None,
    temperature_K: float = 300.0,
) -> Columns:
    """The laws of contact of a scenario of soft spheres along the line of centers.

    Args:
        scenario: Its `[contact]` and materials are taken.
        overlap_m: Overlaps [...] [m]; below 0 the grains are apart.
        separation_m_s: Speeds at which the grains part [...] [m/s], below 0 where they approach; as overlap_m, or one for all.
        radii_m: Of both grains [m].
        materials: Of both grains, by their names or places; the first one for both if left out.
        temperature_K: Of both [K], for stiffness that is softened by heat.

    Returns:
        Arrays of the shape of the overlaps: `repulsion_N`, the force on each grain away from the other; its elastic part
        `elastic_N`; `dashpot_N_s_m`, the coefficient of damping; `dissipation_W`; `energy_J`, what is stored.

    Raises:
        InputError: The scenario is of hard spheres or has no contact, or a number is out of its range.
    """
    overlap, separation = np.broadcast_arrays(
        np.asarray(overlap_m, dtype=np.float64), np.asarray(separation_m_s, dtype=np.float64)
    )
    if len(radii_m) != 2:
        raise InputError(f"radii_m has {len(radii_m)} numbers; 2 are wanted, one for each grain")
    both = [0, 0] if materials is None else [_number(scenario, material) for material in materials]
    if len(both) != 2:
        raise InputError(f"materials has {len(both)} entries; 2 are wanted, one for each grain")
    found = _agglo.contact(
        scenario,
        np.ascontiguousarray(overlap.ravel()),
        np.ascontiguousarray(separation.ravel()),
        radii_m,
        both,
        temperature_K,
    )
    return {name: values.reshape(overlap.shape) for name, values in found.items()}


def reflect(scenario: Scenario, angle_rad: npt.ArrayLike, *, material: Material = 0) -> Columns:
    """What becomes of a ray's power at a grain, by the angle between the ray and the grain's normal.

    Args:
        scenario: Its medium and materials are taken.
        angle_rad: Angles [...] [rad], from 0 to pi/2.
        material: By its name or place.

    Returns:
        Arrays of the shape of the angles, which add up to 1: the parts `reflected`, `sheared` (that go on as a shear wave)
        and `refracted` (that go on as sound).

    Raises:
        InputError: The scenario is of hard spheres, the material has no sound_speed, or an angle is out of its range.
    """
    angle = np.asarray(angle_rad, dtype=np.float64)
    if not np.all((angle >= 0.0) & (angle <= np.pi / 2)):
        raise InputError("angles are from 0 to pi/2")
    cosine = np.clip(np.cos(angle), 0.0, 1.0)
    found = _agglo.reflect(scenario, np.ascontiguousarray(cosine.ravel()), _number(scenario, material))
    return {name: values.reshape(angle.shape) for name, values in found.items()}


def trace(
    scenario: Scenario,
    position_m: npt.ArrayLike | None = None,
    radius_m: npt.ArrayLike | None = None,
    materials: Sequence[Material] | Material = 0,
    *,
    beam: int = 0,
    pulse: int = 0,
) -> Trace:
    """Traces the rays of a pulse to their end among spheres held still, by the laws of a scenario.

    Args:
        scenario: Its beams, medium, materials and law of rays are taken.
        position_m: Centers [n, 3] [m]; the grains of the scenario if left out.
        radius_m: Radii [n] [m], or one for all.
        materials: By names or places [n], or one for all.
        beam: Number of the beam, from 0.
        pulse: Number of its pulse, which says where rays start.

    Raises:
        InputError: There is no such beam, or arrays are not of these shapes.
    """
    if position_m is None:
        if radius_m is not None:
            raise InputError("radius_m is given without position_m")
        grains = _agglo.pack(scenario)
        position, radius, numbers = grains["position_m"], grains["radius_m"], grains["material"]
    else:
        position = np.ascontiguousarray(position_m, dtype=np.float64)
        if position.ndim != 2 or position.shape[1] != 3 or radius_m is None:
            raise InputError(f"position_m has the shape {list(position.shape)}; [n, 3], and radius_m with it, are wanted")
        count = len(position)
        radius = np.ascontiguousarray(np.broadcast_to(np.asarray(radius_m, dtype=np.float64), (count,)))
        named = [materials] * count if isinstance(materials, (str, int)) else list(materials)
        numbers = np.array([_number(scenario, material) for material in named], dtype=np.uint32)
    hits, counts = _agglo.trace(scenario, position, radius, numbers, beam, pulse)
    return Trace(hits, counts)


def _number(scenario: Scenario, material: Material) -> int:
    """The place of a material among those of the scenario, in the order of their names."""
    if not isinstance(material, str):
        return int(material)
    names = sorted(scenario.to_dict()["materials"])
    if material not in names:
        raise InputError(f"there is no material {material!r}; there are {', '.join(names)}")
    return names.index(material)
