"""What was checked in a study, with its verdict and the numbers behind it, in words."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from viscofric.contact.steady import SMALL_STRAIN
from viscofric.report.doubts import is_extrapolated, knows_range, reach
from viscofric.report.friction_summary import CONSISTENT_WITHIN, consistency_words
from viscofric.report.house_style import degrees
from viscofric.report.numbers import percent, several, significant
from viscofric.report.results import SAME_TEMPERATURE, group, number, numbers, sentences, values

if TYPE_CHECKING:
    from collections.abc import Iterator

    import xarray as xr

# What still counts as sound
_OVERLAP = 0.05  # decades of modulus, rms, of the isotherms over one another
_FIT = 0.05  # decades of modulus, rms, of the spectrum from the master curve
_LAW = 0.1  # decades of α, rms
_COMPLEMENTARITY = 1e-6  # over the indentation
_CONSISTENT = 0.9  # share of the points whose configurations agree within two standard errors
# How far apart, in units of the accuracy, friction from the pressure and from the dissipation may be.
_ENERGY_BALANCE = 5.0


@dataclass(frozen=True)
class Check:
    """One check: its name, whether it passed, and a sentence with the numbers."""

    name: str
    verdict: Literal["passed", "noted", "look at this", "failed"]
    words: str


def all_checks(tree: xr.DataTree) -> list[Check]:
    """Return every check that the results allow, in the order of the calculation."""
    parts = (_isotherms, _superposition, _spectrum, _contact, _small_strain, _frequencies, _measurement, _cases)
    return [check for part in parts for check in part(tree)]


def _check(name: str, sound: bool, words: str) -> Check:
    return Check(name, "passed" if sound else "look at this", words)


def _decades(rms: float) -> str:
    """Say an rms of log10 as a percentage."""
    return percent(10.0**rms - 1.0)


def _isotherms(tree: xr.DataTree) -> Iterator[Check]:
    factors = group(tree, "shift_factors")
    if factors is None:
        return
    given, used = (number(factors.attrs, f"isotherms_{name}") for name in ("given", "used"))
    if not (math.isfinite(given) and math.isfinite(used)):
        return  # results of an older viscofric
    if used >= given:
        yield Check("Isotherms used", "passed", f"All {given:.0f} isotherms are joined into the master curve.")
        return
    kept = values(factors, "temperature")
    left = [
        degrees(kelvin)
        for kelvin in numbers(factors.attrs, "temperatures_given")
        if np.min(np.abs(kept - kelvin)) > SAME_TEMPERATURE
    ]
    which = f", those at {several(left)} are not" if len(left) > 1 else f", the one at {''.join(left)} is not"
    known = len(left) == given - used
    yield Check(
        "Isotherms used",
        "look at this",
        f"{used:.0f} of {given:.0f} isotherms are joined into the master curve{which if known else ''}; the notes "
        "on the input say why.",
    )


def _superposition(tree: xr.DataTree) -> Iterator[Check]:
    factors = group(tree, "shift_factors")
    if factors is None:
        return
    storage, loss = (number(factors.attrs, f"overlap_rms_log10_{name}") for name in ("storage", "loss"))
    pairs, apart = (number(factors.attrs, name) for name in ("neighbours", "neighbours_without_overlap"))
    if math.isfinite(storage) and math.isfinite(loss):
        yield _check(
            "Overlap of the isotherms",
            max(storage, loss) <= _OVERLAP and not apart > 0,
            f"Where shifted isotherms overlap they differ by {_decades(storage)} in the storage and "
            f"{_decades(loss)} in the loss modulus (rms; up to {_decades(_OVERLAP)} counts as sound)."
            + (f" {apart:.0f} of {pairs:.0f} neighbours do not overlap at all." if apart > 0 else ""),
        )
    yield from _law(tree, str(factors.attrs.get("shift_used", "measured")) == "measured")
    whole = group(tree, "superposition")
    if whole is not None:
        words = " ".join(sentences(whole.attrs, "sentences"))
        holds, roughly = (number(whole.attrs, name) == 1.0 for name in ("holds", "roughly"))
        yield Check("Superposition", "passed" if holds else "look at this" if roughly else "failed", words)
        if whole.attrs.get("causality"):
            belong = number(whole.attrs, "consistent") == 1.0
            yield _check("Storage against loss modulus", belong, str(whole.attrs["causality"]))


def _law(tree: xr.DataTree, measured_used: bool) -> Iterator[Check]:
    law = group(tree, "shift_law")
    rms = math.nan if law is None else number(law.attrs, "rms")
    if law is None or not math.isfinite(rms):
        return
    far = f"The shift factors lie {significant(rms, 2)} decades (rms) from the {law.attrs.get('law', 'fitted')} law"
    if measured_used:
        words = f"{far}; the measured shift factors are used, not this law."
        yield Check("Shift law", "noted", words)
    else:
        yield _check("Shift law", rms <= _LAW, f"{far} that is used (up to {_LAW:g} counts as sound).")


def _spectrum(tree: xr.DataTree) -> Iterator[Check]:
    curve = group(tree, "master_curve")
    if curve is None:
        return
    storage, loss = (number(curve.attrs, f"rms_log10_{name}") for name in ("storage", "loss"))
    if math.isfinite(storage) and math.isfinite(loss):
        yield _check(
            "Fit of the spectrum",
            max(storage, loss) <= _FIT,
            f"The spectrum lies {_decades(storage)} from the measured storage and {_decades(loss)} from the "
            f"measured loss modulus (rms; up to {_decades(_FIT)} counts as sound).",
        )


def _contact(tree: xr.DataTree) -> Iterator[Check]:
    parts = [part for name in ("prediction", "prediction_master") if (part := group(tree, name)) is not None]
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
        yield _check(
            "Energy balance",
            energy <= limit * (1.0 + 1e-9),
            "Friction is calculated twice, from the contact pressure and from the energy that the rubber dissipates. "
            f"The two differ by {percent(energy)} at most. Up to {percent(limit)} counts as sound, "
            f"{_ENERGY_BALANCE:g} times the accuracy asked for: only the better known of the two is reported, and "
            "that one must reach the accuracy.",
        )
    violation = largest("complementarity")
    if math.isfinite(violation):
        yield _check(
            "Contact conditions",
            violation <= _COMPLEMENTARITY,
            f"No overlap, no suction, no pressure across a gap: violated by {significant(violation, 2)} of "
            f"the indentation at most (up to {significant(_COMPLEMENTARITY, 1)} counts as sound).",
        )


def _small_strain(tree: xr.DataTree) -> Iterator[Check]:
    parts = [part for name in ("prediction", "prediction_master") if (part := group(tree, name)) is not None]
    if not parts:
        return
    reaches = np.concatenate([reach(tree, part) for part in parts])
    reaches = reaches[np.isfinite(reaches)]
    if not reaches.size:
        words = "Could not be checked: the results do not say how large the ball or its contact is."
        yield Check("Small strain", "noted", words)
        return
    wide = int(np.sum(reaches > SMALL_STRAIN))
    many = f" This concerns {wide} of {reaches.size} cases, which the tables mark." if wide else ""
    yield _check(
        "Small strain",
        wide == 0,
        f"The contact reaches up to {significant(float(reaches.max()), 2)} of the ball's radius from its axis; above "
        f"{SMALL_STRAIN:g} the linear, half-space description of the contact is doubtful.{many}",
    )


def _frequencies(tree: xr.DataTree) -> Iterator[Check]:
    counts, outside = [], 0
    for name, what in (
        ("prediction", "cases asked for"),
        ("measurement", "measured points"),
        ("prediction_master", "cases along the friction master curve"),
    ):
        part = group(tree, name)
        if part is None or not knows_range(part):
            continue
        beyond, of = int(is_extrapolated(part).sum()), next(iter(part.sizes.values()))
        outside += beyond
        counts.append(f"{beyond} of {of} {what}")
    if not counts:
        return
    ends = [significant(end, 2) for end in numbers(tree.attrs, "frequency_range")]
    measured = f" ({ends[0]} to {ends[1]} rad/s at the reference temperature)" if len(ends) == 2 else ""
    meaning = "the frequency at which the contact deforms the rubber, shift factor times speed over half-width,"
    if outside:
        words = (
            f"In {several(counts)} {meaning} lies outside the measured range{measured}; friction there rests on the "
            "extrapolated spectrum. The tables mark these cases."
        )
    else:
        words = f"Everywhere {meaning} lies within the measured range{measured}."
    yield _check("Measured frequency range", outside == 0, words)


def _measurement(tree: xr.DataTree) -> Iterator[Check]:
    measurement = group(tree, "measurement")
    if measurement is None:
        return
    left_over, error = values(measurement, "consistency"), values(measurement, "consistency_error")
    told = consistency_words(left_over, error)
    if told is None:
        return
    known = np.isfinite(left_over) & np.isfinite(error)
    sound = np.abs(left_over[known]) <= CONSISTENT_WITHIN * error[known]
    yield _check(
        "Consistency of the four configurations",
        bool(np.mean(sound) >= _CONSISTENT),
        f"The combination of the four sign configurations that should vanish is {told}.",
    )


def _cases(tree: xr.DataTree) -> Iterator[Check]:
    if group(tree, "prediction") is None:
        return
    failures = sentences(tree.attrs, "failures")
    if failures:
        many = f"{len(failures)} cases" if len(failures) > 1 else "One case"
        yield Check("All cases solved", "failed", f"{many} could not be solved: see above.")
    else:
        yield Check(
            "All cases solved",
            "passed",
            "Every case was solved to the accuracy asked for.",
        )
