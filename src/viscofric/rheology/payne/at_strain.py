"""A material at the strain of a contact: moduli scaled by Kraus's law."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscofric.arguments import insist_on
from viscofric.errors import InputError, wrong_argument
from viscofric.notes import Note
from viscofric.rheology.material import Material
from viscofric.rheology.payne.kraus import KrausLaw
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum
from viscofric.units import Quantity, number, shown_celsius

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
