#!/usr/bin/env python3
"""Draws what printed laws change: the plots of docs/differences.md and docs/convergence.md.

    cargo build --release
    target/venv/bin/pip install -r docs/pictures/requirements.txt
    target/venv/bin/python docs/studies/differences.py            # both; a minute
    target/venv/bin/python docs/studies/differences.py impacts    # this one only

AGGLO names another program. Plots go to docs/pictures/validation/.
"""

import tomllib

import numpy as np

import halving
from validation import BLACK, BLUE, ORANGE, ROOT, VERMILION, Run, draw, figure, save

# Hardness [Pa] and density [kg/m3] of the two spheres that meet.
HARDNESS, DENSITY = 1e6, 2000.0


def restitution(x, law):
    """What two equal spheres keep of their speed; x is the pressure of the impact over 2H, at e = 0."""
    speed = np.sqrt(3 * HARDNESS * x / (2 * DENSITY))
    group = '[[grains]]\nmaterial = "grain"\nsize.constant.radius = "1 mm"\n'
    groups = ""
    for side in (-1, 1):
        groups += f'{group}velocity = ["{-side * speed:.17g} m/s", "0 m/s", "0 m/s"]\n'
        groups += f'placement.list.positions = [["{1.5 * side} mm", "0 m", "0 m"]]\n'
    text = f"""version = 1
time.end = "{2e-3 / speed:.17g} s"
[engine.event_driven]
[volume]
lower = ["-1 m", "-1 m", "-1 m"]
upper = ["1 m", "1 m", "1 m"]
boundary = "open"
[materials.grain]
density = "{DENSITY} kg/m3"
hardness = "{HARDNESS} Pa"
{groups}
[impact]
sticking = "never"
[impact.restitution.hardness]
{law}
"""
    _, velocity = Run(text).last_frame
    return (velocity[1][0] - velocity[0][0]) / (2 * speed)


def impacts():
    """Restitution over the load of an impact: consistent, and as printed."""
    made, axis = figure()
    loads = np.linspace(0.01, 1.15, 39)
    printed = 'force_over = "compression"\nsolver.fixed_point.most_iterations = {}'
    laws = [
        ("consistent: the root, 1 - √x", "", BLUE, "-", 2.0),
        ("4.14 as printed: force over compression alone", 'force_over = "compression"', BLACK, "--", 1.2),
        ("iterated as printed, 20 times", printed.format(20), VERMILION, ":", 1.8),
        ("iterated as printed, 21 times", printed.format(21), ORANGE, "-.", 1.5),
    ]
    for name, law, color, line, width in laws:
        found = [restitution(x, law) for x in loads]
        axis.plot(loads, found, line, color=color, linewidth=width, label=name)
    axis.set(xlabel="x: pressure of the impact over 2H", ylabel="restitution e", title="What an impact leaves of the speed: all from runs")
    axis.legend(frameon=False, fontsize=8)
    save(made, "impacts")


def steps():
    """What half the step changes in the two sample problems under sound: the stored measurement that the table tells of too."""
    rows = tomllib.loads((ROOT / "docs/measured/values/halving.toml").read_text())["values"]["rows"]
    made, panels = figure(8.6, 3.7, 2)
    for name, color in zip(halving.SCENARIOS, (BLUE, VERMILION)):
        found = [row[2:] for row in rows if row[0] == name]
        for panel, column in zip(panels, (0, 2)):
            means, errors = zip(*[row[column] for row in found])
            panel.errorbar([1.0, 0.5, 0.25], means, yerr=errors, fmt="o-", ms=5, capsize=3, color=color, label=name)
    for panel, label in zip(panels, ("dispersion degree", "kinetic energy [J]")):
        panel.set_xscale("log", base=2)
        panel.set(xlabel="step over that of the shipped scenario", ylabel=label, xticks=[1, 0.5, 0.25], xticklabels=["1", "1/2", "1/4"])
    panels[0].set_ylim(0, 1)
    panels[1].set_yscale("log")
    panels[0].legend(frameon=False, fontsize=8, loc="upper left")
    save(made, "steps")


if __name__ == "__main__":
    draw((impacts, steps))
