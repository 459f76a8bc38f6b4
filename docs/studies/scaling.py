#!/usr/bin/env python3
"""How a study gets faster with threads and with parts side by side: the table of docs/cluster.md.

    cargo build --release && python3 docs/studies/scaling.py [turns]

The study is examples/slurm/study.toml. All ways take turns; of each the shortest wall time and the least processor time are printed,
since machines have other work to do. AGGLO names another program than target/release/agglo.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("AGGLO", ROOT / "target/release/agglo")).resolve()
STUDY = ROOT / "examples/slurm/study.toml"


def study(folder, threads, *more):
    return [PROGRAM, "study", STUDY, "-o", folder, "--no-report", "--threads", str(threads), *more]


def ways(place):
    """Names, and the commands that run side by side."""
    return {
        "one process, one thread": [study(place / "one", 1)],
        "one process, two threads": [study(place / "two", 2)],
        "two parts side by side, one thread each": [study(place / f"part-{part}", 1, "--part", f"{part}/2") for part in (1, 2)],
        "putting the two parts together": [
            [PROGRAM, "join", place / "part-1", place / "part-2", "-o", place / "whole", "--no-report"]
        ],
    }


def timed(commands):
    """Wall time and processor time [s] of commands side by side."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    running = [subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for command in commands]
    if any([process.wait() for process in running]):
        sys.exit(f"{commands[0]} failed")
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    turns = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    found = {}
    for _ in range(turns):
        with tempfile.TemporaryDirectory() as place:
            for name, commands in ways(Path(place)).items():
                found.setdefault(name, []).append(timed(commands))
    for name, times in found.items():
        wall, processor = (min(values) for values in zip(*times))
        print(f"| {name} | {wall:.2f} s | {processor:.2f} s |", flush=True)


if __name__ == "__main__":
    main()
