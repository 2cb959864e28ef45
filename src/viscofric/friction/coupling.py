"""Coupling of tangential and normal displacements, by which Coulomb friction changes the pressure.

A wave of shear moves the surface in normal direction by X times, and a wave of pressure by Θ times what the latter
moves a half-space by (see `viscofric.contact.bodies`).  The coupling of a contact is the mean of |X| over that of Θ,
weighted by the surface slopes under Hertz's pressure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.bodies import Layer, half_space_coupling
from viscofric.friction.assumption_check import AssumptionCheck, Place, verdict
from viscofric.notes import Note

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.friction.curves import FrictionCurves


#: Largest acceptable displacement by shear, over that by pressure: that of ν = 0.49 under μ_c = 1.
LARGEST = 0.02
# Wave numbers times the contact's radius, over the whole spectrum of the pressure.
_WAVES = np.exp(np.arange(-5.0, 5.0, 0.05))


def coupling(poisson_ratio: float, thickness: float | None = None) -> float:
    """Return the normal displacement of a contact's surface by Coulomb friction 1, over that by its pressure.

    `thickness` is that of a layer on a bonded base, over the contact's radius; None for a half-space.
    """
    if thickness is None:
        return half_space_coupling(poisson_ratio)
    layer = Layer(thickness)
    pressure = 3.0 * (np.sin(_WAVES) - _WAVES * np.cos(_WAVES)) / _WAVES**3
    weight = (_WAVES * pressure) ** 2  # q |p̂|² dq, in equal steps of ln q
    sheared, pressed = layer.coupling(_WAVES, poisson_ratio), layer.yielding(_WAVES, poisson_ratio)
    return float(weight @ np.abs(sheared)) / float(weight @ pressed)


def check_coupling(
    curves: FrictionCurves,
    poisson_ratio: float,
    thickness: float | None = None,
    radii: Sequence[tuple[float, float]] = (),
) -> AssumptionCheck | None:
    """Check the coupling at the worst point of friction curves of known Coulomb friction; None if none is known.

    `thickness` is that of the rubber, m (a half-space without it), compared with the smallest and the
    largest possible radius of each contact.
    """
    if curves.coulomb is None or not np.any(np.isfinite(curves.coulomb)):
        return None
    known = np.flatnonzero(np.isfinite(curves.coulomb))
    rubbed = np.abs(curves.coulomb)
    if thickness is None:
        row = int(known[np.argmax(rubbed[known])])
        low = high = float(rubbed[row]) * coupling(poisson_ratio)
    else:
        each = {
            row: [rubbed[row] * coupling(poisson_ratio, thickness / a) for a in radii[row]] for row in known.tolist()
        }
        row = max(each, key=lambda one: max(each[one]))
        low, high = sorted(float(one) for one in each[row])
    holds = verdict(low, high, LARGEST)
    place = Place.of(curves, row)
    size = f"{high:.2g}" if f"{low:.2g}" == f"{high:.2g}" else f"{low:.2g} to {high:.2g}"
    on = "a half-space" if thickness is None else f"a bonded layer of {1e3 * thickness:.3g} mm"
    said = (
        f"Coulomb friction of {rubbed[row]:.2g} also displaces the surface of {on} (ν = {poisson_ratio:g}) in the "
        f"normal direction, by about {size} of the displacement due to the pressure ({place}). "
        "The contacts were solved without this effect, "
    )
    said += {
        True: f"which is negligible up to {LARGEST:g}.",
        None: f"which is negligible up to {LARGEST:g}. Here this depends on the contact size: solve the contact and "
        "give contact_radius.",
        False: f"which is doubtful above {LARGEST:g}: viscoelastic friction may change by a fraction of that order, "
        "and with the direction of slip; solve the contacts with it (coulomb=…), reduce slip or Coulomb friction "
        "(PTFE, lubricant), or use thicker rubber.",
    }[holds]
    values = {"coulomb": float(rubbed[row]), "lowest": low, "highest": high, **place.values}
    return AssumptionCheck.of("uncoupled", holds, Note("tangential-coupling", said, values=values), high, LARGEST)
