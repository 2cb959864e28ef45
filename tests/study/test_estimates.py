"""What is told beforehand of what a study will take, against what it took."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from friction.planning.made_up_contacts import SLS, carry_out, case_of
from viscofric.friction.planning.plan import Plan
from viscofric.study.cases.estimates import estimate

CASES = [
    case_of(speed, temperature)
    for temperature in np.linspace(283.15, 383.15, 10).tolist()
    for speed in np.geomspace(1e-3, 1.0, 40).tolist()
]


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3])
def test_contacts_of_a_curve_are_foreseen(accuracy: float) -> None:
    reported = estimate(CASES, [SLS], accuracy=accuracy)
    took = sum(map(len, carry_out(Plan(CASES, [SLS], accuracy=accuracy))))
    assert reported.cases == len(CASES)
    assert 0.6 * took <= reported.solves <= 1.6 * took  # rough, and said to be


def test_every_case_counts_where_each_is_solved() -> None:
    assert estimate(CASES, [SLS], each=True).solves == len(CASES)
    assert estimate([*CASES, CASES[0]], [SLS], each=True).solves == len(CASES)
    assert estimate(CASES, [SLS], fields=True).solves == len(CASES)


def test_members_of_a_posterior_have_a_curve_each() -> None:
    one = estimate(CASES, [SLS]).solves
    more = [replace(case, sample=sample) for sample in (None, 1, 2) for case in CASES]
    assert estimate(more, [SLS]).solves == pytest.approx(3 * one, abs=1)  # rounded


def test_what_takes_more_is_reported_to_take_more() -> None:
    plain = estimate(CASES, [SLS])
    assert plain.seconds > 0.0
    assert estimate(CASES, [SLS], sensitive=True).seconds > 1.5 * plain.seconds
    finer = estimate(CASES, [SLS], accuracy=1e-4)
    assert finer.seconds > plain.seconds
    assert finer.memory_per_process > plain.memory_per_process
    on_a_layer = [replace(case, layer=vf.Layer(1e-3)) for case in CASES]
    assert estimate(on_a_layer, [SLS], each=True).seconds > estimate(CASES, [SLS], each=True).seconds
