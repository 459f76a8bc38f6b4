"""Searches from Python: the program's bits wherever simulations run, methods of one's own, loops of one's own."""

import concurrent.futures
import functools
import os
import pickle
import signal
import subprocess
import sys
import time
from pathlib import Path

import agglo
import agglo._batches
import numpy as np
import pytest

QUICK = {
    "settings": ["time.end=1 ms", "grains.0.size.length_ratio.count=30", "grains.0.placement.fill.count=30"],
    "ensemble.until": {"fixed": {"replicates": 2}},
    "confirm": {"candidates": 2, "replicates": 2},
    "method": {"cma_es": {"evaluations": 24}},
}


def campaign(**more):
    return agglo.Campaign.template("search", QUICK | {key.replace("__", "."): value for key, value in more.items()})


def files(folder):
    """All tables and summaries but for wall times."""
    paths = (path for path in Path(folder).rglob("*") if path.suffix in (".csv", ".json", ".svg") and "checkpoints" not in path.parts)
    return {
        str(path.relative_to(folder)): [line for line in path.read_text().splitlines() if "wall_s" not in line]
        for path in paths
    }


@pytest.fixture(scope="module")
def whole(tmp_path_factory, built):
    """The folder of the same search by the program."""
    folder = tmp_path_factory.mktemp("search")
    (folder / "mine.toml").write_text(campaign().to_toml())
    command = [built / "agglo", "search", folder / "mine.toml", "-o", folder / "theirs", "--no-report"]
    subprocess.run(command, check=True, capture_output=True)
    return files(folder / "theirs")


def test_campaigns_are_values():
    one = campaign()
    assert pickle.loads(pickle.dumps(one)) == one and one.replace({"seed": 2}) != one
    assert agglo.Campaign.from_dict(one.to_dict()) == one
    assert one.way == ("method", "cma_es") and not one.is_study and one.led(5).way == ("method", "external")
    v = one.parameters[0]
    assert (v["name"], v["unit"], v["scale"], v["lower"], v["upper"]) == ("v", "m/s", "linear", 20.0, 200.0)
    assert one.objectives == [("growth_deficit", False)] and one.columns[0] == "growth_deficit"
    middle = [0.5] * len(one.parameters)
    assert one.values(middle)["v"] == pytest.approx(110.0)
    speed = one.scenario(middle).to_dict()["grains"][0]["velocity_spread"]["uniform"]["bounds"][0]
    assert "110" in str(speed)
    with pytest.raises(agglo.InputError, match="10 are wanted"):
        one.values([0.5])
    with pytest.raises(agglo.InputError, match="not a part of a range"):
        one.scenario([1.5] + middle[1:])
    with pytest.raises(agglo.ScenarioError, match="evaluations"):
        one.led(0)
    with pytest.raises(agglo.InputError, match="a study tries"):
        agglo.Campaign.template("study").led(5)


def test_a_search_has_the_bits_of_the_program_wherever_it_runs(tmp_path, whole):
    here = agglo.search(campaign(), tmp_path / "here", at_once=1)
    assert files(here.folder) == whole
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        agglo.search(campaign(), tmp_path / "pool", executor=pool, at_once=12)
    assert files(tmp_path / "pool") == whole
    with concurrent.futures.ThreadPoolExecutor(3) as pool:
        agglo.search(campaign(), tmp_path / "threads", executor=pool)
    assert files(tmp_path / "threads") == whole


def test_what_was_begun_in_one_place_goes_on_in_another(tmp_path, built, whole):
    def stop(now):
        assert now["evaluations_at_most"] > 24 and now["stage"] == "search" or now["evaluations"] > 0
        if now["evaluations"] > 8:
            raise StopIteration

    with pytest.raises(StopIteration):
        agglo.search(campaign(), tmp_path / "search", progress=stop)
    assert agglo.read(tmp_path / "search").summary is None
    with concurrent.futures.ProcessPoolExecutor(1) as pool, pytest.raises(StopIteration):
        agglo.resume(tmp_path / "search", executor=pool, progress=lambda now: now["evaluations"] > 15 and stop(now))
    done = subprocess.run([built / "agglo", "resume", tmp_path / "search", "--no-report"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert files(tmp_path / "search") == whole


def test_results_are_read(tmp_path):
    found = agglo.search(campaign(), tmp_path / "search")
    again = agglo.read(tmp_path / "search")
    assert isinstance(again, agglo.Search) and again.campaign.to_dict()["base"] == {"file": "scenario.toml"}
    assert again.campaign.scenario([0.5] * 10).to_dict() == campaign().scenario([0.5] * 10).to_dict()
    assert found.summary["evaluations"] == len(again.table("evaluations")["evaluation"])
    assert again.best.summary["grains"] > 0 and isinstance(again.best, agglo.Run)
    assert again.report().read_text(encoding="utf-8").startswith("<!doctype html>")
    assert agglo.resume(tmp_path / "search").summary == found.summary
    with pytest.raises(agglo.InputError, match="there are best, evaluations"):
        again.table("nothing")
    with pytest.raises(agglo.InputError, match="a search or study; until"):
        agglo.resume(tmp_path / "search", until="1 s")


class Grid:
    """Points along the diagonal, one batch after the other."""

    def __init__(self):
        self.told = []

    def ask(self):
        at = len(self.told)
        return np.full((3, 10), [[0.1], [0.2], [0.3]]) + 0.2 * at if at < 3 else None

    def tell(self, fitness):
        self.told.append(fitness)


def test_methods_of_ones_own_propose_points(tmp_path):
    method = Grid()
    found = agglo.search(campaign().led(30), tmp_path / "search", method=method)
    costs = np.concatenate([fitness.costs[:, 0] for fitness in method.told])
    table = found.table("evaluations")
    searched = table["stage"] == "search"
    assert np.array_equal(costs, table["cost"][searched]) and len(costs) == 9
    assert np.all(method.told[0].standard_errors > 0.0) and np.all(method.told[0].violations == 0.0)
    with pytest.raises(agglo.InputError, match="found method.cma_es"):
        agglo.search(campaign(), tmp_path / "other", method=Grid())
    with pytest.raises(agglo.InputError, match="a program outside says"):
        agglo.search(campaign().led(30), tmp_path / "other")
    assert not (tmp_path / "other").exists()


def test_what_a_method_raises_comes_to_the_caller_and_the_search_goes_on_later(tmp_path):
    class Broken(Grid):
        def ask(self):
            if len(self.told) == 2:
                raise ZeroDivisionError("mine")
            return super().ask()

    folder = tmp_path / "search"
    with pytest.raises(ZeroDivisionError, match="mine"):
        agglo.search(campaign().led(30), folder, method=Broken())

    class Other(Grid):
        def ask(self):
            points = super().ask()
            return points if points is None else 1.0 - points

    with pytest.raises(agglo.InputError, match="proposes another point"):
        agglo.resume(folder, method=Other())
    agglo.resume(folder, method=Grid())
    agglo.search(campaign().led(30), tmp_path / "whole", method=Grid())
    assert files(folder) == files(tmp_path / "whole")


def test_a_loop_of_ones_own_leads(tmp_path):
    with agglo.Evaluator(campaign().led(5), tmp_path / "search") as evaluate:
        first = evaluate([[0.5] * 10, [0.2] * 10])
        second = evaluate([0.5] * 10)
        assert second.costs[0] == first.costs[0] and first.costs.shape == (2, 1)
        for points, told in [([[0.5] * 9], "9 numbers; 10"), ([[1.5] * 10], "not a part"), (np.empty((0, 10)), "no points")]:
            if told == "no points":
                with pytest.raises(agglo.InputError, match=told):
                    evaluate(points)
    assert evaluate.result.summary["repeats"] == 1
    with pytest.raises(agglo.InputError, match="9 numbers; 10"), agglo.Evaluator(campaign().led(5), tmp_path / "short") as evaluate:
        evaluate([[0.5] * 9])
    with pytest.raises(KeyError), agglo.Evaluator(campaign().led(5), tmp_path / "left") as evaluate:
        evaluate([[0.5] * 10])
        raise KeyError("the loop's own")
    with agglo.Evaluator(None, tmp_path / "left") as evaluate:
        assert evaluate([[0.5] * 10]).costs[0] == first.costs[0]
    with pytest.raises(agglo.InputError, match="come to its end"), agglo.Evaluator(campaign().led(1), tmp_path / "one") as evaluate:
        evaluate([[0.5] * 10])
        evaluate([[0.4] * 10])


def bowl(scenario):
    """A cost that is known: v over its range, squared."""
    low, high = scenario.to_dict()["grains"][0]["velocity_spread"]["uniform"]["bounds"][0], 200.0
    speed = float(str(low).split()[0])
    return {"growth_deficit": (speed / high - 0.5) ** 2, "radius_ratio": 1.0, "n_f": 1.0}


def test_functions_of_ones_own_are_what_is_searched(tmp_path):
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        found = agglo.search(campaign(confirm__candidates=0), tmp_path / "search", executor=pool, function=bowl)
    v, cost = (found.table("evaluations")[name] for name in ("v_m_s", "cost"))
    assert cost == pytest.approx((v / 200.0 - 0.5) ** 2)
    def fails(scenario):
        raise ValueError(f"no {scenario.is_hard}")

    with pytest.raises(agglo.RunError, match="ValueError: no True"):
        agglo.search(campaign(), tmp_path / "fails", function=fails)
    with pytest.raises(agglo.RunError, match="the function gave no radius_ratio"):
        agglo.search(campaign(), tmp_path / "poor", function=lambda scenario: {"growth_deficit": 1.0})


class Held:
    """An executor whose work ends when it is told to, as if each simulation took a hundredth of a second."""

    def __init__(self):
        self.sent = []

    def submit(self, work, function, packed):
        self.sent.append((concurrent.futures.Future(), pickle.loads(packed)))
        return self.sent[-1][0]

    def end(self, batch):
        future, jobs = self.sent[batch]
        future.set_result(([[float(job.seed)] for job in jobs], 0.01 * len(jobs)))


def test_short_simulations_travel_together():
    """Two workers, at most forty under way: once it is known how long they take, about ten go at a time."""
    held = Held()
    batches = agglo._batches.Batches(held, 2, None)
    given, begun = [], iter(range(1000))

    def refill():
        while sum(not future.done() for future in given) < 40:
            seed = next(begun)
            given.append(batches.submit("text", Path("."), seed, ["n"]))

    refill()
    assert [len(jobs) for _, jobs in held.sent] == [1, 1, 1, 1], "two for each worker, one by one while their time is not known"
    for batch in range(30):
        held.end(batch)
        refill()
    sizes = [len(jobs) for _, jobs in held.sent]
    assert set(sizes[-15:]) <= {9, 10} and max(sizes) <= 10, sizes
    # Nobody asks for more: what waits is sent as soon as workers are free, and all come to what they are.
    batch = 30
    while batch < len(held.sent):
        held.end(batch)
        batch += 1
    assert [future.result() for future in given] == [[float(seed)] for seed in range(len(given))]
    assert len({id(job.text) for job in held.sent[29][1]}) == 1, "replicates have their text in common"


def killed():
    os.kill(os.getpid(), signal.SIGKILL)


def test_an_executor_that_breaks_is_no_failure_of_a_candidate(tmp_path, whole):
    with concurrent.futures.ProcessPoolExecutor(1) as pool:
        with pytest.raises(concurrent.futures.process.BrokenProcessPool):
            pool.submit(killed).result()
        with pytest.raises(concurrent.futures.process.BrokenProcessPool):
            agglo.search(campaign(), tmp_path / "search", executor=pool)
    agglo.resume(tmp_path / "search")
    assert files(tmp_path / "search") == whole


def bowl_of_two(scenario):
    """A bowl that asks to stop once it was called twice."""
    if bowl_of_two.left == 0:
        raise KeyboardInterrupt
    bowl_of_two.left -= 1
    return bowl(scenario)


def test_a_search_goes_on_with_the_function_that_it_began_with(tmp_path):
    folder, function = tmp_path / "search", functools.partial(bowl_of_two)
    bowl_of_two.left = 2
    with pytest.raises(KeyboardInterrupt):
        agglo.search(campaign(confirm__candidates=0), folder, function=function, at_once=1)
    bowl_of_two.left = 10_000
    for other, whence in [(None, "runs of agglo"), (bowl, "the function bowl")]:
        words = f"come from the function bowl_of_two, and this session's from {whence}; go on with what it began with"
        with pytest.raises(agglo.InputError, match=words):
            agglo.resume(folder, function=other)
    found = agglo.resume(folder, function=bowl_of_two)
    assert found.summary["function"] == "bowl_of_two" and found.summary["evaluations"] == 24
    assert "function bowl_of_two instead of runs" in agglo.report(folder).read_text()
    with pytest.raises(KeyboardInterrupt):
        agglo.search(campaign(), tmp_path / "runs", progress=interrupted)
    with pytest.raises(agglo.InputError, match="come from runs of agglo, and this session's from the function bowl"):
        agglo.resume(tmp_path / "runs", function=bowl)


def test_a_study_has_kernels_with_their_errors(tmp_path):
    """All merges of all replicates; as long as few have merged, single grains meet as those of a gas in equilibrium do."""
    settings = ["output.size_classes=[1, 2, 3]", "time.end=10 ms"]
    study = agglo.Campaign.template("study-kernels", {"settings": settings, "ensemble.until": {"fixed": {"replicates": 12}}})
    found = agglo.search(study, tmp_path / "study")
    kernels, ended = found.kernels()["kernels"], found.table("runs")
    start = np.where(ended["evaluation"] == 0, 200, 400)
    assert len(start) == 24 and kernels["merges"].sum() == start.sum() - ended["grains_end"].sum()
    singles = (kernels["a_lower_primaries"] == 1) & (kernels["count"] == 400)
    # 4 √π s <(r_i + r_j)²> with the deviation s of all velocities, for lognormal radii; four errors are about 12 %.
    radius, spread = 10e-6, np.log(1.2)
    sums_squared = 2 * radius**2 * (np.exp(2 * spread**2) + np.exp(spread**2))
    due = 4 * np.sqrt(np.pi) * 1e-2 * sums_squared
    kernel = kernels["aggregation_kernel_m3_s"][singles][0]
    error = kernels["aggregation_kernel_standard_error_m3_s"][singles][0]
    assert 0.0 < error < 0.1 * kernel and abs(kernel - due) < 4 * error, (kernel, error, due)
    without = study.replace({"kernels": False, "ensemble.until": {"fixed": {"replicates": 1}}})
    with pytest.raises(agglo.InputError, match="there is no table 'kernels'"):
        agglo.search(without, tmp_path / "none").kernels()


def interrupted(progress):
    raise KeyboardInterrupt


# What a shell starts in the background ignores the signal, and so would its children.
CTRL_C = """
import agglo, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
campaign = agglo.Campaign.template("search")
print("ready", flush=True)
try:
    agglo.search(campaign, sys.argv[1])
except KeyboardInterrupt:
    print("stopped", agglo.read(sys.argv[1]).summary is None, flush=True)
"""


def test_ctrl_c_ends_a_search_within_a_second(tmp_path):
    child = subprocess.Popen([sys.executable, "-c", CTRL_C, tmp_path / "search"], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    time.sleep(1.0)
    child.send_signal(signal.SIGINT)
    asked = time.monotonic()
    assert child.stdout.readline() == "stopped True\n"
    assert time.monotonic() - asked < 1.0
    assert child.wait(10) == 0


def test_a_gaussian_process_finds_the_bottom_of_a_bowl(tmp_path):
    """Sixteen points of a parabola in one of two parameters; drawn at random the best of sixteen is 0.03 off on average."""
    pytest.importorskip("sklearn")
    parameters = campaign().to_dict()["parameters"][:2]
    led = campaign(parameters=parameters, confirm__candidates=0).led(16)
    found = agglo.search(led, tmp_path / "search", method=agglo.GaussianProcess(led, initial=6, batch=2), function=bowl)
    table = found.table("evaluations")
    assert len(table["cost"]) == 16
    assert abs(table["v_m_s"][np.argmin(table["cost"])] / 200.0 - 0.5) < 0.01
    again = agglo.search(led, tmp_path / "again", method=agglo.GaussianProcess(led, initial=6, batch=2), function=bowl)
    assert files(again.folder) == files(found.folder)
