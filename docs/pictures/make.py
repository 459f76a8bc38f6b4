#!/usr/bin/env python3
"""Draws the pictures of this folder from runs of the shipped scenarios.

    cargo build --release
    python3 -m venv target/venv
    target/venv/bin/pip install -r docs/pictures/requirements.txt
    target/venv/bin/python docs/pictures/make.py

The runs go to a temporary folder, or to the one given with --runs, where those that are there already are used again.
VTK draws without a window; it needs OpenGL, EGL or OSMesa.
"""

import argparse
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import vtk  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402
from PIL import Image  # noqa: E402  (comes with matplotlib)
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
DISPERSAL = "acoustic-dispersal"
REACTING = "reacting-agglomeration"

PULSES = 4
PERIOD = 0.5
GRAINS = 2000

# Okabe and Ito's colors, which the color-blind tell apart.
BLACK, ORANGE, SKY, GREEN, YELLOW = "#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442"
BLUE, VERMILION, PURPLE, GREY = "#0072B2", "#D55E00", "#CC79A7", "#999999"

# Metres that a panel is high, and its center: nearly all grains are inside at the end.
VIEW_HEIGHT = 4.8
VIEW_CENTER = (0.15, 0.0, 0.0)

# Half the edge of the reacting grains' box [m], their number, and starts of each set.
HALF_EDGE = 0.01
REACTING_GRAINS = 1000
STARTS = 12


def run(agglo, folder, scenario, *settings, seed=None):
    """Runs a shipped scenario into `folder`, unless it has been."""
    if not (folder / "summary.json").exists():
        words = [word for setting in settings for word in ("--set", setting)]
        words += [] if seed is None else ["--seed", str(seed)]
        subprocess.run([agglo, "run", str(ROOT / f"scenarios/{scenario}.toml"), "-o", str(folder), *words], check=True)
    return folder


def series(folder, name):
    """A table of a run: columns by name."""
    return np.genfromtxt(folder / f"series/{name}.csv", delimiter=",", names=True)


def frame(folder, kind, time):
    """The VTK data of the frame next to a time [s], and its own time."""
    listing = ElementTree.parse(folder / f"frames/{kind}.pvd").getroot().iter("DataSet")
    frames = {float(entry.get("timestep")): entry.get("file") for entry in listing}
    nearest = min(frames, key=lambda at: abs(at - time))
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / "frames" / frames[nearest]))
    reader.Update()
    return reader.GetOutput(), nearest


def cluster_sizes(grains):
    """Number of grains in the cluster of each grain."""
    cluster = vtk_to_numpy(grains.GetPointData().GetArray("cluster")).astype(int)
    return np.bincount(cluster)[cluster]


def lookup(colors, norm):
    """A VTK table of a matplotlib color map, logarithmic over the norm."""
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for entry in range(256):
        table.SetTableValue(entry, *colors(entry / 255))
    table.SetRange(norm.vmin, norm.vmax)
    table.SetScaleToLog10()
    return table


def grains_actor(grains, sizes, colors, norm):
    """Grains as spheres, colored by a size that each has."""
    data = vtk.vtkPolyData()
    data.ShallowCopy(grains)
    column = numpy_to_vtk(sizes.astype(float), deep=True)
    column.SetName("size")
    data.GetPointData().AddArray(column)
    sphere = vtk.vtkSphereSource()
    sphere.SetRadius(1.0)
    sphere.SetThetaResolution(24)
    sphere.SetPhiResolution(16)
    mapper = vtk.vtkGlyph3DMapper()
    mapper.SetInputData(data)
    mapper.SetSourceConnection(sphere.GetOutputPort())
    mapper.SetScaleModeToScaleByMagnitude()
    mapper.SetScaleArray("radius_m")
    mapper.SetLookupTable(lookup(colors, norm))
    mapper.SetUseLookupTableScalarRange(True)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("size")
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    light = actor.GetProperty()
    light.SetAmbient(0.25)
    light.SetDiffuse(0.75)
    light.SetSpecular(0.15)
    light.SetSpecularPower(20)
    return actor


def rays_actor(rays, color):
    """Rays as short strokes that end where they are."""
    here = vtk_to_numpy(rays.GetPoints().GetData())
    direction = vtk_to_numpy(rays.GetPointData().GetArray("direction"))
    points, lines = vtk.vtkPoints(), vtk.vtkCellArray()
    for tip, along in zip(here, direction):
        lines.InsertNextCell(2)
        lines.InsertCellPoint(points.InsertNextPoint(*(tip - 0.06 * along)))
        lines.InsertCellPoint(points.InsertNextPoint(*tip))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetLines(lines)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*matplotlib.colors.to_rgb(color))
    actor.GetProperty().SetLineWidth(1.4)
    actor.GetProperty().SetLighting(False)
    return actor


def render(actors, width, height, view=(VIEW_CENTER, VIEW_HEIGHT)):
    """The picture of actors seen along y, x to the right and z up, as an array; a view has a center and a height."""
    (x, y, z), tall = view
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    for actor in actors:
        renderer.AddActor(actor)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(tall / 2)
    camera.SetFocalPoint(x, y, z)
    camera.SetPosition(x, y - 2.0 * tall, z)
    camera.SetViewUp(0.0, 0.0, 1.0)
    renderer.ResetCameraClippingRange()
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[::-1]


def save(figure, path, dpi):
    """Writes a figure without transparency, which would take a third more room."""
    with tempfile.TemporaryDirectory() as folder:
        full = Path(folder) / "full.png"
        figure.savefig(full, dpi=dpi)
        plt.close(figure)
        with Image.open(full) as image:
            image.convert("RGB").save(path, optimize=True)


def scale_bar(axes, right, bottom):
    """A bar of one meter, in the picture's meters."""
    axes.plot([right - 1.0, right], [bottom, bottom], color=BLACK, linewidth=3, solid_capstyle="butt")
    axes.text(right - 0.5, bottom + 0.07, "1 m", ha="center", va="bottom", fontsize=11)


def dispersal(bonded, flight, path):
    """The agglomerate under the first pulse and after the first, second and fourth."""
    colors, norm = matplotlib.colormaps["cividis"], LogNorm(1, GRAINS)
    early, early_time = frame(flight, "grains", 0.5e-3)
    rays, _ = frame(flight, "rays", 0.5e-3)
    # Grains drift apart after their pulse, so each state is that at the end of its half second.
    states = [(early, f"the first pulse on its way ({early_time * 1e3:.1f} ms)", rays)]
    for pulses, words in [(1, "after one pulse"), (2, "after two pulses"), (4, "after four pulses")]:
        grains, time = frame(bonded, "grains", pulses * PERIOD)
        states.append((grains, f"{words} ({time:.1f} s)", None))

    figure, panels = plt.subplots(2, 2, figsize=(12, 11.0))
    figure.subplots_adjust(left=0.01, right=0.99, top=0.945, bottom=0.1, wspace=0.02, hspace=0.14)
    half = VIEW_HEIGHT / 2
    aspect = 1.25
    extent = (VIEW_CENTER[0] - aspect * half, VIEW_CENTER[0] + aspect * half, -half, half)
    for axes, (grains, title, flying) in zip(panels.flat, states):
        actors = [grains_actor(grains, cluster_sizes(grains), colors, norm)]
        if flying is not None:
            actors.append(rays_actor(flying, VERMILION))
        axes.imshow(render(actors, 1000, 800), extent=extent, interpolation="antialiased")
        sizes = cluster_sizes(grains)
        free = np.count_nonzero(sizes == 1)
        axes.set_title(f"{title}\nlargest clump: {sizes.max():,} grains; free grains: {free:,}", fontsize=13)
        axes.set_xlim(extent[:2])
        axes.set_ylim(extent[2:])
        axes.set_xticks([])
        axes.set_yticks([])
        for side in axes.spines.values():
            side.set_color("#cccccc")
        scale_bar(axes, extent[1] - 0.15, -half + 0.15)
    first = panels.flat[0]
    first.annotate(
        "direction of the beam", (0.55, 1.75), (-2.3, 1.75), va="center", color=VERMILION, fontsize=12,
        arrowprops={"arrowstyle": "-|>", "color": VERMILION, "linewidth": 2},
    )
    front = vtk_to_numpy(rays.GetPoints().GetData())[:, 0].max()
    first.text(front, 1.12, "front of the pulse", color=VERMILION, fontsize=12, ha="left")
    first.text(-1.3, -1.22, "reflected rays", color=VERMILION, fontsize=12, ha="center")
    bar = figure.add_axes((0.2, 0.058, 0.6, 0.017))
    figure.colorbar(matplotlib.cm.ScalarMappable(norm, colors), cax=bar, orientation="horizontal")
    bar.set_xlabel("grains in a grain's clump (bonded, or less than 5 % of a radius apart)", fontsize=12)
    ticks = [1, 10, 100, 1000, GRAINS]
    bar.set_xticks(ticks, ["1 (free)", "10", "100", "1,000", ""])
    bar.minorticks_off()
    save(figure, path, 105)


def since_pulse(rays, pulse):
    """Times since a pulse [ms] and the rows of rays.csv until it has gone."""
    start = pulse * PERIOD
    rows = (rays["time_s"] > start) & (rays["time_s"] < start + 8e-3)
    return (rays["time_s"][rows] - start) * 1e3, rows


def rays_picture(bonded, path):
    """Reflections, rays in flight and the beam's power by direction after each pulse."""
    rays = series(bonded, "rays")
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(14, 4.6), constrained_layout=True)
    colors = [BLUE, VERMILION, GREEN, PURPLE]
    for pulse, (color, style) in enumerate(zip(colors, ["-", "--", "-.", ":"])):
        time, rows = since_pulse(rays, pulse)
        before = rays["reflections"][rays["time_s"] <= pulse * PERIOD][-1]
        words = {"color": color, "linestyle": style, "linewidth": 2, "label": f"pulse {pulse + 1}"}
        left.plot(np.append(0, time), np.append(0, rays["reflections"][rows] - before) / 1e3, **words)
        middle.plot(np.append(0, time), np.append(10_000, rays["in_flight"][rows]), **words)
    left.set_ylabel("reflections so far (thousands)")
    left.set_ylim(0, None)
    left.legend(loc="lower right", handlelength=3)
    left.set_title("Rays bounce about five times each")
    middle.set_ylabel("rays in flight, of 10,000")
    middle.set_yscale("log")
    middle.set_ylim(0.8, 1.5e4)
    middle.legend(loc="upper right")
    middle.set_title("Nine in ten are gone within 3.5 ms")
    time, rows = since_pulse(rays, 0)
    for name, start, color, style, label in [
        ("magnitude", 1, BLACK, "-", "in all"),
        ("x", 1, VERMILION, "--", "along x, the beam's direction"),
        ("y", 0, SKY, "-.", "along y"),
        ("z", 0, GREEN, ":", "along z"),
    ]:
        power = np.append(start, rays[f"flying_{name}"][rows])
        right.plot(np.append(0, time), power, color=color, linestyle=style, linewidth=2, label=label)
    right.set_ylabel("power in flight over that launched")
    right.legend(loc="upper right")
    right.set_title("Pulse 1: direction is lost before power")
    right.set_xlim(0, 4)
    for axes in (left, middle):
        axes.set_xlim(0, 8)
    for axes in (left, middle, right):
        axes.set_xlabel("time since the pulse (ms)")
        axes.grid(alpha=0.3)
    save(figure, path, 110)


def energy_picture(bonded, path):
    """Where the work of the rays is: stores and losses one upon another."""
    energy = series(bonded, "energy")
    layers = [
        ("motion of the grains", ["kinetic_J"], BLUE),
        ("rotation of the grains", ["rotational_J"], SKY),
        ("springs of contacts and bonds", ["elastic_J", "tangential_spring_J", "bonds_J"], BLACK),
        ("lost to friction", ["lost_friction_J"], VERMILION),
        ("lost in contact damping", ["lost_contact_damping_J"], ORANGE),
        ("lost to drag of the water", ["lost_drag_J"], YELLOW),
        ("lost in bond damping", ["lost_bond_damping_J"], GREEN),
        ("lost with broken bonds", ["lost_broken_bonds_J"], PURPLE),
    ]
    time = energy["time_s"]
    heights = [sum(energy[name] for name in names) / 1e3 for _, names, _ in layers]
    figure, axes = plt.subplots(figsize=(11, 6), constrained_layout=True)
    areas = axes.stackplot(time, heights, colors=[color for *_, color in layers], linewidth=0)
    (work,) = axes.plot(time, energy["work_rays_J"] / 1e3, color=BLACK, linestyle="--", linewidth=1.5)
    largest = np.abs(energy["drift_J"]).max()
    axes.set_title(
        "Every joule that the rays put in is accounted for, "
        f"but for {largest:.0f} J of {energy['work_rays_J'][-1]:,.0f} J"
    )
    for pulse in range(PULSES):
        height = np.interp(pulse * PERIOD + 0.02, time, energy["work_rays_J"]) / 1e3
        axes.annotate(f"pulse {pulse + 1}", (pulse * PERIOD + 0.02, height + 0.06), ha="left", va="bottom")
    names = [name for name, *_ in layers]
    axes.legend([work, *areas[::-1]], ["work of the rays", *names[::-1]], loc="upper left")
    axes.set_xlim(0, PULSES * PERIOD)
    axes.set_ylim(0, 5.8)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("energy (kJ)")
    save(figure, path, 110)


def primaries(grains):
    """How many primary grains each grain is made of."""
    return vtk_to_numpy(grains.GetPointData().GetArray("primaries")).astype(int)


def agglomeration(early, whole, path):
    """The cloud of reacting grains at the start, as grains merge, and at the end."""
    shades = matplotlib.colormaps["viridis"](np.linspace(0.15, 1.0, 256))
    colors, norm = matplotlib.colors.ListedColormap(shades), LogNorm(1, 100)
    moments = [(early, 0.0), (early, 10e-6), (early, 50e-6), (whole, 0.01)]
    states = [frame(folder, "grains", at) for folder, at in moments]
    titles = ["at the start", "after 10 \u00b5s", "after 50 \u00b5s", "after 10 ms"]
    figure, panels = plt.subplots(2, 2, figsize=(10.4, 11.4))
    figure.subplots_adjust(left=0.01, right=0.99, top=0.945, bottom=0.095, wspace=0.02, hspace=0.13)
    half = 1.4 * HALF_EDGE
    for axes, (grains, _), title in zip(panels.flat, states, titles):
        sizes = primaries(grains)
        picture = render([grains_actor(grains, sizes, colors, norm)], 900, 900, ((0.0, 0.0, 0.0), 2 * half))
        axes.imshow(picture, extent=(-half, half, -half, half), interpolation="antialiased")
        box = np.array([-1, 1, 1, -1, -1]) * HALF_EDGE
        axes.plot(box, np.roll(box, -1)[[0, 1, 2, 3, 0]], color=GREY, linewidth=0.8, linestyle="--")
        largest = f"largest of {sizes.max():,} primaries" if sizes.max() > 1 else "one primary each"
        axes.set_title(f"{title}\n{sizes.size:,} grains; {largest}", fontsize=13)
        axes.set_xlim(-half, half)
        axes.set_ylim(-half, half)
        axes.set_xticks([])
        axes.set_yticks([])
        for side in axes.spines.values():
            side.set_color("#cccccc")
        right, bottom = half - 0.6e-3, -half + 0.5e-3
        axes.plot([right - 5e-3, right], [bottom, bottom], color=BLACK, linewidth=3, solid_capstyle="butt")
        axes.text(right - 2.5e-3, bottom + 0.3e-3, "5 mm", ha="center", va="bottom", fontsize=11)
    bar = figure.add_axes((0.2, 0.056, 0.6, 0.016))
    figure.colorbar(matplotlib.cm.ScalarMappable(norm, colors), cax=bar, orientation="horizontal")
    bar.set_xlabel("primary grains that a grain is made of", fontsize=12)
    bar.set_xticks([1, 10, 100], ["1", "10", "100"])
    bar.minorticks_off()
    save(figure, path, 85)


def growth_picture(sets, early, whole, path):
    """Mean radius over time of the six sets, and where the mass is as grains of set 1 grow."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(14, 5.4), constrained_layout=True)
    colors = [BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY]
    for (number, folders), color, style in zip(sets.items(), colors, ["-", "--", "-.", ":", "-", "--"]):
        tables = [series(folder, "grains") for folder in folders]
        ratio = np.array([table["radius_ratio"] for table in tables])
        time, mean = tables[0]["time_s"][1:] * 1e6, ratio.mean(axis=0)[1:]
        error = ratio.std(axis=0, ddof=1)[1:] / len(tables) ** 0.5
        left.plot(time, mean, color=color, linestyle=style, linewidth=2, label=f"set {number}")
        left.fill_between(time, mean - error, mean + error, color=color, alpha=0.2, linewidth=0)
    left.set_xscale("log")
    left.set_xlim(2, 1e4)
    left.set_ylim(1, None)
    left.set_xlabel("time (\u00b5s)")
    left.set_ylabel("mean radius over that at the start")
    left.set_title(f"Growth ends after a few milliseconds (means of {STARTS} starts)")
    left.legend(loc="upper left", handlelength=3)
    edges = 2 ** np.arange(8)
    shades = matplotlib.colormaps["viridis"](np.linspace(0, 0.9, 5))
    moments = [(early, 0.0), (early, 10e-6), (early, 50e-6), (early, 0.2e-3), (whole, 0.01)]
    labels = ["at the start", "10 \u00b5s", "50 \u00b5s", "200 \u00b5s", "10 ms"]
    for place, ((folder, at), shade, label) in enumerate(zip(moments, shades, labels)):
        sizes = primaries(frame(folder, "grains", at)[0])
        mass = np.histogram(sizes, edges, weights=sizes)[0] / sizes.sum()
        words = f"{label}: {sizes.size:,} grains"
        right.bar(np.arange(7) + 0.16 * (place - 2), 100 * mass, 0.16, color=shade, label=words)
    right.set_xticks(np.arange(7), [f"{low}-{2 * low - 1}" if low > 1 else "1" for low in edges[:-1]])
    right.set_xlabel("primary grains that a grain is made of")
    right.set_ylabel("part of the mass (%)")
    right.set_title("Mass moves to large grains (set 1, one start)")
    right.legend(loc="upper right")
    for axes in (left, right):
        axes.grid(alpha=0.3)
        axes.set_axisbelow(True)
    save(figure, path, 105)


def dispersal_pictures(agglo, runs):
    """Runs the agglomerate under acoustic pulses and draws it."""
    bonded = run(agglo, runs / "bonded", DISPERSAL, 'output.series="0.1 ms"')
    flight = run(
        agglo, runs / "flight", DISPERSAL, 'time.end="1.5 ms"', 'output.frames="0.25 ms"', 'output.series="0.25 ms"'
    )
    dispersal(bonded, flight, HERE / "dispersal.png")
    rays_picture(bonded, HERE / "rays.png")
    energy_picture(bonded, HERE / "energy.png")


def reacting_pictures(agglo, runs):
    """Runs the reacting grains and draws them."""
    whole = run(agglo, runs / "reacting", REACTING)
    early = run(
        agglo, runs / "reacting-early", REACTING, 'time.end="0.2 ms"', 'output.frames="5 us"', 'output.series="5 us"'
    )
    often = ('output.series="2 us"', 'output.frames="10 ms"', 'output.checkpoints="10 ms"')
    sets = {
        number: [
            run(agglo, runs / f"set-{number}-{seed}", f"reacting-set-{number}", *often, seed=seed)
            for seed in range(1, STARTS + 1)
        ]
        for number in range(1, 7)
    }
    agglomeration(early, whole, HERE / "agglomeration.png")
    growth_picture(sets, early, whole, HERE / "growth.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--agglo", default=str(ROOT / "target/release/agglo"), help="the program")
    parser.add_argument("--runs", type=Path, help="folder for the runs, kept")
    parser.add_argument("--only", choices=["dispersal", "reacting"], help="draw only the pictures of one kind")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        runs = options.runs or Path(temporary)
        if options.only in (None, "dispersal"):
            dispersal_pictures(options.agglo, runs)
        if options.only in (None, "reacting"):
            reacting_pictures(options.agglo, runs)


if __name__ == "__main__":
    main()
