"""What the page shows of a spectrum: moduli over frequency, modes, and what the fit leaves unexplained."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.units import shown_number
from viscofric.web.figures import spec

#: Modes weaker than the strongest by more change nothing that can be seen.
_SEEN = 1e-10
_MODULI = (("storage_modulus", "E′", "square", "blue"), ("loss_modulus", "E″", "circle", "vermilion"))
_TANGENT = (("loss_tangent", "tan δ", "diamond", "green"),)


def moduli_figures(
    found: dict[str, Any], temperature: float | None, *, fitted: bool, path: str = "", moved: str = "moved"
) -> dict[str, spec.Spec]:
    """Return the figures of E' and E'', and of tan δ, at a temperature (K), with band and isotherm where known."""
    band, sweep = found.get("band"), found.get("isotherm")

    def over_frequency(path: str, key: str) -> tuple[str, str]:
        return f"{path}.angular_frequency", f"{path}.{key}"

    def traces(parts: tuple[tuple[str, str, str, str], ...]) -> list[spec.Spec]:
        all_traces: list[spec.Spec] = []
        for key, name, symbol, colour in parts if moved else ():
            look: spec.Spec = {"symbol": symbol, "colour": colour, "open": True, "size": 4}
            all_traces.append(spec.points(*over_frequency(moved, key), f"{name} measured", **look))
        for key, name, _, colour in parts:
            edges = (f"band.{key}_lower", f"band.{key}_upper") if band else None
            all_traces.append(spec.line(*over_frequency(f"{path}modulus", key), name, band=edges, colour=colour))
        for key, name, symbol, colour in parts if sweep else ():
            look = {"symbol": symbol, "colour": colour, "legend": False}
            all_traces.append(spec.points(*over_frequency("isotherm", key), f"{name} of this sweep", **look))
        return all_traces

    measured: Any = found
    for part in moved.split(".") if moved else ():
        measured = measured.get(part) or {}
    seen = measured.get("angular_frequency") if moved and fitted else None
    ends = [] if not seen else [{"x": min(seen), "label": "measured from"}, {"x": max(seen), "label": "to"}]
    at = "" if temperature is None else f" at {spec.quantity(temperature, 'temperature')}"
    sentences = [
        band and f"95 % bands of each modulus ({band['draws']} bootstrap samples).",
        moved and "Points: all measurements, shifted to this temperature.",
        sweep and f"Filled points: the sweep measured at {spec.quantity(sweep['temperature'], 'temperature')}.",
        f"Beyond the points{' (dotted lines)' if ends else ''} the spectrum is extrapolated"
        f"{', and its bands show what a continuation may be' if band else ''}."
        if fitted
        else None,
    ]
    caption = " ".join(filter(None, sentences))
    return {
        "modulus": spec.figure(f"E′ and E″{at}", spec.FREQUENCY, spec.MODULUS, traces(_MODULI), caption, marks=ends),
        "loss-tangent": spec.figure(
            f"tan δ{at}", spec.FREQUENCY, spec.axis("tan δ", log=True), traces(_TANGENT), marks=ends
        ),
    }


def spectrum_figures(found: dict[str, Any]) -> dict[str, spec.Spec]:
    """Return the figures of a result of the job ``rubber``."""
    spectrum = found["spectrum"]
    points_of = "spectrum.measured" if spectrum["measured"] else ""
    fitted = bool((spectrum["fit"] or {}).get("frequency_range"))
    figures = moduli_figures(found, spectrum["reference"], fitted=fitted, path="spectrum.", moved=points_of)
    if spectrum["residual"]:
        residuals = []
        for key, name, symbol, colour in _MODULI:
            look: spec.Spec = {"symbol": symbol, "colour": colour, "open": True, "size": 5}
            where = ("spectrum.measured.angular_frequency", f"spectrum.residual.{key}")
            residuals.append(spec.points(*where, name, **look))
        figures["spectrum-residuals"] = spec.figure(
            "Measured over fitted modulus",
            spec.REDUCED_FREQUENCY,
            spec.axis("log₁₀ measured/fit"),
            residuals,
            "log₁₀, at the points of the master curve.",
            marks=[{"y": 0.0}],
        )
    if spectrum["modes"]:
        figures |= {f"modes-{kind}": _modes(found, kind) for kind in ("retardation", "relaxation")}
    return figures


def _modes(found: dict[str, Any], kind: str) -> spec.Spec:
    """Draw a stem for each mode, with its band and the times that no measured frequency reaches."""
    spectrum, band = found["spectrum"], (found.get("band") or {}).get("modes")
    relaxation = kind == "relaxation"
    table_of, strength_of = ("relaxation", "modulus") if relaxation else ("modes", "creep_coefficient")
    tau, strength = (np.array(spectrum[table_of][name]) for name in (f"{kind}_time", strength_of))
    seen = strength > _SEEN * strength.max()
    tau, strength = tau[seen], strength[seen]
    floor = strength.min() / 2.0
    stems = np.stack([np.full_like(strength, floor), strength, np.full_like(strength, np.nan)], axis=1).ravel()
    colour = "vermilion" if relaxation else "blue"
    bands = []
    if band and not relaxation:
        times, lower, upper = (np.array(band[name]) for name in ("retardation_time", "lower", "upper"))
        rows = upper > floor
        edges = (np.maximum(lower, floor)[rows], upper[rows])
        bands = [spec.line(times[rows], upper[rows], "95 % band", band=edges, colour="sky", width=0)]
    measured = (spectrum["fit"] or {}).get("frequency_range")
    caption = [
        "Modulus E of each mode over its relaxation time; the same material, converted exactly."
        if relaxation
        else "Compliance C of each mode over its retardation time.",
        measured and "The measured frequencies cover the times between the dotted lines.",
        "A single mode is poorly determined, since its neighbours can replace it." if bands else None,
    ]
    symbol = "square" if relaxation else "circle"
    return spec.figure(
        "Relaxation modes (Prony series)" if relaxation else "Retardation modes",
        spec.axis("time τ", "time", log=True),
        spec.axis("modulus E", "modulus", log=True) if relaxation else spec.axis("compliance C (1/Pa)", log=True),
        [
            *bands,
            spec.line(np.repeat(tau, 3), stems, legend=False, decoration=True, colour=colour, width=1.2),
            spec.points(tau, strength, "E_k" if relaxation else "C_k", symbol=symbol, colour=colour),
        ],
        " ".join(filter(None, caption)),
        marks=[
            {"x": 1.0 / end, "label": words} for end, words in zip(measured[::-1], ("measured from", "to"), strict=True)
        ]
        if measured
        else [],
    )


def spectrum_numbers_shown(found: dict[str, Any]) -> list[spec.Spec]:
    """Return the main numbers of a result of the job ``rubber``."""
    spectrum, band = found["spectrum"], found.get("band") or {}
    if not spectrum["modes"]:
        return [spec.number("material", "a table of moduli", remark="without modes")]
    fit = spectrum["fit"] or {}

    def end(label: str, name: str) -> spec.Spec:
        error = band.get(f"{name}_error95")
        remarks = ["95 %" if error else "", fit.get(f"{name}_remark") or ""]
        value, remark = spectrum["modes"][name], "; ".join(filter(None, remarks))
        return spec.number(label, value, "modulus", error=error, remark=remark)

    misfits = []
    if fit.get("rms_step") is not None:
        misfit = shown_number(fit["rms_step"], "z.3f")
        misfits.append(spec.number("misfit of the step tests", misfit, remark="decades, rms"))
    if fit.get("rms_storage") is not None:
        both = ", ".join(shown_number(fit[name], "z.3f") for name in ("rms_storage", "rms_loss"))
        misfits.append(spec.number("misfit of E′, E″", both, remark="decades, rms"))
    count, method = len(spectrum["modes"]["retardation_time"]), fit.get("method") or "from the material file"
    return [
        end("E₀, relaxed", "E0"),
        end("E∞, glassy", "E_inf"),
        spec.number("modes", str(count), remark=method),
        *misfits,
        spec.number("Poisson’s ratio", spectrum["poisson_ratio"]),
    ]


def modes_table(spectrum: dict[str, Any]) -> spec.Spec:
    """Return the modes in both forms, in SI units."""
    shown = {"modes": ("retardation_time", "creep_coefficient"), "relaxation": ("relaxation_time", "modulus")}
    columns = [spectrum[kind][name] for kind, names in shown.items() for name in names]
    rows = [
        [str(at + 1), *(column[at] if at < len(column) else "" for column in columns)]
        for at in range(max(map(len, columns)))
    ]
    head = ["k", "retardation time τ (s)", "compliance C (1/Pa)", "relaxation time (s)", "modulus E (Pa)"]
    return spec.table("Retardation modes, and the same material as a Prony series", head, rows)
