"""Offsets of whole isotherms: their size, found from the misfit that no shift removes.

After clamping the sample again or reading its dimensions again, E' and E'' of an isotherm are each too large or too
small by one factor at all its frequencies.  More points do not average that out.  The variance follows from the misfit
of neighbours that no shift removes, by restricted maximum likelihood (H. D. Patterson, R. Thompson, Biometrika 58
(1971) 545) with the shifts linearised.  Some twenty isotherms determine a variance to a factor of two only, and worse
where vertical shifts are fitted too.  Standard errors include its mean over the likelihood; each bootstrap sample takes
one of the sizes, with the probability of that size.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from viscofric.arrays import Array
from viscofric.notes import Note, Remedy
from viscofric.rheology.superposition.shift_problem import Gauge, continued
from viscofric.units import shown_celsius

#: Where one modulus is shifted, offsets that are probably larger than this in both are no offsets: the other modulus is
#: wrong.  Sweeps of one sample repeat to 0.02 decades (`consistency.REPRODUCIBILITY`); sizes found scatter by a third.
LARGEST = 0.027  # decades
#: Standard deviations tried, decades: none, and 0.1 to 25 %.
SIZES = np.append(0.0, np.logspace(-3.4, -1.0, 13))
_ENDS = np.concatenate([[0.0], SIZES[1:] * 10.0**-0.1, [SIZES[-1] * 10.0**0.1]])
#: Scale of the half-Cauchy density of a size before any sweep is seen, which excludes neither none nor large ones: A.
#: Gelman, Bayesian Anal. 1 (2006) 515.
USUAL = 0.01  # decades
BEFORE = np.diff(np.arctan(_ENDS / USUAL))
#: Where vertical shifts are fitted, none is this many times as probable as all other sizes, which are equally probable,
#: together.  Few degrees of freedom are left there (3 of 13 isotherms of a soft rubber), so that this choice matters:
#: with 3, errors of α were half of what they should be in a quarter of the sweeps that had offsets; with 0.3, errors of
#: sweeps that have none are up to 1.6 times as large as with 3.
NONE = 0.3
_BESIDE_VERTICAL = np.append(NONE, np.full(len(SIZES) - 1, 1.0 / (len(SIZES) - 1)))
#: The sum and the difference of the offsets of log E' and log E'', over √2, have separate variances, independent a
#: priori: clamping anew changes both moduli by one factor, so that nothing is seen in the difference, and where the
#: curves are power laws, a shift takes the place of the sum.
TURNS = {1: np.ones((1, 1)), 2: np.array([[1.0, 1.0], [1.0, -1.0]]) / np.sqrt(2.0)}

#: Parts of log10 T that log10 b may have where no vertical shift was requested.  None is as probable as all others
#: together; of these four fifths lie between none and the whole, as of rubber elasticity with any expansion …
TRENDS = np.linspace(-6.0, 6.0, 241)
#: … and a fifth are normal with this standard deviation, as of fillers that soften.
ANY_TREND = 1.5
_ENTROPIC = (TRENDS > 0.0) & (TRENDS <= 1.0)
_ANY = np.exp(-0.5 * (TRENDS / ANY_TREND) ** 2)
NO_TREND = 1.0 * (TRENDS == 0.0)
BEFORE_TREND = 0.5 * NO_TREND + 0.4 * _ENTROPIC / _ENTROPIC.sum() + 0.1 * _ANY / _ANY.sum()
#: A vertical shift is noted where none has at most this probability.
CHANCE = 0.05


@dataclass(frozen=True, eq=False)
class OffsetSizes:
    """Possible sizes of offsets, and the probability of each."""

    # (k, m), standard deviations of sum and difference of two offsets of an isotherm, over √2, or of one; decades
    deviations: Array
    probability: Array  # (k,), sums to 1

    def draw(self, random: np.random.Generator, samples: int) -> Array:
        """Return sizes (samples, m), drawn by their probabilities."""
        return self.deviations[random.choice(len(self.probability), samples, p=self.probability)]


@dataclass(frozen=True, eq=False)
class LeftOut:
    """A vertical shift, log10 b a part of log10 T, that may have been left out of n isotherms, or points of ramps."""

    probability: Array  # of each of `TRENDS`
    log10_b: Array  # (n,), of the whole of it, zero at the reference
    follow: Array  # (n,), what it adds to log10 α found; of ramps (k,), to the logarithms of the constants of the law

    @property
    def size(self) -> float:
        """Root mean square of its part."""
        return float(np.sqrt(self.probability @ TRENDS**2))

    @property
    def errors(self) -> Array:
        """Standard errors of log10 α and of log10 b (2, n) from it; they are one error, of one sign or the other."""
        return np.asarray(self.size * np.stack([self.follow, self.log10_b]))

    def notes(self, coldest: float, warmest: float, remedy: Remedy) -> Iterator[Note]:
        """Yield a note if the moduli show a vertical shift, between the ends of the temperatures, K."""
        if self.probability @ NO_TREND > CHANCE:
            return
        change = float(self.probability @ TRENDS * np.ptp(self.log10_b))
        percent = 100.0 * (10.0**change - 1.0)
        text = (
            f"The moduli {'rise' if change > 0.0 else 'fall'} with temperature beside α, as by a vertical shift that "
            f"was left out, by about {abs(percent):.2g} % from {shown_celsius(coldest)} to {shown_celsius(warmest)} °C:"
            " it moves α, and the errors of α include that."
        )
        yield Note("vertical-shift-left-out", text, remedy=remedy, values={"percent": percent})


@dataclass(frozen=True, eq=False)
class IsothermOffsets:
    """Offsets that all points of an isotherm share, of m quantities, and how found shifts follow them.

    The quantities are log E' and log E'', whichever of them was shifted by; or one of them, or log tan δ, where the
    other modulus is wrong; or the one of step tests.
    """

    covariance: Array  # (m, m), of the offsets of one isotherm, decades²; isotherms are independent
    # (2n, m n), covariance of errors of log10 α and then of log10 b of n isotherms (rows) with the offsets of the first
    # quantity and then of the second (columns), decades².
    with_shifts: Array
    sizes: OffsetSizes  # which sizes offsets may have; `covariance` is the mean over them
    # (2, m), offsets of log E' and log E'' per offset of each quantity; (1, 1) for step tests.
    onto_moduli: Array = field(default_factory=lambda: np.eye(2))
    left_out: LeftOut | None = None  # where no vertical shift was requested

    def __repr__(self) -> str:
        storage, *loss = self.standard_deviations
        others = f" in E', {loss[0]:.2g} in E''" if loss else ""
        return f"IsothermOffsets({storage:.2g} decades{others})"

    @property
    def standard_deviations(self) -> Array:
        """Of log E' and of log E'', (2,), decades."""
        return np.asarray(np.sqrt(np.diag(self.onto_moduli @ self.covariance @ self.onto_moduli.T)))

    def of_moduli(self, offsets: Array) -> Array:
        """Return drawn offsets (samples, m n) as those of log E' and log E'' of each isotherm (samples, n, 2)."""
        by_isotherm = offsets.reshape(len(offsets), len(self.covariance), -1)
        return np.asarray(np.swapaxes(by_isotherm, 1, 2) @ self.onto_moduli.T)

    def continued(self, gauge: Gauge, first: int, last: int) -> IsothermOffsets:
        """Return the offsets of all isotherms of a gauge; these are those of the isotherms `first` to before `last`."""
        size, part, moduli = len(gauge.weights), last - first, len(self.covariance)
        with_shifts = np.zeros((2, size, moduli, size))
        own = self.with_shifts.reshape(2, part, moduli, part)
        for row in range(2):
            for column in range(moduli):
                with_shifts[row, :, column, first:last] = continued(own[row, :, column], gauge, first, last)
        left_out = self.left_out
        if left_out is not None and gauge.trend is not None:
            left_out = replace(left_out, log10_b=gauge.trend, follow=continued(left_out.follow, gauge, first, last))
        return replace(self, with_shifts=with_shifts.reshape(2 * size, moduli * size), left_out=left_out)

    def resized(self, random: np.random.Generator, errors: Array) -> Array:
        """Rescale the offsets of each sample to one size drawn at random, and move its shifts accordingly."""
        # `errors` (samples, s + m n), in decades, were drawn with the mean covariance: errors of log10 α, then of log10
        # b if fitted (s = 2n), then offsets of the first quantity and those of the second.
        if not np.any(self.covariance):
            return errors
        moduli, count = len(self.covariance), self.with_shifts.shape[1]
        turn = TURNS[moduli]
        shifts, offsets = errors[:, :-count], errors[:, -count:]
        mean = np.sqrt(self.sizes.probability @ self.sizes.deviations**2)  # that of the covariance, never below zero
        scale = self.sizes.draw(random, len(errors)) / (mean + 1e-300)
        turned = turn @ offsets.reshape(len(errors), moduli, -1)
        change = (turn.T @ ((scale[:, :, None] - 1.0) * turned)).reshape(offsets.shape)
        follow = self.with_shifts @ np.kron(np.linalg.pinv(self.covariance), np.eye(count // moduli))
        return np.concatenate([shifts + change @ follow[: shifts.shape[1]].T, offsets + change], axis=1)


@dataclass(frozen=True, eq=False)
class Offsets:
    """Estimated offsets of n isotherms."""

    covariance: Array  # (m, m), of the offsets of the quantities of one isotherm, decades²; the mean over `sizes`
    # (m n,), mean of the offsets of log E', then of log E'', given the measurement and the shifts found; decades
    expected: Array
    sizes: OffsetSizes
    trend: Array  # (t,), probability of each of `TRENDS`


def estimated(
    information: Array, score: Array, prior: Array, moduli: int = 2, *, tied: bool, trend: bool = False
) -> Offsets:
    """Estimate the variance of the offsets of the m quantities (`moduli`, 1 or 2) of n isotherms."""
    # `information` (p + m n, p + m n) and `score` (p + m n,), half of the decrease of the objective, are those of p
    # free shifts, of the offsets of log E', and of those of log E'', in units of the scatter of the points, with the
    # curves refitted. `prior` (p, p) is information on the shifts apart from the points. `tied` makes offsets of E' and
    # E'' independent of each other, as they must be where vertical shifts are fitted, which absorb whatever the two
    # have in common. With `trend`, the last row is that of a vertical shift that may have been left out, as a part of
    # log10 T.
    free, levels = len(prior), slice(len(prior), len(score) - trend)
    size = (len(score) - free - trend) // moduli
    if moduli == 1 and tied:  # part of the vertical shifts
        return Offsets(np.zeros((1, 1)), np.zeros(size), OffsetSizes(np.zeros((1, 1)), np.ones(1)), NO_TREND)
    turn = np.eye(len(score))[free:, free:]
    turn[: moduli * size, : moduli * size] = np.kron(TURNS[moduli], np.eye(size))
    gain = np.linalg.solve(information[:free, :free] + prior, information[:free, free:]).T
    left = turn @ (information[free:, free:] - gain @ information[:free, free:]) @ turn.T
    wish = turn @ (score[free:] - gain @ score[:free])
    turn = turn[: moduli * size, : moduli * size]
    if moduli == 1:
        tried, before, likelihood_of = SIZES[:, None], BEFORE, _likelihood_of_one
    else:
        tried = np.stack(np.meshgrid(SIZES, SIZES, indexing="ij"), axis=-1).reshape(-1, 2)
        before = (np.diag(_BESIDE_VERTICAL) if tied else np.outer(BEFORE, BEFORE)).ravel()
        likelihood_of = _likelihood_of_two
    probability = _beside_trends(likelihood_of, left, wish, before, trend)
    found, weight = probability.sum(axis=0), probability.sum(axis=1)
    variances = weight @ tried**2
    deviations = np.repeat(np.sqrt(variances), size)
    beside = np.eye(moduli * size) + deviations[:, None] * (turn @ information[levels, levels] @ turn.T) * deviations
    rest = score[levels]
    if trend:
        rest = rest - found @ TRENDS * information[levels, -1]
    expected = deviations * np.linalg.solve(beside, deviations * (turn @ rest))
    small = TURNS[moduli]
    return Offsets(small.T @ np.diag(variances) @ small, turn.T @ expected, OffsetSizes(tried, weight), found)


def _beside_trends(
    likelihood_of: Callable[[Array, Array], Array], left: Array, wish: Array, before: Array, trend: bool
) -> Array:
    """Return the probabilities of k sizes of offsets and of trends, (k, t), with probabilities (k,) of sizes before."""
    if not trend:
        likelihood, parts = likelihood_of(left, wish[None]).T, NO_TREND
    else:  # it is normal: its logarithm is a parabola of the trend, given by three of them
        three = np.array([[-1.0], [0.0], [1.0]])
        less, none, more = (
            likelihood_of(left[:-1, :-1], wish[:-1] - three * left[:-1, -1])
            + three * wish[-1]
            - 0.5 * left[-1, -1] * three**2
        )
        likelihood = np.outer(0.5 * (more - less), TRENDS) + np.outer(0.5 * (more + less) - none, TRENDS**2)
        likelihood, parts = none[:, None] + likelihood, BEFORE_TREND
    probability = np.outer(before, parts) * np.exp(likelihood - likelihood.max())
    return np.asarray(probability / probability.sum())


def _modes(information: Array) -> tuple[Array, Array]:
    """Return eigenvalues, of which rounding makes some negative, and eigenvectors."""
    known, modes = np.linalg.eigh(information)
    return np.maximum(known, 0.0), modes


def _of_sizes(known: Array, score: Array) -> Array:
    """Return ln of the likelihood of sizes (…, s) over that of none, from information and score of modes (…, n)."""
    variance = SIZES[:, None] ** 2
    found = variance * known[..., None, :]
    return np.asarray(0.5 * np.sum(variance * score[..., None, :] ** 2 / (1.0 + found) - np.log1p(found), axis=-1))


def _likelihood_of_one(left: Array, wishes: Array) -> Array:
    """Return ln of the likelihood of sizes (w, s) over that of none, from their information and scores (w, n)."""
    known, modes = _modes(left)
    return _of_sizes(known, wishes @ modes)


def _likelihood_of_two(left: Array, wishes: Array) -> Array:
    """Return the same of sizes of sums and of differences, all pairs of them."""
    size = len(left) // 2
    known, modes = _modes(left[:size, :size])
    variance = SIZES[:, None] ** 2
    part = variance / (1.0 + variance * known)  # of each size and mode of the sums
    across, score = modes.T @ left[:size, size:], wishes[:, :size] @ modes
    sums = _of_sizes(known, score)
    beside, modes = _modes(left[size:, size:] - (across.T * part[:, None, :]) @ across)
    remaining = wishes[:, None, size:] - (part * score[:, None]) @ across
    differences = _of_sizes(beside, np.einsum("smk,wsm->wsk", modes, remaining))  # beside sums of each size
    return np.asarray(sums[..., None] + differences).reshape(len(wishes), -1)
