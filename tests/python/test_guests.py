"""Forces, measures and rules of one's own in runs that write a folder."""

import subprocess
import sys

import agglo
import numpy as np
import pytest

SOFT = {
    "grains.0.placement.random.count": 30,
    "acoustics.beams.0.rays": 100,
    "time.end": "2 ms",
    "output.series": "20 us",
    "output.frames": "0.2 ms",
    "output.checkpoints": "0.5 ms",
}
HARD = {
    "grains.0.size.length_ratio.count": 100,
    "grains.0.placement.fill.count": 100,
    "time.end": "2 ms",
    "output.series": "20 us",
}
STEPPED = """
version = 1
time.end = "10 ms"
engine.verlet.step = "10 us"
output.series = "1 ms"
materials.glass.density = "2500 kg/m3"
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.list.positions = [["0 m", "0 m", "0 m"], ["1 m", "0 m", "0 m"]]
"""


def soft():
    return agglo.Scenario.template("acoustic", SOFT)


def hard():
    return agglo.Scenario.template("reacting", HARD)


def spread_m(time_s, grains):
    return np.linalg.norm(grains["position_m"], axis=1).max()


def pull(time_s, position, velocity, angular_velocity):
    return -1e-4 * position


def push(time_s, position, velocity, angular_velocity):
    return 1e-4 * position


def nothing(time_s, grains):
    return None


FORCE = agglo.Force(pull, stiffness_over_mass=1e4)


def files(folder):
    """All files but checkpoints, without the wall time."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file() and path.parent.name != "checkpoints" and path.name != ".agglo.lock":
            lines = path.read_bytes().splitlines()
            found[path.relative_to(folder)] = [line for line in lines if b'"wall_s"' not in line]
    return found


def test_a_force_and_measures_do_what_they_say(tmp_path):
    """A constant acceleration a = 2 m/s2: x = a t^2/2, which velocity Verlet has to rounding."""
    mass = 4 / 3 * np.pi * 1e-9 * 2500

    def push(time_s, position, velocity, angular_velocity):
        force = np.zeros((2, 3))
        force[1, 0] = 2.0 * mass
        return force

    seen = []
    measures = {"x_m": lambda time_s, grains: grains["position_m"][1, 0] - 1.0, "none": nothing, "turn": lambda *_: len(seen)}

    def stop(time_s, grains):
        seen.append((time_s, grains))
        return False

    run = agglo.run(agglo.Scenario(STEPPED), tmp_path / "run", force=push, measures=measures, stop=stop)
    own = run.table("own")
    assert list(own) == ["time_s", "x_m", "none", "turn"]
    assert own["time_s"].tolist() == run.table("energy")["time_s"].tolist() == [time for time, _ in seen]
    np.testing.assert_allclose(own["x_m"], own["time_s"] ** 2, rtol=0, atol=1e-15 * 20)
    assert np.isnan(own["none"]).all() and own["turn"].tolist() == list(range(11))
    work = run.summary["energy"]["work_custom_J"]
    assert work == pytest.approx(2.0 * mass * own["x_m"][-1], rel=1e-12)
    # Columns are copies in the order of ids, as those of simulations.
    assert seen[0][1]["id"].tolist() == [0, 1]
    assert seen[0][1].keys() == agglo.Simulation(agglo.Scenario(STEPPED)).grains().keys()
    assert seen[0][1]["position_m"][1, 0] == 1.0
    assert run.report().is_file()


def test_columns_of_hard_spheres_are_those_of_simulations(tmp_path):
    names = []
    agglo.run(hard(), tmp_path / "run", stop=lambda _, grains: names.append(grains) or True)
    wanted = agglo.Simulation(hard()).grains()
    assert len(names) == 1 and names[0].keys() == wanted.keys()
    for name, values in wanted.items():
        np.testing.assert_array_equal(names[0][name], values, err_msg=name)


def test_what_one_function_does_to_columns_is_nothing_to_others(tmp_path):
    def spoils(time_s, grains):
        grains["position_m"][:] = 0.0
        return 0.0

    run = agglo.run(hard(), tmp_path / "run", measures={"spoils": spoils, "spread_m": spread_m})
    assert (run.table("own")["spread_m"] > 0.0).all()


@pytest.mark.parametrize(("scenario", "force"), [(soft(), FORCE), (hard(), None)], ids=["soft", "hard"])
def test_what_is_raised_comes_to_the_caller_and_the_run_goes_on_to_the_same_files(tmp_path, scenario, force):
    whole = agglo.run(scenario, tmp_path / "whole", force=force, measures={"spread_m": spread_m})

    def breaks_m(time_s, grains):
        if time_s > 0.9e-3:
            raise LookupError("nothing to be seen")
        return spread_m(time_s, grains)

    cut = tmp_path / "cut"
    with pytest.raises(LookupError, match="nothing to be seen"):
        agglo.run(scenario, cut, force=force, measures={"spread_m": breaks_m})
    assert agglo.read(cut).summary is None
    with pytest.raises(agglo.InputError, match="the measure spread_m, and is to go on with nothing of the caller"):
        agglo.resume(cut)
    agglo.resume(cut, force=force, measures={"spread_m": spread_m})
    assert files(cut) == files(whole.folder)


def test_a_force_that_raises_makes_no_step(tmp_path):
    whole = agglo.run(soft(), tmp_path / "whole", force=FORCE)

    def breaks(time_s, *motion):
        if time_s > 0.9e-3:
            raise LookupError("no force")
        return pull(time_s, *motion)

    # Once it is put right it has the same name.
    breaks.__name__ = "pull"
    cut = tmp_path / "cut"
    with pytest.raises(LookupError, match="no force"):
        agglo.run(soft(), cut, force=agglo.Force(breaks, stiffness_over_mass=1e4))
    with pytest.raises(agglo.InputError, match='the force "the function pull", and is to go on with the force "the function push"'):
        agglo.resume(cut, force=push)
    agglo.resume(cut, force=FORCE)
    assert files(cut) == files(whole.folder)


def test_the_terminal_does_not_go_on_without_them(tmp_path):
    with pytest.raises(ZeroDivisionError):
        agglo.run(soft(), tmp_path / "run", force=FORCE, stop=lambda time_s, _: 1 / (time_s < 1e-3) < 0)
    done = subprocess.run([sys.executable, "-m", "agglo", "resume", str(tmp_path / "run")], capture_output=True, text=True)
    assert done.returncode == 2, done.stderr
    assert 'began with the force "the function pull", a rule that ends it, and is to go on with nothing' in done.stderr
    assert "agglo.resume` with force, measures and stop" in done.stderr


def test_stop_ends_a_run_as_if_its_end_were_there(tmp_path):
    run = agglo.run(hard(), tmp_path / "run", stop=lambda time_s, grains: np.bool_(time_s >= 1e-3))
    ends = ["breakage", "daughters", "kernels"]
    assert set(ends) <= set(run.tables) and "own" not in run.tables
    assert run.summary["time_s"] == 1e-3 == run.table("energy")["time_s"][-1] == run.grains()[0]
    assert run.summary["warnings"]["ended at 1 ms by a rule of the caller, before its end at 2 ms"] == 1


def test_what_cannot_take_part_is_refused_and_leaves_nothing(tmp_path):
    folder = tmp_path / "run"
    for scenario, given, error, told in [
        (hard(), {"force": pull}, agglo.InputError, "forces act on soft spheres"),
        (hard(), {"measures": {"a b": spread_m}}, agglo.InputError, "letters, digits and underscores"),
        (hard(), {"measures": {"time_s": spread_m}}, agglo.InputError, "the table has the time already"),
        (hard(), {"measures": {"a": lambda *_: "much"}}, agglo.InputError, "the measure a gives a number, or None"),
        (hard(), {"measures": {"a": lambda *_: np.inf}}, agglo.RunError, "the measure a is infinite"),
        (hard(), {"measures": {"a": 3.0}}, TypeError, "the measure a must be callable"),
        (hard(), {"stop": 3.0}, TypeError, "stop must be callable"),
        (soft(), {"force": 3.0}, TypeError, "the force must be callable"),
        (soft(), {"force": agglo.Force(pull, damping_over_mass=-1.0)}, agglo.InputError, "not below 0"),
        (soft(), {"force": lambda *_: np.zeros(3)}, agglo.InputError, "a force gives an array"),
        (soft(), {"measures": {"a": lambda *_: [][0]}}, IndexError, "out of range"),
    ]:
        with pytest.raises(error, match=told):
            agglo.run(scenario, folder, **given)
        assert not folder.exists(), told
    with pytest.raises(agglo.InputError, match="in runs that write a folder"):
        agglo.run(hard(), stop=lambda *_: True)


def test_functions_may_use_the_package_themselves(tmp_path):
    """On one thread, which the run has: what they start has others."""
    agglo.set_threads(1)
    try:
        few = hard().replace({"time.end": "20 us"})
        run = agglo.run(few, tmp_path / "run", measures={"inner_s": lambda *_: agglo.run(few)["time_s"]})
    finally:
        agglo.set_threads()
    assert run.table("own")["inner_s"].tolist() == [20e-6, 20e-6]


def test_domains_change_no_file_and_are_for_soft_spheres_alone(tmp_path):
    # Long enough to be told of more than once on its way.
    lasting = soft().replace({"grains.0.placement.random.count": 300, "time.end": "16 ms", "output.frames": "4 ms"})
    whole, cut = agglo.run(lasting, tmp_path / "whole"), tmp_path / "cut"

    def stops(progress):
        if progress["time_s"] > 0.0:
            raise StopIteration

    with pytest.raises(StopIteration):
        agglo.run(lasting, cut, domains=3, progress=stops)
    assert agglo.read(cut).summary is None
    agglo.resume(cut, domains=2)
    assert files(cut) == files(whole.folder)
    for number, told in [(0, "from 1 to 256"), (257, "from 1 to 256")]:
        with pytest.raises(agglo.InputError, match=told):
            agglo.run(soft(), tmp_path / "other", domains=number)
    with pytest.raises(agglo.InputError, match="events of hard spheres come one after the other; run it with one domain"):
        agglo.run(hard(), tmp_path / "other", domains=2)
    with pytest.raises(agglo.InputError, match="do not know of forces of the caller's own"):
        agglo.run(soft(), tmp_path / "other", domains=2, force=FORCE)
    with pytest.raises(agglo.InputError, match="write a folder"):
        agglo.run(soft(), domains=2)
    assert not (tmp_path / "other").exists()
