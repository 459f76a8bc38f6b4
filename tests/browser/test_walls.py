"""Walls in the replay: they are drawn, follow the run, and can be left out; each has a line in the charts."""

import pytest

SETTINGS = [
    'time.end="50 ms"',
    'output.frames="5 ms"',
    "grains.0.placement.random.count=30",
    'grains.0.placement.random.region.cylinder.length="20 mm"',
    'grains.0.placement.random.region.cylinder.center=["0 m", "0 m", "12 mm"]',
    'walls.2.motion.formula.velocity=["0", "0", "-0.5"]',
]


@pytest.fixture(scope="module")
def folder(finished, scenario):
    return finished("run", scenario("silo"), *SETTINGS)


def test_walls_are_seen_and_move(opened, folder):
    page = opened(folder)
    page.replay("replay.show(0)")
    page.part("follow").uncheck()
    first = page.picture()
    page.part("walls").uncheck()
    assert first.differs_from(page.picture()) > 0.02, "walls change nothing"
    assert page.replay("replay.scene.shownWalls.corners.length") == 0
    page.part("walls").check()
    assert first.differs_from(page.picture()) == 0, "with walls back the picture is another"
    # The gate goes down by 5 mm in 10 ms. Its underside is between the bottom of the silo and the floor, where nothing else has a corner.
    underside = "Math.min(...replay.frames.walls(replay.frame).filter((z, at) => at % 3 === 2 && z > -0.03 && z < -0.0055))"
    heights = []
    for number in (0, 2):
        page.replay(f"replay.show({number})")
        heights.append(page.replay(underside))
    assert heights[0] - heights[1] == pytest.approx(5e-3, rel=0.02), f"heights of the gate: {heights}"
    assert page.tab.locator("#chart-walls-force").count() == 1
    assert "walls" in page.tab.locator("[data-part=legend]").inner_text()
    assert page.trouble == []
    page.close()
