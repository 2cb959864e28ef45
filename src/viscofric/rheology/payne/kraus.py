"""Kraus's law of the moduli of a filled rubber over the strain amplitude, and a material at the strain of a contact.

G. Kraus, J. Appl. Polym. Sci. Appl. Polym. Symp. 39 (1984) 75; A. R. Payne, J. Appl. Polym. Sci. 6 (1962) 57.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.data import DEFORMATIONS, modulus_columns
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, check_choice, wrong_argument
from viscofric.notes import Note
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.shift_law import checked_covariance
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum
from viscofric.showing import Plotted, Rows, with_error
from viscofric.units import Quantity, in_si, number, shown_celsius, to_si

#: Amplitudes that the law is drawn at.
_DRAWN = 101
#: The constants in the order of their covariance.
CONSTANTS = ("storage_linear", "storage_large", "critical_strain", "exponent", "loss_peak", "loss_large")


_UNITS = dict.fromkeys(CONSTANTS, "Pa") | {
    "critical_strain": "dimensionless",
    "exponent": "dimensionless",
    "angular_frequency": "rad/s",
    "temperature": "K",
}


@dataclass(frozen=True, eq=False)
class KrausLaw(Plotted):
    """Kraus's law of the moduli of a filled rubber at a strain amplitude γ.

    G' = G'∞ + (G'0 − G'∞)/(1 + (γ/γc)^2m) and G'' = G''∞ + 2 (G''m − G''∞) (γ/γc)^m/(1 + (γ/γc)^2m); the same for E in
    tension.

    Parameters
    ----------
    storage_linear, storage_large : float
        G'0 at the smallest and G'∞ at the largest amplitudes, Pa.
    critical_strain : float
        γc, where half of the difference is left; a fraction.
    exponent : float
        m.
    loss_peak, loss_large : float
        G''m at γc, and G''∞ at the smallest and the largest amplitudes, Pa.
    angular_frequency, temperature : float
        Where it was measured, rad/s and K.
    deformation : {"tension", "compression", "bending", "shear"}
        Which strain γ and which moduli they are.
    covariance : (6, 6) array, optional
        Of the constants in this order, where the law was fitted.
    strain_range : (float, float), optional
        Amplitudes of the fit.

    Examples
    --------
    >>> import viscofric as vf
    >>> law = vf.rheology.KrausLaw(6e6, 1.5e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "shear")
    >>> law.complex_modulus(0.02).round()
    np.complex128(3750000+900000j)
    """

    storage_linear: float
    storage_large: float
    critical_strain: float
    exponent: float
    loss_peak: float
    loss_large: float
    angular_frequency: float
    temperature: float
    deformation: str = "tension"
    covariance: Array | None = None
    strain_range: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        for name in (*CONSTANTS, "angular_frequency", "temperature"):
            value = getattr(self, name)
            value = to_si(value, _UNITS[name], name)
            if not value > 0.0:
                raise InputError(f"{name} = {value:g}: must be above zero.", code="not-positive")
            object.__setattr__(self, name, value)
        check_choice(self.deformation, "deformation", *DEFORMATIONS)
        if self.covariance is not None:
            object.__setattr__(self, "covariance", checked_covariance(self.covariance, len(CONSTANTS), "Kraus's law"))
        if self.strain_range is not None:
            ends = in_si(self.strain_range, "dimensionless", "strain_range")
            if ends.shape != (2,) or not 0.0 < ends[0] < ends[1]:
                raise InputError(
                    "strain_range must be two amplitudes above zero, the smaller one first.", code="not-ascending"
                )
            object.__setattr__(self, "strain_range", (float(ends[0]), float(ends[1])))

    def _shown(self) -> Rows:
        errors = (None,) * 6 if self.standard_errors is None else self.standard_errors
        return (
            ("linear storage modulus", self.storage_linear, "Pa", errors[0]),
            ("at large strain", self.storage_large, "Pa", errors[1]),
            ("critical strain", self.critical_strain, "%", errors[2]),
            ("exponent", self.exponent, "", errors[3]),
            ("largest loss modulus", self.loss_peak, "Pa", errors[4]),
            ("loss at large strain", self.loss_large, "Pa", errors[5]),
            ("frequency", self.angular_frequency / (2.0 * math.pi), "Hz"),
            ("temperature", self.temperature, "°C"),
            ("deformation", self.deformation),
        )

    def __str__(self) -> str:
        """Return the constants with their standard errors, as for a report."""
        letter = "G" if self.deformation == "shear" else "E"
        errors = (0.0,) * 6 if self.standard_errors is None else self.standard_errors
        names = (f"{letter}'0", f"{letter}'∞", "γc", "m", f"{letter}''m", f"{letter}''∞")
        shown = []
        for place, (name, value, error) in enumerate(zip(names, self.constants, errors, strict=True)):
            factor, unit = ((100.0, " %") if place == 2 else (1.0, "")) if place in (2, 3) else (1e-6, " MPa")
            shown.append(f"{name} = {with_error(factor * value, factor * error)}{unit}")
        return f"Kraus: {', '.join(shown)}"

    @property
    def constants(self) -> Array:
        """The six constants in the order of `covariance`."""
        return np.array([getattr(self, name) for name in CONSTANTS])

    @property
    def standard_errors(self) -> tuple[float, ...] | None:
        """Standard errors of the constants; None where the law was not fitted."""
        return None if self.covariance is None else tuple(np.sqrt(np.diag(self.covariance)).tolist())

    def complex_modulus(self, strain: ArrayLike) -> Any:
        """Return G' + iG'' (or E) at amplitudes above zero, Pa."""
        amplitude = in_si(strain, "dimensionless", "strain")
        if not np.all(amplitude >= 0.0):
            raise InputError("strain must hold amplitudes as fractions, none below zero.", code="negative")
        return kraus_moduli(np.log(np.maximum(self.constants, 1e-300)), amplitude)

    def tensile_strain(self, strain: float) -> float:
        """Return the amplitude of this law's deformation that a tensile strain corresponds to: γ = √3 ε in shear."""
        value = number(strain, "strain")
        return math.sqrt(3.0) * value if self.deformation == "shear" else value

    def to_dataset(self, strain: ArrayLike | None = None) -> Dataset:
        """Return the moduli along ``strain_amplitude``, and the constants.

        Parameters
        ----------
        strain : array_like, optional
            Amplitudes, fractions; without them, the law from a thousandth of γc to a thousand times that, or over the
            amplitudes of its fit.

        Returns
        -------
        xarray.Dataset
            ``storage_modulus`` and ``loss_modulus`` (Pa); attributes are the constants, their standard errors where
            the law was fitted, ``angular_frequency`` (rad/s), ``temperature`` (K) and ``deformation``.

        Raises
        ------
        InputError
            If an amplitude is below zero.
        """
        ends = self.strain_range or (1e-3 * self.critical_strain, 1e3 * self.critical_strain)
        amplitude = np.atleast_1d(
            np.geomspace(*ends, _DRAWN) if strain is None else in_si(strain, "dimensionless", "strain")
        )
        moduli = self.complex_modulus(amplitude)
        return dataset(
            "strain_amplitude",
            modulus_columns(moduli.real, moduli.imag),
            coordinates={"strain_amplitude": (amplitude, "1", "strain amplitude")},
            attributes=self.attributes
            | {
                "angular_frequency": self.angular_frequency,
                "temperature": self.temperature,
                "deformation": self.deformation,
            },
        )

    @property
    def attributes(self) -> dict[str, Any]:
        """The constants and their standard errors, as data sets have them."""
        errors = self.standard_errors or (math.nan,) * len(CONSTANTS)
        return (
            {"law": str(self)}
            | dict(zip(CONSTANTS, self.constants.tolist(), strict=True))
            | {f"{name}_error": error for name, error in zip(CONSTANTS, errors, strict=True)}
        )


def kraus_moduli(logs: Array, strain: Array) -> Any:
    """Return G' + iG'' at amplitudes (n,) from the logarithms of the six constants."""
    linear, large, critical, exponent, peak, floor = np.exp(logs)
    ratio = (strain / critical) ** exponent
    storage = large + (linear - large) / (1.0 + ratio**2)
    return storage + 1j * (floor + 2.0 * (peak - floor) * ratio / (1.0 + ratio**2))


#: Beyond the measured amplitudes by more than this factor the law is extrapolated.
BEYOND = 1.5
#: Strain of a contact over the slope of its edge: D. Tabor, The Hardness of Metals, 1951, ch. V.
TABOR = 0.2
#: ωτ at which the effect of the filler network has faded by half on the way to the glass.
FADED = 1e-3


def contact_strain(slope: Quantity) -> float:
    """Return the tensile strain that stands for a contact: a fifth of the slope at its edge.

    Parameters
    ----------
    slope : float or str
        a/R of a ball or a cylinder, with the contact radius (half-width) a; tan β of a cone whose flank has the angle β
        with the surface.

    Returns
    -------
    float
        A fraction.

    Raises
    ------
    InputError
        If the slope is below zero.

    Notes
    -----
    D. Tabor, The Hardness of Metals, 1951, for the ball; K. L. Johnson, Contact Mechanics, 1985, sec. 6.3, for the
    cone.

    Examples
    --------
    >>> import viscofric as vf
    >>> vf.rheology.contact_strain(0.25)
    0.05
    """
    if not (value := number(slope, "slope")) >= 0.0:
        raise InputError(f"slope = {value:g}: must not be below zero.", code="negative")
    return TABOR * value


def material_at_strain(
    material: Material, law: KrausLaw, strain: Quantity, *, measured_at: Quantity | None = None
) -> Material:
    """Return a material whose moduli are scaled from a small to a larger strain by Kraus's law: an approximation.

    Parameters
    ----------
    material : Material
        With a spectrum; it holds at the strain of its frequency sweeps.
    law : KrausLaw
        From `fit_kraus`, or typed in.
    strain : float or str
        Tensile strain amplitude, a fraction, such as `contact_strain` gives.
    measured_at : float or str, optional
        Tensile strain amplitude of the frequency sweeps; the linear limit of the law without it.

    Returns
    -------
    Material
        Its name says that it is scaled.

    Raises
    ------
    InputError
        If the material is a table, or its modes cannot meet the law.

    Notes
    -----
    At the frequency ω and the temperature of the amplitude sweep the law gives a factor for E' and one for E''.  The
    relaxed modulus and modes that are slow there are multiplied by one number, fast ones by another, with weights
    (ωτ)²/(1 + (ωτ)²) between: the two that meet both factors.  So E' and E'' still belong to each other (Kramers and
    Kronig).  The second number fades to 1 towards the glass, which the filler network hardly changes: by half at
    ωτ = 0.001.  That width is assumed, and so is that the same numbers hold at other temperatures.  A contact strains
    its rubber unevenly and not sinusoidally: one amplitude for all of it is rough, too.

    Examples
    --------
    >>> import viscofric as vf
    >>> law = vf.rheology.KrausLaw(6e6, 1.5e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "shear")  # synthetic
    >>> soft = vf.rheology.material_at_strain(vf.synthetic_fluoroelastomer(), law, strain=0.05)
    >>> before = vf.synthetic_fluoroelastomer().complex_modulus(62.8, 333.15)
    >>> ratio = soft.complex_modulus(62.8, 333.15).real / before.real
    >>> wanted = law.complex_modulus(law.tensile_strain(0.05)).real / law.complex_modulus(0.0).real
    >>> bool(abs(ratio / wanted - 1.0) < 1e-9)
    True
    """
    insist_on(material, "material", Material)
    insist_on(law, "law", KrausLaw)
    spectrum = material.spectrum
    if not isinstance(spectrum, RetardationSpectrum):
        raise InputError("a table of moduli cannot be scaled to a strain; fit a spectrum to it.", code="no-spectrum")
    amplitude = number(strain, "strain")
    start = 0.0 if measured_at is None else number(measured_at, "measured_at")
    for name, value in (("strain", amplitude), ("measured_at", start)):
        if not 0.0 <= value <= 10.0:
            raise wrong_argument(name, value, "must be a fraction (0.05 is 5 %), not below zero.", "out-of-range")
    ends = law.complex_modulus(np.array([law.tensile_strain(start), law.tensile_strain(amplitude)]))
    storage, loss = float(ends[1].real / ends[0].real), float(ends[1].imag / ends[0].imag)
    omega = law.angular_frequency
    if material.shift is not None:
        omega *= float(material.shift(law.temperature))
    relaxation = spectrum.to_relaxation()
    product = omega * relaxation.tau
    slow = product**2 / (1.0 + product**2)
    lasting = product / (product + FADED)
    weights = np.stack([slow, (1.0 - slow) * lasting, (1.0 - slow) * (1.0 - lasting)])  # slow, fast, and the glass
    parts = weights @ (relaxation.E * 1j * product / (1.0 + 1j * product)) + [relaxation.E0, 0.0, 0.0]
    whole, glass = parts.sum(), parts[2]
    wanted = [storage * whole.real - glass.real, loss * whole.imag - glass.imag]
    factors = np.linalg.solve(np.array([parts[:2].real, parts[:2].imag]), wanted)
    if np.any(factors <= 0.0):
        raise InputError(
            f"at {100 * amplitude:.3g} % strain the law asks for negative relaxation strengths: its E' and E'' there "
            "do not go with this material.",
            code="no-relaxed-modulus",
        )
    strengths = (np.array([*factors, 1.0]) @ weights) * relaxation.E
    scaled = RelaxationSpectrum(factors[0] * relaxation.E0, strengths, relaxation.tau).to_retardation()
    name = f"{material.name or 'material'} scaled to {100 * amplitude:.3g} % strain (approximation)"
    return replace(material, spectrum=scaled, name=name)


def on_strain(law: KrausLaw, strain: float) -> list[Note]:
    """Say what a material at a strain is, and where the law is extrapolated."""
    amplitude = law.tensile_strain(strain)
    notes = [
        Note(
            "scaled-to-strain",
            f"The moduli were scaled to {100 * strain:.3g} % tensile strain by Kraus's law, measured at "
            f"{law.angular_frequency / (2 * math.pi):.3g} Hz and {shown_celsius(law.temperature)} °C: an approximation "
            "at other frequencies and temperatures.",
        )
    ]
    if law.strain_range is not None and amplitude > BEYOND * law.strain_range[1]:
        said = f"The strain lies beyond the amplitudes of the sweep, up to {100 * law.strain_range[1]:.3g} %."
        notes.append(Note("beyond-amplitudes", said))
    return notes
