"""Gauss's rules, and the fit of numbers that are not negative."""

import numpy as np
import pytest

import viscofric as vf
from viscofric.arrays import gauss, non_negative_fit
from viscofric.contact.fields.dissipation import Modes


def test_nodes_of_a_gauss_rule_are_found_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Contacts need a rule on every grid, where the nodes would take some percent of the time of a small one."""
    before = gauss(12)
    monkeypatch.setattr("numpy.polynomial.legendre.leggauss", None)
    place, weight = gauss(12, [0.0, 1.0, 3.0])
    np.testing.assert_array_equal(place[:12], before[0])
    assert weight @ place**5 == pytest.approx(3.0**6 / 6.0, rel=1e-14)


@pytest.mark.parametrize("unit", [1.0, 1e-9])
@pytest.mark.parametrize("gives_up", [False, True])
def test_a_fit_meets_the_conditions_of_the_least_squares_that_are_not_negative(unit, gives_up, monkeypatch) -> None:
    def no_end(*_: object, **__: object) -> None:
        raise RuntimeError("Maximum number of iterations reached.")

    if gives_up:
        monkeypatch.setattr("scipy.optimize.nnls", no_end)
    rng = np.random.default_rng(3)
    matrix, aim = unit * rng.normal(size=(30, 8)), rng.normal(size=30)
    found = non_negative_fit(matrix, aim)
    gradient = matrix.T @ (matrix @ found - aim) / unit
    assert np.all(found >= 0.0)
    assert np.all(gradient >= -1e-9)  # rounding
    assert 0 < np.count_nonzero(found) < 8
    assert gradient[found > 0.0] == pytest.approx(0.0, abs=1e-9)


def test_modes_are_merged_at_temperatures_where_columns_are_exchanged_often() -> None:
    # Where the limit of steps in SciPy's own fit, three times the columns, is too few for six of them.
    modes = vf.synthetic_fluoroelastomer().modes_at(273.71993663131593)
    few = Modes(np.asarray(modes.C), np.asarray(modes.tau)).merged(0.05 * 6.878e-5, 50.0 * 6.878e-5, 4.0)
    frequency = np.geomspace(1.0 / 6.878e-5, 10.0 / 6.878e-5, 20)

    def loss(C: np.ndarray, tau: np.ndarray) -> np.ndarray:
        x = np.multiply.outer(frequency, tau)
        return x / (1.0 + x**2) @ C

    assert loss(*few) == pytest.approx(loss(np.asarray(modes.C), np.asarray(modes.tau)), rel=0.04)
