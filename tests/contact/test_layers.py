"""Layers on a rigid base: against the differential equations of one wave, and their limits."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg

import viscofric as vf
from refusals import refused
from viscofric.contact.bodies import Layer
from viscofric.contact.periodic.solve import solve_periodic
from viscofric.contact.periodic.surface import PeriodicSurface


def surface_displacement(q: float, thickness: float, modulus: float, poisson_ratio: float, bonded: bool) -> float:
    """Displacement into a layer under the pressure cos qx, from equilibrium and Hooke's law in plane strain.

    State: U sin qx, W cos qx (displacements along x and z, upwards), T sin qx, Σ cos qx (shear and normal stress).
    """
    nu = poisson_ratio
    system = np.array(
        [
            [0.0, q, 2.0 * (1.0 + nu) / modulus, 0.0],
            [-nu / (1.0 - nu) * q, 0.0, 0.0, (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu) / modulus],
            [q**2 * modulus / (1.0 - nu**2), 0.0, 0.0, nu / (1.0 - nu) * q],
            [0.0, 0.0, -q, 0.0],
        ]
    )
    through = scipy.linalg.expm(system * thickness)
    free = [2, 3] if bonded else [0, 3]  # what the base leaves open: tractions, or slip and normal stress
    at_top = through[:, free]
    base = np.linalg.solve(at_top[[2, 3]], [0.0, -1.0])
    return -float(at_top[1] @ base)


@pytest.mark.parametrize("bonded", [True, False])
@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3, 0.49, 0.5])
@pytest.mark.parametrize("depth", [0.05, 0.3, 1.0, 3.0])
def test_layer_obeys_the_differential_equations(bonded: bool, poisson_ratio: float, depth: float) -> None:
    modulus, thickness = 3.0, 0.7
    q = depth / thickness
    expected = surface_displacement(q, thickness, modulus, poisson_ratio, bonded)
    layer = Layer(thickness, bonded)
    found = 2.0 * (1.0 - poisson_ratio**2) / (modulus * q) * float(layer.yielding(q, poisson_ratio))
    # The matrix exponential loses up to e^{2Q} and, for thin incompressible layers, 1/Q³ of its 16 digits.
    assert found == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("bonded", [True, False])
def test_deep_layer_is_a_half_space(bonded: bool) -> None:
    layer = Layer(1.0, bonded)
    for poisson_ratio in (0.0, 0.5):
        # What is left of the base is of the order Q² e^{−2Q}: 1e-14 at Q = 20.
        np.testing.assert_allclose(layer.yielding([20.0, 1e3, 1e6, 1e100], poisson_ratio), 1.0, rtol=1e-13)


def test_thin_layers_are_what_they_should_be() -> None:
    q = np.array([1e-6, 1e-4, 1e-3])
    for poisson_ratio in (0.0, 0.3, 0.45):
        winkler = (1 + poisson_ratio) * (1 - 2 * poisson_ratio) / (1 - poisson_ratio)
        bonded = 2.0 * (1.0 - poisson_ratio**2) / q * Layer(1.0).yielding(q, poisson_ratio)
        # The next term is relative Q² times at most a few over 1−2ν.
        np.testing.assert_allclose(bonded, winkler, rtol=1e-4)
        assert bonded[0] == pytest.approx(winkler, rel=1e-10)
        assert Layer(2.0).mean_compression(poisson_ratio) == pytest.approx(2.0 * winkler, rel=1e-14)
        sliding = 2.0 * (1.0 - poisson_ratio**2) / q * Layer(1.0, bonded=False).yielding(q, poisson_ratio)
        np.testing.assert_allclose(sliding, 1.0 - poisson_ratio**2, rtol=1e-5)  # next term: relative Q²/3
    incompressible = 1.5 / q * Layer(1.0).yielding(q, 0.5)
    np.testing.assert_allclose(incompressible, q**2, rtol=1e-5)  # next term: relative Q² times a few
    assert Layer(1.0).mean_compression(0.5) == 0.0


@pytest.mark.parametrize("bonded", [True, False])
@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3, 0.499999, 0.5])
def test_yielding_is_smooth_and_grows_with_depth(bonded: bool, poisson_ratio: float) -> None:
    depth = np.logspace(-6.0, 6.0, 4001)
    found = Layer(1.0, bonded).yielding(depth, poisson_ratio)
    assert np.all(np.isfinite(found))
    assert np.all(found > 0.0)
    # A layer never yields more than a few per cent beyond the half-space, and no digit is lost where formulae change.
    slopes = np.diff(np.log(found)) / np.diff(np.log(depth))
    assert np.all(slopes < 3.0 + 1e-6)
    assert np.abs(np.diff(slopes)).max() < 0.02  # steps of 0.7 % in depth; the sharpest bend is of order one


def test_mean_compression_is_part_of_the_indentation() -> None:
    rubber = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3, poisson_ratio=0.3)
    wave = PeriodicSurface(1e-5 * np.cos(2.0 * np.pi * np.arange(64) / 64), 1e-3 / 64)
    solution = solve_periodic(rubber, wave, speed=0.1, pressure=2e4, layer=Layer(1e-4))
    oedometric = 1e6 * 0.7 / (1.3 * 0.4)
    assert solution.displacement.mean() == pytest.approx(2e4 * 1e-4 / oedometric, rel=1e-9)  # round-off
    height = wave.z.max() - wave.z
    np.testing.assert_allclose(solution.gap, solution.displacement + height - solution.indentation, atol=1e-18)


@pytest.mark.parametrize(("wrong", "code"), [(0.0, "not-positive"), (-1.0, "not-positive"), ("1 s", "wrong-unit")])
def test_wrong_thickness_is_refused(wrong: object, code: str) -> None:
    with refused(code, naming="thickness"):
        Layer(wrong)  # type: ignore[arg-type]
