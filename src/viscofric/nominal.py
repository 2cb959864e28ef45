"""Nominal values of scattered readings, and the tolerance of readings with one nominal value."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array, Indices, Integers
from viscofric.errors import InputError
from viscofric.notes import Note

#: Smallest difference of nominal conditions; readings scatter less.
SAME_TEMPERATURE = 1.0  # K
SAME_SPEED = 0.05  # relative
SAME_LOAD = 0.05  # relative

#: Readings without gaps that extend over more tolerances are not one condition.
LONGEST_CHAIN = 4.0


def numbered(values: Array, allowed: Array) -> Integers:
    """Return the number of the nominal value of each reading, from 0, ascending.

    A gap wider than `allowed`, (n,), between neighbours begins the next nominal value.
    """
    order = np.argsort(values, kind="stable")
    apart = np.diff(values[order]) > np.maximum(allowed[order][1:], allowed[order][:-1])
    labels = np.empty(values.size, dtype=np.int64)
    labels[order] = np.concatenate([[0], np.cumsum(apart)])[: values.size]
    return labels


def parted(values: NDArray[Any], gap: float) -> list[Indices]:
    """Return the rows of values, ascending, in parts between which neighbours differ by more than a gap."""
    order = np.argsort(values, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(values[order]) > gap) + 1) if order.size else []


def nominal_rows(temperature: Array) -> list[Indices]:
    """Return the rows of each nominal temperature, of temperatures in K, ascending; none of none."""
    return [np.sort(rows) for rows in parted(temperature, SAME_TEMPERATURE)]


def clusters(values: Array, allowed: Array, refusal: Callable[[float, float], str | Note]) -> Integers:
    """Return numbers of nominal values as `numbered`, provided that they can be distinguished from scatter.

    `refusal` is the sentence about readings without gaps, from their lowest and highest value.
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
