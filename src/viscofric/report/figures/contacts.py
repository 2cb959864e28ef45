"""Contacts whose fields the results keep: which of them are shown, and their figures beside each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure

from viscofric.arrays import Array, centre_line
from viscofric.datasets import Dataset, DataTree
from viscofric.report.figures.contact import draw_arrow, draw_profile, highest_shown, pressure_mesh
from viscofric.report.figures.rough import mark_motion, plot_pressure_of_period
from viscofric.report.figures.style import GREY, INK, VERMILION, WHITE, new_figure, slender_bar
from viscofric.report.results import group, values
from viscofric.report.sweeps import SEED, solved_cases, value_label
from viscofric.report.texts.numbers import megapascals, significant
from viscofric.study.cases.sweep import COORDINATES

_MARGIN = 1.12  # of the shown region, over the largest contact
_MILLI, _MEGA = 1e-3, 1e6
#: Mean pressures within this factor share a scale in MPa.
_ALIKE = 1.8
_FIELDS = "fields"
_SAME = 1e-9  # relative
_PRESSURE, _ALONG = "pressure $p$ (MPa)", "along the motion $x$ (mm) →"


class Contact(NamedTuple):
    """One solved contact with its fields; the indenter moves towards +x."""

    title: str  # "slowest", "most friction", …
    conditions: str  # "30 °C, 20 mm/s"
    friction: float  # friction coefficient; NaN if it is not known
    x: Array  # x, y: (nx,) and (ny,): Cell centres from the indenter's axis, m; one y for a line contact
    y: Array
    pressure: Array  # (nx, ny), Pa
    direction: float = 0.0  # of the motion of a rough surface, from x towards y, rad

    @property
    def is_line(self) -> bool:
        """Whether it is a line contact."""
        return len(self.y) == 1

    @property
    def centre_of_pressure(self) -> float:
        """Where the resultant load acts, from the axis along the motion, m."""
        return float(self.x @ self.pressure.sum(axis=1)) / float(self.pressure.sum())

    @property
    def mean_pressure(self) -> float:
        """Of the loaded cells, Pa."""
        return float(self.pressure[self.pressure > 0.0].mean())

    @property
    def edges(self) -> tuple[float, float]:
        """Rear and front of the loaded cells, m."""
        loaded = self.x[(self.pressure > 0.0).any(axis=1)]
        return (float(loaded.min()), float(loaded.max())) if loaded.size else (float(self.x[0]), float(self.x[-1]))

    @property
    def reach(self) -> float:
        """Largest distance of the contact's edge from the axis, along or across the motion, m."""
        across = self.y[(self.pressure > 0.0).any(axis=0)]
        along = max(abs(end) for end in self.edges)
        return along if self.is_line or not across.size else max(along, float(np.abs(across).max()))


def shown_contacts(tree: DataTree) -> list[Contact]:
    """Return the slowest contact, that of the most friction and the fastest, of those whose fields are kept."""
    cases = solved_cases(tree)
    found = _kept(tree, cases)
    if not found:
        return []
    speed, friction = (
        np.array([conditions[name] for _, conditions in found]) for name in ("speed", "friction_coefficient")
    )
    titles: dict[int, list[str]] = {int(np.argmin(speed)): ["slowest"]}
    if np.isfinite(friction).any():
        most = int(np.nanargmax(friction))
        highest = cases is None or friction[most] >= np.nanmax(values(cases, "friction_coefficient"))
        titles.setdefault(most, []).append("most friction" if highest else "most friction of those shown")
    titles.setdefault(int(np.argmax(speed)), []).append("fastest")
    order = sorted(titles, key=lambda index: speed[index])
    prediction, named = group(tree, "prediction"), _varied(found)
    if prediction is not None and SEED in prediction.dims:  # also where all kept fields are of one seed
        named.add(SEED)
    return [_contact(*found[index], ", ".join(titles[index]) if len(found) > 1 else "", named) for index in order]


def _kept(tree: DataTree, cases: Dataset | None) -> list[tuple[Dataset, dict[str, Any]]]:
    """Return the fields that the results keep, each with the conditions of its case and its friction."""
    if _FIELDS not in tree.children:
        return []
    kept = []
    for child in tree.children[_FIELDS].children.values():
        fields = child.to_dataset()
        if "y" not in fields.dims:  # a line contact
            fields = fields.expand_dims(y=[0.0], axis=1)
        conditions = {name: fields[name].item() for name in COORDINATES if name in fields.coords}
        if "mean_pressure" in fields.coords:  # of a rough surface: `pressure` is the field
            conditions["pressure"] = fields["mean_pressure"].item()
        conditions["friction_coefficient"] = math.nan if cases is None else _friction_of(cases, conditions)
        kept.append((fields, conditions))
    return kept


def _friction_of(cases: Dataset, conditions: dict[str, Any]) -> float:
    """Return the friction coefficient of the case with these conditions, NaN if there is none."""
    same = np.ones(cases.sizes["case"], dtype=bool)
    for name, value in conditions.items():
        if name in cases.variables and cases[name].dims == ("case",):
            column = cases[name].values
            same &= column == value if isinstance(value, str) else np.isclose(column, value, rtol=_SAME, atol=0.0)
    rows = np.flatnonzero(same)
    return float(values(cases, "friction_coefficient")[rows[0]]) if rows.size else math.nan


def _varied(found: list[tuple[Dataset, dict[str, Any]]]) -> set[str]:
    """Return which conditions differ among the contacts, and those that are always listed."""
    differ = {name for name in COORDINATES if len({str(conditions.get(name)) for _, conditions in found}) > 1}
    return differ | {"temperature", "speed"}


def _contact(fields: Dataset, conditions: dict[str, Any], title: str, named: set[str]) -> Contact:
    words = [
        value_label(fields, name, conditions[name]) for name in COORDINATES if name in conditions and name in named
    ]
    x, y = (fields[name].values.astype(float) for name in ("x", "y"))
    pressure = fields["pressure"].transpose("x", "y").values.astype(float)
    friction, direction = conditions["friction_coefficient"], float(conditions.get("direction", 0.0))
    return Contact(title, ", ".join(words), friction, x, y, pressure, direction)


def plot_contact_map(axes: Axes, contact: Contact, pressure: Array, *, reach: float, highest: float) -> QuadMesh:
    """Draw the pressure (nx, ny) of a point contact up to `reach` (m) from its axis, with its outline and its axis.

    Colours end at `highest`, in the unit of the pressure.
    """
    along, across = (np.flatnonzero(np.abs(places) <= reach) for places in (contact.x, contact.y))
    x, y = contact.x[along] / _MILLI, contact.y[across] / _MILLI
    mesh = pressure_mesh(axes, x, y, pressure[np.ix_(along, across)], highest, outlined=True)
    axes.plot([0.0], [0.0], marker="+", color=WHITE, markersize=9, markeredgewidth=1.2, linestyle="none")
    dot: dict[str, Any] = {"color": VERMILION, "markersize": 4, "markeredgecolor": WHITE, "markeredgewidth": 0.6}
    axes.plot([contact.centre_of_pressure / _MILLI], [0.0], "o", **dot)
    ends = (-reach / _MILLI, reach / _MILLI)
    axes.set(xlim=ends, ylim=ends)
    draw_arrow(axes, (0.04, 0.945), (0.21, 0.945))
    return mesh


def plot_contact_profile(axes: Axes, contact: Contact, pressure: Array) -> None:
    """Draw the pressure (nx, ny) on the centre line, and its mirror image: what differs causes the friction."""
    x, line = contact.x / _MILLI, centre_line(contact.y, pressure)
    draw_profile(axes, x, line, label="pressure on the centre line")
    axes.plot(-x, line, color=GREY, linewidth=1.0, linestyle=(0, (1.5, 1.2)), label="mirror image")
    axes.axvline(0.0, color=INK, linewidth=0.8, label="indenter's axis")
    centre = contact.centre_of_pressure / _MILLI
    axes.axvline(centre, color=VERMILION, linewidth=1.3, linestyle=(0, (4, 2)), label="centre of pressure")


def contacts_figure(contacts: Sequence[Contact]) -> Figure:
    """Return contacts on one scale, over their means where pressures differ much: maps (of points) and profiles."""
    scaled, label = _on_one_scale(contacts)
    maps, profiles, figure = _panels(len(contacts), contacts[0].is_line)
    reach = _MARGIN * max(contact.reach for contact in contacts)
    highest = highest_shown(*scaled)
    for axes, contact, pressure in zip(maps, contacts, scaled, strict=False):
        mesh = plot_contact_map(axes, contact, pressure, reach=reach, highest=highest)
    for axes, contact, pressure in zip(profiles, contacts, scaled, strict=True):
        plot_contact_profile(axes, contact, pressure)
        axes.set_xlim(-reach / _MILLI, reach / _MILLI)
        # A peak of a cell or two at the leading edge is cut off rather than all else pressed flat.
        axes.set_ylim(0.0, 1.25 * highest)
        axes.set_xlabel(_ALONG)
    for axes, contact in zip(maps or profiles, contacts, strict=True):
        mean = f"mean pressure {megapascals(contact.mean_pressure)}" if label != _PRESSURE else ""
        axes.set_title("\n".join(line for line in (contact_title(contact), mean) if line), fontsize=9.5)
    profiles[0].set_ylabel(label)
    if maps:
        maps[0].set_ylabel("across $y$ (mm)")
        slender_bar(figure, mesh, maps, label, extend="max")
    handles, labels = profiles[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4 if len(contacts) > 1 else 2, fontsize=8.5)
    return figure


def _on_one_scale(contacts: Sequence[Contact]) -> tuple[list[Array], str]:
    """Return the pressures in MPa, or over their means where these differ much, and what they are called."""
    means = [contact.mean_pressure for contact in contacts]
    if max(means) <= _ALIKE * min(means):
        return [contact.pressure / _MEGA for contact in contacts], _PRESSURE
    return [contact.pressure / contact.mean_pressure for contact in contacts], "pressure over its mean $p/\\bar{p}$"


def _panels(count: int, is_line: bool) -> tuple[list[Axes], list[Axes], Figure]:
    """Return panels for maps (none of line contacts) and for profiles, and their figure."""
    if is_line:
        figure = new_figure(1.2 + 2.9 * count, 3.4)
        return [], list(figure.subplots(1, count, squeeze=False, sharey=True)[0]), figure
    if count == 1:
        figure = new_figure(8.4, 3.9)
        left, right = figure.subplots(1, 2)
        return [left], [right], figure
    figure = new_figure(1.5 + 2.7 * count, 6.0)
    grid = figure.subplots(2, count, sharey="row", height_ratios=[2.5, 1.7])
    return list(grid[0]), list(grid[1]), figure


def contact_title(contact: Contact) -> str:
    """Return what a contact is called, its conditions and its friction, each in a line of its own."""
    friction = rf"$\mu$ = {significant(contact.friction)}" if math.isfinite(contact.friction) else ""
    lines = (contact.title, contact.conditions, friction)
    return "\n".join(line for line in lines if line)


def rough_contacts_figure(contacts: Sequence[Contact]) -> Figure:
    """Return maps of the pressure on a whole period of the surface; of a profile, the pressure along it."""
    is_line = contacts[0].is_line
    count = len(contacts)
    size = (7.4, 0.9 + 1.75 * count) if is_line else (1.5 + 2.9 * count, 1.35 + 2.7 * _shape(contacts[0]))
    figure = new_figure(*size)
    rows, columns = (count, 1) if is_line else (1, count)
    panels = list(figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel())
    highest = highest_shown(*(contact.pressure for contact in contacts))
    for axes, contact in zip(panels, contacts, strict=True):
        touching = f"{100.0 * np.mean(contact.pressure > 0.0):.3g} % in contact"
        title = f"{contact_title(contact)}, {touching}"
        if is_line:
            draw_profile(axes, contact.x / _MILLI, contact.pressure[:, 0] / _MEGA, linewidth=0.9)
            axes.set_title(title.replace("\n", ", "), fontsize=9.5, loc="left")
            axes.margins(x=0.0)
            continue
        mesh, label = plot_pressure_of_period(axes, contact.x, contact.y, contact.pressure, highest=highest)
        mark_motion(axes, (math.cos(contact.direction), math.sin(contact.direction)))
        axes.set_title(title, fontsize=9.5)
        axes.label_outer()
    if is_line:
        panels[0].set_ylim(bottom=0.0)
        panels[-1].set_xlabel("$x$ (mm)")
        figure.supylabel("pressure $p$ (MPa)", fontsize=10.5)
    else:
        figure.supxlabel(panels[-1].get_xlabel(), fontsize=10.5)
        slender_bar(figure, mesh, panels, label, extend="max")
        for axes in panels:
            axes.set_xlabel("")
            axes.set_anchor("S")  # what room an equal aspect leaves is the titles'; a colour bar centres its panels
    return figure


def _shape(contact: Contact) -> float:
    """Return the length of a period across over that along x, within what can be drawn beside others."""
    return float(np.clip(np.ptp(contact.y) / np.ptp(contact.x), 0.4, 1.5))
