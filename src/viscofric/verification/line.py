"""Line contact against Hunter's closed form for one retardation time: the whole range of k and of speed."""

from __future__ import annotations

from collections.abc import Iterator

from viscofric.contact.reference import HunterContact, hunter_line
from viscofric.verification.check import Check, Comparison
from viscofric.verification.model_problems import (
    CYLINDER_LOAD,
    HERTZ_RADIUS,
    POISSON_RATIO,
    RADIUS,
    RUBBER_MODULUS,
    SLOPE,
    SPEED,
    InHertzUnits,
    one_time,
    solve_cylinder,
)

MODULUS_RATIOS = (2.0, 10.0, 100.0, 1000.0)
MEMORY_LENGTHS = (1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3)
ACCURACY = 3e-4
_EDGE = 0.008  # four tenths of a cell over the half width: 128 cells at least cover 2.6 half widths


def hunter(modulus_ratio: float, memory_length: float) -> HunterContact:
    """Return the closed form of the model cylinder on a rubber with one retardation time."""
    return hunter_line(
        CYLINDER_LOAD,
        RADIUS,
        RUBBER_MODULUS,
        modulus_ratio * RUBBER_MODULUS,
        memory_length * HERTZ_RADIUS / SPEED,
        SPEED,
        POISSON_RATIO,
    )


def _hunter() -> Iterator[Comparison]:
    for modulus_ratio in MODULUS_RATIOS:
        for memory_length in MEMORY_LENGTHS:
            known = hunter(modulus_ratio, memory_length)
            found = InHertzUnits.of(solve_cylinder(one_time(modulus_ratio, memory_length), accuracy=ACCURACY))
            case = f"k = {modulus_ratio:g}, vτ/a0 = {memory_length:g}"
            friction, width = known.friction_coefficient / SLOPE, known.half_width / HERTZ_RADIUS
            yield Comparison(case, "friction μR/a0", found.friction, friction, ACCURACY)
            for edge in ("front", "rear"):
                position = getattr(known, edge) / HERTZ_RADIUS
                yield Comparison(case, f"{edge} edge/a0", getattr(found, edge), position, _EDGE * width, "absolute")


CHECKS = (
    Check(
        "hunter",
        "Cylinder, one retardation time: k = 2 to 1000, six decades of speed",
        "viscoelastic line contact",
        "S. C. Hunter, J. Appl. Mech. 28 (1961) 611; closed form, exact",
        "Friction: the requested accuracy. Edges: four tenths of a cell, of which there are 128 at least.",
        _hunter,
    ),
)
