"""What the results of a study say of its setting as a whole: indenter, load, accuracy, seed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from viscofric.study.surface_words import surface_setting

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.study.contacts import Contacts
    from viscofric.study.run_file.contact import AnyIndenterTable


def setting(contacts: Contacts) -> dict[str, Any]:
    """Return the attributes that results have of the setting; what has several values is not among them."""
    study, rubbers = contacts.study, contacts.rubbers
    known: dict[str, Any] = {"accuracy": study.solver.accuracy}
    if study.indenter is None:
        known |= surface_setting(study, contacts.sweep)
    else:
        known["indenter"] = _indenter(study.indenter)
        radii = study.indenter.axes.get("radius", ())
        if len(radii) == 1:
            known["indenter_radius"] = radii[0]
    for name in ("load", "pressure"):
        values = getattr(study.conditions, name)
        if len(values) == 1:
            known[name] = float(values[0])
    if len(rubbers) == 1 and rubbers[0].frequency_range is not None:
        known["frequency_range"] = rubbers[0].frequency_range
    if study.uncertainty.members or any(rubber.bands.samples is not None for rubber in rubbers):
        known["seed"] = study.uncertainty.seed
    return known


def _indenter(table: AnyIndenterTable) -> str:
    """Describe the indenter."""
    lengths = {name: values for name, values in table.axes.items() if name != "angle"}
    parts = [f"{name.replace('_', ' ')} {_between([1e3 * value for value in lengths[name]])} mm" for name in lengths]
    if "angle" in table.axes:
        parts.append(f"angle {_between([math.degrees(value) for value in table.axes['angle']])}°")
    elastic = "" if table.modulus is None else f", of E = {table.modulus:.4g} Pa"
    return f"{table.shape} of {' and '.join(parts)}{elastic}"


def _between(values: Sequence[float]) -> str:
    low, high = f"{min(values):.6g}", f"{max(values):.6g}"
    return low if low == high else f"{low} to {high}"
