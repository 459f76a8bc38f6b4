#!/usr/bin/env python3
"""Halves the step of the two sample problems and prints what becomes of the dispersal.

    cargo build --release && python3 docs/studies/halving.py [starts]

Runs both sample problems to 0.5 s, that is one pulse and what follows from it, from several starts (seeds) and with
three steps, and prints means with their standard errors. About two minutes on two cores for five starts. AGGLO names
another program.
"""

import csv
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("AGGLO", ROOT / "target" / "release" / "agglo")
SCENARIOS = {
    "consistent laws": (
        "acoustic-dispersal",
        lambda part: [f"engine.verlet.safety={0.1 * part}"],
    ),
    "published laws": (
        "acoustic-dispersal-published",
        lambda part: [
            f"acoustics.force.published_step.step_fraction={0.1 * part}",
            f"engine.staggered.largest_step={0.25 * part} ms",
        ],
    ),
}


def last(folder, table, column):
    with open(folder / "series" / f"{table}.csv", encoding="utf-8") as file:
        return float(list(csv.DictReader(file))[-1][column])


def run(scenario, settings, seed):
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place) / "run"
        command = [PROGRAM, "run", ROOT / "scenarios" / f"{scenario}.toml", "-o", folder, "--seed", str(seed)]
        for setting in [*settings, "time.end=0.499 s", "measures.cluster_gap=0.5", "output.frames=1 s"]:
            command += ["--set", setting]
        subprocess.run(command, check=True, capture_output=True)
        return [
            last(folder, "clusters", "dispersion_degree"),
            last(folder, "clusters", "radius_of_gyration_m"),
            last(folder, "energy", "kinetic_J"),
        ]


def main():
    starts = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    print("| laws | step | dispersion degree | radius of gyration [m] | kinetic energy [J] |")
    print("|---|---|---|---|---|")
    for name, (scenario, settings) in SCENARIOS.items():
        for halvings in range(3):
            found = [run(scenario, settings(0.5**halvings), seed) for seed in range(1, starts + 1)]
            cells = []
            for values in zip(*found):
                error = statistics.stdev(values) / len(values) ** 0.5 if len(values) > 1 else float("nan")
                cells.append(f"{statistics.mean(values):.4g} ± {error:.2g}")
            step = "as shipped" if halvings == 0 else f"1/{2**halvings}"
            print(f"| {name} | {step} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
