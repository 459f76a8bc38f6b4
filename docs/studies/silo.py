#!/usr/bin/env python3
"""Lets a silo run out through holes of several sizes and holds the rates against Beverloo's law.

    cargo build --release && python3 docs/studies/silo.py [folder]

Fills a silo 26 grains across with 12,000 grains once, opens holes of 6 to 15 grain diameters, and prints the rates at which mass comes
out, with the fit of W = C rho_b sqrt(g) (D - k d)^(5/2). Rates are taken from 0.15 s on, until a third of the grains is out or for 0.5 s;
their standard errors are those of the mean over ten pieces of that time. The bulk density is that of a bed as high as twice its center of
mass. Some ten minutes on two cores. With a folder the picture silo-beverloo.svg is drawn into it, for which matplotlib is needed.
AGGLO names another program.
"""

import csv
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("AGGLO", ROOT / "target" / "release" / "agglo")
# Lengths in mm: a grain's diameter, the silo's radius, the least and the largest radius of a grain.
DIAMETER, RADIUS, SMALLEST, LARGEST = 4.0, 52.0, 1.9, 2.1
DENSITY, GRAVITY, GRAINS = 2500.0, 9.81, 12000
HOLES = (6, 8, 10, 12, 15)
PIECES = 10

LAWS = f"""
engine.verlet.safety = 0.25
limits = {{ strain = 0.2, drift_warning = 0.1 }}
contact.normal.hertz = {{}}
contact.damping.restitution.restitution = 0.5
contact.friction.mindlin.static_friction = 0.5
fields.gravity.acceleration = ["0 m/s2", "0 m/s2", "-{GRAVITY} m/s2"]
materials.glass = {{ density = "{DENSITY} kg/m3", youngs_modulus = "2 MPa", poisson_ratio = 0.3 }}
[[walls]]
name = "silo"
material = "glass"
shape.cylinder = {{ point = ["0 m", "0 m", "0 m"], axis = [0.0, 0.0, 1.0], radius = "{RADIUS} mm" }}
[[walls]]
name = "bottom"
material = "glass"
shape.plane = {{ point = ["0 m", "0 m", "0 m"], normal = [0.0, 0.0, 1.0]OPENING }}
"""
FILLING = f"""
[[grains]]
material = "glass"
size.uniform = {{ smallest = "{SMALLEST} mm", largest = "{LARGEST} mm" }}
[grains.placement.random]
count = {GRAINS}
region.cylinder = {{ center = ["0 m", "0 m", "90 mm"], axis = [0.0, 0.0, 1.0], radius = "{RADIUS} mm", length = "176 mm" }}
"""
# Mass of all grains [kg]: the mean cube of radii that are spread evenly.
CUBE = (LARGEST**4 - SMALLEST**4) / (4 * (LARGEST - SMALLEST)) * 1e-9
MASS = GRAINS * DENSITY * 4 / 3 * math.pi * CUBE


def run(place, name, end, top, more="", opening=""):
    """Runs a scenario of the silo, with some four hundred rows; gives the folder."""
    head = f'version = 1\ntime.end = "{end:.6g} s"\noutput = {{ series = "{end / 400:.6g} s", frames = "{end:.6g} s" }}\n'
    (place / f"{name}.toml").write_text(head + top + LAWS.replace("OPENING", opening) + more)
    done = subprocess.run(
        [PROGRAM, "run", place / f"{name}.toml", "-o", place / name, "--no-report"], capture_output=True, text=True, check=False
    )
    if done.returncode:
        sys.exit(done.stderr)
    return place / name


def rows(folder, table):
    with open(folder / f"series/{table}.csv", encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def emptied(place, hole):
    """The rate [kg/s] through a hole of so many grain diameters, its standard error, and how many grains came out meanwhile."""
    usual = 0.58 * 0.6 * DENSITY * math.sqrt(GRAVITY) * ((hole - 1.4) * DIAMETER * 1e-3) ** 2.5
    end = 0.15 + min(MASS / usual / 3, 0.5)
    opening = f', opening = {{ center = ["0 m", "0 m", "0 m"], radius = "{hole * DIAMETER / 2} mm" }}'
    folder = run(place, f"hole-{hole}", end, 'start.from = "fill"\n', opening=opening)
    out = [row for row in rows(folder, "walls") if row["wall"] == 1 and row["time_s"] >= 0.15]
    marks = [out[round(at * (len(out) - 1) / PIECES)] for at in range(PIECES + 1)]
    rates = [(b["passed_kg"] - a["passed_kg"]) / (b["time_s"] - a["time_s"]) for a, b in zip(marks, marks[1:])]
    return statistics.mean(rates), statistics.stdev(rates) / math.sqrt(PIECES), round(marks[-1]["passed"] - marks[0]["passed"])


def line(points):
    """Slope of a straight line of least squares, where it crosses zero, and the scatter about it over its rise."""
    x, y = zip(*points)
    middle, mean = statistics.mean(x), statistics.mean(y)
    slope = sum((at - middle) * (value - mean) for at, value in points) / sum((at - middle) ** 2 for at in x)
    left = [value - mean - slope * (at - middle) for at, value in points]
    scatter = math.sqrt(sum(part * part for part in left) / (len(points) - 2))
    return slope, middle - mean / slope, scatter / (max(y) - min(y))


def draw(folder, found, slope, zero):
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    with matplotlib.rc_context({"svg.hashsalt": "agglo", "svg.fonttype": "none", "font.size": 9}):
        figure, axes = plt.subplots(figsize=(5.2, 3.4), layout="constrained")
        axes.plot([zero, 16], [0, slope * (16 - zero)], color="#0072b2", label=f"line through {zero:.2f} diameters")
        axes.plot([hole for hole, *_ in found], [rate**0.4 for _, rate, *_ in found], "o", color="#d55e00", label="runs")
        axes.set(xlabel="diameter of the hole over that of a grain", ylabel="W$^{2/5}$, W in kg/s", xlim=(0, 16), ylim=(0, None))
        axes.legend()
        axes.grid(color="#e4e4e4")
        figure.savefig(pathlib.Path(folder) / "silo-beverloo.svg", metadata={"Date": None})


def main():
    with tempfile.TemporaryDirectory() as name:
        place = pathlib.Path(name)
        filled = run(place, "fill", 0.5, "", FILLING)
        density = MASS / (math.pi * (1e-3 * RADIUS) ** 2 * 2 * rows(filled, "moments")[-1]["mean_z_m"])
        found = [(hole, *emptied(place, hole)) for hole in HOLES]
    print("| hole over grain | W [kg/s] | grains |")
    print("|---|---|---|")
    for hole, rate, error, grains in found:
        print(f"| {hole} | {rate:.5g} ± {error:.2g} | {grains} |", flush=True)
    slope, zero, scatter = line([(hole, rate**0.4) for hole, rate, *_ in found])
    constant = slope**2.5 / (density * math.sqrt(GRAVITY) * (1e-3 * DIAMETER) ** 2.5)
    print("\n| bulk density [kg/m3] | k | C | scatter about the line over its rise |")
    print("|---|---|---|---|")
    print(f"| {density:.1f} | {zero:.3f} | {constant:.3f} | {scatter:.4f} |")
    if len(sys.argv) > 1:
        draw(sys.argv[1], found, slope, zero)


if __name__ == "__main__":
    main()
