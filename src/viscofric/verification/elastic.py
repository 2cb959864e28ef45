"""Elastic contacts at rest and at infinite speed against their closed forms: the limits of every viscoelastic one."""

from __future__ import annotations

import math
from collections.abc import Iterator

from viscofric.contact.indenters.shapes import Cone, Ellipsoid, FlatPunch
from viscofric.contact.reference import flat_punch, hertz_ball, hertz_ellipse, hertz_line, sneddon_cone
from viscofric.verification import model_problems as model
from viscofric.verification.check import Comparison, checks
from viscofric.verification.engine import solve_steady

check = checks("elastic limits")

_RATIO = 10.0
_RUBBER = model.one_time(_RATIO, 1.0)
_LIMITS = (("v = 0", 0.0, model.RUBBER_MODULUS), ("v = ∞", math.inf, _RATIO * model.RUBBER_MODULUS))
_EDGE = 0.005  # a quarter of a cell on the 128 cells of an elastic contact's grid, 49 of them to a radius
_ANGLE = math.radians(5.0)
_ROUND_OFF = 1e-12


@check(
    "hertz-ball",
    "Ball at rest and at infinite speed",
    "Hertz; K. L. Johnson, Contact Mechanics (1985), Eqs. 4.22-4.24, with E0 and with E∞",
    "128 cells: an edge is accurate to a quarter of a cell, the mean edge along the rim to a tenth; depth and "
    "pressure converge faster. The friction of a symmetric pressure is a rounding error.",
)
def _ball() -> Iterator[Comparison]:
    for case, speed, modulus in _LIMITS:
        known = hertz_ball(model.BALL_LOAD, model.RADIUS, modulus, model.POISSON_RATIO)
        found = model.solve_ball(_RUBBER, speed)
        yield Comparison(case, "indentation (m)", found.indentation, known.indentation, 5e-4)
        yield Comparison(case, "front edge (m)", found.front, known.radius, _EDGE)
        yield Comparison(case, "contact area (m²)", found.contact_area, math.pi * known.radius**2, 0.004)
        yield Comparison(case, "largest pressure (Pa)", found.max_pressure, known.max_pressure, 0.002)
        yield Comparison(case, "μ from the pressure", found.pressure_friction_coefficient, 0.0, _ROUND_OFF, "absolute")


@check(
    "hertz-cylinder",
    "Cylinder at rest and at infinite speed",
    "Hertz; K. L. Johnson, Contact Mechanics (1985), Eqs. 4.43-4.45",
    "128 cells: an edge is accurate to a quarter of a cell.",
)
def _cylinder() -> Iterator[Comparison]:
    for case, speed, modulus in _LIMITS:
        known = hertz_line(model.CYLINDER_LOAD, model.RADIUS, modulus, model.POISSON_RATIO)
        found = model.solve_cylinder(_RUBBER, speed)
        yield Comparison(case, "contact width (m)", found.contact_area, 2.0 * known.half_width, _EDGE)
        yield Comparison(case, "largest pressure (Pa)", found.max_pressure, known.max_pressure, 0.002)


@check(
    "hertz-ellipsoid",
    "Ellipsoids at rest",
    "Hertz; K. L. Johnson, Contact Mechanics (1985), Eqs. 4.24-4.27",
    "An edge is accurate to a quarter of a cell; the shorter axis has 30 cells.",
)
def _ellipsoid() -> Iterator[Comparison]:
    for ratio in (0.25, 4.0):
        known = hertz_ellipse(
            model.BALL_LOAD, model.RADIUS, ratio * model.RADIUS, model.RUBBER_MODULUS, model.POISSON_RATIO
        )
        found = solve_steady(_RUBBER, Ellipsoid(model.RADIUS, ratio * model.RADIUS), speed=0.0, load=model.BALL_LOAD)
        case = f"R_y/R_x = {ratio:g}, v = 0"
        area = math.pi * known.semi_axis_x * known.semi_axis_y
        yield Comparison(case, "indentation (m)", found.indentation, known.indentation, 1e-3)
        yield Comparison(case, "half width along (m)", found.front, known.semi_axis_x, 2.0 * _EDGE)
        yield Comparison(case, "half width across (m)", found.half_width, known.semi_axis_y, 2.0 * _EDGE)
        yield Comparison(case, "contact area (m²)", found.contact_area, area, 0.01)


@check(
    "sneddon-cone",
    "Cone at rest and at infinite speed",
    "I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47, Sec. 5",
    "128 cells, as for the ball; the infinite pressure at the tip hardly affects depth and area.",
)
def _cone() -> Iterator[Comparison]:
    for case, speed, modulus in _LIMITS:
        known = sneddon_cone(model.BALL_LOAD, math.tan(_ANGLE), modulus, model.POISSON_RATIO)
        found = solve_steady(_RUBBER, Cone(_ANGLE), speed=speed, load=model.BALL_LOAD)
        yield Comparison(case, "indentation (m)", found.indentation, known.indentation, 1e-3)
        yield Comparison(case, "contact area (m²)", found.contact_area, math.pi * known.radius**2, 0.005)


@check(
    "flat-punch",
    "Flat punch, depth given, at rest and at infinite speed",
    "I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47, Sec. 6: F = 2aE*δ",
    "The edge is a staircase with an infinite pressure: first order in the cell size; the radius has 49 cells.",
)
def _punch() -> Iterator[Comparison]:
    depth = 1e-5
    for case, speed, modulus in _LIMITS:
        known = flat_punch(depth, model.HERTZ_RADIUS, modulus, model.POISSON_RATIO)
        found = solve_steady(_RUBBER, FlatPunch(model.HERTZ_RADIUS), speed=speed, indentation=depth)
        yield Comparison(case, "load (N)", found.load, known.load, 0.01)
