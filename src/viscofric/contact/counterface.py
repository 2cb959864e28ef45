"""The indenter's own compliance: a second half-space without memory."""

from __future__ import annotations

from viscofric.errors import InputError
from viscofric.units import Quantity, positive, to_si


def indenter_compliance(modulus: Quantity | None, poisson_ratio: float) -> float:
    """Return the compliance of an elastic indenter.

    Parameters
    ----------
    modulus : float, str or pint.Quantity, optional
        Young's modulus E_i, Pa; of a rigid indenter None.
    poisson_ratio : float
        ν_i.

    Returns
    -------
    float
        (1 − ν_i²)/E_i, 1/Pa; zero if rigid (K. L. Johnson, Contact Mechanics (1985), Eq. 4.6).

    Raises
    ------
    InputError
        If the modulus is not above zero, or the ratio not from −1 to 0.5.
    """
    if modulus is None:
        return 0.0
    ratio = to_si(poisson_ratio, "dimensionless", "indenter_poisson_ratio")
    if not -1.0 < ratio <= 0.5:
        raise InputError(
            f"indenter_poisson_ratio = {poisson_ratio!r}: must lie between -1 and 0.5, such as 0.3 of steel."
        )
    return (1.0 - ratio**2) / positive(modulus, "Pa", "indenter_modulus")
