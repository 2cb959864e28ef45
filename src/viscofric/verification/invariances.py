"""Changes without effect: other units, axes and sense of the motion, modes or a table for the spectrum, other FFTs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from viscofric.contact import steady
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.bodies import Layer
from viscofric.contact.indenters.height_map import Profile
from viscofric.contact.indenters.shapes import Ball, Ellipsoid
from viscofric.contact.periodic import solve as periodic
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.contact.solution import ContactSolution
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF
from viscofric.rheology.shifts.vertical_shift import DensityShift
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.verification import model_problems as model
from viscofric.verification.check import Comparison, checks
from viscofric.verification.engine import backend, solve_periodic, solve_steady

check = checks("invariances")

_MODULI, _LENGTHS, _TIMES = 1e6, 1e-3, 1e9
_TIGHT = 1e-10  # of the contact conditions
_SAME = 1e-7  # what is left of that in friction and size
_COARSE = 1e-2  # both sides are solved on the same grid
_WAVE = 1e-3  # m


def _scaled(spectrum: RetardationSpectrum) -> Material:
    return Material(
        RetardationSpectrum(
            E0=_MODULI * spectrum.E0,
            E_inf=_MODULI * spectrum.E_inf,
            C=np.asarray(spectrum.C) / _MODULI,
            tau=_TIMES * np.asarray(spectrum.tau),
        ),
        poisson_ratio=model.POISSON_RATIO,
    )


def _same(case: str, one: ContactSolution, other: ContactSolution) -> Iterator[Comparison]:
    pairs = {
        "friction coefficient": (one.friction_coefficient, other.friction_coefficient),
        "indentation": (one.indentation, other.indentation),
        "front edge": (one.front, other.front),
        "largest pressure": (one.max_pressure, other.max_pressure),
    }
    for quantity, (here, there) in pairs.items():
        yield Comparison(case, f"{quantity}, the one over the other", there / here, 1.0, _SAME)


@check(
    "units",
    "Moduli × 1e6, lengths × 1e-3, times × 1e9",
    "dimensional analysis",
    "The same sequence of steps: rounding errors, within the solver's tolerance.",
)
def _units() -> Iterator[Comparison]:
    speed = model.SPEED * _LENGTHS / _TIMES
    for case, material in (("one time", model.one_time(10.0, 1.0)), ("37 modes", model.rising_modes(1e4))):
        here = model.solve_ball(material)
        there = solve_steady(
            _scaled(material.modes_at()),
            Ball(_LENGTHS * model.RADIUS),
            speed=speed,
            load=_MODULI * _LENGTHS**2 * model.BALL_LOAD,
        )
        back = replace(
            there,
            indentation=there.indentation / _LENGTHS,
            front=there.front / _LENGTHS,
            max_pressure=there.max_pressure / _MODULI,
        )
        yield from _same(f"ball, {case}", here, back)
    wave = np.outer(*2 * (np.cos(2.0 * np.pi * np.arange(64) / 64),))
    material = model.one_time(10.0, 1.0)
    surface = PeriodicSurface(1e-3 * _WAVE * wave, _WAVE / 64)
    small = PeriodicSurface(1e-3 * _LENGTHS * _WAVE * wave, _LENGTHS * _WAVE / 64)
    here_rough = solve_periodic(material, surface, speed=model.SPEED, pressure=1e3)
    there_rough = solve_periodic(_scaled(material.modes_at()), small, speed=speed, pressure=_MODULI * 1e3)
    ratio = there_rough.friction_coefficient / here_rough.friction_coefficient
    yield Comparison("crossed waves, one time", "friction coefficient, the one over the other", ratio, 1.0, _SAME)


@check(
    "mirror",
    "Motion reversed",
    "symmetry: the contact is its mirror image",
    "As for the units; the mirrored profile is interpolated again, with other rounding errors.",
)
def _mirror() -> Iterator[Comparison]:
    material = model.one_time(10.0, 1.0)
    x = np.linspace(-2e-3, 2e-3, 81)
    z = x**2 / (2.0 * model.RADIUS) + 4e-6 * np.sin(3e3 * x)
    ahead = solve_steady(material, Profile(z, 5e-5), speed=model.SPEED, load=model.CYLINDER_LOAD)
    back = solve_steady(material, Profile(z[::-1], 5e-5), speed=-model.SPEED, load=model.CYLINDER_LOAD)
    ratio = -back.friction_coefficient / ahead.friction_coefficient
    yield Comparison(
        "profile without symmetry and its mirror image", "friction coefficient, mirrored", ratio, 1.0, 1e-6
    )
    for name, solve in (("ball", model.solve_ball), ("cylinder", model.solve_cylinder)):
        ahead, back = solve(material), solve(material, -model.SPEED)
        turned = replace(back, friction_coefficient=-back.friction_coefficient)
        yield from _same(f"{name}, v and −v", ahead, turned)
        ratio = -back.centre_of_pressure / ahead.centre_of_pressure
        yield Comparison(f"{name}, v and −v", "centre of pressure, mirrored", ratio, 1.0, _SAME)
        apart = float(np.abs(back.pressure[::-1] - ahead.pressure).max()) / ahead.max_pressure
        yield Comparison(f"{name}, v and −v", "difference of mirrored pressures/p_max", apart, 0.0, _SAME, "absolute")


@check(
    "split-modes",
    "One mode split in two, an empty one added",
    "the same material",
    "As for the units, with contact conditions to 1e-10.",
)
def _modes() -> Iterator[Comparison]:
    whole = model.one_time(10.0, 1.0)
    split = model.rubber(10.0, [0.3, 0.7, 0.0], [1.0, 1.0, 1e9])
    for name, solve in (("cylinder", model.solve_cylinder), ("ball", model.solve_ball)):
        one, other = solve(whole, tolerance=_TIGHT), solve(split, tolerance=_TIGHT)
        yield from _same(f"{name}, one mode split in two and an empty one added", one, other)


@check(
    "shifted-friction",
    "Temperature, speed and load shifted",
    "μ(v, T, F) = μ(αv, T0, F/b): C. Putignano et al., Tribol. Int. 100 (2016) 338, Eq. 10, with a vertical shift",
    "The same numbers by another way: round-off and the solver's tolerance.",
)
def _shift() -> Iterator[Comparison]:
    spectrum = model.equal_modes(1e4).modes_at()
    law = WLF(C1=10.0, C2=90.0, reference="20 degC")
    for name, vertical in (("b = ρT/ρ₀T₀", DensityShift(law.reference)), ("b = 1", None)):
        material = Material(spectrum, shift=law, poisson_ratio=model.POISSON_RATIO, vertical_shift=vertical)
        for temperature in ("0 degC", "60 degC"):
            alpha = float(law(temperature))
            b = 1.0 if vertical is None else float(vertical(temperature))
            there = model.solve_ball(material, temperature=temperature, accuracy=_COARSE)
            here = model.solve_ball(
                material, alpha * model.SPEED, temperature="20 degC", load=model.BALL_LOAD / b, accuracy=_COARSE
            )
            ratio = there.friction_coefficient / here.friction_coefficient
            yield Comparison(f"{name}, {temperature} and 20 degC", "μ(v, T, F)/μ(αv, T0, F/b)", ratio, 1.0, _SAME)


_LARGE = (1024, 512)  # points whose FFTs have several threads
_SLOW = 0.01  # vτ/a0
_PER_DECADE = 10


@check(
    "direction",
    "Motion across and oblique to an ellipsoid's axes",
    "symmetry: other axes, the mirror image; at low speed a symmetric tensor",
    "Symmetry: rounding errors and the solver's tolerance, which affect the lateral force more, since it is a "
    "small difference. Tensor: the requested accuracy, on both sides.",
)
def _direction() -> Iterator[Comparison]:
    material = model.one_time(10.0, 1.0)
    long, turned = Ellipsoid(model.RADIUS, 4.0 * model.RADIUS), Ellipsoid(4.0 * model.RADIUS, model.RADIUS)

    def solve(shape: Ellipsoid, degrees: float, rubber: Material = material) -> Any:
        angle = math.radians(degrees)
        return solve_steady(
            rubber,
            shape,
            speed=model.SPEED,
            load=model.BALL_LOAD,
            accuracy=_COARSE,
            direction=(math.cos(angle), math.sin(angle)),
        )

    across, along = solve(long, 90.0), solve(turned, 0.0)
    for quantity, name in (("friction coefficient", "friction_coefficient"), ("indentation", "indentation")):
        ratio = getattr(across, name) / getattr(along, name)
        yield Comparison(
            "ellipsoid across, and its radii exchanged", f"{quantity}, the one over the other", ratio, 1.0, _SAME
        )
    left, right = solve(long, 30.0), solve(long, -30.0)
    case = "ellipsoid, at 30° and −30°"
    ratio = left.friction_coefficient / right.friction_coefficient
    yield Comparison(case, "friction coefficient, the one over the other", ratio, 1.0, _SAME)
    ratio = -left.lateral_friction_coefficient / right.lateral_friction_coefficient
    yield Comparison(case, "lateral friction, mirrored", ratio, 1.0, 10.0 * _SAME)
    # To first order in the speed friction is a symmetric tensor: its components turn as such.
    slow = model.one_time(10.0, _SLOW)
    x, y, oblique = (solve(long, degrees, slow).friction_coefficient for degrees in (0.0, 90.0, 30.0))
    yield Comparison(
        f"ellipsoid at 30°, vτ/a0 = {_SLOW:g}", "friction coefficient", oblique, 0.75 * x + 0.25 * y, 2.0 * _COARSE
    )


@check(
    "modulus-table",
    "A table of moduli instead of the spectrum, ten frequencies per decade",
    "the contact with the spectrum from which the table was computed",
    "The modes fitted to the table reproduce the moduli of a broad spectrum to 1e-5, and the steep moduli of a "
    "single retardation time, between the frequencies of the table, to 0.2 %.",
)
def _table() -> Iterator[Comparison]:
    for case, material, bound in (
        ("one time, vτ/a0 = 1", model.one_time(10.0, 1.0), 2e-3),
        ("25 modes", model.equal_modes(1e4), 1e-5),
    ):
        spectrum = material.modes_at()
        low, high = 1e-2 / np.max(spectrum.tau), 1e2 / np.min(spectrum.tau)
        omega = np.geomspace(low, high, 1 + round(_PER_DECADE * math.log10(high / low)))
        modulus = spectrum.complex_modulus(omega)
        table = ModulusTable(omega, modulus.real, modulus.imag, "plateau")
        same = Material(table, poisson_ratio=model.POISSON_RATIO)
        for shape, solve in (("ball", model.solve_ball), ("cylinder", model.solve_cylinder)):
            found, known = solve(same, accuracy=_COARSE), solve(material, accuracy=_COARSE)
            ratio = found.friction_coefficient / known.friction_coefficient
            yield Comparison(f"{shape}, {case}", "friction coefficient, table over spectrum", ratio, 1.0, bound)


@check(
    "backends",
    "The selected backend, or SciPy's FFTs in two threads",
    "the same contacts with SciPy's FFTs in one thread",
    "Rounding errors, within the solver's tolerance.",
)
def _backends() -> Iterator[Comparison]:
    plain = Backend("scipy", threads=1)
    other = Backend("scipy", threads=2) if backend().name == plain.name else backend()
    material, layer = model.equal_modes(1e4), Layer(model.HERTZ_RADIUS)
    free: dict[str, Any] = {"speed": model.SPEED, "accuracy": _COARSE}
    for case, shape, settings in (
        ("ball", model.BALL, {"load": model.BALL_LOAD}),
        ("ball on a layer as thick as a0", model.BALL, {"load": model.BALL_LOAD, "layer": layer}),
        ("cylinder", model.CYLINDER, {"load": model.CYLINDER_LOAD}),
    ):
        here, there = (steady.solve_steady(material, shape, backend=one, **free, **settings) for one in (other, plain))
        ratio = here.friction_coefficient / there.friction_coefficient
        yield Comparison(case, "friction coefficient, the one over the other", ratio, 1.0, _SAME)
        apart = float(np.abs(here.pressure - there.pressure).max()) / there.max_pressure
        yield Comparison(case, "difference of the pressures/p_max", apart, 0.0, _SAME, "absolute")
    nx, ny = _LARGE
    wave_x, wave_y = (np.cos(2.0 * np.pi * np.arange(points) / points) for points in _LARGE)
    rough = PeriodicSurface(1e-6 * (wave_x[:, None] + wave_y), (model.HERTZ_RADIUS / nx, model.HERTZ_RADIUS / ny))
    here_rough, there_rough = (
        periodic.solve_periodic(material, rough, speed=model.SPEED, pressure=2e3, backend=one) for one in (other, plain)
    )
    ratio = here_rough.friction_coefficient / there_rough.friction_coefficient
    yield Comparison("crossed waves", "friction coefficient, the one over the other", ratio, 1.0, _SAME)
