"""The package `agglo`: scenarios, simulations, runs and results, as a user of Python has them."""

import doctest
import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import agglo
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
SMALL = {"grains.0.placement.random.count": 60, "acoustics.beams.0.rays": 500, "time.end": "2 ms"}


def acoustic(**more):
    return agglo.Scenario.template("acoustic", SMALL | {key.replace("__", "."): value for key, value in more.items()})


STILL = """
version = 1
time.end = "10 ms"
engine.verlet = {}
materials.stone.density = "2500 kg/m3"
[[grains]]
material = "stone"
size.constant.radius = "1 mm"
[grains.placement.random]
count = 20
region.sphere.center = ["0 m", "0 m", "0 m"]
region.sphere.radius = "1 cm"
"""


def still():
    """Soft grains on which nothing acts, so that only what a test does moves them."""
    return agglo.Scenario(STILL)


def cloud():
    settings = {"grains.0.size.length_ratio.count": 200, "grains.0.placement.fill.count": 200, "time.end": "2 ms"}
    return agglo.Scenario.template("reacting", settings)


def test_faults_come_all_at_once_with_their_places():
    with pytest.raises(agglo.ScenarioError) as raised:
        agglo.Scenario("version = 1\nfoo = 2\n[time]\nend = '1 m'")
    faults = {fault["key"]: fault for fault in raised.value.faults}
    assert faults["foo"]["line"] == 2 and faults["foo"]["column"] == 1
    assert "unknown key" in faults["foo"]["message"]
    assert faults["time.end"]["line"] == 4 and "a time is wanted" in faults["time.end"]["message"]
    assert faults["engine"]["line"] is None
    assert isinstance(raised.value, (ValueError, agglo.AggloError))
    assert "foo: unknown key" in str(raised.value)
    with pytest.raises(agglo.ScenarioError) as raised:
        agglo.Scenario.template("acoustic", {"time.end": "3 kg"})
    assert raised.value.faults[0]["setting"].startswith("time.end=")


def test_scenarios_are_values(tmp_path):
    scenario = acoustic()
    assert pickle.loads(pickle.dumps(scenario)) == scenario
    assert agglo.Scenario(scenario.to_toml()) == scenario
    assert agglo.Scenario.from_dict(scenario.to_dict()) == scenario
    longer = scenario.replace({"time.end": "4 ms"})
    assert (scenario.end_s, longer.end_s) == (2e-3, 4e-3)
    assert longer != scenario and longer.replace(["time.end=2 ms"]) == scenario
    (tmp_path / "mine.toml").write_text(scenario.to_toml())
    read = agglo.Scenario.from_file(tmp_path / "mine.toml")
    assert read.base == tmp_path and read.to_dict() == scenario.to_dict()


def test_quantities_of_pint_and_numpy_are_understood():
    class Quantity:
        """As pint has it."""

        def __init__(self, magnitude, units):
            self.magnitude = magnitude
            self.units = units

        def to_base_units(self):
            return self

        def unit_items(self):
            return self.units.items()

    end = Quantity(3e-3, {"second": 1})
    assert acoustic(time__end=end).end_s == 3e-3
    assert acoustic(grains__0__placement__random__count=np.int64(7)).to_dict()["grains"][0]["placement"]["random"]["count"] == 7


def test_quantities_of_pint_itself():
    unit = pytest.importorskip("pint").UnitRegistry()
    for key, quantity, text in [
        ("time__end", unit.Quantity(3, "ms"), "0.003 s"),
        ("materials__ceramic__density", unit.Quantity(2000, "kg/m**3"), "2000 kg/m3"),
        ("materials__ceramic__sound_speed", unit.Quantity(3, "km/s"), "3000 m/s"),
        ("acoustics__beams__0__strength", {"pressure": unit.Quantity(2, "MPa")}, {"pressure": "2 MPa"}),
    ]:
        assert acoustic(**{key: quantity}) == acoustic(**{key: text}), key


def test_a_simulation_goes_on_with_the_same_bits_from_what_it_saved():
    whole, first = agglo.Simulation(acoustic()), agglo.Simulation(acoustic())
    first.run_until(1e-3)
    assert 1e-3 <= first.time_s < 1.1e-3 and not first.is_finished
    second = pickle.loads(pickle.dumps(first))
    for simulation in (whole, second):
        simulation.run_until(1.0)
    assert whole.is_finished and whole.save() == second.save()
    assert whole.pulses()[0]["reflections"] > 0
    with pytest.raises(agglo.InputError, match="no state"):
        agglo.Simulation.restore(acoustic(), b"nothing")


@pytest.mark.parametrize("scenario", [acoustic, cloud])
def test_a_run_and_steps_have_the_bits_of_the_program(built, tmp_path, scenario):
    (tmp_path / "mine.toml").write_text(scenario().to_toml())
    command = [built / "agglo", "run", tmp_path / "mine.toml", "-o", tmp_path / "theirs", "--no-report"]
    subprocess.run(command, check=True, capture_output=True)
    run = agglo.run(scenario(), tmp_path / "ours")
    stepped = agglo.Simulation(scenario())
    while not stepped.is_finished:
        stepped.step()
    names = sorted(path.relative_to(tmp_path / "theirs") for path in (tmp_path / "theirs").rglob("*") if path.is_file())
    same = [name for name in names if name.parent.name != "checkpoints" and name.name != "summary.json"]
    assert len(same) > 10
    for name in same:
        assert (tmp_path / "theirs" / name).read_bytes() == (run.folder / name).read_bytes(), name
    theirs = json.loads((tmp_path / "theirs/summary.json").read_text())
    assert {key: value for key, value in run.summary.items() if key != "wall_s"} == {
        key: value for key, value in theirs.items() if key != "wall_s"
    }
    _, last = run.grains()
    grains = stepped.grains()
    for name in ["id", "velocity_m_s", "temperature_K", "radius_m"]:
        assert np.array_equal(grains[name], last[name]), name


def test_arrays_are_copies_in_the_order_of_ids():
    simulation = agglo.Simulation(acoustic())
    simulation.run_until(1.6e-3)
    grains = simulation.grains()
    assert np.array_equal(grains["id"], np.arange(60))
    assert grains["position_m"].shape == (60, 3) and grains["radius_m"].dtype == np.float64
    grains["position_m"][:] = 0.0
    assert np.all(np.any(simulation.grains()["position_m"] != 0.0, axis=1))


def test_kicks_are_in_the_ledger():
    simulation = agglo.Simulation(still())
    mass = simulation.grains()["mass_kg"][3]
    simulation.kick(np.array([3], dtype=np.uint32), np.array([[2.0, 0.0, 0.0]]))
    # p²/(2 m)
    balance = simulation.balance()
    assert balance["kinetic_J"] == pytest.approx(2.0 / mass, rel=1e-14)
    assert balance["work_custom_J"] == pytest.approx(2.0 / mass, rel=1e-14)
    assert simulation.measures()["momentum_kg_m_s"] == pytest.approx([2.0, 0.0, 0.0])
    for ids, impulses, told in [
        ([99], [[1.0, 0.0, 0.0]], "no grain 99"),
        ([1], [[1.0, 0.0]], "shape"),
        ([1], [[np.nan, 0.0, 0.0]], "finite"),
    ]:
        with pytest.raises(agglo.InputError, match=told):
            simulation.kick(np.array(ids, dtype=np.uint32), np.array(impulses))
    with pytest.raises(agglo.InputError, match="hard spheres"):
        agglo.Simulation(cloud()).kick(np.array([1], dtype=np.uint32), np.array([[1.0, 0.0, 0.0]]))


def test_a_force_of_ones_own_does_what_it_says_and_the_ledger_has_it():
    """A spring to the middle, ω = 1000/s, for all grains alike: r = r_0 cos ωt, v = -ω r_0 sin ωt."""
    simulation = agglo.Simulation(still())
    start = simulation.grains()
    mass, seen = start["mass_kg"][:, None], []

    def spring(time_s, position, velocity, angular_velocity):
        seen.append(time_s)
        assert position.shape == velocity.shape == angular_velocity.shape == (20, 3)
        return -1e6 * mass * position

    simulation.attach(spring, stiffness_over_mass=1e6)
    # Before they meet in the middle.
    simulation.run_until(4e-4)
    end, phase = simulation.grains(), 1e3 * simulation.time_s
    assert len(seen) >= simulation.steps > 5 and not simulation.warnings()
    # The step is 0.06 over the frequency, and verlet's phase is off by a 24th of its square: 1.5e-4.
    assert end["position_m"] == pytest.approx(start["position_m"] * np.cos(phase), abs=3e-4 * 1e-2)
    assert end["velocity_m_s"] == pytest.approx(-1e3 * start["position_m"] * np.sin(phase), abs=3e-4 * 10.0)
    balance = simulation.balance()
    work = 0.5e6 * np.sum(mass * (start["position_m"] ** 2 - end["position_m"] ** 2))
    assert balance["work_custom_J"] == pytest.approx(work, rel=1e-3)
    assert abs(balance["drift_relative"]) < 1e-3


def test_arrays_that_a_force_keeps_stay_as_they_are():
    """The others are filled again in the next step."""
    simulation = agglo.Simulation(still())
    kept, again = [], set()

    def force(time_s, position, velocity, angular_velocity):
        kept.append((position, position.copy(), velocity[:, 0], velocity[:, 0].copy()))
        again.add(id(angular_velocity))
        angular_velocity.flags.writeable = len(kept) != 3
        return position * -1e-6

    simulation.attach(force, stiffness_over_mass=1e6)
    for _ in range(10):
        simulation.step()
    for position, then, component, of_then in kept:
        assert np.array_equal(position, then) and np.array_equal(component, of_then)
    assert len({id(position) for position, *_ in kept}) == len(kept) > 10
    assert len(again) <= 2
    assert not np.array_equal(kept[0][0], kept[-1][0])


def test_torques_of_ones_own_turn_grains():
    simulation = agglo.Simulation(still())
    torque = np.zeros((20, 3))
    torque[7, 2] = 1e-9
    simulation.attach(lambda *_: (np.zeros((20, 3)), torque), stiffness_over_mass=1e6)
    simulation.run_until(1e-3)
    grains = simulation.grains()
    inertia = 0.4 * grains["mass_kg"][7] * 1e-6
    assert grains["angular_velocity_rad_s"][7, 2] == pytest.approx(1e-9 * simulation.time_s / inertia, rel=1e-12)
    assert np.count_nonzero(grains["angular_velocity_rad_s"]) == 1


def test_what_a_force_raises_comes_to_the_caller():
    simulation = agglo.Simulation(still())
    calls = []

    def broken(*_):
        calls.append(1)
        if len(calls) > 3:
            raise ZeroDivisionError("mine")
        return np.zeros((20, 3))

    simulation.attach(broken)
    with pytest.raises(ZeroDivisionError, match="mine"):
        simulation.run_until(1.0)
    for given, told in [(np.zeros((3, 3)), "shape"), ("no", "float64"), (np.full((20, 3), np.inf), "finite")]:
        with pytest.raises(agglo.InputError, match=told):
            agglo.Simulation(still()).attach(lambda *_, given=given: given)
    asking = agglo.Simulation(still())
    with pytest.raises(agglo.RunError, match="cannot ask"):
        asking.attach(lambda *_: asking.grains()["position_m"])


def test_progress_may_stop_a_run_which_goes_on_later(tmp_path):
    scenario = acoustic(time__end="50 ms", grains__0__placement__random__count=400)
    told = []

    def stop(progress):
        told.append(progress)
        if progress["time_s"] > 0.0:
            raise StopIteration

    with pytest.raises(StopIteration):
        agglo.run(scenario, tmp_path / "run", progress=stop)
    assert told[-1]["end_s"] == 0.05 and told[-1]["steps"] > 0
    assert agglo.read(tmp_path / "run").summary is None
    run = agglo.resume(tmp_path / "run")
    whole = agglo.run(scenario)
    assert run.summary["clusters"] == whole["clusters"] and run.summary["energy"] == whole["energy"]


# What a shell starts in the background ignores the signal, and so would its children.
CTRL_C = """
import agglo, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
scenario = agglo.Scenario.template("acoustic", {"time.end": "100 s"})
simulation = agglo.Simulation(scenario)
print("ready", flush=True)
try:
    simulation.run_until(100.0)
except KeyboardInterrupt:
    print("stopped", simulation.steps > 0, simulation.is_finished, flush=True)
"""


def test_ctrl_c_ends_within_a_second():
    child = subprocess.Popen([sys.executable, "-c", CTRL_C], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    time.sleep(0.5)
    child.send_signal(signal.SIGINT)
    asked = time.monotonic()
    assert child.stdout.readline() == "stopped True False\n"
    assert time.monotonic() - asked < 1.0
    assert child.wait(10) == 0


def test_others_work_while_it_runs_and_two_may_step_one():
    simulation = agglo.Simulation(acoustic(time__end="20 ms", grains__0__placement__random__count=300))
    threads = [threading.Thread(target=simulation.run_until, args=(1.0,)) for _ in range(2)]
    for thread in threads:
        thread.start()
    counted = 0
    while any(thread.is_alive() for thread in threads):
        counted += 1
        time.sleep(1e-3)
    assert counted > 10 and simulation.is_finished


def test_threads_that_step_one_never_wait_for_each_other_for_ever():
    """Threads of the pool take up one another's work while they wait; none may come to wait for itself."""
    simulation = agglo.Simulation(acoustic(time__end="1 s", grains__0__placement__random__count=300))

    def steps():
        for _ in range(200):
            simulation.step()

    threads = [threading.Thread(target=steps, daemon=True) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60.0)
    assert not any(thread.is_alive() for thread in threads), f"stuck after {simulation.steps} steps"
    assert simulation.steps == 800


def outcome(_):
    simulation = agglo.Simulation(acoustic())
    simulation.run_until(1.0)
    return simulation.save()


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes_have_the_same_bits(method):
    here = outcome(0)
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map(outcome, range(2)) == [here, here]


def test_results_are_read(tmp_path):
    run = agglo.run(acoustic(), tmp_path / "run")
    energy = run.table("energy")
    assert energy["time_s"][0] == 0.0 and energy["time_s"][-1] == 2e-3
    assert np.all(np.diff(energy["time_s"]) > 0.0) and energy["kinetic_J"][-1] > 0.0
    frames = run.frames()
    assert frames[0][0] == 0.0 and frames[-1][0] == 2e-3 and frames[0][1].is_file()
    time_s, grains = run.grains(0)
    assert time_s == 0.0 and grains["position_m"].shape == (60, 3) and "cluster" in grains
    assert run.report().read_text(encoding="utf-8").startswith("<!doctype html>")
    assert run.scenario.title == acoustic().title
    with pytest.raises(agglo.InputError, match="there are .*energy"):
        run.table("enrgy")
    with pytest.raises(agglo.InputError, match="no frame 900"):
        run.grains(900)
    with pytest.raises(agglo.InputError, match="no run"):
        agglo.read(tmp_path)
    with pytest.raises(agglo.InputError, match="already"):
        agglo.run(acoustic(), tmp_path / "run")


def test_pieces():
    assert np.array_equal(agglo.pack(acoustic())["position_m"], agglo.Simulation(acoustic()).grains()["position_m"])
    hit = agglo.collide(cloud(), [1e-3, 1e-3], [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], [300.0, 300.0], [1.0, 0.0, 0.0])
    assert hit["velocities_m_s"][0, 0] == pytest.approx(-hit["restitution"], rel=1e-14)
    with pytest.raises(agglo.InputError, match="approach"):
        agglo.collide(cloud(), [1e-3, 1e-3], [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [300.0, 300.0], [1.0, 0.0, 0.0])
    assert "Hertz" in agglo.explain("hertz") and dict(agglo.laws())["hertz"]
    with pytest.raises(agglo.InputError, match="did you mean"):
        agglo.explain("herz")
    plan = agglo.check(acoustic())
    assert plan.grains == 60 and plan.steps == pytest.approx(100, rel=0.5) and "steps" in str(plan)
    times = [time_s for time_s, _ in agglo.snapshots(agglo.Simulation(acoustic()), 5e-4)]
    assert times == pytest.approx([0.0, 5e-4, 1e-3, 1.5e-3, 2e-3], abs=2e-6)


def test_the_command_is_the_program(built):
    def said(command, *arguments):
        done = subprocess.run([*command, *arguments], capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    ours = [sys.executable, "-m", "agglo"]
    for arguments in [["--version"], ["explain", "hertz"], ["new", "nothing"], ["check", "/nowhere.toml"], ["nonsense"], ["--help"]]:
        assert said(ours, *arguments) == said([built / "agglo"], *arguments), arguments
    assert os.access(os.path.join(os.path.dirname(sys.executable), "agglo"), os.X_OK)


def test_the_pages_say_what_happens():
    page = ROOT / "docs/python.md"
    for failed, tried in [doctest.testfile(str(page), module_relative=False), doctest.testmod(agglo)]:
        assert tried > 3 and failed == 0


def test_the_list_of_all_functions_is_that_of_the_package():
    done = subprocess.run([sys.executable, ROOT / "docs/book/api.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_stubs_are_those_of_the_module():
    command = [sys.executable, "-m", "mypy.stubtest", "agglo", "--concise"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
