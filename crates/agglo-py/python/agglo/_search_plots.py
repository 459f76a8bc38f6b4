"""Charts of searches and studies with matplotlib, in the look of the report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from agglo._errors import InputError
from agglo._optional import need
from agglo._plots import LINES, LOOK, figure_of
from agglo._tables import Table
from agglo._types import Floats

if TYPE_CHECKING:
    from agglo._search import Search

_MANY = LINES[5][0]
_BEST = LINES[0][0]


def plot(found: Search, quantities: Sequence[str] | None = None) -> Any:
    """Charts of a search or study: see `Search.plot`."""
    campaign = found.campaign
    if campaign.is_study:
        return _study(found, quantities)
    if quantities is not None:
        raise InputError(f"{found.folder} holds a search; quantities are for studies, a search shows its costs")
    evaluations = found.table("evaluations")
    if len(evaluations["evaluation"]) == 0:
        raise InputError(f"{found.folder} holds a search that has evaluated nothing yet; there is nothing to draw")
    objectives = campaign.objectives
    names = [f"{formula}, to be {'large' if is_large else 'small'}" for formula, is_large in objectives]
    figure, panels = figure_of(len(objectives))
    # With two objectives the tables' best is that of the first one.
    cost = "cost" if len(objectives) == 1 else "cost_1"
    with need("matplotlib", "Search.plot").rc_context(LOOK):
        _course(panels[0], found.table("generations"), evaluations, cost)
        panels[0].set(ylabel="cost" if not objectives[0][1] else "cost, minus the value")
        panels[0].set_title(names[0])
        if len(objectives) > 1:
            signs = [-1.0 if is_large else 1.0 for _, is_large in objectives]
            _front(panels[1], evaluations, signs)
            panels[1].set(xlabel=names[0], ylabel=names[1], title="What can be had together")
    figure.suptitle(campaign.title, x=0.01, ha="left")
    return figure


def _course(axes: Any, generations: Table, evaluations: Table, cost: str) -> None:
    """All costs, and the best so far with its standard error."""
    # What confirms the best has other replicates: it is no further candidate.
    is_fresh = np.isin(evaluations["stage"], ["confirm", "final"])
    at, costs, errors = (evaluations[name] for name in ("evaluation", cost, f"{cost}_standard_error"))
    axes.plot(at[~is_fresh], costs[~is_fresh], ".", color=_MANY, markersize=3, label="candidates")
    course = ~np.isin(generations["stage"], ["confirm", "final"])
    after, best, error = (
        generations[name][course] for name in ("evaluations", "best_cost", "best_cost_standard_error")
    )
    axes.fill_between(after, best - error, best + error, color=_BEST, alpha=0.2, linewidth=0, step="post")
    axes.step(after, best, where="post", color=_BEST, label="best so far, ± one standard error")
    if is_fresh.any():
        axes.errorbar(
            at[is_fresh],
            costs[is_fresh],
            errors[is_fresh],
            fmt="o",
            color=LINES[1][0],
            markersize=3,
            label="the best from fresh starts",
        )
    axes.set(xlabel="evaluations")
    axes.legend()


def _front(axes: Any, evaluations: Table, signs: Sequence[float]) -> None:
    """Two objectives against one another, and those that no other one beats in both."""
    costs = np.stack([evaluations["cost_1"], evaluations["cost_2"]], axis=1)
    keeps = (evaluations["violation"] == 0.0) & np.isfinite(costs).all(axis=1)
    axes.plot(*(costs * signs).T, ".", color=_MANY, markersize=3, label="candidates")
    front = _front_of(costs[keeps]) * signs
    axes.plot(*front.T, "o-", color=_BEST, markersize=3, label="no other is better in both")
    axes.legend()


def _front_of(costs: Floats) -> Floats:
    """Those of the points [n, 2] that no other one beats, by their first cost."""
    ordered = costs[np.lexsort((costs[:, 1], costs[:, 0]))]
    least = np.minimum.accumulate(np.append(np.inf, ordered[:, 1]))
    return ordered[ordered[:, 1] < least[:-1]]


def _study(found: Search, quantities: Sequence[str] | None) -> Any:
    """Means with their standard errors over each parameter."""
    campaign, measures = found.campaign, found.table("measures")
    names = list(measures)
    first = names.index("replicates")
    parameters = dict(zip(names[1:first], campaign.parameters))
    known = [name for name in names[first + 1 :] if f"{name}_standard_error" in measures]
    if quantities is None:
        # Many parameters have a panel each, and show one quantity.
        quantities = known if len(parameters) == 1 else known[:1]
    quantities = [quantities] if isinstance(quantities, str) else list(quantities)
    for name in quantities:
        if name not in known:
            raise InputError(f"the study has no quantity {name!r}; there are {', '.join(known)}")
    shown = [(quantity, column) for quantity in quantities for column in parameters]
    figure, panels = figure_of(len(shown))
    with need("matplotlib", "Search.plot").rc_context(LOOK):
        for axes, (quantity, column) in zip(panels, shown):
            parameter = parameters[column]
            place, error = measures[column], measures[f"{quantity}_standard_error"]
            order = np.argsort(place, kind="stable") if len(parameters) == 1 else np.arange(len(place))
            # Points of one parameter are a line; where others vary as well they are a cloud.
            line = "-" if len(parameters) == 1 and place.dtype.kind == "f" else "none"
            axes.errorbar(
                place[order], measures[quantity][order], error[order], color=_BEST, marker="o", markersize=3, linestyle=line
            )
            unit = f" ({parameter['unit']})" if parameter["unit"] not in ("", "1", None) else ""
            axes.set(title=quantity, xlabel=f"{parameter['name']}{unit}", ylabel="mean ± one standard error")
            if parameter["scale"] == "log":
                axes.set_xscale("log")
    figure.suptitle(campaign.title, x=0.01, ha="left")
    return figure
