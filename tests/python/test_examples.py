"""The examples in examples/*.py: each is run, shortened, and held to what it says it does."""

import importlib.util
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import agglo
import numpy as np
import pytest
from test_search import files

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
PICTURES = {
    "acoustic_dispersal": ["rays.png", "series.png"],
    "reacting_search": ["course.svg", "cloud.png"],
    "custom_force": ["standing-wave.svg"],
    "flow_coupling": ["jet.svg"],
    "calibrate_optuna": ["calibration.svg"],
    "study_dask": ["growth.svg"],
    "form_disperse": ["clouds.png", "course.svg"],
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


def test_calibration_with_optuna_finds_what_was_planted(tmp_path):
    pytest.importorskip("optuna")
    said = short("calibrate_optuna", tmp_path)
    example = module("calibrate_optuna")
    # The energy of spin goes about with friction and scatters by 15 %, so four replicates tell friction to 8 %, 0.01.
    # The best of some thirty points is besides not nearer than they are to one another near the bottom, about 0.02.
    for name, near in (("restitution", 0.04), ("friction", 0.03)):
        planted, found = re.search(rf"{name}: planted ([\d.]+), found ([\d.]+)", said).groups()
        assert float(planted) == example.PLANTED[name] and float(found) == pytest.approx(float(planted), abs=near)
    found = agglo.read(tmp_path / "search")
    table = found.table("runs")
    scenario = agglo.Scenario.from_file(tmp_path / "beads.toml")
    measured, scatter = example.measure(scenario)
    values = np.log(np.stack([table[name] for name in example.MEASURED], axis=1))
    assert table["cost"] == pytest.approx((((values - measured) / scatter) ** 2).sum(axis=1))
    # At the planted values, from random starts of the search, it is two squares of normal numbers: 2 ± 0.7 of eight runs.
    asked = found.campaign
    seeds = np.unique(table["seed"])[:8].astype(int)
    planted = [agglo.run(scenario.seeded(seed))["energy"] for seed in seeds]
    logs = np.log([[energy[name.removeprefix("energy.")] for name in example.MEASURED] for energy in planted])
    assert 0.2 < (((logs - measured) / scatter) ** 2).sum(axis=1).mean() < 4.8
    # Stopped half-way and led again, Optuna asks for the same points, and those that are known are not run again.
    with pytest.raises(ZeroDivisionError), agglo.Evaluator(asked, tmp_path / "again") as evaluate:
        evaluate(first_points(example, asked))
        raise ZeroDivisionError
    example.calibrate(asked, tmp_path / "again", 32)
    assert files(tmp_path / "again") == files(tmp_path / "search")


def first_points(example, asked):
    """What Optuna asks for first, as parts of the ranges."""
    optuna = pytest.importorskip("optuna")
    sampler = optuna.samplers.TPESampler(seed=1, multivariate=True, constant_liar=True, n_startup_trials=8)
    study = optuna.create_study(sampler=sampler)
    box = {parameter["name"]: optuna.distributions.FloatDistribution(0.0, 1.0) for parameter in asked.parameters}
    return [list(study.ask(box).params.values()) for _ in range(4)]


def test_a_study_on_dask_has_the_bits_of_the_program_though_a_worker_is_killed(tmp_path, built):
    distributed = pytest.importorskip("distributed")
    short("study_dask", tmp_path)
    example = module("study_dask")
    asked = example.campaign(100, 8)
    (tmp_path / "study.toml").write_text(asked.to_toml())
    command = [built / "agglo", "study", tmp_path / "study.toml", "-o", tmp_path / "theirs", "--no-report"]
    subprocess.run(command, check=True, capture_output=True)
    whole = files(tmp_path / "theirs")
    assert files(tmp_path / "study") == whole
    submitted = []

    class Client:
        """A client whose executor loses a worker when it is given its third evaluation: both workers have work then."""

        def get_executor(self):
            executor = client.get_executor()
            submit = executor.submit

            def counted(*arguments, **more):
                submitted.append(submit(*arguments, **more))
                if len(submitted) == 3:
                    os.kill(min(pids.values()), signal.SIGKILL)
                return submitted[-1]

            executor.submit = counted
            return executor

    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            pids = client.run(os.getpid)
            example.conduct(asked, tmp_path / "killed", Client())
            left = client.run(os.getpid)
    assert len(submitted) > 3
    assert min(pids.values()) not in left.values()
    assert files(tmp_path / "killed") == whole


def pieces(grains):
    """Primaries, masses and momenta of the grains or clusters of a frame, the lightest first."""
    mass, momentum = grains["mass_kg"], grains["mass_kg"][:, None] * grains["velocity_m_s"]
    count = grains.get("primaries", np.ones(len(mass)))
    _, piece = np.unique(grains.get("cluster", grains["id"]), return_inverse=True)
    sums = [np.bincount(piece, weights=of) for of in (count, mass, *momentum.T)]
    order = np.argsort(sums[1])
    return sums[0][order].astype(int).tolist(), sums[1][order], np.stack(sums[2:], axis=1)[order]


def meetings(grown):
    """How often grains are to meet in a run: a cylinder of π (r + r')² |v - v'| for each pair, over the volume and time."""
    faces = grown.scenario.to_dict()["volume"]
    lower, upper = (np.array([float(face.removesuffix(" m")) for face in faces[side]]) for side in ("lower", "upper"))
    times, rates = [], []
    for frame in range(len(grown.frames())):
        time_s, grains = grown.grains(frame)
        i, j = np.triu_indices(len(grains["id"]), 1)
        across = np.pi * (grains["radius_m"][i] + grains["radius_m"][j]) ** 2
        speed = np.linalg.norm(grains["velocity_m_s"][i] - grains["velocity_m_s"][j], axis=1)
        times.append(time_s)
        rates.append((across * speed).sum() / np.prod(upper - lower))
    return np.trapezoid(rates, times)


def pushed(seed, folder):
    """The momentum that sound gives what has grown from another start."""
    example = module("form_disperse")
    formed = example.run(agglo.Scenario.template("form", {**example.SHORT_FORM, "seed": seed}), folder / "formed")
    disperse = agglo.Scenario.template("disperse", example.SHORT_DISPERSE)
    soft, _ = example.hand_over(formed, folder / "agglomerates.toml", disperse)
    return pieces(example.run(soft, folder / "dispersed").grains(-1)[1])[2].sum(axis=0)


def test_agglomerates_form_are_dispersed_and_form_again(tmp_path):
    said = short("form_disperse", tmp_path)
    formed, dispersed, again = (agglo.read(tmp_path / name) for name in ("formed", "dispersed", "again"))
    # Both hand-overs keep every piece: how many primaries it has, its mass and its momentum, to round-off of sums over a hundred.
    for before, after in ((formed.grains(-1), dispersed.grains(0)), (dispersed.grains(-1), again.grains(0))):
        counts, masses, momenta = pieces(before[1])
        now = pieces(after[1])
        assert now[0] == counts and sum(counts) == 100 and after[0] == 0.0
        assert now[1] == pytest.approx(masses, rel=1e-12)
        assert now[2] == pytest.approx(momenta, rel=1e-9, abs=1e-12 * np.abs(momenta).max())
    assert f"{len(pieces(dispersed.grains(-1)[1])[0])} clusters" in said
    told = re.findall(r"mass kept to (\S+), momentum to ([\de.-]+)", said)
    assert len(told) == 2 and all(float(part) < 1e-12 for parts in told for part in parts)
    # Packings begin with their bonds at rest and without overlaps; what moves is what moved before.
    energy = dispersed.table("energy")
    assert energy["bonds_J"][0] == 0.0 and energy["elastic_J"][0] < 1e-12 * energy["kinetic_J"][0]
    # Sound breaks bonds, each of which is an event.
    clusters, kinds = dispersed.table("clusters"), dispersed.events()["event"]
    assert clusters["bonds"][0] - clusters["bonds"][-1] == sum(kind.startswith("broken") for kind in kinds.tolist()) > 0
    assert clusters["dispersion_degree"][-1] > clusters["dispersion_degree"][0]
    assert clusters["clusters"][-1] > 2 * clusters["clusters"][0] == 2 * formed.summary["grains_end"]
    push = pieces(dispersed.grains(-1)[1])[2].sum(axis=0)
    # It pushes along x. What scatters sideways cancels but for chance, of which the mean of four starts has half as much as one.
    mean = np.mean([push, *(pushed(seed, tmp_path / f"start-{seed}") for seed in (2, 3, 4))], axis=0)
    assert push[0] > 3 * np.hypot(*push[1:]) and mean[0] > 5 * np.hypot(*mean[1:])
    # Of the energy the motion of centers is left, P²/2M at least; shaking and spin are dropped.
    kept = float(re.search(r"(\d+)% of the energy of motion and spin left", said)[1]) / 100
    grains = again.grains(0)[1]
    motion = 0.5 * (grains["mass_kg"] * (grains["velocity_m_s"] ** 2).sum(axis=1)).sum()
    final = {name: dispersed.summary["energy"][name] for name in ("kinetic_J", "rotational_J")}
    # The ledger's energy of motion has the water that grains drag along, half of what they displace.
    before = final["kinetic_J"] / (1 + 0.5 * 1000 / 4000) + final["rotational_J"]
    assert kept == pytest.approx(motion / before, abs=0.006) and (push**2).sum() / (2 * grains["mass_kg"].sum()) < motion < before
    # The second growth: every merge is one grain less, until there are as few as before; momentum stays.
    end = again.grains(-1)[1]
    assert again.summary["grains_end"] == again.summary["grains_start"] - again.summary["merges"] <= formed.summary["grains_end"]
    assert end["primaries"].sum() == 100
    assert pieces(end)[2].sum(axis=0) == pytest.approx(push, rel=1e-9, abs=1e-12 * push[0])
    # Both times grains meet as often as the kinetic theory of gases has it, to the chance of so many impacts.
    for grown in (formed, again):
        met = meetings(grown)
        assert grown.summary["merges"] == pytest.approx(met, abs=3 * np.sqrt(met))
    # Started again it says the same of what is there.
    assert short("form_disperse", tmp_path) == said
