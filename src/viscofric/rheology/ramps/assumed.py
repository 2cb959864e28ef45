"""A shift law that is assumed for a temperature ramp at one frequency, and what E' and E'' make of it."""

from __future__ import annotations

from typing import Literal

import numpy as np

from viscofric.errors import InputError, SuperpositionError, brief
from viscofric.notes import Note
from viscofric.ramps import TemperatureRamps
from viscofric.rheology.ramps.glass_transition import GlassTransition
from viscofric.rheology.shifts.laws import WLF, Arrhenius, ShiftLaw
from viscofric.rheology.superposition.kramers_kronig import KramersKronig
from viscofric.units import positive, shown_celsius, to_si

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
        f"E'' is {scale:.2f} ± {causality.loss_scale_error:.2f} times what the rise of E' requires with the "
        f"assumed α(T) (Kramers–Kronig): log α about {1.0 / scale:.1f} times as large would agree.",
    )
