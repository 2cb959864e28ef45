"""Changes without effect: other units, the sense of the motion, splitting of modes; and the effect of shifts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from viscofric.contact.indenters.height_map import Profile
from viscofric.contact.indenters.shapes import Ball
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.contact.solution import ContactSolution
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF
from viscofric.rheology.shifts.vertical_shift import DensityShift
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.verification import model_problems as model
from viscofric.verification.check import Check, Comparison
from viscofric.verification.engine import solve_periodic, solve_steady

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


def _modes() -> Iterator[Comparison]:
    whole = model.one_time(10.0, 1.0)
    split = model.rubber(10.0, [0.3, 0.7, 0.0], [1.0, 1.0, 1e9])
    for name, solve in (("cylinder", model.solve_cylinder), ("ball", model.solve_ball)):
        one, other = solve(whole, tolerance=_TIGHT), solve(split, tolerance=_TIGHT)
        yield from _same(f"{name}, one mode split in two and an empty one added", one, other)


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


_GROUP = "invariances"

CHECKS = (
    Check(
        "units",
        "Moduli × 1e6, lengths × 1e-3, times × 1e9",
        _GROUP,
        "dimensional analysis",
        "The same sequence of steps: rounding errors, within the solver's tolerance.",
        _units,
    ),
    Check(
        "mirror",
        "Motion reversed",
        _GROUP,
        "symmetry: the contact is its mirror image",
        "As for the units; the mirrored profile is interpolated again, with other rounding errors.",
        _mirror,
    ),
    Check(
        "split-modes",
        "One mode split in two, an empty one added",
        _GROUP,
        "the same material",
        "As for the units, with contact conditions to 1e-10.",
        _modes,
    ),
    Check(
        "shifted-friction",
        "Temperature, speed and load shifted",
        _GROUP,
        "μ(v, T, F) = μ(αv, T0, F/b): C. Putignano et al., Tribol. Int. 100 (2016) 338, Eq. 10, with a vertical shift",
        "The same numbers by another way: round-off and the solver's tolerance.",
        _shift,
    ),
)
