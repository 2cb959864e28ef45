"""A study's measurement: separated, compared with the prediction, and its own shift factors."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.shapes import Ball
from viscofric.datasets import Dataset
from viscofric.errors import InputError, SuperpositionError
from viscofric.friction.agreement import compare
from viscofric.friction.cases.record import Record
from viscofric.friction.curve_files import read_friction_curves
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.measurement.tribometry import separate
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.friction.shifting.shift import common_reference, shift_friction
from viscofric.friction.shifting.shift_agreement import compare_shift_factors
from viscofric.notes import Note, note_of
from viscofric.readers.mtm.read import read_mtm
from viscofric.rheology.material import Material
from viscofric.study.results.tree import as_measured, measurement_data
from viscofric.study.run_file.measurement import MeasurementTable
from viscofric.study.study_rubber import FrictionBands
from viscofric.traction import TractionRuns

Groups = dict[str, Dataset]


def read_measurement(table: MeasurementTable) -> FrictionCurves:
    """Return the friction curves of [measurement]: those of a table, or separated from tribometer runs."""
    if table.curves is not None:
        return read_friction_curves(table.curves, columns=table.columns, sheet=table.sheet)
    return separated(read_mtm(*table.mtm, columns=table.columns, sheet=table.sheet), table)


def separated(runs: TractionRuns, table: MeasurementTable) -> FrictionCurves:
    """Return the friction curves of tribometer runs, separated as [measurement] says."""
    if table.except_steps:
        runs = runs.select(except_steps=table.except_steps)
    return separate(runs, **table.settings)


class Measurement:
    """Measured friction and the modulus of a material; `load` of the friction master curve, N."""

    def __init__(self, curves: FrictionCurves, material: Material, ball: Ball, load: float) -> None:
        self.curves, self.material = curves, material
        alone = curves.assumption and curves.assumption not in curves.notes
        assumed = [Note("coulomb-assumed", curves.assumption)] if alone else []
        self.notes = [*assumed, *map(note_of, curves.notes)]
        self._rule: dict[str, Any] = {"indenter": ball, "load": load, "vertical_shift": material.vertical_shift}
        self._master = shift_friction(curves, shift=material.shift, **self._rule)
        self.notes += map(note_of, [*self._master.notes, self._master.overlap.sentence])
        self._found = self._shifted_by_itself()

    @property
    def reduced_speed(self) -> Array:
        """Reduced speeds at the load of the master curve, ascending, m/s."""
        return self._master.reduced_speed

    def _shifted_by_itself(self) -> FrictionMasterCurve | None:
        """Find α(T) from friction alone, about the modulus's reference if friction covers it."""
        about = common_reference(self.curves, self.material.shift)
        try:
            return shift_friction(self.curves, reference=about, **self._rule)
        except (SuperpositionError, InputError) as error:
            self.notes.append(error.note.at("Friction alone gives no shift factors").coded("no-shift-factors"))
            return None

    def groups(
        self,
        at_points: list[Record | None],
        within: list[bool] | None,
        at_reference: FrictionCurves,
        bands: FrictionBands,
    ) -> Groups:
        """Compare with the prediction, and the shift factors of friction with those of the modulus.

        `at_points` are the records at each measured point (None: failed), `within` whether their frequencies were
        measured, and `at_reference` is the prediction along the master curve.
        """
        predicted = bands.curves([record for record in at_points if record is not None])
        alpha = np.asarray(self._master.shift(self.curves.temperature))
        solved = np.array([record is not None for record in at_points], dtype=bool)
        return {
            "/measurement": measurement_data(self.curves, self.curves.speed * alpha, solved, within, predicted),
            "/measurement_master": as_measured(self._master.to_dataset()),
            **self._agreement(at_points, predicted, at_reference),
            **self._shift_factors(),
        }

    def _agreement(
        self, at_points: list[Record | None], predicted: FrictionCurves, at_reference: FrictionCurves
    ) -> Groups:
        """Compare where there are a prediction, and a measured friction above zero as the reference."""
        solved = np.array([record is not None for record in at_points])
        comparable = solved & (self.curves.viscoelastic > 0.0)
        if not comparable.any():
            return {}
        measured = self.curves.select(comparable)
        found = compare(measured, predicted.select(comparable[solved]))
        sentences = [str(found)]
        try:
            shift = self.material.shift
            line = shift_friction(at_reference, shift=shift, **self._rule)
            sentences.append(str(compare(shift_friction(measured, shift=shift, **self._rule), line)))
        except InputError as error:
            where = "The master curves of prediction and measurement were not compared"
            self.notes.append(error.note.at(where).coded("not-compared"))
        words = json.dumps(sentences, ensure_ascii=False)
        return {
            "/agreement": found.to_dataset().assign_attrs(sentences=words, left_out=int(np.count_nonzero(~comparable)))
        }

    def _shift_factors(self) -> Groups:
        if self._found is None or self.material.shift is None or not self.material.has_shift_factors:
            return {}
        try:
            agreement = compare_shift_factors(self._found, self.material.shift)
        except InputError as error:
            where = "Shift factors from friction were not compared with the modulus's"
            self.notes.append(error.note.at(where).coded("not-compared"))
            return {}
        self.notes += [note for note in map(note_of, self._found.notes) if note not in self.notes]
        return {"/friction_shift_factors": agreement.to_dataset()}
