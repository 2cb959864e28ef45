"""What was asked and what came out, in sentences and key numbers, and what each figure shows."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.contact.steady import SMALL_STRAIN
from viscofric.report.doubts import is_extrapolated, is_wide
from viscofric.report.house_style import degrees
from viscofric.report.messages import readable
from viscofric.report.numbers import (
    ABSENT,
    megapascals,
    percent,
    several,
    short,
    signed_percent,
    speed,
    with_error,
)
from viscofric.report.results import (
    group,
    is_from_friction,
    is_synthetic,
    nominal_temperatures,
    number,
    reference_temperature,
    sentences,
    values,
)

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


# Space between a number and its unit, where a line should not break
_BEFORE_UNIT = re.compile(r"(?<=\d) (?=°C|N\b|mm|m/s|rad/s|%)")


class KeyNumber(NamedTuple):
    """A number worth a frame: its name, the number, and a remark."""

    name: str
    value: str
    remark: str


def _range(numbers: Array, digits: int = 3) -> str:
    low, high = short(float(np.nanmin(numbers)), digits), short(float(np.nanmax(numbers)), digits)
    return low if low == high else f"{low} to {high}"


def _speeds(metres_per_second: Array) -> str:
    """Say a range of speeds: 20 to 200 mm/s, 0.1 mm/s to 10 m/s."""
    low, high = speed(float(np.nanmin(metres_per_second))), speed(float(np.nanmax(metres_per_second)))
    if low == high:
        return low
    same_unit = low.split()[1] == high.split()[1]
    return f"{low.split()[0] if same_unit else low} to {high}"


def what_was_asked(tree: xr.DataTree) -> list[str]:
    """Say the inputs of the study in sentences."""
    attrs = tree.attrs
    said = []
    prediction, sweeps = group(tree, "prediction"), group(tree, "isotherms")
    if prediction is not None:
        steps = [degrees(float(kelvin)) for kelvin in nominal_temperatures(values(prediction, "temperature"))]
        at = several(steps) if len(steps) <= 6 else f"{len(steps)} temperatures from {steps[0]} to {steps[-1]}"
        said.append(
            f"The viscoelastic friction of a rubber against a {attrs.get('indenter', 'rigid indenter')} "
            f"under {short(number(attrs, 'load'))} N, at {_speeds(values(prediction, 'speed'))} "
            f"and {at}, to an accuracy of {short(100 * number(attrs, 'accuracy'))} %."
        )
    if sweeps is not None:
        steps = [degrees(float(kelvin)) for kelvin in nominal_temperatures(values(sweeps, "temperature"))]
        at = f"{len(steps)} temperatures from {steps[0]} to {steps[-1]}" if len(steps) > 1 else steps[0]
        file = f" ({attrs['dma_format']})" if attrs.get("dma_format") else ""
        said.append(
            f"The rubber is known from dynamic mechanical analysis in {attrs.get('deformation', 'tension')}{file}: "
            f"frequency sweeps at {at}, {_range(values(sweeps, 'angular_frequency'))} rad/s"
            f"{_isotherms_used(tree)}. Poisson's ratio is taken as {short(number(attrs, 'poisson_ratio'))}."
        )
    elif attrs.get("material"):
        source = f" ({attrs['citation']})" if attrs.get("citation") else ""
        said.append(
            f"The rubber is {attrs['material']}{source}. Poisson's ratio is {short(number(attrs, 'poisson_ratio'))}."
        )
    measurement = group(tree, "measurement")
    if measurement is not None:
        kind = "synthetic (made, not measured)" if is_synthetic(tree) else "measured"
        coulomb = np.isfinite(values(measurement, "coulomb")).any()
        separated = ", at which the viscoelastic and the Coulomb friction were separated" if coulomb else ""
        enters = (
            "The rubber was itself identified from friction; if that is this friction, the comparison tells how well "
            "it was fitted, and tests no prediction."
            if is_from_friction(tree)
            else "Nothing of this friction enters the prediction."
        )
        points = f"{measurement.sizes['point']} {kind} points of friction"
        said.append(f"The prediction is compared with {points}{separated}. {enters}")
    return [_BEFORE_UNIT.sub("\N{NO-BREAK SPACE}", sentence) for sentence in said]


def _isotherms_used(tree: xr.DataTree) -> str:
    factors = group(tree, "shift_factors")
    if factors is None:
        return ""
    given, used = (number(factors.attrs, f"isotherms_{name}") for name in ("given", "used"))
    return f"; {used:.0f} of {given:.0f} isotherms used" if math.isfinite(given) and math.isfinite(used) else ""


def key_numbers(tree: xr.DataTree) -> list[KeyNumber]:
    """Return the answer's most important numbers."""
    return [*_friction_numbers(tree), *_shift_numbers(tree), *_modulus_numbers(tree)]


def _friction_numbers(tree: xr.DataTree) -> list[KeyNumber]:
    found = []
    prediction, agreement = group(tree, "prediction"), group(tree, "agreement")
    if prediction is not None and np.isfinite(values(prediction, "friction_coefficient")).any():
        friction = values(prediction, "friction_coefficient")
        remark = f"predicted, over all cases asked for{_caveat(tree, prediction)}"
        found.append(KeyNumber("Viscoelastic friction coefficient", _range(friction), remark))
    if agreement is not None:
        bias, rms, points = (number(agreement.attrs, name) for name in ("bias", "rms", "points"))
        doubt = number(agreement.attrs, "bias_error")
        average = signed_percent(bias) + (f" ± {percent(doubt)}" if math.isfinite(doubt) else "")
        remark = f"rms over {points:.0f} points; {average} on average" if math.isfinite(points) else ""
        share = number(agreement.attrs, "share_within_error")
        if math.isfinite(share):
            counted = "with" if number(agreement.attrs, "material_counted") == 1.0 else "without"
            remark += (
                f"; {percent(share, 3)} of the points within twice the standard error ({counted} the material's own)"
            )
        found.append(KeyNumber("Prediction less measurement", percent(rms), remark))
    shifts = group(tree, "friction_shift_factors")
    if shifts is not None and not is_from_friction(tree):
        slope, error = (number(shifts.attrs, name) for name in ("slope", "slope_error"))
        remark = "times those of the modulus, as logarithms: 1 where both coincide"
        found.append(KeyNumber("Shift factors from friction", with_error(slope, error), remark))
    return found


def _caveat(tree: xr.DataTree, prediction: xr.Dataset) -> str:
    """Say how many of the cases behind the headline rest on doubtful ground."""
    wide, beyond = int(is_wide(tree, prediction).sum()), int(is_extrapolated(prediction).sum())
    of, said = prediction.sizes["case"], ""
    if wide:
        said += f"; doubtful in {wide} of {of}, where the contact reaches beyond {SMALL_STRAIN:g} ball radii"
    if beyond:
        said += f"; extrapolated in {beyond} of {of}, beyond the measured frequencies"
    return said


def _shift_numbers(tree: xr.DataTree) -> list[KeyNumber]:
    factors, law, reference = group(tree, "shift_factors"), group(tree, "shift_law"), reference_temperature(tree)
    if factors is None or law is None or reference is None:
        return []
    C1, C2, error1, error2 = (number(law.attrs, name) for name in ("wlf_C1", "wlf_C2", "wlf_C1_error", "wlf_C2_error"))
    if not math.isfinite(C1):
        return [KeyNumber("Shift law", str(law.attrs.get("told", "")), "")]
    used = "used"
    if str(factors.attrs.get("shift_used", "measured")) == "measured":
        used = "a summary: the measured shift factors are used"
    return [
        KeyNumber("WLF constant C₁", with_error(C1, error1), f"about {degrees(reference)}; {used}"),
        KeyNumber("WLF constant C₂", f"{with_error(C2, error2)} K", f"about {degrees(reference)}"),
    ]


def _modulus_numbers(tree: xr.DataTree) -> list[KeyNumber]:
    spectrum = group(tree, "spectrum")
    if spectrum is None:
        return []
    found = []
    for name, title in (("E0", "Modulus at rest E₀"), ("E_inf", "Glass modulus E∞")):
        value = number(spectrum.attrs, name)
        known = math.isfinite(value) and number(spectrum.attrs, f"{name}_at_limit") != 1.0
        remark = str(spectrum.attrs.get(f"{name}_remark", ""))
        found.append(KeyNumber(title, megapascals(value) if known else ABSENT, remark))
    return found


def captions(tree: xr.DataTree) -> dict[str, str]:
    """Say what each figure shows."""
    reference = reference_temperature(tree)
    at = "the reference temperature" if reference is None else degrees(reference)
    points = group(tree, "measurement") is not None
    made = is_synthetic(tree)
    measured = "synthetic measurement" if made else "measured"
    bars = f" Points: {measured}, with bars of one standard deviation over the repetitions." if points else ""
    # Only what was tested: a sentence of the study tells how the curves coincide, or that they do not overlap.
    told = (note for note in sentences(tree.attrs, "notes") if "overlap in reduced speed" in note)
    together = f" {readable(next(told, ''))}".rstrip() if points else ""
    return {
        "friction_against_speed": "Viscoelastic friction against speed. "
        f"Lines: predicted{_thin(tree, 'prediction')}{_shaded(tree, 'prediction')}.{bars}",
        "friction_master_curve": f"Viscoelastic friction against speed times shift factor, at {at}. Line: predicted "
        f"over the whole range{_thin(tree, 'prediction_master')}{_shaded(tree, 'prediction_master')}.{bars}{together}",
        "coulomb_friction": f"Coulomb friction against speed.{bars} It is measured, not predicted.",
        "friction_shift_factors": "Shift factors found from friction alone, by laying its curves over one another, "
        "beside those of the modulus; both with their standard errors.",
        "master_curve": f"Master curve of the storage (E′) and loss modulus (E″) at {at}: "
        f"{'synthetic' if made else 'measured'} readings, shifted, and the retardation spectrum fitted to them"
        f"{_banded(tree)}; below, what the spectrum leaves over.",
        "spectrum": "Retardation spectrum: the compliance of each mode over its retardation time.",
        "shift_factors": f"Shift factors {_origin(tree)}, and a law fitted to them.",
        "vertical_shift": "Vertical shift b of the modulus.",
        "superposition": "Loss angle against the size of the modulus (van Gurp–Palmen), and loss against storage "
        "modulus (Cole–Cole), which no shift along the frequency changes: where superposition holds, all temperatures "
        "lie on one line.",
        "isotherms": f"Storage and loss modulus {'of the synthetic sweeps' if made else 'as measured'}, one curve "
        "for each temperature.",
    }


def _origin(tree: xr.DataTree) -> str:
    """Say where the shift factors come from."""
    factors = group(tree, "shift_factors")
    origin = "found" if factors is None else str(factors.attrs.get("shift_origin", "found"))
    if origin == "given":
        return "that were given, not found on the sweeps"
    found = "found by laying the isotherms over one another, with their standard errors"
    return f"{found}; single ones were held at given values, without an error" if origin == "held" else found


def _banded(tree: xr.DataTree) -> str:
    spectrum = group(tree, "spectrum_curve")
    banded = spectrum is not None and "storage_modulus_lower" in spectrum
    return ", with the 95 % band of its modulus" if banded else ""


def _shaded(tree: xr.DataTree, name: str) -> str:
    """Say what the bands are, where there are any."""
    cases = group(tree, name)
    if cases is None or "friction_lower" not in cases.variables:
        return ""
    return ", with the 95 % band that the uncertainty of the rubber (sweeps, shift factors, spectrum) leaves"


def _thin(tree: xr.DataTree, name: str) -> str:
    cases = group(tree, name)
    return ", thin beyond the measured frequencies" if cases is not None and is_extrapolated(cases).any() else ""
