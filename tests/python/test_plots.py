"""Charts with matplotlib, and what notebooks show."""

import html
import re

import agglo
import agglo._html
import agglo._plots
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


def test_a_search_is_drawn_with_its_errors():
    generations = agglo.Table(
        evaluations=np.array([4.0, 8.0]), best_cost=np.array([0.5, 0.25]), best_cost_standard_error=np.array([0.1, np.nan])
    )
    evaluations = agglo.Table(evaluation=np.arange(8.0), cost=np.linspace(1, 0.25, 8))
    axes = agglo._plots.search(generations, evaluations, "mine").axes[0]
    assert np.array_equal(lines(axes)["candidates"].get_ydata(), evaluations["cost"])
    assert (
        lines(axes)["best so far, ± one standard error"].get_ydata().tolist() == [0.5, 0.25]
        and axes.get_title(loc="left") == "mine"
    )


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
