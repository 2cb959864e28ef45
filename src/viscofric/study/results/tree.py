"""The tree of a study's results: which data set stands where; each result labels itself.

`GROUPS` lists them.  All variables are in SI units and have `units` and `long_name`.  A predefined material has its
spectrum only.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from viscofric.contact.solution import Meaning
from viscofric.datasets import Dataset, dataset
from viscofric.friction.cases.record import FIELD_MEANING, MEANING, Failure, Record
from viscofric.friction.cases.surfaces import MadeSurface
from viscofric.friction.curves import FrictionCurves
from viscofric.study.cases.sweep import COORDINATES, Axis, Sweep, shown
from viscofric.study.run_file.contact import AnyIndenterTable
from viscofric.study.run_file.study import Study
from viscofric.study.study_rubber import BandColumns, StudyRubber

Groups = dict[str, Dataset]


#: Each group of results, and what it holds.
GROUPS = {
    "/": "The study; attributes only.",
    "/prediction": "All cases over the axes with more than one point, the others are scalar coordinates; `failed` is 1 "
    "for cases without a solution, whose numbers are NaN, with the reasons in the root's attribute `failures`.",
    "/prediction_master": "Friction at the reference temperature over the reduced speeds α(T)·v.",
    "/fields/<n>": "Pressure and displacement of the case with the number n, if they were kept.",
    "/measurement": "The separated measurement, and the prediction at the same points.",
    "/measurement_master": "Measured friction over the reduced speed, at the load of the master curve.",
    "/agreement": "Prediction against measurement, at each temperature.",
    "/friction_shift_factors": "log10 α found from the measured friction alone, beside that of the material.",
    "/history": "With `[history]`: the cases over time, also over the dwell, where there are several, and over "
    "`instant`; with `[heating]`, also their rise of temperature.",
    "/impact": "With `[impact]`: impacts of the indenters, over shapes, temperatures and `impact_speed`.",
    "/heating": "With `[heating]`: the cases at the temperatures to which their own friction heats them.",
    "/temperature_map": "Its warmest contact: rise of temperature of the rubber's face.",
    "/interface": "With a fitted `[interface]`: shear stress at the measured points.",
    "/interface_law": "Its law at the reference temperature.",
    "/assumptions": "Assumptions of the predictions, and their checks.",
    "/isotherms": "The measured moduli (tensile) that were used.",
    "/ramps": "Temperature ramps (tensile) with α(T) at every point, and the peaks of tan δ and E''.",
    "/step_tests": "Creep or relaxation tests (tensile).",
    "/amplitude_sweep": "Moduli over the strain amplitude, with Kraus's law.",
    "/shift_factors": "log10 α of each isotherm with its standard error, and the vertical shift.",
    "/shift_law": "The law that is used, or the best one, over the same temperatures.",
    "/laws": "Comparison of all shift laws.",
    "/superposition": "Validity of superposition: the checks, in numbers and sentences.",
    "/master_curve": "The isotherms shifted to the reference temperature, and the fit at the same points.",
    "/step_master_curve": "Creep or relaxation tests over reduced time, and the fit at the same points.",
    "/spectrum": "The retardation spectrum at the reference temperature.",
    "/spectrum_curve": "Its storage and loss modulus over a wider range, with the 95 % band.",
    "/materials/<n>/…": "For several materials, the groups of each from `/isotherms` to `/spectrum_curve`.",
}
_WITHIN = "within_measured_frequencies"
# Flags of a case, with their values for a case without a solution.
_FLAGS = {"interpolated": 0, _WITHIN: -1}
# Meaning of values that are no numbers of a record: bands and flags.
_OTHER: dict[str, Meaning] = {
    "friction_material_error": ("1", "standard error of the friction coefficient due to material uncertainty"),
    "friction_lower": ("1", "lower end of the 95 % band of the friction coefficient"),
    "friction_upper": ("1", "upper end of the 95 % band of the friction coefficient"),
    "interface_friction": ("1", "friction coefficient of the interface"),
    "interface_error": ("1", "standard error of the friction coefficient of the interface"),
    "total_friction": ("1", "friction coefficient of hysteresis and interface together"),
    _WITHIN: ("1", "1: reduced frequency αv/a within the measured range; 0: beyond it; -1: case failed"),
    "interpolated": ("1", "1: interpolated between solved contacts; 0: solved"),
    "failed": ("1", "1: the case could not be solved, and its other variables are missing; 0: solved"),
}
_ROUGH_WITHIN = ("1", "1: reduced frequencies 2παv/λ of all waves of the surface within the measured range; 0: not")
_PREDICTED: dict[str, Meaning] = {
    "reduced_speed": ("m/s", "speed times shift factor"),
    "predicted": ("1", "predicted viscoelastic friction coefficient"),
    "predicted_error": ("1", "numerical error estimate of the predicted friction coefficient"),
    "predicted_material_error": ("1", "standard error of the predicted friction due to material uncertainty"),
    "predicted_lower": ("1", "lower end of the 95 % band of the predicted friction coefficient"),
    "predicted_upper": ("1", "upper end of the 95 % band of the predicted friction coefficient"),
    _WITHIN: _OTHER[_WITHIN],
}
# Name of a coordinate besides a field of the same name.
_BESIDE_FIELDS = {"pressure": "mean_pressure"}


def prediction(
    sweep: Sweep,
    outcomes: Sequence[Record | Failure],
    *,
    within: Sequence[bool] | None = None,
    curves: FrictionCurves | BandColumns | None = None,
    interface: Mapping[str, Any] | None = None,
) -> Dataset:
    """Return the cases of a sweep over its axes; those with one point are scalar coordinates.

    Axes that vary together share a dimension, which has no coordinate of its own name.  `within` (whether the contact's
    frequency was measured), `curves` (their bands) and `interface` (columns of its friction) are of the solved cases,
    in their order.
    """
    solved = np.array([isinstance(outcome, Record) for outcome in outcomes], dtype=bool)
    records = [outcome for outcome in outcomes if isinstance(outcome, Record)]
    columns: dict[str, Any] = {
        name: [getattr(record, name) for record in records]
        for name in (records[0].numbers if records else ())
        if name not in COORDINATES
    }
    columns |= {} if curves is None else _band(curves, "friction")
    columns |= interface or {}
    columns["interpolated"] = [record.interpolated for record in records]
    if within is not None:
        columns[_WITHIN] = within
    meaning = meaning_of(sweep.geometry)
    varied = {axis.name: len(axis) for axis in sweep.axes if len(axis) > 1}
    whole = {name: _spread(values, solved, _FLAGS.get(name)) for name, values in columns.items()}
    # the half-width of a line contact is infinite
    whole = {name: values for name, values in whole.items() if not np.isinf(values).all()}
    whole["failed"] = (~solved).astype(np.int8)
    shaped = {name: (np.reshape(values, list(varied.values())), *meaning[name]) for name, values in whole.items()}
    return dataset(tuple(varied), shaped).assign_coords(coordinates_of(sweep.axes, sweep.geometry))


def master_prediction(
    records: Sequence[Record], geometry: str, within: Sequence[bool] | None, curves: FrictionCurves
) -> Dataset:
    """Return the contacts along the friction master curve, with their bands where known."""
    meaning = meaning_of(geometry)
    columns: dict[str, Any] = {name: [getattr(record, name) for record in records] for name in MEANING[geometry]}
    columns |= _band(curves, "friction")
    columns["interpolated"] = np.array([record.interpolated for record in records], dtype=np.int8)
    if within is not None:
        columns[_WITHIN] = np.array(within, dtype=np.int8)
    return dataset("case", {name: (values, *meaning[name]) for name, values in columns.items()})


def field_groups(sweep: Sweep, outcomes: Sequence[Record | Failure]) -> Groups:
    """Return pressure and displacement of the cases that kept them, with their place in the sweep."""
    groups = {}
    meaning = meaning_of(sweep.geometry)
    for number, outcome in enumerate(outcomes):
        if not isinstance(outcome, Record) or outcome.fields is None:
            continue
        kept = outcome.fields
        plane = ("x", "y")[: np.ndim(kept.pressure)]
        labelled = {name: (getattr(kept, name), *FIELD_MEANING[name]) for name in (*plane, "pressure", "displacement")}
        at = {name: labelled.pop(name) for name in plane}
        for axis, point in zip(sweep.axes, np.unravel_index(number, sweep.shape), strict=True):
            at |= {
                _BESIDE_FIELDS.get(name, name): (values[int(point)], *meaning[name])
                for name, values in axis.columns.items()
                if _is_informative(name, values)
            }
        groups[f"/fields/{number + 1}"] = dataset(plane, labelled, coordinates=at, attributes={"case": number + 1})
    return groups


def measurement_data(
    measured: FrictionCurves, reduced_speed: Any, solved: Any, within: Sequence[bool] | None, predicted: FrictionCurves
) -> Dataset:
    """Return the separated measurement with the prediction at the `solved` points, NaN at the others."""
    columns: dict[str, Any] = {"reduced_speed": reduced_speed}
    values = {"predicted": predicted.viscoelastic, "predicted_error": predicted.viscoelastic_error}
    for name, column in (values | _band(predicted, "predicted")).items():
        columns[name] = np.full(len(solved), np.nan)
        columns[name][solved] = column
    if within is not None:
        columns[_WITHIN] = np.array(within, dtype=np.int8)
    known = measured.points_dataset().reset_coords().drop_attrs(deep=False).drop_vars(columns, errors="ignore")
    return as_measured(known).merge(
        dataset("point", {name: (values, *_PREDICTED[name]) for name, values in columns.items()})
    )


def material_groups(
    groups: Sequence[Mapping[str, Dataset]], attributes: Sequence[Mapping[str, Any]]
) -> tuple[Groups, dict[str, Any]]:
    """Place the groups and attributes of each material: at the root for one, in branches of their own for several."""
    import xarray

    if len(groups) == 1:
        return dict(groups[0]), dict(attributes[0])
    found: Groups = {}
    for number, (of_one, about) in enumerate(zip(groups, attributes, strict=True), 1):
        branch = f"/materials/{number}"
        found[branch] = xarray.Dataset(attrs=dict(about))
        found |= {f"{branch}{name}": data for name, data in of_one.items()}
    return found, {}


def setting(study: Study, sweep: Sweep, rubbers: Sequence[StudyRubber]) -> dict[str, Any]:
    """Return the root's attributes of the whole study: accuracy, body, and conditions with a single value."""
    known: dict[str, Any] = {"accuracy": study.solver.accuracy}
    if study.indenter is None:
        known |= _surface_setting(study, sweep)
    else:
        known["indenter"] = _indenter(study.indenter)
        radii = study.indenter.axes.get("radius", ())
        if len(radii) == 1:
            known["indenter_radius"] = radii[0]
    for name in ("load", "pressure"):
        values = getattr(study.conditions, name)
        if len(values) == 1:
            known[name] = float(values[0])
    if len(rubbers) == 1 and (fit := rubbers[0].spectrum_fit) is not None:
        known["frequency_range"] = fit.frequency_range
        if fit.gaps:
            known["frequency_gaps"] = [end for gap in fit.gaps for end in gap]
    if study.uncertainty.members or any(rubber.bands.samples is not None for rubber in rubbers):
        known["seed"] = study.uncertainty.seed
    return known


def _indenter(table: AnyIndenterTable) -> str:
    parts = []
    for name, values in table.axes.items():
        ends = dict.fromkeys(shown(name, end) for end in (min(values), max(values)))
        parts.append(f"{name.replace('_', ' ')} {' to '.join(ends)}")
    elastic = "" if table.modulus is None else f", of E = {table.modulus:.4g} Pa"
    return f"{table.shape} of {' and '.join(parts)}{elastic}"


def _surface_setting(study: Study, sweep: Sweep) -> dict[str, Any]:
    """Describe the rough surface in words and numbers."""
    first: Any = sweep.cases[0]
    topography = first.surface.topography()
    many = f", {len(study.body.axes['seed'])} seeds" if len(study.body.axes.get("seed", ())) > 1 else ""
    elastic = "" if study.body.modulus is None else f", of E = {study.body.modulus:.4g} Pa"
    nx, ny = topography.shape
    kind = "self-affine" if isinstance(first.surface, MadeSurface) else "measured"
    points = f"profile of {nx} points" if ny == 1 else f"{nx} × {ny} points"
    words = (
        f"{kind} rough surface ({points}, period {1e3 * topography.size[0]:.4g} mm, rms height "
        f"{1e6 * topography.rms_height:.4g} µm, rms slope {topography.rms_slope:.4g}{many}){elastic}"
    )
    return {
        "indenter": words,
        "surface_steps": json.dumps(list(topography.history), ensure_ascii=False),
        "surface_rms_height": topography.rms_height,
        "surface_rms_slope": topography.rms_slope,
    }


def as_measured(data: Dataset) -> Dataset:
    """Say in their long names that friction coefficients were measured."""
    for name in ("viscoelastic", "coulomb"):
        if name in data:
            data[name].attrs["long_name"] = f"measured {data[name].attrs['long_name']}"
    return data


def _band(curves: FrictionCurves | BandColumns, name: str) -> dict[str, Any]:
    """Return the columns of the material's uncertainty, where it is known."""
    found = {
        "material_error": curves.material_error,
        "lower": curves.viscoelastic_lower,
        "upper": curves.viscoelastic_upper,
    }
    return {f"{name}_{kind}": column for kind, column in found.items() if column is not None}


def meaning_of(geometry: str) -> dict[str, Meaning]:
    """Return unit and long name of all numbers and coordinates of a geometry."""
    coordinates = {name: one.meaning for name, one in COORDINATES.items()}
    return coordinates | MEANING[geometry] | _OTHER | ({_WITHIN: _ROUGH_WITHIN} if geometry == "rough" else {})


def _attributes(name: str, meaning: Mapping[str, Meaning]) -> dict[str, str]:
    unit, words = meaning[name]
    return {"units": unit, "long_name": words}


def _spread(values: Any, solved: Any, otherwise: int | None) -> Any:
    """Return a column of all cases, with NaN or `otherwise` for those without a solution."""
    kind = float if otherwise is None else np.int8
    whole = np.full(len(solved), np.nan if otherwise is None else otherwise, dtype=kind)
    whole[solved] = values
    return whole


def coordinates_of(axes: Sequence[Axis], geometry: str) -> dict[str, Any]:
    """Return the coordinates of axes with units and long names."""
    meaning = meaning_of(geometry)
    return {
        name: coordinate(axis.name, values, _attributes(name, meaning))
        for axis in axes
        for name, values in axis.columns.items()
        if len(axis) > 1 or _is_informative(name, values)
    }


def coordinate(dimension: str, values: Sequence[Any], about: Mapping[str, str]) -> Any:
    """Return a coordinate along a dimension, or a scalar one of one value."""
    return (dimension, list(values), about) if len(values) > 1 else ((), values[0], about)


def _is_informative(name: str, values: tuple[float | str, ...]) -> bool:
    """Whether a coordinate says anything: a material without a name or the best estimate alone does not."""
    return len(values) > 1 or not (name in ("material", "sample") and values[0] in ("", 0))
