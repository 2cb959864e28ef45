"""Published closed forms beyond those of the engine's own checks: conveyor belts, slow balls, power laws, unloading."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from scipy.optimize import brentq
from scipy.special import beta

from viscofric.arrays import Array, gauss
from viscofric.contact.bodies import Layer
from viscofric.contact.indenters.shapes import Ball, Cone, Cylinder
from viscofric.motion import solve as motion
from viscofric.motion.history import History
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum
from viscofric.verification.check import Comparison, checks
from viscofric.verification.engine import solve_steady
from viscofric.verification.model_problems import SLOPE, one_time, solve_ball

check = checks("published closed forms")


def belt(relaxation: RelaxationSpectrum, radius: float, thickness: float, front: float, speed: float) -> Array:
    """Load (N/m) and friction coefficient of an idler on a belt cover taken as independent strips.

    A strip d behind the leading edge is compressed by ε = d (2a − d)/(2RH), and each Maxwell term adds
    σ = E λ/(RH) [(a + λ)(1 − e^(−d/λ)) − d] with λ = vτ, until σ is zero.
    """
    lengths = speed * relaxation.tau
    unit = 1.0 / (radius * thickness)

    def stress(d: Array) -> Array:
        decay = -np.expm1(-d[:, None] / lengths)
        terms = relaxation.E * lengths * ((front + lengths) * decay - d[:, None])
        return np.asarray(unit * (relaxation.E0 * d * (front - 0.5 * d) + terms.sum(axis=1)))

    # A strip has gained stress up to the axis, d = a, and has lost it all at d = 2a at the latest.
    width = float(brentq(lambda d: float(stress(np.array([d]))[0]), front, 2.0 * front, xtol=1e-14 * front))
    d, weights = gauss(64, (0.0, width))
    pressure = stress(d)
    load = float(weights @ pressure)
    return np.array([load, float(weights @ (pressure * (front - d))) / (load * radius)])


_COVERS = {
    "one relaxation time": RelaxationSpectrum(2e6, [8e6], [0.1e-3]),
    "four relaxation times": RelaxationSpectrum(2e6, [3e6, 3e6, 4e6, 8e6], [3e-3, 0.3e-3, 0.03e-3, 3e-6]),
}
_IDLER, _COVER, _FRONT = 0.05, 0.1e-3, 10e-3  # m


@check(
    "conveyor-belt",
    "Idler on the thin cover of a conveyor belt: one and four relaxation times, 1 to 200 m/s",
    "T. J. Rudolphi, A. V. Reicks, Rubber Chem. Technol. 79 (2006) 307 (generalised Maxwell); "
    "W. D. May, E. L. Morris, D. Atack, J. Appl. Phys. 30 (1959) 1713, doi:10.1063/1.1735042 (three parameters)",
    "The requested accuracy; strips hold for covers much thinner than the contact, here 70 to 200 times.",
    obtained="The strips' closed form, evaluated with ν = 0, for which they are exact in the thin limit.",
    unstated="Only the model was available, not the paper's example numbers; radius, cover and moduli are chosen.",
)
def _belts() -> Iterator[Comparison]:
    for name, relaxation in _COVERS.items():
        material = Material(relaxation.to_retardation(), poisson_ratio=0.0)
        for speed in (1.0, 10.0, 50.0, 200.0):
            load, friction = belt(relaxation, _IDLER, _COVER, _FRONT, speed)
            found = solve_steady(material, Cylinder(_IDLER), speed=speed, load=load, layer=Layer(_COVER))
            yield Comparison(
                f"{name}, {speed:g} m/s", "friction coefficient", found.friction_coefficient, friction, 1e-3
            )


@check(
    "slow-ball",
    "Ball at low speed, one retardation time: μR/v = τ (1 − E0/E∞)",
    "the limit of low speed for any indenter that is a paraboloid; exact",
    "The requested accuracy, and the law's next term, of the order (vτ/a0) ln(a0/vτ).",
    obtained="Closed form.",
)
def _slow_ball() -> Iterator[Comparison]:
    for ratio in (2.0, 10.0):
        for memory in (1e-4, 1e-3):
            found = solve_ball(one_time(ratio, memory), accuracy=2e-3).friction_coefficient / SLOPE
            case = f"k = {ratio:g}, vτ/a0 = {memory:g}"
            law = memory * (1.0 - 1.0 / ratio)
            yield Comparison(case, "friction μR/a0", found, law, 2e-3 + memory * math.log(1.0 / memory))


_PER_DECADE = 4


def power_law_material(exponent: float) -> Material:
    """Solid with E(ω) = (iω)ⁿ MPa, ω in rad/s, from 1e-8 to 1e10 rad/s; ν = ½.

    Its retardation density is sin(nπ)/π τⁿ, integrated by the trapezoidal rule, whose error falls exponentially with
    the number of modes a decade; modes faster than these add up to the glassy compliance.
    """
    step = math.log(10.0) / _PER_DECADE
    log_tau = np.arange(-10 * _PER_DECADE, 8 * _PER_DECADE) * step
    C = 1e-6 * math.sin(exponent * math.pi) / math.pi * step * np.exp(exponent * log_tau)
    glassy = float(C[0] / math.expm1(exponent * step))
    spectrum = RetardationSpectrum(1.0 / (glassy + C.sum()), 1.0 / glassy, C, np.exp(log_tau))
    return Material(spectrum, poisson_ratio=0.5)


def power_law_line(exponent: float, radius: float) -> tuple[float, float]:
    """Load (N/m) and friction coefficient of a cylinder with contact half-width 1 m at 1 m/s on that solid.

    With ξ = ±1 at the edges, p ∝ (1 + ξ)^½ (1 − ξ)^(½−n); the slope of the surface is then linear, and zero at
    ξ = −n/(1−n), under the axis.
    """
    n = exponent
    compliance = 2.0 * 0.75 / 1e6
    load = 2.0 ** (2.0 - n) * float(beta(1.5, 1.5 - n)) / (radius * compliance * math.gamma(2.0 - n))
    return load, 2.0 * n * (2.0 - n) / ((3.0 - n) * (1.0 - n) * radius)


_LARGE = 100.0  # m: a/R = 0.01


@check(
    "power-law-cylinder",
    "Cylinder sliding on a power-law solid, E ∝ (iω)ⁿ",
    "R. A. Schapery, Tire Sci. Technol. 6 (1978) 3 (exact results for power-law solids)",
    "Friction: the requested accuracy. Width: four tenths of a cell at each edge, 128 cells at least.",
    obtained="Closed form, derived again here: a singular integral equation with a homogeneous kernel.",
    unstated="Only the abstract of the paper was available.",
)
def _power_law() -> Iterator[Comparison]:
    for exponent in (0.05, 0.1, 0.2, 0.3, 0.4):
        load, friction = power_law_line(exponent, _LARGE)
        found = solve_steady(power_law_material(exponent), Cylinder(_LARGE), speed=1.0, load=load)
        case = f"n = {exponent:g}"
        yield Comparison(case, "friction coefficient", found.friction_coefficient, friction, 1e-3)
        yield Comparison(case, "contact half-width (m)", 0.5 * (found.front + found.rear), 1.0, 0.008)


def weak_loss_factor(loss_tangent: float) -> float:
    """C of μ = c tan δ a/R, computed for a ball on a solid with this loss tangent at all frequencies."""
    material = power_law_material(2.0 / math.pi * math.atan(loss_tangent))
    found = solve_steady(material, Ball(_LARGE), speed=1.0, load=4e6 / (3.0 * 0.75 * _LARGE))
    return found.friction_coefficient * _LARGE / (loss_tangent * math.sqrt(found.contact_area / math.pi))


@check(
    "greenwood-tabor",
    "Ball on a solid with the same small loss tangent at all frequencies: μ = c tan δ a/R",
    "J. A. Greenwood, D. Tabor, Proc. Phys. Soc. 71 (1958) 989, doi:10.1088/0370-1328/71/6/312",
    "c = 6/π² is the limit of small tan δ, from Hertz's pressure; terms of the order n = 2 atan(tan δ)/π are left "
    "out, and modes stand for the continuous spectrum.",
    obtained="Closed form. Greenwood and Tabor's own estimate from the work on the leading half, μ = (3/16) α a/R, "
    "gives c = 3π/16 = 0.589 with a loss α = π tan δ per cycle.",
    unstated="Their measured α exceeds that of simple cycles; it is no input here.",
)
def _weak_loss() -> Iterator[Comparison]:
    law = 6.0 / math.pi**2
    for loss_tangent in (0.003, 0.03, 0.1, 0.32):
        case = f"tan δ = {loss_tangent:g}"
        exponent = 2.0 / math.pi * math.atan(loss_tangent)
        yield Comparison(case, "μR/(a tan δ)", weak_loss_factor(loss_tangent), law, 5e-3 + exponent)


def unloading(
    relaxation: RelaxationSpectrum, exponent: float, rise: float, back: float, time: float
) -> tuple[float, float]:
    """Load, over its factor, at a time after a depth t up to `rise` has turned and falls `back` times as fast.

    The load is ∫ E(t − s) d(sⁿ), n the exponent of depth in the elastic load, up to the time s₁ at which the contact
    had the present size, which ∫ E(t − s) ds = (1 + back) ∫_rise^t E(t − s) ds from s₁ on gives; the second number is
    s₁, negative if the contact has been lost.
    """

    def held(age: float) -> float:
        return float(relaxation.E0 * age - (relaxation.E * relaxation.tau) @ np.expm1(-age / relaxation.tau))

    left = (1.0 + back) * held(time - rise)
    if held(time) < left:
        return 0.0, -1.0
    same = time - float(brentq(lambda age: held(age) - left, time - rise, time, xtol=1e-14 * time))
    root, weights = gauss(64)  # smooth in the root of s, as sⁿ is
    s = same * np.square(root)
    modulus = relaxation.E0 + np.exp(-(time - s)[:, None] / relaxation.tau) @ relaxation.E
    return float(2.0 * weights @ (modulus * exponent * s ** (exponent - 0.5))) * math.sqrt(same), same


@check(
    "ting-unloading",
    "Ball and cone that are drawn back: load and contact radius while the contact shrinks, and after it is lost",
    "T. C. T. Ting, J. Appl. Mech. 33 (1966) 845",
    "The requested accuracy, of the largest load and radius.",
    obtained="Closed form of a growing and then shrinking contact, evaluated for a depth that rises and falls "
    "steadily; the integral by Gauss's rule.",
    unstated="Only the formulae were available, not the paper's example numbers; the material is chosen.",
)
def _unloading() -> Iterator[Comparison]:
    relaxation = RelaxationSpectrum(1e6, [4e6, 3e6], [0.03, 0.5])
    material = Material(relaxation.to_retardation(), poisson_ratio=0.5)
    rise, rate, radius, slope = 0.2, 1e-3, 0.01, math.tan(math.radians(10.0))  # s, m/s, m
    # The elastic load is the factor times Eδⁿ, the contact radius the width times δⁿ⁻¹.
    indenters = (
        (Ball(radius), 1.5, 4.0 / 3.0 * math.sqrt(radius) / 0.75, math.sqrt(radius)),
        (Cone("10 deg"), 2.0, 2.0 / (math.pi * slope * 0.75), 2.0 / (math.pi * slope)),
    )
    for indenter, exponent, factor, width in indenters:
        for back in (0.5, 3.0):
            end = rise * (1.0 + 1.0 / back)
            times = [rise + part * (end - rise) for part in (0.0, 0.05, 0.2, 0.5, 0.9)]
            history = History([0.0, rise, end], indentation=[0.0, rate * rise, 0.0])
            run = motion.solve_transient(material, indenter, history, times=times)
            assert run.contact_radius is not None
            first, _ = unloading(relaxation, exponent, rise, back, rise)
            largest = factor * rate**exponent * first
            widest = width * (rate * rise) ** (exponent - 1.0)
            for time, load, contact in zip(times, run.load, run.contact_radius, strict=True):
                shape, same = unloading(relaxation, exponent, rise, back, time)
                case = f"{indenter.noun}, falling {back:g} times as fast, t = {time:.3g} s"
                computed, wanted = float(load) / largest, shape / first
                yield Comparison(case, "load over the one at the turn", computed, wanted, 1e-3, "absolute")
                computed, wanted = float(contact) / widest, (max(same, 0.0) / rise) ** (exponent - 1.0)
                yield Comparison(case, "radius over the one at the turn", computed, wanted, 1e-3, "absolute")
