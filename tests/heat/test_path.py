"""Mean rise of a contact along its path: steady sources at the end, partition between both bodies, all heat counted."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf
from viscofric.heat.path import Passage, density, path_rise

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
    steady = vf.MovingHeatSource(1.0, size=SIZE, speed=speed, body=RUBBER, shape=shape).mean_temperature  # type: ignore[arg-type]
    assert found.rise[-1] == pytest.approx(steady, rel=1e-3)  # of the start, 5e-4 is left at the lowest speed


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
        path_rise(Passage(time, np.stack([x, 0.0 * x], 1), np.full(41, SIZE), "disc"), heat, 0.0 * heat, heating).rise
        for x in (there, 0.05 * time)
    )
    assert back[:20] == pytest.approx(onward[:20])
    assert back[-1] > 1.05 * onward[-1]


@pytest.mark.parametrize(("shape", "power"), [("disc", 2), ("strip", 1)])
def test_distances_have_a_probability_of_one(shape: str, power: int) -> None:
    for spread in (1e-5, 1e-2, 1.0, 9.9, 10.1):
        reach = 2.0 + 8.0 * np.sqrt(2.0 * spread)
        place = np.linspace(0.0, reach, 20001)
        ring = 2.0 * np.pi * place if power == 2 else 2.0
        found = density(place, np.full(len(place), spread), shape) * ring
        assert np.trapezoid(found, place) == pytest.approx(1.0, abs=2e-3)
