"""The scope of a study, and its results in key numbers."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from viscofric.contact.steady import SMALL_STRAIN
from viscofric.datasets import Dataset, DataTree
from viscofric.files import parse_toml
from viscofric.notes import Note, Reader
from viscofric.report.results import (
    group,
    is_extrapolated,
    is_from_friction,
    is_rough,
    is_synthetic,
    is_wide,
    nominal_temperatures,
    number,
    on_group,
    reference_temperature,
    rubbers,
    shown_error,
    values,
)
from viscofric.report.sweeps import SweepAxis, cases_of, predicted_axes, solved_cases, value_label
from viscofric.report.texts.numbers import (
    ABSENT,
    degrees,
    megapascals,
    percent,
    several,
    short,
    signed_percent,
    spanned,
    speeds,
    unbroken,
    with_error,
)
from viscofric.study.cases.sweep import CONDITIONS, COORDINATES
from viscofric.study.results.compare import flat_keys
from viscofric.units import CELSIUS_ZERO

_FEW = 6  # points that are listed one by one


class Input(NamedTuple):
    """One thing that was given: what it is, and its value in words."""

    name: str
    value: str


def scope(tree: DataTree) -> list[str]:
    """Say the inputs of the study in sentences."""
    attrs = tree.attrs
    said = []
    found = group(tree, "prediction")
    if found is not None:
        prediction = cases_of(found)
        steps, speed = _temperatures(prediction), values(prediction, "speed")
        moves = unbroken(speeds(float(np.nanmin(speed)), float(np.nanmax(speed))))
        at = several(steps) if len(steps) <= 6 else f"{len(steps)} temperatures from {steps[0]} to {steps[-1]}"
        accuracy = number(attrs, "accuracy")
        known = math.isfinite(accuracy)
        to = f", to a relative accuracy of {unbroken(f'{short(100 * accuracy)} %')}" if known else ""
        said.append(
            f"Viscoelastic friction of a material against a {attrs.get('indenter', 'rigid indenter')}"
            f"{_under(prediction, number(attrs, 'load'))}, at {moves} and {at}{to}."
        )
        also = [axis for axis in predicted_axes(tree) if axis.name not in ("speed", "temperature", "load", "pressure")]
        if also:
            said.append(f"Varied as well: {'; '.join(f'{axis.title} ({_points(axis)})' for axis in also)}.")
    if tests := _tests(tree):
        kind = str(attrs.get("deformation", "")) if len(tests) == 1 else ""
        fitted, ratio = " and to ".join(_tested(one, kind) for one in tests), short(number(attrs, "poisson_ratio"))
        said.append(f"The material is fitted to {fitted}{_isotherms_used(tree)}. Poisson's ratio is taken as {ratio}.")
    elif attrs.get("material"):
        source = f" ({attrs['citation']})" if attrs.get("citation") else ""
        said.append(
            f"The material is {attrs['material']}{source}. Poisson's ratio is {short(number(attrs, 'poisson_ratio'))}."
        )
    measurement = group(tree, "measurement")
    if measurement is not None:
        kind = "synthetic (calculated, not measured)" if is_synthetic(tree) else "measured"
        coulomb = np.isfinite(values(measurement, "coulomb")).any()
        separated = ", at which the viscoelastic and the Coulomb friction were separated" if coulomb else ""
        enters = (
            "The material was itself identified from friction; if from this friction, the comparison shows the quality "
            "of the fit and tests no prediction."
            if is_from_friction(tree)
            else "The prediction does not use this friction."
        )
        points = f"{measurement.sizes['point']} {kind} points of friction"
        said.append(f"The prediction is compared with {points}{separated}. {enters}")
    return [*said, *filter(None, (_interface(tree), _heating(tree)))]


class _Tests(NamedTuple):
    """Tests of one kind that the material is fitted to: what they are called, as a file was read, and their points."""

    noun: str
    read_as: str
    points: Dataset


def _tests(tree: DataTree) -> list[_Tests]:
    """Return the tests that the material is fitted to; none of a predefined material."""
    named = {"isotherms": "DMA sweeps", "ramps": "temperature ramps", "step_tests": "{kind} tests"}
    found: list[_Tests] = []
    for name, noun in (named if "step_tests" in tree.children else named | {"master_curve": "a master curve"}).items():
        points = group(tree, name)
        if points is not None and (name != "master_curve" or not found):  # else that of the tests
            form = str(tree.attrs.get("step_tests_format" if name == "step_tests" else "dma_format", ""))
            found.append(_Tests(noun.format(**points.attrs), form, points))
    return found


def _tested(tests: _Tests, deformation: str) -> str:
    """Say what was tested at which temperatures, and over which frequencies or times."""
    steps = _temperatures(tests.points)
    at = f"{len(steps)} temperatures from {steps[0]} to {steps[-1]}" if len(steps) > 1 else steps[0]
    along, unit = ("time", "s") if "time" in tests.points else ("angular_frequency", "rad/s")
    how = f" in {deformation}" if deformation else ""
    file = f", read as {tests.read_as}" if tests.read_as else ""
    return f"{tests.noun}{how}{file}: {at}, {unbroken(f'{spanned(values(tests.points, along))} {unit}')}"


@on_group("prediction", "")
def _interface(found: Dataset, tree: DataTree) -> str:
    """Say which part of friction is measured, fitted and predicted, where there is an interface."""
    stress = group(tree, "interface")
    if "interface_friction" not in found:
        return ""
    share = found["interface_friction"].values / found["total_friction"].values
    low, high = (percent(float(end)) for end in (np.nanmin(share), np.nanmax(share)))
    law = "given"
    if stress is not None:
        kind = "synthetic" if is_synthetic(tree) else "measured"
        law = f"fitted to {kind} Coulomb friction at {stress.sizes['point']} points"
    return (
        f"The total friction has two parts: hysteresis, predicted from the material; and the interface, {low} to "
        f"{high} of the total, whose law of shear stress is {law}, and acts on the predicted contact area."
    )


@on_group("heating", "")
def _heating(heating: Dataset, tree: DataTree) -> str:
    """Say what of the heat is given, fitted and predicted, and what heating changes."""
    changed = heating["friction_coefficient"].values / heating["isothermal_friction"].values
    low, high = (signed_percent(float(end) - 1.0) for end in (np.nanmin(changed), np.nanmax(changed)))
    rise = short(float(np.nanmax(heating["temperature_rise"].values)), 3)
    kind = "synthetic" if is_synthetic(tree) else "measured"
    law = "given" if group(tree, "interface") is None else f"fitted to {kind} Coulomb friction"
    coulomb = {
        "given": "a Coulomb friction that is given, not measured",
        "interface": f"the interface, whose law is {law}",
    }.get(str(heating.attrs["heat_of"]), "no Coulomb friction")
    return (
        "Every case is also predicted at the temperature to which its own friction heats it, with the heat of "
        f"{coulomb}, and of the predicted viscoelastic loss, in {heating.attrs['rubber']} against "
        f"{heating.attrs['counterface']}. The rubber is up to {rise} K warmer; heating changes viscoelastic "
        f"friction by {low} to {high}. Bands and the comparison with {kind} friction are isothermal."
    )


def inputs(tree: DataTree) -> list[Input]:
    """Return what the study was given: rubber, indenter, conditions, accuracy."""
    attrs, listed = tree.attrs, []
    rubber = str(attrs.get("material") or attrs.get("material_name") or "")
    if not rubber and (tests := _tests(tree)):
        rubber = f"fitted to {' and '.join(one.noun for one in tests)}"
    listed.append(Input("material", rubber))
    listed.append(Input("Poisson's ratio", short(number(attrs, "poisson_ratio"))))
    reference = reference_temperature(tree)
    listed.append(Input("reference temperature", "" if reference is None else degrees(reference)))
    listed.append(Input("surface" if is_rough(tree) else "indenter", str(attrs.get("indenter", ""))))
    friction = group(tree, "prediction")
    if friction is not None:
        along = {axis.name: axis for axis in predicted_axes(tree)}
        varied = {column for axis in along.values() for column in axis.columns}
        listed += [Input(axis.title, _points(axis)) for axis in along.values()]
        for name in (*CONDITIONS, "thickness"):
            if name in friction.coords and name not in varied and friction[name].ndim == 0:
                listed.append(Input(name, value_label(friction, name, friction[name].values.item())))
        listed.append(Input("cases", str(math.prod(friction.sizes.values()))))
    accuracy = number(attrs, "accuracy")
    listed = [Input(name, str(attrs.get(name, ""))) for name in ("author", "sample", "comment")] + listed
    listed += [Input(name, str(attrs.get(name, ""))) for name in ("citation", "licence")]
    listed.append(Input("requested accuracy", f"{short(100 * accuracy)} %" if math.isfinite(accuracy) else ""))
    listed += _other_settings(str(attrs.get("study_text", "")), {item.name for item in listed})
    return [item for item in listed if item.value not in ("", ABSENT)]


# Tables and keys of a run file that the list of inputs shows in words of its own.
_WORDED = frozenset(
    {"cluster", "outputs", "solver.accuracy"}
    | {f"material.{name}" for name in ("poisson_ratio", "reference_temperature", "name", "catalogue")}
    | {f"{table}.{name}" for table in ("indenter", "conditions") for name in ("shape", *COORDINATES)}
)


def _other_settings(text: str, known: set[str]) -> list[Input]:
    """Return all keys of a run file that are not known yet, and their values as they were given."""
    try:
        keys = dict(flat_keys(parse_toml(text)))
    except ValueError:
        return []
    found = []
    for key, value in keys.items():
        table, *names = key.split(".")
        worded = not names or table in _WORDED or f"{table}.{names[0]}" in _WORDED
        if not worded and names[-1] not in known:
            shown = ", ".join(map(_as_given, value)) if isinstance(value, list) else _as_given(value)
            found.append(Input(key.replace("_", " ").replace(".", ": ", 1), shown))
    return found


def _as_given(value: Any) -> str:
    """Return a value of a run file as it is written there, text without its quotes."""
    return json.dumps(value, ensure_ascii=False) if isinstance(value, (bool, list)) else str(value)


def _points(axis: SweepAxis) -> str:
    """Say the points of an axis: all of a few, the ends of many."""
    if len(axis) <= _FEW:
        return several(list(axis.labels)) if not any("," in label for label in axis.labels) else "; ".join(axis.labels)
    return f"{axis.labels[0]} to {axis.labels[-1]} ({len(axis)} values)"


def _temperatures(data: Dataset) -> list[str]:
    return [unbroken(degrees(float(kelvin))) for kelvin in nominal_temperatures(values(data, "temperature"))]


def _under(prediction: Dataset, load: float) -> str:
    """Say the load, or the range of loads."""
    loads = values(prediction, "load")
    loads = loads[np.isfinite(loads)] if np.isfinite(loads).any() else np.array([load])
    unit = str(prediction["load"].attrs.get("units", "N")) if "load" in prediction else "N"
    if "pressure" in prediction:
        return f" under a mean pressure of {unbroken(spanned(values(prediction, 'pressure') / 1e3, 4) + ' kPa')}"
    return f" under {unbroken(f'{spanned(loads, 4)} {unit}')}" if np.isfinite(loads).all() else ""


@on_group("shift_factors", "")
def _isotherms_used(factors: Dataset, _: DataTree) -> str:
    given, used = (number(factors.attrs, f"isotherms_{name}") for name in ("given", "used"))
    return f"; {used:.0f} of {given:.0f} isotherms used" if math.isfinite(given) and math.isfinite(used) else ""


#: Name of the key number that compares prediction and measurement.
AGREEMENT = "Prediction minus measurement"
_MOST_RUBBERS = 4
_SHOWN_PLACES = 6


class KeyNumber(NamedTuple):
    """A number worth a frame: its name, the number, and a remark."""

    name: str
    value: str
    remark: str


def key_numbers(tree: DataTree) -> list[KeyNumber]:
    """Return the most important numbers of the results."""
    found = [*_friction_numbers(tree), *_shift_numbers(tree), *_ramp_numbers(tree), *_modulus_numbers(tree)]
    for rubber, branch in rubbers(tree)[:_MOST_RUBBERS]:
        found += [item._replace(name=f"{item.name}, {rubber}") for item in _modulus_numbers(branch)]
    return found


def _friction_numbers(tree: DataTree) -> list[KeyNumber]:
    found = []
    prediction, agreement = solved_cases(tree), group(tree, "agreement")
    if prediction is not None:
        friction = values(prediction, "friction_coefficient")
        remark = f"predicted, over all requested cases{_caveat(tree, prediction)}"
        found.append(KeyNumber("Viscoelastic friction coefficient", spanned(friction), remark))
    if agreement is not None:
        bias, rms, points = (number(agreement.attrs, name) for name in ("bias", "rms", "points"))
        doubt = number(agreement.attrs, "bias_error")
        average = signed_percent(bias) + (f" ± {percent(doubt)}" if math.isfinite(doubt) else "")
        remark = f"rms over {points:.0f} points; {average} on average" if math.isfinite(points) else ""
        share = number(agreement.attrs, "share_within_error")
        if math.isfinite(share):
            counted = "including" if number(agreement.attrs, "material_counted") == 1.0 else "without"
            remark += f"; {percent(share, 3)} of the points within twice the standard error ({counted} the material's)"
        found.append(KeyNumber(AGREEMENT, percent(rms), remark))
    shifts = group(tree, "friction_shift_factors")
    if shifts is not None and not is_from_friction(tree):
        slope, error = (number(shifts.attrs, name) for name in ("slope", "slope_error"))
        remark = "slope of log α from friction over log α of the modulus; 1 if both coincide"
        found.append(KeyNumber("Shift factors from friction", with_error(slope, error), remark))
    return found


def _caveat(tree: DataTree, prediction: Dataset) -> str:
    """Say how many of the cases behind the headline rest on doubtful ground."""
    wide, beyond = int(is_wide(tree, prediction).sum()), int(is_extrapolated(prediction).sum())
    of, said = prediction.sizes["case"], ""
    if wide:
        reaching = f"extends beyond {SMALL_STRAIN:g} of the indenter's radius"
        said += f"; doubtful in {wide} of {of} cases, whose contact {reaching}"
    friction = values(prediction, "friction_coefficient")
    error = shown_error(friction, values(prediction, "friction_error"))
    if np.isfinite(error).any():
        size = np.abs(friction)
        most = "as large as friction" if (error >= size).any() else f"up to {percent(np.nanmax(error / size))}"
        said += f"; numerical error {most}"
    if beyond:
        said += f"; extrapolated beyond the measured frequencies in {beyond} of {of} cases"
    return said


@on_group("shift_factors", [])
def _shift_numbers(factors: Dataset, tree: DataTree) -> list[KeyNumber]:
    law, reference = group(tree, "shift_law"), reference_temperature(tree)
    if law is None or reference is None:
        return []
    used = "used"
    if str(factors.attrs.get("shift_used", "measured")) == "measured":
        used = "for information: the measured shift factors are used"
    C1, C2, error1, error2 = (number(law.attrs, name) for name in ("wlf_C1", "wlf_C2", "wlf_C1_error", "wlf_C2_error"))
    if not math.isfinite(C1):
        title = str(law.attrs.get("law", ""))
        constants = str(law.attrs.get("description", "")).removeprefix(f"{title}: ")
        return [KeyNumber("Shift law", title, f"{constants}; {used}")]
    return [
        KeyNumber("WLF constant C₁", with_error(C1, error1), f"about {degrees(reference)}; {used}"),
        KeyNumber("WLF constant C₂", f"{with_error(C2, error2)} K", f"about {degrees(reference)}"),
    ]


@on_group("ramps", [])
def _ramp_numbers(ramps: Dataset, _: DataTree) -> list[KeyNumber]:
    """Return the law of temperature ramps, and the glass transition at each frequency."""
    assumed = str(ramps.attrs.get("assumption", ""))
    found = [KeyNumber("Shift law", str(ramps.attrs.get("law", "")), "assumed, not measured" if assumed else "")]
    for peak in json.loads(str(ramps.attrs.get("glass_transitions", "[]"))):
        if peak["by"] == "tan delta":
            name = f"Peak of tan δ at {short(peak['angular_frequency'] / (2.0 * math.pi))} Hz"
            value = with_error(peak["temperature"] - CELSIUS_ZERO, peak["standard_error"])
            found.append(KeyNumber(name, f"{value} °C", "glass transition"))
    return found


@on_group("spectrum", [])
def _modulus_numbers(spectrum: Dataset, _: DataTree) -> list[KeyNumber]:
    found = []
    for name, title in (("E0", "Relaxed modulus E₀"), ("E_inf", "Glassy modulus E∞")):
        value = number(spectrum.attrs, name)
        known = math.isfinite(value) and number(spectrum.attrs, f"{name}_at_limit") != 1.0
        remark = str(spectrum.attrs.get(f"{name}_remark", ""))
        found.append(KeyNumber(title, megapascals(value) if known else ABSENT, remark))
    return found


#: Codes of failures whose sentences differ from case to case in numbers only.
_ONE_REASON = {"accuracy-not-reached", "beyond-indenter", "layer-too-thin", "no-window"} | {
    *("not-converged", "not-finite", "too-fast")
}


def grouped_failures(failures: Sequence[Note], most: int, reader: Reader = "run_file") -> list[str]:
    """Return failures as at most so many lines: those of one reason together, with their cases."""
    kinds: dict[tuple[str, str], list[Note]] = {}
    for failure in failures:
        text = "" if failure.code in _ONE_REASON else failure.text
        kinds.setdefault((failure.code, text), []).append(failure)
    shown = list(kinds.values())
    if len(shown) > most:
        shown = shown[: most - 1]
    left = len(failures) - sum(map(len, shown))
    lines = [_line(cases, reader) for cases in shown]
    return [*lines, *([f"{left} more cases, for other reasons: see the report."] if left else [])]


def _line(cases: list[Note], reader: Reader) -> str:
    places = [one.where for one in cases if one.where]
    if len(cases) == 1 or not places:
        return (f"{len(cases)} times: " if len(cases) > 1 else "") + cases[0].words(reader)
    more = f"; and {len(places) - _SHOWN_PLACES} more" if len(places) > _SHOWN_PLACES else ""
    reason = Note(cases[0].code, cases[0].text, remedy=cases[0].remedy).words(reader)
    first = ", the first" if len({one.text for one in cases}) > 1 else ""
    return f"{len(cases)} cases ({'; '.join(places[:_SHOWN_PLACES])}{more}){first}: {reason}"
