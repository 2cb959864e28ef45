"""Interpolated contacts against the same ones solved by themselves."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf
from friction.planning.made_up_contacts import carry_out, case_of, solved
from viscofric.friction.cases.case import Case
from viscofric.friction.cases.record import Record
from viscofric.friction.cases.solving import solve
from viscofric.friction.planning.plan import Plan

FLUOROELASTOMER = vf.synthetic_fluoroelastomer()


def random_rubber(random: np.random.Generator) -> vf.Material:
    """Return a rubber of three to nine modes; made up."""
    count = int(random.integers(3, 10))
    shares = random.uniform(0.1, 1.0, count)
    ratio = 10.0 ** random.uniform(0.7, 2.5)
    C = (1.0 - 1.0 / ratio) * 1e-6 * shares / shares.sum()
    tau = 10.0 ** np.sort(random.uniform(-5.0, 0.0, count))
    return vf.Material(vf.RetardationSpectrum(1e6, 1e6 * ratio, C, tau))


def interpolated_and_solved(
    material: vf.Material, cases: list[Case], accuracy: float, checked: np.ndarray, better: float = 0.2
) -> list[tuple[Record, Record]]:
    """Interpolate many cases, and solve some of them by themselves, more accurately."""
    plan = Plan(cases, [material], accuracy=accuracy)
    assert sum(map(len, carry_out(plan, solved))) < 0.6 * len(cases)
    found, pairs = plan.found(), []
    for number in checked:
        (task,) = Plan([cases[number]], [material], accuracy=better * accuracy, each=True).wanted()
        one = found[number]
        assert isinstance(one, Record)
        if one.interpolated:
            pairs.append((one, solve(task)))
    return pairs


def ratio_of_errors(pairs: list[tuple[Record, Record]], name: str, error: str) -> np.ndarray:
    """Divide differences by what both claim: those that are solved again are not exact either."""
    return np.array(
        [
            abs(getattr(one, name) - getattr(true, name)) / (getattr(one, error) + getattr(true, error))
            for one, true in pairs
        ]
    )


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_claimed_errors_cover_those_of_random_rubbers(seed: int) -> None:
    random = np.random.default_rng(seed)
    material = random_rubber(random)
    cases = [case_of(speed) for speed in np.geomspace(1e-2, 1.0, 30).tolist()]
    pairs = interpolated_and_solved(material, cases, 1e-2, random.choice(30, 6, replace=False))
    assert len(pairs) >= 4
    assert np.all(ratio_of_errors(pairs, "friction_coefficient", "friction_error") <= 1.0)
    assert np.all(ratio_of_errors(pairs, "indentation", "indentation_error") <= 1.0)
    for one, true in pairs:
        assert one.friction_coefficient == pytest.approx(true.friction_coefficient, rel=1e-2)  # the accuracy


@pytest.mark.apart
@pytest.mark.parametrize(
    ("material", "slowest", "fastest"),
    [
        (FLUOROELASTOMER, 1e-7, 1e5),
        pytest.param(vf.Material.standard_linear_solid(1e6, 1e9, 1e-3), 1e-6, 1e6, marks=pytest.mark.exhaustive),
    ],
    ids=["fluoroelastomer", "standard linear solid"],
)
def test_accuracy_is_kept_over_twelve_decades(material: vf.Material, slowest: float, fastest: float) -> None:
    speeds = np.geomspace(slowest, fastest, 300).tolist()
    temperature = 303.15 if material.reference is None else material.reference
    cases = [case_of(speed, temperature) for speed in speeds]
    checked = np.random.default_rng(7).choice(300, 8, replace=False)
    # As solved directly with the same accuracy: each of the two is off by as much as it claims at most.
    pairs = interpolated_and_solved(material, cases, 1e-2, checked, better=0.3)
    covered = ratio_of_errors(pairs, "friction_coefficient", "friction_error") <= 1.0
    assert np.count_nonzero(~covered) <= 1  # one in eight may be beyond what 95 % are to hold
    for one, true in pairs:
        assert one.friction_coefficient == pytest.approx(true.friction_coefficient, rel=1e-2)  # the accuracy


@pytest.mark.slow
def test_sensitivity_of_an_interpolated_contact_shows_what_its_own_would() -> None:
    material = vf.Material(
        vf.RetardationSpectrum(1e6, 1e7, [4e-7, 5e-7], [1e-4, 1e-2]), shift=vf.Arrhenius(80e3, reference=303.15)
    )
    speeds, temperatures = np.geomspace(1e-2, 1e-1, 8).tolist(), [303.15, 305.15]
    cases = [case_of(speed, temperature) for temperature in temperatures for speed in speeds]
    plan = Plan(cases, [material], accuracy=1e-2, sensitive=True)
    carry_out(plan, solved)
    one = plan.found()[11]
    assert isinstance(one, Record)
    assert one.interpolated
    (task,) = Plan([cases[11]], [material], accuracy=1e-2, sensitive=True, each=True).wanted()
    reported, own = one.sensitivity, solve(task).sensitivity
    assert reported is not None
    assert own is not None
    np.testing.assert_allclose(reported.log_tau, own.log_tau, atol=1e-9)
    # Both have the errors of contacts solved to 1 %, of which the differences along g are the larger part.
    np.testing.assert_allclose(reported.slope, own.slope, atol=0.02 * np.abs(own.slope).max())
    for name in ("friction", "compliance_part", "glass", "load", "frequency"):
        assert getattr(reported, name) == pytest.approx(getattr(own, name), rel=0.02), name
    # A rubber that is the same has the same friction, whatever the rest.
    assert reported.friction == one.friction_coefficient
    own_modes = (
        reported.at(np.log(task.arguments["modes"].tau)) @ task.arguments["modes"].C
        + reported.glass / task.arguments["modes"].E_inf
    )
    assert own_modes == pytest.approx(reported.compliance_part, rel=1e-9)
