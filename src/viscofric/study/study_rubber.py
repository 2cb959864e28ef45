"""A rubber of a study, ready to be solved with: its shift, what is known of its frequencies, its bands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import StudyError
from viscofric.notes import Note, note_of
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.uncertainty.sampling import FEWEST_SAMPLES
from viscofric.study.bands import BandColumns, FrictionBands, draw_rubber
from viscofric.study.checking import shift_of
from viscofric.study.rubber import Rubber, make_rubber
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.study.cases.case import Case
    from viscofric.study.material_table import MaterialTable
    from viscofric.study.record import Record
    from viscofric.study.settings_tables import UncertaintyTable


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
