"""Rise of temperature of a circular track by the earlier passes of a disc of heat."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import insist_on, numbers
from viscofric.arrays import Array, gauss, unit_nodes
from viscofric.errors import InputError, check_choice
from viscofric.heat.influence import Diffusion
from viscofric.thermal import ThermalProperties
from viscofric.units import Quantity, positive

#: Passes that are summed one by one; an integral from there on errs by 1/(24 n²) of a pass.
_ONE_BY_ONE = 64
#: Gauss's rule on panels of the logarithm of the number of passes.
_NODES, _PANEL = 8, 1.0
_ACROSS = 121
#: Diffusion length over the ring's radius from which on a pass leaves t^-3/2, to 2e-8.
_SPREAD = 1e4


def track_temperature(
    power: Quantity,
    body: ThermalProperties,
    *,
    radius: Quantity,
    track_radius: Quantity,
    speed: Quantity,
    passes: ArrayLike,
    thickness: Quantity | None = None,
    base: Literal["isothermal", "insulated"] = "isothermal",
    distribution: Literal["hertz", "uniform"] = "hertz",
) -> Array:
    """Return the rise of temperature that earlier passes of a disc of heat leave where the next one is.

    Parameters
    ----------
    power : float, str or pint.Quantity
        Heat that the body takes up, W.
    body : ThermalProperties
    radius : float, str or pint.Quantity
        Of the disc, m; small beside the track's.
    track_radius : float, str or pint.Quantity
        Of the circle on which the disc runs, m.
    speed : float, str or pint.Quantity
        Along the track, m/s, above zero.
    passes : (n,) array
        Numbers of earlier passes, from zero on, whole ones, or `math.inf` where there is a steady
        state.
    thickness : float, str or pint.Quantity, optional
        Of the body, m; a half-space without.
    base : {"isothermal", "insulated"}
        Whether the lower side of a body with a thickness stays at its temperature, or passes no heat.
    distribution : {"hertz", "uniform"}
        Of the heat over the disc.

    Returns
    -------
    (n,) array
        Mean rise over the disc, K; that of the present pass is `MovingHeatSource.mean_temperature`.

    Raises
    ------
    InputError
        If a value cannot be used, there is no steady state, or the disc is so slow that passes are no instants:
        2πR v/κ below 100.

    Notes
    -----
    A pass leaves the energy E = power · 2πR/v on a ring, t later, with z = R²/2κt ::

        ΔT = E/(4 ρc (πκt)^(3/2)) exp(−z) I0(z) · mean of exp(−d²/4κt)

    d being the distances across the track from the heat to the points of the disc.  Earlier passes are t = n 2πR/v ago;
    taking each as an instant errs by about 4κ/(2πRv).  The rise grows like the logarithm of n until heat reaches across
    the track, κt ≈ R².  No heat leaves the surface: that which goes to the air makes the rise smaller.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.ThermalProperties("0.3 W/m/K", "1200 kg/m**3", "1500 J/kg/K", "rubber")
    >>> rise = vf.heat.track_temperature(
    ...     "0.1 W", rubber, radius="1 mm", track_radius="23 mm", speed="0.1 m/s", passes=[0, 1, 10, 100, 1000]
    ... )
    >>> rise.round(1)
    array([0. , 0.3, 0.9, 1.7, 2.6])
    """
    from scipy.special import i0e

    insist_on(body, "body", ThermalProperties)
    heat, size = positive(power, "W", "power"), positive(radius, "m", "radius")
    ring, velocity = positive(track_radius, "m", "track_radius"), positive(speed, "m/s", "speed")
    thick = math.inf if thickness is None else positive(thickness, "m", "thickness")
    check_choice(base, "base", "isothermal", "insulated")
    check_choice(distribution, "distribution", "hertz", "uniform")
    count = np.atleast_1d(numbers(passes, "passes", infinite=True))
    if count.ndim != 1 or not np.all((count >= 0.0) & (np.isinf(count) | (count == np.floor(count)))):
        raise InputError("passes must be a row of whole numbers from zero on, or math.inf.", code="out-of-range")
    if size > 0.2 * ring or velocity * 2.0 * math.pi * ring < 100.0 * body.diffusivity:
        raise InputError(
            f"radius = {size:g} m, track_radius = {ring:g} m, speed = {velocity:g} m/s: the track's radius must be at "
            "least 5 times the disc's, and its length times the speed 100 times the diffusivity.",
            code="out-of-range",
        )
    endless = math.inf if np.isinf(count).any() else 1.0
    diffusion = Diffusion(body, 0.0, endless, thick, base == "insulated")  # refuses what warms without end
    period = 2.0 * math.pi * ring / velocity
    distance, common = _across(distribution == "hertz")

    def left(n: Array) -> Array:
        """Return what a pass leaves after n others, over E/(ρc R³): that of a ring of heat, less across the track."""
        length = np.sqrt(4.0 * body.diffusivity * period * n)
        near = np.exp(-np.square(size * distance / length[:, None])) @ common
        on_ring = 2.0 / (math.pi**1.5 * (length / ring) ** 3) * i0e(2.0 / (length / ring) ** 2)
        return np.asarray(diffusion.images(length) * on_ring * near)

    last = max(_ONE_BY_ONE, _SPREAD**2 * ring**2 / (4.0 * body.diffusivity * period))
    return heat * period / (body.volume_heat * ring**3) * _summed(left, count, last)


@lru_cache(maxsize=2)
def _across(hertz: bool) -> tuple[Array, Array]:
    """Return distances across the track (n,), in radii, and weights: how much of the heat is so far from the disc."""
    node = unit_nodes(_ACROSS)
    distance = 2.0 * node.place
    length = 2.0 * node.rest  # of the overlap of [−1, 1] and [d − 1, d + 1]
    inside = length * node.place[:, None]  # from y = d − 1
    from_edge = distance + inside  # 1 + y
    disc = (2.0 / math.pi) * np.sqrt(np.maximum(inside * (2.0 - inside), 0.0))
    square = np.maximum(from_edge * (length * node.rest[:, None]), 0.0)  # 1 − y²
    heat = 0.75 * square if hertz else (2.0 / math.pi) * np.sqrt(square)
    return distance, 4.0 * node.weight * length * (node.weight @ (heat * disc))


def _summed(left: Callable[[Array], Array], count: Array, last: float) -> Array:
    """Return the sums of left(n) from 1 to each count; it falls as n^-3/2 from the last n on."""
    first = np.concatenate([[0.0], np.cumsum(left(np.arange(1.0, _ONE_BY_ONE + 1.0)))])
    found = first[np.minimum(count, _ONE_BY_ONE).astype(int)]
    start = math.log(_ONE_BY_ONE + 0.5)
    ends = np.log(np.where(np.isinf(count), last, count) + 0.5)
    edges = np.unique(
        np.concatenate([[start], ends[ends > start], np.arange(start, max(float(ends.max()), start), _PANEL)])
    )
    place, weight = gauss(_NODES, edges)
    n = np.exp(place)
    parts = (weight * n * left(n)).reshape(-1, _NODES)
    later = np.concatenate([[0.0], np.cumsum(parts.sum(axis=1))])
    found = found + later[np.maximum(np.searchsorted(edges, ends), 0)] * (ends > start)
    return np.asarray(np.where(np.isinf(count), found + 2.0 * last * left(np.array([last])), found))
