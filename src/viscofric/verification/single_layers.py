"""A single cylinder and ball on a layer: a thin one is a foundation, known exactly, and a deep one a half-space."""

from __future__ import annotations

import math
from collections.abc import Iterator

from viscofric.contact.bodies import Layer
from viscofric.contact.indenters.shapes import Ball, Cylinder
from viscofric.contact.reference import (
    foundation_modulus,
    rolling_foundation_ball,
    rolling_foundation_line,
    winkler_line,
)
from viscofric.rheology.material import Material
from viscofric.verification.check import Check, Comparison
from viscofric.verification.engine import solve_steady
from viscofric.verification.model_problems import HERTZ_RADIUS, one_time, solve_ball

# Radius, modulus and speed are one; the elastic contact reaches to ±_HALF.
_NU, _THICKNESS, _HALF, _RATIO = 0.3, 0.0125, 0.5, 10.0
_DEEP = 100.0  # a0


def _layers() -> Iterator[Comparison]:
    layer, modulus = Layer(_THICKNESS), foundation_modulus(1.0, _NU)
    thin = f"a0/H = {_HALF / _THICKNESS:g}"
    load = 2.0 * modulus * _HALF**3 / (3.0 * _THICKNESS)
    known = winkler_line(load, 1.0, _THICKNESS, modulus)
    at_rest = Material.standard_linear_solid(1.0, _RATIO, 1.0, _NU)
    found = solve_steady(at_rest, Cylinder(1.0), speed=0.0, load=load, layer=layer)
    yield Comparison(f"cylinder at rest, {thin}", "largest pressure", found.max_pressure, known.max_pressure, 1e-3)
    yield Comparison(f"cylinder at rest, {thin}", "indentation", found.indentation, known.indentation, 1e-3)
    on_ball = math.pi * modulus * _HALF**4 / (4.0 * _THICKNESS)
    for memory in (0.1, 0.5, 5.0):
        rubber = Material.standard_linear_solid(1.0, _RATIO, memory * _HALF, _NU)
        arguments = (1.0, _THICKNESS, modulus, _RATIO * modulus, memory * _HALF, 1.0)
        line = rolling_foundation_line(load, *arguments).friction_coefficient
        cylinder = solve_steady(rubber, Cylinder(1.0), speed=1.0, load=load, layer=layer).friction_coefficient
        yield Comparison(f"cylinder, {thin}, vτ/a0 = {memory:g}", "friction coefficient", cylinder, line, 2e-3)
        point = rolling_foundation_ball(on_ball, *arguments).friction_coefficient
        ball = solve_steady(rubber, Ball(1.0), speed=1.0, load=on_ball, layer=layer).friction_coefficient
        yield Comparison(f"ball, {thin}, vτ/a0 = {memory:g}", "friction coefficient", ball, point, 2e-3)
    half_space = solve_ball(one_time(_RATIO, 1.0)).friction_coefficient
    deep = solve_ball(one_time(_RATIO, 1.0), layer=Layer(_DEEP * HERTZ_RADIUS)).friction_coefficient
    yield Comparison(f"ball, H = {_DEEP:g} a0, vτ/a0 = 1", "friction coefficient", deep, half_space, 1e-4)


CHECKS = (
    Check(
        "single-layers",
        "Single cylinder and ball on thin layers and on a thick one, at rest and in motion",
        "waves and layers",
        "D. G. Flom, A. M. Bueche, J. Appl. Phys. 30 (1959) 1725; W. D. May and others, the same, 1713; the half-space",
        "Thin: the requested accuracy, and terms of the order (H/a)², with H/a = 0.025. Deep: the base bends the "
        "surface of a contact by the order of (a/H)³.",
        _layers,
    ),
)
