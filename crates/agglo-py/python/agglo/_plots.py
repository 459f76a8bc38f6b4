"""Charts of runs with matplotlib, in the look of the report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from agglo._errors import InputError
from agglo._optional import need
from agglo._tables import Table
from agglo._types import Floats

if TYPE_CHECKING:
    from agglo._results import Run

# The report's colors and dashes (crates/agglo-view/src/plot/color.rs): M. Okabe and K. Ito, Color universal design (2008).
LINES: list[tuple[str, Any]] = [
    ("#0072b2", "-"),
    ("#d55e00", (0, (5, 2))),
    ("#009e73", (0, (1.5, 1.5))),
    ("#cc79a7", (0, (6, 2, 1.5, 2))),
    ("#e69f00", (0, (3, 3))),
    ("#56b4e9", (0, (1, 2.5))),
]
INK, GREY, GRID = "#222222", "#999999", "#e4e4e4"

LOOK = {
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "axes.titlelocation": "left",
    "axes.titlesize": 11,
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "font.size": 9,
    "grid.color": GRID,
    "image.cmap": "viridis",
    "legend.edgecolor": "none",
    "legend.framealpha": 0.8,
    "lines.linewidth": 1.6,
    "lines.scale_dashes": False,
    "svg.fonttype": "none",
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
}


def style() -> dict[str, Any]:
    """Settings of matplotlib with which charts look as those of the report, for `matplotlib.rc_context`.

    Lines with the same number have the same color and dashes.

    Raises:
        PackageError: matplotlib is not installed.
    """
    colors, dashes = zip(*LINES)
    return {**LOOK, "axes.prop_cycle": need("matplotlib", "plot_style").cycler(color=colors, linestyle=dashes)}


@dataclass(frozen=True)
class Chart:
    """What is drawn over time: columns of a table with what they are called."""

    title: str
    label: str
    table: str
    lines: dict[str, str]


# The words are those of the report (crates/agglo/src/run/soft/panels.rs and run/hard/panels.rs).
_STORES = {
    "kinetic_J": "motion",
    "rotational_J": "rotation",
    "elastic_J": "contacts",
    "tangential_spring_J": "tangential springs",
    "bonds_J": "bonds",
    "near_field_J": "near field",
    "fields_J": "fields",
}
_FLOWS = {
    "work_rays_J": "put in by rays",
    "work_gravity_J": "put in by gravity",
    "work_fields_J": "put in by fields",
    "work_volume_J": "put in by the volume",
    "work_custom_J": "put in by custom laws",
    "work_walls_J": "put in by walls",
    "lost_drag_J": "lost to drag",
    "lost_contact_damping_J": "lost in contacts",
    "lost_friction_J": "lost to friction",
    "lost_bond_damping_J": "lost in bonds",
    "lost_broken_bonds_J": "lost with broken bonds",
    "lost_absorbed_J": "lost with grains that left",
    "drift_J": "not explained",
}
_BEAM = {"magnitude": "in all", "x": "along x", "y": "along y", "z": "along z"}
_POWER = {
    "power_in_W": "launched",
    "power_absorbed_W": "absorbed",
    "power_into_walls_W": "taken up by walls",
    "power_escaped_W": "left",
    "power_truncated_W": "dropped",
    "power_cut_off_W": "cut off",
}
_SOFT = {
    "dispersion": Chart(
        "Dispersion", "part of the mass", "clusters",
        {"largest_fraction": "largest cluster", "dispersion_degree": "dispersion degree",
         "dispersion_degree_relative": "relative to the start"},
    ),
    "clusters": Chart(
        "Clusters, contacts and bonds", "how many", "clusters", {name: name for name in ("clusters", "contacts", "bonds")}
    ),
    "stores": Chart("Energy: where it is", "energy (J)", "energy", _STORES),
    "flows": Chart("Energy: put in and lost", "energy (J)", "energy", _FLOWS),
    "rays": Chart("Rays", "how many", "rays", {"in_flight": "in flight", "reflections": "reflections", "segments": "segments"}),
    "beam": Chart("Beam power left", "part of the pulse's power", "rays", {f"beam_{end}": words for end, words in _BEAM.items()}),
    "flying": Chart(
        "Power in flight", "part of the pulse's power", "rays", {f"flying_{end}": words for end, words in _BEAM.items()}
    ),
    "power": Chart("Power of the pulses", "power (W)", "rays", _POWER),
    "speed": Chart("Speed", "speed (m/s)", "moments", {"mean_speed_m_s": "mean", "largest_speed_m_s": "largest"}),
    "step": Chart("Step size", "step (s)", "steps", {"step_size_s": "step"}),
    "walls": Chart("Force on walls", "force (N)", "walls", {f"force_{axis}_N": axis for axis in "xyz"}),
    "wall_work": Chart("Work of walls", "work (J)", "walls", {"work_J": "work"}),
    "passed": Chart("Out through openings", "mass (kg)", "walls", {"passed_kg": "mass"}),
}  # fmt: skip
_HARD = {
    "growth": Chart("Growth", "over the mean radius at the start", "grains", {"radius_ratio": "mean radius"}),
    "grains": Chart("Grains left", "how many", "grains", {"grains": "grains"}),
    "sizes": Chart("Sizes over time", "primaries in a grain", "sizes", {}),
    "impacts": Chart(
        "Impacts", "so far", "impacts",
        {"impacts": "impacts", "bounces": "bounces", "merges": "merges", "fragmentations": "breakages"},
    ),
    "energy": Chart(
        "Kinetic energy and where it went", "energy (J)", "energy",
        {"kinetic_J": "motion", "lost_normal_J": "lost along normals", "lost_friction_J": "lost to friction"},
    ),
    "heat": Chart(
        "Heat", "energy (J)", "energy",
        {"thermal_J": "in warm grains", "reaction_J": "set free by reactions", "heat_J": "heat of impacts",
         "surface_J": "new surfaces", "cooled_J": "given off"},
    ),
    "largest": Chart("The largest grain", "primaries", "grains", {"largest_primaries": "primaries"}),
    "temperature": Chart(
        "Temperature", "temperature (K)", "grains",
        {"mean_temperature_K": "mean", "lowest_temperature_K": "lowest", "highest_temperature_K": "highest"},
    ),
    "speed": Chart("Speed", "speed (m/s)", "grains", {"mean_speed_m_s": "mean", "largest_speed_m_s": "largest"}),
    "step": Chart("Step size", "step (s)", "steps", {"step_size_s": "step"}),
}  # fmt: skip

# What is shown if nothing is asked for.
_MOST_OF_SOFT = ["dispersion", "clusters", "stores", "flows", "rays", "speed"]
_MOST_OF_HARD = ["growth", "grains", "sizes", "impacts", "energy", "heat"]


def run(found: Run, names: Sequence[str] | None = None) -> Any:
    """Charts of a run: see `Run.plot`."""
    is_hard = found.scenario.is_hard
    known = _HARD if is_hard else _SOFT
    if names is None:
        names = _MOST_OF_HARD if is_hard else _MOST_OF_SOFT
        if "rays" in names and not np.any(found.table("rays")["pulses"] > 0):
            names = [name for name in names if name != "rays"]
        if "walls" in found.tables:
            has_opening = np.any(np.isfinite(found.table("walls")["passed_kg"]))
            names = [*names, "walls", *(["passed"] if has_opening else [])]
    names = [names] if isinstance(names, str) else list(names)
    for name in names:
        if name not in known:
            raise InputError(f"there is no chart {name!r}; there are {', '.join(known)}")
        if known[name].table == "walls" and "walls" not in found.tables:
            raise InputError(f"there is no chart {name!r}: the run has no walls")
    figure, panels = figure_of(len(names))
    for axes, name in zip(panels, names):
        chart, table = known[name], found.table(known[name].table)
        if chart.table == "walls":
            _walls(axes, chart, table, [wall["name"] for wall in found.scenario.to_dict()["walls"]])
        else:
            (_sizes if name == "sizes" else _lines)(figure, axes, chart, table)
    figure.suptitle(found.scenario.title, x=0.01, ha="left")
    return figure


def figure_of(count: int) -> tuple[Any, list[Any]]:
    """A Figure with so many panels, two or three in a row, in the look of the report."""
    matplotlib, pyplot = need("matplotlib", "plots"), need("matplotlib.pyplot", "plots")
    columns = 1 if count == 1 else 2 if count in (2, 4) else 3
    rows = -(-count // columns)
    with matplotlib.rc_context(LOOK):
        figure = pyplot.figure(figsize=(4.4 * columns, 3.1 * rows + 0.3), layout="constrained")
        panels = [figure.add_subplot(rows, columns, at + 1) for at in range(count)]
    # A notebook shows what a cell gives, and would show an open figure besides.
    if "inline" in matplotlib.get_backend():
        pyplot.close(figure)
    return figure, panels


def time_of(seconds: Floats) -> tuple[Floats, str]:
    """Times in a unit that gives numbers of about 1 to 1000, and its name."""
    largest = float(np.max(np.abs(seconds), initial=0.0))
    for unit, name in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if largest >= unit:
            return seconds / unit, name
    return seconds / 1e-9, "ns"


def _lines(figure: Any, axes: Any, chart: Chart, table: Table) -> None:
    shown = {words: (table["time_s"], table[name]) for name, words in chart.lines.items() if name in table}
    _curves(axes, chart, shown)


def _walls(axes: Any, chart: Chart, table: Table, names: Sequence[str]) -> None:
    """A line for each wall; of a vector its length."""
    rows = [table["wall"] == number for number in range(len(names))]
    parts = [table[column] for column in chart.lines]
    values = parts[0] if len(parts) == 1 else np.sqrt(np.sum(np.square(parts), axis=0))
    _curves(axes, chart, {name: (table["time_s"][own], values[own]) for name, own in zip(names, rows)})


def _curves(axes: Any, chart: Chart, lines: Mapping[str, tuple[Floats, Floats]]) -> None:
    """Curves by their names: times and values; what was nothing all along is left out."""
    shown = {words: line for words, line in lines.items() if np.any(np.nan_to_num(line[1]) != 0.0)}
    _, unit = time_of(np.concatenate([time for time, _ in lines.values()] or [np.zeros(0)]))
    factor = {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "ns": 1e-9}[unit]
    with need("matplotlib", "plots").rc_context(LOOK):
        for (words, (time, values)), (color, dashes) in zip(shown.items(), LINES * 2):
            # The seventh line and those after it have the colors of the first ones, and are thin.
            width = 1.6 if len(axes.lines) < len(LINES) else 0.8
            axes.plot(time / factor, values, color=color, linestyle=dashes, linewidth=width, label=words)
        axes.set(title=chart.title, xlabel=f"time ({unit})", ylabel=chart.label)
        axes.ticklabel_format(axis="y", style="sci", scilimits=(-3, 5))
        if len(shown) > 1:
            axes.legend(fontsize=8, handlelength=2.6)


def _class(low: float, high: float) -> str:
    """The primaries of a class in words; one without an end has no last number."""
    if np.isnan(high):
        return f"{low:g} and more"
    return f"{low:g}" if low == high else f"{low:g}–{high:g}"


def _sizes(figure: Any, axes: Any, chart: Chart, table: Table) -> None:
    """How much of the mass is in each class, over time."""
    times, column = np.unique(table["time_s"], return_inverse=True)
    lower, row = np.unique(table["lower_primaries"], return_inverse=True)
    upper = {low: high for low, high in zip(table["lower_primaries"], table["upper_primaries"])}
    parts = np.zeros((len(lower), len(times)))
    parts[row, column] = table["mass_fraction"]
    shown, unit = time_of(times)
    with need("matplotlib", "plots").rc_context(LOOK):
        axes.grid(False)
        mesh = axes.pcolormesh(shown, np.arange(len(lower)), parts, shading="nearest", vmin=0.0, rasterized=True)
        figure.colorbar(mesh, ax=axes, label="part of the mass")
        axes.set_yticks(range(len(lower)), [_class(low, upper[low]) for low in lower])
        axes.set(title=chart.title, xlabel=f"time ({unit})", ylabel=chart.label)
