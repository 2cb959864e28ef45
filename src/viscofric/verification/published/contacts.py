"""Moving contacts that others solved: the sliding ball of Carbone and Putignano, CONTACT's cylinders, a layer."""

from __future__ import annotations

from collections.abc import Iterator

from viscofric.contact.bodies import Layer
from viscofric.contact.indenters.shapes import Ball, Cylinder
from viscofric.contact.reference import hertz_ball
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RelaxationSpectrum
from viscofric.verification.check import Comparison, checks
from viscofric.verification.engine import solve_steady

check = checks("contacts solved by others")

BALL_RADIUS, BALL_LOAD, BALL_TAU = 0.01, 0.15, 0.01  # m, N, s
#: vτ/a0 and μ of the figure, and the tolerance at which slippy's test meets μ.
BALL_POINTS = ((0.1063, 0.00851, 0.08), (1.169, 0.04028, 0.05), (7.943, 0.01587, 0.08))


def sliding_ball(memory_length: float) -> float:
    """Friction coefficient of Carbone and Putignano's ball at vτ/a0."""
    material = Material.standard_linear_solid(1e6, 1e7, BALL_TAU, 0.3)
    a0 = hertz_ball(BALL_LOAD, BALL_RADIUS, 1e6, 0.3).radius
    return solve_steady(
        material, Ball(BALL_RADIUS), speed=memory_length * a0 / BALL_TAU, load=BALL_LOAD
    ).friction_coefficient


@check(
    "carbone-putignano",
    "Ball sliding on a half-space with one retardation time",
    "G. Carbone, C. Putignano, J. Mech. Phys. Solids 61 (2013) 1822, Fig. 12",
    "The tolerances, 5 and 8 %, within which slippy's own test reproduces the same points.",
    obtained="Three points of the figure, taken from its vector graphics by the test "
    "`test_viscoelastic_sliding.py` of slippy (FrictionTribologyEnigma/slippy on GitHub).",
    unstated="Poisson's ratio (0.3 reproduces the peak), and the grid.",
)
def _sliding_ball() -> Iterator[Comparison]:
    for memory_length, friction, bound in BALL_POINTS:
        case = f"vτ/a0 = {memory_length:g}"
        yield Comparison(case, "friction coefficient", sliding_ball(memory_length), friction, bound)


#: Retardation time (s), largest pressure (MPa), width (mm: elements in contact times 0.16 mm).
_CYLINDERS = ((0.0, 60.32, 12.80), (0.009, 78.74, 9.92), (0.045, 84.72, 9.12), (2.0, 85.31, 8.96))


@check(
    "wang-knothe",
    "Two equal viscoelastic cylinders in rolling contact",
    "G. Wang, K. Knothe, J. Appl. Mech. 60 (1993) 310, as computed by CONTACT",
    "Pressures: piecewise constant on 56 to 80 elements, an error of the order 1/56² at the top. Widths: whole "
    "elements of 0.16 mm, and the accuracy of the edges here.",
    obtained="`PMAX` and the number of elements in contact in the reference output of CONTACT's example "
    "`visc_cylindr` (eve70a/CONTACT on GitHub, revision of 10 May 2023).",
    unstated="Rolling resistance: CONTACT prints the forces of the tangential problem only.",
)
def _two_cylinders() -> Iterator[Comparison]:
    # Two equal bodies: a rigid cylinder of the combined radius on one of half the modulus.
    glassy = 0.5 * 2.0 * 1143e6 * 1.4
    for tau, pressure, width in _CYLINDERS:
        material = Material.standard_linear_solid(0.5 * glassy, glassy, tau or 1.0, 0.4)
        found = solve_steady(material, Cylinder(0.05), speed=1.0 if tau else 0.0, load=600e3)
        case = f"τ = {1e3 * tau:g} ms"
        yield Comparison(case, "largest pressure (MPa)", 1e-6 * found.max_pressure, pressure, 5e-4)
        across = 1e3 * (found.front + found.rear)
        yield Comparison(case, "contact width (mm)", across, width, 0.18, "absolute")


#: Speed (m/s), load (N/m), friction coefficient.
_LAYER = ((0.0, 0.97827, None), (0.3, 1.6003, 5.446e-4), (1.0, 3.2867, 5.121e-4))


def layer_contact(speed: float) -> tuple[float, float]:
    """Load (N/m) and friction coefficient of the cylinder that is 1 µm deep in the bonded layer."""
    relaxation = RelaxationSpectrum(1e6, [4e6, 10e6], [1e-3, 0.2e-3])
    material = Material(relaxation.to_retardation(), poisson_ratio=0.4)
    found = solve_steady(material, Cylinder(1.0), speed=speed, indentation=1e-6, layer=Layer(4e-3))
    return found.load, found.friction_coefficient


@check(
    "felupe-layer",
    "Cylinder sliding on a bonded layer with two relaxation times, at given depth",
    "felupe 11.3 (finite elements, time steps), doi:10.5281/zenodo.4817406",
    "Finite elements of 0.05 mm in a contact of 1.0 to 2.0 mm, with the contact found at nodes.",
    obtained="A cylinder (`ContactRigidCylinder`) 1 µm deep slides over a layer of 4 mm until the forces are "
    "steady; Prony terms for shear and bulk. On other meshes, of `tests/verification/test_finite_elements.py`, the "
    "friction at 1 m/s is lower by 1.9, 0.6 and 0.3 % and the load higher by 0.5, 0.3 and 0.2 % with elements of "
    "0.2, 0.1 and 0.05 mm.",
    unstated="The numbers were computed for this comparison; they are not published elsewhere.",
)
def _bonded_layer() -> Iterator[Comparison]:
    for speed, load, friction in _LAYER:
        found = layer_contact(speed)
        case = f"{speed:g} m/s"
        yield Comparison(case, "load (N/m)", found[0], load, 0.01)
        if friction is not None:
            yield Comparison(case, "friction coefficient", found[1], friction, 0.01)
