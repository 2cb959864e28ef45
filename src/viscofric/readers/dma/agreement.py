"""What a file prints beside E' and E'' must agree with them: tan δ and |E*| tell swapped columns and wrong units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError

if TYPE_CHECKING:
    from viscofric.arrays import Array


#: Both printed with two digits or so agree within this (relative),
PRINTED = 0.05
#: and a small tan δ within the last of its two decimals.
LAST_DECIMAL = 0.01


def insist_on_agreement(
    path: str, storage: Array, loss: Array, tangent: Array | None = None, absolute: Array | None = None
) -> None:
    """Raise `DataFileError` where most of the printed tan δ or |E*| do not follow from E' and E''.

    Single points may differ: noise about zero, numbers of few digits.

    Parameters
    ----------
    path : str
        Named in errors.
    storage, loss : (n,) array
        Of one unit, NaN where missing.
    tangent, absolute : (n,) array, optional
        tan δ, and |E*| in the same unit.
    """
    used = (storage > 0.0) & (loss > 0.0)
    for printed, name, formula, slack, follows in (
        (tangent, "tan δ", "loss over storage modulus", LAST_DECIMAL, loss[used] / storage[used]),
        (absolute, "|E*|", "√(E'² + E''²)", 0.0, np.hypot(storage[used], loss[used])),
    ):
        if printed is None:
            continue
        told = printed[used]
        known = told > 0.0
        apart = np.abs(told[known] - follows[known]) > PRINTED * follows[known] + slack
        if 2 * np.count_nonzero(apart) > apart.size:
            first = int(np.argmax(apart))
            problem = f"the {name} of {np.count_nonzero(apart)} of {apart.size} points is not {formula}, first "
            problem += f"{told[known][first]:.4g} where they give {follows[known][first]:.4g}; are columns swapped, or "
            raise DataFileError(path, problem + "is a unit wrong?")
