"""The least-squares problem of an identification from indentation: growing contacts, spectrum and shift factors."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from viscofric.friction.identification.problem import SpectrumProblem
from viscofric.rheology.spectra.step_misfit import contour

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.arrays import Array
    from viscofric.friction.identification.indentation.growing import Growing


#: Negligible change of ln α: where α is known, it is held to 1e-7.
SAME = 1e-6


class _Kernel(NamedTuple):
    """Matrices that depend on the retardation times only, for one shift factor."""

    log_alpha: float
    relaxed: NDArray[Any]  # (G K, m), 1/(1 + s τ) at the nodes
    creep: Array  # (n, m), weighted, if the load was prescribed


class Functional:
    """Response of a growing contact to compliances, by its Laplace transform along a contour (`step_misfit`)."""

    def __init__(self, contact: Growing, tau: Array) -> None:
        self.contact, self.tau = contact, tau
        nodes, weights = contour()
        self._s = (nodes / contact.grid[:, None]).ravel()
        self._rows = np.stack([weights / nodes, weights])  # of the mean, and of the value
        self._kernel: _Kernel | None = None
        self._total = contact.weights @ np.ones(2 * len(contact.grid))

    def __call__(self, glass: float, C: Array, log_alpha: float, extra: float) -> tuple[Array, Array, Array]:
        """Return ∫ J dI, or ∫ E dI, (n,), with its changes by ln of the compliances (n, 1 + m) and by ln α (n,).

        `glass` and `C` (m,) are compliances at the reference, `extra` that of an elastic indenter, 1/Pa.
        """
        kernel = self._at(log_alpha)
        if self.contact.creep:
            changes = np.concatenate([(self._total * glass)[:, None], kernel.creep * C], axis=1)
            value = changes.sum(axis=1) + self._total * extra
            moved = self._weighted((C * kernel.relaxed * (kernel.relaxed - 1.0)).sum(axis=1)[:, None])[:, 0]
            return value, changes, moved
        modes = kernel.relaxed * C
        compliance = glass + extra + modes.sum(axis=1)
        slope = -1.0 / compliance**2
        value = self._weighted((1.0 / compliance)[:, None])[:, 0]
        by_alpha = (modes * (kernel.relaxed - 1.0)).sum(axis=1)
        columns = np.concatenate([np.full((len(modes), 1), glass), modes, by_alpha[:, None]], axis=1)
        changes = self._weighted(slope[:, None] * columns)
        return value, changes[:, :-1], changes[:, -1]

    def _at(self, log_alpha: float) -> _Kernel:
        if self._kernel is None or abs(self._kernel.log_alpha - log_alpha) > SAME:
            relaxed = 1.0 / (1.0 + np.outer(self._s, np.exp(log_alpha) * self.tau))
            creep = self._weighted(relaxed) if self.contact.creep else np.zeros((0, 0))
            self._kernel = _Kernel(log_alpha, relaxed, creep)
        return self._kernel

    def _weighted(self, transform: NDArray[Any]) -> Array:
        """Return the response (n, k) of functions of s at the nodes of every time on the grid, (G K, k)."""
        shaped = transform.reshape(len(self.contact.grid), self._rows.shape[1], -1)
        both = (self._rows @ shaped).real.swapaxes(0, 1)
        return np.asarray(self.contact.weights @ both.reshape(2 * len(self.contact.grid), -1))


@dataclass(frozen=True, eq=False)
class IndentationProblem(SpectrumProblem):
    """Identification from growing contacts; the data are the logarithms of their responses."""

    contacts: tuple[Growing, ...]
    number: tuple[int, ...]  # of each contact's temperature
    errors: tuple[Array, ...]  # (n,) of each contact, of ln of the response
    plane_strain: float  # 1 − ν²
    extra: float = 0.0  # (1 − ν_i²)/E_i of the indenter over the plane strain of the rubber, 1/Pa
    functionals: dict[int, Functional] = field(default_factory=dict, repr=False)  # in common to all roughnesses

    @cached_property
    def count(self) -> int:
        """Number of measured values."""
        return sum(len(contact) for contact in self.contacts)

    def fitted(self, unknowns: Array) -> tuple[Array, Array]:
        """Return ln of the modelled responses (count,), and their derivatives."""
        compliances, log_alpha = self.split(unknowns)
        strengths = np.exp(compliances)
        values, changes = [], []
        for place, (contact, number) in enumerate(zip(self.contacts, self.number, strict=True)):
            if place not in self.functionals:
                self.functionals[place] = Functional(contact, self.smoothness.tau)
            alpha = float(log_alpha[number])
            found, change, moved = self.functionals[place](float(strengths[0]), strengths[1:], alpha, self.extra)
            by_alpha = np.zeros((len(contact), len(log_alpha)))
            by_alpha[:, number] = moved
            values.append(np.log(found) + (1.0 if contact.creep else -1.0) * np.log(self.plane_strain))
            changes.append(np.concatenate([change, by_alpha], axis=1) / found[:, None])
        return np.concatenate(values), np.concatenate(changes)

    def measured(self, unknowns: Array) -> tuple[Array, Array]:
        """Return modelled minus measured ln of the responses over their errors, and their derivatives."""
        value, change = self.fitted(unknowns)
        error = np.concatenate(self.errors)
        observed = np.concatenate([np.log(contact.response) for contact in self.contacts])
        return (value - observed) / error, change / error[:, None]
