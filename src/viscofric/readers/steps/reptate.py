"""Creep and relaxation files of RepTate (.creep, .gt): a line of parameters, names of columns, units or none."""

from __future__ import annotations

from dataclasses import replace

from viscofric.readers.dma.tables.reptate import parameters_of
from viscofric.readers.source import Source
from viscofric.units import CELSIUS_ZERO

#: RepTate's names of columns -> heading with the unit that it means; its tests are in shear.
_HEADINGS = {"t": "t (s)", "strain": "shear strain (-)", "stress": "shear stress (Pa)", "sxy": "shear stress (Pa)"}
_HEADINGS |= {"T": "T (degC)", "Temp": "T (degC)"}


def with_units(source: Source) -> Source:
    """Return such a file as a table with a unit in every heading, any other file as it is.

    The strain of a relaxation test (``gamma``, 1 if it is not given) and the temperature (``T``) are taken from the
    parameters where there are no columns for them.
    """
    lines = (source.text or "").splitlines()
    parameters = parameters_of(lines[0]) if lines else {}
    names = lines[1].split() if len(lines) > 1 else []
    if not parameters or names[:1] != ["t"] or not {"sxy", "strain"} & set(names):
        return source
    headings = [_HEADINGS.get(name, name) for name in names]
    strain = [] if "strain" in names else [parameters.get("gamma", "1")]
    stress = [] if {"stress", "sxy"} & set(names) else [parameters.get("stress", "")]
    kelvin = source.temperature
    if kelvin is None and not {"T", "Temp"} & set(names):
        kelvin = _kelvin(parameters)
    more = [_HEADINGS["strain"]] * len(strain) + [_HEADINGS["stress"]] * len(stress)
    text = ["# " + lines[0], "\t".join([*headings, *more])]
    for line in lines[2:]:
        cells = line.split()
        numbers = bool(cells) and cells[0][:1] in "0123456789.+-"
        text.append("\t".join([*cells, *strain, *stress]) if numbers else "")  # a row of units is not needed
    return replace(source, data="\n".join(text).encode(), temperature=kelvin)


def _kelvin(parameters: dict[str, str]) -> float | None:
    try:
        return float(parameters["T"]) + CELSIUS_ZERO
    except (KeyError, ValueError):
        return None
