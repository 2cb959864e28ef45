"""Figures and an HTML report, made from a study's results alone: they can be made again from the file.

Nothing here is loaded before it is used: matplotlib and Jinja2 take their time.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from viscofric.report.consistency_figures import (
        plot_booij_thoone_palmen,
        plot_cole_cole,
        plot_kramers_kronig,
        plot_van_gurp_palmen,
        plot_wicket,
    )
    from viscofric.report.drawing import draw_figures
    from viscofric.report.friction_figures import (
        plot_coulomb_friction,
        plot_friction_curves,
        plot_friction_master_curve,
    )
    from viscofric.report.html import write_figures_and_report, write_report
    from viscofric.report.inverse_figures import plot_identified_modulus, plot_shift_comparison
    from viscofric.report.rubber_figures import plot_isotherms, plot_master_curve, plot_residuals
    from viscofric.report.shift_figures import plot_law_residuals, plot_shift_factors, plot_vertical_shift
    from viscofric.report.spectrum_figures import plot_relaxation_spectrum, plot_retardation_spectrum

# public name -> the module that defines it
_HOME = {
    "draw_figures": "viscofric.report.drawing",
    "plot_booij_thoone_palmen": "viscofric.report.consistency_figures",
    "plot_cole_cole": "viscofric.report.consistency_figures",
    "plot_coulomb_friction": "viscofric.report.friction_figures",
    "plot_friction_curves": "viscofric.report.friction_figures",
    "plot_friction_master_curve": "viscofric.report.friction_figures",
    "plot_identified_modulus": "viscofric.report.inverse_figures",
    "plot_isotherms": "viscofric.report.rubber_figures",
    "plot_kramers_kronig": "viscofric.report.consistency_figures",
    "plot_law_residuals": "viscofric.report.shift_figures",
    "plot_master_curve": "viscofric.report.rubber_figures",
    "plot_relaxation_spectrum": "viscofric.report.spectrum_figures",
    "plot_residuals": "viscofric.report.rubber_figures",
    "plot_retardation_spectrum": "viscofric.report.spectrum_figures",
    "plot_shift_comparison": "viscofric.report.inverse_figures",
    "plot_shift_factors": "viscofric.report.shift_figures",
    "plot_van_gurp_palmen": "viscofric.report.consistency_figures",
    "plot_vertical_shift": "viscofric.report.shift_figures",
    "plot_wicket": "viscofric.report.consistency_figures",
    "write_figures_and_report": "viscofric.report.html",
    "write_report": "viscofric.report.html",
}

__all__ = [
    "draw_figures",
    "plot_booij_thoone_palmen",
    "plot_cole_cole",
    "plot_coulomb_friction",
    "plot_friction_curves",
    "plot_friction_master_curve",
    "plot_identified_modulus",
    "plot_isotherms",
    "plot_kramers_kronig",
    "plot_law_residuals",
    "plot_master_curve",
    "plot_relaxation_spectrum",
    "plot_residuals",
    "plot_retardation_spectrum",
    "plot_shift_comparison",
    "plot_shift_factors",
    "plot_van_gurp_palmen",
    "plot_vertical_shift",
    "plot_wicket",
    "write_figures_and_report",
    "write_report",
]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(importlib.import_module(_HOME[name]), name)
    raise AttributeError(f"module 'viscofric.report' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
