"""What the page shows of measured friction: beside its prediction, on one curve, and the material behind it."""

from __future__ import annotations

from typing import Any

from viscofric.web.figures import spec

_VISCOELASTIC = spec.axis("viscoelastic friction coefficient", zero=1.08)
#: Further figures of a test: title, column, column of its bars with a factor, axis and caption.
_OTHERS = {
    "coulomb-friction": (
        "Coulomb friction",
        ("coulomb", "coulomb_scatter", 1.0),
        spec.axis("Coulomb friction coefficient", zero=1.08),
        "Measured{scatter}.",
    ),
    "four-runs": (
        "Check of the four configurations",
        ("consistency", "consistency_error", 2.0),
        spec.axis("residual over load"),
        "(F_I − F_II + F_III − F_IV)/4 over the load, with twice its standard error: zero in a valid test.",
    ),
    "force-cell-zero": (
        "Zero of the force cell",
        ("offset", "", 1.0),
        spec.axis("zero", "load"),
        "As fitted at each condition; a drift is reported in the notes.",
    ),
}
#: Temperatures of points and of their prediction are the same within this, K.
_SAME = 0.5


def _known(curve: dict[str, Any], name: str) -> bool:
    return any(one is not None for one in curve.get(name) or ())


def _scatter(curves: list[dict[str, Any]], bars: str) -> str:
    """Return what bars of measured points are, where there are any."""
    return ", with the standard deviation of the repetitions" if any(_known(one, bars) for one in curves) else ""


def _kept(values: list[float | None], rows: Any) -> list[float | None]:
    return [one if row else None for one, row in zip(values, rows, strict=True)]


def measured_figures(found: dict[str, Any]) -> dict[str, spec.Spec]:
    """Return the figures of a result of the job ``measured``."""
    figures = {}
    for name, (title, (column, bars, factor), y, caption) in _OTHERS.items():
        known = [one for one in found["curves"] if _known(one, column)]
        marks = [{"y": 0.0}] if name == "four-runs" else []
        traces = [one for curve in known for one in _measured(curve, column, bars, factor)]
        if known:
            words = caption.format(scatter=_scatter(known, bars))
            figures[name] = spec.figure(title, spec.SPEED, y, traces, words, marks=marks, synthetic=found["synthetic"])
    return figures | {"measured-friction": _friction(found["curves"], synthetic=found["synthetic"])}


def agreement_figures(found: dict[str, Any], curves: list[dict[str, Any]]) -> dict[str, spec.Spec]:
    """Return measured friction with its prediction, and that at the reference, of a result of ``agreement``."""
    figures = {"measured-friction": _friction(curves, found)}
    if found["along"] and "speed" in found["along"]:
        look: spec.Spec = {"colour": "purple", "name": "predicted", "group": "predicted"}
        figures["along"] = spec.figure("", spec.SPEED, _VISCOELASTIC, _predicted(found["along"], **look))
    return figures


def _friction(curves: list[dict[str, Any]], agreement: dict[str, Any] | None = None, **more: Any) -> spec.Spec:
    """Draw viscoelastic friction as points, with lines and bands of the prediction behind them."""
    doubts = {} if agreement is None else {one["temperature"]: one["remark"] for one in agreement["points"]}
    lines, measured = [], []
    for one in () if agreement is None else agreement["lines"]:
        name = f"{spec.quantity(one['temperature'], 'temperature')}, predicted"
        lines += _predicted(one, temperature=one["temperature"], name=name, legend=False)
    for curve in curves:
        near = [words for kelvin, words in doubts.items() if abs(kelvin - curve["temperature"]) < _SAME]
        measured += _measured(curve, "viscoelastic", "viscoelastic_scatter", doubts=near[0] if near else None)
    band = ", with the 95 % band of its uncertainty" if agreement and agreement["band"] else ""
    caption = f"Points: measured{_scatter(curves, 'viscoelastic_scatter')}."
    caption += f" Lines: predicted for the page's material{band}." if lines else ""
    if any(any(words) for words in doubts.values()):
        caption += " Open points: the prediction there is doubtful."
        more["hint"] = "Hover over open points to see why."
    return spec.figure("Viscoelastic friction", spec.SPEED, _VISCOELASTIC, [*lines, *measured], caption, **more)


def _measured(
    curve: dict[str, Any], column: str, bars: str = "", factor: float = 1.0, doubts: list[str] | None = None
) -> list[spec.Spec]:
    """Draw points of one temperature; those that are doubtful are open."""
    kelvin, doubtful = curve["temperature"], doubts or [""] * len(curve["speed"])
    errors, repeated = (curve.get(name) or [None] * len(doubtful) for name in (f"{column}_error", "replicates"))
    text = []
    for error, count, doubt in zip(errors, repeated, doubtful, strict=True):
        words = [
            f"standard error {error:.2g}" if error else "",
            f"{count} repetitions" if (count or 0) > 1 else "",
            doubt,
        ]
        text.append("; ".join(filter(None, words)))
    scatter = [None if one is None else factor * one for one in curve[bars]] if _known(curve, bars) else None

    def some(rows: list[bool], **look: Any) -> spec.Spec:
        error = None if scatter is None else _kept(scatter, rows)
        y = _kept(curve[column], rows)
        return spec.points(curve["speed"], y, error=error, temperature=kelvin, text=text, **look)

    drawn = [some([not one for one in doubtful])]
    if any(doubtful):
        name = f"{spec.quantity(kelvin, 'temperature')}, doubtful"
        drawn.append(some([bool(one) for one in doubtful], name=name, legend=False, open=True))
    return drawn


def _predicted(one: dict[str, Any], **look: Any) -> list[spec.Spec]:
    """Draw a predicted line, thin where it rests on frequencies that were not measured."""
    band = (one["lower"], one["upper"]) if _known(one, "lower") else None
    thin = any(one["extrapolated"])
    whole = spec.line(one["speed"], one["friction"], band=band, width=0.8 if thin else 2, **look)
    sound = _kept(one["friction"], [not row for row in one["extrapolated"]])
    strong: spec.Spec = {**look, "legend": False, "decoration": True}
    return [whole, spec.line(one["speed"], sound, **strong)] if thin else [whole]


def master_figures(found: dict[str, Any], **more: Any) -> dict[str, spec.Spec]:
    """Return friction at one temperature, by each of the shift factors, and these, of a result of ``master``."""
    figures = {}
    for name in ("by_rubber", "found"):
        master = found[name]
        if not master:
            continue
        look: spec.Spec = {"colour": "purple", "name": "smoothed, with its 95 % band"}
        lines = _predicted(master["line"], **look) if master["line"] else []
        measured = [trace for one in master["points"] for trace in _measured(one, "friction", "scatter")]
        x = {**spec.SPEED, "label": f"reduced speed α·v at {spec.quantity(master['reference'], 'temperature')}"}
        title = "Friction at one temperature"
        figures[f"master-{name}"] = spec.figure(title, x, _VISCOELASTIC, [*lines, *measured], master["overlap"], **more)
    return figures | {"friction-shift-factors": _factors(found, **more)}


def _factors(found: dict[str, Any], **more: Any) -> spec.Spec:
    """Draw shift factors found from friction beside those of the material."""
    own, other, traces = found["found"], found["known"], []

    def dots(about: dict[str, Any], name: str, **look: Any) -> spec.Spec:
        log10, error = about["log10_shift_factor"], about.get("standard_error")
        return spec.points(about["temperature"], log10, f"{name} ± standard error", error=error, **look)

    def law(about: dict[str, Any], name: str, **look: Any) -> spec.Spec:
        log10 = about["log10_shift_factor"]
        band = spec.around(log10, about["error95"]) if _known(about, "error95") else None
        return spec.line(about["temperature"], log10, name, band=band, **look)

    if other and other["points"]:
        traces.append(dots(other["points"], "of the material", colour="orange", symbol="square", open=True))
    elif other:
        traces.append(law(other["line"], "of the material", colour="orange"))
    if own and own["law"]:
        traces.append(law(own["law"], "law fitted to friction, with its 95 % band", colour="sky", width=1.2))
    if own:
        traces.append(dots(own["factors"], "from friction", colour="blue"))
    at = spec.quantity((own or found["by_rubber"])["reference"], "temperature")
    caption = (
        own.get("agreement") or ""
        if own
        else "These are the shift factors of the page's material; friction determines none here."
    )
    return spec.figure("Shift factors", spec.TEMPERATURE, spec.axis(f"log₁₀ α, 0 at {at}"), traces, caption, **more)


def identified_view(found: dict[str, Any], curves: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    """Return ``figures``, ``tables`` and ``anchored_at`` of a result of the job ``identify``."""
    lines = []
    for one in found["fit"]:
        look: spec.Spec = {"temperature": one["temperature"], "legend": False}
        name = f"{spec.quantity(one['temperature'], 'temperature')}, fitted"
        lines.append(spec.line(one["speed"], one["fitted"], name, band=(one["lower"], one["upper"]), **look))
    measured = [{**trace, "size": 5} for one in curves for trace in _measured(one, "viscoelastic")]
    title, sentence = "Friction of the identified material", found["sentences"][0]
    middle = spec.quantity(found["middle"], "angular_frequency")
    head = ["level", f"|E| at {middle}", "rms of friction", "χ² above the best"]
    rows = [
        [
            f"× {one['factor']}",
            spec.quantity(one["modulus"], "modulus"),
            f"{spec.quantity(100.0 * one['rms'], digits=2)} %",
            spec.quantity(one["penalty"], digits=2),
        ]
        for one in found["family"]
    ]
    at, anchored = found["anchor"], ""
    if at:
        where = [spec.quantity(at[name], name) for name in ("modulus", "angular_frequency", "temperature")]
        anchored = f"Anchored to |E| = {where[0]} at {where[1]} and {where[2]}."
    family = spec.table("Materials that friction alone hardly distinguishes", head, rows)
    drawn = spec.figure(title, spec.SPEED, _VISCOELASTIC, [*lines, *measured], sentence, **more)
    return {
        "figures": {"identified-modulus": _identified(found, **more), "identified-friction": drawn},
        "tables": {"family": family} if rows else {},
        "anchored_at": anchored,
    }


def _identified(found: dict[str, Any], **more: Any) -> spec.Spec:
    """Draw the modulus that friction identifies, strong where it does, with the page's material beside it."""
    identified, other, traces = found["identified"], found["known"], []
    omega, low, high = found["modulus"]["angular_frequency"], identified["low"] or 0.0, identified["high"] or 0.0
    for symbol, part, colour in (("E′", "storage_modulus", "blue"), ("E″", "loss_modulus", "vermilion")):
        where, look = f"modulus.{part}", {"colour": colour, "group": part}
        band = (f"{where}_lower", f"{where}_upper")
        name = f"{symbol} from friction"
        inside = _kept(found["modulus"][part], [low <= one <= high for one in omega])
        strong: spec.Spec = {**look, "width": 2.6, "legend": False, "decoration": True}
        traces += [
            spec.line("modulus.angular_frequency", where, f"{name}, 95 % band", band=band, width=0.8, **look),
            spec.line("modulus.angular_frequency", inside, name, **strong),
        ]
        if other:
            name = f"{symbol} of {other['name'] or 'the page’s material'}"
            dashed: spec.Spec = {"colour": "green", "dash": "6px,3px", "width": 1.4}
            traces.append(spec.line("modulus.angular_frequency", f"known.{part}", name, **dashed))
    share = f"{spec.quantity(100.0 * identified['limit'], digits=2)} %"
    reference = spec.quantity(found["reference"], "temperature")
    level = " except for the magnitude, which friction does not determine" if identified["relative"] else ""
    marks = [{"x": low, "label": f"identified to {share} from …"}, {"x": high, "label": "… to"}]
    caption = f"Strong lines: |E| is identified to {share}{level}. "
    caption += "Beyond, it follows from the assumption of a smooth spectrum."
    return spec.figure(
        "Modulus identified from friction",
        {**spec.REDUCED_FREQUENCY, "label": f"{spec.REDUCED_FREQUENCY['label']} at {reference}"},
        spec.MODULUS,
        traces,
        caption if high > low else f"|E| is not identified to {share} at any frequency.",
        marks=marks if high > low else [],
        **more,
    )
