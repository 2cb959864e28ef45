"""Influence of a layer's cells: their waves are those of the layer, with memory, in point and line contacts."""

from __future__ import annotations

import numpy as np
import pytest

from marks import slow
from refusals import refused
from viscofric.contact.free.grids import Grid
from viscofric.contact.influence.layer_potentials import LayerCell
from viscofric.contact.influence.potentials import cell_potential
from viscofric.contact.operators.convolution import SteadyMaterial, bent_share
from viscofric.contact.operators.half_space import HalfSpaceOperator, LineOperator
from viscofric.contact.operators.layer import LayerOperator, LineLayerOperator, ScaledLayer
from viscofric.errors import ConvergenceError

TWO_MODES = SteadyMaterial(0.1, np.array([0.5, 0.4]), np.array([0.3, 3.0]))
LAYERS = [ScaledLayer(0.3, False, 0.3), ScaledLayer(1.0, True, 0.3), ScaledLayer(3.0, True, 0.5)]


def name(layer: ScaledLayer) -> str:
    return f"H {layer.thickness:g}, {'bonded' if layer.bonded else 'sliding'}, ν {layer.poisson_ratio:g}"


def sinc(q: np.ndarray) -> np.ndarray:
    return np.sinc(q / (2.0 * np.pi))


@pytest.mark.parametrize(("layer", "shift"), [*slow((LAYERS[0], 0.3)), (LAYERS[1], 0.0), (LAYERS[2], 0.5)])
def test_waves_of_the_influence_are_those_of_the_layer(layer: ScaledLayer, shift: float) -> None:
    """The sum over all cells of a loaded one's influence times a wave is the layer's answer to that wave.

    To it the cells add those of their reciprocal lattice, each spread over a cell: Poisson's sum formula.
    """
    reach = int(16.0 * layer.thickness + 4.0)
    window = Grid(1.0, 60 + 2 * reach, reach, reach)
    load = np.zeros(window.shape)
    load[-reach, reach] = 1.0  # memory of 3 cells fades to 1e-9 behind it, and so does what the base leaves
    displacement = LayerOperator(window, TWO_MODES, shift, layer=layer)(load)
    lattice_x, lattice_y = 2.0 * np.pi * np.arange(-200, 201)[:, None], 2.0 * np.pi * np.arange(-100, 101)
    for qx in (0.3, 1.2, -2.0):
        found = np.exp(-1j * qx * (window.x - window.x[-reach])) @ displacement.sum(axis=1)
        along = qx + lattice_x
        q = np.hypot(along, lattice_y)
        waves = 2.0 * TWO_MODES.symbol(along) * layer.yielding(q) / q * sinc(along) * sinc(lattice_y)
        expected = (waves * np.exp(-1j * along * shift)).sum()
        # The lattice's sum ends where its terms alternate at 1e-8, or 1e-6 with a phase; 1e-9 fades off the window.
        assert found == pytest.approx(expected, rel=3e-6, abs=3e-6)


@pytest.mark.parametrize(("layer", "shift"), zip(LAYERS, (0.3, 0.0, 0.5), strict=True))
def test_waves_of_a_strips_influence_are_those_of_the_layer(layer: ScaledLayer, shift: float) -> None:
    reach = int(30.0 * layer.thickness + 4.0)
    strip = Grid(1.0, 90 + 2 * reach, reach)
    load = np.zeros(strip.shape)
    load[-reach] = 1.0
    displacement = LineLayerOperator(strip, TWO_MODES, shift, layer=layer)(load)[:, 0]
    lattice = 2.0 * np.pi * np.arange(-20_000, 20_001)
    for qx in (0.3, 1.2, -2.0):
        found = np.exp(-1j * qx * (strip.x - strip.x[-reach])) @ displacement
        q = qx + lattice
        waves = 2.0 * TWO_MODES.symbol(q) * layer.yielding(np.abs(q)) / np.abs(q) * sinc(q)
        expected = (waves * np.exp(-1j * q * shift)).sum()
        assert found == pytest.approx(expected, rel=1e-8, abs=1e-8)  # the memory's and the base's ends, as above


@pytest.mark.parametrize("memory_length", [1e-6, 0.1, 1.0, 10.0])
@pytest.mark.parametrize("bonded", [True, False])
def test_dissipated_energy_is_that_of_the_waves(memory_length: float, bonded: bool) -> None:
    """F_t = ∫ d²q/(4π²) 2 q_x Θ (−Im S)/|q| |p̂|² of the pressure exp(−r²/2), and in plane strain of exp(−x²/2).

    Compared is what the base takes away, 1 − Θ, in which the cells' edges have no part; test_operator has the rest.
    """
    h, layer = 0.2, ScaledLayer(0.6, bonded, 0.4)
    material = SteadyMaterial(0.1, np.array([0.9]), np.array([memory_length]))
    angle = 2.0 * np.pi * (np.arange(4000) + 0.5) / 4000
    points, weights = np.polynomial.legendre.leggauss(200)
    q, weight = 4.5 * (points[:, None] + 1.0), 4.5 * weights[:, None]

    bent = bent_share(material.memory_lengths / h)

    def loss(qx: np.ndarray) -> np.ndarray:
        # Second differences along x stand for the second derivative of the part that is found from bends.
        return 2.0 * qx * material.symbol(qx).imag * sinc(h * qx) * (1.0 - bent + bent * sinc(h * qx) ** 2)

    taken = 1.0 - layer.yielding(q)
    spectrum = taken * (2.0 * np.pi * np.exp(-0.5 * q**2)) ** 2
    across = sinc(h * q * np.cos(angle))
    expected = float((weight * spectrum * loss(q * np.sin(angle)) * across).sum()) / (4000.0 * 2.0 * np.pi)
    window = Grid(h, 40, 40, 40)
    pressure = np.exp(-0.5 * (window.x[:, None] ** 2 + window.y**2))
    on_layer = LayerOperator(window, material, layer=layer).dissipated_force(pressure)
    found = HalfSpaceOperator(window, material).dissipated_force(pressure) - on_layer
    # A memory much shorter than a cell is taken at its leading term, right to 1e-6 of the half-space's whole.
    assert found == pytest.approx(expected, rel=1e-5)
    expected = 2.0 * float((weight * taken * np.exp(-(q**2)) / q * loss(q)).sum())
    strip = Grid(h, 40, 40)
    pressure = np.exp(-0.5 * strip.x[:, None] ** 2)
    on_layer = LineLayerOperator(strip, material, layer=layer).dissipated_force(pressure)
    found = LineOperator(strip, material).dissipated_force(pressure) - on_layer
    assert found == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("bonded", [True, False])
def test_deep_layer_is_a_half_space_but_for_its_level(bonded: bool) -> None:
    x, y = np.arange(-30.0, 31.0)[:, None], np.arange(20.0)
    deep = LayerCell(1e6, bonded, 0.3)
    lowered = cell_potential(x, y) - deep(x, y)
    # The base takes what is the same everywhere, about 1/H, to (r/H)² of it.
    np.testing.assert_allclose(lowered, lowered[0, 0], rtol=1e-7)
    assert 0.1e-6 < lowered[0, 0] < 3e-6
    strip = Grid(0.1, 20, 20)
    pressure = np.random.default_rng(1).random(strip.shape)
    on_layer = LineLayerOperator(strip, TWO_MODES, layer=ScaledLayer(1e6, bonded, 0.3))(pressure)
    on_half_space = LineOperator(strip, TWO_MODES)(pressure)
    np.testing.assert_allclose(np.diff(on_layer, axis=0), np.diff(on_half_space, axis=0), rtol=1e-8, atol=1e-10)


def test_rectangle_of_a_layer_is_a_row_of_smaller_ones() -> None:
    x, y = np.array([0.0, 0.3, 1.0, 7.0, -9.0, 3.0, 40.0]), np.array([0.0, 0.4, 2.0, 3.0, 2.0, 7.0, 1.0])
    for thickness, aspect in ((0.5, 1.0), (4.0, 0.3), (30.0, 2.0)):
        whole = LayerCell(thickness, True, 0.4, aspect)
        third = LayerCell(3.0 * thickness, True, 0.4, 3.0 * aspect)
        summed = sum(third(3.0 * x + side, 3.0 * y) / 3.0 for side in (-1.0, 0.0, 1.0))
        np.testing.assert_allclose(whole(x, y), summed, atol=1e-10)  # as the half-space's


def test_elastic_indenter_is_a_half_space_on_a_layer_too() -> None:
    window = Grid(0.25, 6, 5, 4)
    pressure = np.random.default_rng(3).random(window.shape)
    layer = ScaledLayer(0.4, True, 0.5)
    alone = LayerOperator(window, TWO_MODES, 0.2, layer=layer)(pressure)
    none = np.empty(0)
    facing = HalfSpaceOperator(window, SteadyMaterial(0.7, none, none), 0.2)(pressure)
    material = SteadyMaterial(0.1, TWO_MODES.compliances, TWO_MODES.memory_lengths, counterface=0.7)
    both = LayerOperator(window, material, 0.2, layer=layer)
    np.testing.assert_allclose(both(pressure), alone + facing, rtol=1e-12)  # round-off
    assert both.dissipated_force(pressure) == pytest.approx(
        LayerOperator(window, TWO_MODES, layer=layer).dissipated_force(pressure), rel=1e-12
    )


@pytest.mark.parametrize("layer", [ScaledLayer(0.25, True, 0.5), *LAYERS], ids=name)
def test_every_pressure_on_a_layer_does_work_and_dissipates(layer: ScaledLayer) -> None:
    window, strip = Grid(0.25, 6, 5, 4), Grid(0.25, 12, 10)
    generator = np.random.default_rng(2)
    for memory_length in (1e-5, 0.3, 30.0):
        material = SteadyMaterial(0.1, np.array([0.9]), np.array([memory_length]))
        for operator in (LayerOperator(window, material, layer=layer), LineLayerOperator(strip, material, layer=layer)):
            shape = operator.window.shape
            for pressure in generator.random((3, *shape)):
                assert np.vdot(pressure, operator(pressure)) > 0.0
                assert operator.dissipated_force(pressure) > 0.0


def test_layer_thinner_than_the_grid_resolves_is_refused() -> None:
    with refused("layer-too-thin", ConvergenceError):
        LayerOperator(Grid(1.0, 4, 4, 4), TWO_MODES, layer=ScaledLayer(0.2, True, 0.3))
