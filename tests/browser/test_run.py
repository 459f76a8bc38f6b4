"""The page of a run of soft spheres: it opens offline, draws, and does what its controls say."""

import math
import re

import pytest
from page import frame, table


@pytest.fixture(scope="module")
def folder(finished, scenario):
    settings = ['time.end="0.6 us"', 'output.frames="0.05 us"', 'output.series="0.01 us"']
    return finished("run", scenario("ink-agglomerate"), *settings)


@pytest.fixture
def page(opened, folder):
    page = opened(folder)
    yield page
    page.settle()
    assert page.trouble == []
    page.close()


def test_opens_from_its_file_without_a_request_or_a_word_in_the_console(page):
    assert page.trouble == []
    assert page.tab.locator("#replay[data-ready]").count() == 1
    assert page.tab.locator("#charts[data-ready]").count() == 1
    assert page.tab.locator("[role=alert]").count() == 0


@pytest.mark.parametrize(
    "injected",
    [
        "<script>window.intruded = true</script>",
        "<script type='module'>window.intruded = true</script>",
        "<script src='data:text/javascript,window.intruded = true'></script>",
        "<img src='data:,' onerror='window.intruded = true'>",
        "<iframe srcdoc='<script>parent.intruded = true</script>'></iframe>",
        "<a id='way' href='javascript:window.intruded = true'>here</a><script>way.click()</script>",
    ],
)
def test_a_script_that_got_past_the_escaping_does_not_run(opened, folder, tmp_path, injected):
    text = (folder / "report.html").read_text(encoding="utf-8")
    assert text.count("</h1>") == 1
    (tmp_path / "report.html").write_text(text.replace("</h1>", f"{injected}</h1>"), encoding="utf-8")
    page = opened(tmp_path)
    if "javascript:" in injected:
        page.tab.locator("#way").click()
    page.settle()
    assert page.evaluate("window.intruded === undefined")
    assert any("Content Security Policy" in word for word in page.trouble), page.trouble
    # The page's own go on as ever.
    assert page.tab.locator("#replay[data-ready]").count() == 1
    assert page.tab.locator("#charts[data-ready]").count() == 1
    page.close()


def test_draws_grains_bonds_and_rays_in_many_colors(page):
    assert page.picture().colors > 500
    page.replay("replay.show(6)")
    everything = page.picture()
    for name in ("rays", "bonds"):
        page.part(name).uncheck()
        # Bonds are inside of grains that touch, but these are apart.
        assert everything.differs_from(page.picture()) > 1e-4, f"{name} change nothing"
        page.part(name).check()
    assert everything.differs_from(page.picture()) == 0, "with all parts back the picture is another"
    page.part("size").fill("0.3")
    assert everything.differs_from(page.picture()) > 0.05, "smaller grains look the same"


def test_plays_scrubs_and_steps(page):
    page.replay("replay.show(0)")
    first = page.picture()
    # So slowly that it does not come to its end before the click of a busy machine; a click then begins anew.
    page.part("rate").select_option("2")
    page.part("play").click()
    page.tab.wait_for_function("() => window.agglo.replay.frame >= 1")
    page.part("play").click()
    stopped = page.replay("replay.frame")
    assert first.differs_from(page.picture()) > 0.005, "it does not move"
    page.tab.wait_for_timeout(700)
    assert page.replay("replay.frame") == stopped, "it goes on in a pause"
    page.part("rate").select_option("30")
    page.part("play").click()
    last = page.replay("replay.frames.count") - 1
    at_end = "(last) => window.agglo.replay.frame === last && !window.agglo.replay.playing"
    page.tab.wait_for_function(at_end, arg=last)
    assert page.part("play").text_content() == "Play", "it does not stop at the end"
    page.part("scrub").fill("2")
    assert page.replay("replay.frame") == 2
    assert re.match(r"^10\d(\.\d+)? ns$", page.part("time").text_content())
    page.part("on").click()
    assert page.replay("replay.frame") == 3
    page.part("back").click()
    page.part("back").click()
    assert page.replay("replay.frame") == 1


def test_colors_by_what_the_frames_hold(page):
    page.replay("replay.show(8)")
    options = page.part("color").locator("option")
    choices = options.evaluate_all("(options) => options.map((option) => option.value)")
    assert {"speed", "cluster", "absorbed_power", "size", "id"} <= set(choices)
    pictures = []
    for choice in choices:
        page.part("color").select_option(choice)
        label = page.part("color").locator(f"option[value={choice}]").text_content()
        assert label in page.part("legend").text_content()
        picture = page.picture()
        for other in pictures:
            assert picture.differs_from(other) > 0.01, f"{choice} looks like another"
        pictures.append(picture)


def test_turns_zooms_and_moves_by_mouse_and_keys(page):
    canvas, mouse, keys = page.tab.locator("#replay canvas"), page.tab.mouse, page.tab.keyboard
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    before = page.picture()

    def changed(what):
        nonlocal before
        now = page.picture()
        assert before.differs_from(now) > 0.01, f"{what} changes nothing"
        before = now

    mouse.move(x, y)
    mouse.down()
    mouse.move(x + 90, y + 40, steps=4)
    mouse.up()
    changed("a drag")
    assert page.part("follow").is_checked(), "turning ends following"
    mouse.wheel(0, -300)
    changed("the wheel")
    assert not page.part("follow").is_checked(), "zooming does not end following"
    keys.down("Shift")
    mouse.down()
    mouse.move(x - 60, y, steps=4)
    mouse.up()
    keys.up("Shift")
    changed("a drag with shift")
    canvas.focus()
    for key in ("ArrowLeft", "ArrowUp", "+", "-", "Home"):
        keys.press(key)
        changed(key)
    keys.press("Space")
    assert page.replay("replay.playing"), "space does not play"
    keys.press("Space")
    page.replay("replay.show(4)")
    keys.press(".")
    assert page.replay("replay.frame") == 5
    keys.press(",")
    assert page.replay("replay.frame") == 4
    outline = canvas.evaluate("(stage) => getComputedStyle(stage).outlineStyle")
    assert outline == "solid", "the focus is not seen"


def nearest_grain(page, folder, number):
    """Shows a frame; gives its grains, the grain that reaches nearest to the eye, which hides nothing of its middle from us, and
    where that is on the page."""
    page.replay(f"replay.reset(); replay.show({number})")
    canvas = page.tab.locator("#replay canvas")
    canvas.scroll_into_view_if_needed()
    grains = frame(folder / "frames" / f"grains_{number:06}.vtp")
    eye = page.replay("replay.camera.eye()")

    def center(grain):
        return grains["Points"][3 * grain : 3 * grain + 3]

    nearest = min(range(len(grains["id"])), key=lambda grain: math.dist(center(grain), eye) - grains["radius_m"][grain])
    box = canvas.bounding_box()
    shape = box["width"] / box["height"]
    view, projection = page.replay(f"[[...replay.camera.view()], [...replay.camera.projection({shape})]]")

    def times(matrix, vector):
        return [sum(matrix[4 * k + row] * part for k, part in enumerate(vector)) for row in range(4)]

    clip = times(projection, times(view, [*center(nearest), 1]))
    at = (
        box["x"] + box["width"] * (1 + clip[0] / clip[3]) / 2,
        box["y"] + box["height"] * (1 - clip[1] / clip[3]) / 2,
    )
    return grains, nearest, at, box


def test_a_click_shows_the_figures_of_the_grain_that_is_there(page, folder):
    grains, nearest, at, box = nearest_grain(page, folder, 8)
    before = page.picture()
    page.tab.mouse.click(*at)
    figures = page.part("chosen").evaluate(
        """(list) => Object.fromEntries([...list.querySelectorAll("dt")]
             .map((name) => [name.textContent, name.nextSibling.textContent]))"""
    )
    assert figures["grain"] == str(grains["id"][nearest])
    columns = {column["label"]: column for column in page.replay("replay.plan.columns")}

    def close(label, wanted):
        # Replays round to 65,536 steps, and the page shows three digits.
        step = (columns[label]["high"] - columns[label]["low"]) / 65535
        found = float(re.match(r"[-+.\de]+", figures[label])[0])
        assert abs(found - wanted) <= step + 1e-2 * abs(wanted), f"{label}: expected {wanted}, found {figures[label]}"

    close("speed", math.hypot(*grains["velocity_m_s"][3 * nearest : 3 * nearest + 3]))
    close("radius", grains["radius_m"][nearest])
    close("absorbed power", grains["absorbed_power_W"][nearest])
    assert int(figures["cluster"]) == grains["cluster"][nearest]
    assert before.differs_from(page.picture()) > 1e-4, "the grain is not marked"
    page.tab.mouse.click(box["x"] + 4, box["y"] + 4)
    assert page.part("chosen").is_hidden(), "a click beside all grains does not let go"
    page.part("name").fill("17")
    page.part("name").press("Enter")
    assert "grain17" in page.part("chosen").text_content()
    page.tab.locator("#replay canvas").focus()
    page.tab.keyboard.press("Escape")
    assert page.part("chosen").is_hidden()


CHARTS = {
    "stores": ("energy", {"kinetic energy": "kinetic_J", "elastic energy": "elastic_J", "energy of bonds": "bonds_J"}),
    "flows": ("energy", {"put in by rays": "work_rays_J", "lost to drag": "lost_drag_J"}),
    "dispersion": ("clusters", {"dispersion degree": "dispersion_degree", "largest cluster": "largest_fraction"}),
    "clusters": ("clusters", {"clusters": "clusters", "bonds": "bonds"}),
    "rays": ("rays", {"rays in flight": "in_flight", "reflections": "reflections"}),
    "beam": ("rays", {"beam power along x": "beam_x", "beam power in all": "beam_magnitude"}),
    "flying": ("rays", {"power in flight along x": "flying_x", "power in flight": "flying_magnitude"}),
    "speed": ("moments", {"largest speed": "largest_speed_m_s"}),
    "step": ("steps", {"step": "step_size_s"}),
}


def test_charts_hold_the_numbers_of_the_tables(page, folder):
    numbers = 0
    for chart, (file, columns) in CHARTS.items():
        rows = table(folder / "series" / f"{file}.csv")
        drawn = {line["name"]: line for line in page.lines(chart)}
        for name, column in columns.items():
            assert name in drawn, f"{chart} has no {name}: {list(drawn)}"
            assert drawn[name]["x"] == rows["time_s"], f"times of {chart}, {name}"
            assert drawn[name]["y"] == rows[column], f"{chart}, {name} is not {column}"
            numbers += len(rows[column])
    assert numbers > 500


def test_charts_say_figures_where_one_points_and_zoom(page):
    place = page.tab.locator("#chart-stores")
    place.scroll_into_view_if_needed()
    box = place.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 3
    page.tab.mouse.move(x - 5, y)
    page.tab.mouse.move(x, y)
    page.tab.wait_for_selector("#chart-stores .hoverlayer text")
    assert re.search(r"kinetic.*J", place.locator(".hoverlayer").text_content())

    def ends():
        return place.evaluate("(chart) => chart.layout.xaxis.range.map(Number)")

    whole = ends()
    page.tab.mouse.down()
    page.tab.mouse.move(x + 80, y, steps=5)
    page.tab.mouse.up()
    zoomed = '(before) => document.querySelector("#chart-stores").layout.xaxis.range[1] < before'
    page.tab.wait_for_function(zoomed, arg=whole[1])
    found = ends()
    assert found[1] - found[0] < 0.5 * (whole[1] - whole[0])


def test_every_picture_has_words(page):
    for image in page.tab.locator("[role=img]:not(svg *)").all():
        assert len(image.get_attribute("aria-label") or "") > 20
    assert page.tab.locator("figure details li").first.count() == 1
    assert page.tab.locator("figure figcaption").count() == page.tab.locator("figure").count()


def test_tells_what_was_run_how_to_run_it_again_what_to_cite_and_licenses(page):
    text = page.tab.locator("body").evaluate("(body) => body.textContent")
    for wanted in (
        "Pigment agglomerate",
        "634 grains were followed",
        "energy drift",
        "agglo run scenario.toml -o again",
        "seed",
        "K. L. Johnson",
        "Plotly, Inc.",
        "WITHOUT WARRANTY",
        "default",
    ):
        assert wanted in text
    assert page.tab.locator(".file .default").count() > 10, "defaults are not marked"


@pytest.mark.parametrize("dark", [False, True])
def test_a_phone_shows_it_without_scrolling_sideways_also_in_the_dark(opened, folder, dark):
    page = opened(folder, width=390, height=844, dark=dark, touch=True)
    content, window = page.evaluate("[document.documentElement.scrollWidth, innerWidth]")
    assert content <= window
    assert page.picture().colors > 300
    _, _, at, _ = nearest_grain(page, folder, 0)
    page.tab.touchscreen.tap(*at)
    page.part("chosen").wait_for(state="visible")
    back = page.evaluate("getComputedStyle(document.body).backgroundColor")
    light = int(re.search(r"\d+", back)[0])
    assert light < 60 if dark else light > 200, back
    assert page.trouble == []
    page.close()


def test_every_frame_of_the_folder_is_in_the_replay(page, folder):
    files = sorted((folder / "frames").glob("grains_*.vtp"))
    assert page.replay("replay.frames.count") == len(files)
    wanted = frame(files[-1])["Points"]
    found = page.replay(f"Array.from(replay.frames.grains({len(files) - 1}, 1).centers)")
    reach = max(wanted) - min(wanted)
    assert found == pytest.approx(wanted, abs=1e-4 * reach)
