"""Nominal values behind readings that scatter about them, and how far apart readings of one nominal value may be."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array, Integers
    from viscofric.notes import Note


#: Readings scatter about their nominal condition; the next condition is further off than this.
SAME_TEMPERATURE = 1.0  # K
SAME_SPEED = 0.05  # relative
SAME_LOAD = 0.05  # relative

#: Readings that follow each other so closely that they stretch over more tolerances are not one condition.
LONGEST_CHAIN = 4.0


def numbered(values: Array, allowed: Array) -> Integers:
    """Give nominal values numbers in ascending order: a gap wider than allowed starts the next one.

    Parameters
    ----------
    values : (n,) array
    allowed : (n,) array
        The widest gap that each value may have to its neighbour of the same nominal value.

    Returns
    -------
    (n,) array of int
        Number of the nominal value of each reading, from 0.
    """
    order = np.argsort(values, kind="stable")
    apart = np.diff(values[order]) > np.maximum(allowed[order][1:], allowed[order][:-1])
    labels = np.empty(values.size, dtype=np.int64)
    labels[order] = np.concatenate([[0], np.cumsum(apart)])[: values.size]
    return labels


def clusters(values: Array, allowed: Array, refusal: Callable[[float, float], str | Note]) -> Integers:
    """Give nominal values numbers as `numbered` does, and insist that they can be told from scatter.

    Parameters
    ----------
    values : (n,) array
    allowed : (n,) array
        The widest gap that each value may have to its neighbour of the same nominal value.
    refusal : callable
        The sentence that refuses readings without gaps, from their lowest and highest value.

    Raises
    ------
    InputError
        If values without gaps stretch over more than four times what is allowed between neighbours, counted from each
        to the next: what is allowed may grow with the values.
    """
    labels = numbered(values, allowed)
    order = np.argsort(values, kind="stable")
    ends = np.flatnonzero(np.diff(labels[order]))
    for first, last in zip([0, *(ends + 1)], [*ends, values.size - 1], strict=True):
        if not values.size:
            break
        chain = order[first : last + 1]
        widest = np.maximum(allowed[chain[1:]], allowed[chain[:-1]])
        if np.sum(np.diff(values[chain]) / widest) > LONGEST_CHAIN:
            raise InputError(refusal(float(values[chain[0]]), float(values[chain[-1]])))
    return labels
