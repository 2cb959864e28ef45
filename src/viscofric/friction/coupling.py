"""Coupling of tangential and normal displacements, by which Coulomb friction changes the pressure.

A wave of shear of unit amplitude moves the surface of a layer of thickness H on a bonded base in normal direction by
X times the displacement of a half-space under a wave of pressure, which moves the layer's by Θ (see
`viscofric.contact.bodies`).
With Q = qH and κ = 3 − 4ν, by the same equations ::

    X = [2κ(κ−1)/(κ+1) (cosh 2Q − 1) − 8Q²/(κ+1)] / [2κ cosh 2Q + 1 + κ² + 4Q²]

which becomes (1−2ν)/(2(1−ν)) on the half-space (K. L. Johnson, Contact Mechanics (1985), section 7.2), and does not
vanish with ν = ½ on a layer (N. Menga, G. Carbone, D. Dini, J. Mech. Phys. Solids 148 (2021) 104273).  The coupling of
a contact is the mean of |X| over that of Θ, with the weights of the surface slopes under Hertz's pressure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.bodies import Layer
from viscofric.friction.assumption_check import AssumptionCheck, Place, verdict
from viscofric.notes import Note

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.friction.assumption_check import ContactSize
    from viscofric.friction.curves import FrictionCurves


#: Largest acceptable displacement by shear, over that by pressure: that of ν = 0.49 under μ_c = 1.
LARGEST = 0.02
# Wave numbers times the contact's radius, over the whole spectrum of the pressure.
_WAVES = np.exp(np.arange(-5.0, 5.0, 0.05))
_DEEP = 20.0  # qH from which on a layer is a half-space to 1e-15


def coupling(poisson_ratio: float, thickness: float | None = None) -> float:
    """Return the normal displacement of a contact's surface by Coulomb friction 1, over that by its pressure.

    `thickness` is that of a layer on a bonded base, over the contact's radius; None for a half-space.
    """
    kappa = 3.0 - 4.0 * poisson_ratio
    if thickness is None:
        return (kappa - 1.0) / (kappa + 1.0)
    depth = np.minimum(_WAVES * thickness, _DEEP)
    above = 2.0 * kappa * (kappa - 1.0) * (np.cosh(2.0 * depth) - 1.0) - 8.0 * depth**2
    below = (kappa + 1.0) * (2.0 * kappa * np.cosh(2.0 * depth) + 1.0 + kappa**2 + 4.0 * depth**2)
    pressure = 3.0 * (np.sin(_WAVES) - _WAVES * np.cos(_WAVES)) / _WAVES**3
    weight = (_WAVES * pressure) ** 2  # q |p̂|² dq, in equal steps of ln q
    yielding = Layer(thickness).yielding(_WAVES, poisson_ratio)
    return float(weight @ np.abs(above / below)) / float(weight @ yielding)


def check_coupling(
    curves: FrictionCurves, poisson_ratio: float, thickness: float | None = None, sizes: Sequence[ContactSize] = ()
) -> AssumptionCheck | None:
    """Check the coupling at the worst point of friction curves of known Coulomb friction; None if none is known.

    `thickness` is that of the rubber, m (a half-space without it), compared with the sizes of the contacts.
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
            row: [
                rubbed[row] * coupling(poisson_ratio, thickness / a) for a in (sizes[row].smallest, sizes[row].largest)
            ]
            for row in known.tolist()
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
        f"Contacts are solved without this effect, "
    )
    said += {
        True: f"which is negligible up to {LARGEST:g}.",
        None: f"which is negligible up to {LARGEST:g}. Here this depends on the contact size: solve the contact and "
        "give contact_radius.",
        False: f"which is doubtful above {LARGEST:g}: viscoelastic friction may change by a fraction of that order, "
        "and with the direction of slip; reduce slip or Coulomb friction (PTFE, lubricant), or use thicker rubber.",
    }[holds]
    values = {"coulomb": float(rubbed[row]), "lowest": low, "highest": high, **place.values}
    return AssumptionCheck.of("uncoupled", holds, Note("tangential-coupling", said, values=values), high, LARGEST)
