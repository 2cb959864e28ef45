"""The same contact in another form: other axes, a table of moduli for the spectrum, other FFTs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from viscofric.contact import steady
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.bodies import Layer
from viscofric.contact.indenters.shapes import Ellipsoid
from viscofric.contact.periodic import solve as periodic
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.verification import model_problems as model
from viscofric.verification.check import Check, Comparison
from viscofric.verification.engine import backend, solve_steady

_SAME = 1e-7  # what is left of the contact conditions in friction and size
_LARGE = (1024, 512)  # points whose FFTs have several threads
_COARSE = 1e-2  # both sides are solved on the same grid
_SLOW = 0.01  # vτ/a0
_PER_DECADE = 10


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


_GROUP = "invariances"

CHECKS = (
    Check(
        "direction",
        "Motion across and oblique to an ellipsoid's axes",
        _GROUP,
        "symmetry: other axes, the mirror image; at low speed a symmetric tensor",
        "Symmetry: rounding errors and the solver's tolerance, which affect the lateral force more, since it is a "
        "small difference. Tensor: the requested accuracy, on both sides.",
        _direction,
    ),
    Check(
        "modulus-table",
        "A table of moduli instead of the spectrum, ten frequencies per decade",
        _GROUP,
        "the contact with the spectrum from which the table was computed",
        "The modes fitted to the table reproduce the moduli of a broad spectrum to 1e-5, and the steep moduli of a "
        "single retardation time, between the frequencies of the table, to 0.2 %.",
        _table,
    ),
    Check(
        "backends",
        "The selected backend, or SciPy's FFTs in two threads",
        _GROUP,
        "the same contacts with SciPy's FFTs in one thread",
        "Rounding errors, within the solver's tolerance.",
        _backends,
    ),
)
