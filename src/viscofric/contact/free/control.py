"""What holds the indenter: a given load, or a given indentation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from viscofric.contact.complementarity import ComplementaritySolution, solve_complementarity

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.operators.convolution import ConvolutionOperator


class Control(Protocol):
    """How the contact problem on one grid is closed."""

    def solve(
        self, operator: ConvolutionOperator, height: Array, guess: Array, tolerance: float, patience: int | None = None
    ) -> ComplementaritySolution:
        """Solve on one grid from a guess of the pressure; `patience` as of `solve_complementarity`."""


@dataclass(frozen=True)
class GivenLoad:
    """The load is given.

    Parameters
    ----------
    load : float
    """

    load: float

    def solve(
        self, operator: ConvolutionOperator, height: Array, guess: Array, tolerance: float, patience: int | None = None
    ) -> ComplementaritySolution:
        """Solve on one grid from a guess of the pressure; `patience` as of `solve_complementarity`."""
        load, inner = self.load / operator.window.cell_area, operator.for_corrections()
        found = solve_complementarity(
            operator,
            height,
            load,
            guess,
            tolerance=tolerance,
            patience=patience,
            inner=inner,
            extension=operator.extension(inner.dtype),
        )
        return found.on_numpy(operator.backend)


@dataclass(frozen=True)
class GivenIndentation:
    """The indentation is given.

    Parameters
    ----------
    indentation : float
    """

    indentation: float

    def solve(
        self, operator: ConvolutionOperator, height: Array, guess: Array, tolerance: float, patience: int | None = None
    ) -> ComplementaritySolution:
        """Solve on one grid from a guess of the pressure; `patience` as of `solve_complementarity`."""
        inner = operator.for_corrections()
        found = solve_complementarity(
            operator,
            height,
            None,
            guess,
            indentation=self.indentation,
            tolerance=tolerance,
            patience=patience,
            inner=inner,
            extension=operator.extension(inner.dtype),
        )
        return found.on_numpy(operator.backend)
