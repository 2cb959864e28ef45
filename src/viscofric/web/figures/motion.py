"""What the page shows of a contact over time: its figures and main numbers."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.datasets import Dataset, plain
from viscofric.motion.impact_solution import ImpactContact
from viscofric.motion.solution import TransientSolution
from viscofric.report.data import ENERGIES, SIZES, moves, position_along, pressure_along, returns
from viscofric.report.sweeps import thinned
from viscofric.web.figures.spec import Spec, around, axis, axis_of, figure, kind_of, line, number, quantity

#: Times and points of the pressure over time.
_FRAMES, _POINTS, _FRAME_DIGITS = 120, 121, 4


def motion_view(data: Dataset, contacts: tuple[ImpactContact, ...], steps: str) -> dict[str, Any]:
    """Return ``figures``, ``key_numbers`` and ``summary`` of a solution's data; `steps` says how many there were."""
    error = data["friction_force_error"] / data["load"].where(data["load"] > 0.0)
    data = data.assign(friction_coefficient_error=error.fillna(0.0))
    balance = number("Energy balance error", 100.0 * data.attrs["energy_imbalance"], unit="%", digits=2)
    if contacts:
        numbers = [*_of_impact(data, contacts[0]), balance]
        summary = f"restitution {quantity(contacts[0].restitution, digits=2)}"
    else:
        numbers = [*_of_history(data), {**balance, "remark": steps}]
        summary = f"{data.sizes['time']} times{', stopped' if data.attrs['interrupted'] else ''}"
    return {"figures": _figures(data), "key_numbers": numbers, "summary": summary}


def pressures(solved: TransientSolution) -> dict[str, Any]:
    """Return the pressure along the motion over time, on waves where it is highest; empty where none was kept."""
    if not solved.has_pressures:
        return {}
    times = np.unique(solved.time)
    times = times[thinned(len(times), _FRAMES)]
    waves = solved.geometry == "periodic"
    along = "y" if waves and abs(solved.direction[1]) > abs(solved.direction[0]) else "x"
    lines = [pressure_along(solved.pressure_at(float(time)), along, highest=waves) for time in times]
    pressed = [np.abs(x[p > 0.0]).max() for x, p in lines if np.any(p > 0.0)]
    if not pressed:
        return {}
    reach = 1.15 * max(pressed)
    grid = lines[-1][0] if waves else np.linspace(-reach, reach, _POINTS)
    rows = [p if waves else np.interp(grid, x, p, left=0.0, right=0.0) for x, p in lines]
    found = {"time": plain(times), "x": plain(grid, _FRAME_DIGITS), "pressure": plain(np.array(rows), _FRAME_DIGITS)}
    spec = figure(
        "Pressure along the motion",
        axis(along if waves else "along the motion, from the axis", "length", range=[grid[0], grid[-1]]),
        axis("pressure", "pressure", range=[0.0, 1.05 * float(np.max(rows))]),
        [line("animation.x", "animation.pressure[0]", fill="tozeroy")],
        "On the line of the highest pressure." if waves else "On the line of motion through the indenter's axis.",
        marks=[] if waves else [{"x": 0.0}],
    )
    return {"animation": found, "figures": {"motion-pressure": plain(spec)}}


def _over_time(data: Dataset, title: str, y: Spec, names: dict[str, str | None]) -> Spec:
    """Draw columns with their errors over the time."""
    lines = []
    for name, words in names.items():
        error = data.get(f"{name}_error")
        lines.append(line("time", name, words, band=None if error is None else around(data[name], error)))
    return figure(title, axis_of(data, "time"), y, lines)


def _figures(data: Dataset) -> dict[str, Spec]:
    # a constant load has no range of its own
    load = axis_of(data, "load", range=[0.0, 1.08 * float(data["load"].max()) or 1.0])
    sizes = {name: words for name, words in SIZES.items() if name in data and data[name].notnull().any()}
    contact: dict[str, str | None] = {**sizes} or {"contact_area": None}
    size = axis("size of the contact", "length") if sizes else axis("contact area fraction")
    energy = axis(f"energy ({data['work'].attrs['units'].replace('m2', 'm²')})")
    friction = axis_of(data, "friction_coefficient")
    loop = figure(
        "Friction loop",
        axis("position along the motion", "length"),
        axis_of(data, "friction_force"),
        [line(position_along(data), "friction_force")],
        "Its area is the work of friction.",
    )
    found = {
        "load": _over_time(data, "Load", load, {"load": None}),
        "indentation": _over_time(data, "Indentation", axis_of(data, "indentation"), {"indentation": None}),
        "friction": moves(data) and _over_time(data, "Friction coefficient", friction, {"friction_coefficient": None}),
        "contact": _over_time(data, "Contact", size, contact),
        "loop": returns(data) and loop,
        "energy": _over_time(data, "Energy", energy, {**ENERGIES}),
    }
    return {f"motion-{name}": spec for name, spec in found.items() if spec}


def _of_impact(data: Dataset, first: ImpactContact) -> list[Spec]:
    stays = not np.isfinite(first.contact_time)
    return [
        number("Restitution", first.restitution, digits=4, error=first.restitution_error),
        number("Contact time", "stays" if stays else first.contact_time, "time", digits=4),
        number("Largest force", first.peak_force, kind_of(data, "load"), digits=4),
        number("Largest indentation", first.largest_indentation, "length", digits=4),
    ]


def _of_history(data: Dataset) -> list[Spec]:
    def at(label: str, name: str, place: int, remark: str = "") -> Spec:
        value, error = float(data[name][place]), float(data[f"{name}_error"][place])
        shown = error if error > 1e-9 * abs(value) else None
        return number(label, value, kind_of(data, name), digits=4, error=shown, remark=remark)

    found = [at("Load at the end", "load", -1), at("Indentation at the end", "indentation", -1)]
    friction = data["friction_coefficient"]
    most = int(np.argmax(np.abs(friction.values)))
    if friction[most] == 0.0:
        return found
    after = f"after {quantity(float(data['time'][most] - data['time'][0]), 'time')}"
    found += [
        at("Largest viscoelastic friction", "friction_coefficient", most, after),
        at("Viscoelastic friction at the end", "friction_coefficient", -1),
    ]
    if "total_friction" not in data:
        return found
    total = float(data["total_friction"][-1])
    return [*found, number("Total friction coefficient at the end", total, digits=4, remark="with Coulomb friction")]
