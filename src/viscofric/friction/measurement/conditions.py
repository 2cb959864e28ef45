"""Which readings of a traction test belong together: equal temperature, load, speed and slip."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.nominal import SAME_LOAD, clusters
from viscofric.units import celsius

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.data import TractionRuns

    Array: TypeAlias = NDArray[np.float64]
    Labels: TypeAlias = NDArray[np.int64]

# Slip over speed below which a ball rolls, however still the speeds are.
_PURE_ROLLING = 1e-3


@dataclass(frozen=True, eq=False)
class Condition:
    """The readings taken at one temperature, load, magnitude of the disc's speed and magnitude of the slip.

    Attributes
    ----------
    rows : (n,) array of int
        Rows of the traction runs.
    temperature, speed : float
        Means over all readings of that nominal temperature (K) and of that nominal speed (m/s).
    load, slip : float
        Means over the condition, N and m/s.
    disc_sign, slip_sign : (n,) array
        sgn(u_disc) = ±1 and sgn(u_disc − u_ball) = ±1, or 0 in pure rolling.
    """

    rows: Labels
    temperature: float
    speed: float
    load: float
    slip: float
    disc_sign: Array
    slip_sign: Array

    def __str__(self) -> str:
        return f"{celsius(self.temperature):z.1f} °C and {1e3 * self.speed:.4g} mm/s"

    @property
    def configurations(self) -> Labels:
        """Number of the sign configuration of each reading."""
        return np.asarray(3 * self.disc_sign + self.slip_sign, dtype=np.int64)


def conditions(
    runs: TractionRuns, speed_tolerance: float, temperature_tolerance: float
) -> tuple[list[Condition], tuple[str, ...]]:
    """Group the readings of a traction test by their measured temperature, load, speed and slip.

    Values are sorted, and a gap wider than the tolerance starts the next nominal value.  The tolerance of the
    slip ratio follows the measured jitter of the speeds, since slip is a small difference of two of them: it
    is three standard deviations of that difference, though not below a tenth of the speeds' tolerance.  Slip
    that cannot be told from zero by this is pure rolling.

    Parameters
    ----------
    runs : TractionRuns
        All disc speeds other than zero are used.
    speed_tolerance : float
        Of speeds, relative; that of loads is 5 %.
    temperature_tolerance : float
        K.

    Returns
    -------
    list of Condition
        By temperature, load, speed and slip.
    tuple of str
        Notes on what was left out or taken for pure rolling.

    Raises
    ------
    InputError
        If neighbouring values are too close to tell nominal values from each other.
    """
    moving = np.flatnonzero(runs.disc_speed != 0.0)
    notes = []
    if moving.size < len(runs):
        notes.append(
            f"{len(runs) - moving.size} of {len(runs)} readings were taken with the disc at rest and left out."
        )
    if not moving.size:
        return [], tuple(notes)
    temperature, speed, load = runs.temperature[moving], np.abs(runs.disc_speed[moving]), runs.load[moving]
    isotherm = clusters(
        temperature,
        np.full(temperature.size, temperature_tolerance),
        lambda low, high: f"temperature from {celsius(low):z.1f} to {celsius(high):z.1f} °C",
    )
    loading = clusters(load, SAME_LOAD * load, lambda low, high: f"load from {low:.4g} to {high:.4g} N")
    pace = clusters(
        speed,
        speed_tolerance * speed,
        lambda low, high: f"disc_speed from {1e3 * low:.4g} to {1e3 * high:.4g} mm/s",
    )
    means = np.bincount(pace, speed) / np.bincount(pace)
    jitter = float(np.std(speed / means[pace]))
    resolution = max(0.1 * speed_tolerance, 3.0 * math.sqrt(2.0) * jitter)
    slip = runs.disc_speed[moving] - runs.ball_speed[moving]
    found = []
    for key in np.unique(np.stack([isotherm, loading, pace], axis=1), axis=0):
        here = np.flatnonzero((isotherm == key[0]) & (loading == key[1]) & (pace == key[2]))
        disc_sign = np.sign(runs.disc_speed[moving][here])
        ratio = slip[here] / runs.disc_speed[moving][here]
        direction, sliding = _slips(ratio, speed_tolerance, resolution)
        for number in np.unique(sliding):
            these = sliding == number
            rows = here[these]
            found.append(
                Condition(
                    rows=moving[rows],
                    temperature=float(temperature[isotherm == key[0]].mean()),
                    speed=float(means[key[2]]),
                    load=float(load[rows].mean()),
                    slip=float(np.abs(slip[rows]).mean()),
                    disc_sign=disc_sign[these],
                    slip_sign=disc_sign[these] * direction[these],
                )
            )
    rolling = [one for one in found if not np.any(one.slip_sign) and one.slip > 0.0]
    if rolling:
        notes.append(
            f"{where(rolling, len(found))} the slip ({1e3 * rolling[0].slip:.2g} mm/s) cannot be told from "
            "none and is taken for pure rolling."
        )
    return found, tuple(notes)


def where(some: list[Condition], total: int) -> str:
    """Say at which conditions, as the beginning of a sentence: all that matters of a long list."""
    if len(some) == 1:
        return f"At {some[0]}"
    return f"At {len(some)} of {total} conditions, the first being {some[0]},"


def _slips(ratio: Array, tolerance: float, resolution: float) -> tuple[Array, Labels]:
    """Find the sense of sliding (along the disc's motion, ±1 or 0) and number the magnitudes of slip."""

    def numbered(values: Array) -> Labels:
        return clusters(
            values,
            np.maximum(tolerance * np.abs(values), resolution),
            lambda low, high: f"slip from {100 * low:.3g} to {100 * high:.3g} % of the disc's speed",
        )

    signed = numbered(ratio)
    direction, magnitude = np.empty(ratio.size), np.empty(ratio.size)
    for number in np.unique(signed):
        members = signed == number
        mean = ratio[members].mean()
        rolls = ratio[members].min() < 0.0 < ratio[members].max() or abs(mean) < _PURE_ROLLING
        direction[members], magnitude[members] = (0.0, 0.0) if rolls else (np.sign(mean), abs(mean))
    # Rolling stays apart from sliding, however slow.
    return direction, np.where(direction == 0.0, 0, numbered(magnitude) + 1)
