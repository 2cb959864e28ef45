"""Assessment of a fitted spectrum: its misfit, plateaus that were not measured, and liquids, which have none."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from viscofric.arrays import Array
from viscofric.data import MasterCurve
from viscofric.errors import LiquidError
from viscofric.notes import Note, note_of
from viscofric.rheology.spectra.misfit import STIFFEST, Misfit, Modes, frequencies_of, gaps_of
from viscofric.rheology.spectra.mode_fits import nonnegative_modes
from viscofric.rheology.spectra.quality import LARGEST_MISFIT, SpectrumFit
from viscofric.rheology.spectra.response import shown_modulus
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.step_tests import StepMasterCurve
from viscofric.units import shown_number

#: What a spectrum is fitted to.
Curve: TypeAlias = "MasterCurve | StepMasterCurve"

#: An end of the master curve is a plateau if the modulus is within this of its limit …
PLATEAU = 0.05
#: … and the loss tangent measured there is below this.
PLATEAU_LOSS_TANGENT = 0.1
ROUNDING = 1e-6
#: Organic glasses have a few times 10⁹ Pa.
STIFFEST_GLASS = 2e10  # Pa
#: A spectrum with a rubber plateau fits a measured curve over its lowest decade to this …
MISSED = 0.05  # decades, rms of E' and E''
#: … or a creep compliance, which bends less on its way to a plateau, to this over its last decade …
MISSED_OVER_TIME = 0.01  # decades
#: … or one that flows is not better by this factor; else the material is a liquid.
BETTER = 2.0
#: A mode slower than the lowest frequency by this factor equals flow, 1/(iωη), to 1e-4.
FLOW = 1e4
#: Slopes are taken over this factor of frequency, the outermost half decade.
END = math.sqrt(10.0)
#: Fewest points for a slope.
POINTS_OF_A_SLOPE = 4


def solid_modes(misfit: Misfit, tau: Array, curve: Curve) -> Modes:
    """Fit non-negative modes with a rubber plateau, and raise `LiquidError` where only flow describes the low end."""
    # The slowest retardation time that a mode may have (`Misfit.ends`) is added to `tau` (n,) in s where the curve's
    # low end is missed without it: whether a lattice has a time near it is chance.
    enough = MISSED_OVER_TIME if isinstance(curve, StepMasterCurve) else MISSED
    solid = nonnegative_modes(misfit, tau)
    if _missed_at_low_end(misfit, solid) <= enough:
        return solid
    solid = nonnegative_modes(misfit, np.append(tau, math.exp(misfit.ends[1])))
    missed = _missed_at_low_end(misfit, solid)
    if missed <= enough:
        return solid
    flowing = nonnegative_modes(misfit, np.append(solid.tau, FLOW / misfit.rates[0]))
    left = _missed_at_low_end(misfit, flowing)
    if missed <= BETTER * left:
        return solid
    if isinstance(curve, StepMasterCurve):
        where, missing = f"longest time, {curve.time[-1]:.3g} s", "the last decade"
    else:
        where = f"lowest frequency, {misfit.rates[0]:.3g} rad/s (tan δ = {curve.loss_tangent[0]:.3g})"
        missing = "E' and E'' of the lowest decade"
    raise LiquidError(
        f"the material flows like a liquid at its {where}: a spectrum with a rubber plateau misses {missing} "
        f"by {missed:.2g} decades (rms), one with E0 = 0 by {left:.2g}, and contacts need E0 above zero; leave out the "
        "hottest isotherms to fit what lies above the flow.",
        code="liquid",
    )


def _missed_at_low_end(misfit: Misfit, modes: Modes) -> float:
    """Return the rms error of log10 E' and log10 E'', or of log10 J, over the lowest decade of rate."""
    away = misfit.misses(modes)[misfit.at_rates(0.0, 10.0 * misfit.rates[0])]
    return float(np.sqrt(np.mean(away**2))) / math.log(10.0)


def judged(
    spectrum: RetardationSpectrum,
    *curves: Curve,
    ends: tuple[int, int] = (0, 0),
    method: str = "",
    tau_ratio: float | None = None,
    regularisation: float | None = None,
    notes: tuple[str, ...] = (),
) -> RetardationSpectrum:
    """Return the spectrum with its `fit` judged against master curves at the same temperature; see `SpectrumFit`."""
    # Of several kinds of tests those at the places `ends` reach the lowest and the highest rates.
    fits = [_fit_to(spectrum, curve) for curve in curves]
    low, high = (fits[place] for place in ends)
    known = [one.measured_storage for one in fits if one.measured_storage is not None]

    def first(name: str) -> float | None:
        return next((getattr(one, name) for one in fits if getattr(one, name) is not None), None)

    plateau = [note for note in map(note_of, low.notes) if note.code.startswith("plateau")]
    glass = [note for note in map(note_of, high.notes) if note.code.startswith("glass")]
    fit = SpectrumFit(
        first("rms_storage"),
        first("rms_loss"),
        E0_extrapolated=low.E0_extrapolated,
        E_inf_extrapolated=high.E_inf_extrapolated,
        frequency_range=(low.frequency_range[0], high.frequency_range[1]),
        notes=(*plateau, *glass, *notes),
        method=method,
        modes=len(spectrum),
        tau_ratio=tau_ratio,
        regularisation=regularisation,
        measured_storage=(min(one[0] for one in known), max(one[1] for one in known)),
        E_inf_at_limit=high.E_inf_at_limit,
        E0_missed=low.E0_missed,
        E_inf_missed=high.E_inf_missed,
        rms_step=first("rms_step"),
        gaps=gaps_of(curves),
    )
    rms = max(value for value in (fit.rms_storage, fit.rms_loss, fit.rms_step) if value is not None)
    if rms > LARGEST_MISFIT:
        said = f"The spectrum lies {rms:.2g} decades (rms) from what was measured (good if ≤ {LARGEST_MISFIT:g})."
        misfit = Note("spectrum-misfit", said, values={"rms": rms, "limit": LARGEST_MISFIT})
        fit = replace(fit, notes=(misfit, *fit.notes))
    return replace(spectrum, fit=fit)


def _fit_to(spectrum: RetardationSpectrum, curve: Curve) -> SpectrumFit:
    """Return the quality of the fit to one curve, with notes on both ends."""
    seen = _seen_over_time(spectrum, curve) if isinstance(curve, StepMasterCurve) else _seen(spectrum, curve)
    softest, stiffest = seen.moduli
    at_limit = spectrum.E_inf >= (1.0 - ROUNDING) * STIFFEST * stiffest
    rise = spectrum.E_inf / seen.fitted[1] - 1.0
    fit = SpectrumFit(
        *seen.rms[:2],
        E0_extrapolated=seen.fitted[0] / spectrum.E0 - 1.0 > PLATEAU or seen.loss[0] > PLATEAU_LOSS_TANGENT,
        E_inf_extrapolated=at_limit or rise > PLATEAU or seen.loss[1] > PLATEAU_LOSS_TANGENT,
        frequency_range=seen.rates,
        measured_storage=seen.moduli,
        E_inf_at_limit=at_limit,
        E0_missed=spectrum.E0 / softest > 1.0 + PLATEAU,
        E_inf_missed=spectrum.E_inf < stiffest * (1.0 - PLATEAU),
        rms_step=seen.rms[2],
    )
    return replace(fit, notes=(*_about_rubber(spectrum, fit, seen), *_about_glass(spectrum, fit, seen)))


@dataclass(frozen=True)
class _Seen:
    """The two ends of a curve: rates (1/s), moduli (Pa), loss tangents; and their words."""

    quantity: str  # such as "E'"
    tests: str
    rates: tuple[float, float]
    moduli: tuple[float, float]  # smallest and largest measured
    fitted: tuple[float, float]  # at the lowest and the highest rate
    loss: tuple[float, float]
    ends: tuple[str, str]
    rms: tuple[float | None, float | None, float | None]  # of log10 E', log10 E'', and log10 J or log10 E(t)
    slopes: tuple[float, float] | None  # of log E' and log E'' at the low end


def _seen(spectrum: RetardationSpectrum, curve: MasterCurve) -> _Seen:
    omega, measured = curve.angular_frequency, curve.complex_modulus
    modulus = spectrum.complex_modulus(omega)
    seen = modulus.imag > 0.0
    rms_loss = math.inf
    if np.any(seen):
        rms_loss = float(np.sqrt(np.mean(np.log10(modulus.imag[seen] / measured.imag[seen]) ** 2)))
    low, high = _loss_tangent_at_ends(omega, curve.loss_tangent)
    return _Seen(
        "E'",
        "sweeps",
        (float(omega[0]), float(omega[-1])),
        (float(measured.real.min()), float(measured.real.max())),
        (float(modulus.real[0]), float(modulus.real[-1])),
        (low, high),
        (
            f"at the lowest frequency, {omega[0]:.3g} rad/s, tan δ is {low:.2f}",
            f"at the highest frequency, {omega[-1]:.3g} rad/s, tan δ is {high:.2f}",
        ),
        (float(np.sqrt(np.mean(np.log10(modulus.real / measured.real) ** 2))), rms_loss, None),
        _slopes_at_low_end(curve),
    )


def _seen_over_time(spectrum: RetardationSpectrum, curve: StepMasterCurve) -> _Seen:
    """Return the ends of a creep or relaxation curve; loss tangents are those of the fit at the rates 1/t."""
    time, measured = curve.time[[-1, 0]], curve.modulus
    creep = curve.kind == "creep"
    response = spectrum.creep_compliance(curve.time) if creep else spectrum.relaxation_modulus(curve.time)
    fitted = 1.0 / response if creep else response
    low, high = (float(one) for one in spectrum.loss_tangent(1.0 / time))
    return _Seen(
        "1/J" if creep else "E(t)",
        "tests",
        frequencies_of(curve),
        (float(measured.min()), float(measured.max())),
        (float(fitted[-1]), float(fitted[0])),
        (low, high),
        (
            f"at the longest time, {time[0]:.3g} s, tan δ of the fit is {low:.2f}",
            f"at the shortest time, {time[1]:.3g} s, tan δ of the fit is {high:.2f}",
        ),
        (None, None, float(np.sqrt(np.mean(np.log10(response / curve.response) ** 2)))),
        None,
    )


def _about_rubber(spectrum: RetardationSpectrum, fit: SpectrumFit, seen: _Seen) -> Iterator[Note]:
    softest, end = seen.moduli[0], seen.ends[0]
    where = (
        f"E0 = {shown_modulus(spectrum.E0)} lies {_beside(spectrum.E0, softest)} the smallest measured "
        f"{seen.quantity} ({shown_modulus(softest)})"
    )
    if fit.E0_missed:
        also = f" {end[0].upper()}{end[1:]}: the rubber plateau was not measured." if fit.E0_extrapolated else ""
        yield Note("plateau-missed", f"{where}: the fit does not follow the softest points.{also}")
    elif fit.E0_extrapolated:
        said = f"{where}, and {end}: the rubber plateau was not measured, so that E0 is extrapolated."
        yield Note("plateau-extrapolated", said)
    else:
        return
    if seen.slopes is not None and seen.loss[0] > 1.0:
        storage, loss = (shown_number(slope, ".2f") for slope in seen.slopes)
        yield Note(
            "plateau-doubtful",
            f"At the lowest frequency E' falls as ω^{storage} and E'' as ω^{loss}: the measurement cannot separate a "
            "soft rubber from a liquid (2 and 1), and whether E0 is above zero is not known.",
        )


def _about_glass(spectrum: RetardationSpectrum, fit: SpectrumFit, seen: _Seen) -> Iterator[Note]:
    stiffest, end = seen.moduli[1], seen.ends[1]
    glass = f"E_inf = {shown_modulus(spectrum.E_inf)}"
    largest = f"the largest measured {seen.quantity} ({shown_modulus(stiffest)})"
    where = f"{glass} lies {_beside(spectrum.E_inf, stiffest)} {largest}"
    if fit.E_inf_at_limit:
        yield Note(
            "glass-doubtful",
            f"{glass} is the largest that the fit allows, {STIFFEST:g} times {largest}, and no result: {end}, and the "
            f"{seen.tests} do not reach the glass.",
        )
    elif fit.E_inf_missed:
        also = f" {end[0].upper()}{end[1:]}: the glassy plateau was not measured." if fit.E_inf_extrapolated else ""
        values = {"E_inf": spectrum.E_inf, "measured": float(stiffest)}
        yield Note("glass-missed", f"{where}: the fit does not follow the stiffest points.{also}", values=values)
    elif fit.E_inf_extrapolated:
        said = f"{where}, and {end}: the glassy plateau was not measured, so that E_inf is extrapolated."
        yield Note("glass-extrapolated", said)
    if spectrum.E_inf > STIFFEST_GLASS:
        yield Note(
            "glass-unphysical",
            f"{glass} is beyond any organic glass (a few GPa); no material has such a glass, and the spectrum is not "
            "physical above the measured frequencies.",
        )


def _beside(limit: float, measured: float) -> str:
    """Return the distance of a limit of the fit from that of the data, in words."""
    if limit > 10.0 * measured:
        return f"{limit / measured:.0f} times above"
    if limit < 0.1 * measured:
        return f"{measured / limit:.0f} times below"
    return f"{100 * abs(limit / measured - 1.0):.1f} % {'above' if limit >= measured else 'below'}"


def _loss_tangent_at_ends(angular_frequency: Array, loss_tangent: Array) -> tuple[float, float]:
    """Return the median over the outermost half decade: single points are noisy."""
    low = angular_frequency <= angular_frequency[0] * END
    high = angular_frequency >= angular_frequency[-1] / END
    return float(np.median(loss_tangent[low])), float(np.median(loss_tangent[high]))


def _slopes_at_low_end(master_curve: MasterCurve) -> tuple[float, float] | None:
    """Return the slopes of log E' and log E'' over log ω in the lowest half decade; None with too few points."""
    low = master_curve.angular_frequency <= master_curve.angular_frequency[0] * END
    frequency = np.log(master_curve.angular_frequency[low])
    if len(frequency) < POINTS_OF_A_SLOPE or np.ptp(frequency) < 0.5 * math.log(END):
        return None
    away = (frequency - frequency.mean()) / np.sum((frequency - frequency.mean()) ** 2)
    moduli = (master_curve.storage_modulus, master_curve.loss_modulus)
    storage, loss = (float(away @ np.log(modulus[low])) for modulus in moduli)
    return storage, loss
