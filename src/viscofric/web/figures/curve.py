"""What the page shows of friction curves: the quantities of their cases, and what is drawn of each."""

from __future__ import annotations

from typing import Any

from viscofric.web.figures.spec import Spec, axis, quantity

#: Quantities of cases; those in `_ROUGH` are a rough surface's, those in `_SMOOTH` an indenter's.
_QUANTITIES = {
    "friction": axis("friction coefficient μ"),
    "indentation": axis("indentation", "length"),
    "contact_area": axis("contact area", "area"),
    "contact_area_fraction": axis("contact area fraction"),
    "max_pressure": axis("maximum pressure", "pressure"),
    "mean_gap": axis("mean gap", "length"),
    "heated_friction": axis("friction coefficient μ with heating"),
    "temperature_rise": axis("rise of temperature (K)"),
    "interface_friction": axis("friction coefficient of the interface"),
    "total_friction": axis("total friction coefficient"),
}
_ROUGH, _SMOOTH = ("contact_area_fraction", "mean_gap"), ("indentation", "contact_area")
_OF_TABLES = ("interface_friction", "total_friction", "heated_friction", "temperature_rise")
_DOUBTS = {
    "extrapolated": "it depends on frequencies at which the material was not measured",
    "shift": "the shift factor is extrapolated beyond the temperatures of the sweeps",
    "strain": "the contact is wide or steep: the small-strain assumption is doubtful",
    "unresolved": "the grid does not resolve it: its numerical error is more than twice the requested accuracy",
}
#: Drawn beside a quantity: column, dashes and words.
_BESIDE = {
    "heated_friction": [("friction", "6px,4px", "isothermal")],
    "temperature_rise": [("coulomb_rise", "6px,4px", "by Coulomb friction"), ("loss_rise", "2px,3px", "by the loss")],
}


def curve_layout(kind: str, extra: list[str], layout: dict[str, Any]) -> dict[str, Any]:
    """Return ``quantities`` of a kind of contact with axes, and ``curves``: cases by combination and temperature."""
    others = [*(_SMOOTH if kind == "rough" else _ROUGH), *(name for name in _OF_TABLES if name not in extra)]
    quantities = {name: about for name, about in _QUANTITIES.items() if name not in others}
    if kind == "line":
        quantities["contact_area"] = axis("contact width", "length")
    rows: dict[tuple[int, float], list[int]] = {}
    for at, key in enumerate(zip(layout["combination"], layout["temperature"], strict=True)):
        rows.setdefault(key, []).append(at)
    curves = [
        {"combination": number, "temperature": kelvin, "rows": sorted(some, key=layout["speed"].__getitem__)}
        for (number, kelvin), some in sorted(rows.items())
    ]
    return {"quantities": quantities, "curves": curves}


def curve_parts(found: dict[str, Any]) -> dict[str, Any]:
    """Return ``parts``, the columns drawn of each quantity, ``remarks``, doubts of each case, and ``summary``."""
    band: Spec = {"lower": "lower", "upper": "upper"} if any(one is not None for one in found["lower"] or ()) else {}
    parts = {}
    for name in found["quantities"]:
        main: Spec = {"y": name, "mode": "lines+markers", "size": 6, "text": "remarks"}
        if name == "friction":
            main |= band or {"error": "error"}
        style: Spec = {"mode": "lines", "width": 1.2, "legend": False}
        beside = [{**style, "y": other, "dash": dash, "text": words} for other, dash, words in _BESIDE.get(name, [])]
        parts[name] = [main, *beside]
    remarks = ["<br>".join(_DOUBTS.get(word, word) for word in words) for words in found["doubts"]]
    known = [one for one in found["friction"] if one is not None]
    summary = f"μ {quantity(min(known), digits=2)} to {quantity(max(known), digits=2)}" if known else ""
    return {"parts": parts, "remarks": remarks, "summary": summary}
