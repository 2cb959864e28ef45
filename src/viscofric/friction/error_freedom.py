"""How well the standard errors of measured friction are known: degrees of freedom, given or seen in their scatter."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.notes import Note

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.curves import FrictionCurves


#: Fewer second differences than these tell no scatter.
FEWEST = 6
#: Errors that are smaller than this are those of solved contacts, not of a measurement: nobody averaged them.
SOLVED = 1e-3
#: So many times the scatter of neighbours, that of all holds a course of the errors.
COURSE = 2.0
#: Errors that scatter no more than those of so many degrees of freedom are taken for known.
MANY = 60.0


def error_freedom(curves: FrictionCurves) -> tuple[Array, tuple[Note, ...]]:
    """Return the degrees of freedom behind the standard errors of viscoelastic friction, (n,), and a note if inferred.

    As given; else one less than the replicates; and where neither is given, from how the errors scatter from one speed
    to the next: ln s² of f degrees of freedom scatters by ψ′(f/2), and a smooth course of the errors has no second
    differences.  Infinite where the errors are known, or nothing says that they are not.

    Parameters
    ----------
    curves : FrictionCurves
    """
    if curves.viscoelastic_freedom is not None:
        return np.maximum(curves.viscoelastic_freedom, 1.0), ()
    freedom = np.where(curves.replicates > 1, curves.replicates - 1.0, np.inf)
    relative = curves.viscoelastic_error / np.maximum(np.abs(curves.viscoelastic), np.finfo(float).tiny)
    asked = np.isinf(freedom) & np.isfinite(relative) & (relative > 0.0)
    squares, count = 0.0, 0
    for temperature in np.unique(curves.temperature[asked]):
        rows = np.flatnonzero(asked & (curves.temperature == temperature))
        bent = np.diff(np.log(relative[rows[np.argsort(curves.speed[rows], kind="stable")]] ** 2), 2)
        squares, count = squares + float(bent @ bent), count + bent.size
    if count < FEWEST or np.median(relative[asked]) < SOLVED:
        return freedom, ()
    rough = squares / (6.0 * count)  # 1 + 4 + 1 variances in each
    # Where no course is seen beside the scatter, the scatter of all tells it better than that of neighbours.
    everything = float(np.var(np.log(relative[asked] ** 2), ddof=1))
    seen = freedom_of_scatter(everything if everything < COURSE * rough else rough)
    if seen > MANY:
        return freedom, ()
    note = Note(
        "inferred-freedom",
        f"The standard errors of friction scatter from one speed to the next as those of {seen + 1.0:.0f} replicates "
        "do, whose number was not given: they are taken for that uncertain, and neighbours moderate them; give the "
        "replicates, or degrees of freedom.",
    )
    return np.where(asked, seen, freedom), (note,)


def freedom_of_scatter(variance: float) -> float:
    """Return the degrees of freedom f whose sample variances scatter so much: ψ′(f/2) is the variance of ln s²."""
    from scipy.optimize import brentq
    from scipy.special import polygamma

    least, most = 0.5, 0.5 * MANY
    if variance <= polygamma(1, most):
        return np.inf
    if variance >= polygamma(1, least):
        return 2.0 * least
    return 2.0 * float(brentq(lambda half: float(polygamma(1, half)) - variance, least, most))
