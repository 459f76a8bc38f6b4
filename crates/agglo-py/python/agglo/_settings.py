"""Values of Python as values of a scenario."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from typing import Any

from agglo._agglo import Scenario
from agglo._types import Folder


def plain(value: Any) -> Any:
    """The value as JSON knows it: quantities of pint as text, arrays and scalars of NumPy as lists and numbers."""
    if isinstance(value, Mapping):
        return {str(key): plain(inner) for key, inner in value.items()}
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "magnitude") and hasattr(value, "units"):
        return quantity(value)
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [plain(inner) for inner in value]
    return value


def quantity(value: Any) -> Any:
    """A quantity of pint in SI units, as text: Q(40, "um") is "4e-05 m"."""
    base = value.to_base_units()
    magnitude = plain(base.magnitude)
    unit = " ".join(f"{name}^{power:g}" for name, power in sorted(symbols(base).items()))
    if isinstance(magnitude, list):
        return [f"{part!r} {unit}".strip() for part in magnitude]
    return f"{magnitude!r} {unit}".strip() if unit else magnitude


def symbols(base: Any) -> dict[str, float]:
    """The base units of a quantity by their symbols, with their powers."""
    short = {"meter": "m", "kilogram": "kg", "second": "s", "kelvin": "K", "ampere": "A", "mole": "mol", "candela": "cd"}
    powers = {str(name): float(power) for name, power in base.unit_items()}
    return {short.get(name, name): power for name, power in powers.items() if name != "radian"}


def lines(settings: Mapping[str, Any] | Iterable[str] | None) -> list[str]:
    """Settings as `key.path=value`: {"time.end": "1 s"} is ["time.end=1 s"]."""
    if settings is None:
        return []
    if isinstance(settings, Mapping):
        return [f"{key}={toml(plain(value))}" for key, value in settings.items()]
    if isinstance(settings, str):
        return [settings]
    return list(settings)


def toml(value: Any) -> str:
    """A value of JSON as TOML on one line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(toml(inner) for inner in value) + "]"
    return json.dumps(value)


def scenario(*, base: Folder = "", **tables: Any) -> Scenario:
    """A scenario from its tables as keywords; quantities are text with units, or quantities of pint.

    >>> import agglo
    >>> two = agglo.scenario(
    ...     time={"end": "1 ms"},
    ...     engine={"verlet": {}},
    ...     materials={"glass": {"density": "2500 kg/m3"}},
    ...     grains=[{"material": "glass", "size": {"constant": {"radius": "1 mm"}},
    ...              "placement": {"list": {"positions": [["0 m", "0 m", "0 m"], ["1 cm", "0 m", "0 m"]]}}}],
    ... )
    >>> two.end_s
    0.001

    Args:
        base: The folder that its files are relative to.
        tables: Tables and keys of the scenario; `version` is 1 if left out.

    Raises:
        ScenarioError: With all faults at once.
    """
    return Scenario.from_dict({"version": 1} | tables, base)


def tables(given: Mapping[str, Any]) -> str:
    """The tables of a scenario as JSON."""
    return json.dumps(plain(given))
