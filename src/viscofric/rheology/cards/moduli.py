"""The physics between a card and a material: shear and bulk relaxation on one side, tension on the other."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum

#: Shear and bulk modes of a card whose times and ratios agree so well are one relaxation.
_ALIKE = 1e-9


def tensile(shear: RelaxationSpectrum, bulk: RelaxationSpectrum | None) -> tuple[RetardationSpectrum, float, list[str]]:
    """Return the tensile spectrum of a solid known by its shear and bulk relaxation, exactly.

    1/E = 1/(3G) + 1/(9K) holds at every frequency, so that the retardation modes of E are those of G and of K
    together.  Where K relaxes as G does (or is infinite), the Poisson ratio is constant and E = 2(1+ν)G.

    Parameters
    ----------
    shear : RelaxationSpectrum
        G(t), Pa.
    bulk : RelaxationSpectrum, optional
        K(t), Pa; None for an incompressible solid.

    Returns
    -------
    spectrum : RetardationSpectrum
        Of E.
    poisson_ratio : float
        Of the long-term moduli.
    notes : list of str
        A sentence where the Poisson ratio is not constant.
    """
    if shear.E0 <= 0.0:
        raise InputError(
            "the long-term shear modulus is zero (the relative moduli add up to 1): a liquid has no rubber plateau, "
            "which a Material needs."
        )
    if bulk is None:
        return RelaxationSpectrum(3.0 * shear.E0, 3.0 * shear.E, shear.tau).to_retardation(), 0.5, []
    if bulk.E0 <= 0.0:
        raise InputError("the long-term bulk modulus is zero; a solid needs one above zero.")
    poisson = [(3 * K - 2 * G) / (2 * (3 * K + G)) for G, K in ((shear.E0, bulk.E0), (shear.E_inf, bulk.E_inf))]
    if not all(0.0 <= ratio <= 0.5 for ratio in poisson):
        raise InputError(
            f"shear and bulk moduli give Poisson ratios of {poisson[0]:.4g} (long-term) and {poisson[1]:.4g} "
            "(instantaneous); both must lie between 0 and 0.5."
        )
    if _alike(shear, bulk):
        factor = 2.0 * (1.0 + poisson[0])
        return RelaxationSpectrum(factor * shear.E0, factor * shear.E, shear.tau).to_retardation(), poisson[0], []
    of_shear, of_bulk = shear.to_retardation(), bulk.to_retardation()
    compliance = 1.0 / (3.0 * shear.E_inf) + 1.0 / (9.0 * bulk.E_inf)
    spectrum = RetardationSpectrum(
        1.0 / (1.0 / (3.0 * shear.E0) + 1.0 / (9.0 * bulk.E0)),
        1.0 / compliance,
        np.concatenate([of_shear.C / 3.0, of_bulk.C / 9.0]),
        np.concatenate([of_shear.tau, of_bulk.tau]),
    )
    note = (
        f"Bulk does not relax as shear does, so that the Poisson ratio runs from {poisson[1]:.4g} (glass) to "
        f"{poisson[0]:.4g} (rubber); E(ω) is exact, the material's constant ratio is that of the rubber."
    )
    return spectrum, poisson[0], [note]


def _alike(shear: RelaxationSpectrum, bulk: RelaxationSpectrum) -> bool:
    if len(shear) != len(bulk):
        return False
    ratio = bulk.E0 / shear.E0
    return bool(
        np.allclose(bulk.tau, shear.tau, rtol=_ALIKE, atol=0.0)
        and np.allclose(bulk.E, ratio * shear.E, rtol=_ALIKE, atol=_ALIKE * shear.E_inf * ratio)
    )


def relative_series(modulus: float, ratios: Any, times: Any, long_term: float | None = None) -> RelaxationSpectrum:
    """Return a Prony series from its instantaneous modulus and relative moduli, as Abaqus and ANSYS have it.

    Parameters
    ----------
    modulus : float
        Instantaneous, Pa.
    ratios, times : array_like
        g_i of each mode, and its relaxation time, s.
    long_term : float, optional
        The long-term modulus where it is known better than by modulus (1 − Σg), which loses digits.
    """
    share = 1.0 - float(np.sum(ratios))
    rubber = modulus * share
    if long_term is not None and abs(long_term - rubber) <= 1e-9 * modulus:
        rubber = long_term
    if abs(share) < 1e-12:
        rubber = 0.0
    if share < -1e-12:
        raise InputError(f"the relative moduli add up to {1.0 - share:.6g}; they must stay below 1.")
    return RelaxationSpectrum(rubber, modulus * np.asarray(ratios, dtype=float), times)
