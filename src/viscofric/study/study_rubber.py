"""A material of a study: its shift, its measured frequencies, and the uncertainty bands of friction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from viscofric.errors import InputError, StudyError
from viscofric.friction.bands import DrawnMaterials, with_material_band
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note, note_of
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.uncertainty.sampling import FEWEST_SAMPLES, sample_materials
from viscofric.study.rubber import Rubber, make_rubber, shift_of
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples
    from viscofric.study.cases.case import Case
    from viscofric.study.cases.record import Record
    from viscofric.study.run_file.material import MaterialTable
    from viscofric.study.run_file.settings import UncertaintyTable


@dataclass(frozen=True, eq=False)
class StudyRubber:
    """A rubber of a study.

    Attributes
    ----------
    rubber : Rubber
    bands : FrictionBands
    members : tuple of Material
        Of its posterior, that cases are solved with.
    shift : ShiftLaw
    """

    rubber: Rubber
    bands: FrictionBands
    members: tuple[Material, ...]
    shift: ShiftLaw

    @classmethod
    def of(cls, table: MaterialTable, uncertainty: UncertaintyTable, temperatures: Sequence[float]) -> StudyRubber:
        """Make a rubber, and see that it can be solved with at some temperatures.

        Raises
        ------
        StudyError
            If it has no spectrum, no shift, or no sweeps to draw members from.
        InputError
            If a file cannot be used, or a temperature has no shift factor.
        """
        rubber = make_rubber(table)
        shift = shift_of(rubber)
        # Temperatures without a shift factor are told now, not case by case.
        shift(np.array(temperatures))
        bands = FrictionBands(rubber, uncertainty.draws, uncertainty.seed)
        return cls(rubber, bands, _members(rubber, bands, uncertainty), shift)

    @property
    def material(self) -> Material:
        """The best estimate."""
        return self.rubber.material

    @property
    def frequency_range(self) -> tuple[float, float] | None:
        """Reduced angular frequencies between which the spectrum was measured, rad/s; None where that is not known."""
        fit = getattr(self.material.spectrum, "fit", None)
        return None if fit is None else fit.frequency_range

    def is_within(self, case: Case, record: Record) -> bool:
        """Whether a contact's frequencies, reduced by α(T), lie within the master curve's, as far as is known.

        That of an indenter is v/a; a rough surface has 2πv/λ for the shortest and the longest of its wavelengths.
        """
        if self.frequency_range is None:
            return True
        low, high = self.frequency_range
        rate = float(self.shift(record.temperature)) * record.speed
        shortest, longest = case.lengths(record)
        return low <= rate / longest and rate / shortest <= high

    def doubts(self, temperatures: Sequence[float]) -> list[Note]:
        """Tell what of the prediction rests on more than was measured, or does not lie on one curve."""
        asked = np.array(temperatures)
        beyond = asked[np.asarray(self.shift.extrapolates(asked))]
        spectrum = self.material.spectrum
        fit = spectrum.fit if isinstance(spectrum, RetardationSpectrum) else None
        # What is wrong with a ready rubber is told by nothing else.
        said = list(map(note_of, fit.notes)) if self.rubber.fit is None and fit is not None else []
        if fit is None:
            said.append(
                Note(
                    "frequencies-unknown",
                    "At which frequencies the rubber was measured is not known, so that nothing tells where it is "
                    "extrapolated.",
                )
            )
        if beyond.size:
            at = ", ".join(f"{celsius(float(kelvin)):z.4g}" for kelvin in np.unique(beyond))
            behind = "of the friction that it was identified from" if self.rubber.from_friction else "of the sweeps"
            said.append(
                Note(
                    "extrapolated",
                    f"At {at} °C the shift factor is extrapolated beyond the temperatures {behind}, by its law.",
                )
            )
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


def all_within(rubbers: Sequence[StudyRubber], cases: Sequence[Case], records: Sequence[Record]) -> list[bool]:
    """Whether each case, solved, lies within the frequencies at which its rubber is known, as far as these are."""
    return [rubbers[case.material].is_within(case, record) for case, record in zip(cases, records, strict=True)]


def band_columns(rubbers: Sequence[StudyRubber], cases: Sequence[Case], records: Sequence[Any]) -> BandColumns | None:
    """Return the bands of solved cases; None if no rubber has any.  Those of a posterior's members have none."""
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
    """Return as many members of a rubber's posterior as are asked for."""
    count = uncertainty.members
    if count == 0:
        return ()
    samples = bands.samples
    if samples is None or len(samples) < count:
        samples = draw_rubber(rubber, max(count, FEWEST_SAMPLES), uncertainty.seed)
    if samples is None:
        raise StudyError(
            f"uncertainty.members = {count}: {rubber.material.name or 'the rubber'} cannot be drawn anew, as only the "
            "sweeps that a rubber is made of tell how well it is known; leave members out, or give its sweeps.",
            field="uncertainty.members",
        )
    return samples.materials[:count]


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
