"""What Dask costs: the overhead of an evaluation, and a thousand evaluations of 10 ms on two workers.

    python3 docs/studies/dask_overhead.py              # as for docs/cluster.md: three turns, the least of each

Evaluations sleep or compute for 10 ms, or do nothing; the ideal is their time over the two workers. Those that do nothing are under way
one at a time, so that each goes alone to a worker and back.
"""

import os
import sys
import tempfile
import time
from pathlib import Path

import agglo
from dask.distributed import Client, LocalCluster

FOUND = {"growth_deficit": 0.5, "radius_ratio": 1.0, "largest_fraction": 0.5, "temperature_mean_K": 300.0, "impacts": 1.0}
EACH_S = 0.01


def nothing(scenario):
    return FOUND


def sleeps(scenario):
    time.sleep(EACH_S)
    return FOUND


def computes(scenario):
    end = time.process_time() + EACH_S
    while time.process_time() < end:
        pass
    return FOUND


def seconds(client, function, points, at_once):
    """How long ten replicates at each of so many points take."""
    # A study: at its end a search would run its best once more, here, with frames.
    settings = {"ensemble.until": {"fixed": {"replicates": 10}}, "plan": {"grid": {"levels": points}}}
    campaign = agglo.Campaign.template("study", settings)
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        agglo.search(campaign, Path(folder) / "study", executor=client.get_executor(), at_once=at_once, function=function)
        return time.perf_counter() - began


def round_trip(client, count=200):
    """How long Dask itself takes to bring a call to a worker and back."""
    executor = client.get_executor()
    began = time.perf_counter()
    for number in range(count):
        executor.submit(abs, number).result()
    return (time.perf_counter() - began) / count


def main():
    turns = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    print(f"{os.cpu_count()} processors, load {os.getloadavg()[0]:.1f} before")
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        seconds(client, nothing, 5, 1)
        bare = min(round_trip(client) for _ in range(turns))
        print(f"a call of Dask's own that does nothing: {1e3 * bare:.1f} ms")
        alone = min(seconds(client, nothing, 20, 1) for _ in range(turns))
        print(f"an evaluation that does nothing, one at a time: {1e3 * alone / 200:.1f} ms")
        for function in (sleeps, computes):
            took = min(seconds(client, function, 100, 40) for _ in range(turns))
            ideal = 1000 * EACH_S / 2
            print(f"a thousand evaluations, each of which {function.__name__} for 10 ms: {took:.2f} s, {ideal / took:.0%} of the ideal")
    print(f"load {os.getloadavg()[0]:.1f} after")


if __name__ == "__main__":
    main()
