"""What the page shows of shift factors: the laws, the shifted isotherms, and whether superposition holds."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.units import shown_number
from viscofric.web.figures import spec

_LAWS = ("green", "purple", "orange", "sky")
_LOG_ALPHA = spec.axis("log₁₀ α")
#: A law is hidden at first whose largest residual is so many times that of the best, which counts as 0.005 at least.
_FAR, _LEAST = 20.0, 0.005
#: Columns of the isotherms, with their axes.
_COLUMNS = {
    "storage_modulus": {**spec.MODULUS, "label": "E′"},
    "loss_modulus": {**spec.MODULUS, "label": "E″"},
    "dynamic_modulus": {**spec.MODULUS, "label": "|E*|"},
    "loss_angle": spec.axis("loss angle δ", "angle"),
    "loss_tangent": spec.axis("tan δ", log=True),
}
#: Diagrams that no shift along the frequency changes.
_DIAGRAMS = {
    "van_gurp_palmen": ("van Gurp–Palmen", "dynamic_modulus", "loss_angle"),
    "booij_thoone_palmen": ("tan δ against |E*|", "dynamic_modulus", "loss_tangent"),
    "cole_cole": ("E″ against E′", "storage_modulus", "loss_modulus"),
    "wicket": ("tan δ against E′", "storage_modulus", "loss_tangent"),
}
_RESPONSES = {
    "creep": ("creep compliance", {"shear": "J"}, "D", " (1/MPa)", "plain", 1e6),
    "relaxation": ("relaxation modulus", {"shear": "G"}, "E", "", "modulus", 1.0),
}


def shift_figures(found: dict[str, Any]) -> dict[str, spec.Spec]:
    """Return the figures of the shift of a result of the job ``rubber``."""
    shift, check = found["shift"], found["check"] or {}
    figures = {"shift-factors": _factors(shift)}
    if shift["laws"]:
        figures["law-residuals"] = _residuals(shift)
    if shift["steps"]:
        title = "Creep and relaxation tests over reduced time"
        figures["shifted-steps"] = step_figure(title, shift["steps"], "shift.steps", found["deformation"])
    if shift["vertical"]:
        figures["vertical-shift"] = _vertical(shift["vertical"])
    for name in ("storage_modulus", "loss_modulus", "loss_tangent"):
        y = _COLUMNS[name]
        traces = spec.isotherms("shift.isotherms", shift["isotherms"], "angular_frequency", name)
        over_b = "/b" if shift["vertical"] and y["kind"] else ""
        figures[f"shifted-{name}"] = spec.figure(
            "Isotherms shifted to the reference",
            spec.REDUCED_FREQUENCY,
            {**y, "label": f"{y['label']}{over_b}"},
            [
                {**one, "symbol": "square"} if about["held"] else one
                for one, about in zip(traces, shift["isotherms"], strict=True)
            ],
            "Squares are fixed manually." if any(one["held"] for one in shift["isotherms"]) else "",
            look=spec.ISOTHERMS,
        )
    return figures | (_quality(check, shift["isotherms"]) if shift["isotherms"] else {})


def _factors(shift: dict[str, Any]) -> spec.Spec:
    factors, traces = shift["factors"], []
    if factors:
        held = np.array(factors["held"], dtype=bool)
        for name, rows, symbol, colour in (
            ("isotherms, 95 %", ~held, "circle", "blue"),
            ("fixed manually", held, "square", "orange"),
        ):
            names = ("temperature", "log10_shift_factor", "error95")
            x, y, error = (np.array(factors[one], dtype=float)[rows] for one in names)
            if rows.any():
                traces.append(spec.points(x, y, name, error=error, symbol=symbol, colour=colour))
    drawn = [row for row in shift["laws"] if row.get("line") and row["same_as"] == ""]
    shown = next((row for row in drawn if row["used"]), next((row for row in drawn if row["chosen"]), None))
    for at, row in enumerate(drawn):
        colour = "vermilion" if row is shown else _LAWS[at % len(_LAWS)]
        name = f"{row['title']}{', used' if row['used'] else ', best' if row['chosen'] else ''}"
        traces += _law(row, name, colour, hidden=row is not shown)
    if not factors:
        traces += _law(shift["material"], "α(T) of the material", "vermilion")
    return spec.figure(
        "Shift factor against temperature",
        spec.TEMPERATURE,
        _LOG_ALPHA,
        traces,
        f"{_limits_in_words(shift['material'])} Bars and bands are 95 %. Dotted lines are extrapolated; they end at "
        "the limits of validity.",
        marks=[{"x": shift["reference"], "label": "reference"}],
    )


def _law(row: dict[str, Any], name: str, colour: str, *, hidden: bool = False) -> list[spec.Spec]:
    """Draw a law as a solid line where it was fitted, dotted on either side."""
    kelvin, log10 = (np.array(row["line"][one]) for one in ("temperature", "log10_shift_factor"))
    error = row["line"].get("error95")
    band = None if error is None or hidden else spec.around(log10, error)
    low, high = (row["limits"] or {}).get("fitted") or (-np.inf, np.inf)
    first, last = np.flatnonzero((kelvin >= low) & (kelvin <= high))[[0, -1]]
    look: spec.Spec = {"colour": colour, "group": name, "hidden": hidden}
    beyond: spec.Spec = {**look, "legend": False, "dash": "dot"}

    def part(start: int, end: int, words: str, look: spec.Spec) -> spec.Spec:
        rows = slice(start, end + 1)
        edges = None if band is None else (band[0][rows], band[1][rows])
        return spec.line(kelvin[rows], log10[rows], words, band=edges, **look)

    ends = [(0, first)] if first > 0 else []
    ends += [(last, kelvin.size - 1)] if last < kelvin.size - 1 else []
    return [part(first, last, name, look), *(part(*both, f"{name}, extrapolated", beyond) for both in ends)]


def _residuals(shift: dict[str, Any]) -> spec.Spec:
    traces = []
    if shift["factors"]:
        error = np.array(shift["factors"]["error95"], dtype=float)
        zero = np.zeros_like(error)
        band = (-error, error)
        traces = [spec.line("shift.factors.temperature", zero, "95 % of the factors", band=band, colour="sky", width=0)]
    rows = [(at, row) for at, row in enumerate(shift["laws"]) if row.get("residual") and row["same_as"] == ""]
    worst = {at: np.max(np.abs(row["residual"]["log10_residual"])) for at, row in rows}
    most = _FAR * max(min(worst.values(), default=0.0), _LEAST)
    for at, row in rows:
        where = f"shift.laws[{at}].residual"
        look: spec.Spec = {"mode": "lines+markers", "size": 5, "width": 1.2, "hidden": bool(worst[at] > most)}
        traces.append(spec.line(f"{where}.temperature", f"{where}.log10_residual", row["title"], **look))
    return spec.figure(
        "Measured factors over each law",
        spec.TEMPERATURE,
        spec.axis("log₁₀ measured/law"),
        traces,
        "log₁₀ of the measured over the law’s α; the band is the measurement’s 95 %.",
    )


def _vertical(vertical: dict[str, Any]) -> spec.Spec:
    where, upper = ("shift.vertical.temperature", "shift.vertical.b"), vertical["upper"]
    bars = None if upper is None else np.subtract(upper, vertical["b"])
    return spec.figure(
        "Vertical shift b(T)",
        spec.TEMPERATURE,
        spec.axis("b"),
        [spec.points(*where, error=bars) if upper else spec.line(*where, mode="lines+markers")],
        "Fitted with the shift factors; bars are 95 %." if upper else "ρT/(ρ₀T₀), from rubber elasticity.",
        marks=[{"y": 1.0}],
    )


def step_figure(title: str, steps: dict[str, Any], path: str, deformation: str | None) -> spec.Spec:
    """Return creep or relaxation tests, as measured or with their fit over reduced time."""
    word, symbols, otherwise, unit, kind, scale = _RESPONSES[steps["kind"]]
    fit = steps.get("fit")
    traces = spec.isotherms(f"{path}.curves", steps["curves"], "time", "response")
    if scale != 1.0:
        traces = [
            {**one, "y": [scale * value for value in curve["response"]]}
            for one, curve in zip(traces, steps["curves"], strict=True)
        ]
    if fit:
        fitted = scale * np.array(fit["response"])
        traces.append(spec.line(f"{path}.fit.time", fitted, "fitted", mode="lines", colour="vermilion", width=1.5))
    time = spec.axis("reduced time t/α" if fit else "time", "time", log=True)
    label = f"{word} {symbols.get(deformation or '', otherwise)}{unit}"
    look = {**spec.ISOTHERMS, "mode": "markers" if fit else "lines+markers", "size": 4}
    return spec.figure(title, time, spec.axis(label, kind, log=True), traces, look=look)


def _quality(check: dict[str, Any], shifted: list[dict[str, Any]]) -> dict[str, spec.Spec]:
    """Draw what shows whether superposition holds."""
    figures = {
        f"diagram-{name}": spec.figure(
            title,
            _COLUMNS[x],
            _COLUMNS[y],
            spec.isotherms("shift.isotherms", shifted, x, y),
            "No shift along the frequency changes these points.",
            look={**spec.ISOTHERMS, "width": 1},
        )
        for name, (title, x, y) in _DIAGRAMS.items()
    }
    pairs = check["neighbours"]
    between = [0.5 * (pair["colder"] + pair["warmer"]) for pair in pairs]
    distance, error = ([pair[name] for pair in pairs] for name in ("distance", "error95"))
    figures["neighbour-distances"] = spec.figure(
        "Distance of neighbouring isotherms",
        {**spec.TEMPERATURE, "label": "temperature between them"},
        spec.axis("distance (decades)"),
        [spec.points(between, distance, error=error)],
        "In tan δ against |E*|, which no shift changes; bars: 95 % range of the noise.",
        marks=[{"y": 0.0}],
    )
    causal = check["kramers_kronig"]
    return figures if causal is None else figures | {"kramers-kronig": _causal(causal)}


def _causal(found: dict[str, Any]) -> spec.Spec:
    """Draw each modulus computed from the other; open points at the ends are not judged."""
    judged, traces = np.array(found["judged"], dtype=bool), []
    for inside in (True, False):
        rows = judged == inside
        for key, name, symbol, colour in (
            ("storage", "E′ computed from E″", "square", "blue"),
            ("loss", "E″ computed from E′", "circle", "vermilion"),
        ):
            x, y = (np.array(found[one], dtype=float)[rows] for one in ("angular_frequency", f"{key}_deviation"))
            look: spec.Spec = {"symbol": symbol, "colour": colour, "size": 6, "open": not inside, "legend": inside}
            traces.append(spec.points(x, y, name if inside else f"{name}, not evaluated", group=name, **look))
    return spec.figure(
        "Kramers–Kronig",
        spec.REDUCED_FREQUENCY,
        spec.axis("log₁₀ demanded/measured"),
        traces,
        f"{found['sentence']} Drawn: log₁₀ of each modulus computed from the other, over the measured one; open points "
        "at the ends are not evaluated.",
        marks=[{"y": found["allowed"], "label": "allowed rms of E′"}, {"y": -found["allowed"]}],
    )


def verdict_numbers(found: dict[str, Any]) -> list[spec.Spec]:
    """Return the numbers behind the verdict on superposition."""
    check, shift = found["check"], found["shift"]
    misfit, merit = shift["misfit"], check.get("figure_of_merit")
    held = sum((shift["factors"] or {}).get("held", ()))
    origin = f"{held} fixed manually" if held else "fitted to the measurements"
    origin = "from a file" if shift["origin"] == "given" else origin
    agree = {None: "not tested", True: "agree", False: "do not agree"}
    causal = (check.get("kramers_kronig") or {}).get("holds")
    numbers = [
        misfit
        and spec.number(
            "overlap", f"{shown_number(misfit['joint'], 'z.3f')} decades", remark=f"rms over {misfit['points']} points"
        ),
        merit is not None and spec.number("figure of merit", merit, digits=2, remark="good if ≤ 1"),
        bool(shift["isotherms"])
        and spec.number("E′ against E″", agree[None if causal is None else bool(causal)], remark="Kramers–Kronig"),
        spec.number("α(T) used", "as measured" if shift["used"] == "measured" else shift["used"], remark=origin),
    ]
    return [one for one in numbers if one]


def _limits_in_words(material: dict[str, Any]) -> str:
    """Return what law is used and where it is valid."""
    if not material["limits"]:
        return str(material["words"])
    low, high = (None if end is None else spec.quantity(end, "temperature") for end in material["limits"]["valid"])
    inside = f"above {low}" if low and material["limits"]["valid"][0] > 0.0 else "at every temperature"
    return f"Used: {material['words']}. Valid {f'from {low} to {high}' if low and high else inside}."
