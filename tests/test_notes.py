"""Notes and errors are sentences with a code, a place, and a remedy in the words of each reader."""

import copy
import json
import pickle
from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest

import viscofric as vf
from viscofric.errors import DataFileError, InputError, StudyError, SuperpositionError
from viscofric.notes import Note, Remedy, codes, counted, note_of, records

EXAMPLE = files("viscofric") / "templates" / "paper"
GIVE = Remedy("; give unit=.", "; give --unit.", page="; fill in “Unit”.", field="material.unit")


def test_a_note_is_its_sentence_and_keeps_its_code_in_copies_and_pickles():
    note = Note("few-replicates", "Two replicates only.")
    assert note == "Two replicates only."
    for again in (copy.copy(note), copy.deepcopy(note), pickle.loads(pickle.dumps(note))):
        assert (again, again.code) == (note, "few-replicates")


def test_codes_pass_over_sentences_without_one():
    assert codes(["a plain sentence", Note("drift", "It drifts.")]) == {"drift"}


def test_each_reader_gets_the_remedy_in_his_own_words():
    note = Note("no-unit", "It has no unit", "a.csv", GIVE)
    assert note == "a.csv: It has no unit; give unit=."
    words = {reader: note.words(reader).rpartition("; ")[2] for reader in ("python", "shell", "run_file", "page")}
    assert words == {
        "python": "give unit=.",
        "shell": "give --unit.",
        "run_file": "give --unit.",
        "page": "fill in “Unit”.",
    }


def test_remedies_are_joined_for_each_reader_and_keep_their_field():
    both = "; measure it, or say it" + GIVE + " It is worth it."
    assert both.python == "; measure it, or say it; give unit=. It is worth it."
    assert both.words("page") == "; measure it, or say it; fill in “Unit”. It is worth it."
    assert both.field == "material.unit"


def test_a_note_comes_back_from_json_whole():
    notes = [Note("no-unit", "It has no unit", "a.csv", GIVE), Note("drift", "It drifts."), "A sentence alone."]
    again = list(map(note_of, json.loads(json.dumps(records(notes)))))
    assert again == [str(note) for note in notes]
    assert [(one.code, one.where, one.remedy) for one in again] == [
        ("no-unit", "a.csv", GIVE),
        ("drift", "", None),
        ("", "", None),
    ]


@pytest.mark.parametrize(
    "error",
    [
        DataFileError("a.csv", "has no unit", 3, code="no-unit", remedy=GIVE),
        SuperpositionError("has no unit", code="no-unit", remedy=GIVE),
        InputError(Note("no-unit", "has no unit", "a.csv", GIVE)),
    ],
)
def test_an_error_keeps_code_remedy_and_field_in_copies_and_pickles(error):
    for again in (error, copy.copy(error), pickle.loads(pickle.dumps(error))):
        assert type(again) is type(error)
        assert (str(again), again.code, again.remedy, again.field) == (str(error), "no-unit", GIVE, "material.unit")
        assert again.words("page").endswith("has no unit; fill in “Unit”.")
        assert str(again.at("rubber 2")).startswith("rubber 2: ")
    named = error.reworded(lambda text: text.replace("has no", "lacks a"))
    assert (named.code, named.remedy) == ("no-unit", GIVE)
    assert "lacks a unit; give unit=." in str(named)


def test_the_field_of_an_error_is_that_of_its_first_problem_where_nothing_else_names_one():
    wrong = [Note("missing", "Is missing.", "conditions.load"), Note("missing", "Is missing.", "material")]
    assert StudyError("Two things are wrong.", wrong).field == "conditions.load"
    assert InputError("Wrong.", field="material").field == "material"
    assert InputError("Wrong.").field is None


def test_every_note_of_sweeps_master_curve_and_spectrum_has_a_code():
    sweeps = vf.read_dma(EXAMPLE / "dma.csv")
    sweeps = replace(sweeps, isotherms=sweeps.isotherms[2:8])
    fit = vf.superpose(sweeps, "30 degC")
    spectrum = vf.fit_retardation_spectrum(fit.master_curve)
    notes = [*sweeps.notes, *fit.notes, *spectrum.fit.notes]
    assert notes
    assert [note for note in notes if not note_of(note).code] == []


def test_every_note_of_traction_runs_and_friction_curves_has_a_code():
    """Runs in which each replicate lacks sign configurations, and one reading stands far from the others."""
    runs = vf.read_mtm(EXAMPLE / "mtm.csv")
    force = runs.traction_force.copy()
    force[5] *= 1.5
    few = replace(runs, traction_force=force).select(np.arange(len(runs)) % 7 != 3)
    curves = vf.separate(few)
    assert {"readings-selected", "incomplete-replicates"} <= codes(curves.notes)
    assert [note for note in curves.notes if not note_of(note).code] == []


def test_the_note_that_is_shown_of_many_is_the_most_severe() -> None:
    each = [
        [],
        *([Note("adhesion", f"{share} times the load", values={"severity": share})] for share in (0.2, 0.9, 0.4)),
    ]
    (note,) = counted(each, rank=[0.0, 1.0, 2.0, 3.0])
    assert (note.values["severity"], note.values["contacts"], note.values["of"]) == (0.9, 3, 4)


def test_the_widest_of_several_impacts_is_shown() -> None:
    elastic = vf.Material.standard_linear_solid("1 MPa", "2 MPa", "1 ms")
    hits = vf.motion.restitution_curve(elastic, vf.Ball("1 mm"), mass="1 mg", speeds=[1.0, 3.0], accuracy=1e-2)
    fast = vf.motion.solve_impact(elastic, vf.Ball("1 mm"), mass="1 mg", speed=3.0, accuracy=1e-2)
    (of_all,), (of_fast,) = (
        [note.values["radii"] for note in map(note_of, found.notes) if note.code == "large-strain"]
        for found in (hits, fast)
    )
    assert of_all == pytest.approx(of_fast)


def test_warnings_of_contacts_are_their_notes() -> None:
    elastic, ball = vf.Material.standard_linear_solid("1 MPa", "2 MPa", "1 ms"), vf.Ball("10 mm")
    contact = vf.solve_steady(elastic, ball, speed=0.0, load="0.1 mN", accuracy=0.1)
    impact = vf.motion.solve_impact(elastic, ball, mass="1 ug", speed="1 mm/s", accuracy=1e-2)
    assert codes(contact.notes) == codes(contact.warnings) == {"adhesion"}
    assert impact.notes == impact.warnings != ()
