"""Figures and an HTML report, made from a study's results alone: they can be made again from the file.

Nothing here is loaded before it is used: matplotlib and Jinja2 take their time.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from viscofric.report.figures.animation import save_animation
    from viscofric.report.figures.friction import (
        plot_coulomb_friction,
        plot_friction_curves,
        plot_friction_master_curve,
    )
    from viscofric.report.figures.heating import plot_heated_friction, plot_temperature_rise
    from viscofric.report.figures.identified import plot_fitted_records, plot_identified_modulus
    from viscofric.report.figures.interface import plot_friction_parts, plot_shear_stress
    from viscofric.report.figures.motion import (
        plot_force_depth,
        plot_friction_loop,
        plot_restitution,
        plot_transient,
    )
    from viscofric.report.figures.pressures import plot_pressure_profiles, pressure_strip, transient_figure
    from viscofric.report.figures.ramps import plot_amplitude_sweep, plot_temperature_ramps
    from viscofric.report.figures.rubber import (
        plot_isotherms,
        plot_master_curve,
        plot_relaxation_spectrum,
        plot_residuals,
        plot_retardation_spectrum,
    )
    from viscofric.report.figures.shift_factors import (
        plot_law_residuals,
        plot_shift_comparison,
        plot_shift_factors,
        plot_vertical_shift,
    )
    from viscofric.report.figures.study import draw_figures
    from viscofric.report.figures.superposition import (
        plot_booij_thoone_palmen,
        plot_cole_cole,
        plot_kramers_kronig,
        plot_van_gurp_palmen,
        plot_wicket,
    )
    from viscofric.report.html import write_figures_and_report, write_report

# public name -> the module that defines it
_HOME = {
    "draw_figures": "viscofric.report.figures.study",
    "plot_amplitude_sweep": "viscofric.report.figures.ramps",
    "plot_temperature_ramps": "viscofric.report.figures.ramps",
    "plot_booij_thoone_palmen": "viscofric.report.figures.superposition",
    "plot_cole_cole": "viscofric.report.figures.superposition",
    "plot_coulomb_friction": "viscofric.report.figures.friction",
    "plot_friction_curves": "viscofric.report.figures.friction",
    "plot_friction_master_curve": "viscofric.report.figures.friction",
    "plot_friction_parts": "viscofric.report.figures.interface",
    "plot_shear_stress": "viscofric.report.figures.interface",
    "plot_heated_friction": "viscofric.report.figures.heating",
    "plot_temperature_rise": "viscofric.report.figures.heating",
    "plot_fitted_records": "viscofric.report.figures.identified",
    "plot_identified_modulus": "viscofric.report.figures.identified",
    "plot_isotherms": "viscofric.report.figures.rubber",
    "plot_kramers_kronig": "viscofric.report.figures.superposition",
    "plot_law_residuals": "viscofric.report.figures.shift_factors",
    "plot_master_curve": "viscofric.report.figures.rubber",
    "plot_relaxation_spectrum": "viscofric.report.figures.rubber",
    "plot_residuals": "viscofric.report.figures.rubber",
    "plot_retardation_spectrum": "viscofric.report.figures.rubber",
    "plot_shift_comparison": "viscofric.report.figures.shift_factors",
    "plot_shift_factors": "viscofric.report.figures.shift_factors",
    "plot_van_gurp_palmen": "viscofric.report.figures.superposition",
    "plot_vertical_shift": "viscofric.report.figures.shift_factors",
    "plot_wicket": "viscofric.report.figures.superposition",
    "plot_force_depth": "viscofric.report.figures.motion",
    "plot_friction_loop": "viscofric.report.figures.motion",
    "plot_restitution": "viscofric.report.figures.motion",
    "plot_transient": "viscofric.report.figures.motion",
    "plot_pressure_profiles": "viscofric.report.figures.pressures",
    "pressure_strip": "viscofric.report.figures.pressures",
    "transient_figure": "viscofric.report.figures.pressures",
    "save_animation": "viscofric.report.figures.animation",
    "write_figures_and_report": "viscofric.report.html",
    "write_report": "viscofric.report.html",
}

__all__ = [
    "draw_figures",
    "plot_amplitude_sweep",
    "plot_booij_thoone_palmen",
    "plot_cole_cole",
    "plot_coulomb_friction",
    "plot_fitted_records",
    "plot_force_depth",
    "plot_friction_curves",
    "plot_friction_loop",
    "plot_friction_master_curve",
    "plot_friction_parts",
    "plot_heated_friction",
    "plot_identified_modulus",
    "plot_isotherms",
    "plot_kramers_kronig",
    "plot_law_residuals",
    "plot_master_curve",
    "plot_pressure_profiles",
    "plot_relaxation_spectrum",
    "plot_residuals",
    "plot_restitution",
    "plot_retardation_spectrum",
    "plot_shear_stress",
    "plot_shift_comparison",
    "plot_shift_factors",
    "plot_temperature_ramps",
    "plot_temperature_rise",
    "plot_transient",
    "plot_van_gurp_palmen",
    "plot_vertical_shift",
    "plot_wicket",
    "pressure_strip",
    "save_animation",
    "transient_figure",
    "write_figures_and_report",
    "write_report",
]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(importlib.import_module(_HOME[name]), name)
    raise AttributeError(f"module 'viscofric.report' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
