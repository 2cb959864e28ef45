"""What was checked in a study, with its verdict and the numbers behind it, in words."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from viscofric.report.friction_checks import friction_checks
from viscofric.report.results import rubbers
from viscofric.report.rubber_checks import rubber_checks

if TYPE_CHECKING:
    import xarray as xr

    from viscofric.report.check import Check


def all_checks(tree: xr.DataTree) -> list[Check]:
    """Return every check that the results allow, in the order of the calculation."""
    of_each = [
        replace(check, name=f"{check.name} ({rubber})")
        for rubber, branch in rubbers(tree)
        for check in rubber_checks(branch)
    ]
    return [*rubber_checks(tree), *of_each, *friction_checks(tree)]


def counted(checks: list[Check]) -> str:
    """Say how many checks there are of each verdict: 12 checks: 9 passed, 2 to look at, 1 noted."""
    words = {"failed": "failed", "look at this": "to look at", "noted": "noted", "passed": "passed"}
    found = [(sum(check.verdict == verdict for check in checks), told) for verdict, told in words.items()]
    parts = ", ".join(f"{count} {told}" for count, told in found if count)
    return f"{len(checks)} check{'' if len(checks) == 1 else 's'}: {parts}." if checks else ""
