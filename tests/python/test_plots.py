"""Charts with matplotlib, and what notebooks show."""

import html
import re

import agglo
import agglo._html
import agglo._plots
import agglo._search_plots
import numpy as np
import pytest
from test_results import hard, soft  # noqa: F401  (fixtures)


@pytest.fixture(autouse=True)
def no_window():
    pytest.importorskip("matplotlib").use("Agg")
    yield
    import matplotlib.pyplot

    matplotlib.pyplot.close("all")


def lines(axes):
    return {line.get_label(): line for line in axes.lines}


def test_charts_leave_out_no_energy(soft):  # noqa: F811
    shown = set(agglo._plots._STORES) | set(agglo._plots._FLOWS)
    assert shown == {column for column in soft.table("energy") if column.endswith("_J")}


def test_charts_show_the_tables(soft, hard, tmp_path):  # noqa: F811
    figure = soft.plot(["flows", "dispersion"])
    flows, dispersion = figure.axes
    energy = soft.table("energy")
    drawn = lines(flows)["put in by rays"]
    assert np.array_equal(drawn.get_ydata(), energy["work_rays_J"]) and drawn.get_xdata() == pytest.approx(1e3 * energy["time_s"])
    assert drawn.get_color() == "#0072b2" and flows.get_xlabel() == "time (ms)" and flows.get_ylabel() == "energy (J)"
    # What was nothing all along is left out.
    assert "put in by gravity" not in lines(flows) and "dispersion degree" in lines(dispersion)
    figure = hard.plot()
    assert len(figure.axes) == 7, "six charts and the scale of sizes"
    sizes = hard.table("sizes")
    mesh = np.asarray(figure.axes[2].collections[0].get_array())
    last = sizes["time_s"] == sizes["time_s"][-1]
    assert mesh[:, -1][mesh[:, -1] > 0] == pytest.approx(sizes["mass_fraction"][last])
    figure.savefig(tmp_path / "hard.png")
    assert (tmp_path / "hard.png").stat().st_size > 10_000
    assert len(soft.plot().axes) == 6
    with pytest.raises(agglo.InputError, match="no chart 'growth'; there are dispersion"):
        soft.plot("growth")


WALLS = {
    "version": 1,
    "time": {"end": "20 ms"},
    "output": {"series": "1 ms"},
    "engine": {"verlet": {}},
    "materials": {"glass": {"density": "2500 kg/m3", "youngs_modulus": "1 MPa", "poisson_ratio": 0.3}},
    "grains": [{"material": "glass", "size": {"constant": {"radius": "1 mm"}},
                "placement": {"list": {"positions": [["0 m", "0 m", "0.1 mm"], ["5 mm", "0 m", "0.99 mm"]]}}}],
    "walls": [
        {"name": "plate", "material": "glass", "shape": {"plane": {
            "point": ["0 m"] * 3, "normal": [0, 0, 1], "opening": {"center": ["0 m"] * 3, "radius": "2 mm"}}}},
        {"name": "lid", "material": "glass", "shape": {"plane": {"point": ["0 m", "0 m", "9 mm"], "normal": [0, 0, -1]}}},
    ],
    "contact": {"normal": {"hertz": {}}, "damping": {"restitution": {"restitution": 0.3}}},
    "fields": {"gravity": {"acceleration": ["0 m/s2", "0 m/s2", "-9.81 m/s2"]}},
}  # fmt: skip


def test_walls_have_a_line_each(soft, tmp_path):  # noqa: F811
    run = agglo.run(agglo.Scenario.from_dict(WALLS), tmp_path / "run")
    force, passed = run.plot(["walls", "passed"]).axes
    table = run.table("walls")
    plate = table["wall"] == 0
    # Nothing touches the lid; a grain falls through the hole of the plate, and one lies on it.
    assert list(lines(force)) == ["plate"] and list(lines(passed)) == ["plate"]
    pressed = np.linalg.norm([table[f"force_{axis}_N"][plate] for axis in "xyz"], axis=0)
    assert np.array_equal(lines(force)["plate"].get_ydata(), pressed) and pressed.max() > 0
    assert lines(passed)["plate"].get_xdata() == pytest.approx(1e3 * table["time_s"][plate])
    mass = 2500 * 4 / 3 * np.pi * 1e-9
    assert lines(passed)["plate"].get_ydata()[[0, -1]] == pytest.approx([0, mass]), "in kg"
    assert len(run.plot().axes) == 7, "five charts of every run, forces, and what has passed"
    with pytest.raises(agglo.InputError, match="no chart 'walls': the run has no walls"):
        soft.plot("walls")


QUICK = {
    "settings": ["time.end=1 ms", "grains.0.size.length_ratio.count=30", "grains.0.placement.fill.count=30"],
    "ensemble.until": {"fixed": {"replicates": 2}},
    "confirm": {"candidates": 2, "replicates": 2},
}
TWO = {
    "objectives": [{"minimize": "growth_deficit"}, {"maximize": "n_f"}],
    "method": {"genetic": {"population": 8, "generations": 2}},
}


def test_a_search_is_drawn_with_its_errors(tmp_path):
    campaign = agglo.Campaign.template("search", QUICK | {"method": {"cma_es": {"evaluations": 20}}})
    found = agglo.search(campaign, tmp_path / "search")
    table, generations = found.table("evaluations"), found.table("generations")
    searched = table["stage"] == "search"
    (axes,) = found.plot().axes
    assert np.array_equal(lines(axes)["candidates"].get_ydata(), table["cost"][searched])
    best = lines(axes)["best so far, ± one standard error"]
    lowest = [table["cost"][: int(count)].min() for count in best.get_xdata()]
    assert best.get_ydata().tolist() == lowest and best.get_xdata()[-1] == 20
    (fresh,) = axes.containers
    assert fresh.lines[0].get_ydata() == pytest.approx(table["cost"][~searched])
    low, high = fresh.lines[2][0].get_segments()[0][:, 1]
    assert (high - low) / 2 == pytest.approx(table["cost_standard_error"][~searched][0])
    assert axes.get_title(loc="left") == "growth_deficit, to be small" and len(generations["stage"]) > len(lowest)
    with pytest.raises(agglo.InputError, match="quantities are for studies"):
        found.plot("n_f")


def test_two_objectives_are_drawn_against_one_another(tmp_path):
    found = agglo.search(agglo.Campaign.template("search", QUICK | TWO), tmp_path / "search")
    costs, front = found.plot().axes
    table = found.table("evaluations")
    deficit, filled = table["growth_deficit"], table["n_f"]
    assert np.array_equal(lines(front)["candidates"].get_ydata(), filled) and "candidates" in lines(costs)
    unbeaten = [
        (x, y) for x, y in zip(deficit, filled)
        if not any(a <= x and b >= y and (a < x or b > y) for a, b in zip(deficit, filled))
    ]  # fmt: skip
    drawn = lines(front)["no other is better in both"]
    assert list(zip(*drawn.get_data())) == sorted(set(unbeaten))
    made_up = np.array([[3.0, 1.0], [1.0, 3.0], [2.0, 2.0], [2.0, 2.5], [1.0, 4.0], [4.0, 1.0]])
    assert agglo._search_plots._front_of(made_up).tolist() == [[1.0, 3.0], [2.0, 2.0], [3.0, 1.0]]


def test_a_study_is_drawn_over_its_parameters(tmp_path):
    one = agglo.search(agglo.Campaign.template("study", QUICK), tmp_path / "one")
    figure, measures = one.plot(), one.table("measures")
    assert [axes.get_title(loc="left") for axes in figure.axes][:2] == ["growth_deficit", "radius_ratio"]
    means = figure.axes[1].containers[0]
    assert np.array_equal(means.lines[0].get_ydata(), measures["radius_ratio"])
    low, high = means.lines[2][0].get_segments()[0][:, 1]
    assert (high - low) / 2 == pytest.approx(measures["radius_ratio_standard_error"][0])
    assert len(one.plot("impacts").axes) == 1
    with pytest.raises(agglo.InputError, match="no quantity 'cost'; there are growth_deficit, radius_ratio"):
        one.plot(["cost"])
    parameters = agglo.Campaign.template("search").to_dict()["parameters"][:2]
    several = agglo.Campaign.template("study", QUICK | {"parameters": parameters, "plan": {"grid": {"levels": 2}}})
    axes = agglo.search(several, tmp_path / "several").plot().axes
    assert [part.get_xlabel() for part in axes] == ["v (m/s)", "length_ratio"]
    assert sorted(axes[0].containers[0].lines[0].get_xdata()) == pytest.approx([20.0, 20.0, 200.0, 200.0])


def test_notebooks_show_searches_with_their_report(tmp_path):
    campaign = agglo.Campaign.template("search", QUICK | {"method": {"random": {"points": 4}}})
    found = agglo.search(campaign, tmp_path / "search")
    assert "search.report()" in found._repr_html_() and "srcdoc" not in found._repr_html_()
    page = found.report().read_text(encoding="utf-8")
    shown = found._repr_html_()
    best = found.summary["best"]
    assert html.unescape(re.search(r'srcdoc="([^"]*)"', shown)[1]) == page and "finished" in shown
    assert f"{best['cost']:.6g} ± {best['cost_standard_error']:.6g}" in shown and f"{best['parameters']['v_m_s']:.6g}" in shown
    study = agglo.search(agglo.Campaign.template("study", QUICK), tmp_path / "study")
    assert "study.report()" in study._repr_html_() and "cost of the best" not in study._repr_html_()


def test_what_has_not_begun_is_not_drawn(tmp_path):
    def stop(now):
        raise StopIteration

    for name, told in (("search", "evaluated nothing yet"), ("study", "no table 'measures'")):
        campaign = agglo.Campaign.template(name, {"ensemble.until": {"fixed": {"replicates": 2}}})
        with pytest.raises(StopIteration):
            agglo.search(campaign, tmp_path / name, progress=stop)
        assert "not finished" in agglo.read(tmp_path / name)._repr_html_()
        with pytest.raises(agglo.InputError, match=told):
            agglo.read(tmp_path / name).plot()


def test_notebooks_show_runs_with_their_replay(soft):  # noqa: F811
    run = agglo.read(soft.folder)
    (soft.folder / "report.html").unlink(missing_ok=True)
    assert "run.report()" in run._repr_html_() and "srcdoc" not in run._repr_html_()
    page = run.report().read_text(encoding="utf-8")
    shown = run._repr_html_()
    inner = html.unescape(re.search(r'srcdoc="([^"]*)"', shown)[1])
    assert inner == page and "sandbox='allow-scripts'" in shown
    assert f"{len(page.encode()) / 1e6:.1f} MB" in shown and "dispersion_degree" in shown
    assert "too much for a notebook" in agglo._html.page("x" * 20_000_001, "big.html")


def test_notebooks_show_tables_plans_and_grains(soft):  # noqa: F811
    table = agglo.Table(time_s=np.arange(40.0), word=np.array(["<b>"] * 40))
    shown = table._repr_html_()
    assert shown.count("<tr>") == 12 and "40 rows" in shown and "&lt;b&gt;" in shown and "<b>" not in shown
    assert "rows" in agglo.Table()._repr_html_()
    plan = agglo.check(soft.scenario)
    assert html.unescape(plan._repr_html_()) == f"<pre>{plan.text}</pre>"
    grains = {
        "position_m": np.array([[0.0, 1.0, 0.0], [2.0, 0.0, 4.0]]),
        "radius_m": np.array([1.0, 1.0]),
        "velocity_m_s": np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 4.0]]),
    }
    picture = agglo._html.grains(grains)
    circles = re.findall(r"cx='([\d.]+)' cy='([\d.]+)' r='([\d.]+)' fill='(#\w+)'", picture)
    # 6 m high, of which 2 to 398 are drawn; the one that is farther along y is behind, so it comes first.
    assert circles == [("134.0", "332.0", "66.00", "#440154"), ("266.0", "68.0", "66.00", "#fde725")]
    assert "6 m wide" in picture and "yellow at 5 m/s" in picture
    assert "no grains" in agglo._html.grains({name: values[:0] for name, values in grains.items()})
    simulation = agglo.Simulation(soft.scenario)
    assert agglo._html.simulation(simulation).count("<circle") == 150
    assert "soft spheres" in agglo._html.scenario(soft.scenario)
