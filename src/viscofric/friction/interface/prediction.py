"""Interfacial friction of predicted contacts, beside their hysteresis friction."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.rheology.interface.friction import insist_on_interface, interface_friction, interface_notes
from viscofric.units import to_si_array

if TYPE_CHECKING:
    from viscofric.arrays import Array
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
    rise: Array | None = None,
) -> FrictionCurves:
    """Put the friction of an interface into predicted curves, as their Coulomb friction.

    `slip` is the slip speed (m/s) of all points or of each; the speed of the curves without it (pure sliding).  `rise`
    is that of the contacts' temperature (n,), K.
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
    return replace(
        curves,
        coulomb=friction,
        coulomb_error=error,
        coulomb_scatter=np.zeros(len(curves)),
        slip=speed,
        notes=(*curves.notes, *notes, Note("interface-share", said, values={"lowest": low, "highest": high})),
    )
