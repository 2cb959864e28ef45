"""Friction near a rubber for which contacts were solved: the first-order closed form, put right by what they gave."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.identification.first_order import FirstOrder


class Solved(NamedTuple):
    """What solved contacts gave at one rubber, at k nodes.

    `compliances` is (1 + m,), ln(1/E_inf) and every ln C; `log_speed`, `log_friction` and `error` (relative) are (k,);
    `change` (k, 1 + m) and `load_slope` (k,) are the derivatives of ln μ by the compliances and by ln F.
    """

    compliances: Array
    log_speed: Array
    log_friction: Array
    error: Array
    change: Array
    load_slope: Array


@dataclass(frozen=True, eq=False)
class CorrectedFriction:
    """ln μ at any speed and compliances, exact with its derivatives at the nodes of the solved rubber.

    Parameters
    ----------
    first : FirstOrder
    solved : Solved or None
        None: the first-order form as it is.

    Notes
    -----
    What the closed form misses of ln μ and of its derivatives varies so slowly with ln v that a cubic spline through a
    few nodes per decade carries it; over changes of the rubber it is continued linearly.  This is space mapping:
    J. W. Bandler et al., IEEE Trans. Microw. Theory Tech. 42 (1994) 2536.
    """

    first: FirstOrder
    solved: Solved | None = None

    def __post_init__(self) -> None:
        if self.solved is None:
            return
        from scipy.interpolate import CubicSpline

        crude = self.first(self.solved.compliances, self.solved.log_speed)
        missing = np.column_stack(
            [
                self.solved.log_friction - crude.log_friction,
                self.solved.change - crude.change,
                self.solved.load_slope,
            ]
        )
        object.__setattr__(self, "_missing", CubicSpline(self.solved.log_speed, missing))

    def __call__(self, compliances: Array, log_speed: Array, log_load: Array) -> tuple[Array, Array, Array]:
        """Return ln μ (n,), its derivatives by the compliances (n, 1 + m) and by ln v (n,).

        Parameters
        ----------
        compliances : (1 + m,) array
            ln(1/E_inf), then every ln C.
        log_speed, log_load : (n,) array
            ln of the reduced speed, m/s, and of the load over that of the nodes.
        """
        crude = self.first(compliances, log_speed)
        if self.solved is None:
            return crude.log_friction, crude.change, crude.slope
        nodes = self.solved.log_speed
        inside = np.clip(log_speed, nodes[0], nodes[-1])
        missing = self._missing(inside)  # type: ignore[attr-defined]
        rising = np.where(inside == log_speed, 1.0, 0.0)[:, None] * self._missing(inside, 1)  # type: ignore[attr-defined]
        moved = compliances - self.solved.compliances
        return (
            crude.log_friction + missing[:, 0] + missing[:, 1:-1] @ moved + missing[:, -1] * log_load,
            crude.change + missing[:, 1:-1],
            crude.slope + rising[:, 0] + rising[:, 1:-1] @ moved + rising[:, -1] * log_load,
        )
