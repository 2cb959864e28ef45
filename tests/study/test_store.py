"""Finished cases on disk: whole or not there, and found again by what they depend on."""

from __future__ import annotations

import os
import stat
from dataclasses import replace
from pathlib import Path

import pytest

from refusals import refused
from study import sweeps
from viscofric.errors import DataFileError, InputError
from viscofric.files import write_atomically
from viscofric.friction.cases.record import Failure
from viscofric.friction.cases.solving import _sources, key_of
from viscofric.notes import Note, Remedy
from viscofric.study.running.store import CaseStore, Damaged

# Friction is no short decimal: it must come back to the last bit.
RECORD = replace(
    sweeps.RECORD,
    numbers={**sweeps.RECORD.numbers, "friction_coefficient": 0.1 + 0.2},
    warnings=(Note("large-strain", "A sentence.", values={"slope": 0.1 + 0.2}),),
)


def test_a_stored_case_comes_back_to_the_last_bit(tmp_path: Path) -> None:
    store = CaseStore(tmp_path / "cases")
    assert store.get("a") is None
    store.put("a", RECORD)
    assert store.get("a") == RECORD
    (warning,) = store.get("a").warnings
    assert (warning.code, warning.values) == ("large-strain", {"slope": 0.1 + 0.2})


@pytest.mark.parametrize("kept", [0, 1, 20, 200])
def test_a_half_written_case_counts_as_not_solved(tmp_path: Path, kept: int) -> None:
    store = CaseStore(tmp_path)
    store.put("a", RECORD)
    path = tmp_path / "a.json"
    path.write_bytes(path.read_bytes()[:kept])
    assert isinstance(store.get("a"), Damaged)
    store.put("a", replace(RECORD, numbers={**RECORD.numbers, "cells": 512}))
    assert store.get("a") == replace(RECORD, numbers={**RECORD.numbers, "cells": 512})


def test_no_changed_digit_becomes_a_result(tmp_path: Path) -> None:
    store = CaseStore(tmp_path)
    store.put("a", RECORD)
    path = tmp_path / "a.json"
    whole = path.read_text(encoding="utf-8")
    numbers = [place for place, letter in enumerate(whole) if letter.isdigit()]
    assert len(numbers) > 45
    for place in numbers:
        path.write_text(whole[:place] + str((int(whole[place]) + 1) % 10) + whole[place + 1 :], encoding="utf-8")
        assert isinstance(store.get("a"), Damaged), place
    friction = f'"friction_coefficient": {RECORD.friction_coefficient!r}'
    assert friction in whole
    path.write_text(
        whole.replace(friction, f'"friction_coefficient": {3.0 * RECORD.friction_coefficient!r}'), encoding="utf-8"
    )
    assert set(store.damaged()) == {"a"}
    path.write_text(whole, encoding="utf-8")
    assert store.damaged() == {}


def test_the_reason_of_a_failure_is_kept_in_the_words_of_each_reader(tmp_path: Path) -> None:
    problem = InputError("it is not periodic; use ", code="not-periodic", remedy=Remedy("window().", page="“Window”."))
    store = CaseStore(tmp_path)
    store.put("a", Failure.of(problem, "30 °C"))
    stored = store.get("a")
    assert isinstance(stored, Failure)
    assert (stored.note.code, stored.note.where, stored.note.remedy) == ("not-periodic", "30 °C", problem.remedy)


def test_a_case_under_the_key_of_another_is_not_taken(tmp_path: Path) -> None:
    store = CaseStore(tmp_path)
    store.put("a", RECORD)
    store.put("b", Failure("it does not converge.", "30 °C"))
    assert store.get("b") == Failure("it does not converge.", "30 °C")
    (tmp_path / "a.json").rename(tmp_path / "c.json")
    assert isinstance(store.get("c"), Damaged)
    assert store.get("a") is None


def test_a_case_without_a_checksum_is_not_taken(tmp_path: Path) -> None:
    store = CaseStore(tmp_path)
    store.put("cut", RECORD)
    (tmp_path / "cut.json").write_bytes((tmp_path / "cut.json").read_bytes().partition(b', "sha256"')[0] + b"}")
    assert isinstance(store.get("cut"), Damaged)
    assert set(store.damaged()) == {"cut"}


def test_key_changes_with_every_input() -> None:
    description: dict[str, object] = {"speed": 0.1, "load": 25.0, "C": [1.0, 2.0]}
    keys = {key_of(description), *(key_of({**description, name: 7.0}) for name in description)}
    assert len(keys) == 4


def test_every_file_of_the_solver_counts_however_deep_it_lies(tmp_path: Path) -> None:
    (tmp_path / "one" / "two").mkdir(parents=True)
    for place in ("a.py", "one/b.py", "one/two/c.py", "one/notes.txt"):
        (tmp_path / place).write_text(place, encoding="utf-8")
    found = dict(_sources(tmp_path))
    assert found == {"/a.py": b"a.py", "/one/b.py": b"one/b.py", "/one/two/c.py": b"one/two/c.py"}


def test_unwritable_folder_is_reported_in_a_sentence(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    with refused("not-written", DataFileError):
        write_atomically(tmp_path / "file" / "a.json", b"{}")


def test_nothing_is_left_behind_by_a_failed_write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full_disk(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("viscofric.files.os.fsync", full_disk)
    with refused("not-written", DataFileError):
        write_atomically(tmp_path / "a.json", b"{}")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such call for folders")
def test_a_written_file_is_on_the_disk_with_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    order: list[str] = []
    sync, replace_ = os.fsync, Path.replace

    def synced(handle: int) -> None:
        order.append("folder" if stat.S_ISDIR(os.fstat(handle).st_mode) else "file")
        sync(handle)

    def replaced(path: Path, target: Path) -> Path:
        order.append("name")
        return replace_(path, target)

    monkeypatch.setattr("viscofric.files.os.fsync", synced)
    monkeypatch.setattr(Path, "replace", replaced)
    write_atomically(tmp_path / "a.txt", b"a")
    assert order == ["file", "name", "folder"]
