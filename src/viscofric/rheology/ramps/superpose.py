"""Temperature ramps onto one master curve: by a law found from several frequencies, or by a law that is assumed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, TypeAlias

import numpy as np

from viscofric.arguments import insist_on
from viscofric.data import MasterCurve
from viscofric.errors import InputError, SuperpositionError, brief, check_choice
from viscofric.files import of_synthetic
from viscofric.notes import Note, Remedy
from viscofric.ramps import TemperatureRamps
from viscofric.rheology.ramps.common_law import CommonLaw, RampPoints, common_law
from viscofric.rheology.ramps.result import GlassTransition, RampCheck, RampSuperposition, glass_transition
from viscofric.rheology.shifts.law_fitting import undetermined
from viscofric.rheology.shifts.laws import WLF, Arrhenius, ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import VerticalShift, known_vertical
from viscofric.rheology.superposition.common_curve import Basis
from viscofric.rheology.superposition.kramers_kronig import KramersKronig, kramers_kronig
from viscofric.showing import with_error
from viscofric.threads import one_blas_thread
from viscofric.units import Quantity, checked_poisson_ratio, kelvin_hint, plain, positive, shown_celsius, to_si

#: The constants that M. L. Williams, R. F. Landel, J. D. Ferry (J. Am. Chem. Soc. 77 (1955) 3701) found for many
#: amorphous polymers about their glass transition.
UNIVERSAL = 17.44, 51.6


def assumed_of(text: str, reference: float) -> ShiftLaw | Literal["universal"]:
    """Return the law of a text: "universal", an activation energy, or "WLF" with C1, C2 and their reference."""
    words = text.strip()
    if words.lower() == "universal":
        return "universal"
    if words[:3].lower() == "wlf":
        parts = [part.strip() for part in words[3:].split(",")]
        if len(parts) != 3:
            raise InputError(
                f"{brief(text)}: write 'WLF 17.44, 51.6 K, -30 degC': C1, C2 and their reference.", code="no-law"
            )
        return WLF(to_si(parts[0], "dimensionless", "C1"), parts[1], parts[2])
    return Arrhenius(positive(words, "J/mol", "activation energy"), reference)


def assumed_law(
    assumed: ShiftLaw | str, ramps: TemperatureRamps, peaks: tuple[GlassTransition, ...], kelvin: float
) -> tuple[ShiftLaw, str, TemperatureRamps, list[Note]]:
    """Return the assumed law about the reference, in words, and the points where it holds."""
    lowest = ramps.temperature_range[0]
    if isinstance(assumed, str):
        first = next((one for one in peaks if one.by == "loss modulus"), None)
        if first is None:
            raise SuperpositionError(
                "the universal WLF law needs the glass transition, and the loss modulus has no peak inside the ramp; "
                "give the law about a known one, WLF(17.44, '51.6 K', glass_transition).",
                code="no-peak",
            )
        law: ShiftLaw = WLF(*UNIVERSAL, first.temperature)
        lowest = first.temperature
        words = (
            f"WLF with the universal constants {UNIVERSAL[0]} and {UNIVERSAL[1]} K about "
            f"{shown_celsius(first.temperature)} °C, the peak of the loss modulus at "
            f"{first.angular_frequency / (2.0 * np.pi):.3g} Hz"
        )
    else:
        law, words = assumed, str(assumed)
    lowest = max(lowest, law._divergence + 1.0)
    notes = [Note("shift-assumed", f"α(T) was assumed, not measured: {words}.")]
    before = sum(len(one) for one in ramps.ramps)
    kept = ramps.between(lowest, ramps.temperature_range[1])
    left = before - sum(len(one) for one in kept.ramps)
    if left:
        said = f"{left} points below {shown_celsius(lowest)} °C were left out, where the assumed law does not hold."
        notes.append(Note("points-left-out", said))
    if kelvin < kept.temperature_range[0]:
        raise InputError(
            f"reference = {shown_celsius(kelvin)} °C lies below {shown_celsius(kept.temperature_range[0])} °C, from "
            "where the assumed law holds; choose a warmer one.",
            code="outside-measured",
        )
    return law.at_reference(kelvin), words, kept, notes


def on_assumption(causality: KramersKronig) -> Note:
    """Say what E' and E'' make of an assumed law."""
    if not causality.scale_differs:
        return Note("assumption-consistent", f"{causality.sentence} This is the only test of the assumed α(T).")
    scale = causality.loss_scale
    return Note(
        "assumption-contradicted",
        f"E'' is {with_error(scale, causality.loss_scale_error)} times what the rise of E' requires with the "
        f"assumed α(T) (Kramers–Kronig): log α about {1.0 / scale:.1f} times as large would agree.",
    )


RampLaw: TypeAlias = Literal["wlf", "arrhenius", "vft", "wlf+arrhenius"]
#: Points of a ramp that a common curve needs; a law has up to three constants.
FEWEST_POINTS = 8
#: Temperatures of the table of shift factors.
TABLE = 41
#: Frequencies that are closer than this determine hardly anything.
NARROW = 0.3  # decades
#: A ramp that lies this far from the curve that all share is named.
OFFSET = 0.02  # decades
#: Heating faster than this, the thermometer lags behind the middle of a usual sample by a kelvin or more: a slab of
#: rubber of thickness h lags by q h²/8κ on average over 2/3, with a diffusivity κ of 0.1 mm²/s and h = 2 mm by
#: 3.3 s times the rate q (H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 2nd ed. 1959, sec. 3.3), and
#: the air in the furnace multiplies that.
FAST = 5.0 / 60.0  # K/s


@one_blas_thread
def superpose_ramps(
    ramps: TemperatureRamps,
    reference: Quantity,
    law: RampLaw = "wlf",
    *,
    assumed: ShiftLaw | Literal["universal"] | None = None,
    poisson_ratio: float = 0.5,
    vertical: Literal["density"] | VerticalShift | None = None,
) -> RampSuperposition:
    """Move temperature ramps onto one master curve.

    E(ω, T) = b(T) E(α(T) ω, reference), with α(T) of a law.

    Parameters
    ----------
    ramps : TemperatureRamps
        Of two frequencies or more; of one frequency with `assumed` only.
    reference : float or quantity
        Temperature of the master curve, between those of the ramps; K, or text such as ``"30 degC"``.
    law : {"wlf", "arrhenius", "vft", "wlf+arrhenius"}
        Whose constants are fitted.  "wlf+arrhenius" is WLF above a temperature that is found, and Arrhenius below: for
        ramps that begin in the glass.
    assumed : ShiftLaw or "universal", optional
        A law that is taken as it is, such as ``Arrhenius("200 kJ/mol", "20 degC")``; ``"universal"`` is WLF with the
        constants of Williams, Landel and Ferry, 17.44 and 51.6 K, about the peak of the loss modulus at the lowest
        frequency.  Points where the law does not hold are left out, with a note.
    poisson_ratio : float
        Turns shear moduli into tensile ones, E = 2(1+ν)G.
    vertical : "density" or VerticalShift, optional
        b(T), which is taken off; none by default.

    Returns
    -------
    RampSuperposition

    Raises
    ------
    SuperpositionError
        If there is one frequency and no assumption, ramps have too few points, or no law of the kind describes them.
    InputError
        If an argument is wrong.

    Notes
    -----
    The constants minimise the distance of all points from one smooth curve of log E' and one of log E'', at all
    temperatures and frequencies together (variable projection, splines smoothed by restricted maximum likelihood, as
    for isotherms in `superpose`).  E' and E'' have the weights of their own scatter.  The covariance of the constants
    follows from the scatter of the points about the curves; neighbours that are alike count for fewer.  Moduli of whole
    ramps that are off by a factor each, as after clamping anew, are included where the ramps show it, with a note.
    Four ramps show offsets of 2 %, two ramps in half of the cases only: their intervals then held 69 % of α(T).  95 %
    intervals of planted constants and of α(T) hold 95 % (`benchmarks/rheology/ramps.py`).  Two things are not in
    them: that α(T) may follow another law (`check`; compare a second one), and errors of the temperature.  Without a
    requested vertical shift they include one in proportion to temperature, as in `superpose`, with a note where the
    ramps show it (`vertical-shift-left-out`): with ρT it moved log10 α by up to 0.24 at the ends.

    At one frequency the master curve is the ramp itself, drawn over α(T) ω: no data contradict a wrong α(T), except
    that E' and E'' must belong to each other (Kramers and Kronig).  An activation energy that is too high by a factor
    makes E'' too large, by the same factor, for the rise of E' (`causality.loss_scale`); a note says so.

    While the sample is heated, its middle is colder than the thermometer.  If the lag is the same at all
    temperatures, it moves the reference and nothing else.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> kelvin = np.arange(263.0, 353.0, 1.0)
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> omega = {hertz: 2 * np.pi * hertz * rubber.shift(kelvin) for hertz in (1.0, 10.0)}  # reduced
    >>> moduli = {hertz: rubber.spectrum.complex_modulus(omega[hertz]) for hertz in omega}  # synthetic
    >>> found = vf.readers.TemperatureRamps(
    ...     tuple(vf.readers.TemperatureRamp(f"{hertz} Hz", kelvin, E.real, E.imag) for hertz, E in moduli.items())
    ... )
    >>> fit = vf.superpose_ramps(found, "30 degC")
    >>> truth = rubber.shift.at_reference("30 degC")
    >>> bool(abs(fit.shift.log10("60 degC") - truth.log10("60 degC")) < 0.02)
    True
    """
    insist_on(ramps, "ramps", TemperatureRamps, right="TemperatureRamps; read them with read_ramps(…)")
    check_choice(law, "law", "wlf", "arrhenius", "vft", "wlf+arrhenius")
    if not isinstance(assumed, str) or assumed != "universal":
        insist_on(assumed, "assumed", ShiftLaw, type(None), right='a shift law, "universal" or None')
    kelvin = positive(reference, "K", "reference")
    ratio = checked_poisson_ratio(poisson_ratio)
    tensile = ramps.in_tension(ratio)
    low, high = tensile.temperature_range
    if not low <= kelvin <= high:
        raise InputError(
            f"reference = {shown_celsius(kelvin)} °C lies outside the ramps, {shown_celsius(low)} to "
            f"{shown_celsius(high)} °C",
            code="outside-measured",
            remedy=kelvin_hint(kelvin),
        )
    b = known_vertical(vertical, kelvin)
    peaks = tuple(
        peak
        for one in tensile.ramps
        for by in ("tan delta", "loss modulus")
        if (peak := glass_transition(one, by)) is not None
    )
    notes: list[str] = [*tensile.notes]
    found: CommonLaw | None = None
    if assumed is None:
        _insist_on_several(tensile)
        points = _points(tensile, b)
        found = common_law(points, "wlf" if law == "vft" else law, kelvin, left_out=vertical is None)
        shift: ShiftLaw = found.law.to_vft() if law == "vft" and isinstance(found.law, WLF) else found.law
        assumption, check = "", _check(points, found)
        notes += _on_fit(tensile, shift, check)
        notes += undetermined(found.law, found.law.parameters, found.law.covariance)
        notes += _on_offsets(found)
        if found.left_out is not None:
            notes += found.left_out.notes(low, high, DENSITY)
    else:
        shift, assumption, tensile, on_law = assumed_law(assumed, tensile, peaks, kelvin)
        notes += on_law
        points, check = _points(tensile, b), None
    curve = _master_curve(tensile, points, shift, kelvin)
    causality = _causality(curve)
    if assumption and causality is not None:
        notes.append(on_assumption(causality))
    notes += _on_lag(tensile)
    return RampSuperposition(
        shift, _table(shift, tensile, kelvin), curve, tensile, peaks, assumption, check, causality, b, tuple(notes)
    )


def _insist_on_several(ramps: TemperatureRamps) -> None:
    frequencies = ramps.angular_frequencies
    if len(ramps) == 1:
        raise SuperpositionError(
            "ramps at one frequency do not determine α(T)",
            code="one-frequency",
            remedy=Remedy(
                "; give one that you assume, such as assumed=Arrhenius('200 kJ/mol', '20 degC') or assumed='universal'"
                ", or measure a second frequency.",
                "; give one that you assume, such as --assumed-shift '250 kJ/mol', or measure a second frequency.",
                "; give one that you assume (assumed_shift), or measure a second frequency.",
                field="material.assumed_shift",
            ),
        )
    fewest = min(len(one) for one in ramps.ramps)
    if fewest < FEWEST_POINTS:
        raise SuperpositionError(
            f"one of the ramps has {fewest} points; {FEWEST_POINTS} or more are needed.", code="too-few-points"
        )
    if np.log10(frequencies[-1] / frequencies[0]) < NARROW:
        raise SuperpositionError(
            f"the frequencies of the ramps range over a factor of {frequencies[-1] / frequencies[0]:.3g}; α(T) needs "
            f"{10**NARROW:.2g} or more.",
            code="too-few-frequencies",
        )


def _points(ramps: TemperatureRamps, vertical: VerticalShift | None) -> RampPoints:
    counts = [len(one) for one in ramps.ramps]
    kelvin = np.concatenate([one.temperature for one in ramps.ramps])
    moduli = np.log10([np.concatenate([getattr(one, name) for one in ramps.ramps]) for name in _MODULI]).T
    if vertical is not None:
        moduli = moduli - np.asarray(vertical.log10(kelvin))[:, None]
    frequency = np.repeat(np.log10(ramps.angular_frequencies), counts)
    return RampPoints(frequency, kelvin, moduli, np.repeat(np.arange(len(counts)), counts))


_MODULI = ("storage_modulus", "loss_modulus")


def _check(points: RampPoints, found: CommonLaw) -> RampCheck:
    """Compare the scatter about common curves with that about curves of each ramp's own."""
    reduced = points.log_frequency + found.law.log10(points.temperature)
    own, offsets = [], []
    for number in range(int(points.ramp[-1]) + 1):
        inside = points.ramp == number
        own.append(np.count_nonzero(inside) * Basis.of(reduced[inside]).smoother(points.moduli[inside]).scatter ** 2)
        away = found.residual[inside].mean(axis=0)
        offsets.append(float(away[np.argmax(np.abs(away))]))
    within = np.sqrt(np.mean(np.sum(own, axis=0)) / len(reduced))
    return RampCheck(float(np.sqrt(np.mean(found.scatter**2))), float(within), tuple(offsets))


def _on_fit(ramps: TemperatureRamps, shift: ShiftLaw, check: RampCheck) -> Iterator[Note]:
    yield Note("ramps-superpose" if check.holds else "ramps-do-not-superpose", check.sentence)
    value, worst = max(zip(check.offsets, ramps.ramps, strict=True), key=lambda each: abs(each[0]))
    if abs(value) > OFFSET:
        hertz = worst.angular_frequency / (2.0 * np.pi)
        yield Note(
            "ramp-off",
            f"The moduli at {hertz:.3g} Hz lie {100.0 * (10.0**value - 1.0):+.0f} % from the common curve on "
            "average; look for inertia, compliance of the instrument or a resonance at this frequency.",
        )
    pole = shift._divergence
    if 0.0 < ramps.temperature_range[0] - pole < NEAR_POLE:
        yield Note(
            "pole-near",
            f"The pole of the law, {shown_celsius(pole)} °C, lies next to the coldest point: the glass determines "
            "it, not the transition. Fit WLF above and Arrhenius below (law 'wlf+arrhenius'), or leave the glass "
            "out.",
        )


def _on_offsets(found: CommonLaw) -> Iterator[Note]:
    if np.any(found.offsets):
        storage, loss = 10.0**found.offsets - 1.0
        words = [f"{plain(100.0 * one, 2)} % in {name}" for one, name in ((storage, "E'"), (loss, "E''"))]
        yield Note(
            "ramp-offsets",
            f"Moduli of whole ramps are off by {' and '.join(words)} (rms), for example because the sample was clamped "
            "anew for each frequency; errors of the law include this.",
            values={"storage": float(storage), "loss": float(loss)},
        )


DENSITY = Remedy(
    ' Compare vertical="density".',
    " Compare --vertical-shift density.",
    ' Compare vertical_shift = "density" under [material].',
    " Compare “Vertical shift b(T)” as “density”.",
)
#: A pole so close below the coldest point follows from that point.
NEAR_POLE = 5.0  # K


def _on_lag(ramps: TemperatureRamps) -> Iterator[Note]:
    rate = ramps.heating_rate
    if rate is None:
        said = (
            "The heating rate is unknown: the middle of the sample lags behind the thermometer, and by how much cannot "
            "be said."
        )
        yield Note("heating-rate-unknown", said)
    elif abs(rate) > FAST:
        yield Note(
            "thermal-lag",
            f"At {60.0 * rate:.3g} K/min the middle of the sample may lag behind the thermometer by kelvins; a lag "
            "that is the same at all temperatures moves the reference temperature only.",
        )


def _causality(curve: MasterCurve) -> KramersKronig | None:
    try:
        return kramers_kronig(curve)
    except InputError:  # too short
        return None


def _master_curve(ramps: TemperatureRamps, points: RampPoints, shift: ShiftLaw, kelvin: float) -> MasterCurve:
    frequency = points.log_frequency + np.asarray(shift.log10(points.temperature))
    order = np.argsort(frequency, kind="stable")
    moduli = 10.0 ** points.moduli[order]
    temperature, made_up = points.temperature[order], of_synthetic(ramps.notes)
    return MasterCurve(10.0 ** frequency[order], moduli[:, 0], moduli[:, 1], temperature, kelvin, made_up)


def _table(shift: ShiftLaw, ramps: TemperatureRamps, kelvin: float) -> ShiftFactors:
    """Return the law as a table over the temperatures of the ramps, with the covariance that its constants make."""
    temperatures = np.linspace(*ramps.temperature_range, TABLE)
    covariance = shift._covariance(temperatures) if shift.has_standard_error else None
    values, made_up = np.asarray(shift.log10(temperatures)), of_synthetic(ramps.notes)
    return ShiftFactors(temperatures, values, kelvin, covariance, made_up)
