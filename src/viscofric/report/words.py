"""What was asked and what came out, in sentences and key numbers, and what each figure shows."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.report.house_style import degrees
from viscofric.report.numbers import (
    ABSENT,
    megapascals,
    percent,
    several,
    short,
    signed_percent,
    with_error,
)
from viscofric.report.results import group, nominal_temperatures, number, reference_temperature, values

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


# Space between a number and its unit, where a line should not break
_BEFORE_UNIT = re.compile(r"(?<=\d) (?=°C|N\b|mm|rad/s|%)")


class KeyNumber(NamedTuple):
    """A number worth a frame: its name, the number, and a remark."""

    name: str
    value: str
    remark: str


def _range(numbers: Array, digits: int = 3) -> str:
    low, high = short(float(np.nanmin(numbers)), digits), short(float(np.nanmax(numbers)), digits)
    return low if low == high else f"{low} to {high}"


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
            f"under {short(number(attrs, 'load'))} N, at {_range(1e3 * values(prediction, 'speed'))} mm/s "
            f"and {at}, to an accuracy of {short(100 * number(attrs, 'accuracy'))} %."
        )
    if sweeps is not None:
        steps = [degrees(float(kelvin)) for kelvin in nominal_temperatures(values(sweeps, "temperature"))]
        at = f"{len(steps)} temperatures from {steps[0]} to {steps[-1]}" if len(steps) > 1 else steps[0]
        said.append(
            f"The rubber is known from dynamic mechanical analysis in {attrs.get('deformation', 'tension')}: "
            f"frequency sweeps at {at}, {_range(values(sweeps, 'angular_frequency'))} rad/s. "
            f"Poisson's ratio is taken as {short(number(attrs, 'poisson_ratio'))}."
        )
    measurement = group(tree, "measurement")
    if measurement is not None:
        said.append(
            f"The prediction is compared with {measurement.sizes['point']} measured points, at which the "
            "viscoelastic and the Coulomb friction were separated; nothing of the measured friction enters "
            "the prediction."
        )
    return [_BEFORE_UNIT.sub("\N{NO-BREAK SPACE}", sentence) for sentence in said]


def key_numbers(tree: xr.DataTree) -> list[KeyNumber]:
    """Return the answer's most important numbers."""
    return [*_friction_numbers(tree), *_shift_numbers(tree), *_modulus_numbers(tree)]


def _friction_numbers(tree: xr.DataTree) -> list[KeyNumber]:
    found = []
    prediction, agreement = group(tree, "prediction"), group(tree, "agreement")
    if prediction is not None and np.isfinite(values(prediction, "friction_coefficient")).any():
        friction = values(prediction, "friction_coefficient")
        found.append(
            KeyNumber("Viscoelastic friction coefficient", _range(friction), "predicted, over all cases asked for")
        )
    if agreement is not None:
        bias, rms, points = (number(agreement.attrs, name) for name in ("bias", "rms", "points"))
        remark = f"rms over {points:.0f} points; {signed_percent(bias)} on average" if math.isfinite(points) else ""
        for name, meaning in (
            ("share_within_scatter", "within the measured scatter"),
            ("share_within_error", "within twice the standard error"),
        ):
            if math.isfinite(number(agreement.attrs, name)):
                remark += f"; {percent(number(agreement.attrs, name), 3)} of the points {meaning}"
        found.append(KeyNumber("Prediction less measurement", percent(rms), remark))
    return found


def _shift_numbers(tree: xr.DataTree) -> list[KeyNumber]:
    factors, reference = group(tree, "shift_factors"), reference_temperature(tree)
    if factors is None or reference is None:
        return []
    C1, C2, error1, error2 = (
        number(factors.attrs, name) for name in ("wlf_C1", "wlf_C2", "wlf_C1_error", "wlf_C2_error")
    )
    if not math.isfinite(C1):
        return []
    used = "used in the prediction"
    if str(factors.attrs.get("shift_used", "measured")) != "wlf":
        used = "a summary: the prediction uses the measured shift factors"
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
        beyond = number(spectrum.attrs, f"{name}_extrapolated") == 1.0
        remark = "extrapolated: beyond what the sweeps reach" if beyond else "reached by the sweeps"
        found.append(KeyNumber(title, megapascals(value) if math.isfinite(value) else ABSENT, remark))
    return found


def captions(tree: xr.DataTree) -> dict[str, str]:
    """Say what each figure shows."""
    reference = reference_temperature(tree)
    at = "the reference temperature" if reference is None else degrees(reference)
    measured = group(tree, "measurement") is not None
    bars = " Points: measured, with bars of one standard deviation over the repetitions." if measured else ""
    together = " They fall on one curve if friction obeys the shift factors of the modulus." if measured else ""
    return {
        "friction_against_speed": f"Viscoelastic friction against speed. Lines: predicted.{bars}",
        "friction_master_curve": f"Viscoelastic friction against speed times shift factor, at {at}. "
        f"Line: predicted over the whole range.{bars}{together}",
        "master_curve": f"Master curve of the storage (E′) and loss modulus (E″) at {at}: measured readings, "
        "shifted, and the retardation spectrum fitted to them.",
        "shift_factors": "Shift factors found by laying the isotherms over one another, with their standard "
        "errors, and the WLF law fitted to them.",
        "isotherms": "Storage and loss modulus as measured, one curve for each temperature.",
    }
