"""Whether measured friction can be that of a rubber at all: it must change, and not fall faster than 1/v."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.notes import Note
from viscofric.units import celsius

if TYPE_CHECKING:
    from viscofric.friction.curves import FrictionCurves

#: The power μFv that is lost in a linear rubber does not fall as it is deformed faster, to first order in the loss:
#: waves of frequency ω lose ω²τ/(1 + ω²τ²) in a mode, and a contact that becomes smaller presses harder.
STEEPEST = -1.0
#: A line must be steeper than that by so many of its standard errors.
SURE = 4.0
#: Friction whose differences chance makes at least as often may be constant.
CHANCE = 0.01
_FEWEST = 3


def implausible(curves: FrictionCurves) -> tuple[Note, ...]:
    """Say what of friction curves no rubber does: notes "too-steep" and "constant-friction".

    Parameters
    ----------
    curves : FrictionCurves
        At one load; points of unknown error, or not above zero, are passed over.
    """
    known = np.isfinite(curves.viscoelastic_error) & (curves.viscoelastic > 0.0)
    return (*_too_steep(curves.select(known)), *_constant(curves.select(known)))


def _too_steep(curves: FrictionCurves) -> tuple[Note, ...]:
    steepest, where = np.inf, ""
    for kelvin in curves.temperatures:
        mine = curves.select(curves.temperature == kelvin)
        x = np.log(mine.speed / np.exp(np.log(mine.speed).mean()))
        if len(mine) < _FEWEST or not np.any(x):
            continue
        y = np.log(mine.viscoelastic)
        slope = float(x @ y / (x @ x))
        left = y - y.mean() - slope * x
        own = mine.viscoelastic_error / mine.viscoelastic
        error = np.sqrt(max(left @ left / (len(mine) - 2), float(np.mean(own**2))) / (x @ x))
        if slope + SURE * error < min(STEEPEST, steepest):
            steepest, where = slope, f"{celsius(float(kelvin)):z.1f} °C"
    if not np.isfinite(steepest):
        return ()
    said = (
        f"Friction at {where} goes as v to the power {steepest:.2g}: faster than 1/v that of a linear rubber never "
        "falls, because the power lost in it would fall as it is deformed faster; check speeds, forces and lubrication."
    )
    return (Note("too-steep", said),)


def _constant(curves: FrictionCurves) -> tuple[Note, ...]:
    from scipy.special import chdtrc

    error = curves.viscoelastic_error
    if len(curves) <= _FEWEST or not np.any(error > 0.0):
        return ()
    weight = 1.0 / np.maximum(error, 1e-3 * error.max()) ** 2
    away = curves.viscoelastic - np.average(curves.viscoelastic, weights=weight)
    if chdtrc(len(curves) - 1, float(weight @ away**2)) < CHANCE:
        return ()
    said = (
        f"Friction of all {len(curves)} points is the same within its errors: so is Coulomb friction, and nothing "
        "tells that it comes from the rubber's loss; measure over more speeds and temperatures, or separate the two."
    )
    return (Note("constant-friction", said),)
