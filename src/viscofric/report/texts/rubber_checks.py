"""Checks of the rubber in a study's results: isotherms, superposition, shift law and spectrum."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.checks import Check
from viscofric.notes import Note
from viscofric.report.results import (
    SAME_TEMPERATURE,
    group,
    number,
    numbers,
    sentences,
    values,
)
from viscofric.report.texts.numbers import degrees, percent, several, significant

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import xarray as xr


def rubber_checks(tree: xr.DataTree) -> Iterator[Check]:
    """Yield every check of the rubber that the results allow."""
    for part in (_isotherms, _superposition, _spectrum):
        yield from part(tree)


def _decades(rms: float) -> str:
    """Say an rms of log10 as a percentage."""
    return percent(10.0**rms - 1.0)


def _judged(name: str, words: str, value: float, attributes: Mapping[Any, Any], kind: str) -> Check:
    """Return a check with the verdict that the results hold, and the words with the limit for an ``@``."""
    holds, limit = (number(attributes, f"{kind}_{part}") for part in ("holds", "limit"))
    if not math.isfinite(limit):  # results of an older viscofric
        return Check(name, "noted", words.replace("@", "rms"), value)
    return Check.of(name, holds == 1.0, words.replace("@", f"rms; good if ≤ {_decades(limit)}"), value, limit)


def _isotherms(tree: xr.DataTree) -> Iterator[Check]:
    factors = group(tree, "shift_factors")
    if factors is None:
        return
    given, used = (number(factors.attrs, f"isotherms_{name}") for name in ("given", "used"))
    if not (math.isfinite(given) and math.isfinite(used)):
        return  # results of an older viscofric
    if used >= given:
        words = f"All {given:.0f} isotherms are joined into the master curve."
        yield Check("Isotherms used", "passed", Note("isotherms-used", words, values={"used": used, "given": given}))
        return
    kept = values(factors, "temperature")
    given_temperatures = numbers(factors.attrs, "temperatures_given")
    apart = [kelvin for kelvin in given_temperatures if np.min(np.abs(kept - kelvin)) > SAME_TEMPERATURE]
    left = [degrees(kelvin) for kelvin in apart]
    which = f"those at {several(left)} are left out" if len(left) > 1 else f"the one at {''.join(left)} is left out"
    if len(left) != given - used:
        which = "the others are left out"
    words = (
        f"{used:.0f} of {given:.0f} isotherms are joined into the master curve; {which} (reasons: notes on the input)."
    )
    counted = {"used": used, "given": given, "left_out": apart}
    yield Check("Isotherms used", "warning", Note("isotherms-used", words, values=counted))


def _superposition(tree: xr.DataTree) -> Iterator[Check]:
    factors = group(tree, "shift_factors")
    if factors is None:
        return
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
        words = " ".join(sentences(whole.attrs, "sentences"))
        holds, roughly = (number(whole.attrs, name) == 1.0 for name in ("holds", "roughly"))
        fails = whole.attrs.get("verdict", "roughly" if roughly else "fails") == "fails"
        yield Check("Superposition", "passed" if holds else "failed" if fails else "warning", words)
        if whole.attrs.get("causality"):
            belong = number(whole.attrs, "consistent") == 1.0
            yield Check.of("Storage against loss modulus", belong, str(whole.attrs["causality"]))


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
        holds, limit = (number(law.attrs, f"misfit_{part}") for part in ("holds", "limit"))
        words = f"{far} that is used (good if ≤ {limit:g})."
        yield Check.of("Shift law", holds == 1.0, words, rms, limit)


def _spectrum(tree: xr.DataTree) -> Iterator[Check]:
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
