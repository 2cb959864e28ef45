"""What the page shows of a material: its shift, its spectrum, and its moduli where nothing was measured."""

from __future__ import annotations

from typing import Any

from viscofric.web.figures.shift import law_table, shift_figures, verdict_numbers
from viscofric.web.figures.spectrum import modes_table, spectrum_figures, spectrum_numbers_shown
from viscofric.web.figures.sweeps import moduli_of_material


def rubber_view(found: dict[str, Any]) -> dict[str, Any]:
    """Return what is shown of a result of the job ``rubber``, without columns that figures have of their own."""
    shift, check, spectrum = found["shift"], found["check"], found["spectrum"]
    tables = {}
    if shift and shift["laws"]:
        tables["laws"] = law_table(shift["laws"])
    if spectrum["modes"]:
        tables["modes"] = modes_table(spectrum)
    return {
        "shift": shift and _without_lines(shift),
        "check": check and {**check, "kramers_kronig": _without_columns(check.get("kramers_kronig"))},
        "figures": {
            **spectrum_figures(found),
            **(shift_figures(found) if shift else {}),
            **moduli_of_material(spectrum),
        },
        "tables": tables,
        "key_numbers": spectrum_numbers_shown(found),
        "verdict_numbers": verdict_numbers(found) if shift and check else [],
        "summary": {"shift": _shift_summary(found), "spectrum": _spectrum_summary(spectrum)},
    }


def _without_lines(shift: dict[str, Any]) -> dict[str, Any]:
    def bare(law: dict[str, Any]) -> dict[str, Any]:
        return {name: entry for name, entry in law.items() if name != "line"}

    return {**shift, "laws": [bare(law) for law in shift["laws"]], "material": bare(shift["material"])}


def _without_columns(found: dict[str, Any] | None) -> dict[str, Any] | None:
    return found and {name: entry for name, entry in found.items() if not isinstance(entry, (list, dict))}


def _shift_summary(found: dict[str, Any]) -> str:
    if not found["shift"]:
        return "no shift with temperature"
    if found["check"]:
        return str(found["check"]["short"])
    return "assumed law" if found["shift"]["used"] == "assumed" else "from the material file"


def _spectrum_summary(spectrum: dict[str, Any]) -> str:
    return f"{len(spectrum['modes']['retardation_time'])} modes" if spectrum["modes"] else "a table of moduli"
