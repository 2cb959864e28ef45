"""Where rough surfaces touch, contacts of a study beside each other on one scale."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.report.field_figures import contact_title
from viscofric.report.house_style import BLUE, new_figure, slender_bar
from viscofric.report.surface_figures import highest_shown, mark_motion, plot_pressure_of_period

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.figure import Figure

    from viscofric.report.field_figures import Contact

_MILLI, _MEGA = 1e-3, 1e6


def rough_contacts_figure(contacts: Sequence[Contact], directions: Sequence[float]) -> Figure:
    """Return maps of the pressure on a whole period of the surface; of a profile, the pressure along it.

    Parameters
    ----------
    contacts : sequence of Contact
        One to three, all of them of maps or all of profiles.
    directions : sequence of float
        Of the motion of each, from x towards y, radians.
    """
    is_line = contacts[0].is_line
    count = len(contacts)
    size = (7.4, 0.9 + 1.75 * count) if is_line else (1.5 + 2.9 * count, 1.35 + 2.7 * _shape(contacts[0]))
    figure = new_figure(*size)
    rows, columns = (count, 1) if is_line else (1, count)
    panels = list(figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel())
    highest = highest_shown(*(contact.pressure for contact in contacts))
    for axes, contact, direction in zip(panels, contacts, directions, strict=True):
        touching = f"{100.0 * np.mean(contact.pressure > 0.0):.3g} % in contact"
        title = f"{contact_title(contact)}, {touching}"
        if is_line:
            line = contact.pressure[:, 0] / _MEGA
            axes.fill_between(contact.x / _MILLI, line, color=BLUE, alpha=0.15, linewidth=0.0)
            axes.plot(contact.x / _MILLI, line, color=BLUE, linewidth=0.9)
            axes.set_title(title.replace("\n", ", "), fontsize=9.5, loc="left")
            axes.margins(x=0.0)
            continue
        mesh, label = plot_pressure_of_period(axes, contact.x, contact.y, contact.pressure, highest=highest)
        mark_motion(axes, (math.cos(direction), math.sin(direction)))
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
