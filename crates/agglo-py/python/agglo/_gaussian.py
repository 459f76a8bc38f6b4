"""Bayesian optimization with a Gaussian process."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
import numpy.typing as npt

from agglo._agglo import Campaign
from agglo._errors import InputError
from agglo._fitness import Fitness
from agglo._optional import need
from agglo._types import Floats

# Points of the unit cube at which the expected improvement is looked at, and how many of the best it is climbed from.
_TRIED = 2048
_CLIMBED = 3


class GaussianProcess:
    """Proposes the point whose expected improvement over the best so far is largest, by a Gaussian process of scikit-learn.

    Equation: EI(x) = (c_best - m(x)) Phi(z) + s(x) phi(z), z = (c_best - m(x))/s(x), with the mean m and standard deviation s of the
    process, whose kernel is Matern's with nu = 5/2 and a length for each parameter; the variance of the mean over the replicates is
    its noise at each point. Limits: EI is multiplied with the probability that the violation, another process, is at most 0.

    Source: D. R. Jones, M. Schonlau and W. J. Welch, J. Global Optim. 13, 455 (1998), section 4.1; with noise the best is that of
    the process's means at the points tried (V. Picheny et al., Struct. Multidiscip. Optim. 48, 607 (2013), "plug-in"); limits:
    M. Schonlau, W. J. Welch and D. R. Jones, IMS Lect. Notes 34, 11 (1998). Several points at once are chosen one after another, each
    as if the ones before had come to their means ("kriging believer": D. Ginsbourger, R. Le Riche and L. Carraro (2010)).

    It is for few evaluations, tens to a few hundreds, of up to about twenty parameters, and one objective.

    Args:
        campaign: What is searched.
        initial: How many points fill the box at the start; 2 (d + 1) for d parameters if left out.
        batch: How many points are proposed at once.
        seed: The same seed proposes the same points when it is told the same.

    Raises:
        PackageError: scikit-learn is not installed.
        InputError: The campaign has not one objective, or a number is not above 0.
    """

    def __init__(self, campaign: Campaign, *, initial: int | None = None, batch: int = 1, seed: int = 1) -> None:
        self._process = need("sklearn.gaussian_process", "GaussianProcess")
        self._optimize = need("scipy.optimize", "GaussianProcess")
        quasi = need("scipy.stats.qmc", "GaussianProcess")
        self._dimensions = len(campaign.parameters)
        initial = 2 * (self._dimensions + 1) if initial is None else initial
        if len(campaign.objectives) != 1:
            raise InputError(f"the campaign has {len(campaign.objectives)} objectives; GaussianProcess makes one small")
        if initial < 1 or batch < 1:
            raise InputError(f"initial is {initial} and batch {batch}; numbers from 1 are wanted")
        self._batch = batch
        self._seed = seed
        # A sequence is even over powers of 2.
        even = quasi.Sobol(self._dimensions, seed=seed).random_base2(math.ceil(math.log2(initial)))
        self._asked: Floats = even[:initial]
        self._is_first = True
        self._points: Floats = np.empty((0, self._dimensions))
        self._costs: Floats = np.empty(0)
        self._errors: Floats = np.empty(0)
        self._violations: Floats = np.empty(0)

    def ask(self) -> Floats:
        """The next points [n, parameters]."""
        if self._is_first:
            self._is_first = False
        else:
            self._asked = self._proposed()
        return self._asked

    def tell(self, fitness: Fitness, /) -> None:
        """How good they are."""
        self._points = np.concatenate([self._points, self._asked[: len(fitness.violations)]])
        self._costs = np.concatenate([self._costs, fitness.costs[:, 0]])
        self._errors = np.concatenate([self._errors, fitness.standard_errors[:, 0]])
        self._violations = np.concatenate([self._violations, fitness.violations])

    def recommended(self) -> Floats | None:
        """The point tried whose mean by the process is lowest among those that keep the limits."""
        is_kept = self._violations == 0.0
        if not is_kept.any():
            return None
        means = self._model(self._points, *self._of_costs()).predict(self._points)
        best: Floats = self._points[np.argmin(np.where(is_kept, means, np.inf))]
        return best

    def _of_costs(self) -> tuple[Floats, Floats]:
        """Costs and variances; what failed is as bad as the worst that did not."""
        known = np.isfinite(self._costs)
        worst = float(np.max(self._costs[known], initial=0.0)) if known.any() else 0.0
        return np.where(known, self._costs, worst), np.where(known, self._errors, 0.0) ** 2

    def _of_violations(self) -> Floats:
        """Violations; of those that keep the limits -1, so that a border lies between them and the others."""
        known = np.isfinite(self._violations)
        worst = float(np.max(self._violations[known], initial=1.0))
        missed = np.where(known, self._violations, worst)
        limits: Floats = np.where(missed == 0.0, -1.0, np.minimum(missed, 1.0))
        return limits

    def _model(self, points: Floats, values: Floats, variances: Floats) -> Any:
        kernels = self._process.kernels
        scale = float(np.std(values)) or 1.0
        kernel = kernels.ConstantKernel(1.0, (1e-3, 1e3)) * kernels.Matern(
            np.full(self._dimensions, 0.5), (1e-2, 1e2), nu=2.5
        ) + kernels.WhiteKernel(1e-4, (1e-8, 1.0))
        model = self._process.GaussianProcessRegressor(
            kernel,
            alpha=variances / scale**2 + 1e-10,
            normalize_y=True,
            n_restarts_optimizer=1,
            random_state=self._seed,
        )
        return _quietly(lambda: model.fit(points, values))

    def _proposed(self) -> Floats:
        costs, variances = self._of_costs()
        model = self._model(self._points, costs, variances)
        misses = not np.all(self._violations == 0.0)
        limits = self._model(self._points, self._of_violations(), np.zeros(len(costs))) if misses else None
        points, chosen = self._points, []
        rng = np.random.default_rng((self._seed, len(points)))
        for _ in range(self._batch):
            means = model.predict(self._points)
            is_kept = self._violations == 0.0
            best = float(np.min(means[is_kept], initial=np.inf)) if is_kept.any() else float(np.min(means))
            chosen.append(self._best_of(model, limits, best, rng))
            points = np.vstack([points, chosen[-1]])
            costs = np.append(costs, model.predict(chosen[-1][None])[0])
            variances = np.append(variances, 0.0)
            if len(chosen) < self._batch:
                model = self._model(points, costs, variances)
        return np.array(chosen)

    def _best_of(self, model: Any, limits: Any, best: float, rng: np.random.Generator) -> Floats:
        """The point of the largest expected improvement: the best of many, climbed from."""

        def gain(points: npt.ArrayLike) -> Floats:
            return _gain(model, limits, best, np.atleast_2d(points))

        near = self._points[np.argsort(self._of_costs()[0])[:_CLIMBED]]
        around = np.repeat(near, 20, axis=0) + rng.normal(0.0, 0.05, (20 * len(near), self._dimensions))
        tried = np.vstack([rng.random((_TRIED, self._dimensions)), np.clip(around, 0.0, 1.0)])
        starts = tried[np.argsort(-gain(tried))[:_CLIMBED]]
        found = [
            self._optimize.minimize(lambda x: -float(gain(x)[0]), start, bounds=[(0.0, 1.0)] * self._dimensions).x
            for start in starts
        ]
        ends = np.clip(np.vstack([starts, *found]), 0.0, 1.0)
        point: Floats = ends[np.argmax(gain(ends))]
        return point


def _gain(model: Any, limits: Any, best: float, points: Floats) -> Floats:
    mean, deviation = model.predict(points, return_std=True)
    deviation = np.maximum(deviation, 1e-12)
    z = (best - mean) / deviation
    gain: Floats = (best - mean) * _below(z) + deviation * np.exp(-0.5 * z**2) / math.sqrt(2.0 * math.pi)
    if limits is not None:
        mean, deviation = limits.predict(points, return_std=True)
        gain = gain * _below(-mean / np.maximum(deviation, 1e-12))
    return gain


def _below(z: Floats) -> Floats:
    """Probability that a standard normal number is below z."""
    values: Floats = 0.5 * (1.0 + np.vectorize(math.erf)(z / math.sqrt(2.0)))
    return values


def _quietly(work: Any) -> Any:
    """Without the notes of scikit-learn on bounds of kernels, which are wide on purpose."""
    exceptions = need("sklearn.exceptions", "GaussianProcess")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", exceptions.ConvergenceWarning)
        return work()
