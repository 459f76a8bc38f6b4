"""Form, then disperse, and form again: grains stick and grow, sound takes them apart, and what is left grows once more.

    python3 examples/form_disperse.py out/form-disperse            # seconds; --short: a quarter of the grains

Pigment grains grow as hard spheres, which stick at every impact (`form`). `agglo.hand_over` makes of each a packing of its own
primaries, bonded soft spheres in water, and two pulses of sound break them up (`disperse`). What is left goes back to hard
spheres, one for each cluster, and these grow until there are as few as before. Primaries, mass and momentum are kept at both
hand-overs. Started again, it draws what is there.
"""

import argparse
import json
from pathlib import Path

import agglo
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle

# In a quarter of the room, so that grains meet as often as in the full run.
SHORT_FORM = {
    "grains.0.placement.fill.count": 100,
    "volume.lower": 3 * ["-0.157 mm"],
    "volume.upper": 3 * ["0.157 mm"],
}
SHORT_DISPERSE = {"acoustics.beams.0.radius": "0.44 mm", "acoustics.beams.0.rays": 8000}
# Sound leaves grains fast, so the second growth needs far less time than the first.
AGAIN = {"time.end": "20 ms"}


def run(scenario, folder, stop=None):
    """The run in a folder; it is run if it has not been."""
    if (folder / "summary.json").is_file():
        return agglo.read(folder)
    return agglo.run(scenario, folder, stop=stop)


def hand_over(grown, file, scenario):
    """A run's grains in a scenario of the other kind of spheres, and the record of what was kept."""
    if not file.is_file():
        agglo.hand_over(grown.folder, file, scenario=scenario)
    record = json.loads(file.with_name(f"{file.stem}-hand-over.json").read_text(encoding="utf-8"))
    return agglo.Scenario.from_file(file), record


def chain(folder, short):
    """The three runs, and the records of the two hand-overs between them."""
    form = agglo.Scenario.template("form", SHORT_FORM if short else {})
    formed = run(form, folder / "formed")
    disperse = agglo.Scenario.template("disperse", SHORT_DISPERSE if short else {})
    soft, apart = hand_over(formed, folder / "agglomerates.toml", disperse)
    dispersed = run(soft, folder / "dispersed")
    hard, whole = hand_over(dispersed, folder / "again.toml", form.replace(AGAIN))
    few = formed.summary["grains_end"]
    again = run(hard, folder / "again", stop=lambda time_s, grains: len(grains["radius_m"]) <= few)
    return formed, apart, dispersed, whole, again


def primaries(grains):
    """How many primaries the piece has that each sphere is, or is part of; pieces are grains or clusters."""
    if "primaries" in grains:
        return grains["primaries"]
    _, cluster, count = np.unique(grains["cluster"], return_inverse=True, return_counts=True)
    return count[cluster]


def off(record, grains):
    """By how much mass and momentum differ after a hand-over, over all mass and over all |m v| of the grains before it."""
    before, after = record["before"], record["after"]
    motion = (grains["mass_kg"] * np.linalg.norm(grains["velocity_m_s"], axis=1)).sum()
    momentum = np.subtract(after["momentum_kg_m_s"], before["momentum_kg_m_s"])
    return abs(after["mass_kg"] / before["mass_kg"] - 1), np.linalg.norm(momentum) / motion


def draw_clouds(formed, dispersed, again):
    """The grains at four moments, seen along y; colors are the primaries of the piece."""
    stages = [("Formed", formed, -1), ("Taken apart", dispersed, 0), ("Dispersed", dispersed, -1), ("Grown again", again, -1)]
    frames = [found.grains(at)[1] for _, found, at in stages]
    most = max(primaries(grains).max() for grains in frames)
    half_um = 1e6 * max(np.abs(grains["position_m"]).max() + grains["radius_m"].max() for grains in frames)
    figure, panels = plt.subplots(2, 2, figsize=(9.2, 8.2), sharex=True, sharey=True, layout="constrained")
    for axes, (words, _, _), grains in zip(panels.flat, stages, frames):
        # The farthest along y first, so that the nearest cover them.
        order = np.argsort(-grains["position_m"][:, 1])
        place, radius = 1e6 * grains["position_m"][order], 1e6 * grains["radius_m"][order]
        circles = PatchCollection(
            [Circle((x, z), r) for (x, _, z), r in zip(place, radius)],
            cmap="viridis",
            array=np.log2(primaries(grains)[order]),
            edgecolor="#222222",
            linewidth=0.3,
        )
        circles.set_clim(0.0, np.log2(most))
        axes.add_collection(circles)
        is_soft = "cluster" in grains
        pieces = f"{len(np.unique(grains['cluster']))} clusters of soft" if is_soft else f"{len(place)} hard"
        axes.set(title=f"{words}: {pieces} spheres", xlim=(-half_um, half_um), ylim=(-half_um, half_um), aspect="equal")
        axes.grid(False)
    for axes in panels[-1]:
        axes.set_xlabel("x (µm)")
    for axes in panels[:, 0]:
        axes.set_ylabel("z (µm)")
    bar = figure.colorbar(circles, ax=panels, shrink=0.7, label="primaries in a grain or cluster")
    powers = np.arange(0, int(np.log2(most)) + 1)
    bar.set_ticks(powers, labels=[str(2**power) for power in powers])
    return figure


def course(found):
    """Times [s], how many primaries the largest piece has, and how many pieces there are."""
    if "clusters" in found.tables:
        table = found.table("clusters")
        return table["time_s"], table["largest_grains"], table["clusters"]
    table = found.table("grains")
    return table["time_s"], table["largest_primaries"], table["grains"]


def draw_course(formed, dispersed, again):
    """Sizes over time, stage by stage, and where the mass is at the end of each."""
    names = ["Hard spheres stick", "Sound breaks bonds", "Hard spheres stick again"]
    figure, panels = plt.subplot_mosaic([names, ["sizes"] * 3], figsize=(10, 7), layout="constrained")
    stages = (formed, dispersed, again)
    count = len(dispersed.grains()[1]["id"])
    most = max(course(found)[1].max() for found in stages)
    for name, found, (scale, unit) in zip(names, stages, [(1e3, "ms"), (1e6, "µs"), (1e3, "ms")]):
        time_s, largest, pieces = course(found)
        axes = panels[name]
        axes.step(scale * time_s, largest, where="post", label="the largest")
        axes.step(scale * time_s, count / pieces, where="post", label="mean of all")
        axes.set_yscale("log", base=2)
        axes.yaxis.set_major_formatter("{x:.0f}")
        axes.set(title=name, xlabel=f"time ({unit})", ylim=(0.9, 1.3 * most))
    panels[names[0]].set_ylabel("primaries in a grain or cluster")
    panels[names[0]].legend(loc="upper left")
    for number, pulse in enumerate(dispersed.summary["pulses"], 1):
        panels[names[1]].axvline(1e6 * pulse["start_s"], color="#999999", linestyle="-", linewidth=1)
        at = (1e6 * pulse["start_s"], 1.05)
        panels[names[1]].annotate(f"pulse {number}", at, xytext=(4, 0), textcoords="offset points")

    sizes = [found.sizes() for found in stages]
    classes = max(int(np.log2(table["lower_primaries"].max())) for table in sizes) + 1
    for number, (words, table) in enumerate(zip(["formed", "dispersed", "grown again"], sizes)):
        part = np.zeros(classes)
        part[np.log2(table["lower_primaries"]).astype(int)] = table["mass_fraction"]
        panels["sizes"].bar(np.arange(classes) + 0.27 * (number - 1), 100 * part, width=0.25, label=words)
    labels = ["1"] + [f"{2**power} to {2 ** (power + 1) - 1}" for power in range(1, classes)]
    panels["sizes"].set_xticks(range(classes), labels=labels)
    panels["sizes"].grid(False, axis="x")
    panels["sizes"].set(title="Where the mass is", xlabel="primaries in a grain or cluster", ylabel="part of the mass (%)")
    panels["sizes"].legend(loc="upper center")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the runs and the pictures go")
    parser.add_argument("--short", action="store_true", help="a quarter of the grains, for a try")
    given = parser.parse_args()
    formed, apart, dispersed, whole, again = chain(given.folder, given.short)

    first, broken, last = formed.summary, dispersed.summary, again.summary
    print(
        f"formed: {first['grains_end']} grains of {first['grains_start']} in {1e3 * first['time_s']:.0f} ms, "
        f"the largest of {first['largest_primaries']} primaries"
    )
    mass, momentum = off(apart, formed.grains()[1])
    print(
        f"taken apart: {apart['after']['grains']} primaries in {apart['clusters']} agglomerates "
        f"with {apart['packing']['bonds']} bonds; mass kept to {mass:.0e}, momentum to {momentum:.0e}"
    )
    degree = dispersed.table("clusters")["dispersion_degree"]
    print(
        f"dispersed: {broken['clusters']['count']} clusters after {1e6 * broken['time_s']:.0f} µs and "
        f"{len(broken['pulses'])} pulses; {broken['bonds_end']} bonds left, "
        f"dispersion degree {degree[0]:.3f} before and {degree[-1]:.3f} after"
    )
    mass, momentum = off(whole, dispersed.grains()[1])
    part = whole["after"]["kinetic_J"] / whole["before"]["kinetic_J"]
    print(
        f"made whole: {whole['clusters']} grains; mass kept to {mass:.0e}, momentum to {momentum:.0e}, "
        f"{part:.0%} of the energy of motion and spin left"
    )
    before, now = (np.sqrt(found.table("grains")["granular_temperature_m2_s2"][0]) for found in (formed, again))
    print(
        f"grown again: {last['grains_end']} grains in {1e3 * last['time_s']:.1f} ms, the largest of "
        f"{last['largest_primaries']} primaries; at first {now / before:.0f} times as fast as the primaries were"
    )

    with plt.rc_context(agglo.plot_style()):
        draw_clouds(formed, dispersed, again).savefig(given.folder / "clouds.png", dpi=80)
        draw_course(formed, dispersed, again).savefig(given.folder / "course.svg")


if __name__ == "__main__":
    main()
