"""What the page shows of one contact: maps and cuts, its numbers with their errors, and why it has friction."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.cases.case import Case
from viscofric.web.figures.spec import Spec, axis, figure, line, number, number_of, points, quantity

_EDGE, _MARK = "vermilion", "grey"
_ASIDE: Spec = {"legend": False, "decoration": True}
_PRESSURE = axis("pressure", "pressure")
#: Below this loss tangent, a contact is nearly symmetric.
_LOSSY = 0.03


def contact_view(found: dict[str, Any], case: Case, rows: dict[str, Any]) -> dict[str, Any]:
    """Return ``figures``, ``key_numbers``, ``more_numbers`` and ``why``, the cause of the friction, of `pictures`."""
    indenter = getattr(case, "indenter", None)
    noun = "rough surface" if indenter is None else indenter.noun
    rough = found["kind"] == "rough"
    figures = {"pressure-profile": _pressure(found), "surface-profile": _surface(found, noun)}
    key, more = _numbers(found, rows)
    return {
        "figures": figures if found["map"] is None else {"pressure-map": _map(found), **figures},
        "key_numbers": key,
        "more_numbers": more,
        "why": _why_rough(found) if rough else _why(found, noun, getattr(indenter, "radius", None)),
    }


def _along(found: dict[str, Any]) -> str:
    return "x" if found["kind"] == "rough" else "along the motion"


def _map(found: dict[str, Any]) -> Spec:
    rough = found["kind"] == "rough"
    outlines = [
        line(f"outline[{at}].x", f"outline[{at}].y", width=1.5, colour=_MARK, **_ASIDE)
        for at in range(len(found["outline"]))
    ]
    return figure(
        "Contact pressure",
        axis(_along(found), "length"),
        axis("y" if rough else "across", "length", equal=True),
        [*outlines, *([] if rough else _centres(found)), _arrow(found)],
        "One period of the surface; white is not in contact. The arrow is the surface's motion."
        if rough
        else "Top view: outline of the contact, + the indenter's axis, ● the centre of pressure. The indenter moves to "
        "the right; the leading edge is on the right.",
        z=_PRESSURE,
        map={"x": "map.x", "y": "map.y", "z": "map.pressure", "smooth": False if rough else "fast"},
    )


def _centres(found: dict[str, Any]) -> list[Spec]:
    centre = found["numbers"]["centre_of_pressure"]["value"]
    return [
        points([0.0], [0.0], symbol="cross-thin", colour="#ffffff", size=12, **_ASIDE),
        points([centre], [0.0], symbol="circle", colour=_EDGE, size=8, **_ASIDE),
    ]


def _arrow(found: dict[str, Any]) -> Spec:
    """Draw an arrow along the motion, in a corner of the map."""
    x, y, angle = found["map"]["x"], found["map"]["y"], found["direction"]
    wide, high = x[-1] - x[0], y[-1] - y[0]
    size = 0.14 * min(wide, high)
    back = np.array([size if math.cos(angle) < 0.0 else 0.0, -size if math.sin(angle) > 0.0 else 0.0])
    start = np.array([x[0] + 0.05 * wide, y[-1] - 0.06 * high]) + back

    def towards(direction: float, length: float) -> Array:
        return length * np.array([math.cos(direction), math.sin(direction)])

    tip = start + towards(angle, size)
    barbs = [tip - towards(angle + turn, 0.35 * size) for turn in (0.5, -0.5)]
    along, across = np.array([start, tip, barbs[0], tip, barbs[1]]).T
    return line(along, across, width=2.5, colour=_EDGE, **_ASIDE)


def _pressure(found: dict[str, Any]) -> Spec:
    """Draw the pressure on the centre line; what differs from its mirror image makes the friction."""
    x, pressure = (np.array(found["profile"][name], dtype=float) for name in ("x", "pressure"))
    pressed = line("profile.x", "profile.pressure", "pressure", fill="tozeroy", colour="blue")
    y = {**_PRESSURE, "range": [0.0, 1.15 * max(float(pressure.max()), 1e-9)]}  # with room for the words at the top
    across = axis(_along(found), "length")
    if found["kind"] == "rough":
        title = "Pressure along x, through the highest peak"
        return figure(title, {**across, "range": [x[0], x[-1]]}, y, [pressed])
    front, rear, centre = (found["numbers"][name]["value"] for name in ("front", "rear", "centre_of_pressure"))
    reach = 1.12 * max(abs(front), abs(rear))  # the contact and a little more, the same on either side
    mirrored: Spec = {"dash": "3px,3px", "width": 1.3, "colour": _MARK, "decoration": True}
    return figure(
        "Pressure along the motion",
        {**across, "range": [-reach, reach]},
        y,
        [pressed, line(-x, "profile.pressure", "mirror image", **mirrored)],
        "On the centre line; motion to the right, the indenter's axis at zero. The difference from the mirror image "
        "causes the friction.",
        marks=[{"x": 0.0}, {"x": centre, "label": "centre of pressure"}],
    )


def _surface(found: dict[str, Any], noun: str) -> Spec:
    rough = found["kind"] == "rough"
    surface, indenter = (np.array(found["profile"][name], dtype=float) for name in ("surface", "indenter"))
    if not rough:  # of the indenter, only what is near
        high, low = np.nanmax(surface), np.nanmin(surface)
        indenter = np.where(indenter <= high + 0.6 * (high - low), indenter, np.nan)
    return figure(
        "Rubber and surface along x" if rough else "Rubber and indenter along the motion",
        axis(_along(found), "length"),
        axis("height", "length"),
        [
            line("profile.x", indenter, noun, colour=_MARK, width=2),
            line("profile.x", "profile.surface", "rubber", colour="vermilion", width=2.5),
        ],
        "Heights are exaggerated; the section goes through the highest pressure."
        if rough
        else "Motion to the right; heights are exaggerated. Behind the contact the rubber has not recovered yet (the "
        "trail).",
    )


def _value(found: dict[str, Any], name: str) -> float:
    return float(found["numbers"][name]["value"])


_KEY = ("friction_coefficient", "indentation", "contact_area", "max_pressure")
_WAVES = (("longest", "slowest"), ("shortest", "fastest"))
_ROUGH_KEY = ("friction_coefficient", "contact_area_fraction", "mean_contact_pressure", "mean_gap")


def _numbers(found: dict[str, Any], rows: dict[str, Any]) -> tuple[list[Spec], list[Spec]]:
    """Return the main numbers and the others."""

    def one(label: str, name: str, kind: str = "plain") -> Spec:
        return number(label, _value(found, name), kind, digits=3)

    rough = found["kind"] == "rough"
    told = {name: number_of(row) for name, row in rows.items()}
    key = [told.pop(name) for name in (_ROUGH_KEY if rough else _KEY)]
    waves = {f"Frequency of the {wave} wave": f"{name}_frequency" for wave, name in _WAVES}
    frequencies = waves if rough else {"Frequency {v/a}": "frequency"}
    balance = number("Energy balance error", 100.0 * abs(_value(found, "energy_balance")), unit="%", digits=2)
    given, asked = (int(_value(found, name)) for name in (("points", "points_requested") if rough else 2 * ("cells",)))
    grid = number("Points along an edge", str(given), remark=f"of {asked}: coarse" if given < asked else "")
    return key, [
        *told.values(),
        *(one(label, name, "angular_frequency") for label, name in frequencies.items()),
        one("Shift factor α(T)", "shift_factor"),
        one("Loss tangent tan δ at v/a", "loss_factor"),
        one("Storage modulus E′ at v/a", "storage_modulus", "modulus"),
        balance,
        grid,
    ]


def _of_rubber(found: dict[str, Any]) -> str:
    loss, modulus = _value(found, "loss_factor"), _value(found, "storage_modulus")
    return f"tan δ {quantity(loss, 'plain', 2)} and a storage modulus E′ of {quantity(modulus, 'modulus')}"


def _why_rough(found: dict[str, Any]) -> str:
    ends = [quantity(_value(found, f"{name}_frequency"), "angular_frequency", 2) for _, name in _WAVES]
    return (
        f"At {quantity(found['speed'], 'speed')}, the longest wave of the surface deforms the rubber at {ends[0]}, the "
        f"shortest at {ends[1]}, where the rubber has {_of_rubber(found)}. On the leading flanks the rubber is being "
        "compressed and resists; behind the summits it has not recovered yet, and the pressure is lower. This "
        f"difference, over {quantity(100.0 * _value(found, 'contact_area_fraction'))} % of the area, causes the "
        f"friction: μ = {quantity(_value(found, 'friction_coefficient'))}."
    )


def _why(found: dict[str, Any], noun: str, radius: float | None) -> str:
    front, rear, lean = (_value(found, name) for name in ("front", "rear", "centre_of_pressure"))
    passing = quantity((front + rear) / found["speed"], "time", 2)
    frequency = quantity(_value(found, "frequency"), "angular_frequency", 2)
    friction = f"μ = {quantity(_value(found, 'friction_coefficient'))}"
    cause = (
        "It dissipates little energy at this frequency and recovers almost completely behind the contact, so that the "
        "pressure is nearly symmetric."
        if _value(found, "loss_factor") < _LOSSY
        else "Ahead of the axis it is being compressed and resists; behind, it has not recovered yet, and the pressure "
        "is lower."
    )
    lever = (
        f", where the slope opposes the motion: {friction}."
        if radius is None
        else f"; divided by the radius of {quantity(radius, 'length')}, this is the friction coefficient, {friction}."
    )
    return (
        f"The {noun} passes each point of the rubber in {passing}, which deforms it at {{v/a}} = {frequency}. At this "
        f"frequency the rubber has {_of_rubber(found)}. {cause} The contact therefore extends "
        f"{quantity(front, 'length')} in front of the axis and {quantity(rear, 'length')} behind it, and the resultant "
        f"lies {quantity(lean, 'length')} ahead{lever}"
    )
