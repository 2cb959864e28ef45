"""Maps of heat on cells: closed forms, layers, time, periodic ones, and agreement with discs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.heat.means import disc_mean

UNIT = vf.ThermalProperties(1.0, 1.0, 1.0, "unit")
EVEN = np.ones((64, 64))


def rise(heat: np.ndarray, **settings: Any) -> np.ndarray:
    return vf.heat.surface_temperature(heat, settings.pop("spacing", 1.0), UNIT, **{"speed": 0.0, **settings})


def disc(cells: int, hertz: bool) -> tuple[np.ndarray, np.ndarray]:
    """Heat and share of each cell within a disc of radius 1, by points within cells."""
    points = 8 * cells
    x = (2.0 * np.arange(points) + 1.0) / points - 1.0
    square = x[:, None] ** 2 + x**2
    inside = (square < 1.0).astype(float)
    heat = 1.5 * np.sqrt(np.maximum(1.0 - square, 0.0)) if hertz else inside
    means = [one.reshape(cells, 8, cells, 8).mean((1, 3)) for one in (heat, inside)]
    return means[0], means[1] / means[1].sum()


@pytest.mark.parametrize("hertz", [False, True])
@pytest.mark.parametrize("peclet", [0.0, 0.1, 10.0, 1e3])
def test_a_map_of_a_disc_warms_like_the_disc(peclet: float, hertz: bool) -> None:
    """The rim is made of cells: an error that falls with their size, of order 3/2, and is 2e-3 here."""
    errors = []
    for cells in (32, 64):
        heat, mean = disc(cells, hertz)
        found = np.sum(mean * rise(heat, spacing=2.0 / cells, speed=2.0 * peclet))
        errors.append(abs(found / disc_mean(peclet, hertz=hertz) - 1.0))
    assert errors[1] < 2e-3
    assert errors[0] / errors[1] > 2.3


def test_a_square_at_rest_has_its_closed_form() -> None:
    """2 ln(1 + √2)/π q l/k in the middle (Carslaw and Jaeger, Sec. 10.5)."""
    assert rise(np.ones((1, 1)))[0, 0] == pytest.approx(2.0 * np.arcsinh(1.0) / np.pi, rel=1e-9)


def test_time_and_layers_have_the_limits_of_a_plane_source() -> None:
    """In the middle of a wide map: 2√(t/π), H, t/H + H/3 (all in units), which the rim changes by exp(−32²/4t)."""
    middle = 32, 32
    assert rise(EVEN, time=4.0)[middle] == pytest.approx(2.0 * np.sqrt(4.0 / np.pi), rel=1e-9)
    assert rise(EVEN, thickness=0.5)[middle] == pytest.approx(0.5, rel=1e-9)
    warmed = rise(EVEN, thickness=0.5, base="insulated", time=4.0)[middle]
    assert warmed == pytest.approx(4.0 / 0.5 + 0.5 / 3.0, rel=1e-9)
    for base in ("isothermal", "insulated"):
        assert rise(EVEN, thickness=1e5, base=base, time=1e4) == pytest.approx(rise(EVEN, time=1e4), rel=1e-9)
        assert rise(EVEN, thickness=1.0, base=base, time=1e-3) == pytest.approx(rise(EVEN, time=1e-3), rel=1e-9)
    assert rise(EVEN, time=1e12) == pytest.approx(rise(EVEN), rel=1e-4)


@pytest.mark.parametrize("speed", [0.0, 3.0, -20.0])
def test_periodic_maps_equal_free_ones_before_they_meet(speed: float) -> None:
    """Waves against cells: a band-limited map differs at the rim of the disc, by 7e-3 with 16 cells across."""
    heat = np.zeros((64, 48))
    heat[24:40, 16:32] = disc(16, True)[0]
    settings: dict[str, Any] = {"spacing": 1.0 / 8.0, "speed": speed}
    both = {"time": 0.05, "thickness": 0.15}
    for more in ({"time": 0.05}, {"thickness": 0.15}, both, {**both, "base": "insulated"}):
        free, waves = rise(heat, **settings, **more), rise(heat, **settings, **more, periodic=True)
        assert np.abs(waves - free).max() < 1e-2 * free.max()


def test_a_steady_periodic_map_shows_the_rise_above_the_mean() -> None:
    """One wave: cos qx at Pe → q s with s² = q² − iqv/κ; layers multiply by tanh or coth of sH."""
    x = np.arange(16)
    q, speed, thickness = 2.0 * np.pi / 16.0, 0.7, 3.0
    wave = np.cos(q * x)[:, None] * np.ones(8)
    s = np.sqrt(q**2 - 1j * q * speed)
    for more, factor in (
        ({}, 1.0),
        ({"thickness": thickness}, np.tanh(s * thickness)),
        ({"thickness": thickness, "base": "insulated"}, 1.0 / np.tanh(s * thickness)),
    ):
        expected = np.real(np.exp(1j * q * x) * factor / s)
        found = rise(5.0 + wave, speed=speed, periodic=True, **more) - (15.0 if len(more) == 1 else 0.0)
        assert found[:, 3] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("base", ["isothermal", "insulated"])
def test_a_periodic_map_on_a_layer_is_that_of_a_half_space_at_first_and_steady_at_last(base: str) -> None:
    """And is smooth where one formula takes over from the other (H = 6 √(κt)); even heat warms as its series says."""
    heat = np.random.default_rng(1).random((12, 9))
    layer: dict[str, Any] = {"speed": 2.0, "periodic": True, "thickness": 3.0, "base": base}
    just = [rise(heat, **layer, time=0.25 * (1.0 + one)) for one in (-1e-12, 1e-12)]
    assert just[0] == pytest.approx(just[1], rel=1e-10)
    assert just[0] == pytest.approx(rise(heat, speed=2.0, periodic=True, time=0.25), rel=1e-10)
    level = 3.0 if base == "isothermal" else 100.0 / 3.0 + 1.0  # H, or t/H + H/3
    last, steady = rise(heat, **layer, time=100.0), rise(heat, **layer)
    assert last - last.mean() == pytest.approx(steady - steady.mean(), abs=1e-9)
    assert last.mean() == pytest.approx(level * heat.mean(), rel=1e-9)


def test_motion_the_other_way_is_the_mirror_image() -> None:
    heat = np.random.default_rng(1).random((12, 9))
    assert rise(heat, speed=-2.0) == pytest.approx(rise(heat[::-1], speed=2.0)[::-1], rel=1e-12)
    assert rise(heat, speed=2.0, time=1e9) == pytest.approx(rise(heat, speed=2.0), rel=1e-9)


def test_what_warms_without_end_is_refused() -> None:
    with refused("no-steady-state"):
        rise(EVEN, thickness=1.0, base="insulated")
    with refused("shape"):
        rise(np.ones(4))
