"""Verification of the contact engine: checks against closed forms, other solvers, energy balance, and refinement.

``viscofric verify`` and the verification page run them; tests show that each check can fail.
"""

from viscofric.verification import ball, elastic, invariances, line, over_time, refinement, slopes, waves
from viscofric.verification.check import Check, Comparison, Outcome, checks_in, run_checks, select

#: All checks, in the order of the report.
CHECKS = checks_in(elastic, waves, line, ball, invariances, slopes, refinement, over_time)

__all__ = ["CHECKS", "Check", "Comparison", "Outcome", "run_checks", "select"]
