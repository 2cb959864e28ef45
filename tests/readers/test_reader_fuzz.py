"""Damaged files of every format: a clear error or data that look right, in bounded time, never anything else."""

from __future__ import annotations

import os
import random

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from marks import slow
from readers.samples import SAMPLES
from readers.samples.pcs import TRACTION_SAMPLES
from readers.samples.pcs_binary import BINARY_SAMPLES
from readers.samples.workbook import write as write_workbook
from viscofric import read_dma, read_mtm
from viscofric.errors import LONGEST_SENTENCE, DataFileError
from viscofric.readers.dma.read import FORMATS

#: Processor time of one damaged file of a few kilobytes, s; whole ones take some milliseconds, a workbook 40 ms
#: in a process of its own.  The time of the processor does not count what else the machine is doing.
LONGEST = 1.0

damage = settings(
    max_examples=10,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
TRACTION = {f"traction {name}": write for name, write in TRACTION_SAMPLES.items()}
EVERY = {**SAMPLES, **TRACTION, **{f"traction {name}": write for name, write in BINARY_SAMPLES.items()}}
every_sample = pytest.mark.parametrize("name", sorted(SAMPLES))
every_traction_table = pytest.mark.parametrize("name", sorted(TRACTION))
#: A workbook takes 40 ms, a hundred damaged ones four seconds.
_WORKBOOKS = [name for name in sorted(SAMPLES) if name.startswith(("eplexor", "workbook"))]
every_damaged_sample = pytest.mark.parametrize("name", [*sorted(set(EVERY) - set(_WORKBOOKS)), *slow(*_WORKBOOKS)])


@pytest.fixture(scope="module")
def sample_bytes(tmp_path_factory):
    """Name of a sample -> ending and content of its file."""
    folder = tmp_path_factory.mktemp("samples")
    written = {name: write(folder) for name, write in EVERY.items()}
    return {name: (path.suffix, path.read_bytes()) for name, path in written.items()}


@pytest.fixture(scope="module", autouse=True)
def warm():
    """Import what readers import at need, so that the first file does not count it."""
    from viscofric.units import registry

    registry()


def read_or_refuse(tmp_path, suffix, data, name=""):
    """Read what a damaged file holds, and insist on data that look right or one clear sentence."""
    path = tmp_path / f"damaged{suffix}"
    path.write_bytes(data)
    traction = name.startswith("traction")
    before = os.times()
    found, refusal = None, ""
    try:
        found = read_mtm(path) if traction else read_dma(path)
    except DataFileError as error:
        refusal = str(error)
    after = os.times()
    assert sum(after[:4]) - sum(before[:4]) < LONGEST
    if found is None:
        assert str(path) in refusal
        assert "\n" not in refusal
        assert len(refusal) <= LONGEST_SENTENCE
        return
    assert len(found) >= 1
    assert all("\n" not in note for note in found.notes)
    (assert_runs if traction else assert_sweeps)(found, data)


def assert_sweeps(sweeps, data):
    assert np.all(np.isfinite(sweeps.temperatures) & (sweeps.temperatures > 0))
    for isotherm in sweeps.isotherms:
        assert len(isotherm) >= 1
        for column in (isotherm.angular_frequency, isotherm.storage_modulus, isotherm.loss_modulus):
            assert np.all(np.isfinite(column) & (column > 0))
    assert sweeps.format
    assert sweeps.notes


def assert_runs(runs, data):
    for column in (runs.disc_speed, runs.ball_speed, runs.traction_force, runs.load, runs.temperature):
        assert np.all(np.isfinite(column))
    assert np.all(runs.load > 0.0)
    assert np.all(runs.temperature > 0.0)
    assert np.all(runs.replicate >= 1) or b"started at" not in data
    assert sum(step.readings for step in runs.steps) in (0, len(runs))


@every_sample
def test_a_whole_file_is_read(tmp_path, name):
    sweeps = read_dma(SAMPLES[name](tmp_path))
    assert sum(map(len, sweeps.isotherms)) >= 2
    assert sweeps.format in sweeps.notes[0]


@pytest.mark.slow
def test_every_format_has_a_sample(tmp_path):
    from viscofric.readers.dma.read import format_of
    from viscofric.readers.source import Source

    seen = set()
    for write in SAMPLES.values():
        path = write(tmp_path)
        seen.add(format_of(Source(str(path), path.read_bytes())).NAME)
    assert seen == {one.NAME for one in FORMATS}


@every_damaged_sample
@damage
@given(share=st.floats(0.0, 1.0))
def test_a_file_torn_off_anywhere(tmp_path, sample_bytes, name, share):
    suffix, data = sample_bytes[name]
    read_or_refuse(tmp_path, suffix, data[: int(share * len(data))], name)


@every_damaged_sample
@damage
@given(seed=st.integers(0, 10**6), count=st.integers(1, 30))
def test_flipped_bytes(tmp_path, sample_bytes, name, seed, count):
    suffix, data = sample_bytes[name]
    rng, damaged = random.Random(seed), bytearray(data)
    for _ in range(count):
        damaged[rng.randrange(len(damaged))] = rng.randrange(256)
    read_or_refuse(tmp_path, suffix, bytes(damaged), name)


@every_damaged_sample
@damage
@given(seed=st.integers(0, 10**6), kind=st.sampled_from(["shuffled", "doubled", "left out", "reversed"]))
def test_lines_out_of_order(tmp_path, sample_bytes, name, seed, kind):
    suffix, data = sample_bytes[name]
    rng, lines = random.Random(seed), data.splitlines(keepends=True)
    if kind == "shuffled":
        rng.shuffle(lines)
    elif kind == "doubled":
        lines += rng.choices(lines, k=len(lines) // 2)
    elif kind == "left out":
        lines = [line for line in lines if rng.random() < 0.7]
    else:
        lines.reverse()
    read_or_refuse(tmp_path, suffix, b"".join(lines), name)


@every_damaged_sample
def test_another_encoding(tmp_path, sample_bytes, name):
    suffix, data = sample_bytes[name]
    text = data.decode("utf-16" if data.startswith(b"\xff\xfe") else "cp1252", errors="replace")
    for encoding in ("utf-16", "utf-16-le", "utf-16-be", "utf-32", "cp437", "utf-7", "cp037"):
        read_or_refuse(tmp_path, suffix, text.encode(encoding, errors="replace"), name)


@every_traction_table
@damage
@given(seed=st.integers(0, 10**6), count=st.integers(1, 8))
@pytest.mark.slow
def test_printable_characters_changed(tmp_path, sample_bytes, name, seed, count):
    suffix, data = sample_bytes[name]
    rng, damaged = random.Random(seed), bytearray(data)
    for _ in range(count):
        damaged[rng.randrange(len(damaged))] = rng.choice(b"0123456789-+.,eE_ \tNnaif\n")
    read_or_refuse(tmp_path, suffix, bytes(damaged), name)


@every_traction_table
@damage
@given(seed=st.integers(0, 10**6), kind=st.sampled_from(["swapped", "column left out", "emptied", "column moved"]))
def test_cells_out_of_place(tmp_path, sample_bytes, name, seed, kind):
    rng = random.Random(seed)
    mark = b"," if name == "traction delimited" else b"\t"
    suffix, data = sample_bytes[name]
    rows = [line.split(mark) for line in data.splitlines()]
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
    read_or_refuse(tmp_path, suffix, b"\r\n".join(mark.join(row) for row in rows) + b"\r\n", name)


@damage
@given(junk=st.binary(max_size=3000))
def test_junk_after_the_beginning_of_a_step(tmp_path, junk):
    read_or_refuse(tmp_path, ".txt", b"Step 1 started at 23/03/2018 10:00:00\n" + junk, "traction")


@damage
@given(
    start=st.sampled_from(
        [b"", b"PK\x03\x04", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", b"\xff\xfe", b"\xef\xbb\xbf", b"{"]
    ),
    junk=st.binary(max_size=3000),
)
def test_junk_with_the_first_bytes_of_a_format(tmp_path, start, junk):
    read_or_refuse(tmp_path, ".xlsx", start + junk)


@damage
@given(
    cells=st.lists(
        st.lists(
            st.one_of(st.sampled_from(["T (K)", "f (Hz)", "E' (Pa)", "E'' (Pa)"]), st.floats().map(str)), max_size=6
        ),
        max_size=12,
    ),
    delimiter=st.sampled_from(",;\t"),
)
def test_rows_of_headings_and_numbers_at_random(tmp_path, cells, delimiter):
    read_or_refuse(tmp_path, ".csv", "\n".join(delimiter.join(row) for row in cells).encode())


@pytest.mark.slow
@damage
@given(
    cells=st.lists(
        st.lists(
            st.one_of(
                st.sampled_from(["T (K)", "f (Hz)", "E' (Pa)", "E'' (Pa)", "1,5", "---"]),
                st.floats(allow_nan=False, allow_infinity=False),
                st.booleans(),
                st.text(st.characters(min_codepoint=32, exclude_categories=["Cs", "Cn"]), max_size=5),
            ),
            max_size=5,
        ),
        max_size=10,
    )
)
def test_sheets_of_headings_and_cells_at_random(tmp_path, cells):
    header = ["T (K)", "f (Hz)", "E' (Pa)", "E'' (Pa)"]
    path = write_workbook(tmp_path / "random.xlsx", {"A": [*cells, header, [300, 1, 2e6, 1e5], *cells]})
    read_or_refuse(tmp_path, ".xlsx", path.read_bytes())
