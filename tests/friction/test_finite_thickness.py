"""What a layer changes is estimated from the half-space as it comes out of solved layers."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

import viscofric as vf
from viscofric.contact.bodies import Layer
from viscofric.friction.finite_thickness import ContactOnLayers
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum

BALL, CYLINDER = vf.Ball(radius="10 mm"), vf.Cylinder(radius="10 mm")
ACCURACY = 1e-3


def one_mode(ratio: float = 10.0, poisson_ratio: float = 0.5) -> Material:
    return Material.standard_linear_solid(E0=1e6, E_inf=ratio * 1e6, tau=1e-3, poisson_ratio=poisson_ratio)


def power_law(exponent: float, poisson_ratio: float = 0.5) -> Material:
    """SYNTHETIC: C ~ τ^exponent over eight decades, from 1 GPa down to 1 MPa."""
    tau = np.geomspace(1e-6, 1e2, 24)
    C = tau**exponent * (1e-6 - 1e-9) / np.sum(tau**exponent)
    return Material(RetardationSpectrum(E0=1e6, E_inf=1e9, C=C, tau=tau), poisson_ratio=poisson_ratio)


def fluoroelastomer(celsius: float) -> Material:
    rubber = vf.synthetic_fluoroelastomer()
    return Material(rubber.modes_at(273.15 + celsius), poisson_ratio=rubber.poisson_ratio)


class Case(NamedTuple):
    """A contact on a half-space and on a layer so many of its radii thick."""

    rubber: Material
    speed: float
    radii: float
    bonded: bool = True
    indenter: vf.Ball | vf.Cylinder = BALL
    load: float = 1.0


FKM = {"indenter": vf.Ball(radius="9.525 mm"), "load": 25.0}
LINE = {"indenter": CYLINDER, "load": 300.0}
QUICK = [
    Case(fluoroelastomer(30.0), 0.02, 4.0, **FKM),
    Case(fluoroelastomer(90.0), 0.2, 8.0, **FKM),
    Case(one_mode(), 10.0, 4.0),  # memory longer than the layer is thick
    Case(one_mode(100.0), 10.0, 2.0, bonded=False),
    Case(power_law(0.1, 0.3), 1.0, 4.0),
    Case(one_mode(), 10.0, 16.0, **LINE),
    Case(power_law(0.1), 1.0, 4.0, **LINE),
]
MANY = [
    Case(rubber, speed, radii, bonded, indenter, load)
    for indenter, load in ((BALL, 1.0), (CYLINDER, 300.0))
    for rubber in (one_mode(2.0), one_mode(poisson_ratio=0.49), one_mode(1000.0, 0.3), power_law(0.3), power_law(0.5))
    for speed in (1.0, 10.0, 100.0)
    for radii, bonded in ((2.0, True), (2.0, False), (4.0, True), (16.0, True))
]


def half_and_layer(case: Case, accuracy: float = ACCURACY) -> tuple[vf.contact.ContactSolution, ContactOnLayers, Layer]:
    deep = vf.solve_steady(case.rubber, case.indenter, speed=case.speed, load=case.load, accuracy=accuracy)
    reach = 0.5 * (deep.front + deep.rear)
    line = case.indenter.geometry.load_unit == "N/m"
    radius = reach if line else max(reach, deep.half_width)
    contact = ContactOnLayers(
        case.rubber.modes_at(),
        case.rubber.poisson_ratio,
        radius,
        1.0 / float(case.indenter.radius),
        case.speed,
        case.load,
        line,
        deep.friction_coefficient,
    )
    return deep, contact, Layer(case.radii * radius, bonded=case.bonded)


def holds(case: Case) -> None:
    """Friction to 7 %, in plane strain to 30 %, of the change, which two solutions tell to twice their accuracy."""
    deep, contact, layer = half_and_layer(case)
    solved = vf.solve_steady(
        case.rubber, case.indenter, speed=case.speed, load=case.load, accuracy=ACCURACY, layer=layer
    )
    found = contact.on(layer)
    change = solved.friction_coefficient / deep.friction_coefficient - 1.0
    share, least = (0.3, 2.3e-3) if contact.line else (0.07, 1.2e-3)
    assert found.friction == pytest.approx(change, rel=share, abs=least + 2.0 * ACCURACY), case
    if contact.line:
        assert np.isnan(found.indentation)
    else:
        sunk = solved.indentation / deep.indentation - 1.0
        assert 0.7 < found.indentation / sunk < 1.1, case


@pytest.mark.parametrize("case", QUICK)
@pytest.mark.slow
def test_friction_changes_on_a_layer_as_estimated(case: Case) -> None:
    holds(case)


@pytest.mark.exhaustive
@pytest.mark.parametrize("case", MANY)
def test_friction_changes_as_estimated_for_many_spectra(case: Case) -> None:
    holds(case)


def contact(rubber: Material, speed: float, **changed: object) -> ContactOnLayers:
    """Contact of 1 mm on a ball of 10 mm under the load of Hertz at 1 MPa; 500 N/m on a cylinder."""
    given = ContactOnLayers(rubber.modes_at(), rubber.poisson_ratio, 1e-3, 100.0, speed, 0.178)
    return replace(given, **changed)  # type: ignore[arg-type]


def falls(one: ContactOnLayers, radii: float) -> float:
    """By what power of the thickness the change of friction falls."""
    thin, thick = (one.on(Layer(1e-3 * many)).friction for many in (radii, 2.0 * radii))
    return -float(np.log2(thick / thin))


def test_long_memory_feels_the_base_farther_than_short() -> None:
    """vτ = a/100: as the cube; 100 a on layers of 4 to 8 a, slower than their thickness, and twenty times as much."""
    short, long = contact(one_mode(), 1e-2), contact(one_mode(), 100.0)
    assert falls(short, 8.0) == pytest.approx(3.0, abs=0.1)
    assert falls(long, 4.0) < 1.2
    assert long.on(Layer(4e-3)).friction < -0.15
    assert abs(short.on(Layer(4e-3)).friction) < 0.01
    # once the layer is thicker than the memory is long, it is short memory again
    assert falls(long, 4000.0) == pytest.approx(3.0, abs=0.1)


def test_a_broad_spectrum_feels_it_at_any_thickness() -> None:
    broad = contact(power_law(0.3), 1.0)
    assert 1.0 < falls(broad, 8.0) < 2.2
    assert 1.0 < falls(broad, 64.0) < 2.2


def test_a_sliding_base_and_compressible_rubber_are_felt_less() -> None:
    for speed in (1.0, 100.0):
        bonded = contact(one_mode(), speed).on(Layer(4e-3))
        sliding = contact(one_mode(), speed).on(Layer(4e-3, bonded=False))
        compressible = contact(one_mode(poisson_ratio=0.3), speed).on(Layer(4e-3))
        for other in (sliding, compressible):
            assert bonded.friction < other.friction < 0.0
            assert bonded.indentation < other.indentation < 0.0


@pytest.mark.parametrize("line", [False, True])
def test_the_thickness_that_serves_changes_friction_by_that_much(line: bool) -> None:
    one = contact(power_law(0.3), 1.0, line=line, load=500.0 if line else 0.178)
    needed = one.thickness_for(0.05)
    assert abs(one.on(Layer(needed)).friction) == pytest.approx(0.05, rel=1e-6)
    assert abs(one.on(Layer(2.0 * needed)).friction) < 0.05
    assert one.thickness_for(10.0) == 1e-3  # never below one contact radius


def test_units_do_not_matter() -> None:
    modes = power_law(0.3).modes_at()
    scaled = RetardationSpectrum(E0=1e12, E_inf=1e15, C=1e-6 * modes.C, tau=1e9 * modes.tau)
    one = ContactOnLayers(modes, 0.5, 1e-3, 100.0, 1.0, 0.178)
    other = ContactOnLayers(scaled, 0.5, 1e-6, 1e5, 1e-12, 0.178)  # loads: 1e6 of moduli, 1e-6 of areas
    assert other.on(Layer(4e-6)) == pytest.approx(one.on(Layer(4e-3)), rel=1e-9)


def test_friction_that_cannot_be_the_half_spaces_is_not_believed() -> None:
    """Nor is what is none: Hertz's estimate stands in its place."""
    own = contact(one_mode(), 10.0).on(Layer(4e-3)).friction
    assert contact(one_mode(), 10.0, friction=np.nan).on(Layer(4e-3)).friction == own
    small = contact(one_mode(), 10.0, friction=1e-9).on(Layer(4e-3)).friction
    assert 3.1 * own < small < 2.9 * own


def test_without_loss_friction_changes_nothing() -> None:
    elastic = Material(RetardationSpectrum(E0=1e6, E_inf=1e6, C=[], tau=[]))
    found = contact(elastic, 1.0).on(Layer(4e-3))
    assert found.friction == 0.0
    assert found.indentation < -0.1
