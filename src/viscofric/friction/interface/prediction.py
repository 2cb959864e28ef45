"""Interfacial friction of predicted contacts, beside their hysteresis friction."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.coupling import check_coupling
from viscofric.notes import Note, note_of
from viscofric.rheology.interface.friction import insist_on_interface, interface_friction, interface_notes
from viscofric.units import to_si_array

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.bodies import Layer
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.interface.law import InterfaceLaw
    from viscofric.units import Quantities


def check_interface(interface: object, slip: object) -> None:
    """Raise `InputError` for an interface that is none, and for a slip without an interface."""
    if interface is not None:
        insist_on_interface(interface)
    elif slip is not None:
        raise InputError("slip has a meaning with an interface only; give interface too.", code="interface-needed")


def with_interface(
    curves: FrictionCurves,
    interface: InterfaceLaw,
    slip: Quantities | None = None,
    *,
    poisson_ratio: float = 0.5,
    layer: Layer | None = None,
    rise: Array | None = None,
) -> FrictionCurves:
    """Put the friction of an interface into predicted curves, as their Coulomb friction.

    `slip` is the slip speed (m/s) of all points or of each; the speed of the curves without it (pure sliding).  A note
    tells where the shear would change the contacts, which are solved without it, on a body of this Poisson's ratio.
    `rise` is that of the contacts' temperature (n,), K.
    """
    assert curves.mean_pressure is not None
    assert curves.mean_pressure_error is not None
    speed = curves.speed if slip is None else to_si_array(slip, "m/s", "slip")
    if speed.size not in (1, len(curves)):
        raise InputError(
            f"slip has {speed.size} values: must be one, or one for each of the {len(curves)} points.",
            code="different-lengths",
        )
    speed = np.broadcast_to(speed, curves.speed.shape).copy()
    kelvin = curves.temperature if rise is None else curves.temperature + rise
    friction, error = interface_friction(interface, speed, kelvin, curves.mean_pressure, curves.mean_pressure_error)
    share = friction / (friction + curves.viscoelastic)
    low, high = float(share.min()), float(share.max())
    size = f"{100 * low:.0f} %" if high - low < 0.005 else f"{100 * low:.0f} to {100 * high:.0f} %"
    said = f"The interface makes {size} of the total friction, hysteresis the rest; both are predicted."
    notes = interface_notes(interface, speed, kelvin, curves.mean_pressure)
    rubbed = replace(
        curves,
        coulomb=friction,
        coulomb_error=error,
        coulomb_scatter=np.zeros(len(curves)),
        slip=speed,
        notes=(*curves.notes, *notes, Note("interface-share", said, values={"lowest": low, "highest": high})),
    )
    return replace(rubbed, notes=(*rubbed.notes, *_coupling(rubbed, poisson_ratio, layer)))


def _coupling(curves: FrictionCurves, poisson_ratio: float, layer: Layer | None) -> tuple[Note, ...]:
    """Return a note where the shear of the interface changes the contacts."""
    assert curves.mean_pressure is not None
    if layer is not None and not layer.bonded:
        said = (
            "The shear of the interface also displaces the surface of a layer on a sliding base in the normal "
            "direction, by an amount that is not estimated; contacts are solved without this effect."
        )
        return (Note("tangential-coupling", said),)
    area = curves.load / curves.mean_pressure
    radius = 0.5 * area if curves.load_unit == "N/m" else np.sqrt(area / np.pi)
    thickness = None if layer is None else float(layer.thickness)
    check = check_coupling(curves, poisson_ratio, thickness, [(one, one) for one in radius.tolist()])
    return () if check is None or check.holds else (note_of(check.sentence),)
