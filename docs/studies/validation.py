#!/usr/bin/env python3
"""Draws the plots of docs/validation.md from runs of agglo, each beside what it is held to.

    cargo build --release
    target/venv/bin/pip install -r docs/pictures/requirements.txt
    target/venv/bin/python docs/studies/validation.py            # all plots; some minutes on two cores
    target/venv/bin/python docs/studies/validation.py haff rays  # these only

AGGLO names another program. Plots go to docs/pictures/validation/, runs to a temporary folder. What is expected is
computed here from closed forms, apart from agglo, or is a published figure that is named beside it.
"""

import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import reacting  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "docs/pictures/validation"
PROGRAM = os.environ.get("AGGLO", ROOT / "target/release/agglo")

# Okabe and Ito's colors, which the color-blind tell apart.
BLACK, ORANGE, SKY, GREEN, BLUE, VERMILION = "#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#D55E00"


class Run:
    """A run of agglo in a folder that is gone afterwards: its summary and its tables."""

    def __init__(self, text, *tables, settings=(), seed=1):
        with tempfile.TemporaryDirectory() as place:
            file, folder = Path(place) / "case.toml", Path(place) / "run"
            file.write_text(text)
            command = [PROGRAM, "run", file, "-o", folder, "--seed", str(seed)]
            for setting in settings:
                command += ["--set", setting]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode:
                sys.exit(f"{text}\n{done.stderr}")
            self.summary = json.loads((folder / "summary.json").read_text())
            self.tables = {name: columns(folder / "series" / f"{name}.csv") for name in tables}
            self.last_frame = read_frame(sorted((folder / "frames").glob("grains_*.vtp"))[-1])


def columns(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def read_frame(path):
    """Places and velocities of the grains of a frame."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    places = vtk_to_numpy(data.GetPoints().GetData()).copy()
    return places, vtk_to_numpy(data.GetPointData().GetArray("velocity_m_s")).copy()


def figure(width=6.4, height=3.9, panels=1, **more):
    made, axes = plt.subplots(1, panels, figsize=(width, height), layout="constrained", **more)
    for axis in np.atleast_1d(axes):
        axis.spines[["top", "right"]].set_visible(False)
        axis.grid(color="#dddddd", linewidth=0.6)
        axis.set_axisbelow(True)
    return made, axes


def save(made, name):
    PICTURES.mkdir(exist_ok=True)
    plt.rcParams["svg.hashsalt"] = name
    made.savefig(PICTURES / f"{name}.svg", metadata={"Date": None})
    plt.close(made)
    print(PICTURES / f"{name}.svg", flush=True)


def two_grains(material, radius, speed, end, more, engine="[engine.verlet]\nsafety = 0.02", gap=0.0):
    """Two equal grains that approach each other along x, each with this speed."""
    group = f'[[grains]]\nmaterial = "grain"\nsize.constant.radius = "{radius} m"\n'
    groups = ""
    for side in (-1, 1):
        groups += f'{group}velocity = ["{-side * speed} m/s", "0 m/s", "0 m/s"]\n'
        groups += f'placement.list.positions = [["{side * (radius + gap / 2):.17g} m", "0 m", "0 m"]]\n'
    head = f'version = 1\ntime.end = "{end} s"\n{engine}\n[materials.grain]\n{material}\n'
    return head + groups + more


def hertz_overlap(modulus, poisson, density, radius, speed):
    """Overlap over time of two equal elastic spheres, by Runge and Kutta's fourth order."""
    mass = 4 / 3 * np.pi * radius**3 * density / 2
    stiffness = 4 / 3 * modulus / (2 * (1 - poisson**2)) * np.sqrt(radius / 2)

    def slope(state):
        return np.array([state[1], -stiffness / mass * max(state[0], 0.0) ** 1.5])

    step, state, path = 1e-8, np.array([0.0, 2 * speed]), [(0.0, 0.0)]
    while state[0] >= 0.0:
        a = slope(state)
        b = slope(state + step / 2 * a)
        c = slope(state + step / 2 * b)
        d = slope(state + step * c)
        state = state + step / 6 * (a + 2 * b + 2 * c + d)
        path.append((path[-1][0] + step, state[0]))
    return np.array(path).T


def hertz():
    """Chung and Ooi (2011), test 1: two spheres meet head-on."""
    made, axis = figure()
    cases = [
        ("glass", 2800, 48e9, 0.20, (274.11e-6, 40.34e-6), BLUE),
        ("limestone", 2500, 20e9, 0.25, (368.30e-6, 54.20e-6), VERMILION),
    ]
    for name, density, modulus, poisson, (largest, duration), color in cases:
        material = f'density = "{density} kg/m3"\nyoungs_modulus = "{modulus} Pa"\npoisson_ratio = {poisson}\n'
        more = '[contact.normal.hertz]\n[output]\nseries = "1.5 us"\n'
        run = Run(two_grains(material, 0.01, 10.0, 60e-6, more), "steps")
        steps = run.tables["steps"]
        time, overlap = hertz_overlap(modulus, poisson, density, 0.01, 10.0)
        axis.plot(time * 1e6, overlap * 1e6, color=color, linewidth=1.2, label=f"{name}: Hertz, integrated here")
        axis.plot(steps["time_s"] * 1e6, steps["largest_strain"] * 0.02 * 1e6, "o", ms=4, color=color, label=f"{name}: agglo")
        axis.plot([duration * 1e6], [0], "|", ms=14, mew=2, color=BLACK)
        axis.axhline(largest * 1e6, color=BLACK, linewidth=0.8, linestyle=":")
    axis.set(xlabel="time [µs]", ylabel="overlap [µm]", xlim=(-3, 112), title="Two spheres of 10 mm meet at ±10 m/s")
    axis.plot([], [], color=BLACK, linestyle=":", label="largest overlap and (bars) duration,\nChung and Ooi (2011), test 1")
    axis.legend(frameon=False, fontsize=8, loc="center right")
    save(made, "hertz")


def restitution():
    """What comes out against what was asked for, for three elastic laws."""
    made, (axis, error) = figure(8.6, 3.7, 2)
    asked = np.array([0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
    laws = [
        ("hertz", "[contact.normal.hertz]", BLUE, "o"),
        ("hooke", '[contact.normal.hooke]\nstiffness = "10 MN/m"', VERMILION, "s"),
    ]
    material = 'density = "4000 kg/m3"\nyoungs_modulus = "380 GPa"\npoisson_ratio = 0.23\n'
    for name, law, color, marker in laws:
        found = []
        for wanted in asked:
            more = f'{law}\n[contact.damping.restitution]\nrestitution = {wanted}\n'
            engine = "[engine.verlet]\nsafety = 0.002"
            run = Run(two_grains(material, 0.0025, 1.95, 1e-4, more, engine, gap=1e-7), "moments")
            speeds = run.tables["moments"]["mean_speed_m_s"]
            found.append(speeds[-1] / speeds[0])
        axis.plot(asked, found, marker, color=color, ms=5, label=f"agglo, {name}", fillstyle="none")
        error.semilogy(asked, np.abs(np.array(found) - asked) + 1e-12, marker, color=color, label=f"agglo, {name}", fillstyle="none")
    axis.plot([0, 1], [0, 1], color=BLACK, linewidth=0.8, label="what was asked for")
    axis.set(xlabel="restitution asked for", ylabel="restitution found")
    error.axhline(1e-3, color=BLACK, linestyle=":", label="tolerance of the test")
    error.set(xlabel="restitution asked for", ylabel="found less asked for, without sign", ylim=(1e-8, 1e-1))
    for panel in (axis, error):
        panel.legend(frameon=False, fontsize=8)
    save(made, "restitution")


def before_a_plane(angle, more):
    """An alumina sphere flies at 3.9 m/s against a sphere of ten thousand times its radius, at an angle to the normal."""
    radius = 0.0025
    plane = 1e4 * radius
    fast = [-3.9 * np.cos(angle), 3.9 * np.sin(angle)]
    return f"""version = 1
time.end = "60 us"
[engine.verlet]
step = "5 ns"
[materials.alumina]
density = "4000 kg/m3"
youngs_modulus = "380 GPa"
poisson_ratio = 0.23
[materials.glass]
density = "1e6 kg/m3"
youngs_modulus = "70 GPa"
poisson_ratio = 0.25
[[grains]]
material = "alumina"
size.constant.radius = "{radius} m"
velocity = ["{fast[0]:.17g} m/s", "{fast[1]:.17g} m/s", "0 m/s"]
placement.list.positions = [["{radius} m", "0 m", "0 m"]]
[[grains]]
material = "glass"
size.constant.radius = "{plane} m"
placement.list.positions = [["-{plane} m", "0 m", "0 m"]]
{more}
[output]
frames = "60 us"
"""


def oblique():
    """Kharaz, Gorham and Salman (2001): tangential restitution of alumina spheres on glass."""
    more = "[contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = 0.98\n"
    more += "[contact.friction.mindlin]\nstatic_friction = 0.092\n"
    degrees = np.array([2, 5.17, 8, 11, 14, 17, 20.06, 25, 30, 35, 40.02, 50, 59.98, 70, 80.02, 86])
    found = []
    for angle in np.radians(degrees):
        _, velocity = Run(before_a_plane(angle, more)).last_frame
        found.append(velocity[0][1] / (3.9 * np.sin(angle)))
    made, axis = figure()
    line = np.linspace(12, 89, 200)
    axis.plot(line, 1 - 0.092 * 1.98 / np.tan(np.radians(line)), color=BLACK, linewidth=1, label="sliding all along: 1 - µ (1 + e)/tan θ")
    axis.plot(degrees, found, "o", color=BLUE, ms=5, label="agglo: hertz, mindlin")
    measured = np.array([(5.17, 0.948), (20.06, 0.616), (40.02, 0.781), (59.98, 0.893), (80.02, 0.966)]).T
    axis.errorbar(*measured, yerr=0.03 * measured[1], fmt="s", ms=6, fillstyle="none", color=VERMILION, capsize=3, label="measured, Kharaz et al. (2001), ± 3 %")
    axis.set(xlabel="angle to the normal [°]", ylabel="tangential speed after over before", ylim=(0.5, 1.02))
    axis.legend(frameon=False, fontsize=8, loc="lower right")
    save(made, "oblique")


def gas(count, solid_fraction, restitution, end, series):
    """Hard spheres of 1 mm radius with Maxwell's velocities of 1 m/s along each axis, in a periodic cube."""
    edge = (count * 4 / 3 * np.pi * 1e-9 / solid_fraction) ** (1 / 3)
    return f"""version = 1
time.end = "{end:.17g} s"
[engine.event_driven]
[volume]
lower = ["0 m", "0 m", "0 m"]
upper = ["{edge:.17g} m", "{edge:.17g} m", "{edge:.17g} m"]
[materials.glass]
density = "2500 kg/m3"
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.fill.count = {count}
velocity_spread.maxwell = {{ deviation = "1 m/s", centered = true }}
[impact.restitution.constant]
restitution = {restitution}
[output]
series = "{series:.17g} s"
frames = "{end:.17g} s"
checkpoints = "{end:.17g} s"
"""


def carnahan_starling(solid_fraction):
    return (1 - solid_fraction / 2) / (1 - solid_fraction) ** 3


def enskog(solid_fraction, temperature=1.0):
    """Impacts of a sphere per second, for spheres of 2 mm diameter."""
    return 24 * solid_fraction * carnahan_starling(solid_fraction) * np.sqrt(temperature / np.pi) / 2e-3


def haff():
    """Haff (1983): a gas of grains cools as (1 + t/t_H)^-2."""
    made, axis = figure()
    for value, color, marker in ((0.95, BLUE, "o"), (0.98, VERMILION, "s")):
        own = 6 / (enskog(0.05) * (1 - value**2))
        runs = [Run(gas(4000, 0.05, value, 8 * own, own / 2), "grains", seed=seed) for seed in (1, 2, 3)]
        time = runs[0].tables["grains"]["time_s"] / own
        temperature = np.mean([run.tables["grains"]["granular_temperature_m2_s2"] for run in runs], axis=0)
        axis.semilogy(time, temperature / temperature[0], marker, color=color, ms=5, fillstyle="none", label=f"agglo, restitution {value}")
    line = np.linspace(0, 8, 100)
    axis.semilogy(line, (1 + line) ** -2.0, color=BLACK, linewidth=1, label="Haff (1983)")
    axis.set(xlabel="time over t_H = 6/(ω (1 - e²)), ω Enskog's rate", ylabel="granular temperature over its start")
    axis.legend(frameon=False, fontsize=8)
    save(made, "haff")


def collisions():
    """Enskog (1922): how often spheres meet, with Carnahan and Starling's contact value of the pair distribution."""
    fractions = np.array([0.01, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35])
    found, errors = [], []
    for fraction in fractions:
        rate = enskog(fraction)
        values = []
        for seed in (1, 2, 3, 4):
            tables = Run(gas(4000, fraction, 1.0, 60 / rate, 20 / rate), "impacts", "grains", seed=seed).tables
            time, impacts = tables["impacts"]["time_s"], tables["impacts"]["impacts"]
            temperature = tables["grains"]["granular_temperature_m2_s2"][0]
            # The first third is for the start to be forgotten.
            per_sphere = 2 * (impacts[-1] - impacts[1]) / 4000 / (time[-1] - time[1])
            values.append(per_sphere * carnahan_starling(fraction) / enskog(fraction, temperature))
        found.append(np.mean(values))
        errors.append(np.std(values, ddof=1) / 2)
    found, errors = np.array(found), np.array(errors)
    made, (axis, ratio) = figure(8.6, 3.7, 2)
    line = np.linspace(0, 0.37, 100)
    axis.plot(line, carnahan_starling(line), color=BLACK, linewidth=1, label="Carnahan and Starling (1969)")
    axis.plot(line, np.ones_like(line), color=BLACK, linewidth=0.8, linestyle=":", label="Boltzmann: no crowding")
    axis.plot(fractions, found, "o", color=BLUE, ms=5, label="agglo")
    axis.set(xlabel="solid fraction", ylabel="rate of impacts over that of a dilute gas")
    ratio.axhline(0, color=BLACK, linewidth=1)
    ratio.errorbar(fractions, 100 * (found / carnahan_starling(fractions) - 1), yerr=100 * errors / carnahan_starling(fractions), fmt="o", color=BLUE, ms=5, capsize=3, label="agglo, ± one standard error")
    ratio.set(xlabel="solid fraction", ylabel="off Carnahan and Starling [%]", ylim=(-1, 1))
    for panel in (axis, ratio):
        panel.legend(frameon=False, fontsize=8)
    save(made, "collisions")


def aggregation():
    """Ballistic aggregation: whatever meets becomes one."""
    made, axis = figure()
    rate = enskog(0.01)
    end = 130 / rate
    time = np.exp(np.linspace(np.log(0.3), np.log(125), 300))
    masses, exponents = [], []
    for seed in range(1, 9):
        grains = Run(gas(6000, 0.01, 0.0, end, end / 1000), "grains", seed=seed).tables["grains"]
        mass = np.interp(time, grains["time_s"] * rate, 6000 / grains["grains"])
        window = (mass >= 5) & (mass <= 60)
        exponents.append(np.polyfit(np.log(time[window]), np.log(mass[window]), 1)[0])
        axis.loglog(time, mass, color=SKY, linewidth=0.7, label="agglo, eight starts" if seed == 1 else None)
        masses.append(mass)
    mean = np.exp(np.mean(np.log(masses), axis=0))
    axis.loglog(time, mean, color=BLUE, linewidth=2, label="agglo, mean")
    error = np.std(exponents, ddof=1) / np.sqrt(len(exponents))
    found = f"{np.mean(exponents):.3f} ± {error:.3f}"
    line = np.array([8.0, 100.0])
    middle = np.sqrt(line[0] * line[1])
    height = np.interp(middle, time, mean)
    axis.loglog(line, 1.6 * height * (line / middle) ** 0.966, color=BLACK, linewidth=1.2, label="slope 0.966: Boltzmann's equation for the same grains")
    axis.loglog(line, height / 1.6 * (line / middle) ** 1.2, color=BLACK, linewidth=1.2, linestyle=":", label="slope 6/5: mean field, Carnevale et al. (1990)")
    axis.set(xlabel="time over the first mean free time", ylabel="mean mass [grains]", title=f"Slope from 5 to 60 grains: {found}")
    axis.legend(frameon=False, fontsize=8)
    save(made, "aggregation")


def rays():
    """Reflections per ray are the grains' cross-sections over the beam's, on average over packings."""
    text = (ROOT / "scenarios/acoustic-dispersal-published.toml").read_text()
    counts = np.array([125, 250, 500, 750, 1000, 1250, 1500, 1750, 2000])
    means, errors, segments = [], [], []
    for count in counts:
        settings = [f"grains.0.placement.random.count={count}", "time.end=20 ms", "acoustics.beams.0.pulses.count=1"]
        settings += ["output.series=20 ms", "output.frames=20 ms", "output.checkpoints=20 ms"]
        pulses = [Run(text, settings=settings, seed=seed).summary["pulses"][0] for seed in range(1, 9)]
        assert not any(pulse["in_flight"] for pulse in pulses)
        of_ray = np.array([pulse["reflections"] / pulse["rays"] for pulse in pulses])
        means.append(of_ray.mean())
        errors.append(of_ray.std(ddof=1) / np.sqrt(len(of_ray)))
        segments.append(np.mean([pulse["segments"] for pulse in pulses]))
    made, (axis, ratio) = figure(8.6, 3.7, 2)
    exact = counts * 0.05**2
    axis.plot(counts, exact, color=BLACK, linewidth=1, label="exact: N r²/R², over all directions")
    axis.errorbar(counts, means, yerr=errors, fmt="o", color=BLUE, ms=5, capsize=3, label="agglo, eight packings of 10,000 rays")
    axis.set(xlabel="grains N of 5 cm in a beam of 1 m", ylabel="reflections per ray")
    axis.legend(frameon=False, fontsize=8)
    ratio.axhspan(58, 62, color=ORANGE, alpha=0.35, linewidth=0, label="Zohdi (2016) for 2,000 grains")
    ratio.plot(counts, np.array(segments) / 1000, "o", color=BLUE, ms=5, label="agglo: straight segments")
    ratio.plot(counts, 10 * np.array(means), "s", color=VERMILION, fillstyle="none", ms=5, label="agglo: reflections")
    ratio.set(xlabel="grains N", ylabel="thousands per pulse")
    ratio.legend(frameon=False, fontsize=8)
    save(made, "rays")


def circling(engine):
    """How far two charges are off, over their distance, when they have gone a quarter of their circle."""
    mass = 2500 * 4 / 3 * np.pi * 0.2**3
    charge = np.sqrt(4 * np.pi * 8.8541878128e-12 * 4 * mass)  # turns with one radian per second at 2 m
    groups = ""
    for side in (-1, 1):
        groups += '[[grains]]\nmaterial = "grain"\nsize.constant.radius = "0.2 m"\n'
        groups += f'charge = "{side * charge:.17g} C"\nvelocity = ["0 m/s", "{side} m/s", "0 m/s"]\n'
        groups += f'placement.list.positions = [["{side} m", "0 m", "0 m"]]\n'
    end = np.pi / 2
    text = f'version = 1\ntime.end = "{end:.17g} s"\n{engine}\n[limits]\ndisplacement = 10.0\n[materials.grain]\n'
    text += f'density = "2500 kg/m3"\n{groups}[fields.near_field]\nlaw.coulomb.relative_permittivity = 1.0\n'
    places, _ = Run(text + f'[output]\nframes = "{end:.17g} s"\n').last_frame
    return np.linalg.norm(places[1] - places[0] - np.array([0.0, 2.0, 0.0])) / 2


def order():
    """Error of the place of two circling charges, against the step."""
    steps = 2 * np.pi / np.array([40, 80, 160, 320, 640, 1280])
    staggered = '[engine.staggered]\ninitial_step = "{0:.17g} s"\nlargest_step = "{0:.17g} s"\ntolerance = 1e-12\ntarget_iterations = 200\nimplicitness = {1}'
    schemes = [
        ("verlet", '[engine.verlet]\nstep = "{0:.17g} s"', BLUE, "o"),
        ("staggered, φ = 1/2", staggered.replace("{1}", "0.5"), GREEN, "s"),
        ("staggered, φ = 1", staggered.replace("{1}", "1.0"), VERMILION, "^"),
    ]
    made, axis = figure()
    for name, engine, color, marker in schemes:
        errors = [circling(engine.format(float(step))) for step in steps]
        slope = np.polyfit(np.log(steps[2:]), np.log(errors[2:]), 1)[0]
        axis.loglog(steps, errors, marker + "-", color=color, ms=5, linewidth=1, fillstyle="none", label=f"{name}: slope {slope:.3f}")
    axis.loglog(steps, 0.05 * steps**2, color=BLACK, linewidth=0.8, linestyle=":", label="slopes 2 and 1")
    axis.loglog(steps, 1.5 * steps, color=BLACK, linewidth=0.8, linestyle=":")
    axis.set(xlabel="step [rad]", ylabel="distance from the exact place,\nover that of the charges")
    axis.legend(frameon=False, fontsize=8)
    save(made, "order")


def sets():
    """Growth of the 2004 paper's six sets: consistent, as printed, the paper."""
    kinds = [
        ("consistent laws", None, BLUE, "o"),
        ("as printed, 20 iterations", 20, VERMILION, "s"),
        ("as printed, 21 iterations", 21, ORANGE, "^"),
    ]
    made, axis = figure()
    for place, (name, most, color, marker) in zip((-0.18, 0.0, 0.18), kinds):
        for number in reacting.PAPER:
            scenario, settings = f"reacting-set-{number}", []
            if most:
                scenario = reacting.PUBLISHED
                settings = [*reacting.as_set(number), f"impact.restitution.hardness.solver.fixed_point.most_iterations={most}"]
            ratios = np.array([reacting.run(scenario, settings, seed)["radius_ratio"] for seed in range(1, 13)])
            error = ratios.std(ddof=1) / np.sqrt(len(ratios))
            label = name if number == 1 else None
            axis.errorbar(number + place, ratios.mean(), yerr=error, fmt=marker, color=color, ms=5, capsize=3, label=label)
    axis.plot(list(reacting.PAPER), list(reacting.PAPER.values()), "_", color=BLACK, ms=26, mew=2, label="Zohdi (2004), table 3")
    axis.set(xlabel="set", ylabel="mean radius, end over start", xticks=list(reacting.PAPER), ylim=(0, None))
    axis.legend(frameon=False, fontsize=8, ncols=2)
    save(made, "sets")


PLOTS = (hertz, restitution, oblique, haff, collisions, aggregation, rays, order, sets)


def draw(plots):
    """Draws the plots that the command line names; all of them where it names none."""
    known = {plot.__name__: plot for plot in plots}
    unknown = [name for name in sys.argv[1:] if name not in known]
    if unknown:
        sys.exit(f"{', '.join(unknown)}: one of {', '.join(known)} is wanted")
    for name in sys.argv[1:] or known:
        known[name]()


if __name__ == "__main__":
    draw(PLOTS)
