"""Growing contacts: the response as a linear functional of the creep compliance or the relaxation modulus.

While the contact of a body of revolution grows, load and depth of a viscoelastic half-space follow from those of an
elastic one by the correspondence principle (E. H. Lee, J. R. M. Radok, J. Appl. Mech. 27 (1960) 438): with
X(δ) = 2 ∫₀ᵃ (δ − g(s)) ds of the one-dimensional profile g, g(a) = δ, which is (4/3) √R δ^{3/2} of a ball,

    X(δ(t)) = (1−ν²) ∫ J(t−s) dF(s),        F(t) = ∫ E(t−s) dX(δ(s))/(1−ν²).

The prescribed quantity I is linear between knots s_m, where its slope changes by κ_m or it jumps by Δ_m, so that

    ∫ R(t−s) dI(s) = Σ κ_m (t−s_m) M(t−s_m) + Σ Δ_m R(t−s_m),    M(t) = ∫₀ᵗ R ds/t,

with R = J or E: weights of R and of its mean M, which are interpolated over ln t.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array, lagrange
from viscofric.friction.identification.indentation.contact import EXACT, Answer, Shared, Trial
from viscofric.friction.identification.indentation.rows import Reduced, Rows, RowsContact, changes
from viscofric.rheology.spectra.misfit import contour

#: Points per decade of time at which J or E is evaluated; interpolation by cubics is then good to 1e-5 of it.
GRID = 20
#: Ratio of prescribed depths between which X is taken as linear, good to 1.5e-4 of it, and the least depth over the
#: largest one at which that is so.
FINE, LEAST_DEPTH = 1.04, 1e-4
#: Times below this fraction of the first row's time are not resolved.
SHORTEST = 1e-5
BLOCK = 500_000  # lags at once
#: Negligible change of ln α: where α is known, it is held to 1e-7.
SAME = 1e-6


class _Kernel(NamedTuple):
    """Matrices that depend on the retardation times and on one shift factor only."""

    tau: Array
    log_alpha: float
    relaxed: NDArray[Any]  # (G K, m), 1/(1 + s τ) at the nodes
    creep: Array  # (n, m), weighted, if the load was prescribed


@dataclass(frozen=True, eq=False, kw_only=True)
class Growing(RowsContact):
    """The usable rows of a record, averaged, as linear functionals of J (load prescribed) or E (depth prescribed)."""

    grid: Array  # (G,), times at which R and M are evaluated, s
    weights: Array  # (n, 2G), of M and of R: their product with both is the response times E/(1−ν²), or its inverse
    # relative changes of X by the radius and, in creep, by the zero of the depth (n,), by one standard deviation
    by_radius: float
    by_zero: Array | float
    # in relaxation: the same weights of the change of X by one standard deviation of the zero
    zero_weights: Array | None
    gain: float  # standard deviation of the load cell's gain
    _kept: list[_Kernel] = field(default_factory=list, init=False, repr=False)  # of the last material

    @property
    def log_elastic(self) -> float:
        """Ln of the plane-strain compliance of an elastic contact."""
        elastic = float(np.median(np.log(self.response / np.maximum(self._total, 1e-300))))
        return elastic if self.creep else -elastic

    @cached_property
    def _nodes(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """Nodes s (G K,) of Laplace's transform on a contour (`spectra.misfit`), and weights of M and R (2, K)."""
        nodes, weights = contour()
        return (nodes / self.grid[:, None]).ravel(), np.stack([weights / nodes, weights])

    @cached_property
    def _total(self) -> Array:
        return np.asarray(self.weights @ np.ones(2 * len(self.grid)))

    def answer(self, trial: Trial) -> Answer:
        """Return the response to a material."""
        strengths, kernel = np.exp(trial.compliances), self._kernel(trial)
        glass, C = float(strengths[0]), strengths[1:]
        value, changes, moved = self._response(glass, C, kernel, trial.extra)
        sign = 1.0 if self.creep else -1.0
        shared = np.zeros((len(self), 3))
        shared[:, 0], shared[:, 1], shared[:, 2] = -sign * self.by_radius, sign * self.gain, -self.by_zero
        if self.zero_weights is not None:
            compliance = glass + trial.extra + kernel.relaxed @ C
            shared[:, 2] = (self.zero_weights @ self._both(1.0 / compliance))[:, 0] / value
        log_value = np.log(value) + sign * np.log(trial.plane_strain)
        return Answer(log_value, changes / value[:, None], moved / value, shared)

    def _response(self, glass: float, C: Array, kernel: _Kernel, extra: float) -> tuple[Array, Array, Array]:
        """Return ∫ J dI, or ∫ E dI, (n,), with its changes by ln of the compliances (n, 1 + m) and by ln α (n,)."""
        if self.creep:
            changes = np.concatenate([(self._total * glass)[:, None], kernel.creep * C], axis=1)
            value = changes.sum(axis=1) + self._total * extra
            moved = self._weighted((C * kernel.relaxed * (kernel.relaxed - 1.0)).sum(axis=1)[:, None])[:, 0]
            return value, changes, moved
        modes = kernel.relaxed * C
        compliance = glass + extra + modes.sum(axis=1)
        slope = -1.0 / compliance**2
        value = self._weighted((1.0 / compliance)[:, None])[:, 0]
        by_alpha = (modes * (kernel.relaxed - 1.0)).sum(axis=1)
        columns = np.concatenate([np.full((len(modes), 1), glass), modes, by_alpha[:, None]], axis=1)
        changes = self._weighted(slope[:, None] * columns)
        return value, changes[:, :-1], changes[:, -1]

    def _kernel(self, trial: Trial) -> _Kernel:
        kept = self._kept[0] if self._kept else None
        if kept is None or kept.tau is not trial.tau or abs(kept.log_alpha - trial.log_alpha) > SAME:
            relaxed = 1.0 / (1.0 + np.outer(self._nodes[0], np.exp(trial.log_alpha) * trial.tau))
            creep = self._weighted(relaxed) if self.creep else np.zeros((0, 0))
            self._kept[:] = [kept := _Kernel(trial.tau, trial.log_alpha, relaxed, creep)]
        return kept

    def _weighted(self, transform: NDArray[Any]) -> Array:
        """Return the response (n, k) of functions of s at the nodes of every time on the grid, (G K, k)."""
        return np.asarray(self.weights @ self._both(transform))

    def _both(self, transform: NDArray[Any]) -> Array:
        """Return M and R on the grid (2G, k)."""
        weights = self._nodes[1]
        both = (weights @ transform.reshape(len(self.grid), weights.shape[1], -1)).real.swapaxes(0, 1)
        return np.asarray(both.reshape(2 * len(self.grid), -1))


def growing(rows: Rows, reduced: Reduced, shared: Shared = EXACT, by_radius: float = 0.0) -> Growing:
    """Return a record whose contact grows; `by_radius` is d ln X/d ln R at a given depth."""
    knots, values, moved = rows.knots, rows.values, None
    if not rows.creep:
        knots, depths = _subdivided(knots, values)
        values = reduced(depths)
        moved = changes(knots, shared.zero * reduced.slope(depths))
    bends, jumps = changes(knots, values)
    grid, weights = _weights(rows.time, knots, bends, jumps)
    by_zero, zero_weights = np.zeros(len(rows)), None
    if shared.zero > 0.0 and rows.creep:
        by_zero = rows.average @ (shared.zero * reduced.slope(rows.depth)) / rows.response
    elif shared.zero > 0.0 and moved is not None:
        zero_weights = rows.average @ _weights(rows.time, knots, *moved, grid)[1]
    return Growing(
        **vars(rows),
        grid=grid,
        weights=rows.average @ weights,
        by_radius=shared.radius * by_radius,
        by_zero=by_zero,
        zero_weights=zero_weights,
        gain=shared.gain,
    )


def _subdivided(knots: Array, depths: Array) -> tuple[Array, Array]:
    """Return depths at more knots, since X is not linear in the depth."""
    times, values = [knots[:1]], [depths[:1]]
    for (start, above), (end, below) in pairwise(zip(knots, depths, strict=True)):
        within = np.array([below])
        if end > start and below > above:
            least = max(above, LEAST_DEPTH * below)
            count = int(np.ceil(np.log(below / least) / np.log(FINE)))
            within = np.geomspace(least, below, count + 1)[int(least == above) :]
        share = (within - above) / (below - above) if below != above else np.ones(1)
        times.append(start + share * (end - start))
        values.append(within)
    return np.concatenate(times), np.concatenate(values)


def _weights(time: Array, knots: Array, bends: Array, jumps: Array, grid: Array | None = None) -> tuple[Array, Array]:
    """Return the grid of times (G,) and the weights (n, 2G) of M and of R on it; `time` (n,) lies after a knot."""
    acting = (bends != 0.0) | (jumps != 0.0)
    knots, bends, jumps = knots[acting], bends[acting], jumps[acting]
    low = float(np.min(time - knots[np.searchsorted(knots, time, side="left") - 1]))
    low = max(low, SHORTEST * float(time.min() - knots[0]))
    high = float(time.max() - knots[0])
    if grid is not None:
        low, high = float(grid[0]), float(grid[-1])
    count = max(4, int(np.ceil(GRID * np.log10(high / low))) + 1) if grid is None else len(grid)
    spacing = max(np.log(high / low) / (count - 1), 1e-3)
    weights = np.zeros(len(time) * 2 * count)
    for block in np.array_split(np.arange(len(time)), max(1, len(time) * len(knots) // BLOCK)):
        lags = time[block, None] - knots
        rows, columns = np.nonzero(lags > 0.0)
        lag = lags[rows, columns]
        place = np.log(np.maximum(lag / low, 1.0)) / spacing
        cell = np.clip(np.floor(place).astype(int) - 1, 0, count - 4)
        for node, share in enumerate(lagrange(np.arange(4.0), place - cell).T):
            of_mean, of_value = block[rows] * 2 * count + cell + node, (block[rows] * 2 + 1) * count + cell + node
            weights += np.bincount(of_mean, share * bends[columns] * lag, len(weights))
            weights += np.bincount(of_value, share * jumps[columns], len(weights))
    return low * np.exp(spacing * np.arange(count)), weights.reshape(len(time), -1)
