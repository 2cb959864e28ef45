"""What the page shows of files as they were read: their numbers, tables and moduli."""

from __future__ import annotations

from typing import Any

from viscofric.web.figures import spec
from viscofric.web.figures.shift import step_figure

_MOST_ROWS = 200
_RAMPS: spec.Spec = {"mode": "lines+markers", "size": 4, "width": 1.2}
_MODULI = {
    "storage_modulus": ("Storage modulus", "′"),
    "loss_modulus": ("Loss modulus", "″"),
    "loss_tangent": ("Loss tangent", ""),
}


def sweeps_view(found: dict[str, Any], given: str | None) -> dict[str, Any]:
    """Return ``figures``, ``tables`` and ``key_numbers`` of a result of ``sweeps``; `given`: the user's deformation."""
    figures = {}
    if found.get("steps"):
        figures["step-tests"] = step_figure("Creep and relaxation tests", found["steps"], "steps", found["deformation"])
    letter = "G" if found.get("deformation") == "shear" else "E"
    for key in _MODULI if found["source"] in ("dma", "ramps") else ():
        traces = _of_ramps(found["ramps"], key) if "ramps" in found else _of_sweeps(found, key)
        x, look = (spec.TEMPERATURE, _RAMPS) if "ramps" in found else (spec.FREQUENCY, spec.ISOTHERMS)
        figures[_id(key)] = spec.figure(_MODULI[key][0], x, _axis(key, letter), traces, look=look)
    tables = {}
    if found.get("files"):
        tables["files"] = _files(found["files"])
    if found["flagged"]:
        tables["flagged"] = _flagged(found["flagged"])
    return {"figures": figures, "tables": tables, "key_numbers": _numbers(found, given)}


def moduli_of_material(spectrum: dict[str, Any]) -> dict[str, spec.Spec]:
    """Return the figures of a material without measured moduli, at its reference."""
    kelvin = spectrum["reference"]
    at = "" if kelvin is None else f" at {spec.quantity(kelvin, 'temperature')}"
    return {
        _id(key): spec.figure(
            f"{title}{at}",
            spec.FREQUENCY,
            _axis(key, "E"),
            [spec.line("spectrum.modulus.angular_frequency", f"spectrum.modulus.{key}", title.lower(), legend=False)],
        )
        for key, (title, _) in _MODULI.items()
        if key != "loss_tangent"
    }


def _id(key: str) -> str:
    return f"isotherms-{key.replace('_', '-')}"


def _axis(key: str, letter: str) -> spec.Spec:
    title, primes = _MODULI[key]
    modulus = {**spec.MODULUS, "label": f"{title.lower()} {letter}{primes}"}
    return modulus if primes else spec.axis("loss tangent tan δ", log=True)


def _of_ramps(ramps: list[dict[str, Any]], key: str) -> list[spec.Spec]:
    names = [spec.quantity(one["angular_frequency"], "angular_frequency") for one in ramps]
    return [spec.line(f"ramps[{at}].temperature", f"ramps[{at}].{key}", name) for at, name in enumerate(names)]


def _of_sweeps(found: dict[str, Any], key: str) -> list[spec.Spec]:
    """Draw the isotherms with the readings that were left out, or are far from their neighbours."""
    traces = spec.isotherms("isotherms", found["isotherms"], "angular_frequency", key)

    def value(one: dict[str, Any]) -> float:
        storage, loss = (one[name] or 0.0 for name in ("storage_modulus", "loss_modulus"))
        tangent = loss / storage if storage > 0.0 else 0.0
        return float({"storage_modulus": storage, "loss_modulus": loss}.get(key, tangent))

    for name, left, symbol in (("left out", True, "x"), ("far from its neighbours", False, "circle")):
        some = [
            one
            for one in found["flagged"]
            if (one["why"] == "left out") == left and (one["angular_frequency"] or 0.0) > 0.0 and value(one) > 0.0
        ]
        if some:
            omega, text = [one["angular_frequency"] for one in some], [f"{one['place']}: {one['why']}" for one in some]
            look: spec.Spec = {"symbol": symbol, "open": not left, "colour": "red", "size": 9, "text": text}
            traces.append(spec.points(omega, [value(one) for one in some], name, **look))
    return traces


def _span(values: list[float] | None, kind: str) -> str:
    """Return "20 °C to 90 °C"; one of them where both are the same, and a dash without any."""
    ends = dict.fromkeys(spec.quantity(end, kind) for end in (min(values), max(values))) if values else ["–"]
    return " to ".join(ends)


def _numbers(found: dict[str, Any], given: str | None) -> list[spec.Spec]:
    source = found["source"]
    if source in ("master_curve", "file", "catalogue"):
        reference = found["reference"]
        synthetic = "synthetic, not measured" if found["synthetic"] else ""
        return [
            spec.number("material", found["name"] or "unnamed", remark=synthetic),
            spec.number("reference", "none", remark="valid at one temperature only")
            if reference is None
            else spec.number("reference", reference, "temperature"),
        ]
    asked = "deformation" in found["left_open"]
    curves = found["isotherms"] if source == "dma" else found.get("ramps") or found["steps"]["curves"]
    over = "time" if source in ("creep", "relaxation") else "angular_frequency"
    kelvin, values = _all(curves, "temperature"), _all(curves, over)
    count = {"dma": len(values), "ramps": len(kelvin)}.get(source) or found["steps"]["points"]
    numbers = [
        spec.number("measured in", "?", remark="please select tension or shear")
        if asked and given is None
        else spec.number("measured in", found["deformation"], remark="as given" if asked else "from the file"),
        spec.number(
            {"dma": "isotherms", "ramps": "frequencies"}.get(source, "tests"),
            str(len(curves)),
            remark=_span(kelvin, "temperature"),
        ),
        spec.number("points", str(count), remark=_span(values, over)),
    ]
    if source != "dma":
        return numbers
    left, outliers = found["left_out"], sum(one["why"] != "left out" for one in found["flagged"])
    return [*numbers, spec.number("flagged", str(left + outliers), remark=f"{left} left out, {outliers} far off")]


def _all(curves: list[dict[str, Any]], name: str) -> list[float]:
    """Return all values of a column, which may be one number."""
    return [one for curve in curves for one in (curve[name] if isinstance(curve[name], list) else [curve[name]])]


def _files(files: list[dict[str, Any]]) -> spec.Spec:
    head = ["file", "format", "deformation", "readings", "temperatures", "frequencies"]
    rows = [
        [
            one["name"],
            one["format"],
            one["deformation"] or "not stated",
            str(one["readings"]),
            _span(one["temperature"], "temperature"),
            _span(one["angular_frequency"], "angular_frequency"),
        ]
        for one in files[:_MOST_ROWS]
    ]
    return spec.table("Files as read", head, rows)


def _flagged(flagged: list[dict[str, Any]]) -> spec.Spec:
    kinds = {name: name for name in ("temperature", "angular_frequency")}
    kinds |= dict.fromkeys(("storage_modulus", "loss_modulus"), "modulus")
    head = ["location", "reason", "temperature", "frequency", "storage modulus", "loss modulus"]
    rows = [
        [one["place"], one["why"], *(spec.quantity(one[name], kind) for name, kind in kinds.items())]
        for one in flagged[:_MOST_ROWS]
    ]
    return spec.table("Flagged readings", head, rows)
