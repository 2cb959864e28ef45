"""Friction between the temperatures that were asked for: along Eq. 10, by the shift factors, not straight across."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.report.results import group, rubbers, values

if TYPE_CHECKING:
    import xarray as xr

    from viscofric.arrays import Array


_ROWS = 120  # of a map, about
# So far beyond the temperatures at which the shift factor is known, it goes on straight over 1/T: enough for a picture.
_BEYOND = 50.0  # K


def known_shifts(tree: xr.DataTree) -> list[tuple[Array, Array] | None]:
    """Return temperature (K, ascending) and log10 of the shift factor of each rubber; None where it is not known."""
    return [_known_shift(branch) for _, branch in rubbers(tree) or [("", tree)]]


def _known_shift(tree: xr.DataTree) -> tuple[Array, Array] | None:
    factors, law = group(tree, "shift_factors"), group(tree, "shift_law")
    measured = factors is not None and str(factors.attrs.get("shift_used", "measured")) == "measured"
    found = factors if measured or law is None else law
    if found is None:
        return None
    kelvin, log = values(found, "temperature"), values(found, "log10_shift_factor")
    order = np.argsort(kelvin)
    return (kelvin[order], log[order]) if len(kelvin) > 1 else None


def filled_in(
    speed: Array, temperature: Array, friction: Array, shift: tuple[Array, Array] | None
) -> tuple[Array, Array]:
    """Return friction at many temperatures from friction at some.

    Parameters
    ----------
    speed : (n,) array
        m/s, ascending.
    temperature : (m,) array
        K, ascending.
    friction : (m, n) array
        NaN where a case was not solved.
    shift : ((k,) array, (k,) array) or None
        Temperatures (K) and log10 of the shift factor; None where it is not known.

    Returns
    -------
    temperature : (M,) array
        Those given among them, or these alone where nothing is known in between.
    friction : (M, n) array

    Notes
    -----
    μ(v, T) = μ(α(T) v, T₀): between two temperatures, each of the two curves is moved along log v by its own
    difference of log α, and the two are weighed by how near they are in 1/T.  Where one of them ends, the other serves.
    Log α is straight over 1/T between the temperatures at which it is known.
    """
    if shift is None or temperature[0] < shift[0][0] - _BEYOND or temperature[-1] > shift[0][-1] + _BEYOND:
        return temperature, friction
    logarithm = np.log(speed)

    def moved(row: int, kelvin: float) -> Array:
        step = np.log(10.0) * (_log_shift(shift, kelvin) - _log_shift(shift, float(temperature[row])))
        found: Array = np.interp(logarithm + step, logarithm, friction[row], left=np.nan, right=np.nan)
        return found

    between = max(1, round(_ROWS / (len(temperature) - 1)))
    kelvins, rows = [float(temperature[0])], [friction[0]]
    for lower in range(len(temperature) - 1):
        cold, warm = float(temperature[lower]), float(temperature[lower + 1])
        for part in range(1, between + 1):
            kelvin = cold + part * (warm - cold) / between
            weight = (1.0 / cold - 1.0 / kelvin) / (1.0 / cold - 1.0 / warm)
            first, second = moved(lower, kelvin), moved(lower + 1, kelvin)
            straight = (1.0 - weight) * friction[lower] + weight * friction[lower + 1]
            mixed = (1.0 - weight) * first + weight * second
            whole = np.where(np.isfinite(first), np.where(np.isfinite(second), mixed, first), second)
            whole = np.where(np.isfinite(whole), whole, straight)
            failed = ~np.isfinite(friction[lower + (weight > 0.5)])
            kelvins.append(kelvin)
            rows.append(np.where(failed, np.nan, whole) if part < between else friction[lower + 1])
    return np.array(kelvins), np.array(rows)


def _log_shift(shift: tuple[Array, Array], kelvin: float) -> float:
    at, log = -1.0 / shift[0], shift[1]
    end = 0 if kelvin < shift[0][0] else -2 if kelvin > shift[0][-1] else None
    if end is None:
        return float(np.interp(-1.0 / kelvin, at, log))
    slope = (log[end + 1] - log[end]) / (at[end + 1] - at[end])
    return float(log[end] + slope * (-1.0 / kelvin - at[end]))
