"""Statistics of drawn materials: scatter of each isotherm as far as it is told, limits that a further draw keeps."""

from __future__ import annotations

import numpy as np
import pytest

from viscofric.rheology.uncertainty.material_samples import MaterialSamples, Residuals


@pytest.mark.parametrize("freedom", [6.0, 30.0])
def test_scatter_of_an_isotherm_counts_by_its_points_beside_what_all_have_in_common(freedom):
    """Variances σ² ~ ν0 s0²/χ²(ν0), n points each: the best guess of one has the slope n/(ν0 + n) on its own mean.

    That is the mean of σ² given the n squares, where variances differ as the inverse of χ² with ν0 degrees.
    """
    random = np.random.default_rng(5)
    isotherms, points = 2000, 10
    deviation = 0.01 * np.sqrt(freedom / random.chisquare(freedom, isotherms))
    place = np.repeat(np.arange(isotherms), points)
    values = deviation[place, None] * random.standard_normal((isotherms * points, 2))
    residuals = Residuals(values, place, np.zeros_like(values))
    for column in range(2):
        own = np.mean(values[:, column].reshape(isotherms, points) ** 2, axis=1)
        found = residuals.scale[::points, column] ** 2
        slope = np.polyfit(own, found, 1)[0]
        # ψ'(ν0/2) is known to √(2/2000) of var ln s², which is 0.01 of 0.07 for 30: ν0 to 13 %, the slope to 0.03; four
        # of that.
        assert slope == pytest.approx(points / (freedom + points), abs=0.12)
        # Nearer to the true variances than either the scatter of each or that of all.
        away = np.mean(np.log(found / deviation**2) ** 2)
        assert away < 0.95 * np.mean(np.log(own / deviation**2) ** 2)
        assert away < 0.95 * np.mean(np.log(own.mean() / deviation**2) ** 2)


@pytest.mark.parametrize("samples", [20, 50])
@pytest.mark.parametrize("level", [0.9, 0.68])
def test_a_further_draw_lies_within_the_limits_as_often_as_they_promise(samples, level):
    """Between ranks p(n + 1) of n draws a further one lies with probability 1 − 2p, whatever they are drawn from."""
    random = np.random.default_rng(6)
    trials = 20000
    drawn, further = random.standard_normal((samples, trials)), random.standard_normal(trials)
    # Only the number of materials matters here: each stands for its place among the draws.
    few = MaterialSamples(tuple(range(samples)), np.zeros((samples, 1)), np.ones((samples, 1)), (1.0, 2.0))
    band = few.band(lambda place: drawn[place], level)
    inside = np.mean((further >= band.lower) & (further <= band.upper))
    # Shares of 20000 are known to 0.003, four of that.  Limits at ranks 1 + p(n − 1) hold 0.81 in place of 0.90.
    assert inside == pytest.approx(level, abs=0.012)
