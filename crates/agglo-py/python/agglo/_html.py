"""What notebooks show of scenarios, plans, grains, tables, runs and searches."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from agglo._types import Columns, Floats

if TYPE_CHECKING:
    from agglo._agglo import Scenario, Simulation
    from agglo._results import Run
    from agglo._search import Search
    from agglo._verbs import Plan

# Rows of a table that are shown: the first and the last ones.
_ROWS = 5
# Bytes of a page; a larger one would make the notebook slow, and is named instead.
_LARGEST_REPLAY = 20_000_000
# Grains of a picture; of more, an even sample.
_DRAWN = 2000
# viridis at even parts: the report's map (crates/agglo-view/src/plot/map.rs).
_MAP = np.array([[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]], dtype=np.float64)


def table(columns: Mapping[str, Any]) -> str:
    """The first and last rows of columns."""
    count = len(next(iter(columns.values()), ()))
    shown: list[int | None] = (
        list(range(count)) if count <= 2 * _ROWS else [*range(_ROWS), None, *range(count - _ROWS, count)]
    )
    head = "".join(f"<th>{html.escape(name)}</th>" for name in columns)
    cells = [["…" if at is None else _cell(values[at]) for values in columns.values()] for at in shown]
    body = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>" for row in cells)
    whole = f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table><p>{count} rows</p>"
    return f"<div style='overflow-x:auto;white-space:nowrap'>{whole}</div>"


def plan(found: Plan) -> str:
    """The plan as the terminal has it."""
    return f"<pre>{html.escape(found.text)}</pre>"


def scenario(found: Scenario) -> str:
    """What it is, and all of its keys to unfold."""
    engine = "hard spheres" if found.is_hard else "soft spheres"
    facts = _facts([("spheres", engine), ("end", f"{found.end_s:g} s")])
    return f"{_title(found.title)}{facts}<details><summary>all keys</summary><pre>{html.escape(found.to_toml())}</pre></details>"


def simulation(found: Simulation) -> str:
    """How far it is, and a picture of its grains."""
    columns = found.grains()
    steps = ("events" if found.scenario.is_hard else "steps", str(found.steps))
    facts = [("time", f"{found.time_s:.6g} s of {found.end_s:g} s"), steps, ("grains", str(len(columns["id"])))]
    return f"{_title(found.scenario.title)}{_facts(facts)}{grains(columns)}"


def grains(columns: Columns) -> str:
    """A picture of grains, seen along y with z up, colored by their speeds."""
    place, radius = columns["position_m"], columns["radius_m"]
    if len(place) == 0:
        return "<p>no grains</p>"
    speed = np.linalg.norm(columns["velocity_m_s"], axis=1)
    order = np.argsort(-place[:, 1], kind="stable")
    if len(order) > _DRAWN:
        order = order[np.linspace(0, len(order) - 1, _DRAWN).astype(np.int64)]
    lower, upper = (place - radius[:, None]).min(axis=0), (place + radius[:, None]).max(axis=0)
    width = max(float((upper - lower)[[0, 2]].max()), 1e-300)
    fastest = float(speed.max())
    colors = _viridis(speed / fastest if fastest > 0.0 else np.zeros(len(speed)))
    # The picture is 400 units wide and high; its middle is that of the grains.
    middle = (lower + upper) / 2.0
    at = 200.0 + 396.0 * (place - middle)[:, [0, 2]] / width * np.array([1.0, -1.0])
    circles = "".join(
        f"<circle cx='{at[one, 0]:.1f}' cy='{at[one, 1]:.1f}' r='{396.0 * radius[one] / width:.2f}' fill='{colors[one]}'/>"
        for one in order
    )
    words = f"{len(place)} grains, {len(order)} drawn" if len(order) < len(place) else f"{len(place)} grains"
    caption = f"{words}, {width:.3g} m wide, x to the right and z up; violet at rest, yellow at {fastest:.3g} m/s"
    look = "viewBox='0 0 400 400' width='400' height='400' stroke='#222222' stroke-width='0.4'"
    svg = f"<svg {look} role='img' aria-label='{caption}'>{circles}</svg>"
    return f"<figure style='margin:0'>{svg}<figcaption>{caption}</figcaption></figure>"


def run(found: Run) -> str:
    """What a run came to, and its replay where report.html is there."""
    summary, report = found.summary, found.folder / "report.html"
    facts = [("folder", str(found.folder)), ("state", "finished" if summary is not None else "not finished")]
    for key in ("time_s", "grains", "steps", "dispersion_degree", "radius_ratio", "wall_s"):
        if summary is not None and key in summary:
            facts.append((key, _cell(summary[key])))
    if not report.is_file():
        replay = "<p><code>run.report()</code> makes the page with the replay, which is shown here then.</p>"
    else:
        replay = page(report.read_text(encoding="utf-8"), str(report))
    return f"{_title(found.scenario.title)}{_facts(facts)}{replay}"


def search(found: Search) -> str:
    """What a search or study came to, with its best, and its report where that is there."""
    summary, report, campaign = found.summary, found.folder / "report.html", found.campaign
    facts = [("folder", str(found.folder)), ("state", "finished" if summary is not None else "not finished")]
    if summary is not None:
        facts += [(key, _cell(summary[key])) for key in ("evaluations", "runs", "failures", "wall_s") if key in summary]
        best = None if campaign.is_study else summary.get("best")
        if best is not None:
            cost, error = best["cost"], best["cost_standard_error"]
            facts.append(("cost of the best", f"{_cell(cost)} ± {_cell(error)}" if error is not None else _cell(cost)))
            facts += [(name, _cell(value)) for name, value in best["parameters"].items()]
    if not report.is_file():
        shown = f"<p><code>{'study' if campaign.is_study else 'search'}.report()</code> makes the page that is shown here then.</p>"
    else:
        shown = page(report.read_text(encoding="utf-8"), str(report))
    return f"{_title(campaign.title)}{_facts(facts)}{shown}"


def page(text: str, name: str) -> str:
    """A page in a frame of its own, with how large it is; too large a one by name alone."""
    size = len(text.encode())
    told = f"<p>{html.escape(name)}, {size / 1e6:.1f} MB</p>"
    if size > _LARGEST_REPLAY:
        return f"<p>{html.escape(name)} is {size / 1e6:.0f} MB, too much for a notebook: open it in a browser.</p>"
    # The page's scripts run, but reach nothing of the notebook.
    look = "style='width:100%;height:720px;border:1px solid #d9dee4'"
    return f"<iframe sandbox='allow-scripts' {look} srcdoc=\"{html.escape(text)}\"></iframe>{told}"


def _viridis(parts: Floats) -> list[str]:
    where = np.clip(parts, 0.0, 1.0) * (len(_MAP) - 1)
    red, green, blue = (
        np.interp(where, np.arange(len(_MAP)), _MAP[:, channel]).round().astype(int) for channel in range(3)
    )
    return [f"#{r:02x}{g:02x}{b:02x}" for r, g, b in zip(red, green, blue)]


def _title(words: str) -> str:
    return f"<p><b>{html.escape(words)}</b></p>"


def _facts(facts: Iterable[tuple[str, str]]) -> str:
    left = "style='text-align:left'"
    cells = [f"<th {left}>{html.escape(name)}</th><td {left}>{html.escape(value)}</td>" for name, value in facts]
    return f"<table>{''.join(f'<tr>{cell}</tr>' for cell in cells)}</table>"


def _cell(value: Any) -> str:
    if isinstance(value, (float, np.floating)):
        return f"{value:.6g}"
    if isinstance(value, np.ndarray):
        return html.escape(" ".join(f"{part:.6g}" for part in value.tolist()))
    return html.escape(str(value))
