"""Labels of a sweep: its cases over their axes, each coordinate and variable with unit and long name.

===============================  ====================================================================
``/prediction``                  all cases over the axes that have more than one point
``/fields/<n>``                  pressure and displacement of the case with the number n, where kept
``/materials/<n>/…``             of several materials: the groups of each rubber, numbered from 1
===============================  ====================================================================

The numbers of a case that could not be solved are missing (NaN), and its `failed` is 1; the reasons stand in the
attribute `failures` of the results, those of the cases first and in their order.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.study.cases.record import Record
from viscofric.study.labels import MEANING, band

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import xarray

    from viscofric.friction.curves import FrictionCurves
    from viscofric.study.cases.record import Failure
    from viscofric.study.cases.sweep import Axis, Sweep
    from viscofric.study.study_rubber import BandColumns

#: What a case holds besides its numbers: flags with what stands for a case that failed.
_FLAGS = {"interpolated": 0, "within_measured_frequencies": -1}
#: Numbers of a record that are coordinates here.
_PLACES = ("speed", "temperature", "load", "pressure")
# coordinate -> unit, long name
_COORDINATES = {
    "material": ("1", "name of the rubber"),
    "sample": ("1", "member of the rubber's posterior; 0 is the best estimate"),
    "radius": ("m", "radius of the indenter"),
    "radius_x": ("m", "radius of curvature of the indenter along the motion"),
    "radius_y": ("m", "radius of curvature of the indenter across the motion"),
    "angle": ("rad", "angle between the cone's flank and the surface"),
    "thickness": ("m", "thickness of the rubber"),
    "seed": ("1", "seed of the rough surface, one of many of the same statistics"),
    "direction": ("rad", "direction of the motion, from x towards y"),
}
# of a rough surface, where it is something else: variable -> unit, long name
_OF_A_SURFACE = {
    "complementarity": ("1", "largest violation of the contact conditions over the rms height"),
    "cells": ("1", "points along the longer period"),
    "products": ("1", "products with the transfer function on the finest grid"),
    "within_measured_frequencies": (
        "1",
        "whether 2πv/λ, reduced, lies within the measured frequencies for all waves of the surface (1), not (0)",
    ),
}
# of a line contact, where it is something else: variable -> unit, long name
_OF_A_LINE = {
    "load": ("N/m", "normal load per length"),
    "contact_area": ("m", "width of the contact along the motion"),
    "contact_area_error": ("m", "error estimate of the width of the contact"),
}
_OTHER = {"rough": _OF_A_SURFACE, "line": _OF_A_LINE}
#: What a coordinate is called beside a field of its name.
_BESIDE_FIELDS = {"pressure": "mean_pressure"}
# field -> unit, long name
_FIELDS = {
    "x": ("m", "position along the motion, ahead of the indenter's axis"),
    "y": ("m", "position across the motion"),
    "pressure": ("Pa", "contact pressure"),
    "displacement": ("m", "displacement of the surface into the rubber"),
}


def prediction(
    sweep: Sweep,
    outcomes: Sequence[Record | Failure],
    *,
    within: Sequence[bool] | None = None,
    curves: FrictionCurves | BandColumns | None = None,
) -> xarray.Dataset:
    """Label the cases of a sweep.

    Parameters
    ----------
    sweep : Sweep
    outcomes : sequence of Record or Failure
        One for each case, in their order.
    within : sequence of bool, optional
        Of those that were solved, in their order: whether the contact's frequency lies within those measured.
    curves : FrictionCurves or BandColumns, optional
        Their friction with its bands, or these alone.

    Returns
    -------
    xarray.Dataset
        Every axis with more than one point is a dimension, under its name; the others are scalar coordinates.  Where
        several coordinates are stepped together, the dimension has all of them, and none of its own name.
    """
    import xarray

    solved = np.array([isinstance(outcome, Record) for outcome in outcomes], dtype=bool)
    records = [outcome for outcome in outcomes if isinstance(outcome, Record)]
    columns: dict[str, Any] = {
        name: [getattr(record, name) for record in records]
        for name in (records[0].numbers if records else ())
        if name not in _PLACES
    }
    columns |= {} if curves is None else band(curves, "friction")
    columns["interpolated"] = [record.interpolated for record in records]
    if within is not None:
        columns["within_measured_frequencies"] = within
    meaning = _meaning(sweep)
    dimensions = [axis.name for axis in sweep.axes if len(axis) > 1]
    shape = [len(axis) for axis in sweep.axes if len(axis) > 1]

    def labelled(name: str, values: Any) -> Any:
        return dimensions, np.reshape(values, shape), _attributes(name, meaning)

    variables = {}
    for name, values in columns.items():
        whole = _spread(values, solved, _FLAGS.get(name))
        if np.isinf(whole).all():  # what a line contact has no end of
            continue
        variables[name] = labelled(name, whole)
    variables["failed"] = labelled("failed", (~solved).astype(np.int8))
    coordinates = {name: value for axis in sweep.axes for name, value in _coordinates(axis, meaning).items()}
    return xarray.Dataset(variables, coordinates)


def field_groups(sweep: Sweep, outcomes: Sequence[Record | Failure]) -> dict[str, xarray.Dataset]:
    """Label the fields of those cases that kept them.

    Returns
    -------
    dict of str to xarray.Dataset
        ``/fields/<n>`` → pressure and displacement over x and y, with the coordinates of the case; n is the case's
        number, from 1, the last axis running fastest.
    """
    import xarray

    meaning, of_fields = _meaning(sweep), _FIELDS
    if sweep.geometry == "rough":
        of_fields = _FIELDS | {name: ("m", f"position along {name}") for name in ("x", "y")}
    groups = {}
    for number, outcome in enumerate(outcomes):
        if not isinstance(outcome, Record) or outcome.fields is None:
            continue
        kept = outcome.fields
        plane = ["x", "y"][: np.ndim(kept.pressure)]
        variables: dict[str, Any] = {
            name: (plane, getattr(kept, name), _attributes(name, of_fields)) for name in ("pressure", "displacement")
        }
        coordinates: dict[str, Any] = {
            name: (name, getattr(kept, name), _attributes(name, of_fields)) for name in plane
        }
        place = np.unravel_index(number, sweep.shape)
        for axis, point in zip(sweep.axes, place, strict=True):
            coordinates |= {
                _BESIDE_FIELDS.get(name, name): ((), values[int(point)], _attributes(name, meaning))
                for name, values in axis.columns.items()
                if _tells(name, values)
            }
        groups[f"/fields/{number + 1}"] = xarray.Dataset(variables, coordinates, {"case": number + 1})
    return groups


def material_groups(
    groups: Sequence[Mapping[str, xarray.Dataset]], attributes: Sequence[Mapping[str, Any]]
) -> tuple[dict[str, xarray.Dataset], dict[str, Any]]:
    """Lay out what is known of each rubber: of one alone at the root, of several each in a branch of its own.

    Parameters
    ----------
    groups : sequence of mapping
        Of each rubber: name of the group, with its leading stroke, → data set.
    attributes : sequence of mapping
        Of each rubber, such as its name and reference temperature.

    Returns
    -------
    groups : dict of str to xarray.Dataset
        As they are of one rubber; below ``/materials/<n>``, from 1, of several.
    attributes : dict
        Of the root: those of one rubber; of several they stand at their branches.
    """
    import xarray

    if len(groups) == 1:
        return dict(groups[0]), dict(attributes[0])
    found: dict[str, xarray.Dataset] = {}
    for number, (of_one, about) in enumerate(zip(groups, attributes, strict=True), 1):
        branch = f"/materials/{number}"
        found[branch] = xarray.Dataset(attrs=dict(about))
        found |= {f"{branch}{name}": data for name, data in of_one.items()}
    return found, {}


def _meaning(sweep: Sweep) -> dict[str, tuple[str, str]]:
    return MEANING | _COORDINATES | _OTHER.get(sweep.geometry, {})


def _attributes(name: str, meaning: Mapping[str, tuple[str, str]]) -> dict[str, str]:
    unit, words = meaning[name]
    return {"units": unit, "long_name": words}


def _spread(values: Any, solved: Any, otherwise: int | None) -> Any:
    """Return a column of all cases: what stands for one that failed where that is given, else NaN."""
    kind = float if otherwise is None else np.int8
    whole = np.full(len(solved), np.nan if otherwise is None else otherwise, dtype=kind)
    whole[solved] = values
    return whole


def _coordinates(axis: Axis, meaning: Mapping[str, tuple[str, str]]) -> dict[str, Any]:
    """Return the coordinates along an axis, single ones if it has one point."""
    along: Any = axis.name if len(axis) > 1 else ()
    return {
        name: (along, list(values) if len(axis) > 1 else values[0], _attributes(name, meaning))
        for name, values in axis.columns.items()
        if len(axis) > 1 or _tells(name, values)
    }


def _tells(name: str, values: tuple[float | str, ...]) -> bool:
    """Whether a coordinate says anything: a rubber without a name, or the best estimate alone, does not."""
    return len(values) > 1 or not (name in ("material", "sample") and values[0] in ("", 0))
