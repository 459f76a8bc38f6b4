"""Results as tables, graphs, meshes and atoms, and starts from arrays."""

import subprocess
import sys

import agglo
import numpy as np
import pytest

SOFT = {
    "grains.0.placement.random.count": 150,
    "grains.0.placement.random.region.sphere.radius": "0.55 m",
    "acoustics.beams.0.rays": 500,
    "time.end": "4 ms",
    "output.frames": "1 ms",
}
HARD = {
    "grains.0.size.length_ratio.count": 300,
    "grains.0.placement.fill.count": 300,
    "time.end": "0.6 ms",
    # Weak enough that some of what has merged breaks again.
    "materials.grain.surface_energy": "3 kJ/m2",
    "output.series": "0.1 ms",
    "output.frames": "0.1 ms",
}


@pytest.fixture(scope="module")
def soft(tmp_path_factory):
    return agglo.run(agglo.Scenario.template("acoustic", SOFT), tmp_path_factory.mktemp("runs") / "soft")


@pytest.fixture(scope="module")
def hard(tmp_path_factory):
    return agglo.run(agglo.Scenario.template("reacting", HARD), tmp_path_factory.mktemp("runs") / "hard")


def test_what_is_missing_is_said_with_what_to_install():
    code = """
import sys
for name in ["matplotlib", "networkx", "pandas", "pyarrow", "pyvista", "polars", "ase"]:
    sys.modules[name] = None
import agglo
table = agglo.Table()
for call, told in [
    (table.pandas, 'Table.pandas needs pandas, which is not installed; pip install "agglo[plots]"'),
    (table.polars, "Table.polars needs polars, which is not installed; pip install polars"),
    (lambda: table.parquet("x"), "needs pyarrow"),
    (lambda: agglo.to_ase({"position_m": agglo.pack(scenario)["position_m"]}), "pip install ase"),
    (lambda: agglo.to_pyvista({}), "needs pyvista"),
]:
    scenario = agglo.Scenario.template("acoustic", {"grains.0.placement.random.count": 3})
    try:
        call()
    except agglo.PackageError as error:
        assert isinstance(error, ImportError) and isinstance(error, agglo.InputError) and told in str(error), str(error)
    else:
        raise AssertionError(told)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_sizes_of_a_frame_are_those_of_the_series(hard):
    series = hard.table("sizes")
    for frame, (time_s, _) in enumerate(hard.frames()):
        sizes, rows = hard.sizes(frame), series["time_s"] == time_s
        for name in ("lower_primaries", "upper_primaries", "grains"):
            assert np.array_equal(sizes[name], series[name][rows]), f"{name} at {time_s} s"
        for name in ("mass_kg", "mass_fraction"):
            # Round-off of a sum of 300.
            assert sizes[name] == pytest.approx(series[name][rows], rel=1e-13), f"{name} at {time_s} s"
    assert len(hard.sizes()["grains"]) > 2


def test_classes_of_ones_own_are_those_of_the_scenario(tmp_path):
    settings = {"grains.0.placement.fill.count": 100, "time.end": "0.1 s", "output.size_classes": [1, 3, 8]}
    run = agglo.run(agglo.Scenario.template("form", settings), tmp_path / "run")
    sizes, series = run.sizes(), run.table("sizes")
    last = series["time_s"] == series["time_s"][-1]
    assert sizes["lower_primaries"].tolist() == series["lower_primaries"][last].tolist() == [1, 3, 8]
    assert sizes["upper_primaries"][:2].tolist() == [2.0, 7.0] and np.isnan(sizes["upper_primaries"][2])
    assert np.array_equal(sizes["upper_primaries"], series["upper_primaries"][last], equal_nan=True)
    assert sizes["grains"].tolist() == series["grains"][last].tolist() and sizes["grains"].sum() == run.summary["grains_end"]
    kernels = run.kernels()["kernels"]
    assert kernels["merges"].sum() == run.summary["merges"] and set(kernels["a_lower_primaries"]) == {1, 3, 8}
    pytest.importorskip("matplotlib")
    labels = [label.get_text() for axes in run.plot().axes for label in axes.get_yticklabels()]
    assert {"1–2", "3–7", "8 and more"} <= set(labels)
    assert "8 and more" in run.report().read_text(encoding="utf-8")


def test_sizes_of_soft_spheres_are_those_of_their_clusters(soft):
    sizes, clusters = soft.sizes(0), soft.table("clusters")
    assert sizes["grains"].sum() == clusters["clusters"][0]
    assert sizes["mass_fraction"].sum() == pytest.approx(1.0, rel=1e-14)
    largest = clusters["largest_grains"][0]
    assert sizes["lower_primaries"][-1] <= largest <= sizes["upper_primaries"][-1] and largest > 1


def test_the_genealogy_keeps_mass_and_primaries_and_ends_at_the_last_frame(hard):
    pytest.importorskip("networkx")
    graph = hard.genealogy()
    assert hard.summary["fragmentations"] > 0 and hard.summary["merges"] > 50
    start, end = hard.grains(0)[1], hard.grains()[1]
    for node, of in graph.nodes(data=True):
        for way in ("in_edges", "out_edges"):
            edges = list(getattr(graph, way)(node, data=True))
            if edges:
                assert sum(edge["primaries"] for *_, edge in edges) == of["primaries"], (node, way)
                assert sum(edge["mass_kg"] for *_, edge in edges) == pytest.approx(of["mass_kg"], rel=1e-12), (node, way)
                times = {edge["time_s"] for *_, edge in edges}
                assert times == {of["born_s" if way == "in_edges" else "ended_s"]}, (node, way)
    assert sum(1 for node in graph if graph.in_degree(node) == 0) == len(start["id"])
    left = {of["grain"]: of for node, of in graph.nodes(data=True) if graph.out_degree(node) == 0}
    assert sorted(left) == end["id"].tolist()
    assert [left[grain]["primaries"] for grain in sorted(left)] == end["primaries"].tolist()
    assert [left[grain]["mass_kg"] for grain in sorted(left)] == pytest.approx(end["mass_kg"], rel=1e-12)
    assert all(np.isnan(of["ended_s"]) for of in left.values())
    merges = [
        node
        for node in graph
        if graph.in_degree(node) == 2 and {edge["kind"] for *_, edge in graph.in_edges(node, data=True)} == {"merge"}
    ]
    assert len(merges) == hard.summary["merges"]


def test_events_and_kernels_are_tables(soft, hard):
    events = hard.events()
    assert np.count_nonzero(events["kind"] == "merge") == hard.summary["merges"]
    kernels = hard.kernels()
    assert kernels["kernels"]["merges"].sum() == hard.summary["merges"]
    assert kernels["breakage"]["breakages"].sum() == hard.summary["fragmentations"]
    with pytest.raises(agglo.InputError, match="no table 'kernels' in"):
        soft.kernels()
    with pytest.raises(agglo.InputError, match="no table 'genealogy'"):
        pytest.importorskip("networkx")
        soft.genealogy()


def test_bonds_and_rays_of_a_frame(soft):
    _, bonds = soft.bonds(0)
    assert len(bonds["grain_i"]) == soft.summary["bonds_start"] and np.all(bonds["grain_i"] < bonds["grain_j"])
    assert bonds["stretch"] == pytest.approx(0.0, abs=1e-12)
    time_s, rays = soft.rays(1)
    table = soft.table("rays")
    row = np.argmin(np.abs(table["time_s"] - time_s))
    assert len(rays["power_W"]) == table["in_flight"][row] > 0 and rays["position_m"].shape == rays["direction"].shape
    assert rays["power_W"].sum() == pytest.approx(table["flying_magnitude"][row] * table["power_in_W"][row], rel=1e-9)
    with pytest.raises(agglo.InputError, match="no frame 99 of rays"):
        soft.rays(99)


def test_parquet_brings_back_the_same_bits(hard, tmp_path):
    files = pytest.importorskip("pyarrow.parquet")
    for name, table in [("energy", hard.table("energy")), ("events", hard.events())]:
        back = files.read_table(table.parquet(tmp_path / f"{name}.parquet"))
        assert back.column_names == list(table)
        for column, values in table.items():
            assert np.array_equal(back[column].to_numpy(), values, equal_nan=values.dtype.kind == "f"), column


def test_frames_of_pandas(hard):
    pytest.importorskip("pandas")
    frame = hard.table("grains").pandas()
    assert frame["grains"].iloc[-1] == hard.summary["grains_end"]


def test_meshes_have_grains_with_radii_and_bonds_as_lines(soft):
    vista = pytest.importorskip("pyvista")
    time_s, grains = soft.grains()
    for mesh in (soft.pyvista(), agglo.to_pyvista(grains)):
        assert np.array_equal(mesh.points, grains["position_m"]) and np.array_equal(
            mesh.point_data["radius_m"], grains["radius_m"]
        )
    spheres = agglo.to_pyvista(grains).glyph(scale="radius_m", geom=vista.Sphere(radius=1.0), orient=False)
    reach = (grains["position_m"] + grains["radius_m"][:, None]).max()
    # The poles of the sphere lie along z, so that along x and y facets are a little short of it.
    assert max(spheres.bounds[1::2]) == pytest.approx(reach, rel=2e-2)
    bonds = soft.pyvista(kind="bonds")
    assert bonds.n_lines == soft.table("clusters")["bonds"][-1] > 0
    simulation = agglo.Simulation(soft.scenario)
    lines = agglo.to_pyvista(simulation.grains(), simulation.bonds())
    pairs = lines.lines.reshape(-1, 3)
    assert np.array_equal(pairs[:, 1:], simulation.bonds()) and lines.n_lines == soft.summary["bonds_start"]
    with pytest.raises(agglo.InputError, match="not among the grains"):
        agglo.to_pyvista(grains, np.array([[0, 9999]], dtype=np.uint32))


def test_atoms_have_their_unit_and_come_back(soft, tmp_path):
    pytest.importorskip("ase")
    atoms, (time_s, grains) = soft.ase(length_unit_m=1e-3), soft.grains()
    assert atoms.get_positions() == pytest.approx(1e3 * grains["position_m"], rel=1e-14)
    assert np.array_equal(atoms.arrays["velocity_m_s"], grains["velocity_m_s"]) and atoms.info["time_s"] == time_s
    again = agglo.pack(agglo.start(atoms, tmp_path / "start", soft.scenario))
    assert again["position_m"] == pytest.approx(grains["position_m"], rel=1e-14)
    with pytest.raises(agglo.InputError, match="above 0"):
        agglo.to_ase(grains, length_unit_m=0.0)


def test_a_start_from_arrays_has_their_bits(soft, tmp_path):
    _, grains = soft.grains()
    mixed = {name: values[::-1] for name, values in grains.items()}
    scenario = agglo.start(mixed, tmp_path / "start", soft.scenario)
    packed = agglo.pack(scenario)
    for name in ("id", "position_m", "velocity_m_s", "angular_velocity_rad_s", "radius_m", "temperature_K", "material"):
        assert np.array_equal(packed[name], grains[name]), name
    with pytest.raises(agglo.InputError, match="grains-0.csv is there already"):
        agglo.start(mixed, tmp_path / "start", soft.scenario)
    run = agglo.run(scenario, tmp_path / "run")
    assert np.array_equal(run.grains(0)[1]["position_m"], grains["position_m"])
    assert (tmp_path / "run/tables").is_dir()


def test_bonds_are_those_that_are_given(soft, tmp_path):
    """Bonds by the ids of a column, by places, and none at all; a run has them, and breaks no other."""
    simulation = agglo.Simulation(soft.scenario)
    grains, bonds = simulation.grains(), simulation.bonds()
    assert len(bonds) > 10
    # The same bonds by other names of the same grains.
    names = 7 + 3 * grains["id"]
    mixed = {name: values[::-1] for name, values in {**grains, "id": names}.items()}
    for number, (columns, given) in enumerate([(grains, bonds), (mixed, 7 + 3 * bonds.astype(np.int64))]):
        again = agglo.Simulation(agglo.start(columns, tmp_path / str(number), soft.scenario, bonds=given))
        assert np.array_equal(again.bonds(), given) and np.array_equal(again.grains()["id"], np.sort(columns["id"]))
        again.run_until(1e-5)
    some = agglo.start(grains, tmp_path / "some", soft.scenario, bonds=bonds[::3])
    assert len(agglo.Simulation(some).bonds()) == len(bonds[::3])
    assert len(agglo.Simulation(agglo.start(grains, tmp_path / "none", some, bonds=[])).bonds()) == 0
    # Without any the law bonds neighbors, and the table of another start is not kept.
    assert np.array_equal(agglo.Simulation(agglo.start(grains, tmp_path / "law", some)).bonds(), bonds)
    for given, told in [([[0, 9999]], r"there is no grain 9999"), ([0, 1], "found int64 of the shape"), ([[0.0, 1.0]], "found float64")]:
        with pytest.raises(agglo.InputError, match=told):
            agglo.start(grains, tmp_path / "bad", soft.scenario, bonds=given)
    with pytest.raises(agglo.InputError, match="a scenario is wanted"):
        agglo.start(grains, tmp_path / "bad", bonds=bonds)
    with pytest.raises(agglo.InputError, match="two grains have the same"):
        agglo.start({**grains, "id": np.zeros(len(names))}, tmp_path / "bad", soft.scenario)
    with pytest.raises(agglo.InputError, match="whole numbers from 0 on"):
        agglo.start({**grains, "id": names - 100.5}, tmp_path / "bad", soft.scenario)


def test_bonds_of_two_materials_find_their_grains(tmp_path):
    """Tables are written material by material; ids are those of the given order all the same."""
    place = np.array([[2e-3 * at, 0.0, 0.0] for at in range(4)])
    columns = {"position_m": place, "radius_m": np.full(4, 1e-3), "material": ["steel", "glass", "steel", "glass"]}
    hold = {"bonds.beam": {"youngs_modulus": "1 MPa", "tensile_strength": "1 MPa", "shear_strength": "1 MPa", "gap": 0.1}}
    scenario = agglo.Scenario(TWO).replace(hold)
    simulation = agglo.Simulation(agglo.start(columns, tmp_path / "start", scenario, bonds=[[0, 1], [3, 2]]))
    ends = simulation.grains()["position_m"][simulation.bonds()][:, :, 0]
    assert sorted(map(sorted, ends.tolist())) == [[0.0, 2e-3], [4e-3, 6e-3]]


TWO = """
version = 1
time.end = "1 ms"
engine.verlet = {}
materials.steel.density = "7800 kg/m3"
materials.glass.density = "2500 kg/m3"
[[grains]]
material = "steel"
charge = "2e-9 C"
velocity = ["1 m/s", "0 m/s", "0 m/s"]
size.constant.radius = "1 mm"
placement.list.positions = [["0 m", "0 m", "0 m"]]
"""


def test_materials_go_into_tables_of_their_own(tmp_path):
    place = 0.01 * np.arange(12.0).reshape(4, 3)
    columns = {"position_m": place, "radius_m": [1e-3, 2e-3, 1e-3, 2e-3], "material": ["steel", "glass", "steel", "glass"]}
    packed = agglo.pack(agglo.start(columns, tmp_path / "names", agglo.Scenario(TWO)))
    assert np.array_equal(packed["position_m"], place)
    # Frames number materials by the alphabet: glass, steel. What steel had besides it keeps.
    assert packed["material"].tolist() == [1, 0, 1, 0]
    assert packed["charge_C"].tolist() == [2e-9, 0.0, 2e-9, 0.0] and packed["velocity_m_s"][:, 0].tolist() == [1.0, 0.0, 1.0, 0.0]
    assert packed["mass_kg"] == pytest.approx(np.array([7800, 20000, 7800, 20000]) * 4e-9 / 3 * np.pi, rel=1e-14)
    numbers = agglo.start({**columns, "material": [1, 0, 1, 0]}, tmp_path / "numbers", agglo.Scenario(TWO))
    assert np.array_equal(agglo.pack(numbers)["material"], packed["material"])
    entries = agglo.start({**columns, "charge_C": np.full(4, 3e-9)}, tmp_path / "entries")
    assert [entry["material"] for entry in entries] == ["steel", "glass"] and entries[0]["charge"] == "3e-09 C"
    tables = agglo.Scenario(TWO).to_dict()
    assert agglo.pack(agglo.Scenario.from_dict({**tables, "grains": entries}))["charge_C"].tolist() == [3e-9] * 4
    for change, told in [
        ({"material": ["tin"] * 4}, "found 'tin'; the scenario has glass, steel"),
        ({"material": [0, 1, 2, 0]}, "found 2; the scenario has 0 to 1"),
        ({"radius_m": [1.0, 2.0]}, r"radius_m: found the shape \(2,\)"),
        ({"radius_m": [1.0, np.nan, 1.0, 1.0]}, "radius_m: found nan at grain 1"),
        ({"velocity_m_s": np.zeros((4, 2))}, "velocity_m_s: found the shape"),
        ({"position_m": np.zeros((0, 3))}, "there are none"),
    ]:
        with pytest.raises(agglo.InputError, match=told):
            agglo.start({**columns, **change}, tmp_path / "bad", agglo.Scenario(TWO))
    del columns["material"]
    with pytest.raises(agglo.InputError, match="a name for all or a column"):
        agglo.start(columns, tmp_path / "bad", agglo.Scenario(TWO))
    with pytest.raises(agglo.InputError, match="found int"):
        agglo.start(3, tmp_path / "bad", agglo.Scenario(TWO))
