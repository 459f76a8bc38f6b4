#!/usr/bin/env python3
"""Collisions per second beside EDMD: an elastic gas of equal hard spheres in a periodic cube, on one core.

    cargo build --release
    git clone https://github.com/FSmallenburg/EDMD target/edmd
    python3 docs/studies/peers/edmd.py target/edmd

EDMD (F. Smallenburg, Eur. Phys. J. E 45, 22 (2022)) has a variant with cells and two with neighbor lists; the one with cells is
the fastest at these densities. Its source is built as its makefile says, with the number of spheres, the solid fraction and the
time put in, and room for as many cells as a million spheres need; it starts from a crystal that melts at once, agglo from
random places. The cost of a collision is the processor time of a long run less that of a short one over the collisions
between, so that start and reading fall out. Programs take turns, and the ratio is taken turn by turn, as machines drift. AGGLO
names another program.
"""

import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from measure import AGGLO, timed

# Spheres as four times a cube, for EDMD's crystal, and the part of the volume that they fill.
GASES = [(4 * edge**3, fraction) for fraction in (0.05, 0.25) for edge in (7, 14, 29, 63)]
# Collisions that the long run has beyond the short one, per sphere, and at the least.
COLLISIONS, LEAST = 1.0, 400_000
# The short run, in collisions a sphere: then the gas has forgotten how it began.
WARM = 1.0

SCENARIO = """version = 1
time.end = "{end!r} s"
[engine.event_driven]
[volume]
lower = ["0 m", "0 m", "0 m"]
upper = ["{edge!r} m", "{edge!r} m", "{edge!r} m"]
boundary = "periodic"
[materials.glass]
density = "2500 kg/m3"
[[grains]]
material = "glass"
size.constant.radius = "0.5 m"
placement.fill.count = {spheres}
velocity_spread.maxwell = {{ deviation = "1 m/s", centered = true }}
[impact.restitution.constant]
restitution = 1.0
[output]
series = "1e9 s"
frames = "1e9 s"
checkpoints = "1e9 s"
"""


def rate(fraction):
    """Collisions per sphere and second at a diameter of 1 m and 1 m/s along each axis (Enskog, Carnahan and Starling)."""
    chi = (1 - fraction / 2) / (1 - fraction) ** 3
    return 2 * math.sqrt(math.pi) * (6 * fraction / math.pi) * chi


def agglo(_, folder, spheres, fraction, end):
    """Processor seconds and collisions of a run."""
    edge = (math.pi * spheres / (6 * fraction)) ** (1 / 3)
    (folder / "gas.toml").write_text(SCENARIO.format(end=end, edge=edge, spheres=spheres))
    with tempfile.TemporaryDirectory(dir=folder) as out:
        seconds, _ = timed([AGGLO, "run", "gas.toml", "-o", f"{out}/run", "--threads", "1"], folder, None)
        summary = json.loads((Path(out) / "run/summary.json").read_text())
    return seconds, summary["impacts"]


def edmd(source, folder, spheres, fraction, end):
    """The same of EDMD."""
    text = (source / "Cell/mdCell.c").read_text()
    for name, value in {
        "double maxtime": repr(end),
        "double writeinterval": repr(end),
        "int initialconfig": "1",
        "double packfrac": repr(fraction),
        "int N": str(spheres),
    }.items():
        text, count = re.subn(rf"^({name}\s*=\s*)[^;]+;", rf"\g<1>{value};", text, flags=re.M)
        assert count == 1, name
    (folder / "mdCell.c").write_text(text.replace("#define MAXCEL 75", "#define MAXCEL 220"))
    for name in ("mdCell.h", "mt19937ar.c"):
        (folder / name).write_text((source / "Cell" / name).read_text())
    flags = ["-Ofast", "-funroll-loops", "-march=native"]
    subprocess.run(["gcc", "-w", *flags, "mdCell.c", "-o", "md", "-lm"], cwd=folder, check=True)
    seconds, said = timed(["./md"], folder, os.environ)
    return seconds, int(re.findall(r"Collisions: (\d+)", said)[-1])


def speed(run, source, folder, spheres, fraction):
    """Collisions per second."""
    per_second = spheres * rate(fraction)
    warm = WARM * spheres / per_second
    more = max(COLLISIONS * spheres, LEAST) / per_second
    (short, before), (long, after) = (run(source, folder, spheres, fraction, end) for end in (warm, warm + more))
    return (after - before) / (long - short)


def main():
    source, turns = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 5
    with tempfile.TemporaryDirectory() as place:
        for spheres, fraction in GASES:
            found = [[speed(run, source, Path(place), spheres, fraction) for run in (agglo, edmd)] for _ in range(turns)]
            ours, theirs = (statistics.median(speeds) / 1e3 for speeds in zip(*found))
            ratios = [own / other for own, other in found]
            print(
                f"{spheres:9} spheres at {fraction:.2f}: {ours:5.0f} thousand collisions/s, EDMD {theirs:5.0f}, agglo is"
                f" {statistics.median(ratios):.2f} times as fast ({min(ratios):.2f} to {max(ratios):.2f})",
                flush=True,
            )


if __name__ == "__main__":
    main()
