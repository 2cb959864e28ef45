"""Notes are sentences with a code."""

import copy
import pickle

from viscofric.notes import Note, codes


def test_a_note_is_its_sentence_and_keeps_its_code_in_copies_and_pickles():
    note = Note("few-replicates", "Two replicates only.")
    assert note == "Two replicates only."
    for again in (copy.copy(note), copy.deepcopy(note), pickle.loads(pickle.dumps(note))):
        assert (again, again.code) == (note, "few-replicates")


def test_codes_pass_over_sentences_without_one():
    assert codes(["a plain sentence", Note("drift", "It drifts.")]) == {"drift"}
