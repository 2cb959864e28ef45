"""Verification of the contact engine: checks against closed forms, other solvers, energy balance, and refinement.

``viscofric verify`` and the verification page run them; tests show that each check can fail.
"""

from viscofric.verification import (
    ball,
    elastic,
    line,
    over_time,
    refinement,
    restated,
    similarity,
    slopes,
    waves,
    windows,
)
from viscofric.verification.check import Check, Comparison, Outcome, run_checks, select

#: All checks, in the order of the report.
CHECKS: tuple[Check, ...] = (
    *elastic.CHECKS,
    *waves.CHECKS,
    *line.CHECKS,
    *ball.CHECKS,
    *similarity.CHECKS,
    *restated.CHECKS,
    *slopes.CHECKS,
    *refinement.CHECKS,
    *windows.CHECKS,
    *over_time.CHECKS,
)

__all__ = ["CHECKS", "Check", "Comparison", "Outcome", "run_checks", "select"]
