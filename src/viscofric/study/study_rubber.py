"""A material of a study: its shift, its measured frequencies, and the uncertainty bands of friction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from viscofric.errors import InputError, StudyError
from viscofric.friction.bands import DrawnMaterials, with_material_band
from viscofric.friction.cases.case import Case
from viscofric.friction.cases.record import Record, columns_of_records
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note, note_of
from viscofric.rheology.material import EXTRAPOLATED, Material, unknown_frequencies
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.spectra.quality import KnownFrequencies, SpectrumFit
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.rheology.uncertainty.sampling import FEWEST_SAMPLES, sample_materials
from viscofric.study.make_rubber import make_rubber
from viscofric.study.rubber import Rubber, rubber_at
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.settings import UncertaintyTable


@dataclass(frozen=True, eq=False)
class StudyRubber:
    """A material of a study with its bands and its bootstrap samples (`members`)."""

    rubber: Rubber
    bands: FrictionBands
    members: tuple[Material, ...]

    @classmethod
    def of(cls, table: MaterialTable, uncertainty: UncertaintyTable, temperatures: Sequence[float]) -> StudyRubber:
        """Make a material for contacts at some temperatures; raise if it, or one of these, cannot be used for them."""
        # Raises for temperatures without a shift factor, before any case is solved.
        rubber = rubber_at(make_rubber(table), temperatures)
        bands = FrictionBands(rubber, uncertainty.draws, uncertainty.seed)
        return cls(rubber, bands, _members(rubber, bands, uncertainty))

    @property
    def material(self) -> Material:
        """The best estimate."""
        return self.rubber.material

    @property
    def shift(self) -> ShiftLaw:
        """α(T)."""
        assert self.material.shift is not None
        return self.material.shift

    @property
    def spectrum_fit(self) -> SpectrumFit | None:
        """Fit of the spectrum with the measured range of frequencies; None if unknown."""
        return getattr(self.material.spectrum, "fit", None)

    @property
    def known_frequencies(self) -> KnownFrequencies | None:
        """Frequencies at which the spectrum is known, be it of its modes alone; None of a table or a single mode."""
        return self.material.spectrum.known_frequencies

    def is_within(self, case: Case, record: Record) -> bool | None:
        """Whether a contact's frequencies (v/a, or 2πv/λ), reduced by α(T), were measured; None if not known."""
        if self.known_frequencies is None:
            return None
        rate = float(self.shift(record.temperature)) * record.speed
        inside = bool(self.known_frequencies.covers(rate / np.array(case.lengths(record))).all())
        return None if inside and self.spectrum_fit is None else inside

    @property
    def notes(self) -> list[Note]:
        """Notes on the material and its bands, and on what is unknown of its measurement."""
        said = (*self.rubber.notes, *self.bands.notes, *unknown_frequencies(self.material))
        return list(map(note_of, said))

    def doubts(self, temperatures: Sequence[float]) -> list[Note]:
        """Return notes about extrapolation, and about curves that do not lie on the master curve."""
        fit = self.spectrum_fit
        # The warnings of a predefined material are reported nowhere else.
        said = list(map(note_of, fit.notes)) if self.rubber.fit is None and fit is not None else []
        # Doubts about the measurement are checks of the results, or among the warnings above.
        said += [note for note in self.material.notes_at(temperatures) if note.code == EXTRAPOLATED]
        if self.material.vertical_shift is not None:
            said.append(
                Note(
                    "curves-of-one-load",
                    "The modulus has a vertical shift b(T), so that curves of other temperatures fall on the friction "
                    "master curve only at the load F/b; measured points are brought to it by the similarity of "
                    "contacts.",
                )
            )
        return said


def all_within(
    rubbers: Sequence[StudyRubber], cases: Sequence[Case], records: Sequence[Record | None]
) -> list[bool] | None:
    """Return for each case whether it was solved and its frequencies were measured; None if that is not known.

    Of a material whose measurement is unknown, contacts count as measured where others lie beyond all modes.
    """
    if any(rubber.known_frequencies is None for rubber in rubbers):
        return None
    pairs = zip(cases, records, strict=True)
    found = [None if one is None else rubbers[case.material].is_within(case, one) is not False for case, one in pairs]
    if False not in found and any(rubber.spectrum_fit is None for rubber in rubbers):
        return None
    return list(map(bool, found))


def band_columns(rubbers: Sequence[StudyRubber], cases: Sequence[Case], records: Sequence[Any]) -> BandColumns | None:
    """Return the bands of solved cases; None if no material has any.  Bootstrap samples have none."""
    if all(rubber.bands.samples is None for rubber in rubbers):
        return None
    columns = np.full((len(BandColumns._fields), len(records)), np.nan)
    for number, rubber in enumerate(rubbers):
        rows = [row for row, case in enumerate(cases) if case.material == number and case.sample is None]
        curves = rubber.bands.curves([records[row] for row in rows])
        for column, name in zip(columns, BandColumns._fields, strict=True):
            values = getattr(curves, name)
            if values is not None:
                column[rows] = values
    return BandColumns(*columns) if np.isfinite(columns).any() else None


def _members(rubber: Rubber, bands: FrictionBands, uncertainty: UncertaintyTable) -> tuple[Material, ...]:
    """Return the requested number of bootstrap samples of a material."""
    count = uncertainty.members
    if count == 0:
        return ()
    samples = bands.samples
    if samples is None or len(samples) < count:
        samples = draw_rubber(rubber, max(count, FEWEST_SAMPLES), uncertainty.seed)
    if samples is None:
        raise StudyError(
            f"uncertainty.members = {count}: {rubber.material.name or 'the rubber'} has no bootstrap samples, which "
            "need its sweeps; leave members out, or give its sweeps.",
            code="no-samples",
            field="uncertainty.members",
        )
    return samples.materials[:count]


class BandColumns(NamedTuple):
    """Uncertainty of friction due to the material, an entry for each record; NaN if unknown."""

    material_error: Any
    viscoelastic_lower: Any
    viscoelastic_upper: Any


def draw_rubber(rubber: Rubber, samples: int, seed: int = 0) -> MaterialSamples | None:
    """Return bootstrap samples of a material; None without sweeps, scaled to a strain, or for 0 samples."""
    spectrum = rubber.material.spectrum
    fit = None if rubber.strain is not None else rubber.superposed
    if samples == 0 or fit is None or not isinstance(spectrum, RetardationSpectrum):
        return None
    law = None if rubber.shift_used == "measured" else rubber.shift_used
    ratio, name = rubber.material.poisson_ratio, rubber.material.name
    return sample_materials(fit, spectrum, samples=samples, seed=seed, law=law, poisson_ratio=ratio, name=name)


def no_samples(rubber: Rubber, begun: str) -> tuple[Note, ...]:
    """Return the note that a material has no bootstrap samples, and why; `begun` begins its sentence."""
    if rubber.strain is not None:
        why = "the uncertainty of a material scaled to a strain is not known."
    elif rubber.superposed is None:
        why = "the uncertainty of the material is known from tests at several temperatures only."
    else:
        return ()
    return (Note("no-bands", f"{begun} no 95 % bands: {why}"),)


def curves_of(records: Sequence[Record], load_unit: str = "N") -> FrictionCurves:
    """Return the friction of solved cases of indenters, in their order, without the notes on their contacts."""
    return FrictionCurves(**columns_of_records(records, load_unit) | {"notes": ()}, source="prediction")


class FrictionBands:
    """Converts solved cases to friction curves, with bands from `count` bootstrap samples of the material, if any."""

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
        elif count:
            for note in no_samples(rubber, "Friction has"):
                self._note(note)

    def curves(self, records: Sequence[Record]) -> FrictionCurves:
        """Return the friction of solved cases, in their order; without bands if any has no derivatives."""
        found = curves_of(records)
        sensitivities = [record.sensitivity for record in records if record.sensitivity is not None]
        if self._drawn is None or not records:
            return found
        if len(sensitivities) < len(records):
            self._note(
                Note(
                    "no-bands",
                    f"At {len(records) - len(sensitivities)} of {len(records)} cases the derivatives of "
                    "friction by the material were not found, so that these friction curves have no bands.",
                    values={"cases": len(records) - len(sensitivities), "of": len(records)},
                )
            )
            return found
        banded = with_material_band(found, sensitivities, self._drawn)
        for note in banded.notes:
            self._note(note)
        return banded

    def _note(self, note: str) -> None:
        self.notes = tuple(dict.fromkeys((*self.notes, note)))
