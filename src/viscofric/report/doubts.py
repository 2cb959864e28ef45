"""Which cases rest on doubtful ground: contacts too wide for small strain, frequencies beyond the measured ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.steady import SMALL_STRAIN
from viscofric.report.results import number, values

if TYPE_CHECKING:
    import xarray as xr

    from viscofric.arrays import Array, Mask


WIDE, EXTRAPOLATED = "wide contact", "beyond the sweeps"


def reach(tree: xr.DataTree, cases: xr.Dataset) -> Array:
    """Return how far each contact reaches from the ball's axis, over the ball's radius; nan if not known."""
    radius = values(cases, "radius") if "radius" in cases.variables else number(tree.attrs, "indenter_radius")
    sides = np.array([values(cases, name) for name in ("front", "rear", "half_width")])
    farthest: Array = np.where(np.isfinite(sides), sides, -np.inf).max(axis=0)
    ratio: Array = np.where(farthest > 0.0, farthest, np.nan) / radius
    return ratio


def is_wide(tree: xr.DataTree, cases: xr.Dataset) -> Mask:
    """Whether each contact is too wide for small strain; not where its size is not known."""
    wide: Mask = reach(tree, cases) > SMALL_STRAIN
    return wide


def knows_range(cases: xr.Dataset) -> bool:
    """Whether results say which of their cases lie within the measured frequencies; older ones do not."""
    return "within_measured_frequencies" in cases.variables


def is_extrapolated(cases: xr.Dataset) -> Mask:
    """Whether each case rests on frequencies that were not measured; not where it was not solved."""
    friction = "predicted" if "predicted" in cases.variables else "friction_coefficient"
    outside: Mask = (values(cases, "within_measured_frequencies") == 0.0) & np.isfinite(values(cases, friction))
    return outside


def remarks(tree: xr.DataTree, cases: xr.Dataset) -> list[tuple[str, ...]]:
    """Return what is doubtful about each case, in a word or two; nothing about sound ones."""
    marks = [(WIDE, is_wide(tree, cases)), (EXTRAPOLATED, is_extrapolated(cases))]
    return [tuple(word for word, mask in marks if mask[row]) for row in range(len(marks[0][1]))]


def interpolated(cases: xr.Dataset) -> Mask:
    """Whether each case was interpolated on a curve of solved ones, instead of solved itself."""
    found: Mask = values(cases, "interpolated") == 1.0
    return found
