"""What was checked in a study, with its verdict and the numbers behind it, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.report.friction_checks import friction_checks
from viscofric.report.rubber_checks import rubber_checks

if TYPE_CHECKING:
    import xarray as xr

    from viscofric.report.check import Check


def all_checks(tree: xr.DataTree) -> list[Check]:
    """Return every check that the results allow, in the order of the calculation."""
    return [*rubber_checks(tree), *friction_checks(tree)]
