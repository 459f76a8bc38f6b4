"""Figures 4 and 5 and tables 1 to 3 of T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004): which grains grow most?

    python3 examples/reacting_search.py out/reacting               # minutes; --short: seconds, few and small runs

The search is the shipped `search`, the paper's genetic algorithm with consistent laws. Figure 4 is the cost of the best and its mean
radius over generations, figure 5 the cloud of the best in time; tables 1 to 3 are the best candidates, in the paper's units.
"""

import argparse
import csv
import json
import subprocess
import sys
from pathlib import Path

import agglo
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle

SHORT = [
    "settings=['grains.0.size.length_ratio.count=60','grains.0.placement.fill.count=60','time.end=1 ms','output.frames=0.1 ms']",
    "method.published_genetic.population=6",
    "method.published_genetic.parents=2",
    "method.published_genetic.offspring=2",
    "method.published_genetic.generations=3",
    "ensemble.until.running_mean.most=2",
    "confirm.candidates=6",
    "confirm.replicates=2",
]
# Tables 1 and 2: the column of best.csv, its name in the paper, and what the paper multiplies it with.
COLUMNS = [
    ("v_m_s", "v_x rel", 0.5e-2),
    ("length_ratio", "L", 1.0),
    ("density_kg_m3", "rho", 1e-4),
    ("hardness_Pa", "H0", 1e-6),
    ("heat_capacity_J_kg_K", "C", 0.5e-3),
    ("friction", "mu", 1e2),
    ("temperature_K", "theta0", 1e-3),
    ("activation_energy_J_mol", "Q", 1e-3),
    ("reaction_heat_J_m2", "alpha", 1e-14),
    ("surface_energy_J_m2", "gamma", 1e-16),
]
PAPER = [(0.67708, 3.2292), (0.79078, 2.0922), (0.79636, 2.0394), (0.79957, 2.0043), (0.80036, 1.9964), (0.80691, 1.9309)]


def search(folder, short):
    """The folder of the search; it is run if it has not been."""
    if not (folder / "summary.json").is_file():
        agglo_command = [sys.executable, "-m", "agglo"]
        file = folder.parent / "search.toml"
        file.parent.mkdir(parents=True, exist_ok=True)
        new = subprocess.run([*agglo_command, "new", "search"], check=True, capture_output=True, text=True)
        file.write_text(new.stdout)
        settings = [word for setting in (SHORT if short else []) for word in ("--set", setting)]
        subprocess.run([*agglo_command, "search", str(file), "-o", str(folder), "--no-report", *settings], check=True)
    return folder


def table(file):
    """The rows of a table of a search, as dicts of texts."""
    with file.open(encoding="utf-8", newline="") as lines:
        return list(csv.DictReader(lines))


def draw_course(folder):
    """Figure 4: cost and mean radius of the best so far over the generations."""
    generations = [row for row in table(folder / "generations.csv") if row["stage"] == "search" and row["best_evaluation"]]
    evaluations = {row["evaluation"]: row for row in table(folder / "evaluations.csv")}
    number = [int(row["generation"]) for row in generations]
    cost = [float(row["best_cost"]) for row in generations]
    radius = [float(evaluations[row["best_evaluation"]]["radius_ratio"]) for row in generations]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    left.step(number, cost, where="post", label="agglo")
    right.step(number, radius, where="post", label="agglo")
    for axes, (value, words) in zip(
        (left, right), zip(PAPER[0], ("cost Π of the best", "its mean radius over that at the start"))
    ):
        axes.axhline(value, color="#999999", label="the paper after 25 generations")
        axes.set(xlabel="generation", ylabel=words)
        axes.legend()
    left.set_title("Figure 4 a")
    right.set_title("Figure 4 b")
    return figure


def draw_cloud(found):
    """Figure 5: the cloud of the best at six moments, each later than the one before; colors are primaries."""
    figure, panels = plt.subplots(2, 3, figsize=(9.6, 6.6), sharex=True, sharey=True, layout="constrained")
    frames = found.frames()
    chosen = np.unique(np.concatenate([[0], np.geomspace(1, len(frames) - 1, 5).round().astype(int)]))
    most = found.grains()[1]["primaries"].max()
    half_mm = 1e3 * 0.01
    for axes, at in zip(panels.flat, chosen):
        time_s, grains = found.grains(int(at))
        # The farthest along y first, so that the nearest cover them.
        order = np.argsort(-grains["position_m"][:, 1])
        place, radius = 1e3 * grains["position_m"][order], 1e3 * grains["radius_m"][order]
        circles = PatchCollection(
            [Circle((x, z), r) for (x, _, z), r in zip(place, radius)],
            cmap="viridis",
            array=np.log2(grains["primaries"][order]),
            edgecolor="#222222",
            linewidth=0.3,
        )
        circles.set_clim(0.0, max(np.log2(most), 1.0))
        axes.add_collection(circles)
        axes.set(
            title=f"{1e3 * time_s:.2f} ms: {len(place):,} grains",
            xlim=(-half_mm, half_mm),
            ylim=(-half_mm, half_mm),
            aspect="equal",
        )
        axes.grid(False)
    for axes in panels[-1]:
        axes.set_xlabel("x (mm)")
    for axes in panels[:, 0]:
        axes.set_ylabel("z (mm)")
    bar = figure.colorbar(circles, ax=panels, shrink=0.7, label="primaries in a grain")
    powers = np.arange(0, int(max(np.log2(most), 1.0)) + 1, 2)
    bar.set_ticks(powers, labels=[str(2**power) for power in powers])
    return figure


def print_tables(folder):
    """Tables 1 to 3: the best candidates as they were confirmed."""
    evaluations = {row["evaluation"]: row for row in table(folder / "evaluations.csv")}
    print("| rank | " + " | ".join(f"{name} x {factor:g}" for _, name, factor in COLUMNS) + " |")
    best = table(folder / "best.csv")
    for row in best:
        print(f"| {row['rank']} | " + " | ".join(f"{factor * float(row[key]):.5f}" for key, _, factor in COLUMNS) + " |")
    print("\n| rank | Pi | ± | b_f/b_0 | n_f | Pi of the paper | b_f/b_0 of the paper |")
    for row, (cost, radius) in zip(best, PAPER):
        outcome = evaluations[row["evaluation"]]
        cells = [f"{float(row['cost']):.5f}", f"{float(row['cost_standard_error']):.5f}"]
        cells += [f"{float(outcome['radius_ratio']):.4f}", f"{float(outcome['n_f']):.4f}", f"{cost}", f"{radius}"]
        print(f"| {row['rank']} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the search and the pictures go")
    parser.add_argument("--short", action="store_true", help="few and small runs, for a try")
    given = parser.parse_args()
    folder = search(given.folder / "search", given.short)
    with plt.rc_context(agglo.plot_style()):
        draw_course(folder).savefig(given.folder / "course.svg")
        draw_cloud(agglo.read(folder / "best")).savefig(given.folder / "cloud.png", dpi=80)
    print_tables(folder)
    first = table(folder / "best.csv")[0]
    print(
        "\nthe first once more, from starts that had no part in choosing it: "
        f"Pi = {float(first['final_cost']):.4f} ± {float(first['final_cost_standard_error']):.4f}"
    )
    runs = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["runs"]
    print(f"{runs:,} runs")


if __name__ == "__main__":
    main()
