"""Anchors and known moduli, which fix the magnitude of the modulus: friction alone hardly determines it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Self, TypeAlias, get_args

import numpy as np

from viscofric.arrays import Array, ComplexArray
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_steady
from viscofric.data import MasterCurve
from viscofric.errors import InputError, check_choice, wrong_argument
from viscofric.friction.identification.forward import FirstOrder
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.quality import covers
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.showing import Rows, Shown
from viscofric.units import Quantity, positive, share
from viscofric.units import angular_frequency as frequency_of

Part: TypeAlias = Literal["magnitude", "storage", "loss"]
Size: TypeAlias = Literal["indentation", "contact_area", "half_width"]

_UNITS: dict[str, str] = {"indentation": "m", "contact_area": "m²", "half_width": "m"}
#: Change of the load for the slope of a size: its error is the square of it, that of the solutions over it.
_LOAD_STEP = 0.05


@dataclass(frozen=True)
class ModulusAnchor(Shown):
    """A modulus of the rubber measured at one frequency and temperature.

    Parameters
    ----------
    modulus : float, str or pint.Quantity
        Pa.
    angular_frequency : float, str or pint.Quantity
        rad/s if a plain number; text in hertz is multiplied by 2π.
    temperature : float, str or pint.Quantity
        K if a plain number.
    part : {"magnitude", "storage", "loss"}
        Whether it is |E|, E' or E''.
    error : float
        Relative standard error.

    Raises
    ------
    InputError
        If a value is out of range or the part unknown.

    Examples
    --------
    >>> import viscofric as vf
    >>> anchor = vf.friction.ModulusAnchor("8 MPa", "1 Hz", "30 degC", error=0.02)
    >>> f"{anchor.angular_frequency:.3f} rad/s"
    '6.283 rad/s'
    """

    modulus: Quantity
    angular_frequency: Quantity
    temperature: Quantity
    part: Part = "magnitude"
    error: float = 0.01

    def __post_init__(self) -> None:
        object.__setattr__(self, "modulus", positive(self.modulus, "Pa", "modulus"))
        frequency = frequency_of(self.angular_frequency, "angular_frequency")
        object.__setattr__(self, "angular_frequency", frequency)
        object.__setattr__(self, "temperature", positive(self.temperature, "K", "temperature"))
        object.__setattr__(self, "error", share(self.error, "error of the anchor", example=0.02))
        check_choice(self.part, "part", *get_args(Part))

    def _shown(self) -> Rows:
        return (
            ("modulus", self.modulus, "Pa"),
            ("part", self.part),
            ("angular frequency", self.angular_frequency, "rad/s"),
            ("temperature", self.temperature, "°C"),
            ("relative error", self.error, "%"),
        )


@dataclass(frozen=True)
class ContactAnchor(Shown):
    """The size of the moving contact measured at one speed, temperature and load.

    Exactly one of the indentation, the contact area and the half width is given.

    Parameters
    ----------
    speed, temperature, load : float, str or pint.Quantity
        m/s, K and N (of a line contact N/m) if plain numbers.
    indentation : float, str or pint.Quantity, optional
        Depth of the indenter's lowest point below the undeformed surface, m.
    contact_area : float, optional
        m².
    half_width : float, str or pint.Quantity, optional
        Half the largest width of the contact across the motion, m.
    error : float
        Relative standard error.

    Raises
    ------
    InputError
        If a value is out of range, or not exactly one size is given.

    Examples
    --------
    >>> import viscofric as vf
    >>> seen = vf.friction.ContactAnchor("20 mm/s", "60 degC", "25 N", half_width="2.4 mm", error=0.02)
    """

    speed: Quantity
    temperature: Quantity
    load: Quantity
    indentation: Quantity | None = None
    contact_area: float | None = None
    half_width: Quantity | None = None
    error: float = 0.01

    def __post_init__(self) -> None:
        given = [name for name in _UNITS if getattr(self, name) is not None]
        if len(given) != 1:
            raise InputError(
                f"a contact anchor has {' and '.join(given) or 'no size'}; give exactly one of indentation, "
                "contact_area and half_width.",
                code="give-one",
            )
        for name, unit in (("speed", "m/s"), ("temperature", "K"), *((name, _UNITS[name]) for name in given)):
            object.__setattr__(self, name, positive(getattr(self, name), unit, name))
        object.__setattr__(self, "load", _force(self.load))
        object.__setattr__(self, "error", share(self.error, "error of the anchor", example=0.02))

    def _shown(self) -> Rows:
        return (
            ("speed", self.speed, "m/s"),
            ("temperature", self.temperature, "°C"),
            ("load", self.load, "N"),
            ("indentation", self.indentation, "m"),
            ("contact area", self.contact_area, "m²"),
            ("half-width", self.half_width, "m"),
            ("relative error", self.error, "%"),
        )

    @property
    def size(self) -> Size:
        """Which of the sizes was measured."""
        return next(name for name in get_args(Size) if getattr(self, name) is not None)

    @property
    def value(self) -> float:
        """Its value, m or m²."""
        return float(getattr(self, self.size))

    def of(self, solution: ContactSolution) -> float:
        """Return the size of a solved contact that the anchor measures, m, or m² for the contact area."""
        return float(getattr(solution, self.size))


def _force(load: Quantity) -> float:
    """Return a load, N, or N/m where it is that of a line contact."""
    try:
        return positive(load, "N/m", "load")
    except InputError:
        return positive(load, "N", "load")


#: Anything that fixes the level.
Anchor: TypeAlias = ModulusAnchor | ContactAnchor


@dataclass(frozen=True, eq=False)
class SolvedContact:
    """ln of the size of a contact near a material for which it was solved.

    A half-space's contact under a rigid indenter depends on load × compliance, so that two solved loads determine the
    derivative of a size by the level of all compliances.  Its distribution over the modes is that of the contact radius
    to first order (`FirstOrder`): Hertz's contact at the contact's own frequency.  The size itself is exact for the
    solved material, so that only the step of an iteration, and the standard errors, depend on this approximation.
    """

    anchor: ContactAnchor
    first: FirstOrder
    compliances: Array
    log_alpha: float
    log_size: float
    level: float

    @classmethod
    def of(
        cls,
        anchor: ContactAnchor,
        indenter: Indenter,
        material: Material,
        accuracy: float,
        compliances: Array,
        log_alpha: float,
    ) -> SolvedContact:
        """Solve the contact of a material of these `compliances`."""
        sizes = []
        for factor in (1.0, 1.0 + _LOAD_STEP, 1.0 / (1.0 + _LOAD_STEP)):
            solution = solve_steady(
                material,
                indenter,
                speed=float(anchor.speed) * float(np.exp(log_alpha)),
                load=float(anchor.load) * factor,
                accuracy=accuracy,
            )
            sizes.append(np.log(anchor.of(solution)))
        level = (sizes[1] - sizes[2]) / (2.0 * np.log1p(_LOAD_STEP))
        tau = np.array(material.modes_at().tau)
        first = FirstOrder(indenter, float(anchor.load), 1.0 - material.poisson_ratio**2, tau)
        return cls(anchor, first, compliances, log_alpha, float(sizes[0]), float(level))

    @property
    def temperature(self) -> float:
        """Of the anchor, K."""
        return float(self.anchor.temperature)

    def away(self, compliances: Array, _: Array, log_alpha: float) -> tuple[Array, Array, Array]:
        """Return (modelled minus measured)/error (1,), and its derivatives by the compliances and by ln α."""
        # The second argument are the retardation times, as of other observations; the closed form has them.
        log_speed = np.log(float(self.anchor.speed)) + np.array([self.log_alpha, log_alpha])
        before = self.first(self.compliances, log_speed[:1])
        now = self.first(compliances, log_speed[1:])
        by_radius = self.level / float(before.radius_change[0].sum())
        missed = self.log_size + by_radius * (now.log_radius - before.log_radius) - np.log(self.anchor.value)
        by_radius /= self.anchor.error
        return missed / self.anchor.error, by_radius * now.radius_change, by_radius * now.radius_slope


# --- moduli at several frequencies, or a part of E(ω) that is known from a DMA --------------------------------

Known: TypeAlias = Material | MaterialSamples | MasterCurve

#: Frequencies per decade at which a measured modulus is used: errors of closer ones are correlated.
PER_DECADE = 4
#: Least relative error of samples of a material: their covariance at many frequencies is nearly singular.
LEAST_ERROR = 3e-3
BOTH = ("storage", "loss")


def compliance(compliances: Array, tau: Array, log_frequency: Array) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return S(ω) (n,), its derivatives by ln(1/E_inf) and every ln C (n, 1 + m), and by ln ω (n,)."""
    values = np.exp(compliances)
    lag = 1j * np.exp(log_frequency[:, None]) * tau
    modes = values[1:] / (1.0 + lag)
    change = np.concatenate([np.full((len(lag), 1), values[0], dtype=complex), modes], axis=1)
    return change.sum(axis=1), change, -np.sum(modes * lag / (1.0 + lag), axis=1)


def log_modulus(part: str, S: ComplexArray, change: ComplexArray) -> tuple[Array, Array]:
    """Return ln of |E|, E' or E'' (n,), and its changes (n, p) with those of the compliance S."""
    relative = -change / S[:, None]  # of E = 1/S
    E = 1.0 / S
    if part == "magnitude":
        return np.log(np.abs(E)), relative.real
    moved = E[:, None] * relative
    if part == "storage":
        return np.log(E.real), moved.real / E.real[:, None]
    return np.log(E.imag), moved.imag / E.imag[:, None]


@dataclass(frozen=True, eq=False)
class ModulusObservation:
    """ln of moduli at k frequencies with their errors, which may be correlated."""

    log_frequency: Array  # (k,), ln ω at `temperature`, rad/s
    temperature: float  # K
    parts: tuple[str, ...]  # (p,), "magnitude", "storage" or "loss"
    log_modulus: Array  # (p k,), ln of Pa, part by part
    whitening: Array  # (p k, p k); its product with the errors has independent rows of standard deviation one

    @classmethod
    def single(cls, log_frequency: float, temperature: float, log_modulus: float, error: float, part: str) -> Self:
        """Return one modulus with a relative standard error."""
        known = np.array([log_frequency]), temperature, (part,), np.array([log_modulus]), np.array([[1.0 / error]])
        return cls(*known)

    @classmethod
    def of(cls, anchor: ModulusAnchor) -> Self:
        """Return the modulus of an anchor."""
        frequency, modulus = np.log(float(anchor.angular_frequency)), np.log(float(anchor.modulus))
        return cls.single(frequency, float(anchor.temperature), modulus, anchor.error, anchor.part)

    def away(self, compliances: Array, tau: Array, log_alpha: float) -> tuple[Array, Array, Array]:
        """Return (modelled minus observed)/error (p k,), and its derivatives by the compliances and by ln α."""
        S, change, slope = compliance(compliances, tau, self.log_frequency + log_alpha)
        both = np.column_stack([change, slope])
        modelled, moved = map(np.concatenate, zip(*(log_modulus(part, S, both) for part in self.parts), strict=True))
        moved = self.whitening @ moved
        return self.whitening @ (modelled - self.log_modulus), moved[:, :-1], moved[:, -1]


def known_part(
    prior: Known, band: tuple[Quantity, Quantity] | None, error: float, reference: float
) -> ModulusObservation:
    """Return E' and E'' of a prior over its measured frequencies."""
    # `band` are angular frequencies at the prior's own reference, rad/s, if not those that it was measured at; `error`
    # is the relative standard error of each modulus (samples of a material have their own); `reference` is the
    # temperature of a material without a shift, K.
    if isinstance(prior, MasterCurve):
        return _of_curve(prior, band, error)
    if isinstance(prior, Material):
        materials: tuple[Material, ...] = (prior,)
        fit = getattr(prior.at(), "fit", None)
        own, gaps = (None, ()) if fit is None else (fit.frequency_range, fit.gaps)
    elif isinstance(prior, MaterialSamples):
        materials = prior.materials
        own, gaps = prior.frequency_range, prior.gaps
    else:
        kind = type(prior).__name__
        raise InputError(f"prior must be a Material, MaterialSamples or a MasterCurve, not {kind}.", code="wrong-type")
    low, high = _checked(own if band is None else band)
    count = max(2, round(PER_DECADE * np.log10(high / low)) + 1)
    frequency = np.geomspace(low, high, count)
    if band is None:
        frequency = frequency[covers((low, high), frequency, gaps)]
        count = len(frequency)
    E = np.array([material.complex_modulus(frequency) for material in materials])
    rows = np.log(np.concatenate([E.real, E.imag], axis=1))
    if len(materials) > 1:
        covariance = np.cov(rows, rowvar=False) + LEAST_ERROR**2 * np.eye(2 * count)
        whitening = np.linalg.inv(np.linalg.cholesky(covariance))
    else:
        whitening = np.eye(2 * count) / error
    temperature = reference if materials[0].reference is None else materials[0].reference
    return ModulusObservation(np.log(frequency), temperature, BOTH, rows.mean(axis=0), whitening)


def _of_curve(curve: MasterCurve, band: tuple[Quantity, Quantity] | None, error: float) -> ModulusObservation:
    """Average ln E' and ln E'' over quarters of a decade."""
    low, high = _checked(
        (float(curve.angular_frequency[0]), float(curve.angular_frequency[-1])) if band is None else band
    )
    within = (curve.angular_frequency >= low) & (curve.angular_frequency <= high)
    if not within.any():
        raise InputError(
            f"prior_band = {low:.3g} to {high:.3g} rad/s: the master curve has no point there.", code="no-points"
        )
    E = curve.complex_modulus[within]
    columns = np.log(np.stack([curve.angular_frequency[within], E.real, E.imag]))
    part = np.floor(PER_DECADE * columns[0] / np.log(10.0))
    means = np.array([columns[:, part == one].mean(axis=1) for one in np.unique(part)])
    moduli = np.concatenate([means[:, 1], means[:, 2]])
    return ModulusObservation(means[:, 0], curve.reference, BOTH, moduli, np.eye(len(moduli)) / error)


def _checked(band: tuple[Quantity, Quantity] | None) -> tuple[float, float]:
    if band is None:
        raise InputError(
            "prior_band is missing: the measured frequencies of a material that was not fitted are unknown; give "
            "(lowest, highest) in rad/s at its reference temperature.",
            code="no-prior-band",
        )
    if np.shape(band) != (2,):
        raise wrong_argument("prior_band", band, "must be two frequencies, such as ('0.1 Hz', '10 Hz').", "wrong-count")
    low, high = (float(frequency_of(end, "prior_band")) for end in band)
    if low >= high:
        raise InputError(
            f"prior_band = {low:g} to {high:g} rad/s: must be two frequencies above zero that ascend.",
            code="not-positive",
        )
    return low, high
