"""Calibration with Optuna: which restitution and friction give beads the energies that were measured?

    python3 examples/calibrate_optuna.py out/calibration             # about a minute; --short: seconds

Two loose clouds of glass beads fly into one another. How much they move and spin afterwards follows from the restitution and the
friction of their contacts: both take energy, friction alone makes beads spin. What is "measured" is planted here, over 32 runs
with known values from other random starts, so that one sees how well they are found again. The cost of a run is the sum of
squares of its deviations over their scatter, in logarithms: 2 on average where both numbers are right. Optuna proposes (its ask
and tell); agglo runs the replicates, keeps the journal and confirms the best from fresh starts. Started again, it goes on where
it was stopped.

It needs Optuna (pip install optuna) and matplotlib.
"""

import argparse
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import agglo
import matplotlib.pyplot as plt
import numpy as np
import optuna

PLANTED = {"restitution": 0.85, "friction": 0.12}
MEASURED = ["energy.kinetic_J", "energy.rotational_J"]

SCENARIO = {
    "version": 1,
    "title": "Two clouds of beads collide",
    "time": {"end": "30 ms"},
    "engine": {"verlet": {}},
    "medium": {"density": "1.2 kg/m3", "viscosity": "1.8e-5 Pa s"},
    # Much softer than glass: the steps are longer, and restitution and friction are what they were.
    "materials": {"glass": {"density": "2500 kg/m3", "youngs_modulus": "7 MPa", "poisson_ratio": 0.25}},
    "grains": [
        {
            "material": "glass",
            "size": {"constant": {"radius": "1.5 mm"}},
            "velocity": [f"{-0.5 * side} m/s", "0 m/s", "0 m/s"],
            "placement": {
                "random": {"count": 40, "region": {"sphere": {"center": [f"{12 * side} mm", "0 mm", "0 mm"], "radius": "11 mm"}}}
            },
        }
        for side in (-1, 1)
    ],
    "contact": {
        "normal": {"hertz": {}},
        "damping": {"restitution": {"restitution": PLANTED["restitution"]}},
        "friction": {"mindlin": {"static_friction": PLANTED["friction"], "dynamic_friction": PLANTED["friction"]}},
    },
}


def measure(scenario, runs=32):
    """Means of the logarithms of what is measured and their scatter, over random starts that the search does not have."""
    with ThreadPoolExecutor() as pool:
        energies = pool.map(lambda seed: agglo.run(scenario.seeded(seed))["energy"], range(1_000_000, 1_000_000 + runs))
        values = np.log([[energy[name.removeprefix("energy.")] for name in MEASURED] for energy in energies])
    return values.mean(axis=0), values.std(axis=0, ddof=1)


def campaign(scenario_file, measured, scatter, evaluations, replicates, confirm):
    """The search for the two numbers, whose points come from outside."""
    misses = [f"(ln({name}/{np.exp(mean):.17g})/{wide:.17g})^2" for name, mean, wide in zip(MEASURED, measured, scatter)]
    tables = {
        "version": 1,
        "title": "Calibration of restitution and friction",
        "base": {"file": str(scenario_file.resolve())},
        "parameters": [
            {
                "name": "restitution",
                "key": "contact.damping.restitution.restitution",
                "range": {"linear": {"lower": 0.5, "upper": 1.0}},
            },
            {
                "name": "friction",
                "key": "contact.friction.mindlin.static_friction",
                "range": {"linear": {"lower": 0.01, "upper": 0.5}},
            },
        ],
        "derived": [{"key": "contact.friction.mindlin.dynamic_friction", "formula": "friction"}],
        "objectives": [{"minimize": " + ".join(misses)}],
        "ensemble": {"until": {"fixed": {"replicates": replicates}}},
        "method": {"external": {"evaluations": evaluations}},
        "confirm": confirm,
    }
    return agglo.Campaign.from_dict(tables)


def calibrate(asked, folder, evaluations, at_once=4, seed=1):
    """Optuna leads the search into the folder, or goes on with the one that is there."""
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    sampler = optuna.samplers.TPESampler(seed=seed, multivariate=True, constant_liar=True, n_startup_trials=evaluations // 4)
    study = optuna.create_study(sampler=sampler)
    names = [parameter["name"] for parameter in asked.parameters]
    box = {name: optuna.distributions.FloatDistribution(0.0, 1.0) for name in names}
    is_there = folder.exists() and any(folder.iterdir())
    # Told the same, Optuna asks for the same: what is known already is answered from the journal.
    with agglo.Evaluator(None if is_there else asked, folder) as evaluate:
        for _ in range(evaluations // at_once):
            trials = [study.ask(box) for _ in range(at_once)]
            fitness = evaluate([[trial.params[name] for name in names] for trial in trials])
            for trial, (cost,) in zip(trials, fitness.costs):
                # Not a number: none of its runs came to an end.
                failed = optuna.trial.TrialState.FAIL if np.isnan(cost) else None
                study.tell(trial, None if failed else cost, state=failed)
    return evaluate.result


def draw(found, file):
    table = found.table("evaluations")
    tried = table["stage"] == "search"
    best = found.summary["best"]["parameters"]
    with plt.rc_context(agglo.plot_style()):
        figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
        order = np.argsort(-table["cost"][tried])
        x, y, cost = (table[name][tried][order] for name in ("restitution", "friction", "cost"))
        shown = left.scatter(x, y, c=np.log10(cost), s=18, cmap="viridis_r")
        figure.colorbar(shown, ax=left, label="log10 of the cost")
        left.plot(*PLANTED.values(), "+", color="#d55e00", markersize=14, markeredgewidth=2, label="planted")
        left.plot(best["restitution"], best["friction"], "o", color="#d55e00", markersize=9, fillstyle="none", label="found")
        left.set(title="What Optuna tried", xlabel="restitution", ylabel="friction")
        left.legend()
        right.semilogy(table["evaluation"][tried], table["cost"][tried], ".", color="#56b4e9", label="candidates")
        so_far = np.fmin.accumulate(table["cost"][tried])
        right.step(table["evaluation"][tried], so_far, where="post", color="#0072b2", linestyle="-", label="best so far")
        right.set(title="How well they fit", xlabel="evaluations", ylabel="cost")
        right.legend()
        figure.savefig(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the search and the picture go")
    parser.add_argument("--short", action="store_true", help="fewer beads and evaluations, for a try")
    given = parser.parse_args()
    scenario = agglo.Scenario.from_dict(SCENARIO)
    evaluations, replicates, confirm = 100, 8, {"candidates": 6, "replicates": 32}
    if given.short:
        scenario = scenario.replace({f"grains.{cloud}.placement.random.count": 20 for cloud in (0, 1)})
        evaluations, replicates, confirm = 32, 4, {"candidates": 2, "replicates": 8}
    given.folder.mkdir(parents=True, exist_ok=True)
    file = given.folder / "beads.toml"
    file.write_text(scenario.to_toml())

    measured, scatter = measure(scenario)
    asked = campaign(file, measured, scatter, evaluations, replicates, confirm)
    found = calibrate(asked, given.folder / "search", evaluations)
    best = found.summary["best"]
    for name, value in PLANTED.items():
        print(f"{name}: planted {value}, found {best['parameters'][name]:.3f}")
    for name, mean, wide in zip(MEASURED, measured, scatter):
        print(f"{name}: measured {np.exp(mean):.4g}, with a scatter of {wide:.1%}; of the best {best['quantities'][name]:.4g}")
    print(f"cost of the best from fresh starts: {best['cost']:.3g} ± {best['cost_standard_error']:.2g}")
    print(f"{found.summary['evaluations']} candidates, {found.summary['runs']} runs")
    draw(found, given.folder / "calibration.svg")


if __name__ == "__main__":
    main()
