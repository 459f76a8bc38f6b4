#!/usr/bin/env python3
"""Compares what `agglo check` says of a run with what the run takes: steps, memory, bytes, time.

    cargo build --release && python3 docs/studies/forecast.py [word ...]

Runs the shipped scenarios and six others, or those whose names contain a word, and prints the ratio of forecast to run for each
figure. Some three minutes on two cores. AGGLO names another program.
"""

import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("AGGLO", ROOT / "target" / "release" / "agglo")
UNITS = {"B": 1, "kB": 1e3, "MB": 1e6, "GB": 1e9, "s": 1, "min": 60, "h": 3600, "days": 86400}

GLASS = """
[materials.glass]
density = "2500 kg/m3"
sound_speed = "5000 m/s"
youngs_modulus = "50 MPa"
poisson_ratio = 0.2
"""
GRAINS = """
[[grains]]
material = "glass"
size.constant.radius = "{radius}"
placement.random = {{ count = {count}, region.{region} }}
"""
CONTACT = """
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.6
[contact.friction.mindlin]
static_friction = 0.4
dynamic_friction = 0.4
"""


def head(end, engine="verlet"):
    return f'version = 1\ntitle = "forecast"\ntime.end = "{end}"\n[engine.{engine}]\n{GLASS}'


def falling_bed(_):
    region = 'box = { lower = ["-10 mm", "-10 mm", "0 mm"], upper = ["10 mm", "10 mm", "40 mm"] }'
    gravity = '[fields.gravity]\nacceleration = ["0 m/s2", "0 m/s2", "-9.81 m/s2"]\n'
    return head("40 ms") + GRAINS.format(radius="0.5 mm", count=6000, region=region) + CONTACT + gravity


def charged_cloud(_):
    region = 'sphere = { radius = "10 mm" }'
    grains = GRAINS.format(radius="0.3 mm", count=1000, region=region) + 'charge = "10 pC"\n'
    return head("1 ms") + grains + CONTACT + "[fields.near_field.law.coulomb]\n"


def bonded_table(folder):
    side, rows = 12, []
    for number in range(side**3):
        x, y, z = (2e-4 * (number // side**k % side) for k in range(3))
        rows.append(f"{x},{y},{z},1e-4,{math.copysign(0.5, x - 1.1e-3)},0,0")
    (folder / "grains.csv").write_text("x_m,y_m,z_m,radius_m,vx_m_s,vy_m_s,vz_m_s\n" + "\n".join(rows) + "\n")
    bonds = (
        '[bonds.beam]\nyoungs_modulus = "10 MPa"\ntensile_strength = "50 kPa"\n'
        'shear_strength = "50 kPa"\nradius_ratio = 0.5\ngap = 0.01\n'
    )
    grains = '[[grains]]\nmaterial = "glass"\nsize.constant.radius = "1 m"\nplacement.table.file = "grains.csv"\n'
    return head("2 ms") + grains + CONTACT + bonds


def two_beams(_):
    beam = """
[[acoustics.beams]]
start = ["{x} mm", "0 mm", "0 mm"]
direction = [{way}, 0.0, 0.0]
radius = "5 mm"
rays = 20000
strength.pressure = "2 MPa"
pulses = {{ first = "{first} ms", period = "0.5 ms", count = 3 }}
"""
    beams = beam.format(x=-6, way=1.0, first=0.2) + beam.format(x=6, way=-1.0, first=0.3)
    grains = GRAINS.format(radius="0.2 mm", count=3000, region='sphere = { radius = "5 mm" }')
    return head("3 ms") + grains + CONTACT + '[acoustics.force.impulse]\nduration = "1 us"\n' + beams


def hard(engine, count, end, restitution):
    return f"""
version = 1
title = "forecast"
time.end = "{end}"
[engine.{engine}]
[volume]
lower = ["0 m", "0 m", "0 m"]
upper = ["20 cm", "20 cm", "20 cm"]
boundary = "periodic"
[materials.glass]
density = "2500 kg/m3"
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.fill.count = {count}
velocity_spread.maxwell.deviation = "0.2 m/s"
[impact.restitution.constant]
restitution = {restitution}
"""


OTHERS = {
    "falling-bed": falling_bed,
    "charged-cloud": charged_cloud,
    "bonded-table": bonded_table,
    "two-beams": two_beams,
    "hard-gas": lambda _: hard("event_driven", 20000, "30 s", 0.95),
    "hard-gas-stepped": lambda _: hard("time_stepped", 500, "1 s", 0.9),
}


def figure(page, label):
    """A figure of the page, or nothing where it says that it does not know."""
    found = re.search(rf"^ *{label} +(?:about |less than )?([\d.e+]+) ?([a-zA-Z]*)", page, re.MULTILINE)
    return float(found[1]) * UNITS.get(found[2], 1) if found else None


def compare(name, file, folder):
    checked = subprocess.run([PROGRAM, "check", file], stdout=subprocess.PIPE, text=True, check=True)
    page = checked.stdout
    out, began = folder / "out", time.time()
    process = subprocess.Popen([PROGRAM, "run", file, "-o", out], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.time() - began
    if os.waitstatus_to_exitcode(status) != 0:
        print(f"| {name} | the run failed | | | |", flush=True)
        return
    summary = json.loads((out / "summary.json").read_text())
    size = sum(path.stat().st_size for path in out.rglob("*") if path.is_file())
    run = {"steps": summary["steps"], "memory": usage.ru_maxrss * 1024, "disk": size, "time of the run": wall}
    cells = []
    for label, value in run.items():
        told = figure(page, label)
        # "less than 1 s" is right for all that is.
        short = label == "time of the run" and told == 1 and value < 1
        cells.append("not known" if told is None else "short" if short else f"{told / value:.2f} of {value:.3g}")
    print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


def main():
    words = sys.argv[1:]
    print("| scenario | steps | memory [B] | disk [B] | time [s] |\n|---|---|---|---|---|", flush=True)
    shipped = sorted(path for path in (ROOT / "scenarios").glob("*.toml") if "[engine." in path.read_text())
    for name, text in [(path.stem, path) for path in shipped] + list(OTHERS.items()):
        if words and not any(word in name for word in words):
            continue
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            file = text
            if callable(text):
                file = folder / f"{name}.toml"
                file.write_text(text(folder))
            compare(name, file, folder)


if __name__ == "__main__":
    main()
