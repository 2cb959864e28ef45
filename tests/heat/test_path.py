"""Mean rise of a contact along its path: steady sources at the end, partition between both bodies, all heat counted."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf
from viscofric.contact.fields.dissipation import Modes
from viscofric.contact.heating import thermal_resistances
from viscofric.heat.path import Passage, between_depths, density, path_rise

RUBBER = vf.ThermalProperties("0.3 W/m/K", "1150 kg/m**3", "1700 J/kg/K", "rubber")
STEEL = vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "steel")
#: Takes no heat worth speaking of.
AIR = vf.ThermalProperties(1e-9, "1 kg/m**3", "1 J/kg/K", "nothing")
SIZE = 1e-3


def passage(shape: str, peclet: float, radii: float, count: int = 30) -> tuple[Passage, np.ndarray]:
    """Slide so far, in radii, with times dense before the end; also return the durations."""
    speed = 2.0 * peclet * RUBBER.diffusivity / SIZE
    end = radii * SIZE / speed
    time = np.sort(end - np.append(np.geomspace(1e-6 * end, end, count), 0.0))
    return Passage(time, np.stack([speed * time, 0.0 * time], 1), np.full(len(time), SIZE), shape), np.diff(
        time, prepend=0.0
    )


@pytest.mark.parametrize(
    ("shape", "peclet", "radii"),
    [("disc", 0.1, 100.0), ("disc", 10.0, 400.0), ("disc", 1e3, 100.0), ("strip", 10.0, 400.0)],
)
def test_the_rise_ends_at_that_of_a_steady_source(shape: str, peclet: float, radii: float) -> None:
    path, durations = passage(shape, peclet, radii)
    heating = vf.Heating(rubber=RUBBER, counterface=AIR)
    found = path_rise(path, durations, 0.0 * durations, heating)
    speed = 2.0 * peclet * RUBBER.diffusivity / SIZE
    steady = vf.heat.MovingHeatSource(1.0, size=SIZE, speed=speed, body=RUBBER, shape=shape).mean_temperature  # type: ignore[arg-type]
    assert found.face[-1] == pytest.approx(steady, rel=1e-3)  # of the start, 5e-4 is left at the lowest speed


def test_faces_share_heat_as_their_steady_resistances_do() -> None:
    """A still source warms rubber and steel to the same temperature with heats in the ratio of conductivities."""
    end = 1e5 * SIZE**2 / RUBBER.diffusivity
    time = np.append(0.0, np.geomspace(1e-4, end, 30))
    path = Passage(time, np.zeros((31, 2)), np.full(31, SIZE), "disc")
    heat = np.diff(time, prepend=0.0)
    found = path_rise(path, heat, 0.0 * heat, vf.Heating(rubber=RUBBER, counterface=STEEL))
    share = found.counterface[-1] / heat[-1]
    assert share == pytest.approx(46.0 / 46.3, abs=1e-3)


def test_a_source_that_comes_back_meets_its_own_heat() -> None:
    time = np.linspace(0.0, 0.4, 41)
    there = np.where(time < 0.2, 0.05 * time, 0.05 * (0.4 - time))  # 10 radii to and fro
    heat = np.diff(time, prepend=0.0)
    heating = vf.Heating(rubber=RUBBER, counterface=AIR)
    back, onward = (
        path_rise(Passage(time, np.stack([x, 0.0 * x], 1), np.full(41, SIZE), "disc"), heat, 0.0 * heat, heating).face
        for x in (there, 0.05 * time)
    )
    assert back[:20] == pytest.approx(onward[:20])
    assert back[-1] > 1.05 * onward[-1]


def test_times_that_differ_by_rounding_are_one_time() -> None:
    """Such as a time asked for next to one of the history: the rise is that without one of them."""
    time = np.array([0.0, 0.01, np.nextafter(0.01, 1.0), 0.03, 0.05])
    heating = vf.Heating(rubber=RUBBER, counterface=STEEL)
    both, one = (
        path_rise(
            Passage(each, np.stack([0.1 * each, 0.0 * each], 1), np.full(len(each), SIZE), "disc"),
            np.diff(each, prepend=0.0), np.diff(each, prepend=0.0), heating,
        )
        for each in (time, np.delete(time, 2))
    )  # fmt: skip
    assert np.delete(both.face, 2) == pytest.approx(one.face, rel=1e-9)
    assert np.delete(both.below, 2) == pytest.approx(one.below, rel=1e-9)


@pytest.mark.parametrize(("shape", "power"), [("disc", 2), ("strip", 1)])
def test_distances_have_a_probability_of_one(shape: str, power: int) -> None:
    for spread in (1e-5, 1e-2, 1.0, 9.9, 10.1):
        reach = 2.0 + 8.0 * np.sqrt(2.0 * spread)
        place = np.linspace(0.0, reach, 20001)
        ring = 2.0 * np.pi * place if power == 2 else 2.0
        found = density(place, np.full(len(place), spread), shape) * ring
        assert np.trapezoid(found, place) == pytest.approx(1.0, abs=2e-3)


@pytest.mark.parametrize("shape", ["disc", "strip"])
def test_the_loss_warms_the_rubber_as_its_depths_do_each_other(shape: str) -> None:
    """Sums over the density z exp(−z/b)/b² of depths, against closed forms."""
    b = 0.5 if shape == "disc" else 0.65
    node, weight = np.polynomial.legendre.leggauss(400)
    z, dz = 15.0 * b * (1.0 + node), 15.0 * b * weight
    share = z * np.exp(-z / b) / b**2 * dz
    assert share.sum() == pytest.approx(1.0, abs=1e-9)
    spread = np.array([0.01, 0.3, 5.0, 0.99 * (20.0 * b) ** 2, 1.01 * (20.0 * b) ** 2, 1e6])
    found = between_depths(spread, shape)
    for place, four in enumerate((4.0 * spread).tolist()):
        ahead, behind = (np.exp(-np.square(z[:, None] + sign * z) / four) for sign in (-1.0, 1.0))
        assert found[1, place] == pytest.approx(share @ np.exp(-z * z / four), rel=1e-7)
        assert found[2, place] == pytest.approx(0.5 * share @ (ahead + behind) @ share, rel=1e-6)


@pytest.mark.apart
@pytest.mark.parametrize("broad", [False, True])
@pytest.mark.parametrize("line", [False, True])
def test_the_rises_at_the_end_of_a_slide_are_near_those_of_the_steady_contact(line: bool, broad: bool) -> None:
    """With the loss where a contact releases it, for memories that the depth z exp(−z/b) was not chosen at."""
    lasting = [0.05, 0.5, 5.0] if broad else [0.3, 3.0]  # of modes, in sizes of the contact
    for speed in (0.1, 10.0):
        contact, size, modes = _steady(lasting, line, speed)
        for peclet in (0.3, 3.0, 30.0):
            body = vf.ThermalProperties(0.3, 1150.0, 2.0 * peclet * 0.3 / (speed * size * 1150.0), "rubber")
            heating = vf.Heating(rubber=body, counterface=AIR)
            exact = thermal_resistances(contact, modes, 0.5, heating)
            end = 400.0 * max(1.0, 1.0 / peclet) * size / speed
            time = np.sort(end - np.append(np.geomspace(1e-6 * end, end, 30), 0.0))
            path = Passage(
                time, np.stack([speed * time, 0.0 * time], 1), np.full(31, size), "strip" if line else "disc"
            )
            heat = np.diff(time, prepend=0.0)
            on_face, released = path_rise(path, heat, 0.0 * heat, heating), path_rise(path, 0.0 * heat, heat, heating)
            assert 1 / 1.8 < on_face.below[-1] / exact.surface_below < 1.8
            assert 0.9 < released.below[-1] / exact.loss_below < 2.5


def _steady(lasting: list[float], line: bool, speed: float) -> tuple[vf.contact.ContactSolution, float, Modes]:
    """Solve a contact whose modes last so many times as long as it takes to pass; return its size and modes too."""
    size = 1e-3
    indenter, load = (vf.Cylinder("5 mm"), 300.0) if line else (vf.Ball("5 mm"), 1.0)
    for _ in range(4):
        times = np.array(lasting) * size / speed
        C = np.full(len(times), 9e-7 / len(times))
        spectrum = vf.RetardationSpectrum(E0=1e6, E_inf=1e7, C=C, tau=times)
        contact = vf.solve_steady(vf.Material(spectrum), indenter, speed=speed, load=load, accuracy=1e-2)
        size = 0.5 * contact.contact_area if line else float(np.sqrt(contact.contact_area / np.pi))
    return contact, size, Modes(np.asarray(spectrum.C), np.asarray(spectrum.tau))


def test_loss_below_more_than_the_face_leaves_the_heat_of_the_face_where_it_is() -> None:
    time, other = np.linspace(0.0, 1.0, 11), vf.Heating(rubber=RUBBER, counterface=STEEL)
    heat, nothing = np.append(0.0, np.ones(10)), np.zeros(11)
    path = Passage(time, np.zeros((11, 2)), np.full(11, SIZE), "disc")
    wide = path._replace(size=np.full(11, 2.0 * SIZE))
    both = path._replace(loss_size=wide.size)
    assert path_rise(both, heat, nothing, other).face == pytest.approx(path_rise(path, heat, nothing, other).face)
    assert path_rise(both, nothing, heat, other).below_by_loss == pytest.approx(
        path_rise(wide, nothing, heat, other).below_by_loss
    )
