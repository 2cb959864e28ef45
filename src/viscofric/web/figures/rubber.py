"""What the page shows of a material: its shift, its spectrum, and its moduli where nothing was measured."""

from __future__ import annotations

from typing import Any

from viscofric.web.figures.shift import law_table, limits_in_words, shift_figures, verdict_numbers
from viscofric.web.figures.spectrum import modes_table, spectrum_figures, spectrum_numbers_shown
from viscofric.web.figures.sweeps import moduli_of_material


def rubber_view(found: dict[str, Any]) -> dict[str, Any]:
    """Return what is shown of a result of the job ``rubber``; ``limits`` says where its law is valid."""
    shift, spectrum = found["shift"], found["spectrum"]
    tables = {}
    if shift and shift["laws"]:
        tables["laws"] = law_table(shift["laws"])
    if spectrum["modes"]:
        tables["modes"] = modes_table(spectrum)
    return {
        "figures": {
            **spectrum_figures(found),
            **(shift_figures(found) if shift else {}),
            **moduli_of_material(spectrum),
        },
        "tables": tables,
        "key_numbers": spectrum_numbers_shown(found),
        "verdict_numbers": verdict_numbers(found) if shift and found["check"] else [],
        "summary": {"shift": _shift_summary(found), "spectrum": _spectrum_summary(spectrum)},
        "limits": limits_in_words(shift["material"]) if shift else "",
    }


def _shift_summary(found: dict[str, Any]) -> str:
    if not found["shift"]:
        return "no shift with temperature"
    if found["check"]:
        return str(found["check"]["short"])
    return "assumed law" if found["shift"]["used"] == "assumed" else "from the material file"


def _spectrum_summary(spectrum: dict[str, Any]) -> str:
    return f"{len(spectrum['modes']['retardation_time'])} modes" if spectrum["modes"] else "a table of moduli"
