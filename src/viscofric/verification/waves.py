"""Waves at rest and in motion, and layers thin and thick, periodic and under a single indenter: closed forms."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.bodies import Layer
from viscofric.contact.indenters.shapes import Ball, Cylinder
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.contact.reference import (
    crossed_waves,
    foundation_modulus,
    full_contact_wave,
    incompressible_line,
    rolling_foundation_ball,
    rolling_foundation_line,
    westergaard,
    winkler_line,
)
from viscofric.rheology.material import Material
from viscofric.verification import model_problems as model
from viscofric.verification.check import Comparison, checks
from viscofric.verification.engine import solve_periodic, solve_steady

check = checks("waves and layers")

_WAVELENGTH, _AMPLITUDE = 1e-3, 1e-6  # m: slopes of 0.006
_RUBBER = model.one_time(10.0, 1.0)
_NU = 0.3  # of layers that can be compressed


def _wave(points: int) -> Array:
    return np.asarray(np.cos(2.0 * np.pi * (np.arange(points) / points - 0.5)))


@check(
    "full-contact-wave",
    "Wave in full contact, six speeds, two spectra",
    "the closed form μ p̄ = (qΔ)² E''(qv)/(4(1−ν²)), exact",
    "Linear and exact on any grid: the solver's tolerance. The highest point of the pressure may lie half a cell "
    "from a point of the grid.",
)
def _full_contact() -> Iterator[Comparison]:
    points = 32
    surface = PeriodicSurface(_AMPLITUDE * _wave(points), _WAVELENGTH / points)
    for name, rubber in (("one time", _RUBBER), ("37 modes", model.rising_modes(1e6))):
        for speed in (1e-6, 1e-3, 0.1, 1.0, 1e3, -0.1):
            modulus = complex(rubber.complex_modulus(2.0 * np.pi * abs(speed) / _WAVELENGTH))
            pressure = 10.0 * abs(modulus) * _AMPLITUDE / _WAVELENGTH
            known = full_contact_wave(pressure, _AMPLITUDE, _WAVELENGTH, modulus, model.POISSON_RATIO)
            found = solve_periodic(rubber, surface, speed=speed, pressure=pressure)
            case = f"{name}, v = {speed:g} m/s"
            friction = math.copysign(known.friction_coefficient, speed)
            yield Comparison(case, "friction coefficient", found.friction_coefficient, friction, 1e-8)
            largest = pressure + known.full_contact_pressure
            bound = 1e-8 + known.full_contact_pressure / largest * (1.0 - math.cos(math.pi / points))
            yield Comparison(case, "largest pressure (Pa)", found.max_pressure, largest, bound)


@check(
    "westergaard",
    "Parallel waves at rest, partial contact",
    "H. M. Westergaard, J. Appl. Mech. 6 (1939) A49",
    "The area is counted in cells, two of 2048.",
)
def _westergaard() -> Iterator[Comparison]:
    points = 2048
    surface = PeriodicSurface(_AMPLITUDE * _wave(points), _WAVELENGTH / points)
    full = math.pi * model.RUBBER_MODULUS / (1.0 - model.POISSON_RATIO**2) * _AMPLITUDE / _WAVELENGTH
    for share in (0.1, 0.5, 0.9):
        known = westergaard(share * full, _AMPLITUDE, _WAVELENGTH, model.RUBBER_MODULUS, model.POISSON_RATIO)
        found = solve_periodic(_RUBBER, surface, speed=0.0, pressure=share * full)
        case = f"mean pressure {share:g} of that of full contact"
        area = found.contact_area_fraction
        yield Comparison(case, "area fraction", area, known.area_fraction, 2.0 / points, "absolute")
        yield Comparison(case, "largest pressure (Pa)", found.max_pressure, known.max_pressure, 1e-3)


@check(
    "johnson-waves",
    "Crossed waves at rest: full, nearly full and light contact",
    "K. L. Johnson, J. A. Greenwood, J. G. Higginson, Int. J. Mech. Sci. 27 (1985) 383",
    "Full contact is linear: round-off. The two asymptotes neglect their next terms; areas are counted in cells.",
)
def _crossed() -> Iterator[Comparison]:
    points = 256
    wave = _wave(points)
    surface = PeriodicSurface(_AMPLITUDE * np.outer(wave, wave), _WAVELENGTH / points)
    known = crossed_waves(_AMPLITUDE, _WAVELENGTH, model.RUBBER_MODULUS, model.POISSON_RATIO)
    full = known.full_contact_pressure
    closed = solve_periodic(_RUBBER, surface, speed=0.0, pressure=1.001 * full)
    yield Comparison("just closed", "area fraction", closed.contact_area_fraction, 1.0, 0.0, "absolute")
    yield Comparison("just closed", "largest pressure (Pa)", closed.max_pressure, 2.001 * full, 1e-9)
    nearly = solve_periodic(_RUBBER, surface, speed=0.0, pressure=0.98 * full)
    area = known.area_fraction_at_high_pressure(0.98 * full)
    yield Comparison("nearly closed", "area fraction", nearly.contact_area_fraction, area, 2e-3, "absolute")
    light = solve_periodic(_RUBBER, surface, speed=0.0, pressure=0.005 * full)
    area = known.area_fraction_at_low_pressure(0.005 * full)
    yield Comparison("lightly pressed", "area fraction", light.contact_area_fraction, area, 0.05)


@check(
    "thick-layer",
    "Layer twice as thick as its waves are long, in motion",
    "the half-space",
    "The effect of the base is of the order (qH)² exp(−2qH), below 1e-8; the bound is the solver's tolerance.",
)
def _thick_layer() -> Iterator[Comparison]:
    points = 64
    wave = _wave(points)
    surface = PeriodicSurface(_AMPLITUDE * np.outer(wave, wave), _WAVELENGTH / points)
    settings = {"speed": 0.1, "pressure": 2e3}
    half_space = solve_periodic(_RUBBER, surface, **settings)
    for bonded in (True, False):
        layer = Layer(2.0 * _WAVELENGTH, bonded)
        found = solve_periodic(_RUBBER, surface, layer=layer, **settings)
        case = f"H = 2λ, {'bonded' if bonded else 'sliding on its base'}"
        friction = half_space.friction_coefficient
        yield Comparison(case, "friction coefficient", found.friction_coefficient, friction, 1e-5)
        yield Comparison(case, "largest pressure (Pa)", found.max_pressure, half_space.max_pressure, 1e-5)


#: A cylinder of radius 1 that touches to about ±0.5, repeated at a distance that a thin layer does not feel.
_PERIOD, _CELLS, _HALF = 2.0, 1024, 0.5
_THIN = 0.0125


def _parabola(periods: int = 1) -> PeriodicSurface:
    cell = _PERIOD / _CELLS
    x = cell * (np.arange(periods * _CELLS) - 0.5 * periods * _CELLS + 0.5)
    return PeriodicSurface(-0.5 * x**2, cell)


@check(
    "thin-layers",
    "Cylinder on thin layers at rest: Winkler's foundation and the incompressible layer",
    "K. L. Johnson, Contact Mechanics (1985), Sec. 5.8",
    "The limits neglect terms of the order H/a, here 0.025, whose factor is small for pressures; widths are "
    "counted in cells of 0.004 a.",
)
def _thin_layers() -> Iterator[Comparison]:
    for bonded in (True, False):
        modulus = foundation_modulus(1.0, _NU, "bonded" if bonded else "frictionless")
        load = 2.0 * modulus * _HALF**3 / (3.0 * _THIN)
        known = winkler_line(load, 1.0, _THIN, modulus)
        rubber = Material.standard_linear_solid(1.0, 10.0, 1.0, _NU)
        found = solve_periodic(rubber, _parabola(), speed=0.0, pressure=load / _PERIOD, layer=Layer(_THIN, bonded))
        case = f"a/H = {_HALF / _THIN:g}, ν = {_NU:g}, {'bonded' if bonded else 'sliding on its base'}, at rest"
        width = 0.5 * _PERIOD * found.contact_area_fraction
        yield Comparison(case, "half width", width, known.half_width, 0.006)
        yield Comparison(case, "largest pressure", found.max_pressure, known.max_pressure, 1e-3)
    load = 2.0 * _HALF**5 / (45.0 * _THIN**3)
    squeezed = incompressible_line(load, 1.0, _THIN, 1.0)
    rubber = Material.standard_linear_solid(1.0, 10.0, 1.0, 0.5)
    found = solve_periodic(rubber, _parabola(), speed=0.0, pressure=load / _PERIOD, layer=Layer(_THIN))
    case = f"a/H = {_HALF / _THIN:g}, ν = 0.5, bonded, at rest"
    yield Comparison(case, "largest pressure", found.max_pressure, squeezed.max_pressure, 5e-3)
    yield Comparison(case, "indentation", found.indentation, squeezed.indentation, 5e-3)


@check(
    "rolling-on-layer",
    "Cylinder rolling over a thin viscoelastic layer",
    "W. D. May, E. L. Morris, D. Atack, J. Appl. Phys. 30 (1959) 1713",
    "The limit of a thin layer: terms of the order H/a, and cells of 0.004 a.",
)
def _rolling_layer() -> Iterator[Comparison]:
    modulus = foundation_modulus(1.0, _NU)
    load = 2.0 * modulus * _HALF**3 / (3.0 * _THIN)
    # The memory of the longest fades by e^(−14) on the way to the next cylinder.
    periods = 4
    for modulus_ratio, memory in ((2.0, 0.25), (10.0, 0.05), (10.0, 0.25), (10.0, 0.5), (100.0, 0.25)):
        known = rolling_foundation_line(load, 1.0, _THIN, modulus, modulus_ratio * modulus, memory, 1.0)
        rubber = Material.standard_linear_solid(1.0, modulus_ratio, memory, _NU)
        found = solve_periodic(
            rubber, _parabola(periods), speed=1.0, pressure=load / (periods * _PERIOD), layer=Layer(_THIN)
        )
        case = f"a0/H = {_HALF / _THIN:g}, k = {modulus_ratio:g}, vτ/a0 = {memory / _HALF:g}"
        friction = found.pressure_friction_coefficient
        yield Comparison(case, "friction coefficient", friction, known.friction_coefficient, 2e-3)


# Radius, modulus and speed are one; the elastic contact reaches to ±_HALF.
_RATIO = 10.0
_DEEP = 100.0  # a0


@check(
    "single-layers",
    "Single cylinder and ball on thin layers and on a thick one, at rest and in motion",
    "D. G. Flom, A. M. Bueche, J. Appl. Phys. 30 (1959) 1725; W. D. May and others, the same, 1713; the half-space",
    "Thin: the requested accuracy, and terms of the order (H/a)², with H/a = 0.025. Deep: the base bends the "
    "surface of a contact by the order of (a/H)³.",
)
def _single_layers() -> Iterator[Comparison]:
    layer, modulus = Layer(_THIN), foundation_modulus(1.0, _NU)
    thin = f"a0/H = {_HALF / _THIN:g}"
    load = 2.0 * modulus * _HALF**3 / (3.0 * _THIN)
    known = winkler_line(load, 1.0, _THIN, modulus)
    at_rest = Material.standard_linear_solid(1.0, _RATIO, 1.0, _NU)
    found = solve_steady(at_rest, Cylinder(1.0), speed=0.0, load=load, layer=layer)
    yield Comparison(f"cylinder at rest, {thin}", "largest pressure", found.max_pressure, known.max_pressure, 1e-3)
    yield Comparison(f"cylinder at rest, {thin}", "indentation", found.indentation, known.indentation, 1e-3)
    on_ball = math.pi * modulus * _HALF**4 / (4.0 * _THIN)
    for memory in (0.1, 0.5, 5.0):
        rubber = Material.standard_linear_solid(1.0, _RATIO, memory * _HALF, _NU)
        arguments = (1.0, _THIN, modulus, _RATIO * modulus, memory * _HALF, 1.0)
        line = rolling_foundation_line(load, *arguments).friction_coefficient
        cylinder = solve_steady(rubber, Cylinder(1.0), speed=1.0, load=load, layer=layer).friction_coefficient
        yield Comparison(f"cylinder, {thin}, vτ/a0 = {memory:g}", "friction coefficient", cylinder, line, 2e-3)
        point = rolling_foundation_ball(on_ball, *arguments).friction_coefficient
        ball = solve_steady(rubber, Ball(1.0), speed=1.0, load=on_ball, layer=layer).friction_coefficient
        yield Comparison(f"ball, {thin}, vτ/a0 = {memory:g}", "friction coefficient", ball, point, 2e-3)
    half_space = model.solve_ball(model.one_time(_RATIO, 1.0)).friction_coefficient
    deep = model.solve_ball(model.one_time(_RATIO, 1.0), layer=Layer(_DEEP * model.HERTZ_RADIUS)).friction_coefficient
    yield Comparison(f"ball, H = {_DEEP:g} a0, vτ/a0 = 1", "friction coefficient", deep, half_space, 1e-4)
