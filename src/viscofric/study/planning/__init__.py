"""What has to be solved for a set of cases: families of similar ones, and the curves that they lie on."""

from viscofric.study.planning.estimates import Expectation, estimate
from viscofric.study.planning.plan import Plan, plan_cases

__all__ = ["Expectation", "Plan", "estimate", "plan_cases"]
