#!/usr/bin/env python3
"""Measures again what the pages tell: runs a measurement's command and writes its values to docs/measured/values/NAME.toml.

    cargo build --release
    python3 docs/measured/measure.py                          # lists the measurements
    python3 docs/measured/measure.py acoustic-dispersal-published sets  # measures these again, and says what has changed
    python3 docs/measured/measure.py --check README           # all that this page tells of; writes nothing, ends with 1 if one has changed

`tests/python/test_figures.py` says then which lines of the pages are no longer right. AGGLO names another program; the
measurements `tests`, `six-sets` and `medians` build their own. Values of `speed` are typed in by hand from what its commands print: they
depend on the machine and on what else it does.
"""

import csv
import datetime
import json
import os
import platform
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def program():
    return os.environ.get("AGGLO", str(ROOT / "target/release/agglo"))


class Run:
    """A run of agglo in a folder of its own: its summary and its tables."""

    def __init__(self, folder, command):
        words = shlex.split(command)
        self.folder = Path(folder) / "out"
        done = subprocess.run([program(), *words[1:], "-o", self.folder, "--no-report"], cwd=ROOT, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"{command}\n{done.stderr}")
        self.summary = json.loads((self.folder / "summary.json").read_text())

    def table(self, name):
        with open(self.folder / f"series/{name}.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def at(self, name, column, time):
        """A figure of a table in the last row up to a time [s]."""
        return float([row for row in self.table(name) if float(row["time_s"]) <= time * (1 + 1e-9)][-1][column])


def study(command):
    """The rows of the table that a study prints: cells `a ± b` as two numbers."""
    words = shlex.split(command)
    done = subprocess.run([sys.executable, *words[1:]], cwd=ROOT, capture_output=True, text=True, check=False, env={**os.environ, "AGGLO": program()})
    if done.returncode:
        sys.exit(f"{command}\n{done.stderr}")
    return {"rows": rows(done.stdout)}


def silo():
    """Rates of the holes, and what the second table says of the line through them."""
    found = study(SILO)["rows"]
    density, zero, constant, scatter = found[-1]
    return {"rows": [row for row in found if isinstance(row[0], float)][:-1], "density": density, "k": zero, "C": constant, "scatter": scatter}


def rows(printed):
    lines = [line for line in printed.splitlines() if line.startswith("|")][2:]
    return [[cell_value(cell.strip()) for cell in line.strip("|").split(" | ")] for line in lines]


def cell_value(cell):
    numbers = cell.split(" ± ")
    try:
        found = [float(number) for number in numbers]
    except ValueError:
        return cell
    return found if len(found) == 2 else found[0]


def reflections(run):
    return [pulse["reflections"] for pulse in run.summary["pulses"]]


def blocked(run):
    return sum(times for text, times in run.summary["warnings"].items() if "started inside a grain" in text)


def acoustic_dispersal_published(run):
    return {
        "reflections": reflections(run),
        "segments": [pulse["segments"] for pulse in run.summary["pulses"]],
        "steps": run.summary["steps"],
        "blocked": blocked(run),
        "degree_after_pulses": [run.at("clusters", "dispersion_degree", 0.5 * number) for number in (1, 2, 3, 4)],
        "gyration_end_m": run.at("clusters", "radius_of_gyration_m", 2.0),
        "beam_x_4_ms": run.at("rays", "beam_x", 4.01e-3),
        "beam_magnitude_4_ms": run.at("rays", "beam_magnitude", 4.01e-3),
        "flying_x_4_ms": run.at("rays", "flying_x", 4.01e-3),
        "flying_magnitude_4_ms": run.at("rays", "flying_magnitude", 4.01e-3),
        "mean_speed_m_s": run.at("moments", "mean_speed_m_s", 0.5),
    }


def acoustic_dispersal(run):
    summary = run.summary
    return {
        "reflections": reflections(run),
        "steps": summary["steps"],
        "blocked": blocked(run),
        "bonds_start": summary["bonds_start"],
        "bonds_end": summary["bonds_end"],
        "drift_J": summary["energy"]["drift_J"],
        "work_rays_J": summary["energy"]["work_rays_J"],
    }


def ink(run):
    return {"reflections": reflections(run), "steps": run.summary["steps"], "grains": run.summary["grains"]}


SUMMARY_OF_GROWTH = (
    "grains_start", "grains_end", "impacts", "merges", "fragmentations", "tc_bounces", "impacts_overlapping", "radius_ratio",
    "largest_primaries", "largest_radius_m", "self_gravity_radius_m", "steps",
)  # fmt: skip


def growth(run):
    return {key: run.summary[key] for key in SUMMARY_OF_GROWTH}


def early_growth(run):
    table = {round(float(row["time_s"]) * 1e6): int(row["grains"]) for row in run.table("grains")}
    return {f"grains_{time}_us": table[time] for time in (10, 50)}


def false_heat(run):
    energy = run.summary["energy"]
    lost = energy["lost_normal_J"] + energy["lost_friction_J"]
    return {"lost_J": lost, "heat_J": energy["heat_J"], "unbalanced_J": energy["unbalanced_J"]}


def first_pulse(run):
    return {"reflections": run.summary["pulses"][0]["reflections"], "bonds_start": run.summary["bonds_start"]}


SEARCHED = {
    "v_m_s": 200.0, "length_ratio": 1.0, "density_kg_m3": 1e4, "hardness_Pa": 1e6, "heat_capacity_J_kg_K": 2000.0, "friction": 0.01,
    "temperature_K": 1000.0, "activation_energy_J_mol": 1000.0, "reaction_heat_J_m2": 1e14, "surface_energy_J_m2": 1e16,
}  # fmt: skip


def search(run):
    """The best candidates in the units of the paper's tables; rows of the table in docs/search.md."""
    with open(run.folder / "best.csv", encoding="utf-8") as file:
        best = list(csv.DictReader(file))
    with open(run.folder / "generations.csv", encoding="utf-8") as file:
        generations = [row for row in csv.DictReader(file) if row["stage"] == "search"]
    stages = run.summary["stages"]
    first = best[0]
    return {
        "runs": run.summary["runs"],
        "runs_search": stages[0]["runs"],
        "candidates_search": stages[0]["candidates"],
        "candidates": stages[0]["candidates"] + stages[1]["candidates"],
        "cost": [float(first["final_cost"]), float(first["final_cost_standard_error"])],
        "search_cost": [float(first["search_cost"]), float(first["search_cost_standard_error"])],
        "lowest_search_cost": [float(generations[-1]["best_cost"]), float(generations[-1]["best_cost_standard_error"])],
        "replicates": int(first["final_replicates"]),
        "generations": len(generations) - 1,
        "paper_passed_in": next(int(row["generation"]) for row in generations if float(row["best_cost"]) < 0.677),
        "best": [[float(row[key]) / unit for key, unit in SEARCHED.items()] for row in best],
        "best_costs": [[float(row["cost"]), float(row["cost_standard_error"])] for row in best],
    }


def from_tests(command):
    """What tests note down."""
    with tempfile.TemporaryDirectory() as place:
        notes = Path(place) / "found"
        # One test at a time, so that lines keep their order.
        words = [*shlex.split(command), "--test-threads=1"]
        subprocess.run(words, cwd=ROOT, check=True, env={**os.environ, "AGGLO_FOUND": str(notes)}, stdout=subprocess.DEVNULL)
        return noted(notes.read_text())


def noted(text):
    """Lines of notes, each a case with its figures; these become lists in the order in which they were found."""
    found = {}
    for line in sorted(text.splitlines(), key=lambda line: line.split()[0]):
        case, *figures = line.split(" ")
        for figure in figures:
            name, value = figure.split("=")
            found.setdefault(f"{case}_{name}".replace(".", "_"), []).append(float(value))
    return found


def medians(printed):
    """What optimizers find on test functions: Rastrigin, Ackley and Griewank, the noisy and the exact value in turn."""
    found = {}
    for line in printed.splitlines()[1:]:
        name, *values = re.split(r"\s{2,}|(?<=\d) (?=\d)", line.strip())
        key = "_".join(re.findall(r"\w+", name))
        found[key] = [float(values[at]) for at in (0, 2, 4)]
    return found


def printed_by(command):
    return subprocess.run(shlex.split(command), cwd=ROOT, capture_output=True, text=True, check=True).stdout


def of_run(command, values):
    """A measurement that is a run, search or study."""

    def measure():
        with tempfile.TemporaryDirectory() as place:
            return values(Run(place, command))

    return command, measure


SET_6 = "agglo run scenarios/reacting-set-6.toml --set impact.heat.balance=published --set 'materials.grain.reaction_heat=0 J/m2'"
SHORT = "--set 'time.end=20 ms' --set acoustics.beams.0.pulses.count=1"
TESTS = "cargo test -q -p agglo --test val_soft --test val_rays --test val_hard --test contract --"
SIX_SETS = "cargo test -q --release -p agglo --test val_hard val_zohdi_2004_growth_of_six_sets -- --ignored"
MEDIANS = "cargo run -q --release -p agglo --example test_functions -- 20"
REACTING = "python3 docs/studies/reacting.py"
HALVING = "python3 docs/studies/halving.py 5"
SILO = "python3 docs/studies/silo.py"

MEASUREMENTS = {
    "acoustic-dispersal-published": of_run("agglo run scenarios/acoustic-dispersal-published.toml", acoustic_dispersal_published),
    "acoustic-dispersal": of_run("agglo run scenarios/acoustic-dispersal.toml", acoustic_dispersal),
    "ink-agglomerate": of_run("agglo run scenarios/ink-agglomerate.toml", ink),
    "first-pulse": of_run(f"agglo run scenarios/acoustic-dispersal-published.toml {SHORT}", first_pulse),
    "bonds-at-start": of_run("agglo run scenarios/acoustic-dispersal.toml --set 'time.end=0.1 ms'", first_pulse),
    "reacting-agglomeration": of_run("agglo run scenarios/reacting-agglomeration.toml", growth),
    "reacting-early": of_run("agglo run scenarios/reacting-agglomeration.toml --set 'time.end=0.1 ms' --set 'output.series=5 us'", early_growth),
    "set-1-weak": of_run(
        "agglo run scenarios/reacting-set-1.toml --set 'materials.grain.surface_energy=1 J/m2' --set 'time.end=2 ms'", growth
    ),
    "set-6-heat": of_run(f"{SET_6} --set materials.grain.emissivity=0.0", false_heat),
    "search": of_run("agglo search scenarios/search-agglomeration.toml", search),
    "search-100": of_run("agglo search scenarios/search-agglomeration.toml --set method.published_genetic.generations=100", search),
    "sets": (f"{REACTING} sets 12", lambda: study(f"{REACTING} sets 12")),
    "laws": (f"{REACTING} laws 12", lambda: study(f"{REACTING} laws 12")),
    "breakage": (f"{REACTING} breakage 12", lambda: study(f"{REACTING} breakage 12")),
    "steps": (f"{REACTING} steps 12", lambda: study(f"{REACTING} steps 12")),
    "halving": (HALVING, lambda: study(HALVING)),
    "silo": (SILO, silo),
    "tests": (TESTS, lambda: from_tests(TESTS)),
    "six-sets": (SIX_SETS, lambda: from_tests(SIX_SETS)),
    "medians": (MEDIANS, lambda: medians(printed_by(MEDIANS))),
}

# Below some seconds each: tests/python/test_figures.py measures these every time.
QUICK = ("first-pulse", "bonds-at-start", "reacting-agglomeration", "reacting-early", "set-1-weak", "set-6-heat")


def text(value):
    """A value in TOML."""
    if isinstance(value, list):
        return "[" + ", ".join(text(part) for part in value) + "]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def stored(name):
    path = HERE / f"values/{name}.toml"
    return tomllib.loads(path.read_text()) if path.exists() else {"values": {}}


def write(name, command, values):
    day = datetime.date.today().isoformat()
    version = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]["version"]
    lines = [
        f"# Written by `python3 docs/measured/measure.py {name}`.",
        f"command = {text(command)}",
        f'date = "{day}"',
        f'version = "{version}"',
        f'machine = "{platform.machine()}, {os.cpu_count()} cores"',
        "",
        "[values]",
    ]
    for key, value in values.items():
        if isinstance(value, list) and value and isinstance(value[0], list):
            lines += [f"{key} = ["] + [f"    {text(row)}," for row in value] + ["]"]
        else:
            lines.append(f"{key} = {text(value)}")
    (HERE / f"values/{name}.toml").write_text("\n".join(lines) + "\n")


def named_by(page):
    """The measurements that the file of a page names; a measurement itself."""
    if page in MEASUREMENTS:
        return [page]
    text = (HERE / f"pages/{page}.toml").read_text(encoding="utf-8")
    return [name for name in MEASUREMENTS if f'measured = "{name}"' in text or f"of('{name}')" in text]


def main():
    names = sys.argv[1:]
    is_check = names[:1] == ["--check"]
    if is_check:
        names = [name for page in names[1:] for name in named_by(page)]
    unknown = [name for name in names if name not in MEASUREMENTS]
    if unknown or not names:
        for name, (command, _) in MEASUREMENTS.items():
            print(f"{name:26} {command}")
        sys.exit(f"{', '.join(unknown)}: not one of these" if unknown else 0)
    has_changed = False
    for name in names:
        command, measure = MEASUREMENTS[name]
        before, values = stored(name)["values"], measure()
        if not is_check:
            write(name, command, values)
        changed = [key for key in values if before.get(key) != values[key]]
        has_changed |= bool(changed)
        print(f"{name}: {'as before' if not changed else ''}", flush=True)
        for key in changed:
            print(f"  {key}: {before.get(key, 'new')} -> {values[key]}")
    sys.exit(is_check and has_changed)


if __name__ == "__main__":
    main()
