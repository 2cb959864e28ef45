"""Coulomb friction of friction curves: that of a predicted interface, and its effect on viscoelastic friction.

For the latter see `viscofric.contact.coupling`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.bodies import Layer
from viscofric.contact.coupling import LARGEST, REMEDY, ShearedContact, coupling_notes, sheared_compliance
from viscofric.errors import InputError
from viscofric.friction.assumption_check import AssumptionCheck, Place, modes_by_temperature, modes_of, verdict
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note
from viscofric.rheology.interface.friction import insist_on_interface, interface_friction, interface_notes
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.units import Quantities, to_si_array


def shear_notes(
    curves: FrictionCurves,
    coulomb: Array,
    bodies: Sequence[tuple[Material, Layer | None]],
    rise: Array | None = None,
    solved: float = 0.0,
) -> tuple[Note, ...]:
    """Return a note where Coulomb friction (n,) changes predicted friction, solved with another one, by too much."""
    # `bodies` are the material and the layer of each point, `rise` (n,) its temperature above that of the body, K.
    assert curves.mean_pressure is not None
    kelvin = curves.temperature if rise is None else curves.temperature + rise
    area = curves.load / curves.mean_pressure
    radius = 0.5 * area if curves.load_unit == "N/m" else np.sqrt(area / math.pi)
    rows = np.flatnonzero(np.abs(coulomb) != abs(solved)).tolist()
    modes = (modes_of(bodies[row][0], float(kelvin[row])) for row in rows)
    return coupling_notes(
        _sheared(curves, row, float(coulomb[row]), *bodies[row], float(radius[row]), found, solved)
        for row, found in zip(rows, modes, strict=True)
    )


def check_coupling(
    curves: FrictionCurves, material: Material, layer: Layer | None, radii: Sequence[tuple[float, float]]
) -> AssumptionCheck | None:
    """Check the coupling at the worst point, of a radius (m) between two; None if no Coulomb friction is known."""
    if curves.coulomb is None or not np.any(np.isfinite(curves.coulomb)):
        return None
    worst: list[ShearedContact] = []
    modes_at = modes_by_temperature(material)
    for row in np.flatnonzero(np.isfinite(curves.coulomb)).tolist():
        modes, coulomb = modes_at(float(curves.temperature[row])), float(curves.coulomb[row])
        both = (_sheared(curves, row, coulomb, material, layer, one, modes) for one in radii[row])
        found = sorted(both, key=lambda one: one.share)
        if not worst or found[1].share > worst[1].share:
            worst, place = found, Place.of(curves, row)
    low, high = worst[0].share, worst[1].share
    holds = verdict(low, high, LARGEST)
    percent = f"{100 * LARGEST:.0f} %"
    rest = {
        True: f", which is negligible up to {percent}.",
        None: f", which is negligible up to {percent}. Here this depends on the contact size: solve the contact and "
        "give contact_radius.",
        False: f", which is doubtful above {percent}",
    }[holds]
    remedy = None if holds is not False else REMEDY + " Less slip or Coulomb friction (PTFE, lubricant) reduces it."
    values = {"lowest": low, "highest": high, **worst[1].values, **place.values}
    least = "" if low >= 0.98 * high else f" (a change of {100 * low:.2g} % for the other bound of the contact size)"
    said = Note("tangential-coupling", worst[1].said + least + rest, remedy=remedy, values=values)
    return AssumptionCheck.of("uncoupled", holds, said, high, LARGEST)


def _sheared(
    curves: FrictionCurves,
    row: int,
    coulomb: float,
    material: Material,
    layer: Layer | None,
    radius: float,
    modes: RetardationSpectrum,
    solved: float = 0.0,
) -> ShearedContact:
    """Return the contact of a point of curves, of a radius or half-width, m, with the material's modes there."""
    line, ratio = curves.load_unit == "N/m", material.poisson_ratio
    area = 2.0 * radius if line else math.pi * radius**2
    return ShearedContact(
        stress=abs(coulomb) * float(curves.load[row]) / area,
        friction=float(curves.viscoelastic[row]),
        compliance=sheared_compliance(modes, ratio, layer, radius, float(curves.speed[row]), line=line),
        line=line,
        where=str(Place.of(curves, row)),
        solved=abs(solved) * float(curves.load[row]) / area,
    )


def check_interface(interface: object, slip: object) -> None:
    """Raise `InputError` for an interface that is none, and for a slip without an interface."""
    if interface is not None:
        insist_on_interface(interface)
    elif slip is not None:
        raise InputError("slip has a meaning with an interface only; give interface too.", code="interface-needed")


def with_interface(
    curves: FrictionCurves, interface: InterfaceLaw, slip: Quantities | None = None, *, rise: Array | None = None
) -> FrictionCurves:
    """Put the friction of an interface into predicted curves, as their Coulomb friction."""
    # `slip` is the slip speed (m/s) of all points or of each; the speed of the curves without it (pure sliding). `rise`
    # is that of the contacts' temperature (n,), K.
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
