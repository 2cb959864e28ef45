"""The choice among shift laws: planted ones are recognised, and no constant is added that does not pay."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

import viscofric as vf
from viscofric.errors import InputError
from viscofric.rheology import ShiftFactors
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, WLFArrhenius

WARM = np.arange(0.0, 121.0, 10.0) + 273.15
WIDE = np.arange(-60.0, 121.0, 10.0) + 273.15
PLANTED = {
    "wlf": (WLF(9.0, 100.0, "30 degC"), WARM),
    "arrhenius": (Arrhenius("120 kJ/mol", "30 degC"), WARM),
    "wlf+arrhenius": (WLFArrhenius(17.44, 51.6, "-18 degC", "30 degC"), WIDE),
}


def measured(law, temperatures, seed, step=0.01, scatter=0.0):
    """Return factors whose errors add up from neighbour to neighbour, as those of a superposition do."""
    random = np.random.default_rng(seed)
    errors = np.cumsum(step * random.standard_normal(len(temperatures)))
    order = np.arange(1, len(temperatures) + 1)
    place = int(np.argmin(np.abs(temperatures - law.reference)))
    relative = np.eye(len(temperatures))
    relative[:, place] -= 1.0
    covariance = relative @ (step**2 * np.minimum.outer(order, order)) @ relative.T
    values = law.log10(temperatures) + errors - errors[place]
    values += scatter * random.standard_normal(len(temperatures))
    return ShiftFactors(temperatures, values, law.reference, covariance)


@pytest.mark.parametrize("kind", PLANTED)
@pytest.mark.parametrize("scatter", [0.0, 0.03])
def test_the_planted_law_is_chosen(kind, scatter):
    law, temperatures = PLANTED[kind]
    chosen = Counter(
        measured(law, temperatures, seed, scatter=scatter).compare_laws().chosen.kind for seed in range(10)
    )
    assert chosen[kind] >= 9  # nine in ten; 99 in 100 were counted over a hundred seeds


@pytest.mark.parametrize("kind", ["wlf", "arrhenius"])
def test_few_temperatures_do_not_hide_a_curve_that_the_errors_show(kind):
    """Six of them; a straight line misses WLF by up to 0.13 decades, thirteen standard errors of 0.01."""
    law, temperatures = PLANTED[kind][0], np.arange(30.0, 71.0, 8.0) + 273.15
    found = [measured(law, temperatures, seed).compare_laws() for seed in range(10)]
    assert Counter(one.chosen.kind for one in found)[kind] >= 9  # nine in ten


def test_a_fitted_law_is_as_uncertain_as_it_says():
    """Over seeds, planted log10 α lie in the 95 % bands at 95 % of temperatures, inside the fit and beyond."""
    for kind, (law, temperatures) in PLANTED.items():
        asked = np.array([temperatures[1] + 4.0, temperatures[-2] + 3.0, temperatures[-1] + 20.0])
        inside = []
        for seed in range(60):
            fitted = measured(law, temperatures, seed).law(kind)
            inside.append(np.abs(fitted.log10(asked) - law.log10(asked)) < 1.96 * fitted.standard_error(asked))
        # 60 seeds: 95 ± 2.8 % (one sigma); three sigma allowed.
        assert np.all(np.mean(inside, axis=0) > 0.866), kind


def test_wlf_and_vft_are_one_curve_and_one_candidate():
    found = measured(*PLANTED["wlf"], seed=1).compare_laws()
    rows = {row.kind: row for row in found.rows}
    assert rows["vft"].same_as == "wlf"
    assert rows["vft"].aicc == rows["wlf"].aicc
    assert isinstance(found.best, WLF)
    assert isinstance(rows["vft"].law, VFT)
    assert rows["vft"].law.log10(WARM) == pytest.approx(found.best.log10(WARM), abs=1e-10)
    assert "VFT is the same curve as WLF" in found.explanation


def test_the_explanation_names_the_winner_and_its_lead():
    found = measured(*PLANTED["wlf"], seed=1).compare_laws()
    second = min(row.aicc for row in found.rows if row.kind not in ("wlf", "vft"))
    if second > found.chosen.aicc:
        assert found.explanation.startswith("WLF describes these shift factors best: its AICc is lower by ")
        assert f"{second - found.chosen.aicc:.2g}" in found.explanation
    assert [row.aicc for row in found.rows] == sorted(row.aicc for row in found.rows)


def test_the_likelihood_is_that_of_a_normal_distribution():
    """−2 ln L from the density of scipy, at the constants and the scatter that were found."""
    from scipy.stats import multivariate_normal

    law, temperatures = PLANTED["arrhenius"]
    table = measured(law, temperatures, seed=3, scatter=0.05)
    row = next(row for row in table.compare_laws().rows if row.kind == "arrhenius")
    assert row.scatter == pytest.approx(0.05, rel=0.6)  # 12 values: ±20 % (one sigma)
    differences = np.diff(np.eye(len(temperatures)), axis=0)
    covariance = differences @ (table.covariance + row.scatter**2 * np.eye(len(temperatures))) @ differences.T

    def deviance(energy):
        away = differences @ (table.log10_values - Arrhenius(energy, table.reference).log10(temperatures))
        return -2.0 * multivariate_normal(np.zeros(len(away)), covariance).logpdf(away)

    energies = row.law.activation_energy * np.linspace(0.95, 1.05, 2001)
    count, constants = len(temperatures) - 1, 2
    penalty = 2 * constants + 2 * constants * (constants + 1) / (count - constants - 1)
    # The grid of energies and the end of the search for the scatter leave about 1e-3.
    assert row.aicc == pytest.approx(min(deviance(energy) for energy in energies) + penalty, abs=5e-3)


def test_a_polynomial_is_the_last_resort():
    """Curved the other way than WLF: only a polynomial follows; where WLF does, no polynomial is chosen."""
    inverse = 1.0 / WARM - 1.0 / 303.15
    table = ShiftFactors(WARM, 8e3 * inverse - 4e6 * inverse**2, 303.15, 1e-4 * np.eye(len(WARM)))
    found = table.compare_laws()
    assert isinstance(found.best, InversePolynomial)
    assert found.best.coefficients[:2] == pytest.approx((8e3, -4e6), rel=1e-3)
    assert {row.kind: row.refusal for row in found.rows}["wlf"]
    slightly = 8e3 * inverse + 2e8 * inverse**3  # by up to 0.1 decades: a law of physics is good enough
    table = ShiftFactors(WARM, slightly, 303.15, 1e-6 * np.eye(len(WARM)))
    found = table.compare_laws()
    assert not isinstance(found.best, InversePolynomial)
    assert found.rows[0].kind == "polynomial"
    assert "describes without explaining" in found.explanation


def test_the_degree_of_a_polynomial_is_chosen_by_the_same_criterion():
    inverse = 1.0 / WARM - 1.0 / 303.15
    random = np.random.default_rng(4)
    for degree, coefficients in ((2, [6e3, 2e6]), (3, [6e3, 2e6, 4e9])):
        values = sum(c * inverse**power for power, c in enumerate(coefficients, start=1))
        values = values + 0.01 * random.standard_normal(len(WARM))
        table = ShiftFactors(WARM, values, 303.15, 1e-4 * np.eye(len(WARM)))
        law = table.law("polynomial")
        assert law.degree == degree
        assert np.all(np.abs(law.parameters - coefficients) < 4.0 * np.array(law.standard_errors))
    assert table.law("polynomial", degree=1).coefficients[0] > 0.0
    with pytest.raises(InputError, match="degree = 7"):
        table.law("polynomial", degree=7)


def test_refused_laws_say_why_and_too_few_temperatures_are_told():
    law, _ = PLANTED["arrhenius"]
    few = measured(law, WARM[:4], 0).at_reference(WARM[1])
    with pytest.raises(InputError, match="too few"):
        ShiftFactors(few.temperatures[:3], few.log10_values[:3], few.reference).compare_laws()
    found = measured(law, WARM[:6], 0).compare_laws()
    refused = {row.kind: row.refusal for row in found.rows if row.law is None}
    assert "wlf+arrhenius" in refused
    assert all(refused.values())
    rising = ShiftFactors(WARM, 0.01 * (WARM - 300.0), 300.0)
    with pytest.raises(InputError, match="no shift law describes these factors"):
        rising.compare_laws()


@pytest.mark.parametrize(
    ("name", "reference", "kind"),
    [
        ("acrylic_468mp.csv", "20 degC", "wlf"),
        ("adhesive_ems_ca.csv", "25 degC", None),
        ("eva_shear.csv", "20 degC", None),
        ("vinyl_nitrile_foam.csv", "20 degC", None),
    ],
)
def test_measured_factors_get_a_law_and_a_reason(real_data, name, reference, kind):
    deformation = "tension" if "adhesive" in name else "shear"
    factors = vf.superpose(vf.read_dma(real_data / "dma" / name, deformation=deformation), reference).shift_factors
    found = factors.compare_laws()
    assert found.explanation.endswith(".")
    assert all(row.law is not None or row.refusal for row in found.rows)
    if kind is not None:
        assert found.chosen.kind == kind
