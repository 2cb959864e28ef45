"""One case of a study over time, or as an impact: what is solved, and the stored part of it."""

from __future__ import annotations

from typing import Any

from viscofric.datasets import Dataset
from viscofric.friction.cases.record import Column, HistoryRecord
from viscofric.friction.cases.surfaces import surface_of
from viscofric.motion.cycle import solve_cycle
from viscofric.motion.history import History, dense_times
from viscofric.motion.impact import solve_impact
from viscofric.motion.solve import solve_transient
from viscofric.notes import note_of
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Number of a cycle -> its meaning; units by that of the load.
_OF_CYCLE = {
    "energy_per_cycle": "energy dissipated in a cycle",
    "storage_stiffness": "storage stiffness",
    "loss_stiffness": "loss stiffness",
    "loss_tangent": "loss over storage stiffness",
    "mean_friction_coefficient": "work of friction over that of a friction force as large as the load",
    "periods": "periods computed to find the periodic state",
    "change": "distance from the periodic state",
}
_STIFFNESS = {"N": "N/m", "N/m": "Pa", "Pa": "Pa/m"}
#: Number of an impact -> its unit and meaning.
_OF_IMPACT = {
    "restitution": ("1", "speed after the contact over that before it"),
    "restitution_error": ("1", "estimated error of the restitution"),
    "contact_time": ("s", "contact time"),
    "peak_force": ("N", "largest force"),
    "largest_indentation": ("m", "largest indentation"),
}


def solve_history(
    material: Material, *, history: History, points: int, cycle: bool = False, **contact: Any
) -> HistoryRecord:
    """Solve a contact over time, or with `cycle` the periodic state of a period, at so many times (`dense_times`).

    An isothermal `material` has the modes at its temperature, without shift factors; `contact` are further arguments
    of `solve_transient`, SI, with `surface`, a description of one, instead of `indenter`.
    """
    times = dense_times(history, points)
    if "surface" in contact:
        contact["indenter"] = surface_of(contact.pop("surface"))
    if cycle:
        body = contact.pop("indenter")
        found = solve_cycle(material, body, history, times=times, **contact)
        data = found.to_dataset()
        return HistoryRecord({}, tuple(map(note_of, found.warnings)), columns=_columns(data) | _of_cycle(data))
    run = solve_transient(material, history=history, times=times, **contact)
    if run.interrupted:  # a part of a history is no result
        raise KeyboardInterrupt
    return HistoryRecord({}, tuple(map(note_of, run.warnings)), columns=_columns(run.to_dataset()))


def solve_hit(modes: RetardationSpectrum, poisson_ratio: float, **impact: Any) -> HistoryRecord:
    """Solve an impact by `solve_impact`, whose further arguments are `impact`, SI; see `solve_history`."""
    hit = solve_impact(Material(modes, poisson_ratio=poisson_ratio), **impact)
    columns = {name: Column([float(getattr(hit, name))], *about) for name, about in _OF_IMPACT.items()}
    return HistoryRecord({}, tuple(map(note_of, hit.warnings)), columns=columns)


def _columns(data: Dataset) -> dict[str, Column]:
    return {
        str(name): Column(one.values.tolist(), str(one.attrs["units"]), str(one.attrs["long_name"]))
        for name, one in data.variables.items()
    }


def _of_cycle(data: Dataset) -> dict[str, Column]:
    """Return the numbers of a cycle, which are attributes of its data set."""
    units = {"energy_per_cycle": str(data["dissipated"].attrs["units"])}
    units |= dict.fromkeys(("storage_stiffness", "loss_stiffness"), _STIFFNESS[str(data["load"].attrs["units"])])
    found = {}
    for name, words in _OF_CYCLE.items():
        for key, meaning in ((name, words), (f"{name}_error", f"estimated error of the {words}")):
            if key in data.attrs:
                found[key] = Column([float(data.attrs[key])], units.get(name, "1"), meaning)
    return found
