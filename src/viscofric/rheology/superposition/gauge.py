"""The gauge of a superposition: where shifts are zero, and which of them are held."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from viscofric.arrays import Array


@dataclass(frozen=True, eq=False)
class Gauge:
    """Which shifts are held.

    Parameters
    ----------
    inverse_temperatures : (n,) array
        1/T of the isotherms, ascending in temperature.
    weights, vertical_weights : (n,) array
        Interpolation at the reference, where log10 α and log10 b are zero.
    held : mapping
        log10 α of isotherms, by their place.
    free_vertical : bool
        Whether vertical shifts are sought.
    """

    inverse_temperatures: Array
    weights: Array
    vertical_weights: Array
    held: Mapping[int, float]
    free_vertical: bool = False

    def free(self) -> tuple[Array, Array]:
        """Return shifts that meet what is held, and an orthonormal basis of the ways to change them."""
        size = len(self.weights)
        full = 2 * size if self.free_vertical else size
        rows = [np.eye(full)[place] for place in self.held]
        values = list(self.held.values())
        if not all(place in self.held for place in np.flatnonzero(self.weights)):
            rows.append(np.concatenate([self.weights, np.zeros(full - size)]))
            values.append(0.0)
        if self.free_vertical:
            rows.append(np.concatenate([np.zeros(size), self.vertical_weights]))
            values.append(0.0)
        matrix = np.array(rows)
        _, _, right = np.linalg.svd(matrix, full_matrices=True)
        return np.linalg.lstsq(matrix, np.array(values), rcond=None)[0], right[len(rows) :].T

    def within(self, first: int, last: int) -> Gauge:
        """Return the same for some of the isotherms; about the nearest of them if the reference is not among them."""
        inside = slice(first, last)
        weights = self.weights[inside]
        if weights.sum() < 1.0 - 1e-9:
            weights = np.eye(last - first)[0 if np.argmax(self.weights) < first else -1]
        held = {place - first: value for place, value in self.held.items()}
        return Gauge(self.inverse_temperatures[inside], weights, self.vertical_weights[inside], held)

    def brought_to(self, shifts: Array) -> Array:
        """Return shifts moved so that they meet what is held, by a correction that is straight in 1/T between."""
        shifts = shifts - self.weights @ shifts
        changes = {float(self.weights @ self.inverse_temperatures): 0.0}
        changes |= {float(self.inverse_temperatures[place]): v - shifts[place] for place, v in self.held.items()}
        points = np.array(sorted(changes.items()))
        shifts = shifts + np.interp(self.inverse_temperatures, points[:, 0], points[:, 1])
        start, ways = self.free()  # what is left of the condition at a reference between isotherms
        parameters = np.concatenate([shifts, np.zeros(len(start) - len(shifts))])
        return np.asarray((start + ways @ (ways.T @ (parameters - start)))[: len(shifts)])
