"""The material of [material] scaled to a strain, by the Kraus law of an amplitude sweep."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.ramps import read_amplitude_sweep
from viscofric.rheology.payne.kraus import material_at_strain, on_strain
from viscofric.rheology.payne.kraus_fit import PayneFit, fit_kraus
from viscofric.study.rubber import Rubber
from viscofric.study.run_file.material import MaterialTable

#: What a file of an amplitude sweep may leave open -> the keys of [material] that state it then.
_STATED = {
    "no-deformation": ("deformation",),
    "no-unit": ("modulus_unit",),
    "no-temperature": ("temperature",),
    "missing-columns": ("columns", "sheet"),
}


def payne_of(table: MaterialTable) -> PayneFit | None:
    """Return Kraus's law of the amplitude sweep of [material], whose keys count for what its file leaves open."""
    if table.amplitude_sweep is None:
        return None
    given: dict[str, Any] = {}
    while True:
        try:
            return fit_kraus(read_amplitude_sweep(*table.amplitude_sweep, **given))
        except DataFileError as error:
            keys = [key for key in _STATED.get(error.code, ()) if key not in given and getattr(table, key)]
            if not keys:
                raise
            given |= {key: getattr(table, key) for key in keys}


def at_strain(rubber: Rubber, table: MaterialTable) -> Rubber:
    """Return the material scaled to the strain of [material], with its amplitude sweep; as it is without one."""
    fit = payne_of(table)
    if fit is None:
        return rubber
    notes = [*rubber.notes, *(note for note in fit.notes if note not in fit.sweep.notes)]
    if table.strain is None:
        said = "The amplitude sweep is not used: strain, to which the moduli would be scaled, is not given."
        return replace(rubber, payne=fit, notes=(*notes, Note("no-strain", said)))
    material = material_at_strain(rubber.material, fit.law, table.strain, measured_at=table.measured_at)
    notes += on_strain(fit.law, table.strain)
    small = rubber.material
    return replace(rubber, material=material, linear=small, payne=fit, strain=table.strain, notes=tuple(notes))
