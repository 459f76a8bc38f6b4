"""Figures 7 to 10 of T. I. Zohdi, Comput. Mech. 57, 465 (2016): a pulse of sound breaks up an agglomerate.

    python3 examples/acoustic_dispersal.py out/acoustic            # some minutes; --short: seconds, a twentieth of the grains

The scenario is `acoustic-published`, with the laws as printed. Figures 7 and 8 are rays on their way through the grains, figure 9
counts reflections over four pulses, figure 10 is the power that is left in the beam.
"""

import argparse
from pathlib import Path

import agglo
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.colors import Normalize
from matplotlib.patches import Circle

# Frames of figures 7 and 8 [s].
TIMES_S = 0.25e-3 * np.arange(1, 13)
SHORT = {
    "grains.0.placement.random.count": 100,
    "acoustics.beams.0.rays": 400,
    "acoustics.beams.0.pulses.period": "6 ms",
    "time.end": "12 ms",
}


def run(folder, short):
    """The run in a folder; it is run if it has not been."""
    if (folder / "summary.json").is_file():
        return agglo.read(folder)
    # Frames while rays fly are denser than in the shipped file. That changes nothing else.
    settings = {"output.pulses.frames": "0.25 ms", **(SHORT if short else {})}
    return agglo.run(agglo.Scenario.template("acoustic-published", settings), folder)


def draw_rays(found):
    """Rays in flight over the grains, seen along y; strokes are as long as their rays are strong, as in the paper."""
    figure, panels = plt.subplots(3, 4, figsize=(12, 9.4), sharex=True, sharey=True, layout="constrained")
    times = np.array([time for time, _ in found.frames("rays")])
    norm = Normalize(0.5, 1.0)
    for axes, wanted in zip(panels.flat, TIMES_S):
        at = int(np.argmin(np.abs(times - wanted)))
        time_s, rays = found.rays(at)
        _, grains = found.grains(at)
        circles = [Circle((x, z), radius) for (x, _, z), radius in zip(grains["position_m"], grains["radius_m"])]
        axes.add_collection(PatchCollection(circles, facecolor="#e4e4e4", edgecolor="#c8c8c8", linewidth=0.2))
        whole = found.scenario.to_dict()["acoustics"]["beams"][0]["rays"]
        launched = found.table("rays")["power_in_W"][1] / whole
        part = rays["power_W"] / launched
        tip, stroke = rays["position_m"], 0.12 * part[:, None] * rays["direction"]
        strokes = [[(a[0], a[2]), (b[0], b[2])] for a, b in zip(tip - stroke, tip)]
        lines = matplotlib.collections.LineCollection(strokes, cmap="viridis_r", norm=norm, array=part, linewidth=0.5)
        axes.add_collection(lines)
        axes.set(title=f"{1e3 * time_s:.2f} ms, {len(part):,} rays", xlim=(-2.2, 2.2), ylim=(-2.2, 2.2), aspect="equal")
        axes.grid(False)
    for axes in panels[-1]:
        axes.set_xlabel("x (m)")
    for axes in panels[:, 0]:
        axes.set_ylabel("z (m)")
    figure.colorbar(lines, ax=panels, label="power of a ray over that at its launch", shrink=0.6, extend="min")
    return figure


def draw_series(found):
    """Reflections over all pulses, and the power in the beam during the first."""
    rays = found.table("rays")
    figure, panels = plt.subplots(2, 3, figsize=(12, 6.4), layout="constrained")
    count, power = panels.flat[0], panels.flat[1:5]
    count.plot(rays["time_s"], rays["segments"] / 1e3, label="straight segments")
    count.plot(rays["time_s"], rays["reflections"] / 1e3, label="reflections")
    count.axhspan(58, 62, color="#e69f00", alpha=0.4, linewidth=0, label="the paper's first pulse")
    count.set(title="Figure 9", xlabel="time (s)", ylabel="thousands so far")
    count.legend()
    period = found.scenario.to_dict()["acoustics"]["beams"][0]["pulses"]
    first = (rays["pulses"] > 0) & (rays["time_s"] < min(0.01, 0.9 * rays["time_s"][-1] / period["count"]))
    time_ms = 1e3 * rays["time_s"][first]
    for axes, name, words in zip(
        power,
        ["beam_x", "beam_y", "beam_z", "beam_root_of_squares"],
        ["10 a: along x", "10 b: along y", "10 c: along z", "10 d: root of the sum of squares"],
    ):
        axes.plot(time_ms, rays[name][first])
        axes.set(title=f"Figure {words}", xlabel="time (ms)", ylabel="over the power launched")
    panels.flat[5].plot(found.table("clusters")["time_s"], found.table("clusters")["dispersion_degree"])
    panels.flat[5].set(title="Not in the largest cluster", xlabel="time (s)", ylabel="part of the mass", ylim=(0, 1.02))
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the run and the pictures go")
    parser.add_argument("--short", action="store_true", help="a twentieth of the grains, for a try")
    given = parser.parse_args()
    found = run(given.folder / "run", given.short)
    with plt.rc_context(agglo.plot_style()):
        draw_rays(found).savefig(given.folder / "rays.png", dpi=80)
        draw_series(found).savefig(given.folder / "series.png", dpi=80)
    pulse = found.summary["pulses"][0]
    print(
        f"first pulse: {pulse['reflections']:,} reflections, {pulse['segments']:,} segments; the paper has 59,238 of 2,000 grains"
    )
    print(f"dispersion degree: {found.summary['dispersion_degree']:.4f}")


if __name__ == "__main__":
    main()
