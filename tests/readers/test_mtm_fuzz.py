"""Damaged traction files: a clear error or readings that look right, in bounded time, never anything else."""

from __future__ import annotations

import os
import random

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from readers.samples.pcs import TRACTION_SAMPLES
from readers.samples.pcs_binary import BINARY_SAMPLES
from viscofric import read_mtm
from viscofric.errors import LONGEST_SENTENCE, DataFileError

#: Processor time of one damaged file of a few kilobytes, s; whole ones take some milliseconds.
LONGEST = 1.0

damage = settings(
    max_examples=10,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
every_sample = pytest.mark.parametrize("name", sorted(TRACTION_SAMPLES))
every_file = pytest.mark.parametrize("name", sorted({**TRACTION_SAMPLES, **BINARY_SAMPLES}))


@pytest.fixture(scope="module")
def sample_bytes(tmp_path_factory):
    """Name of a sample -> content of its file."""
    folder = tmp_path_factory.mktemp("samples")
    return {name: write(folder).read_bytes() for name, write in {**TRACTION_SAMPLES, **BINARY_SAMPLES}.items()}


@pytest.fixture(scope="module", autouse=True)
def warm():
    """Import what readers import at need, so that the first file does not count it."""
    from viscofric.units import registry

    registry()


def read_or_refuse(tmp_path, data):
    """Read what a damaged file holds, and insist on readings that look right or one clear sentence."""
    path = tmp_path / "damaged.txt"
    path.write_bytes(data)
    before = os.times()
    runs, refusal = None, ""
    try:
        runs = read_mtm(path)
    except DataFileError as error:
        refusal = str(error)
    after = os.times()
    assert sum(after[:4]) - sum(before[:4]) < LONGEST
    if runs is None:
        assert str(path) in refusal
        assert "\n" not in refusal
        assert len(refusal) <= LONGEST_SENTENCE
        return
    assert len(runs) >= 1
    for column in (runs.disc_speed, runs.ball_speed, runs.traction_force, runs.load, runs.temperature):
        assert np.all(np.isfinite(column))
    assert np.all(runs.load > 0.0)
    assert np.all(runs.temperature > 0.0)
    assert np.all(runs.replicate >= 1) or name_of(data) == "delimited"
    assert sum(step.readings for step in runs.steps) in (0, len(runs))
    assert all("\n" not in note for note in runs.notes)


def name_of(data):
    return "delimited" if b"started at" not in data else "export"


@every_file
@damage
@given(share=st.floats(0.0, 1.0))
def test_a_file_torn_off_anywhere(tmp_path, sample_bytes, name, share):
    data = sample_bytes[name]
    read_or_refuse(tmp_path, data[: int(share * len(data))])


@every_file
@damage
@given(seed=st.integers(0, 10**6), count=st.integers(1, 30))
def test_flipped_bytes(tmp_path, sample_bytes, name, seed, count):
    rng, damaged = random.Random(seed), bytearray(sample_bytes[name])
    for _ in range(count):
        damaged[rng.randrange(len(damaged))] = rng.randrange(256)
    read_or_refuse(tmp_path, bytes(damaged))


@every_sample
@damage
@given(seed=st.integers(0, 10**6), count=st.integers(1, 8))
@pytest.mark.slow
def test_printable_characters_changed(tmp_path, sample_bytes, name, seed, count):
    rng, damaged = random.Random(seed), bytearray(sample_bytes[name])
    for _ in range(count):
        damaged[rng.randrange(len(damaged))] = rng.choice(b"0123456789-+.,eE_ \tNnaif\n")
    read_or_refuse(tmp_path, bytes(damaged))


@every_sample
@damage
@given(seed=st.integers(0, 10**6), kind=st.sampled_from(["shuffled", "doubled", "left out", "reversed"]))
def test_lines_out_of_order(tmp_path, sample_bytes, name, seed, kind):
    rng, lines = random.Random(seed), sample_bytes[name].splitlines(keepends=True)
    if kind == "shuffled":
        rng.shuffle(lines)
    elif kind == "doubled":
        lines += rng.choices(lines, k=len(lines) // 2)
    elif kind == "left out":
        lines = [line for line in lines if rng.random() < 0.7]
    else:
        lines.reverse()
    read_or_refuse(tmp_path, b"".join(lines))


@every_sample
@damage
@given(seed=st.integers(0, 10**6), kind=st.sampled_from(["swapped", "column left out", "emptied", "column moved"]))
def test_cells_out_of_place(tmp_path, sample_bytes, name, seed, kind):
    rng = random.Random(seed)
    mark = b"," if name == "delimited" else b"\t"
    rows = [line.split(mark) for line in sample_bytes[name].splitlines()]
    wide = [row for row in rows if len(row) > 5]
    place, other = rng.randrange(len(wide[0])), rng.randrange(len(wide[0]))
    for row in wide if kind.startswith("column") else rng.choices(wide, k=2):
        here, there = place % len(row), other % len(row)
        if kind == "swapped":
            row[here], row[there] = row[there], row[here]
        elif kind == "emptied":
            row[here] = b""
        elif kind == "column moved":
            row.insert(there, row.pop(here))
        else:
            del row[here]
    read_or_refuse(tmp_path, b"\r\n".join(mark.join(row) for row in rows) + b"\r\n")


@every_sample
@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-32", "cp437", "utf-7", "cp037"])
def test_another_encoding(tmp_path, sample_bytes, name, encoding):
    text = sample_bytes[name].decode("utf-8-sig")
    read_or_refuse(tmp_path, text.encode(encoding, errors="replace"))


@damage
@given(junk=st.binary(max_size=3000))
def test_junk_after_the_beginning_of_a_step(tmp_path, junk):
    read_or_refuse(tmp_path, b"Step 1 started at 23/03/2018 10:00:00\n" + junk)
