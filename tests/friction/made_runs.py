"""Traction runs made from planted coefficients, and friction curves made from a planted master curve."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.curves import FrictionCurves
from viscofric.traction import TractionRuns

#: (sgn u_disc, sgn(u_disc − u_ball)) of the four configurations I, II, III, IV of the paper.
FOUR = ((-1, 1), (-1, -1), (1, -1), (1, 1))


def traction_runs(
    *,
    viscoelastic: Callable[[float, float], float],
    coulomb: float = 0.05,
    offset: float = 0.3,
    speeds: Sequence[float] = (0.02, 0.1, 0.2),
    temperatures: Sequence[float] = (303.15, 333.15),
    slip_ratio: float = 0.2,
    configurations: Sequence[tuple[int, int]] = FOUR,
    replicates: int = 2,
    load: float = 25.0,
    load_jitter: float = 0.01,
    speed_jitter: float = 0.0,
    temperature_jitter: float = 0.0,
    noise: float = 0.0,
    seed: int = 1,
) -> TractionRuns:
    """Make forces O + F_N [μ_c sgn(u_disc − u_ball) + μ_v sgn(u_disc)], own loads, plus noise (N)."""
    random = np.random.default_rng(seed)
    rows = []
    for temperature, speed, (disc_sign, slip_sign), replicate in product(
        temperatures, speeds, configurations, range(1, replicates + 1)
    ):
        normal = load * (1.0 + load_jitter * random.standard_normal())
        force = offset + normal * (coulomb * slip_sign + viscoelastic(speed, temperature) * disc_sign)
        disc = disc_sign * speed
        ball = disc - slip_sign * slip_ratio * speed
        rows.append(
            (
                disc * (1.0 + speed_jitter * random.standard_normal()),
                ball * (1.0 + speed_jitter * random.standard_normal()),
                force + noise * random.standard_normal(),
                normal,
                temperature + temperature_jitter * random.standard_normal(),
                replicate,
            )
        )
    return runs_from(np.array(rows))


def runs_from(rows: Array) -> TractionRuns:
    """Rows of disc speed, ball speed, force, load, temperature and replicate."""
    return TractionRuns(*(rows[:, column] for column in range(5)), replicate=rows[:, 5].astype(int))


def rows_of(runs: TractionRuns) -> Array:
    return np.column_stack(
        [
            runs.disc_speed,
            runs.ball_speed,
            runs.traction_force,
            runs.load,
            runs.temperature,
            runs.replicate,
        ]
    )


def friction_curves(
    speed: Array,
    temperature: Array,
    viscoelastic: Array,
    *,
    error: float | Array = 0.0,
    load: float | Array = 25.0,
) -> FrictionCurves:
    count = len(speed)
    return FrictionCurves(
        speed=speed,
        temperature=temperature,
        load=np.broadcast_to(load, (count,)),
        viscoelastic=viscoelastic,
        viscoelastic_error=np.broadcast_to(error, (count,)),
        viscoelastic_scatter=np.zeros(count),
        replicates=np.ones(count, dtype=int),
    )


def exported_runs(
    *,
    viscoelastic: Callable[[float], float] = lambda v: 0.03,
    coulomb: float = 0.05,
    offset: Callable[[float], float] = lambda t: 0.3,
    zero_noise: float = 0.0,
    noise: float = 0.0,
    rolling_speeds: Sequence[float] = (0.02, 0.1),
    slip_ratio: float = 0.2,
    steps: int = 8,
    points: int = 3,
    load: float = 25.0,
    load_jitter: float = 0.01,
    seed: int = 1,
) -> TractionRuns:
    """Make a test as machines export it: slip reversed at a constant mean speed of disc and ball, one direction.

    Each step (one per speed and replicate, replicate after replicate) begins with a recording of the zero, and each
    point of it is two readings of one time, 6 s after those before.  The offset depends on time (s).
    """
    random = np.random.default_rng(seed)
    rows, recorded, times, numbers = [], [], [], []
    for number, (replicate, rolling) in enumerate(product(range(1, steps + 1), rolling_speeds), start=1):
        start = 6.0 * points * (number - 1)
        zero = offset(start) + zero_noise * random.standard_normal()
        for point, sense in product(range(points), (1, -1)):
            time = start + 6.0 * point
            disc, ball = rolling * (1 + 0.5 * sense * slip_ratio), rolling * (1 - 0.5 * sense * slip_ratio)
            normal = load * (1.0 + load_jitter * random.standard_normal())
            force = offset(time) + normal * (viscoelastic(disc) + coulomb * sense) + noise * random.standard_normal()
            rows.append((disc, ball, force, normal, 313.15, replicate))
            recorded.append(zero)
            times.append(time)
            numbers.append(number)
    return replace(
        runs_from(np.array(rows)), zero_force=np.array(recorded), time=np.array(times), step=np.array(numbers)
    )


def timed_sweeps(
    speeds: Array,
    *,
    variation: float = 0.0,
    anew: bool = False,
    runs: int = 3,
    readings: int = 8,
    noise: float = 0.01,
    autocorrelation: float = 0.0,
    configurations: Sequence[tuple[int, int]] = FOUR,
    coulomb: float = 0.045,
    viscoelastic: float = 0.012,
    seed: int = 1,
) -> TractionRuns:
    """Make sweeps over all speeds, one after the other, each in one configuration, in steps of several readings.

    Friction of a run differs from the planted one by `variation` (of itself, Coulomb and viscoelastic by themselves),
    or that of each step where `anew`; readings scatter by `noise` of the Coulomb force, in series of first order.
    """
    random = np.random.default_rng(seed)
    rows = []
    for replicate, (disc_sign, slip_sign) in product(range(1, runs + 1), configurations):
        factors = np.ones((speeds.size, 2)) + variation * random.standard_normal((speeds.size if anew else 1, 2))
        for speed, factor in zip(speeds, factors, strict=True):
            scatter = random.standard_normal(readings)
            for place in range(1, readings):
                fresh = np.sqrt(1.0 - autocorrelation**2) * scatter[place]
                scatter[place] = autocorrelation * scatter[place - 1] + fresh
            force = 0.12 + 25.0 * (factor @ [coulomb * slip_sign, viscoelastic * disc_sign] + noise * coulomb * scatter)
            disc = disc_sign * speed
            rows += [(disc, disc - 0.05 * slip_sign * speed, one, 25.0, 303.15, replicate) for one in force]
    made = runs_from(np.array(rows))
    return replace(made, step=1 + np.arange(len(made)) // readings, time=np.arange(float(len(made))))
