"""One contact, whatever arrays and FFTs it is solved with; requests for others are refused in one sentence."""

from __future__ import annotations

import math
import pickle
import subprocess
import sys
import time
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.typing import NDArray

import viscofric as vf
from contact.made_surfaces import self_affine
from marks import apart
from refusals import refused
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.complementarity import solve_complementarity
from viscofric.contact.free.grids import Grid
from viscofric.contact.operators.convolution import SteadyMaterial, both_halves, is_even, upper_half
from viscofric.contact.operators.half_space import HalfSpaceOperator
from viscofric.contact.periodic.operator import PeriodicOperator
from viscofric.contact.periodic.splitting import split_steps
from viscofric.errors import InputError
from viscofric.processes import Workers, call_all
from viscofric.threads import THREADS_VARIABLE, in_parts, so_many, threads_for, usable_threads

OTHERS = ("array_api_strict", "ducc0", "torch:cpu", "torch:cuda", "cupy")
# The solver's own error at this tolerance, which another rounding may shift; pressures are well conditioned here.
TOLERANCE, SAME = 1e-12, 1e-10
BALL, CYLINDER = vf.Ball(radius=0.01), vf.Cylinder(radius=0.01)
TWO_MODES = SteadyMaterial(0.01, np.array([0.49, 0.5]), np.array([0.2, 30.0]))


def available(name: str) -> Backend:
    try:
        return Backend(name)
    except InputError as missing:
        pytest.skip(str(missing))


@pytest.fixture(params=OTHERS)
def backend(request: pytest.FixtureRequest) -> Backend:
    return available(request.param)


def ball(backend: Backend | str, indenter: vf.Indenter = BALL, load: float = 1.0) -> vf.contact.ContactSolution:
    rubber = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3)
    return vf.solve_steady(rubber, indenter, speed=1.0, load=load, accuracy=0.02, tolerance=TOLERANCE, backend=backend)


def rough(backend: Backend | str, *, speed: float, **given: float) -> vf.contact.PeriodicSolution:
    modes = vf.RetardationSpectrum(1.0, 100.0, np.full(20, 0.99 / 20), np.logspace(-4, 1, 20))
    surface = vf.contact.PeriodicSurface(self_affine(64), 1.0 / 64)
    return vf.solve_periodic(
        vf.Material(modes), surface, speed=speed, tolerance=TOLERANCE, backend=backend, **given or {"pressure": 0.1}
    )


CONTACTS = {
    "ball": ball,
    "roller": partial(ball, indenter=CYLINDER, load=100.0),
    "rough, elastic": lambda backend: rough(backend, speed=0.0),
    "rough, viscoelastic": lambda backend: rough(backend, speed=1.0),
    "rough, given gap": lambda backend: rough(backend, speed=1.0, gap=0.1),
    "rough, full contact": lambda backend: rough(backend, speed=1.0, pressure=20.0),
}


@cache
def by_scipy(name: str) -> vf.contact.ContactSolution | vf.contact.PeriodicSolution:
    return CONTACTS[name]("scipy")


def assert_same(found: NDArray[np.float64], expected: NDArray[np.float64]) -> None:
    assert isinstance(found, np.ndarray)
    assert found.dtype == np.float64
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=SAME * np.abs(expected).max())


@pytest.mark.parametrize("name", CONTACTS)
@pytest.mark.slow
def test_contact_is_the_same_with_any_arrays_and_ffts(name: str, backend: Backend) -> None:
    expected = by_scipy(name)
    found = CONTACTS[name](backend)
    assert np.all(expected.pressure > 0.0) == (name == "rough, full contact")
    assert_same(found.pressure, expected.pressure)
    assert_same(found.displacement, expected.displacement)
    assert found.friction_coefficient == pytest.approx(expected.friction_coefficient, rel=SAME, abs=SAME)
    assert found.indentation == pytest.approx(expected.indentation, rel=SAME)


@pytest.mark.parametrize("precision", [np.float64, np.float32])
def test_accelerated_splitting_is_the_same_with_any_arrays_and_ffts(precision: type, backend: Backend) -> None:
    """In single precision where arrays are NumPy's: elsewhere all is in double precision."""
    if precision is np.float32 and not backend.is_numpy:
        pytest.skip("corrections are in double precision here")
    q = np.hypot(np.fft.fftfreq(32)[:, None], np.fft.rfftfreq(32))
    q[0, 0] = np.inf
    transfer = (1.0 + 0.5j * np.sign(np.fft.fftfreq(32))[:, None]) / q
    transfer[16] = np.abs(transfer[16])  # the shortest wave is real
    height = self_affine(32)
    height -= height.min()

    def pressures(where: Backend) -> NDArray[np.float64]:
        operator = PeriodicOperator(transfer, (32, 32), precision, where)
        guess = np.ones((32, 32))
        found = split_steps(
            operator, height, guess, load=10.0, indentation=None, steps=12, accelerated=True,
            rho=0.5 * math.sqrt(math.prod(operator.compliance_range)),
        )  # fmt: skip
        return where.to_numpy(found)

    expected = pressures(Backend())
    # Twelve steps of an extrapolation that amplifies the rounding of single precision some tenfold each.
    tolerance = 1e-10 if precision is np.float64 else 1e-3
    np.testing.assert_allclose(pressures(backend), expected, rtol=0.0, atol=tolerance * expected.max())


@pytest.mark.parametrize("precision", [np.float32, np.float64])
@pytest.mark.parametrize("shape", [(37, 23), (40, 1), (5, 64)])
def test_convolutions_in_blocks_are_those_of_whole_arrays(
    precision: type, shape: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Blocks of a few rows and columns, the last ones smaller, do the same operations."""
    rng = np.random.default_rng(8)
    padded = (2 * shape[0], 2 * shape[1])
    values = rng.standard_normal(shape).astype(precision)
    transforms = Backend().transforms
    factor = transforms.forward(rng.standard_normal(padded).astype(precision))
    whole = transforms.convolved(values, factor, padded)
    monkeypatch.setattr("viscofric.contact.arrays.transforms._LARGE", 0)
    monkeypatch.setattr("viscofric.contact.arrays.transforms._BLOCK", 3000)
    found = transforms.convolved(values, factor, padded)
    assert found.dtype == precision
    # FFTs of several lines at once may add in another order.
    np.testing.assert_allclose(found, whole, rtol=0.0, atol=10.0 * np.finfo(precision).eps * np.abs(whole).max())


def test_padded_transforms_are_plain_convolutions(backend: Backend) -> None:
    rng = np.random.default_rng(5)
    influence, values = rng.standard_normal((13, 9)), rng.standard_normal((7, 5))
    padded = (15, 9)
    transforms = backend.transforms
    spectrum = transforms.forward_padded(backend.asarray(influence), padded)
    waves = transforms.forward_padded(backend.asarray(values), padded)
    waves *= spectrum
    found = backend.to_numpy(transforms.inverse_cropped(waves, padded, (7, 5)))
    expected = np.zeros((7, 5))
    for i, j in np.ndindex(7, 5):
        for k, m in np.ndindex(i + 1, j + 1):
            expected[i, j] += influence[k, m] * values[i - k, j - m]
    # The cyclic convolution agrees with the plain one where nothing wraps around: from the first cells on that
    # neither axis has wrapped, 13 + 7 - 1 - 15 = 4 and 9 + 5 - 1 - 9 = 4.
    np.testing.assert_allclose(found[4:, 4:], expected[4:, 4:], rtol=0.0, atol=1e-13)


def test_cells_are_gathered_and_scattered_in_order(backend: Backend) -> None:
    field = np.arange(12.0).reshape(3, 4)
    for chosen in (field % 3.0 == 1.0, field == 11.0, field >= 0.0):
        cells = backend.cells(backend.asarray(chosen))
        values = cells.gathered(backend.asarray(field))
        assert len(cells) == np.count_nonzero(chosen)
        np.testing.assert_array_equal(backend.to_numpy(values), field[chosen])
        np.testing.assert_array_equal(backend.to_numpy(cells.scattered(values)), np.where(chosen, field, 0.0))


def test_readonly_and_mirrored_arrays_are_taken(backend: Backend) -> None:
    values = np.arange(6.0).reshape(2, 3)[::-1]
    values.flags.writeable = False
    np.testing.assert_array_equal(backend.to_numpy(backend.asarray(values)), values)


def test_solver_leaves_what_it_is_given(backend: Backend) -> None:
    window = Grid.around(1.0, 1.0, 1.0, 16)
    operator = HalfSpaceOperator(window, SteadyMaterial(1.0, np.empty(0), np.empty(0)), backend=backend)
    height = 0.5 * (window.x[:, None] ** 2 + window.y**2)
    guess = np.ones(window.shape)
    before = height.copy(), guess.copy()
    assert solve_complementarity(operator, height, 1.0, guess).converged
    np.testing.assert_array_equal(height, before[0])
    np.testing.assert_array_equal(guess, before[1])


# --- choice -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("jax", "unknown-backend"),
        ("", "unknown-backend"),
        ("scipy:cuda", "no-device"),
        ("ducc0:", "no-device"),
    ],
)
def test_unknown_backends_are_refused(name: str, code: str) -> None:
    with refused(code):
        ball(name)
    with refused(code):
        rough(name, speed=0.0)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("ducc0", "pip install ducc0"),
        ("torch", "pytorch.org"),
        ("torch:cuda", "pytorch.org"),
        ("cupy", "docs.cupy.dev"),
        ("array_api_strict", "pip install array-api-strict"),
    ],
)
def test_missing_libraries_are_named_with_their_installation(
    name: str, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    library = name.partition(":")[0]
    # An entry of None makes an import fail as if nothing were installed.
    for module in (library, f"{library}.fft", f"{library}.interfaces.scipy_fft"):
        monkeypatch.setitem(sys.modules, module, None)
    with refused("not-installed", naming=(f"backend = '{name}'", words)):
        Backend(name)


def test_unknown_device_is_refused() -> None:
    pytest.importorskip("torch")
    with refused("no-device"):
        Backend("torch:abacus")


def test_cupy_without_a_gpu_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cupy", SimpleNamespace(is_available=lambda: False))
    with refused("no-device"):
        Backend("cupy")


@pytest.mark.parametrize("threads", [0, -1, 1.5, True, "2"])
def test_threads_are_whole_numbers(threads: int) -> None:
    with refused("threads"):
        Backend("scipy", threads=threads)


def test_large_ffts_have_a_thread_for_each_processor_unless_set_otherwise(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.sched_getaffinity", lambda _: {0, 1, 2, 3}, raising=False)
    monkeypatch.delenv(THREADS_VARIABLE, raising=False)
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    large, small = 2048 * 2048, 256 * 256
    assert threads_for(large) == 4
    assert threads_for(large, 3) == 3
    assert threads_for(2**19, 64) == 4
    assert threads_for(small, 3) == 1
    monkeypatch.setenv("OMP_NUM_THREADS", "1")  # as in the workers of a cluster
    assert threads_for(large) == 1
    monkeypatch.setenv(THREADS_VARIABLE, "2")
    assert threads_for(large) == 2
    monkeypatch.setenv(THREADS_VARIABLE, "many")
    with refused(THREADS_VARIABLE):
        Backend()
    with refused("no-threads"):
        Backend("array_api_strict", threads=2)


def test_processes_share_the_processors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(THREADS_VARIABLE, "5")
    with Workers(2) as workers:
        assert call_all(usable_threads, [{}, {}], workers=workers) == [2, 2]


@pytest.mark.parametrize("name", ["scipy", "ducc0"])
def test_threads_change_no_digit(name: str) -> None:
    values = np.random.default_rng(1).normal(size=(900, 640))  # more than enough for several threads
    available(name)
    one, two = (Backend(name, threads=threads).transforms for threads in (1, 2))
    assert threads_for(values.size, 2) == 2
    factor = one.forward_padded(values, (1800, 1280))
    for transformed in (
        lambda by: by.forward(values),
        lambda by: by.inverse(one.forward(values), values.shape),
        lambda by: by.convolved(values, factor, (1800, 1280)),
        lambda by: by.convolved_even(values, factor[:901, :640], (1800, 640)),
    ):
        np.testing.assert_array_equal(transformed(one), transformed(two))


@pytest.mark.parametrize("beside", [3, 5, 40])
@pytest.mark.parametrize("name", ["scipy", "ducc0"])
def test_even_pressures_need_the_cells_on_one_side_only(name: str, beside: int) -> None:
    """Their products, also with the transposed and damped matrices, under shear, and the inverse, as on all cells."""
    window = Grid(spacing=0.25, behind=23, ahead=20, beside=beside)
    dragged = replace(TWO_MODES, drag=0.4, coupling=0.3)
    whole = HalfSpaceOperator(window, dragged, shift=0.3, backend=available(name))
    half = np.random.default_rng(4).standard_normal((window.shape[0], beside))
    for operator in (whole, whole.transposed(), whole.damped(0.7)):
        for every, some in ((operator, operator.even), (operator.precondition, operator.even.precondition)):
            expected = every(both_halves(half))
            assert is_even(expected)
            # Rounding of FFTs.
            np.testing.assert_allclose(some(half), upper_half(expected), atol=1e-13 * np.abs(expected).max())


def test_the_dissipated_force_takes_no_more_threads_than_those_given(monkeypatch: pytest.MonkeyPatch) -> None:
    window = Grid(spacing=0.25, behind=9, ahead=7, beside=8)
    operator = HalfSpaceOperator(window, TWO_MODES, backend=Backend("scipy", threads=1))
    expected = operator.dissipated_force(np.ones(window.shape))
    monkeypatch.setattr("viscofric.threads._LARGE", 1)
    monkeypatch.setattr("viscofric.threads._EACH", 1)
    monkeypatch.setattr("viscofric.threads.usable_threads", None)
    assert operator.dissipated_force(np.ones(window.shape)) == expected


def test_parts_cover_all_rows_in_their_order_with_any_threads() -> None:
    """Each row once, the results by rows; small arrays, and those of other libraries, whole."""
    values, column = np.arange(2.0 * 900 * 700).reshape(900, 700, 2), np.arange(900)[:, None, None]

    def add(found: NDArray[np.float64], values: NDArray[np.float64], column: NDArray[np.int64]) -> int:
        found += values + column
        return int(column[0, 0, 0])

    for threads in (1, 2, 3):
        found = np.zeros_like(values)
        first = in_parts(add, found, values, column, threads=threads)
        np.testing.assert_array_equal(found, values + column)
        assert len(first) > threads
        assert first == sorted(first)
    assert in_parts(len, values[:100]) == [100]
    with pytest.raises(ZeroDivisionError):
        in_parts(lambda _: 1 // 0, values, threads=2)


@pytest.mark.parametrize("threads", [1, 2])
def test_parts_after_one_that_fails_are_left(threads: int) -> None:
    values = np.ones((1000, 4000))  # 31 parts
    done: list[int] = []
    values[0] = 0.0

    def reciprocal(part: NDArray[np.float64]) -> None:
        if not part.all():
            raise ZeroDivisionError
        time.sleep(0.02)
        done.append(len(part))

    with pytest.raises(ZeroDivisionError):
        in_parts(reciprocal, values, threads=threads)
    assert len(done) < 15  # one, unless the thread of the first part is late


def test_parts_are_done_once_the_main_thread_has_ended(tmp_path: Path) -> None:
    """No further thread can be started then."""
    script = """
import threading
import numpy as np
from viscofric.threads import in_parts
def work():
    threading.main_thread().join()
    print(sum(in_parts(np.size, np.zeros((1024, 1024)), threads=2)))
threading.Thread(target=work).start()
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, cwd=tmp_path, check=True)
    assert (done.stdout.strip(), done.stderr) == (str(1024**2), "")


def test_so_many_threads_hold_within_only(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(THREADS_VARIABLE, "5")
    with so_many(3):
        assert usable_threads() == 3
        with so_many(None):
            assert usable_threads() == 3
        with so_many(1):
            assert usable_threads() == 1
    assert usable_threads() == 5


@pytest.mark.parametrize("given", [{"pressure": "200 kPa"}, *apart({"gap": "3 cm"})], ids=["pressure", "gap"])
def test_threads_change_no_contact(given: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> None:
    # Fewer than 724 points a side have one thread.
    surface = vf.contact.PeriodicSurface(self_affine(768), 1.0 / 768)
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")

    def solved(threads: int) -> vf.contact.PeriodicSolution:
        return vf.solve_periodic(
            rubber, surface, speed="1 m/s", **given, backend=Backend("scipy", threads), tolerance=1e-4
        )

    two = solved(2)
    monkeypatch.setattr("viscofric.threads.ThreadPoolExecutor", None)  # one thread is none besides the calling one
    one = solved(1)
    for name in ("pressure", "displacement", "gap", "friction_coefficient", "pressure_friction_coefficient"):
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name), name)


def test_backends_are_values() -> None:
    backend = Backend("scipy", threads=2)
    assert pickle.loads(pickle.dumps(backend)) == backend
    assert hash(backend) == hash(Backend("scipy", threads=2))
    assert backend != Backend("scipy", threads=1)
    assert Backend.of(backend) is backend
