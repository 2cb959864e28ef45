"""Line contact against Hunter's closed form for one retardation time: the whole range of k and of speed."""

from __future__ import annotations

from collections.abc import Iterator

from viscofric.contact.reference import HunterContact, hunter_line
from viscofric.verification import model_problems as model
from viscofric.verification.check import Comparison, checks

check = checks("viscoelastic line contact")

MODULUS_RATIOS = (2.0, 10.0, 100.0, 1000.0)
MEMORY_LENGTHS = (1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3)
ACCURACY = 3e-4
_EDGE = 0.008  # four tenths of a cell over the half width: 128 cells at least cover 2.6 half widths


def hunter(modulus_ratio: float, memory_length: float) -> HunterContact:
    """Return the closed form of the model cylinder on a rubber with one retardation time."""
    return hunter_line(
        model.CYLINDER_LOAD,
        model.RADIUS,
        model.RUBBER_MODULUS,
        modulus_ratio * model.RUBBER_MODULUS,
        memory_length * model.HERTZ_RADIUS / model.SPEED,
        model.SPEED,
        model.POISSON_RATIO,
    )


@check(
    "hunter",
    "Cylinder, one retardation time: k = 2 to 1000, six decades of speed",
    "S. C. Hunter, J. Appl. Mech. 28 (1961) 611; closed form, exact",
    "Friction: the requested accuracy. Edges: four tenths of a cell, of which there are 128 at least.",
)
def _hunter() -> Iterator[Comparison]:
    for modulus_ratio in MODULUS_RATIOS:
        for memory_length in MEMORY_LENGTHS:
            known = hunter(modulus_ratio, memory_length)
            found = model.InHertzUnits.of(
                model.solve_cylinder(model.one_time(modulus_ratio, memory_length), accuracy=ACCURACY)
            )
            case = f"k = {modulus_ratio:g}, vτ/a0 = {memory_length:g}"
            friction, width = known.friction_coefficient / model.SLOPE, known.half_width / model.HERTZ_RADIUS
            yield Comparison(case, "friction μR/a0", found.friction, friction, ACCURACY)
            for edge in ("front", "rear"):
                position = getattr(known, edge) / model.HERTZ_RADIUS
                yield Comparison(case, f"{edge} edge/a0", getattr(found, edge), position, _EDGE * width, "absolute")
