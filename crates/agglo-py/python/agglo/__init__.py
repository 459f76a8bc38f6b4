"""How particulate agglomerates grow, break up and disperse.

A scenario says what there is and what happens; it is run into a folder, or stepped one by one:

>>> import agglo
>>> scenario = agglo.Scenario.template("acoustic", {"grains.0.placement.random.count": 60, "time.end": "0.1 ms"})
>>> simulation = agglo.Simulation(scenario)
>>> simulation.run_until(50e-6)
>>> simulation.grains()["position_m"].shape
(60, 3)

Quantities are in SI units, and names of arrays end with theirs. Arrays are copies in the order of the grains' ids.
"""

from agglo._agglo import (
    VERSION as __version__,
    Campaign,
    Scenario,
    Simulation,
    bibtex,
    cite,
    collide,
    explain,
    laws,
    pack,
    set_threads,
    templates,
)
from agglo._errors import AggloError, InputError, PackageError, RunError, ScenarioError
from agglo._fitness import Fitness
from agglo._guests import Force
from agglo._gaussian import GaussianProcess
from agglo._hand_over import HandOver, hand_over
from agglo._pieces import Trace, contact, reflect, trace
from agglo._plots import style as plot_style
from agglo._recorded import report
from agglo._results import Run
from agglo._search import Evaluator, Search, read, search
from agglo._settings import scenario
from agglo._shapes import to_ase, to_pyvista
from agglo._start import start
from agglo._tables import Table
from agglo._verbs import Plan, check, resume, run, schema, snapshots

__all__ = [
    "AggloError",
    "Campaign",
    "Evaluator",
    "Fitness",
    "Force",
    "GaussianProcess",
    "HandOver",
    "InputError",
    "PackageError",
    "Plan",
    "Run",
    "RunError",
    "Scenario",
    "ScenarioError",
    "Search",
    "Simulation",
    "Table",
    "Trace",
    "__version__",
    "bibtex",
    "check",
    "cite",
    "collide",
    "contact",
    "explain",
    "hand_over",
    "laws",
    "pack",
    "plot_style",
    "read",
    "reflect",
    "report",
    "resume",
    "run",
    "scenario",
    "schema",
    "search",
    "set_threads",
    "snapshots",
    "start",
    "templates",
    "to_ase",
    "to_pyvista",
    "trace",
]
