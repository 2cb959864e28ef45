"""Sweeps and step tests of one material together: one table of shift factors, one spectrum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import Dataset
from viscofric.errors import InputError
from viscofric.files import of_synthetic
from viscofric.nominal import parted
from viscofric.notes import Note
from viscofric.rheology.shifts.shift_factors import ShiftFactors, weights_between
from viscofric.rheology.shifts.vertical_shift import VerticalShift
from viscofric.rheology.superposition.isotherm_offsets import BEFORE_TREND
from viscofric.rheology.superposition.result import StepSuperposition, Superposition
from viscofric.showing import Plotted, Rows
from viscofric.step_tests import StepMasterCurve
from viscofric.units import shown_celsius

Part: TypeAlias = Superposition | StepSuperposition

#: Temperatures of two kinds of tests closer than this are one temperature of the material.
SAME = 0.5  # K
#: Kinds disagree if their common shift factors differ by more than their errors make once in a thousand.
RARE = 1e-3


@dataclass(frozen=True, eq=False)
class JointSuperposition(Plotted):
    """The result of `superpose` of several kinds of tests of one material.

    Parameters
    ----------
    parts : tuple of Superposition or StepSuperposition
        Of each kind, in the order given, with the common shift factors.
    shift_factors : ShiftFactors
        α at the temperatures of all kinds, with standard errors: the generalised least squares mean of the factors of
        each kind.
    alone : tuple of Superposition or StepSuperposition
        Each kind with the factors that it gives by itself.
    gains : tuple of (n, n_p) array
        What errors of the factors of each kind add to those of the common ones.
    notes : tuple of str
        Those of the kinds, and whether they agree.
    """

    parts: tuple[Part, ...]
    shift_factors: ShiftFactors
    alone: tuple[Part, ...]
    gains: tuple[Array, ...]
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("kinds of tests", self.parts),
            ("temperature", self.shift_factors.temperatures, "°C"),
            ("reference", self.shift_factors.reference, "°C"),
            ("log10 α", self.shift_factors.log10_values),
            ("notes", self.notes),
        )

    @property
    def vertical_shift(self) -> VerticalShift | None:
        """The vertical shift b(T), where one was requested; the same for all kinds."""
        return self.parts[0].vertical_shift

    def to_dataset(self) -> Dataset:
        """Return the common shift factors as a labelled data set; see `ShiftFactors.to_dataset`."""
        return self.shift_factors.to_dataset()


def joined_kinds(alone: Sequence[Part], reference: float) -> JointSuperposition:
    """Join superpositions of several kinds about one reference, K."""
    alone = _of_one_vertical_shift(alone)
    temperatures = of_all_kinds([one.shift_factors.temperatures for one in alone])
    size = len(temperatures)
    picks, onto = [], []
    for one in alone:
        own = one.shift_factors.temperatures
        pick = np.eye(size)[np.abs(own[:, None] - temperatures).argmin(axis=1)]
        picks.append(pick)
        onto.append(pick - weights_between(own, np.array([reference])) @ pick)
    R, found = np.concatenate(onto), np.concatenate([one.shift_factors.log10_values for one in alone])
    ends = np.cumsum([0, *(len(one) for one in onto)])
    shared = np.concatenate([_error_of_vertical_shift(one) for one in alone])
    spread = np.outer(shared, shared)
    for one, first, last in zip(alone, ends, ends[1:], strict=False):
        spread[first:last, first:last] = one.shift_factors.covariance
    inverse = np.linalg.pinv(spread, rcond=1e-10, hermitian=True)
    gauge = weights_between(temperatures, np.array([reference]))[0]
    information = R.T @ inverse @ R
    information += float(np.trace(information)) * np.outer(gauge, gauge)
    gain = np.linalg.pinv(information, rcond=1e-14, hermitian=True) @ R.T @ inverse
    values, covariance = gain @ found, gain @ spread @ gain.T
    away = found - R @ values
    misfit, freedom = float(away @ inverse @ away), len(found) - len(alone) + 1 - size
    notes = [note for one in alone for note in one.notes]
    notes += _agreement(misfit, freedom)
    excess = max(misfit / freedom, 1.0) if freedom > 0 else 1.0
    covariance = excess * covariance
    gains = tuple(np.split(np.sqrt(excess) * gain, ends[1:-1], axis=1))
    made_up = of_synthetic(note for one in alone for note in one.shift_factors.notes)
    common = ShiftFactors(temperatures, values, reference, covariance, made_up)
    parts = tuple(_shifted(one, pick @ common.log10_values) for one, pick in zip(alone, picks, strict=True))
    return JointSuperposition(parts, common, tuple(alone), gains, tuple(dict.fromkeys(notes)))


def _error_of_vertical_shift(part: Part) -> Array:
    """Return the errors of log10 α (n,) from a vertical shift that may have been left out, of one sign or the other."""
    left_out = None if part.offsets is None else part.offsets.left_out
    return np.zeros(len(part.shift_factors.temperatures)) if left_out is None else np.asarray(left_out.errors[0])


def _of_one_vertical_shift(alone: Sequence[Part]) -> tuple[Part, ...]:
    """Return kinds of tests whose errors include the vertical shift that all of them together may have left out."""
    shown = [one.offsets.left_out.probability for one in alone if one.offsets is not None and one.offsets.left_out]
    if len(shown) < 2:
        return tuple(alone)
    together = np.prod(shown, axis=0) / BEFORE_TREND ** (len(shown) - 1)
    return tuple(_with_trend(one, together / together.sum()) for one in alone)


def _with_trend(part: Part, probability: Array) -> Part:
    """Return one kind with other probabilities of the vertical shift."""
    if part.offsets is None or part.offsets.left_out is None:
        return part
    offsets = replace(part.offsets, left_out=replace(part.offsets.left_out, probability=probability))
    found = replace(part, offsets=offsets)
    before, after = (np.outer(one, one) for one in (_error_of_vertical_shift(part), _error_of_vertical_shift(found)))
    factors = part.shift_factors
    return replace(found, shift_factors=replace(factors, covariance=factors.covariance - before + after))


def of_all_kinds(temperatures: Sequence[Array]) -> Array:
    """Return the temperatures of all kinds of tests, ascending, K; those closer than `SAME` are one."""
    kelvin = np.concatenate(temperatures)
    return np.array([kelvin[rows].mean() for rows in parted(kelvin, SAME)])


def _agreement(misfit: float, freedom: int) -> list[str]:
    """Say whether kinds of tests agree on the shift factors that they share."""
    from scipy.special import chdtrc

    if freedom < 1 or chdtrc(freedom, misfit) > RARE:
        return []
    said = (
        "The kinds of tests disagree on α at the temperatures that they share: χ² is "
        f"{misfit:.3g} for {freedom} differences; the errors of the common factors were increased accordingly."
    )
    return [Note("kinds-disagree", said)]


def _shifted(part: Part, values: Array) -> Part:
    """Return one kind with other shift factors (n,) at its temperatures."""
    own, curve = part.shift_factors, part.master_curve
    place = np.abs(curve.temperature[:, None] - own.temperatures).argmin(axis=1)
    change = 10.0 ** (values - own.log10_values)[place]
    if isinstance(curve, StepMasterCurve):
        columns = {"time": curve.time / change, "response": curve.response}
    else:
        columns = {"angular_frequency": curve.angular_frequency * change}
        columns |= {"storage_modulus": curve.storage_modulus, "loss_modulus": curve.loss_modulus}
    order = np.argsort(next(iter(columns.values())), kind="stable")
    moved = {name: column[order] for name, column in {**columns, "temperature": curve.temperature}.items()}
    factors = ShiftFactors(own.temperatures, values, own.reference, own.covariance, own.notes)
    return replace(part, shift_factors=factors, master_curve=replace(curve, **moved))  # type: ignore[arg-type]


def insist_on_kinds(tests: Sequence[object], vertical: object, shift: object, fixed: object) -> None:
    """Refuse lists of tests, and choices for them, that cannot be superposed together."""
    if shift is not None or fixed:
        raise InputError(
            "shift and fixed are for one kind of tests; superpose each kind by itself.", code="not-for-several"
        )
    if not tests:
        raise InputError("superpose needs sweeps or step tests; the list is empty.", code="no-tests")
    if vertical == "free":
        raise InputError(
            "vertical='free' is fitted to one kind of tests; for several give 'density', a VerticalShift or None.",
            code="no-free-vertical",
        )


def level_note(kind: str, decades: float, kelvin: float) -> Note:
    """Say how far the moduli of one kind of tests lie from those of the first."""
    percent = 100.0 * (10.0**decades - 1.0)
    return Note(
        "kinds-offset",
        f"Moduli of the {kind} tests lie {abs(percent):.1f} % {'above' if percent > 0 else 'below'} those of the first "
        f"kind of tests at {shown_celsius(kelvin)} °C; the spectrum has the level of the first.",
    )
