"""Residuals extended beyond the contact: smooth, fading, going on behind a moving one; and what that spares."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import ndimage

import viscofric as vf
from contact.made_surfaces import self_affine
from marks import slow
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.complementarity import solve_on_contact
from viscofric.contact.extension import Extension, lag
from viscofric.contact.operators.convolution import both_halves, upper_half
from viscofric.contact.periodic import one_grid
from viscofric.contact.periodic.blocks import BlockExtension
from viscofric.contact.periodic.operator import PeriodicOperator
from viscofric.contact.periodic.transfer import SlidingSolid

#: E∞/E0 = 100, memory lengths of 1e-4 to 10 periods at unit speed.
SPECTRUM = vf.RetardationSpectrum(1.0, 100.0, np.full(20, 0.99 / 20), np.logspace(-4, 1, 20))


def sliding(points: int, velocity: tuple[float, float]) -> PeriodicOperator:
    transfer = SlidingSolid(SPECTRUM, 0.4, velocity).transfer((points, points), (1.0 / points,) * 2)
    return PeriodicOperator(transfer / np.abs(transfer).max(), (points, points))


@pytest.mark.parametrize("beside", [40, 67])
@pytest.mark.parametrize("late", [0.0, 0.7, -0.7])
def test_even_residuals_are_extended_on_one_side_as_on_both(late: float, beside: int) -> None:
    """In blocks of eight cells and, where their number is prime, of one."""
    backend, random = Backend("scipy"), np.random.default_rng(2)
    half = random.random((96, beside)) < 0.3
    whole = backend.cells(both_halves(half))
    values = both_halves(random.standard_normal(half.shape))
    block = 1 if beside % 8 else 8
    expected = Extension(backend, (96, 2 * beside), float, lag=late, block=block).on(whole)
    contact = backend.cells(half)
    found = Extension(backend, half.shape, float, lag=late, block=block, even=True).on(contact)
    # Rounding of FFTs and of cosines.
    np.testing.assert_allclose(
        both_halves(found(contact.gathered(upper_half(values)))), expected(whole.gathered(values)), atol=1e-12
    )


@pytest.mark.parametrize("fixed_load", [True, False])
@pytest.mark.parametrize("speed", [0.0, 1.0])
def test_extension_spares_steps(speed: float, fixed_load: bool) -> None:
    """On many spots of contact, whose edges the inverse symbol alone takes for the ends of the displacement."""
    points, random = 256, np.random.default_rng(0)
    operator = sliding(points, (speed, 0.0))
    centres = np.zeros((points, points))
    centres[random.integers(points, size=300), random.integers(points, size=300)] = 1.0
    contact = operator.backend.cells(ndimage.grey_dilation(centres, size=(5, 5), mode="wrap") > 0.0)
    gap = contact.gathered(operator(contact.scattered(random.random(len(contact))).copy()))
    extension = Extension(operator.backend, (points, points), operator.dtype)
    steps, found = [], []
    for given in (None, extension):
        correction, taken, residual = solve_on_contact(
            operator, gap, contact, reduction=1e-9, floor=0.0, directions=40, fixed_load=fixed_load, extension=given
        )
        assert residual <= 1e-9
        steps.append(taken)
        found.append(correction)
    # 14 or 15 of 21 steps were seen to be left at rest, 15 or 17 of 28 in motion.
    assert steps[1] < 0.75 * steps[0]
    # Residuals of 1e-9 take pressures of that times the condition of the problem, some hundreds.
    np.testing.assert_allclose(found[1], found[0], atol=1e-6 * np.abs(found[0]).max())


@pytest.mark.parametrize("shape", [(64, 48), (30, 7), (33, 1)])
def test_extension_goes_on_smoothly_from_spots_to_the_mean_of_all(shape: tuple[int, int]) -> None:
    """Whatever divides the grid: values are kept on the contact, and continued beyond it by means of them."""
    backend = PeriodicOperator(np.ones((shape[0], shape[1] // 2 + 1)), shape).backend
    chosen, half, long = np.zeros(shape, bool), shape[0] // 2, shape[0] // 6
    chosen[:long, : max(shape[1] // 3, 1)] = chosen[half : half + long, : max(shape[1] // 3, 1)] = True
    contact = backend.cells(chosen)
    extended = Extension(backend, shape, np.float64).on(contact)
    values = np.random.default_rng(0).random(len(contact))
    field = extended(values)
    np.testing.assert_array_equal(field[chosen], values)
    assert field.max() <= values.max()
    assert field[~chosen].min() >= 0.0
    np.testing.assert_allclose(extended(np.ones(len(contact))), 1.0, rtol=1e-9)
    # One on the first spot, three on the second: on the way they change from the one to the other.
    field = extended(np.where(contact.indices < half * shape[1], 1.0, 3.0))
    beside, between, behind = field[long, 0], field[(long + half) // 2, 0], field[half - 1, 0]
    assert 1.0 <= beside < 1.7
    assert 1.7 < between < 2.3
    assert 2.3 < behind <= 3.0


def test_pressures_beyond_the_contact_are_moved_to_their_neighbours_in_it() -> None:
    """By the part that the inverse operator says, also across the period; not those farther away."""
    operator = sliding(64, (0.0, 0.0))
    backend, chosen = operator.backend, np.zeros((64, 64), bool)
    chosen[0, 5:9] = True
    contact = backend.cells(chosen)
    extension = Extension(backend, (64, 64), np.float64, inverse=operator.inverse)
    kernel = backend.transforms.inverse(operator.inverse.copy(), (64, 64))
    field = np.zeros((64, 64))
    field[0, 6], field[63, 6], field[0, 9], field[2, 6] = 1.0, 10.0, 100.0, 1e6
    part = -1.5 * kernel[0, 1] / kernel[0, 0]
    wanted = [0.0, 1.0 + 10.0 * part, 0.0, 100.0 * part]
    # The inverse is taken from every eighth wave.
    np.testing.assert_allclose(extension.collecting(contact)(field), wanted, rtol=0.05)


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("toward", [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (1.0, -1.0), (2.0, 1.0)])
def test_values_go_on_behind_the_moving_contact(toward: tuple[float, float], way: float) -> None:
    """The nearest cells behind take their edge's value, farther ones less of it, none ahead; also across the period."""
    shape, backend = (64, 32), Backend()
    random = np.random.default_rng(0)
    chosen = np.zeros(shape, bool)
    chosen[28:64, :3] = chosen[0:3, :3] = True
    contact = backend.cells(chosen)
    values = random.random(len(contact))
    plain = Extension(backend, shape, np.float64).on(contact)(values).copy()
    found = Extension(backend, shape, np.float64, toward, way).on(contact)(values)
    np.testing.assert_array_equal(found[chosen], values)
    changed = (found != plain) & ~chosen
    ahead = way * np.array(toward) / np.hypot(*toward)
    reached = np.zeros(shape, bool)
    places = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij")).astype(float)
    for distance in range(1, 6):
        # Linear interpolation of the values at a distance ahead, of what is in contact there.
        at = np.round(places + distance * ahead[:, None, None], 12)
        share = ndimage.map_coordinates(chosen.astype(float), at, order=1, mode="grid-wrap")
        behind = (share > 1e-9) & ~chosen & ~reached
        edge = ndimage.map_coordinates(np.where(chosen, found, 0.0), at, order=1, mode="grid-wrap")[behind]
        weight = 1.0 - (distance - 1) / 5.0
        expected = weight * edge / share[behind] + (1.0 - weight) * plain[behind]
        np.testing.assert_allclose(found[behind], expected, rtol=1e-9)
        reached |= behind
    assert not changed[~reached].any()


@pytest.mark.parametrize("toward", [(1.0, 0.0), (0.6, 0.8), (-1.0, 0.2)])
def test_contact_that_moves_any_way_is_the_same_by_the_array_standard(toward: tuple[float, float]) -> None:
    pytest.importorskip("array_api_strict")
    rubber, surface = vf.Material(SPECTRUM, poisson_ratio=0.4), vf.contact.PeriodicSurface(self_affine(32), 1.0 / 32)
    one, other = (
        vf.solve_periodic(rubber, surface, speed=5.0, pressure=0.1, direction=toward, backend=backend)
        for backend in ("scipy", "array_api_strict")
    )
    # Both to 1e-8 of the rms height.
    assert other.friction_coefficient == pytest.approx(one.friction_coefficient, rel=1e-6)
    assert abs(other.diagnostics.ffts - one.diagnostics.ffts) <= 10


def test_lag_shows_how_late_short_waves_answer_and_which_way() -> None:
    points = 128
    late = {way: lag(sliding(points, way).transfer, points, (1.0, 0.0)) for way in ((30.0, 0.0), (-30.0, 0.0))}
    assert late[30.0, 0.0] == -late[-30.0, 0.0]
    assert late[30.0, 0.0] > 0.9
    assert lag(sliding(points, (0.0, 0.0)).transfer, points, (1.0, 0.0)) == 0.0
    straight = lag(sliding(points, (0.3, 0.0)).transfer, points, (1.0, 0.0))
    assert straight < 0.8
    for angle in (0.3, 2.0, 4.0, -0.7):
        toward = (math.cos(angle), math.sin(angle))
        oblique = sliding(points, (0.3 * toward[0], 0.3 * toward[1])).transfer
        # The same waves, but for the rounding of their number along x and y.
        assert lag(oblique, points, toward) == pytest.approx(straight, rel=0.02)
        assert lag(oblique, points, (-toward[0], -toward[1])) == -lag(oblique, points, toward)


@pytest.mark.parametrize(("angle", "left"), [(0.0, 0.65), *slow((math.pi, 0.65), (0.6, 0.9))])
def test_going_on_behind_spares_work_where_memories_are_some_cells_long(
    angle: float, left: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a surface with kinks; smooth ones take fewer steps without."""
    points = 256
    z = ndimage.map_coordinates(self_affine(32), np.mgrid[:points, :points] / 8.0, order=1, mode="grid-wrap")
    z = z if angle != math.pi else np.roll(z[::-1], 1, axis=0)  # the same contact, mirrored
    surface, rubber = vf.contact.PeriodicSurface(z, 1.0 / points), vf.Material(SPECTRUM, poisson_ratio=0.4)

    def ffts() -> int:
        direction = math.cos(angle), math.sin(angle)
        found = vf.solve_periodic(rubber, surface, speed=32.0, pressure=0.1, direction=direction)
        return found.diagnostics.ffts

    late = ffts()
    monkeypatch.setattr(one_grid, "lag", lambda *_: 0.0)
    # 106 of 190 and 106 of 186 FFTs were seen along x, 132 of 164 obliquely.
    assert late < left * ffts()


@pytest.mark.parametrize("held", ["pressure", "gap"])
@pytest.mark.parametrize("speed", [0.0, *slow(1.0)])
def test_the_contact_of_blocks_spares_ffts_and_leaves_the_contact_as_it_is(
    speed: float, held: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    surface = vf.contact.PeriodicSurface(self_affine(256), 1.0 / 256)
    given = {"pressure": 0.05} if held == "pressure" else {"gap": surface.rms_height}
    found = []
    for fewest in (256**2 + 1, 256**2):
        monkeypatch.setattr(one_grid, "_FEWEST_ON_BLOCKS", fewest)
        found.append(vf.solve_periodic(vf.Material(SPECTRUM), surface, speed=speed, tolerance=1e-8, **given))
    without, with_blocks = found
    # 28 of 36 and 28 of 40 FFTs were seen to be left at rest, 36 of 40 and 40 of 48 in motion.
    assert with_blocks.diagnostics.ffts < without.diagnostics.ffts
    # Gaps within 1e-8 of the rms height take pressures within that times the condition of the problem, some hundreds.
    np.testing.assert_allclose(with_blocks.pressure, without.pressure, atol=1e-5 * without.max_pressure)


def test_pressures_on_a_contact_are_raised_to_the_loads_of_its_blocks() -> None:
    """In long waves whatever they were, in short ones not at all."""
    operator = sliding(128, (1.0, 0.0))
    x = np.arange(128)
    # Half of each block, so that no cell carries more than another.
    contact = Backend().cells((x[:, None] + x) % 2 == 0)
    blocks = BlockExtension(operator, (1.0, 0.0), 0.5, fixed_load=False)
    wanted = 1.0 + np.cos(2.0 * np.pi * x / 128)[:, None] * np.cos(2.0 * np.pi * x / 64)
    blocks.on(contact)(contact.gathered(wanted))
    pressure = 0.5 * operator.precondition(wanted)
    moved = Extension(operator.backend, (128, 128), operator.dtype, inverse=operator.inverse).collecting(contact)

    def loads(pressure: np.ndarray) -> np.ndarray:
        field = contact.scattered(pressure).reshape(16, 8, 16, 8).mean(axis=(1, 3))
        return np.array([np.fft.fft2(field)[wave] for wave in ((0, 0), (1, 2), (1, 14))])

    of_blocks = loads(blocks.collecting(contact)(np.zeros_like(pressure)))
    raised, before = loads(blocks.collecting(contact)(pressure)), loads(moved(pressure))
    # Missing loads are distributed by a Gaussian with a standard deviation of two of the 16 blocks of a period.
    distributed = np.exp(-0.5 * (2.0 * 2.0 * np.pi / 16 * np.sqrt([0.0, 5.0, 5.0])) ** 2)
    np.testing.assert_allclose(raised, of_blocks + (1.0 - distributed) * before, rtol=1e-4)
    assert of_blocks[0].real > 0.0
    assert abs(raised[1] - before[1]) > 0.1 * abs(before[1])
