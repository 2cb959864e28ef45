"""What came out, in key numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.contact.steady import SMALL_STRAIN
from viscofric.notes import Note
from viscofric.report.doubts import is_extrapolated, is_wide
from viscofric.report.house_style import degrees
from viscofric.report.numbers import (
    ABSENT,
    megapascals,
    percent,
    short,
    signed_percent,
    typeset,
    with_error,
)
from viscofric.report.results import (
    group,
    is_from_friction,
    number,
    reference_temperature,
    rubbers,
    values,
)
from viscofric.report.sweeps import solved_cases

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from viscofric.arrays import Array


#: Name of the key number that compares prediction and measurement.
AGREEMENT = "Prediction less measurement"
_MOST_RUBBERS = 4
_SHOWN_PLACES = 6


class KeyNumber(NamedTuple):
    """A number worth a frame: its name, the number, and a remark."""

    name: str
    value: str
    remark: str


def _range(numbers: Array, digits: int = 3) -> str:
    low, high = short(float(np.nanmin(numbers)), digits), short(float(np.nanmax(numbers)), digits)
    return low if low == high else f"{low} to {high}"


def key_numbers(tree: xr.DataTree) -> list[KeyNumber]:
    """Return the answer's most important numbers."""
    found = [*_friction_numbers(tree), *_shift_numbers(tree), *_modulus_numbers(tree)]
    for rubber, branch in rubbers(tree)[:_MOST_RUBBERS]:
        found += [item._replace(name=f"{item.name}, {rubber}") for item in _modulus_numbers(branch)]
    return found


def _friction_numbers(tree: xr.DataTree) -> list[KeyNumber]:
    found = []
    prediction, agreement = solved_cases(tree), group(tree, "agreement")
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
        found.append(KeyNumber(AGREEMENT, percent(rms), remark))
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


def grouped_failures(failures: Sequence[Note], most: int) -> list[str]:
    """Return failures as at most so many lines: those of one reason together, with their cases.

    Parameters
    ----------
    failures : sequence of Note
        Their places are the cases; those of one code, or without any of one text, have one reason.
    most : int
        Lines at most; the last one says how many failures are not shown, if there are more kinds.
    """
    kinds: dict[str, list[Note]] = {}
    for failure in failures:
        kinds.setdefault(failure.code or failure.text, []).append(failure)
    shown = list(kinds.values())
    if len(shown) > most:
        shown = shown[: most - 1]
    left = len(failures) - sum(map(len, shown))
    return [*map(_line, shown), *([f"{left} more cases, for other reasons: see the report."] if left else [])]


def _line(cases: list[Note]) -> str:
    places = [one.where for one in cases if one.where]
    if len(cases) == 1 or not places:
        return (f"{len(cases)} times: " if len(cases) > 1 else "") + typeset(cases[0])
    more = f"; and {len(places) - _SHOWN_PLACES} more" if len(places) > _SHOWN_PLACES else ""
    reason = Note(cases[0].code, cases[0].text, remedy=cases[0].remedy).words("run_file")
    return typeset(f"{len(cases)} cases ({'; '.join(places[:_SHOWN_PLACES])}{more}): {reason}")
