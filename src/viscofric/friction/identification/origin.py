"""A material that says of itself that it was identified from friction, and over which frequencies."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from viscofric.rheology.spectra.quality import FROM_FRICTION, SpectrumFit
from viscofric.rheology.spectra.retardation import RetardationSpectrum

if TYPE_CHECKING:
    from viscofric.friction.identification.result import IdentifiedMaterial
    from viscofric.rheology.material import Material


def with_origin(found: IdentifiedMaterial, source: str) -> Material:
    """Return the identified material with where it comes from, which goes into its file.

    Parameters
    ----------
    found : IdentifiedMaterial
    source : str
        Of the friction curves; may be empty.
    """
    spectrum, band = found.material.spectrum, found.identified
    if not isinstance(spectrum, RetardationSpectrum):
        raise TypeError("an identified material is one of retardation modes.")
    # Known nowhere: then all is extrapolated but the middle.
    ends = (band.low, band.high) if band.high > band.low else (found.middle, found.middle)
    behind = f" ({source})" if source else ""
    origin = f"The rubber was identified from friction{behind}, no modulus of it was measured."
    fit = SpectrumFit(
        None,
        None,
        E0_extrapolated=True,
        E_inf_extrapolated=True,
        frequency_range=(float(ends[0]), float(ends[1])),
        notes=(origin, *found.known),
        method=FROM_FRICTION,
        modes=len(spectrum),
    )
    return replace(found.material, spectrum=replace(spectrum, fit=fit))
