"""A study on Dask: how grains grow over how fast they fly, on this machine or on a cluster.

    python3 examples/study_dask.py out/dask                          # starts two workers here; --short: fewer runs
    python3 examples/study_dask.py out/dask tcp://10.0.0.1:8786      # the workers of a scheduler that is there

What is run and what comes of it is that of `agglo study`: the same files and bits, whatever the workers are and however many.
Workers need the package agglo, and the files that a scenario names (this one names none): scenarios travel to them as text. One
that dies costs the runs that it had, which Dask gives to another. Started again, the study goes on where it was stopped.

It needs Dask and matplotlib (pip install ".[plots,cluster]" in the folder of the project).
"""

import argparse
import contextlib
from pathlib import Path

import agglo
from dask.distributed import Client, LocalCluster


def campaign(grains, replicates):
    """Growth over the spread of speeds along x, a tenth of it along y and z; each point is a mean over random starts."""
    spread = "grains.0.velocity_spread.uniform.bounds"
    settings = {
        "title": "Growth against speed",
        "settings": [
            'grains.0.velocity=["0 m/s", "0 m/s", "0 m/s"]',
            f"grains.0.size.length_ratio.count={grains}",
            f"grains.0.placement.fill.count={grains}",
        ],
        "parameters": [{"name": "v", "key": f"{spread}.0", "range": {"linear": {"lower": "20 m/s", "upper": "200 m/s"}}}],
        "derived": [{"key": f"{spread}.{axis}", "formula": "0.1*v"} for axis in (1, 2)],
        "plan": {"grid": {"levels": 10}},
        "ensemble.until": {"fixed": {"replicates": replicates}},
    }
    return agglo.Campaign.template("study", settings)


def conduct(asked, folder, client, progress=None):
    """The study in the folder, or what is left of it to do, on the workers of a client."""
    if folder.exists() and any(folder.iterdir()):
        return agglo.resume(folder, executor=client.get_executor(), progress=progress)
    return agglo.search(asked, folder, executor=client.get_executor(), progress=progress)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the study and the picture go")
    parser.add_argument("scheduler", nargs="?", help="address of a Dask scheduler; without it two workers are started here")
    parser.add_argument("--short", action="store_true", help="fewer grains and runs, for a try")
    given = parser.parse_args()
    asked = campaign(100, 8) if given.short else campaign(1000, 16)
    with contextlib.ExitStack() as stack:
        # Processes with a thread each: one simulation at a time in each of them.
        where = given.scheduler or stack.enter_context(LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None))
        client = stack.enter_context(Client(where))
        found = conduct(asked, given.folder / "study", client)
        print(f"{len(client.scheduler_info()['workers'])} workers")
    summary = found.summary
    print(f"{summary['evaluations']} evaluations, {summary['runs']} runs, {summary['failures']} failures")
    measures = found.table("measures")
    for speed, mean, error in zip(*(measures[name] for name in ("v_m_s", "radius_ratio", "radius_ratio_standard_error"))):
        print(f"{speed:.0f} m/s: mean radius {mean:.3f} ± {error:.3f} times the first")
    found.plot(["radius_ratio", "largest_fraction"]).savefig(given.folder / "growth.svg")


if __name__ == "__main__":
    main()
