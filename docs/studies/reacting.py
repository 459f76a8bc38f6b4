#!/usr/bin/env python3
"""Reacting agglomeration from many starts: the paper's six sets, one printed law at a time, and shorter steps.

    cargo build --release && python3 docs/studies/reacting.py sets|laws|breakage|steps [starts]

Prints means over the starts (seeds 1, 2, ...) with their standard errors, as the tables of docs/differences.md,
docs/validation.md and docs/convergence.md have them. For twelve starts, on one core: `sets`, `laws` and `breakage` a
minute or two each, `steps` some minutes. AGGLO names another program.
"""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("AGGLO", ROOT / "target" / "release" / "agglo")
# Zohdi (2004), table 3.
PAPER = {1: 3.2292, 2: 2.0922, 3: 2.0394, 4: 2.0043, 5: 1.9964, 6: 1.9309}
PUBLISHED = "reacting-agglomeration-published"

# Each printed law alone in an otherwise consistent model.
LAWS = {
    "consistent model": [],
    "4.14: force over compression": ["impact.restitution.hardness.force_over=compression"],
    "box, 6 b: fixed point": ["impact.restitution.hardness.solver.fixed_point.most_iterations=100"],
    "4.17: friction without a bound": ["impact.tangential.limit=published"],
    "6.8, 6.10: printed heat": ["impact.heat.balance=published"],
    "section 7: r -> -r": ["volume.boundary=antipodal"],
    "6.14 with gaps, all pairs": ["engine={time_stepped={shortest_step=\"0.1 us\"}}"],
    "6.14 as printed, all pairs": ["engine={time_stepped={shortest_step=\"0.1 us\",distance=\"centers\"}}"],
    "6.14 with gaps, nearest pairs": ["engine={time_stepped={shortest_step=\"0.1 us\",pairs=\"nearest\"}}"],
    "6.14 as printed, nearest pairs": [
        "engine={time_stepped={shortest_step=\"0.1 us\",distance=\"centers\",pairs=\"nearest\"}}"
    ],
}

WEAK = ["materials.grain.surface_energy=3 kJ/m2"]
AT_REST = ["grains.0.velocity=[\"0 m/s\",\"0 m/s\",\"0 m/s\"]"]
PRINTED = ["impact.fragmentation.energy=published"]
BREAKAGE = {
    "consistent, as shipped": WEAK,
    "consistent, seen by one who flies with the cloud": WEAK + AT_REST,
    "printed, as shipped": WEAK + PRINTED,
    "printed, seen by one who flies with the cloud": WEAK + PRINTED + AT_REST,
}

STEPS = ["30 us", "10 us", "3 us", "1 us", "0.3 us", "0.1 us"]


def run(scenario, settings, seed):
    """The summary of one run."""
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place) / "run"
        command = [PROGRAM, "run", ROOT / "scenarios" / f"{scenario}.toml", "-o", folder, "--seed", str(seed)]
        for setting in [*settings, "output.series=10 ms", "output.frames=10 ms", "output.checkpoints=10 ms"]:
            command += ["--set", setting]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(done.stderr)
        return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def mean(summaries, key):
    """The mean of a figure, with its standard error; with digits to spare, since pages round them."""
    values = [summary[key] for summary in summaries]
    error = statistics.stdev(values) / len(values) ** 0.5 if len(values) > 1 else float("nan")
    return f"{statistics.mean(values):.6g} ± {error:.4g}"


def row(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def sets(starts):
    row("set", "radius ratio", "Π", "impacts", "merges", "printed, 20 iterations", "printed, 21 iterations", "paper")
    row(*["---"] * 8)
    for number, paper in PAPER.items():
        consistent = [run(f"reacting-set-{number}", [], seed) for seed in starts]
        cells = [mean(consistent, key) for key in ("radius_ratio", "growth_deficit", "impacts", "merges")]
        for most in (20, 21):
            settings = [*as_set(number), f"impact.restitution.hardness.solver.fixed_point.most_iterations={most}"]
            cells.append(mean([run(PUBLISHED, settings, seed) for seed in starts], "radius_ratio"))
        row(number, *cells, paper)


def as_set(number):
    """The settings that make the published scenario one of the six sets."""
    import tomllib

    with open(ROOT / "scenarios" / f"reacting-set-{number}.toml", "rb") as file:
        of_set = tomllib.load(file)
    grains = of_set["grains"][0]
    settings = [f"materials.grain.{key}={value}" for key, value in of_set["materials"]["grain"].items()]
    settings.append(f"grains.0.temperature={grains['temperature']}")
    settings.append(f"grains.0.size.length_ratio.ratio={grains['size']['length_ratio']['ratio']}")
    bounds = json.dumps(grains["velocity_spread"]["uniform"]["bounds"])
    settings.append(f"grains.0.velocity_spread.uniform.bounds={bounds}")
    settings.append(f"impact.tangential.friction={of_set['impact']['tangential']['friction']}")
    return settings


def laws(starts):
    row("law that is printed", "set 1: radius ratio", "merges", "set 6: radius ratio", "merges")
    row(*["---"] * 5)
    for name, settings in LAWS.items():
        found = [[run(f"reacting-set-{number}", settings, seed) for seed in starts] for number in (1, 6)]
        row(name, *(mean(of_set, key) for of_set in found for key in ("radius_ratio", "merges")))


def breakage(starts):
    row("breaking energy", "breakages", "radius ratio", "largest, in primaries")
    row(*["---"] * 4)
    for name, settings in BREAKAGE.items():
        found = [run("reacting-set-1", settings, seed) for seed in starts]
        row(name, *(mean(found, key) for key in ("fragmentations", "radius_ratio", "largest_primaries")))


def steps(starts):
    row("engine", "shortest step", "set 1: radius ratio", "impacts", "set 6: radius ratio", "impacts")
    row(*["---"] * 6)
    engines = [("time_stepped", step, [f"engine={{time_stepped={{shortest_step=\"{step}\"}}}}"]) for step in STEPS]
    for engine, step, settings in [*engines, ("event_driven", "none", [])]:
        found = [[run(f"reacting-set-{number}", settings, seed) for seed in starts] for number in (1, 6)]
        row(engine, step, *(mean(of_set, key) for of_set in found for key in ("radius_ratio", "impacts")))


def main():
    choices = {"sets": sets, "laws": laws, "breakage": breakage, "steps": steps}
    if len(sys.argv) < 2 or sys.argv[1] not in choices:
        sys.exit(f"one of {', '.join(choices)} is wanted")
    starts = int(sys.argv[2]) if len(sys.argv) > 2 else 12
    choices[sys.argv[1]](range(1, starts + 1))


if __name__ == "__main__":
    main()
