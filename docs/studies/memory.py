#!/usr/bin/env python3
"""Most memory of a run of soft spheres for each grain that it has more, files and checkpoints included.

    cargo build --release && python3 docs/studies/memory.py

A cubic lattice of grains that overlap by a hundredth and shake: six contacts a grain, with friction that remembers. Two such runs of
20 steps, of 125,000 and of 1,000,000 grains, write rows, frames and checkpoints; one more goes on from the last checkpoint. What the
larger takes more at its peak is divided by the grains that it has more. AGGLO names another program than target/release/agglo.
"""

import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

AGGLO = os.environ.get("AGGLO", Path(__file__).resolve().parents[2] / "target/release/agglo")
EDGES = 50, 100

SCENARIO = """version = 1
time.end = "105 ns"
engine.verlet.step = "5 ns"
medium.density = "1 kg/m3"
[materials.grain]
density = "2500 kg/m3"
youngs_modulus = "10 MPa"
poisson_ratio = 0.3
[[grains]]
material = "grain"
size.constant.radius = "1 um"
placement.table.file = "lattice.csv"
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.5
[contact.friction.mindlin]
static_friction = 0.5
[output]
series = "50 ns"
frames = "100 ns"
checkpoints = "0.1 s"
"""


def write(folder, edge):
    source = random.Random(1)
    with open(folder / "lattice.csv", "w") as file:
        file.write("x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n")
        for at in range(edge**3):
            place = [1.98e-6 * (at // edge**power % edge) for power in range(3)]
            velocity = [0.1 * source.uniform(-1.0, 1.0) for _ in range(3)]
            file.write(",".join(f"{value:.9e}" for value in place + velocity) + "\n")
    (folder / "lattice.toml").write_text(SCENARIO)


def most_memory(command, folder):
    """Largest resident set [B] of a command."""
    process = subprocess.Popen([AGGLO, *command], cwd=folder, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"agglo {' '.join(command)} failed")
    return used.ru_maxrss * 1024


def main():
    most = {}
    for edge in EDGES:
        with tempfile.TemporaryDirectory() as place:
            write(Path(place), edge)
            ways = {
                "start and 21 steps, rows, a frame, checkpoints": ["run", "lattice.toml", "-o", "out", "--no-report"],
                "going on from its checkpoint": ["resume", "out", "--until", "210 ns", "--no-report"],
            }
            for name, command in ways.items():
                most.setdefault(name, []).append(most_memory(command, place))
    more = EDGES[1] ** 3 - EDGES[0] ** 3
    for name, (small, large) in most.items():
        print(f"| {name} | {(large - small) / more:.0f} B a grain |", flush=True)


if __name__ == "__main__":
    main()
