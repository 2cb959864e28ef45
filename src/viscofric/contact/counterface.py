"""The indenter's own compliance: a second half-space without memory."""

from __future__ import annotations

from viscofric.units import Quantity, checked_poisson_ratio, positive


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
    ratio = checked_poisson_ratio(poisson_ratio, "indenter_poisson_ratio", above=-1.0)
    return (1.0 - ratio**2) / positive(modulus, "Pa", "indenter_modulus")
