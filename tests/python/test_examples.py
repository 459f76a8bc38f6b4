"""The examples in examples/*.py: each is run, shortened, and held to what it says it does."""

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import agglo
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
PICTURES = {
    "acoustic_dispersal": ["rays.png", "series.png"],
    "reacting_search": ["course.svg", "cloud.png"],
    "custom_force": ["standing-wave.svg"],
    "flow_coupling": ["jet.svg"],
}


@pytest.fixture(autouse=True)
def no_window(monkeypatch):
    pytest.importorskip("matplotlib")
    monkeypatch.setenv("MPLBACKEND", "Agg")


def module(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


def short(name, folder):
    """What a shortened example prints."""
    command = [sys.executable, EXAMPLES / f"{name}.py", folder, "--short"]
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Warning" not in done.stderr, done.stderr
    for picture in PICTURES[name]:
        assert (folder / picture).stat().st_size > 5000, picture
    return done.stdout


def test_every_example_is_tried_and_shown_in_the_guide():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == set(PICTURES)
    page = (ROOT / "docs/examples.md").read_text()
    for name in PICTURES:
        assert f"python3 examples/{name}.py" in page and f"](../examples/{name}.py)" in page, name


def test_rays_of_the_first_paper(tmp_path):
    said = short("acoustic_dispersal", tmp_path)
    rays = agglo.read(tmp_path / "run").table("rays")
    first = agglo.read(tmp_path / "run").summary["pulses"][0]
    assert f"{first['reflections']} reflections, {first['segments']} segments" in said
    # A ray has one more straight piece than it has bounces.
    assert first["segments"] - first["reflections"] == first["rays"] == 400
    # N r²/R² of 100 grains of 5 cm in a ball of 1 m; chance of 400 rays about it is 6 %, that of the packing some more.
    assert first["reflections"] / first["rays"] == pytest.approx(0.25, rel=0.2)
    assert rays["beam_root_of_squares"][1] == pytest.approx(1 / np.sqrt(400), rel=1e-3)


def test_the_search_of_the_second_paper(tmp_path):
    said = short("reacting_search", tmp_path)
    rows = [[float(cell) for cell in line.split("|")[1:-1]] for line in said.splitlines() if re.match(r"\| \d", line)]
    tables, outcomes = rows[:6], rows[6:]
    assert len(outcomes) == 6 and all(len(row) == 11 for row in tables) and [row[0] for row in rows] == [1, 2, 3, 4, 5, 6] * 2
    # The paper's units make of each range of the search one of 0.1 to 1, of L 0.4 to 0.8.
    assert all(0.09 < value <= 1.0 for row in tables for value in row[1:])
    for _, cost, _, radius, volume, paper_cost, paper_radius in outcomes:
        # Π = 1 - b/b* with b* = 60^(1/3) b_0, and the same of the paper with 1000 grains.
        assert cost == pytest.approx(1 - radius / 60 ** (1 / 3), abs=1e-4) and volume >= 0.999 * radius**3
        assert paper_cost == pytest.approx(1 - paper_radius / 10, abs=1e-3)


def test_a_force_of_ones_own_follows_the_closed_form(tmp_path):
    said = short("custom_force", tmp_path)
    off_um = float(re.search(r"at most ([\d.]+) µm off", said)[1])
    example = module("custom_force")
    k, rate = example.WAVE_1_M, example.RATE_1_S
    assert rate * 4e-3 == pytest.approx(1.5, rel=0.01)
    scenario = agglo.Scenario.from_dict(example.SCENARIO).replace({"grains.0.placement.random.count": 30})
    simulation = agglo.Simulation(scenario)
    simulation.attach(example.wave)
    start = simulation.grains()["position_m"][:, 2]
    simulation.run_until(4e-3)
    end, time_s = simulation.grains()["position_m"][:, 2], simulation.time_s

    def speed(z):
        return rate / (2 * k) * np.sin(2 * k * z)

    # Inertia, to first order in τ: they are late by τ (1 + ln(v/v_0)).
    tau = 2 * example.RADIUS_M**2 * 1050 / (9 * example.VISCOSITY_PA_S)
    late = tau * (1 + np.log(speed(example.in_closed_form(start, time_s)) / speed(start)))
    exact = example.in_closed_form(start, time_s - late)
    # Second order in τ over the time of the force, 0.9 %, of a quarter of a wave. A force that is 1 % off is 0.9 µm off here.
    assert end == pytest.approx(exact, abs=0.05e-6)
    assert 0.1 < off_um < 1.5


def test_air_and_dust_keep_their_momentum(tmp_path):
    said = short("flow_coupling", tmp_path)
    assert float(re.search(r"changed by (\S+) of it", said)[1]) < 1e-12
    example = module("flow_coupling")
    scenario = agglo.Scenario.from_dict(example.SCENARIO).replace({"time.end": "10 ms", "grains.0.placement.random.count": 200})
    times, profiles, dust, momenta, jet = example.couple(scenario, gives_back=False)
    # A grain in a flow that hardly changes: u (1 - e^(-t/τ)), with the flow's mean over the grains at the start and at the end.
    simulation = agglo.Simulation(scenario)
    cells = jet.cell(simulation.grains()["position_m"][:, 2])
    tau = 2 * example.RADIUS_M**2 * example.DUST_KG_M3 / (9 * example.VISCOSITY_PA_S)
    mean = 0.5 * (profiles[0][cells].mean() + profiles[-1][cells].mean())
    # Within the change of the flow over these 10 ms, weighted otherwise than by its mean: a part in three hundred.
    assert dust[-1] == pytest.approx(mean * (1 - np.exp(-times[-1] / tau)), rel=3e-3)
    # Viscosity spreads the jet: the variance of the momentum grows by 2 ν t, a thousandth less for what the faces hold back.
    variance = [(profile * jet.z**2).sum() / profile.sum() for profile in profiles]
    assert variance[-1] - variance[0] == pytest.approx(2 * example.VISCOSITY_PA_S / example.AIR_KG_M3 * times[-1], rel=2e-3)
