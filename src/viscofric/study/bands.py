"""Bands of a study: its rubber drawn as other measurements might have given it, and what that makes of friction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.bands import DrawnMaterials, with_material_band
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.uncertainty.sampling import sample_materials

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.rheology.uncertainty.material_samples import MaterialSamples
    from viscofric.study.record import Record
    from viscofric.study.rubber import Rubber


class BandColumns(NamedTuple):
    """What the rubber's uncertainty leaves on friction, a column entry for each record; NaN where that is not known."""

    material_error: Any
    viscoelastic_lower: Any
    viscoelastic_upper: Any


def draw_rubber(rubber: Rubber, samples: int, seed: int = 0) -> MaterialSamples | None:
    """Draw a rubber as other sweeps of it might have given it; None where there are no sweeps to tell, or no wish.

    Parameters
    ----------
    rubber : Rubber
    samples : int
        How many; 0 for none.
    seed : int
        Of the random numbers.

    Raises
    ------
    InputError
        If its spectrum was not fitted to its sweeps, or there are too few samples.
    """
    spectrum = rubber.material.spectrum
    if samples == 0 or rubber.fit is None or not isinstance(spectrum, RetardationSpectrum):
        return None
    law = None if rubber.shift_used == "measured" else rubber.shift_used
    ratio, name = rubber.material.poisson_ratio, rubber.material.name
    return sample_materials(rubber.fit, spectrum, samples=samples, seed=seed, law=law, poisson_ratio=ratio, name=name)


def curves_of(records: Sequence[Record]) -> FrictionCurves:
    """Return the friction of solved cases, in their order."""
    return FrictionCurves(
        speed=np.array([record.speed for record in records]),
        temperature=np.array([record.temperature for record in records]),
        load=np.array([record.load for record in records]),
        viscoelastic=np.array([record.friction_coefficient for record in records]),
        viscoelastic_error=np.array([record.friction_error for record in records]),
        viscoelastic_scatter=np.zeros(len(records)),
        replicates=np.ones(len(records), dtype=np.int64),
        source="prediction",
    )


class FrictionBands:
    """Turns solved cases into friction curves, with bands where the rubber can be drawn.

    Parameters
    ----------
    rubber : Rubber
    count : int
        Samples of the rubber; 0 for no bands.
    seed : int
        Of their random numbers.

    Attributes
    ----------
    samples : MaterialSamples or None
    notes : tuple of str
        What is to be said of the bands so far: one sentence each.
    """

    def __init__(self, rubber: Rubber, count: int, seed: int = 0) -> None:
        self.notes: tuple[str, ...] = ()
        self.samples: MaterialSamples | None = None
        try:
            self.samples = draw_rubber(rubber, count, seed)
        except InputError as error:
            self._note(error.note.at("Friction has no 95 % bands").coded("no-bands"))
        self._drawn = None if self.samples is None else DrawnMaterials(self.samples, rubber.material)
        if self.samples is not None:
            self.notes = tuple(self.samples.notes)
        elif count and rubber.fit is None:
            text = "Friction has no 95 % bands: only the sweeps that a rubber is made of tell how well it is known."
            self._note(Note("no-bands", text))

    def curves(self, records: Sequence[Record]) -> FrictionCurves:
        """Return the friction of solved cases, in their order; without bands if any of them has no sensitivity."""
        found = curves_of(records)
        sensitivities = [record.sensitivity for record in records if record.sensitivity is not None]
        if self._drawn is None or not records:
            return found
        if len(sensitivities) < len(records):
            self._note(
                Note(
                    "no-bands",
                    f"At {len(records) - len(sensitivities)} of {len(records)} cases it could not be found how "
                    "friction answers to the rubber, so that these friction curves have no bands.",
                )
            )
            return found
        banded = with_material_band(found, sensitivities, self._drawn)
        for note in banded.notes:
            self._note(note)
        return banded

    def _note(self, note: str) -> None:
        self.notes = tuple(dict.fromkeys((*self.notes, note)))
