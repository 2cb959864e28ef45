"""Checks of a study's results, each with its verdict and the numbers behind it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from viscofric.checks import Check
from viscofric.contact.steady import SMALL_STRAIN
from viscofric.datasets import Dataset, DataTree
from viscofric.friction.assumption_check import assumption_checks_of
from viscofric.friction.intervals import consistency_check
from viscofric.notes import Note, by_reader, notes_in
from viscofric.report.results import (
    SHOWN_AS_ONE,
    group,
    interpolated,
    is_extrapolated,
    is_from_friction,
    is_rough,
    number,
    numbers,
    on_group,
    reach,
    rubbers,
    values,
)
from viscofric.report.sweeps import solved_cases
from viscofric.report.texts.numbers import degrees, percent, several, significant
from viscofric.rheology.spectra.quality import shown_range
from viscofric.study.results.results import beyond_accuracy


def all_checks(tree: DataTree) -> list[Check]:
    """Return every check that the results allow, in the order of the calculation."""
    found = list(rubber_checks(tree))
    for rubber, branch in rubbers(tree):
        found += [replace(check, name=f"{check.name} ({rubber})") for check in rubber_checks(branch)]
    return [*found, *friction_checks(tree)]


def counted(checks: list[Check]) -> str:
    """Say how many checks there are of each verdict: 12 checks: 2 warnings, 1 noted, 9 passed."""
    verdicts = ("failed", "warning", "noted", "passed")
    found = [(sum(check.verdict == verdict for check in checks), verdict) for verdict in verdicts]
    plural = {"warning": "warnings"}
    parts = ", ".join(f"{n} {plural.get(label, label) if n > 1 else label}" for n, label in found if n)
    return f"{len(checks)} check{'' if len(checks) == 1 else 's'}: {parts}." if checks else ""


def rubber_checks(tree: DataTree) -> Iterator[Check]:
    """Yield every check of the rubber that the results allow."""
    for part in (_isotherms, _superposition, _spectrum):
        yield from part(tree)


def _decades(rms: float) -> str:
    """Say an rms of log10 as a percentage."""
    return percent(10.0**rms - 1.0)


def _judged(name: str, words: str, value: float, attributes: Mapping[Any, Any], kind: str) -> Check:
    """Return a check with the verdict that the results hold, and the words with the limit for an ``@``."""
    holds, limit = (number(attributes, f"{kind}_{part}") for part in ("holds", "limit"))
    return Check.of(name, holds == 1.0, words.replace("@", f"rms; good if ≤ {_decades(limit)}"), value, limit)


@on_group("shift_factors", ())
def _isotherms(factors: Dataset, _: DataTree) -> Iterator[Check]:
    given, used = (number(factors.attrs, f"isotherms_{name}") for name in ("given", "used"))
    if not (math.isfinite(given) and math.isfinite(used)):
        return
    if used >= given:
        words = f"All {given:.0f} isotherms are joined into the master curve."
        yield Check("Isotherms used", "passed", Note("isotherms-used", words, values={"used": used, "given": given}))
        return
    kept = values(factors, "temperature")
    given_temperatures = numbers(factors.attrs, "temperatures_given")
    apart = [kelvin for kelvin in given_temperatures if np.min(np.abs(kept - kelvin)) > SHOWN_AS_ONE]
    left = [degrees(kelvin) for kelvin in apart]
    which = f"those at {several(left)} are left out" if len(left) > 1 else f"the one at {''.join(left)} is left out"
    if len(left) != given - used:
        which = "the others are left out"
    words = (
        f"{used:.0f} of {given:.0f} isotherms are joined into the master curve; {which} (reasons: notes on the input)."
    )
    counted = {"used": used, "given": given, "left_out": apart}
    yield Check("Isotherms used", "warning", Note("isotherms-used", words, values=counted))


@on_group("shift_factors", ())
def _superposition(factors: Dataset, tree: DataTree) -> Iterator[Check]:
    storage, loss = (number(factors.attrs, f"overlap_rms_log10_{name}") for name in ("storage", "loss"))
    step = number(factors.attrs, "overlap_rms_log10")
    pairs, apart = (number(factors.attrs, name) for name in ("neighbours", "neighbours_without_overlap"))
    without = f" {apart:.0f} of {pairs:.0f} neighbours do not overlap at all." if apart > 0 else ""
    name = "Overlap of the isotherms"
    if math.isfinite(storage) and math.isfinite(loss):
        words = f"Where shifted isotherms overlap they differ by {_decades(storage)} in the storage and "
        words += f"{_decades(loss)} in the loss modulus (@).{without}"
        yield _judged(name, words, max(storage, loss), factors.attrs, "overlap")
    if math.isfinite(step):
        words = f"Where shifted tests overlap they differ by {_decades(step)} (@).{without}"
        yield _judged(name, words, step, factors.attrs, "overlap")
    yield from _law(tree, str(factors.attrs.get("shift_used", "measured")) == "measured")
    whole = group(tree, "superposition")
    if whole is not None:
        said = notes_in(whole.attrs, "sentences")
        code = said[0].code if said else ""
        words = Note(code, "", remedy=by_reader(lambda reader: " ".join(one.words(reader) for one in said)))
        holds, roughly = (number(whole.attrs, name) == 1.0 for name in ("holds", "roughly"))
        fails = whole.attrs.get("verdict", "roughly" if roughly else "fails") == "fails"
        yield Check("Superposition", "passed" if holds else "failed" if fails else "warning", words)
        if whole.attrs.get("causality"):
            belong = number(whole.attrs, "consistent") == 1.0
            yield Check.of("Storage against loss modulus", belong, str(whole.attrs["causality"]))


def _law(tree: DataTree, measured_used: bool) -> Iterator[Check]:
    law = group(tree, "shift_law")
    rms = math.nan if law is None else number(law.attrs, "rms")
    if law is None or not math.isfinite(rms):
        return
    apart = "less than 0.001" if rms < 1e-3 else significant(rms, 2)
    far = f"The shift factors lie {apart} decades (rms) from the {law.attrs.get('law', 'fitted')} law"
    if measured_used:
        words = f"{far}; the measured shift factors are used, not this law."
        yield Check("Shift law", "noted", words)
    else:
        holds, limit = (number(law.attrs, f"misfit_{part}") for part in ("holds", "limit"))
        words = f"{far} that is used (good if ≤ {limit:g})."
        yield Check.of("Shift law", holds == 1.0, words, rms, limit)


def _spectrum(tree: DataTree) -> Iterator[Check]:
    steps = group(tree, "step_master_curve")
    if steps is not None and math.isfinite(step := number(steps.attrs, "rms_log10_step")):
        words = f"The spectrum lies {_decades(step)} from the measured response (@)."
        yield _judged("Fit of the spectrum", words, step, steps.attrs, "misfit")
    curve = group(tree, "master_curve")
    if curve is None:
        return
    storage, loss = (number(curve.attrs, f"rms_log10_{name}") for name in ("storage", "loss"))
    if math.isfinite(storage) and math.isfinite(loss):
        words = f"The spectrum lies {_decades(storage)} from the measured storage and {_decades(loss)} from the "
        words += "measured loss modulus (@)."
        yield _judged("Fit of the spectrum", words, max(storage, loss), curve.attrs, "misfit")


#: What a comparison with friction is worth where the rubber comes from friction.
CIRCULAR = Note(
    "identified-from-friction",
    "The material was itself identified from friction; if from this friction, the comparison tests nothing.",
)
# Largest values that are good
_COMPLEMENTARITY = 1e-6  # over the indentation, or the rms height; contacts are solved to less
# Probability of differences as large, below which two sets of shift factors are not the same
_LIKELY = 0.05
# How far apart, in units of the accuracy, friction from the pressure and from the dissipation may be.
_ENERGY_BALANCE = 5.0
# What `viscofric.friction.assumptions` judges -> how the report calls it.
_ASSUMPTIONS = {
    "half-space": "Half-space",
    "linearity": "Linear viscoelasticity",
    "uncoupled": "Pressure independent of shear",
    "quasi-static": "No inertia",
    "one temperature": "Isothermal",
}


def friction_checks(tree: DataTree) -> Iterator[Check]:
    """Yield every check of friction that the results allow, in the order of the calculation."""
    parts = (_contact, _small_strain, _assumptions, _frequencies, _measurement, _friction_shifts, _cases)
    for part in parts:
        yield from part(tree)


def _predictions(tree: DataTree) -> list[Dataset]:
    """Return the solved cases: those requested, and those along the friction master curve."""
    names = ("prediction", "prediction_master")
    return [part for name in names if (part := solved_cases(tree, name)) is not None]


def _contact(tree: DataTree) -> Iterator[Check]:
    parts = _predictions(tree)
    if not parts:
        return

    def largest(name: str) -> float:
        sizes = np.abs(np.concatenate([values(part, name) for part in parts]))
        sizes = sizes[np.isfinite(sizes)]
        return float(sizes.max()) if sizes.size else math.nan

    accuracy = number(tree.attrs, "accuracy")
    energy = largest("energy_balance")
    if math.isfinite(energy):
        limit = _ENERGY_BALANCE * (accuracy if math.isfinite(accuracy) else 1e-3)
        yield Check.of(
            "Energy balance",
            energy <= limit * (1.0 + 1e-9),
            "Friction is calculated twice: from the contact pressure, and from the energy dissipated in the material. "
            f"The two differ by {percent(energy)} at most (good if ≤ {percent(limit)}, {_ENERGY_BALANCE:g} times "
            "the requested accuracy). The reported value is at least as accurate as the better one.",
            energy,
            limit,
        )
    violation = largest("complementarity")
    if math.isfinite(violation):
        yield Check.of(
            "Contact conditions",
            violation <= _COMPLEMENTARITY,
            f"No overlap, no suction, no pressure across a gap: violated by {significant(violation, 2)} of the "
            f"{'rms height' if is_rough(tree) else 'indentation'} at most (good if ≤ "
            f"{significant(_COMPLEMENTARITY, 1)}).",
            violation,
            _COMPLEMENTARITY,
        )


def _small_strain(tree: DataTree) -> Iterator[Check]:
    parts = _predictions(tree)
    if not parts or is_rough(tree):
        return
    reaches = np.concatenate([reach(tree, part) for part in parts])
    reaches = reaches[np.isfinite(reaches)]
    if not reaches.size:
        words = (
            "Could not be checked: the results do not contain the radius of the indenter, or the size of its contact."
        )
        yield Check("Small strain", "noted", words)
        return
    wide = int(np.sum(reaches > SMALL_STRAIN))
    along = " (those requested, and those along the friction master curve)" if len(parts) > 1 else ""
    many = f" This concerns {wide} of {reaches.size} cases{along}, marked in the tables." if wide else ""
    yield Check.of(
        "Small strain",
        wide == 0,
        f"The contact extends to {significant(float(reaches.max()), 2)} of the indenter's radius from its axis at "
        f"most; above {SMALL_STRAIN:g} the linear theory of a half-space is doubtful.{many}",
        float(reaches.max()),
        SMALL_STRAIN,
    )


@on_group("assumptions", ())
def _assumptions(found: Dataset, _: DataTree) -> Iterator[Check]:
    for check in assumption_checks_of(found):
        if check.name in _ASSUMPTIONS:  # the others are those of small strain, which counts the cases
            yield replace(check, name=_ASSUMPTIONS[check.name])


def _frequencies(tree: DataTree) -> Iterator[Check]:
    counts, outside, cases = [], 0, {}
    for name, what in (
        ("prediction", "requested cases"),
        ("measurement", "measured points"),
        ("prediction_master", "cases along the friction master curve"),
    ):
        part = group(tree, name) if name == "measurement" else solved_cases(tree, name)
        if part is None or "within_measured_frequencies" not in part:
            continue
        beyond, of = int(is_extrapolated(part).sum()), next(iter(part.sizes.values()))
        outside += beyond
        counts.append(f"{beyond} of {of} {what}")
        cases[name] = [beyond, of]
    if not counts:
        return
    ends, gaps = (numbers(tree.attrs, f"frequency_{name}") for name in ("range", "gaps"))
    pairs = tuple(zip(gaps[::2], gaps[1::2], strict=True))
    measured = f" ({shown_range((ends[0], ends[1]), pairs)} at the reference temperature)" if len(ends) == 2 else ""
    kind = "identified" if is_from_friction(tree) else "measured"
    meaning, some, each = "frequency of the contact (shift factor times speed over half its length)", "the", "the"
    if is_rough(tree):
        meaning, some, each = (
            "frequency of the surface's waves (2π times shift factor times speed over length)",
            "some",
            "each",
        )
    if outside:
        words = (
            f"In {several(counts)}, {some} {meaning} lies outside the {kind} range{measured}; friction there depends "
            f"on the extrapolated {'or interpolated ' if gaps else ''}spectrum. These cases are marked in the tables."
        )
    else:
        words = f"In all cases {each} {meaning} lies within the {kind} range{measured}."
    counted = {**cases, "range": ends} | ({"gaps": gaps} if gaps else {})
    yield Check.of("Measured frequency range", outside == 0, Note("frequency-range", words, values=counted))


@on_group("measurement", ())
def _measurement(measurement: Dataset, _: DataTree) -> Iterator[Check]:
    freedom = values(measurement, "viscoelastic_freedom") if "viscoelastic_freedom" in measurement else None
    check = consistency_check(values(measurement, "consistency"), values(measurement, "consistency_error"), freedom)
    if check is not None:
        yield consistency_shown(check)


def consistency_shown(check: Check) -> Check:
    """Return the check of `FrictionCurves.consistency_check` in a whole sentence."""
    words = f"The residual of the four sign configurations, which should vanish, is {check}."
    return replace(check, name="Consistency of the four configurations", sentence=words)


@on_group("friction_shift_factors", ())
def _friction_shifts(found: Dataset, tree: DataTree) -> Iterator[Check]:
    likely = number(found.attrs, "p_value") >= _LIKELY
    sentence = str(found.attrs.get("sentence", ""))
    if is_from_friction(tree):
        yield Check("Shift factors from friction", "noted", f"{sentence} {CIRCULAR}")
    else:
        yield Check.of("Shift factors from friction", likely, sentence)


@on_group("prediction", ())
def _cases(found: Dataset, tree: DataTree) -> Iterator[Check]:
    failures = notes_in(tree.attrs, "failures")
    if failures:
        many = f"{len(failures)} cases" if len(failures) > 1 else "One case"
        words = f"{many} could not be solved; the reasons are listed with the results."
        yield Check("All cases solved", "failed", Note("not-solved", words, values={"cases": len(failures)}))
    else:
        yield Check("All cases solved", "passed", "Every case was solved.")
    cases, accuracy = solved_cases(tree), number(tree.attrs, "accuracy")
    if cases is not None and math.isfinite(accuracy) and "friction_error" in cases:
        yield _accuracy(cases, accuracy, is_rough(tree))


def _accuracy(cases: Dataset, accuracy: float, rough: bool) -> Check:
    """Judge the numerical errors of friction by the requested accuracy."""
    beyond, between = int(beyond_accuracy(cases, accuracy).sum()), int(interpolated(cases).sum())
    friction, error = (np.abs(values(cases, name)) for name in ("friction_coefficient", "friction_error"))
    known = friction > 0.0
    largest = float(np.max(error[known] / friction[known], initial=0.0))
    worst = percent(largest)
    words = f"The numerical error of friction is estimated at {worst} at most; {percent(accuracy)} was requested."
    if beyond:
        why = " The points of the surface are too far apart for it." if rough else ""
        words += f" It is larger than requested in {beyond} of {friction.size} cases.{why}"
    if between:
        words += (
            f" {between} of {friction.size} friction coefficients are interpolated on a curve through solved contacts, "
            "which is common to the cases of one material and load. They are marked in the tables, and their errors "
            "include that of the interpolation."
        )
    counted = {"largest": largest, "requested": accuracy, "beyond": beyond, "interpolated": between}
    return Check.of("Accuracy", beyond == 0, Note("accuracy", words, values={**counted, "of": friction.size}))
