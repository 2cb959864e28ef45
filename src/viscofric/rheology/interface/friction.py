"""Friction of an interface on contacts of known mean pressure: μ = τ_s/p, with its error and its doubts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.errors import InputError
from viscofric.heat.heating import Heating
from viscofric.notes import Note
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.rheology.shifts.shift_law import LN10

#: Within this factor pressures are those of the fit.
SAME_PRESSURE = 1.5
#: Error estimates of solved contacts are limits that nearly all contacts keep: taken as ends of 95 % intervals, this
#: part of them is a standard error.
OF_LIMIT = 1.0 / LEVEL_95


def insist_on_interface(given: object) -> None:
    """Raise `InputError` for anything else than a law of shear stress."""
    right = "a law of shear stress, such as GaussianShearStress or what ShearStress.law() gives"
    insist_on(given, "interface", InterfaceLaw, right=right)


def check_interface_heat(heating: Heating, interface: object, slip: object = None) -> None:
    """Raise InputError where the Coulomb heat of a contact would follow from two laws."""
    if interface is not None and (heating.coulomb != 0.0 or slip is not None):
        raise InputError(
            "heating: with an interface, its shear stress makes the Coulomb heat, and the slip is that of the Heating; "
            "leave out coulomb of the Heating, and slip.",
            code="not-with-heating",
        )


def total_friction(hysteresis: Array, interface: Array | None, give: str) -> Array:
    """Return both parts of a friction coefficient together; InputError without an interface: `give` is the remedy."""
    if interface is None:
        raise InputError(f"there is no interfacial friction; give {give}.", code="no-interface")
    return hysteresis + interface


def total_error(*parts: Array | None) -> Array | None:
    """Return the standard error of a friction coefficient from those of its parts; None where one is not known."""
    known = [part for part in parts if part is not None]
    return np.sqrt(np.sum(np.square(known), axis=0)) if len(known) == len(parts) else None


def interface_friction(
    law: InterfaceLaw, speed: Array, kelvin: Array | None, pressure: Array, pressure_error: Array
) -> tuple[Array, Array]:
    """Return μ = τ_s(v, T)/p and its standard error at slip speeds, m/s, and mean pressures, Pa, of one shape."""
    # `pressure_error` is the error estimate of solved contacts. The error of a law of unknown uncertainty is that of
    # the pressure alone.
    friction = np.asarray(law(speed, kelvin)) / pressure
    relative = OF_LIMIT * pressure_error / pressure
    if law.has_standard_error:
        relative = np.hypot(relative, LN10 * np.asarray(law.standard_error(speed, kelvin)))
    return friction, friction * relative


def interface_notes(law: InterfaceLaw, speed: Array, kelvin: Array | None, pressure: Array) -> Iterator[Note]:
    """Yield how the friction of an interface was found, and where its law is used outside its fit."""
    how = "fitted to measured stress" if law.fitted_speeds is not None else "as given"
    said = f"Interfacial friction is shear stress times solved contact area over load; law of the stress, {how}: {law}."
    yield Note("interface-law", said)
    if not law.has_standard_error:
        said = "The uncertainty of the law of shear stress is not known, nor included."
        yield Note("interface-without-error", said)
    outside = np.broadcast_to(law.extrapolates(speed, kelvin), pressure.shape)
    count = int(np.count_nonzero(outside))
    if count:
        said = (
            f"At {count} of {outside.size} points the reduced slip speed or the temperature lies outside those at "
            "which shear stress was measured; there the stress rests on the form of the law."
        )
        yield Note("interface-extrapolated", said, values={"points": count})
    if law.fitted_pressures is None:
        return
    (low, high), lowest, highest = law.fitted_pressures, float(pressure.min()), float(pressure.max())
    if lowest * SAME_PRESSURE < low or highest > SAME_PRESSURE * high:
        said = (
            f"Shear stress was measured at mean contact pressures of {1e-6 * low:.2g} to {1e-6 * high:.2g} MPa and "
            f"is used at {1e-6 * lowest:.2g} to {1e-6 * highest:.2g} MPa, as if it did not depend on pressure."
        )
        yield Note("interface-pressure", said, values={"lowest": lowest, "highest": highest})


def friction_on_area(law: InterfaceLaw, speed: Array, kelvin: Array, pressure: float, area: Array) -> dict[str, Any]:
    """Return friction, standard error and notes on parts (m, n, k) of the area at n speeds, NaN without temperature."""
    v = np.broadcast_to(speed[None, :, None], area.shape)
    T = kelvin if np.all(np.isfinite(kelvin)) else None
    local = pressure / area
    friction, error = interface_friction(law, v, T, local, np.zeros(area.shape))
    notes = tuple(interface_notes(law, v, T, local))
    return {"interface_friction": friction, "interface_error": error, "notes": notes}
