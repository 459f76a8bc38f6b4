#!/usr/bin/env python3
"""Most memory of a run of soft spheres for each grain that it has more, files and checkpoints included.

    cargo build --release && python3 docs/studies/memory.py

The shaken lattice of peers/measure.py: six contacts a grain, with friction that remembers. Two such runs of
21 steps, of 125,000 and of 1,000,000 grains, write rows, frames and checkpoints; one more goes on from the last checkpoint. What the
larger takes more at its peak is divided by the grains that it has more. AGGLO names another program than target/release/agglo.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent / "peers"))
import measure

EDGES = 50, 100
RECORDS = ["--set", 'output.series="50 ns"', "--set", 'output.frames="100 ns"']


def write(folder, edge):
    measure.write_table(folder, measure.lattice(edge))
    (folder / "lattice.toml").write_text(measure.SCENARIO.format(end=105e-9))


def most_memory(command, folder):
    """Largest resident set [B] of a command."""
    process = subprocess.Popen([measure.AGGLO, *command], cwd=folder, stdout=subprocess.DEVNULL)
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
                "start and 21 steps, rows, a frame, checkpoints": ["run", "lattice.toml", "-o", "out", "--no-report", *RECORDS],
                "going on from its checkpoint": ["resume", "out", "--until", "210 ns", "--no-report"],
            }
            for name, command in ways.items():
                most.setdefault(name, []).append(most_memory(command, place))
    more = EDGES[1] ** 3 - EDGES[0] ** 3
    for name, (small, large) in most.items():
        print(f"| {name} | {(large - small) / more:.0f} B a grain |", flush=True)


if __name__ == "__main__":
    main()
