"""What ``.plot()`` of each result draws: one function for each class, of the figures where there is one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import matplotlib
import numpy as np
from matplotlib.axes import Axes

from viscofric.friction.curves import is_predicted
from viscofric.ramps import TemperatureRamps
from viscofric.report.data import as_dataset, modulus_band
from viscofric.report.figures.contact import plot_pressure_map, plot_pressure_profile
from viscofric.report.figures.friction import plot_friction_curves, plot_friction_master_curve
from viscofric.report.figures.heating import plot_heated_friction
from viscofric.report.figures.identified import plot_fitted_record, plot_identified_modulus
from viscofric.report.figures.interface import plot_shear_stress
from viscofric.report.figures.motion import plot_force_depth, plot_friction_loop, plot_restitution, plot_transient
from viscofric.report.figures.ramps import plot_amplitude_sweep, plot_temperature_ramps
from viscofric.report.figures.rough import (
    plot_contact_map,
    plot_friction_by_wavelength,
    plot_line_scan,
    plot_power_spectra,
    plot_rough_friction,
    plot_topography,
)
from viscofric.report.figures.rubber import (
    plot_isotherms,
    plot_master_curve,
    plot_relaxation_spectrum,
    plot_retardation_spectrum,
    plot_step_master_curve,
)
from viscofric.report.figures.shift_factors import (
    draw_law,
    plot_shift_comparison,
    plot_shift_factors,
    plot_vertical_shift,
)
from viscofric.report.figures.style import BLUE, MODULI, STYLE, looks
from viscofric.report.figures.superposition import plot_van_gurp_palmen
from viscofric.report.figures.sweeps import plot_study
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.showing import prefixed, shown_value
from viscofric.units import CELSIUS_ZERO

Drawing: TypeAlias = Callable[..., Any]


#: A law of shift factors is drawn from so far below to so far above its reference, where it is valid, K.
_BELOW, _ABOVE = 50.0, 100.0


def plot(result: object, axes: Axes | None = None, **options: Any) -> Axes:
    """Draw a result on axes, or on those of a new figure; see `viscofric.showing.Plotted.plot`."""
    drawing = next(PLOTS[one.__name__] for one in type(result).__mro__ if one.__name__ in PLOTS)
    with matplotlib.rc_context(dict(STYLE)):
        if axes is None:
            from matplotlib import pyplot

            axes = pyplot.subplots(layout="constrained")[1]
        drawing(axes, result, **options)
    return axes


def _part(drawing: Drawing, part: Callable[[Any], Any]) -> Drawing:
    """Return the drawing of a part of a result."""
    return lambda axes, result, **options: drawing(axes, part(result), **options)


def _columns(*names: str, along: str, log: str = "") -> Drawing:
    """Return the drawing of those columns that a result has over another, a line for each temperature where it can."""

    def draw(axes: Axes, result: Any) -> None:
        data = as_dataset(result)
        found = [name for name in names if name in data]
        for name in found:
            column = data[name]
            others = [one for one in column.dims if one != along and along in column.dims]
            lines = column.stack(line=others).transpose("line", ...) if others else [column]
            for line, look in zip(lines, looks(len(lines)), strict=True):
                label = column.attrs["long_name"] if len(found) > 1 else ""
                where = [shown_value(line[one].item(), _unit(line[one])) for one in others if one in line.coords]
                style = {"color": look.colour, "linestyle": look.dashes} if others else {}
                text = ", ".join([label] * bool(label) + [one for one in where if one != "unknown"])
                axes.plot(data[along].values, line.values, "." if line.size < 60 else "", label=text or None, **style)
        axes.set_xlabel(_label(data[along]))
        axes.set_ylabel(_label(data[found[0]]) if len(found) == 1 else _unit(data[found[0]]))
        if axes.get_legend_handles_labels()[1]:
            axes.legend()
        axes.set(**{f"{one}scale": "log" for one in log})

    return draw


def _label(column: Any) -> str:
    unit = str(column.attrs.get("units", "1")).replace("**3", "³").replace("**4", "⁴")
    return str(column.attrs.get("long_name", column.name)) + ("" if unit == "1" else f" ({unit})")


def _unit(column: Any) -> str:
    unit = str(column.attrs.get("units", "1"))
    return {"1": "", "K": "°C"}.get(unit, unit)


def _contact(axes: Axes, solution: Any, **options: Any) -> None:
    draw = plot_pressure_profile if solution.geometry == "line" else plot_pressure_map
    draw(axes, solution, **options)
    if solution.geometry != "line":
        axes.set_title(f"pressure up to {prefixed(solution.max_pressure, None, 'Pa')}", fontsize="medium", loc="left")


def _curves(axes: Axes, curves: Any, **options: Any) -> None:
    kind = "prediction" if is_predicted(curves) else "measurement"
    plot_friction_curves(axes, **{kind: curves}, **options)


def _cycle(axes: Axes, cycle: Any) -> None:
    moves = cycle.mean_friction_coefficient is not None
    (plot_friction_loop if moves else plot_force_depth)(axes, cycle.to_dataset())


def _law(axes: Axes, law: ShiftLaw) -> None:
    reference = float(getattr(law, "reference"))  # noqa: B009 - laws of a user may have none in their base
    kelvin = np.linspace(reference - _BELOW, reference + _ABOVE, 151)
    valid = kelvin[np.asarray(law.valid_at(kelvin, above_pole=1.0))]
    handles = draw_law(axes, law, valid)
    axes.plot([reference - CELSIUS_ZERO], [1.0], ".", color="black")
    axes.set(yscale="log", xlabel="temperature (°C)", ylabel=r"shift factor $\alpha_T$")
    axes.legend(handles=handles)


def _laws(axes: Axes, comparison: Any) -> None:
    data = comparison.to_dataset()
    chosen = data["law"].values == data.attrs["chosen"]
    bars = axes.barh(data["law"].values, data["information_criterion"].values, color=np.where(chosen, BLUE, "0.7"))
    axes.bar_label(bars, [f"weight {100.0 * weight:.0f} %" for weight in data["akaike_weight"].values], padding=3)
    axes.set(xlabel="AIC above the lowest", xmargin=0.25)
    axes.invert_yaxis()


def _samples(axes: Axes, samples: Any) -> None:
    bounds = modulus_band(samples, np.geomspace(*samples.frequency_range))
    for name, symbol, _, colour in MODULI:
        look: dict[str, Any] = {"color": colour, "alpha": 0.4, "linewidth": 0, "label": f"{symbol}, 95 %"}
        axes.fill_between(bounds.angular_frequency, *getattr(bounds, name), **look)
    axes.set(xscale="log", yscale="log", xlabel=r"angular frequency $\omega$ (rad/s)", ylabel="modulus (MPa)")
    axes.legend()


def _indentation(axes: Axes, record: Any) -> None:
    _columns("indentation" if record.control == "load" else "load", along="time")(axes, record)


def _master(axes: Axes, found: Any, **options: Any) -> None:
    if is_predicted(found.curves):  # the figure of measurements would call them measured
        _columns("viscoelastic", along="reduced_speed", log="x")(axes, found, **options)
    else:
        plot_friction_master_curve(axes, measurement=found, **options)


def _agreement(axes: Axes, found: Any) -> None:
    error = np.where(np.isfinite(found.bias_error_at), found.bias_error_at, 0.0)
    axes.errorbar(found.temperature - CELSIUS_ZERO, 100.0 * found.bias_at, 100.0 * error, fmt="o")
    axes.axhline(0.0, color="black", linewidth=0.8)
    axes.set(xlabel="temperature (°C)", ylabel="predicted minus measured friction (%)")


def _topography(axes: Axes, topography: Any) -> None:
    if topography.is_line:
        plot_line_scan(axes, topography)
    else:
        axes.set_title(plot_topography(axes, topography)[1], fontsize="medium", loc="left")


def _periodic(axes: Axes, solution: Any) -> None:
    axes.set_title(plot_contact_map(axes, solution)[1], fontsize="medium", loc="left")


def _steps(axes: Axes, result: Any, **options: Any) -> None:
    plot_step_master_curve(axes, result.to_dataset(), **options)


def _spectrum(axes: Axes, spectrum: Any, **options: Any) -> None:
    PLOTS[type(spectrum).__name__](axes, spectrum, **options)


#: Name of a class -> what draws it on axes; subclasses without a line of their own are drawn as their bases.
PLOTS: dict[str, Drawing] = {
    "Agreement": _agreement,
    "AmplitudeSweep": _columns("storage_modulus", "loss_modulus", along="strain_amplitude", log="xy"),
    "ContactAtStrain": _part(_contact, lambda found: found.scaled),
    "ContactSolution": _contact,
    "CycleSolution": _cycle,
    "Density": _columns("density", along="wave_number", log="xy"),
    "FittedRecord": plot_fitted_record,
    "FrictionByWavelength": _part(plot_friction_by_wavelength, lambda found: {"": found}),
    "FrictionCurves": _curves,
    "FrictionDerivatives": _columns("log_C", "log_tau", along="mode"),
    "FrictionMasterCurve": _master,
    "HeatedFrictionCurves": plot_heated_friction,
    "Identified": plot_identified_modulus,
    "ImpactSolution": _part(plot_force_depth, as_dataset),
    "IndentationRecord": _indentation,
    "Isotherm": _part(plot_isotherms, lambda found: (found,)),
    "IsothermalSweeps": plot_isotherms,
    "JointSuperposition": _part(plot_shift_factors, lambda found: found.shift_factors),
    "KrausLaw": _columns("storage_modulus", "loss_modulus", along="strain_amplitude", log="xy"),
    "LawComparison": _laws,
    "MasterCurve": plot_master_curve,
    "Material": _part(_spectrum, lambda found: found.spectrum),
    "MaterialSamples": _samples,
    "ModulusTable": _columns("storage_modulus", "loss_modulus", along="angular_frequency", log="xy"),
    "OscillationRecord": _columns("storage_stiffness", "loss_stiffness", along="angular_frequency", log="xy"),
    "PayneFit": plot_amplitude_sweep,
    "PeriodicSolution": _periodic,
    "PerssonTheory": _columns("friction_coefficient", along="speed", log="x"),
    "PowerSpectrum": _part(plot_power_spectra, lambda found: {"": found}),
    "RampSuperposition": _part(plot_master_curve, lambda found: found.master_curve),
    "ReboundRecord": _columns("restitution", "contact_time", along="speed"),
    "RelaxationSpectrum": plot_relaxation_spectrum,
    "RestitutionCurve": _part(plot_restitution, as_dataset),
    "RetardationSpectrum": plot_retardation_spectrum,
    "RoughFriction": plot_rough_friction,
    "ShearStress": plot_shear_stress,
    "ShiftAgreement": lambda axes, found: plot_shift_comparison(axes, found.found, found.other),
    "ShiftFactors": plot_shift_factors,
    "ShiftLaw": _law,
    "StepMasterCurve": _steps,
    "StepSuperposition": _part(_steps, lambda found: found.master_curve),
    "StepTests": _steps,
    "StudyResults": _part(plot_study, lambda found: found.dataset),
    "Superposition": plot_master_curve,
    "SuperpositionCheck": plot_van_gurp_palmen,
    "TemperatureRamp": _part(plot_temperature_ramps, lambda found: TemperatureRamps((found,))),
    "TemperatureRamps": plot_temperature_ramps,
    "Topography": _topography,
    "TractionRuns": _columns("traction_force", along="disc_speed"),
    "TransientSolution": _part(plot_transient, as_dataset),
    "VerticalShift": plot_vertical_shift,
}
