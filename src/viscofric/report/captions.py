"""What each figure shows, in a sentence or two."""

from __future__ import annotations

import math

import numpy as np

from viscofric.datasets import Dataset, DataTree
from viscofric.notes import notes_in
from viscofric.report.figures.contacts import shown_contacts
from viscofric.report.figures.heating import MOST_PANELS as HEATED
from viscofric.report.figures.histories import MOST_LINES as HISTORIES
from viscofric.report.figures.maps import MARKED_TEMPERATURES, known_shifts
from viscofric.report.figures.sweeps import numerical_error, panel_count
from viscofric.report.results import (
    group,
    interpolated,
    is_extrapolated,
    is_rough,
    is_synthetic,
    on_group,
    reference_temperature,
    rubbers,
)
from viscofric.report.sweeps import (
    MOST_LINES,
    MOST_PANELS,
    SAMPLE,
    SEED,
    layout_of,
    predicted_axes,
    seeds_averaged,
    solved_cases,
    words_of_band,
)
from viscofric.report.texts.numbers import degrees, prefixed, speed


def captions(tree: DataTree) -> dict[str, str]:
    """Say what each figure shows."""
    said = _captions(tree)
    for place, (rubber, branch) in enumerate(rubbers(tree), 1):
        said |= {f"{name}_{place}": f"{rubber}. {caption}" for name, caption in _captions(branch).items()}
    return said


def _captions(tree: DataTree) -> dict[str, str]:
    reference = reference_temperature(tree)
    at = "the reference temperature" if reference is None else degrees(reference)
    points = group(tree, "measurement") is not None
    made = is_synthetic(tree)
    measured = "synthetic measurement" if made else "measured"
    bars = f" Points: {measured}, with bars of one standard deviation over the repetitions." if points else ""
    # A note of the study says how the curves coincide, or that they do not overlap.
    tested = (note for note in notes_in(tree.attrs, "notes") if note.code in ("curves-coincide", "curves-apart"))
    together = f" {next(tested, '')}".rstrip() if points else ""
    return {
        "friction_against_speed": "Viscoelastic friction against speed. "
        f"Lines: predicted{_thin(tree, 'prediction')}{_shaded(tree, 'prediction')}.{bars}",
        "friction_master_curve": f"Viscoelastic friction against speed times shift factor, at {at}. Line: predicted "
        f"over the whole range{_thin(tree, 'prediction_master')}{_shaded(tree, 'prediction_master')}.{bars}{together}",
        "friction_sweep": _of_sweep(tree),
        "friction_map": _of_map(tree),
        "coulomb_friction": f"Coulomb friction against speed.{bars}",
        "shear_stress": f"Shear stress of the interface against slip speed times shift factor: {measured} Coulomb "
        "friction times the mean pressure of the solved contact, with bars of one standard error. Line: the law fitted "
        "to it, with its 95 % band.",
        "friction_parts": "Predicted friction against speed, with its parts: hysteresis of the material, and shear "
        "stress of the interface on the predicted contact area. Bars: 95 % interval of the total.",
        "heated_friction": "Contacts that their own friction heats: viscoelastic friction against speed, beside the "
        f"isothermal one, and the rise of temperature with its parts, all predicted.{_few_heated(tree)} Where two "
        "states are stable, a rising speed follows the cold ones and a falling speed the hot ones.",
        "heated_parts": "Predicted friction with heating against speed, with its parts: hysteresis of the material, "
        f"and {'Coulomb friction as given' if _heat_of(tree) == 'given' else 'shear stress of the interface'}"
        f".{_few_heated(tree)}",
        "temperature_map": _of_temperature_map(tree),
        "friction_shift_factors": "Shift factors from friction alone, by superposition of its curves, "
        "and those of the modulus, with their standard errors.",
        "ramps": "Left: storage (filled) and loss modulus (open) as measured, against the temperature, at each "
        "frequency. Right: tan δ, with the temperature of its peak and the standard error.",
        "master_curve": f"Master curve of the storage (E′) and loss modulus (E″) at {at}: "
        f"{'synthetic' if made else 'measured'} readings, shifted, and the retardation spectrum fitted to them"
        f"{_banded(tree)}; below, the residuals.",
        "step_master_curve": f"Master curve of {'synthetic' if made else 'measured'} creep or relaxation tests over "
        f"reduced time at {at}, with the response of the retardation spectrum fitted to them.",
        "spectrum": "Retardation spectrum: compliance of each mode against its retardation time.",
        "shift_factors": f"Shift factors {_origin(tree)}, and a law fitted to them.",
        "vertical_shift": "Vertical shift b of the modulus.",
        "superposition": "Loss angle against the magnitude of the modulus (van Gurp–Palmen), and loss against storage "
        "modulus (Cole–Cole). A shift along the frequency changes neither: if superposition holds, all temperatures "
        "lie on one line.",
        "isotherms": f"Storage and loss modulus {'of the synthetic sweeps' if made else 'as measured'}, one curve "
        "for each temperature.",
        "contacts_over_time": _of_histories(tree),
        "impacts": _of_impacts(tree),
        "contacts": _of_contacts(tree),
        "convergence": _of_convergence(tree),
    }


def _heat_of(tree: DataTree) -> str:
    heating = group(tree, "heating")
    return "" if heating is None else str(heating.attrs["heat_of"])


def _few_heated(tree: DataTree) -> str:
    """Say how many of the heated curves are drawn, if not all."""
    heating = group(tree, "heating")
    count = 1 if heating is None else math.prod(n for name, n in heating.sizes.items() if name not in ("speed", SAMPLE))
    return f" {HEATED} of {count} curves are drawn." if count > HEATED else ""


@on_group("temperature_map", "")
def _of_temperature_map(data: Dataset, _: DataTree) -> str:
    at = f"{degrees(float(data.attrs['temperature']))}, {speed(float(data.attrs['speed']))}"
    seen = "along the motion" if data.sizes["y"] == 1 else "seen from above, and on the centre line"
    return (
        f"Rise of temperature of the rubber's face at the warmest contact ({at}), predicted, {seen}; the indenter "
        "moves to the right. Friction counts with one mean temperature."
    )


def _of_sweep(tree: DataTree) -> str:
    """Say what runs along the axis, what the lines and the panels are, and what was left out."""
    friction = group(tree, "prediction")
    layout = None if friction is None else layout_of(friction)
    if friction is None or layout is None:
        return ""
    said = f"Predicted viscoelastic friction against {layout.along.title}"
    if layout.lines is not None:
        said += f", one line for each {layout.lines.title}"
        if len(layout.lines) > MOST_LINES:
            said += f" ({MOST_LINES} of {len(layout.lines)} are drawn)"
    if layout.panels:
        shown, count = panel_count(layout.panels, MOST_PANELS)
        said += f", one panel for each {' and each '.join(axis.title for axis in layout.panels)}"
        said += f" ({shown} of {count} are drawn)" if shown < count else ""
    if seeds := seeds_averaged(friction):
        said += (
            f". Mean over {seeds} seeds of the surface, which are the thin lines; bands: the 95 % interval of the "
            "mean, by Student's t over the seeds"
        )
    elif "sample" in friction["friction_coefficient"].dims:
        said += f"; bands: {words_of_band(friction, 'friction_coefficient')} of the uncertainty samples of the material"
    elif "friction_lower" in friction:
        said += "; bands: 95 %, from the uncertainty of the material"
    solved = np.isfinite(friction["friction_coefficient"].values).all()
    said += "; bars: numerical error" if np.isfinite(numerical_error(friction)).any() else ""
    missing = "" if solved else f" Crosses: not solved{', for one seed or more' if seeds else ''}."
    return f"{said}.{missing}"


@on_group("history", "")
def _of_histories(data: Dataset, _: DataTree) -> str:
    """Say what is drawn over time, and how many cases are left out."""
    before = {"untouched": "untouched material", "at rest": "a contact at rest", "sliding": "steady sliding"}
    begun = before.get(str(data.attrs["before"]))
    words = "One period of contacts in their periodic state" if begun is None else f"Contacts over time, from {begun}"
    warm = ", at the temperature of their own friction (dotted: without heating)" if "temperature_rise" in data else ""
    return words + warm + _some(data, "time", data.sizes["instant"])


@on_group("impact", "")
def _of_impacts(data: Dataset, _: DataTree) -> str:
    """Say what falls, and how many lines are left out."""
    each = max(data.sizes["impact_speed"], data.sizes.get("temperature", 1))
    mass = prefixed(1e3 * float(data.attrs["mass"]), None, "g")
    return f"Restitution of impacts of {mass}{_some(data, 'restitution', each)}"


def _some(data: Dataset, name: str, each: int) -> str:
    """Say how many of the cases are drawn, and what their bands are; ends the sentence."""
    samples = data.sizes.get("sample", 1)
    count = data[name].size // each // samples
    some = f" ({HISTORIES} of {count} cases are drawn)" if count > HISTORIES else ""
    if samples == 1:
        return f"{some}."
    return f"{some}; bands: {words_of_band(data, name)} of the uncertainty samples of the material."


def _of_map(tree: DataTree) -> str:
    friction = group(tree, "prediction")
    seeds = 0 if friction is None else seeds_averaged(friction)
    mapped = {*_MAPPED, SEED} if seeds else set(_MAPPED)
    others = [axis for axis in predicted_axes(tree) if axis.name not in mapped]
    said = "Predicted viscoelastic friction over speed and temperature"
    said += f", mean over {seeds} seeds of the surface" if seeds else ""
    said += f", one panel for each {' and each '.join(axis.title for axis in others)}" if others else ""
    said += ". Diamonds: speed of the highest friction at each temperature, if it lies inside the range. "
    said += "Between the solved speeds and temperatures the colours are interpolated"
    said += ", from one temperature to the next along α(T)·v." if any(known_shifts(tree)) else "."
    if friction is not None and friction.sizes.get("temperature", 0) <= MARKED_TEMPERATURES:
        said += " Dotted lines: the solved temperatures."
    if group(tree, "measurement") is not None:
        said += " Circles: where friction was measured."
    if friction is not None and not np.isfinite(friction["friction_coefficient"].values).all():
        said += " Crosses: not solved."
    return said


_MAPPED = ("speed", "temperature")


def _of_contacts(tree: DataTree) -> str:
    shown = shown_contacts(tree)
    if not shown:
        return ""
    is_line = shown[0].is_line
    if is_rough(tree):
        return _of_rough_contacts(is_line)
    seen = f"seen from above, and on the centre line{' below' if len(shown) > 1 else ''}"
    marks = "" if is_line else " (cross: the axis; dot: the centre of pressure)"
    return (
        f"Contact pressure {'along the motion' if is_line else seen}. The indenter moves to the right{marks}. The "
        "pressure is higher at the leading edge: its centre lies ahead of the indenter's axis, which causes the "
        "friction. Dotted: the profile's mirror image."
    )


def _of_rough_contacts(is_line: bool) -> str:
    seen = "along a whole period of the profile" if is_line else "on a whole period of the surface, seen from above"
    blank = "Blank: no contact" if not is_line else "Zero: no contact"
    arrow = "" if is_line else "; the arrow shows the motion of the surface"
    return f"Contact pressure {seen}. {blank}{arrow}."


def _of_convergence(tree: DataTree) -> str:
    cases = solved_cases(tree)
    between = 0 if cases is None else int(interpolated(cases).sum())
    said = (
        "Numerical accuracy of the cases: estimated discretisation error of friction, and difference of friction from "
        "the pressure and from the dissipated energy, both relative to the friction coefficient"
    )
    if cases is None or not between:
        return f"{said}. Below: cells along the longer edge of the finest grid."
    return (
        f"{said}. {between} of {cases.sizes['case']} values (open marks) are interpolated between solved contacts "
        "(interpolation error included). Below: cells along the longer edge of the finest grid, for the solved cases."
    )


def _origin(tree: DataTree) -> str:
    """Say where the shift factors come from."""
    factors = group(tree, "shift_factors")
    origin = "found" if factors is None else str(factors.attrs.get("shift_origin", "found"))
    if origin == "given":
        return "that were given, not fitted to the sweeps"
    by = "both" if factors is None else str(factors.attrs.get("shifted_by", "both"))
    alone = {"storage": " by E' alone", "loss": " by E'' alone", "loss-tangent": " by tan δ alone"}.get(by, "")
    found = f"from the superposition of the isotherms{alone}, with their standard errors"
    return f"{found}; some were fixed at given values, without an error" if origin == "held" else found


def _banded(tree: DataTree) -> str:
    spectrum = group(tree, "spectrum_curve")
    banded = spectrum is not None and "storage_modulus_lower" in spectrum
    return ", with the 95 % band of its modulus (grey: extrapolated, beyond what was measured)" if banded else ""


def _shaded(tree: DataTree, name: str) -> str:
    """Say what the bands are, where there are any."""
    cases = solved_cases(tree, name)
    if cases is None or "friction_lower" not in cases.variables:
        return ""
    return ", with the 95 % band from the uncertainty of the material (sweeps, shift factors, spectrum)"


def _thin(tree: DataTree, name: str) -> str:
    cases = solved_cases(tree, name)
    return (
        ", thin where extrapolated beyond the measured frequencies"
        if cases is not None and is_extrapolated(cases).any()
        else ""
    )
