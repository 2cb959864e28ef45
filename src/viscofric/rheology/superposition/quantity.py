"""Choice of the quantities that are shifted onto common curves: E' and E'', one of them, or tan δ."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from viscofric.arguments import numbers
from viscofric.arrays import Array
from viscofric.errors import InputError, check_choice
from viscofric.notes import Note, Remedy
from viscofric.rheology.superposition.overlap import LogSweep

ShiftBy: TypeAlias = Literal["both", "storage", "loss", "loss-tangent"]
#: Quantities as combinations (m, 2) of log E' and log E'', and their names.
_SEEN: dict[str, tuple[list[list[float]], str]] = {
    "both": ([[1.0, 0.0], [0.0, 1.0]], "E' and E''"),
    "storage": ([[1.0, 0.0]], "E' alone"),
    "loss": ([[0.0, 1.0]], "E'' alone"),
    "loss-tangent": ([[-1.0, 1.0]], "tan δ alone"),
}


@dataclass(frozen=True, eq=False)
class Quantities:
    """The m quantities of an isotherm that a fit of shifts compares."""

    by: ShiftBy
    seen: Array  # (m, 2), each as a combination of log E' and log E''; (1, 1) for step tests, which have one quantity
    weights: Array  # (m,), of their squared residuals; their mean is 1

    @classmethod
    def chosen(cls, by: str = "both", weights: Any = None) -> Quantities:
        """Return a choice; InputError if unknown, or if the weights are not two positive numbers for E' and E''."""
        check_choice(by, "by", *_SEEN)
        seen = np.array(_SEEN[by][0])
        if weights is None:
            return cls(by, seen, np.ones(len(seen)))  # type: ignore[arg-type]
        if by != "both":
            raise InputError(
                f"weights are for E' and E'' together, and α is found from {_SEEN[by][1]}; leave them out.",
                field="weights",
                code="useless-weights",
            )
        values = numbers(weights, "weights")
        if values.shape != (2,) or not np.all((values > 0.0) & np.isfinite(values)):
            raise InputError(
                "weights must be two positive numbers, of log E' and of log E''; for one of the two alone, "
                "choose by='storage' or by='loss'.",
                field="weights",
                code="wrong-weights",
            )
        return cls("both", seen, values / values.mean())

    @property
    def joint(self) -> bool:
        """Whether E' and E'' both take part."""
        return self.by == "both"

    @property
    def rising(self) -> bool:
        """Whether the first of them is E', which rises with frequency."""
        return self.by in ("both", "storage")

    @property
    def onto_moduli(self) -> Array:
        """Smallest offsets of log E' and log E'' per offset of each quantity, (2, m)."""
        return np.asarray(np.linalg.pinv(self.seen))

    @property
    def alone(self) -> bool:
        """Whether one quantity is shifted where two moduli were measured."""
        return bool(len(self.seen) < self.seen.shape[1])

    def of(self, sweeps: list[LogSweep]) -> list[LogSweep]:
        """Return the quantities of isotherms given by log E' and log E''."""
        return [LogSweep(one.frequency, one.moduli @ self.seen.T, one.weights) for one in sweeps]

    def insist_on_use(self, vertical: object, shift: object) -> None:
        """Raise an error for a choice without effect beside the other arguments of `superpose`."""
        if shift is not None and self.notes:
            raise InputError(
                "shift and by (or weights): give one of them; with shift no factor is left to be fitted.",
                code="give-one",
            )
        if self.by == "loss-tangent" and vertical == "free":
            raise InputError(
                "vertical shifts cancel in tan δ, so that none can be fitted to it.",
                code="no-vertical-in-tangent",
                remedy=Remedy(
                    " Find α first, and fit b to both moduli then: superpose(sweeps, T, shift=fit.shift_factors, "
                    "vertical='free').",
                    " Shift by both moduli, or without a vertical shift.",
                ),
            )

    @property
    def notes(self) -> tuple[Note, ...]:
        """Notes on a choice other than the default."""
        if not self.joint:
            return (Note("shifted-by", f"α was found from {_SEEN[self.by][1]}, as requested."),)
        if self.weights[0] != self.weights[-1]:
            storage, loss = self.weights
            return (
                Note(
                    "shifted-by",
                    f"α was found from E' and E'' with the weights {storage:.3g} and {loss:.3g}, as requested.",
                ),
            )
        return ()


#: E' and E'' with equal weights.
BOTH = Quantities.chosen()
#: The quantity of creep and relaxation tests: log of a modulus, 1/J(t) or E(t), over the rate 1/t.
STEP = Quantities("both", np.ones((1, 1)), np.ones(1))
