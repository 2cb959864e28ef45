"""What shows that the contact engine is right: checks against closed forms, other solvers, energy, and refinement.

They are what ``viscofric verify`` runs and what the verification page shows, and they are tested to fail where they
should.
"""

from viscofric.verification import (
    ball,
    elastic,
    line,
    refinement,
    restated,
    similarity,
    single_layers,
    slopes,
    waves,
    windows,
)
from viscofric.verification.check import Check, Comparison, Outcome, run_checks, select

#: All checks, in the order in which they are told.
CHECKS: tuple[Check, ...] = (
    *elastic.CHECKS,
    *waves.CHECKS,
    *single_layers.CHECKS,
    *line.CHECKS,
    *ball.CHECKS,
    *similarity.CHECKS,
    *restated.CHECKS,
    *slopes.CHECKS,
    *refinement.CHECKS,
    *windows.CHECKS,
)

__all__ = ["CHECKS", "Check", "Comparison", "Outcome", "run_checks", "select"]
