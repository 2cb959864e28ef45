"""Spectra of few modes: retardation times are free, and their number is the smallest that meets an error."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.rheology.spectra.modulus_misfit import Modes, descend
from viscofric.rheology.spectra.nonnegative import nonnegative_modes

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.rheology.spectra.modulus_misfit import Misfit


ITERATIONS = 40
CONVERGED = 1e-4  # relative fall of the sum of squares
#: A mode with less than this part of the compliance at its own frequency is left out.
NEGLIGIBLE = 1e-6
#: The search for the fewest modes changes their number in steps of this part of it.
STRIDES = 5
#: Modes whose times are closer than this are one.
SAME = 1e-3  # of ln τ


def joint_error(misfit: Misfit, modes: Modes) -> float:
    """Return √((rms E'² + rms E''²)/2) of the errors of log10 E' and log10 E'', decades."""
    away = misfit.misses(modes)
    return float(np.sqrt(np.mean(away**2))) / math.log(10.0)


def few_modes(misfit: Misfit, number: int) -> Modes:
    """Fit a number of modes whose retardation times are free.

    They start evenly spaced over the measured frequencies, and stay within the limits of `Misfit.ends`.
    """
    low, high = -math.log(misfit.rates[-1]), -math.log(misfit.rates[0])
    ends = np.linspace(low, high, number + 1)
    start = nonnegative_modes(misfit, np.exp(0.5 * (ends[1:] + ends[:-1])))
    return moved_modes(misfit, start)


def moved_modes(misfit: Misfit, start: Modes, *, tidy: bool = True, converged: float = CONVERGED) -> Modes:
    """Refine the compliances and the retardation times of modes near the optimum.

    A mode's compliance begins at no less than a hundredth of 1/|E*| at its frequency.  `tidy` sorts the modes, joins
    those of one time and removes those that have vanished; `converged` is the relative fall of the sum of squares at
    which to stop.
    """
    number = len(start.tau)
    low, high = misfit.ends
    floor = 1e-2 / misfit.size_at(start.tau)
    begin = np.concatenate(
        [[math.log(start.glass)], np.log(np.maximum(start.C, floor)), np.clip(np.log(start.tau), low, high)]
    )

    def unpacked(point: Array) -> tuple[float, Array, Array]:
        glass = max(math.exp(point[0]), misfit.least_glass)
        return glass, np.exp(point[1 : number + 1]), np.exp(np.clip(point[number + 1 :], low, high))

    def residual(point: Array) -> Array:
        glass, C, tau = unpacked(point)
        return misfit.residual(glass + misfit.relaxed(tau) @ C)

    def normal(point: Array, now: Array) -> tuple[Array, Array]:
        glass, C, tau = unpacked(point)
        relaxed = misfit.relaxed(tau)
        modes = relaxed * C
        glasses = np.full((len(relaxed), 1), glass, dtype=relaxed.dtype)
        change = np.concatenate([glasses, modes, misfit.moved(relaxed, C, tau)], 1)
        jacobian = misfit.jacobian(glass + modes.sum(axis=1), change)
        return jacobian.T @ jacobian, jacobian.T @ now

    found = Modes(*unpacked(descend(residual, normal, begin, iterations=ITERATIONS, tolerance=converged)))
    return _tidied(misfit, found) if tidy else found


def _tidied(misfit: Misfit, modes: Modes) -> Modes:
    """Sort modes, join those of one time, and leave out those without compliance."""
    order = np.argsort(modes.tau, kind="stable")
    C, tau = modes.C[order], modes.tau[order]
    groups = np.concatenate([[0], np.cumsum(np.diff(np.log(tau)) > SAME)])
    joined = np.asarray(np.bincount(groups, weights=C), dtype=float)
    tau = np.exp(np.bincount(groups, weights=C * np.log(tau)) / joined)
    keep = joined * misfit.size_at(tau) > NEGLIGIBLE
    return Modes(modes.glass, joined[keep], tau[keep])


def fewest_modes(misfit: Misfit, largest_error: float, most: int) -> Modes:
    """Return the fit of fewest modes whose joint error is not above a given one, or of `most` modes if none is.

    The error falls with the number of modes.  The search begins at one mode per decade, where it falls most steeply,
    steps up or down until the answer is enclosed, and bisects.
    """
    fits: dict[int, Modes] = {}

    def meets(number: int) -> bool:
        fits[number] = few_modes(misfit, number)
        return joint_error(misfit, fits[number]) <= largest_error

    decades = math.log10(misfit.rates[-1] / misfit.rates[0])
    number = min(max(round(decades), 1), most)
    stride = max(1, number // STRIDES)
    low, high = 0, most + 1  # too few, and enough
    while high - low > 1:
        if meets(number):
            high = number
            number = max(high - stride, (low + high) // 2)
        else:
            low = number
            number = min(low + stride, (low + high) // 2)
    return fits[min(high, most)]
