"""Pages of hard spheres, large and damaged runs, searches."""

import json
import statistics

import pytest
from page import table


@pytest.fixture
def opened_clean(opened):
    """As `opened`, for pages without trouble."""

    def open_page(folder, **options):
        page = opened(folder, **options)
        assert page.trouble == []
        return page

    return open_page


def test_hard_spheres_temperature_growth_and_sizes(opened_clean, finished, scenario):
    folder = finished("run", scenario("reacting-set-1"), 'time.end="2 ms"')
    page = opened_clean(folder)
    assert page.part("color").input_value() == "size", "they grow, and are not colored by size"
    first = page.picture()
    page.part("scrub").fill("20")
    assert first.differs_from(page.picture()) > 0.02
    sizes = table(folder / "series" / "sizes.csv")
    chart = page.evaluate(
        """() => { const { x, z } = document.getElementById("chart-sizes").data[0];
                   return { x: [...x], z: z.map((row) => [...row]) }; }"""
    )
    classes = sorted(set(sizes["lower_primaries"]))
    rows = zip(sizes["time_s"], sizes["lower_primaries"], sizes["mass_fraction"], strict=True)
    for time, lower, fraction in rows:
        found = chart["z"][classes.index(lower)][chart["x"].index(time)]
        assert found == fraction, f"mass fraction from {lower} primaries on at {time} s: expected {fraction}, found {found}"


def test_twenty_thousand_grains_open_draw_and_play(opened_clean, finished, scenario):
    folder = finished(
        "run",
        scenario("reacting-agglomeration"),
        "grains.0.size.length_ratio.ratio=0.4",
        "grains.0.size.length_ratio.count=20000",
        "grains.0.placement.fill.count=20000",
        'time.end="0.05 ms"',
        'output.frames="0.01 ms"',
    )
    assert (folder / "report.html").stat().st_size < 25e6
    page = opened_clean(folder)
    # Where grains grow the page opens with what came of it.
    page.part("scrub").fill("0")
    assert "20000 grains" in page.part("count").text_content()
    first = page.picture()
    assert first.colors > 30
    page.part("scrub").fill("4")
    assert first.differs_from(page.picture()) > 0.05, "it does not move"
    # What the page itself does for a frame; the drawing is the graphics card's, which tests do not have.
    times = page.evaluate(
        """() => Array.from({ length: 9 }, (_, k) => {
             const start = performance.now();
             window.agglo.replay.show(k % window.agglo.replay.frames.count);
             return performance.now() - start;
           })"""
    )
    # 30 frames a second leave 33 ms; three times that for a busy machine.
    assert statistics.median(times) < 100, f"a frame of 20,000 grains takes {statistics.median(times)} ms to be ready"


def test_a_damaged_folder_shows_what_is_there_and_says_what_is_not(opened_clean, agglo, finished, scenario):
    folder = finished("run", scenario("reacting-set-1"), 'time.end="1 ms"')
    for name in ("series/energy.csv", "frames/grains_000003.vtp"):
        content = (folder / name).read_bytes()
        (folder / name).write_bytes(content[: len(content) // 2])
    (folder / "summary.json").unlink()
    (folder / "series/grains.csv").write_text("time_s,grains\n0,<img src=x onerror=alert(1)>\n0.5,7\n")
    agglo("report", folder)
    page = opened_clean(folder)
    notes = page.tab.locator("#notes").text_content()
    for wanted in ("series/energy.csv is cut", "grains_000003.vtp", "summary.json is missing", "series/grains.csv is cut"):
        assert wanted in notes
    # All grains are alike in the first frame, and so are their colors.
    page.evaluate("window.agglo.replay.show(window.agglo.replay.frames.count - 1)")
    assert page.picture().colors > 100
    lines = (folder / "series/energy.csv").read_text().rstrip("\n").split("\n")
    # Without the header and the row that was cut.
    assert len(page.lines("energy")[0]["y"]) == len(lines) - 2


SEARCH = """
version = 1
title = "Growth against heat"
seed = 5
columns = ["radius_ratio"]
settings = ['time.end="0.5 ms"']
[base]
template = "reacting"
[[parameters]]
name = "v"
key = "grains.0.velocity_spread.uniform.bounds.0"
range.log = { lower = "20 m/s", upper = "200 m/s" }
[[parameters]]
name = "hardness"
key = "materials.grain.hardness"
range.linear = { lower = "0.1 MPa", upper = "1 MPa" }
[ensemble.until.fixed]
replicates = 2
"""


@pytest.fixture
def searched(finished, tmp_path):
    """A search or study with these objectives and method, in a folder of its own."""

    def run(verb, rest):
        file = tmp_path / "search.toml"
        file.write_text(SEARCH + rest)
        return finished(verb, file)

    return run


def test_a_search_cost_against_generation_candidates_parallel_coordinates_tables(opened_clean, searched):
    folder = searched(
        "search",
        """
[[objectives]]
minimize = "growth_deficit"
[method.published_genetic]
population = 8
parents = 4
offspring = 2
generations = 4
[confirm]
candidates = 2
replicates = 2
""",
    )
    page = opened_clean(folder)
    best, mean = page.lines("cost")[:2]
    generations = table(folder / "generations.csv")
    assert best["y"] == generations["best_cost"]
    assert best["error"] == generations["best_cost_standard_error"]
    assert mean["name"] == "mean of the best 4 so far"
    evaluations = table(folder / "evaluations.csv")
    costs = zip(evaluations["cost"], evaluations["generation"], strict=True)
    first = sorted(cost for cost, generation in costs if generation == 0)[:4]
    assert mean["y"][0] == pytest.approx(sum(first) / 4, rel=1e-12)
    labels = "document.getElementById('chart-parallel').data[0].dimensions.map(({ label }) => label)"
    assert page.evaluate(labels) == ["v_m_s", "hardness_Pa", "growth_deficit"]
    pairs = page.lines("pairs")
    # A histogram for each parameter and a cell for their pair, with the best quarter, but at least 50, of the candidates.
    assert [line["name"] for line in pairs] == ["v_m_s", "hardness_Pa", ""]
    columns = (evaluations["v_m_s"], evaluations["hardness_Pa"], evaluations["stage"])
    wanted = sorted((v, hardness) for v, hardness, stage in zip(*columns, strict=True) if stage == "search")
    assert sorted(zip(pairs[2]["x"], pairs[2]["y"], strict=True)) == wanted
    assert page.tab.locator("table").first.locator("tr").count() == 3, "not two best and a header"
    page.tab.locator("a", has_text="The run of the best candidate").click()
    page.tab.wait_for_selector("#replay[data-ready]")
    phone = opened_clean(folder, width=390, height=844)
    assert phone.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_two_costs_a_front(opened_clean, searched):
    folder = searched(
        "search",
        """
[[objectives]]
minimize = "growth_deficit"
[[objectives]]
minimize = "temperature_mean_K"
[method.genetic]
population = 8
generations = 3
[confirm]
candidates = 1
replicates = 2
""",
    )
    page = opened_clean(folder)
    front = json.loads((folder / "summary.json").read_text())["front"]
    wanted = sorted(entry["costs"] for entry in front)
    line = page.lines("front")[1]
    assert line["x"]
    assert [list(point) for point in zip(line["x"], line["y"], strict=True)] == wanted


def test_a_study_of_sensitivity_what_moves_what(opened_clean, searched):
    folder = searched("study", '\n[[objectives]]\nminimize = "growth_deficit"\n[plan.morris]\ntrajectories = 3\n')
    page = opened_clean(folder)
    sizes = table(folder / "sensitivity.csv")["mean_size"]
    assert page.lines("sensitivity-0")[0]["y"] == sizes[:2]


def test_shares_in_the_variance_have_their_own_intervals(opened_clean, searched):
    folder = searched("study", '\n[[objectives]]\nminimize = "growth_deficit"\n[plan.sobol_indices]\nsamples = 16\n')
    page = opened_clean(folder)
    shares = table(folder / "sensitivity.csv")
    bars = page.evaluate(
        """() => document.getElementById("chart-sensitivity-0").data.map(({ y, error_y: { array, arrayminus } }) =>
          [y.map((value, at) => value - arrayminus[at]), y.map((value, at) => value + array[at])])"""
    )
    for name, (lower, upper) in zip(("first", "total"), bars, strict=True):
        # Taking off the value and adding it again rounds a few times, to parts of the value of the order of 1.
        assert lower == pytest.approx(shares[f"{name}_lower"][:2], abs=1e-14)
        assert upper == pytest.approx(shares[f"{name}_upper"][:2], abs=1e-14)


def test_a_refinement_of_less_than_two_tens_has_ticks_that_tell_the_scale(opened_clean, finished, tmp_path):
    head = SEARCH.split("[[parameters]]")[0]
    file = tmp_path / "search.toml"
    file.write_text(
        head
        + """[[objectives]]
minimize = "growth_deficit"
[[parameters]]
name = "v"
key = "grains.0.velocity_spread.uniform.bounds.0"
range.choices = ["20 m/s", "40 m/s", "80 m/s", "160 m/s"]
[plan.refinement]
tolerance = 0.1
[ensemble]
common_random_numbers = true
[ensemble.until.fixed]
replicates = 8
"""
    )
    folder = finished("study", file)
    page = opened_clean(folder)
    assert page.tab.locator("#chart-outcome-0 .xtick text").all_text_contents() == ["20", "50", "100"]
    # Eight replicates of a level are enough to see how they scatter.
    counts = page.lines("distribution-0")[0]["y"]
    assert sum(counts) == 8
