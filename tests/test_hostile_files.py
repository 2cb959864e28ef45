"""Hostile files at every way in: one sentence of bearable length, soon, in little memory."""

from __future__ import annotations

import importlib.util
import os
import pickle
import re
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import hostile
import viscofric as vf
from refusals import refused
from study import sweeps
from viscofric import files
from viscofric.errors import LONGEST_SENTENCE, DataFileError, StudyError, not_imported, shortened
from viscofric.files import LARGEST_TABLE, insist_on_size, parse_toml
from viscofric.notes import codes, warned
from viscofric.processes import LimitedProcess
from viscofric.readers.topography import package
from viscofric.rheology.cards.card_files import LARGEST_CARD
from viscofric.study.running.store import CaseStore, Damaged, _sealed

#: Processor time of one small file, s: each takes a few hundredths; unguarded they took half a minute and more.
LONGEST = 2.0


def refusal(read, path):
    """Return the error by which a file is refused, and insist that it is one sentence, and soon."""
    before = os.times()
    with pytest.raises(vf.InputError) as caught:
        read(path)
    after = os.times()
    assert sum(after[:4]) - sum(before[:4]) < LONGEST
    said = str(caught.value)
    assert str(path.name) in said
    assert "\n" not in said
    assert len(said) <= LONGEST_SENTENCE
    return caught.value


@pytest.mark.parametrize("name", hostile.run_files())
def test_run_files_of_any_depth_are_refused_at_once(tmp_path: Path, name: str) -> None:
    path = tmp_path / "study.toml"
    path.write_text(hostile.run_files()[name], encoding="utf-8")
    refusal(vf.load_study, path)


def test_ordinary_keys_and_texts_with_dots_are_read() -> None:
    text = "a.b.c.d = 1\nnumbers = [" + "0.5, " * 5_000 + ']\ntitle = "one. two. … 3.5"\n# ......................\n'
    found = parse_toml(text)
    assert found["a"]["b"]["c"]["d"] == 1
    assert len(found["numbers"]) == 5_000


def test_a_stored_case_of_nested_lists_counts_as_not_solved(tmp_path: Path) -> None:
    store = CaseStore(tmp_path)
    nested = "[" * hostile.NESTED + "]" * hostile.NESTED
    for text in (nested, f'{{"case": {nested}}}', '{"case": ' + "1" * 5_000 + "}"):
        for stored in (text.encode(), _sealed(text, "a")):  # with a checksum that is right, too
            (tmp_path / "a.json").write_bytes(stored)
            assert isinstance(store.get("a"), Damaged)
    store.put("a", sweeps.RECORD)
    assert store.get("a") == sweeps.RECORD


def test_arrays_that_announce_more_than_they_hold_are_refused(tmp_path: Path) -> None:
    def read(path: Path) -> object:
        return vf.read_topography(path, spacing="1 um")

    assert refusal(read, hostile.array(tmp_path / "scan.npy")).code == "damaged"


def test_workbooks_are_no_surfaces(tmp_path: Path) -> None:
    refusal(vf.read_topography, hostile.workbook(tmp_path / "book.xlsx"))
    torn = tmp_path / "torn.xlsx"
    torn.write_bytes(hostile.workbook(tmp_path / "book.xlsx").read_bytes()[:3_000])
    refusal(vf.read_topography, torn)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit of address space")
@pytest.mark.parametrize(("seconds", "memory", "words"), [(0.01, 10**9, "takes longer"), (60.0, 10**8, "takes more")])
def test_surfaces_of_instruments_are_read_within_limits(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seconds: float, memory: int, words: str
) -> None:
    """With limits so small that importing a package goes beyond them, whatever is in the file."""
    if importlib.util.find_spec("SurfaceTopography") is None:
        pytest.skip("the package SurfaceTopography is not installed")
    process = LimitedProcess(seconds, memory, needed=package.__name__)
    monkeypatch.setattr(package, "_APART", process)
    path = tmp_path / "scan.sur"
    path.write_bytes(b"DIGITAL SURF\0" + bytes(1_000))
    assert words in str(refusal(vf.read_topography, path))


def test_a_workbook_as_the_tester_writes_it_is_parsed_apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its cells are counted before the package sees it; one as large as the limit takes seconds to write and parse."""
    monkeypatch.setattr(package, "_MOST_CELLS", package._MOST_CELLS // 100)
    path = hostile.workbook(tmp_path / "scan.xlsx", ("DATA", "Certificate"), rows=60, columns=100)
    with refused("too-large", DataFileError):
        vf.read_topography(path)


def test_hdf5_that_announces_more_than_it_can_hold_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("h5py")
    path = hostile.hdf5(tmp_path / "results.nc")
    assert path.stat().st_size < 10_000
    assert refusal(vf.read_topography, path).code == "too-large"
    assert refusal(vf.open_results, path).code == "damaged"
    with refused("too-large", DataFileError):
        insist_on_size(path.read_bytes(), path)


def test_hdf5_of_others_is_refused_without_a_warning(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "results.nc"
    with h5py.File(path, "w") as file:
        file.create_dataset("heights", data=[[1.0, 2.0]])  # without names of its dimensions
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        refusal(vf.open_results, path)


MEASURED = """
import resource, sys, warnings
import h5py, xarray, viscofric as vf
warnings.simplefilter("error")
reads = {"results.nc": vf.open_results, "study.toml": vf.load_study, "scan.npy": vf.read_topography}
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
for path in sys.argv[1:]:
    try:
        reads[path.rpartition("/")[2]](path)
    except vf.InputError:
        pass
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024)
"""


@pytest.mark.slow  # a process of its own, so that its memory can be measured
@pytest.mark.skipif(sys.platform != "linux", reason="memory is measured in kB on Linux only")
def test_what_is_refused_takes_little_memory_and_warns_of_nothing(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(hostile.run_files()["dotted key"], encoding="utf-8")
    paths = [hostile.hdf5(tmp_path / "results.nc"), study, hostile.array(tmp_path / "scan.npy")]
    done = subprocess.run(
        [sys.executable, "-c", MEASURED, *map(str, paths)], capture_output=True, text=True, check=True
    )
    # MB beyond the imports: what reading loads besides; unguarded, several GB
    assert float(done.stdout) < 300


CARDS = {
    "digits.txt": "nu 0.5\nG_long_term 1e6[Pa]\nG_1 1e6[Pa]\ntau_1 x[s]\nG_" + "1" * 5_000 + " 1e6[Pa]\n",
    "digits.json": '{"format": ' + "1" * 5_000 + "}",
    "nested.json": '{"a":' * hostile.NESTED + "1" + "}" * hostile.NESTED,
    "line.inp": "*ELASTIC\n" + "z" * 500_000 + "\n*VISCOELASTIC, TIME=PRONY\n0.1,0,1\n",
    "key.k": "*MAT_" + "VISCO" * 100_000 + "\n",
    "branch.txt": "1 1e6 1\n" + "2" * 5_000 + " 1e6 1\n",
}


@pytest.mark.parametrize("name", CARDS)
def test_cards_with_endless_numbers_and_lines_are_refused(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    path.write_text(CARDS[name], encoding="utf-8")
    refusal(vf.read_card, path)


def test_a_card_of_a_whole_disk_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "card.inp"
    with path.open("wb") as file:
        file.truncate(LARGEST_CARD + 1)  # takes no room
    assert refusal(vf.read_card, path).code == "too-large"


@pytest.mark.parametrize(
    "read", [vf.read_dma, vf.read_mtm, vf.read_friction_curves, vf.read_shift_factors], ids=lambda one: one.__name__
)
def test_measurements_of_a_whole_disk_are_not_read(tmp_path: Path, read: object) -> None:
    path = tmp_path / "long.csv"
    with path.open("wb") as file:
        file.truncate(LARGEST_TABLE + 1)  # takes no room
    assert refusal(read, path).code == "too-large"


def test_heights_of_a_large_surface_are_read_in_binary_form_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    heights = np.arange(100.0).reshape(10, 10)
    np.save(tmp_path / "scan.npy", heights)
    np.savetxt(tmp_path / "scan.csv", heights, delimiter=",")
    monkeypatch.setattr(files, "LARGEST_TABLE", 500)  # both have more bytes
    np.testing.assert_array_equal(vf.read_topography(tmp_path / "scan.npy", spacing="1 m").heights, heights)
    assert refusal(lambda path: vf.read_topography(path, spacing="1 m"), tmp_path / "scan.csv").code == "too-large"


def test_a_card_may_hold_a_name_of_any_length(tmp_path: Path) -> None:
    path = tmp_path / "card.txt"
    path.write_text(CARDS["digits.txt"].replace("x[s]", "1[s]"), encoding="utf-8")
    with warned() as notes:
        vf.read_card(path)
    assert "not-read" in codes(notes)
    assert all(len(note) < 2 * LONGEST_SENTENCE for note in notes)


def test_friction_and_heights_that_no_rubber_or_surface_has_are_noted(tmp_path: Path) -> None:
    path = tmp_path / "curves.csv"
    header = "speed (mm/s),temperature (degC),load (N),viscoelastic friction"
    path.write_text(f"{header}\n1,20,1,5.6e9\n2,20,1,0.1\n", encoding="utf-8")
    assert "implausible-friction" in codes(vf.read_friction_curves(path).notes)
    path.write_text(f"{header}\n1,20,1,3.5\n", encoding="utf-8")
    assert codes(vf.read_friction_curves(path).notes) == {"errors-unknown"}
    header = "temperature (degC),disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)"
    path.write_text(f"{header}\n20,10,9,1,99\n20,9,10,1,-1\n", encoding="utf-8")
    assert "implausible-friction" in codes(vf.read_mtm(path).notes)
    for values, code in (
        ("20,0.1,0.09,1e4,0.7", "implausible-friction"),  # N for kN: below any force cell's resolution
        ("293,0.1,0.09,1,0.7", "implausible-temperature"),
        ("20,300,290,1,0.7", "implausible-speed"),
    ):
        path.write_text(f"{header.replace('mm/s', 'm/s')}\n{values}\n", encoding="utf-8")
        assert codes(vf.read_mtm(path).notes) >= {code}
    path.write_text("speed (m/s),temperature (K),load (N),viscoelastic friction\n300,20,1,1e-5\n", encoding="utf-8")
    implausible = {"implausible-friction", "implausible-temperature", "implausible-speed"}
    assert codes(vf.read_friction_curves(path).notes) == implausible | {"errors-unknown"}
    path.write_text(path.read_text("utf-8") + "300,20,1,1e-5\n", encoding="utf-8")
    assert "copied-rows" in codes(vf.read_friction_curves(path).notes)
    path.write_text(path.read_text("utf-8") + "301,20,1,1e-5\n", encoding="utf-8")
    assert "copied-rows" not in codes(vf.read_friction_curves(path).notes)  # one of three
    random = np.random.default_rng(0)
    precise = np.round(0.83 * np.exp(0.01 * random.standard_normal(12)), 4)
    measured = 0.83 * np.exp(0.01 * random.standard_normal(24))  # two digits are as coarse as the scatter
    for friction, copied in ((np.round(measured, 2), False), (precise.repeat(2), True)):
        rows = [f"10,20,1,{one}" for one in friction]
        path.write_text("\n".join(["speed (m/s),temperature (degC),load (N),viscoelastic friction", *rows]), "utf-8")
        assert ("copied-rows" in codes(vf.read_friction_curves(path).notes)) == copied
    scan = tmp_path / "scan.csv"
    scan.write_text("8e298,0\n0,1\n", encoding="utf-8")
    with refused("implausible-height", DataFileError, naming="8e+298"):
        vf.read_topography(scan, spacing="1 um")
    scan.write_text("3.5,0\n0,1\n", encoding="utf-8")  # µm, read as m
    assert "implausible-heights" in codes(vf.read_topography(scan, spacing="1 um").history)
    assert not codes(vf.read_topography(scan, spacing="1 um", unit="um").history)


SHADOWED = """
import viscofric as vf
from viscofric.units import to_si
try:
    to_si("30 furlong", "m")  # a unit that only pint knows
except vf.ViscofricError as error:
    print(error)
"""


@pytest.mark.slow  # a process of its own, which imports anew
def test_a_module_of_the_users_in_place_of_a_package_is_reported_as_such(tmp_path: Path) -> None:
    (tmp_path / "pint.py").write_text("import nothing_of_this_name\n", encoding="utf-8")
    (tmp_path / "script.py").write_text(SHADOWED, encoding="utf-8")
    done = subprocess.run([sys.executable, tmp_path / "script.py"], capture_output=True, text=True, check=True)
    assert "No module named 'nothing_of_this_name'" in done.stdout
    assert "not a unit" not in done.stdout


def test_a_package_that_is_missing_differs_from_one_that_fails() -> None:
    missing = ModuleNotFoundError("No module named 'dask'", name="dask")
    reported = not_imported("dask", missing, "pip install dask")
    assert reported.endswith("pip install dask")
    for broken in (ModuleNotFoundError("No module named 'dask.base'", name="dask.base"), AttributeError("x")):
        assert str(broken) in not_imported("pint", broken)
        assert str(broken) not in reported


LONG = "x" * 100_000
TABLES = {
    "a heading": f"T (°C),f (Hz),E' (MPa),loss {LONG}\n20,1,5,0.5\n",
    "a unit": f"T (°C),f (Hz),E' (MPa),E'' ({LONG})\n20,1,5,0.5\n",
    "a cell": f"T (°C),f (Hz),E' (MPa),E'' (MPa)\n20,1,5,{LONG}\n",
    "a number": f"T (°C),f (Hz),E' (MPa),E'' (MPa)\n20,1,5,{'1' * 100_000}\n",
    "a traction table": f"speed (mm/s),temperature (degC),load (N),traction force (N)\n1,20,1,{LONG}\n",
    "friction curves": f"speed (mm/s),temperature (degC),load (N),viscoelastic friction\n1,20,1,{LONG}\n",
    "RepTate": f"T=25;Mw={LONG};\nFreq G' G''\nrad/s Pa Pa\n1 1 {LONG}\n",
    "RheoCompass": f"Interval and data points:\t1\t1\nInterval data:\tPoint No.\tf\t{LONG}\n\t[Hz]\n\t1\t{LONG}\n",
}


@pytest.mark.parametrize("name", TABLES)
@pytest.mark.parametrize(
    "read", [vf.read_dma, vf.read_mtm, vf.read_friction_curves, vf.read_shift_factors], ids=lambda one: one.__name__
)
def test_messages_quote_no_more_than_a_sentence_holds(tmp_path: Path, read: object, name: str) -> None:
    path = tmp_path / "long.csv"
    path.write_text(TABLES[name], encoding="utf-8")
    refusal(read, path)


def test_a_long_sentence_keeps_its_beginning_and_its_end() -> None:
    error = DataFileError("a.csv", f"column {'x' * 10**6} has no unit; write it.", row=3)
    for one in (error, pickle.loads(pickle.dumps(error))):
        assert len(str(one)) <= LONGEST_SENTENCE
        assert str(one).startswith("a.csv, line 3: column xxx")
        assert str(one).endswith("has no unit; write it.")
    assert shortened("brief") == "brief"


@pytest.mark.parametrize("count", [2, 5, 99])
@pytest.mark.parametrize("length", [10, 90, 10_000])
def test_many_mistakes_are_counted_in_a_message_and_listed_for_a_terminal(count: int, length: int) -> None:
    mistakes = [f"{number:02}{'a' * length}: no." for number in range(count)]
    error = StudyError(f"study.toml: {count} things are wrong:", mistakes)
    for one in (error, pickle.loads(pickle.dumps(error))):
        assert len(one.mistakes) == count
        assert len(str(one)) <= LONGEST_SENTENCE
        first, *lines = str(one).split("\n")
        assert first == f"study.toml: {count} things are wrong:"
        assert 2 <= len(lines) <= count
        left = re.fullmatch(r"  … and (\d+) more\.", lines[-1])
        assert len(lines) - 1 + int(left[1]) == count if left else len(lines) == count
        assert all(line.endswith(": no.") for line in lines[: -1 if left else None])
        listed = one.listing().split("\n")
        assert len(listed) == 1 + min(count, 21)
        assert all(len(line) <= LONGEST_SENTENCE + 2 for line in listed)


def test_all_mistakes_of_a_run_file_stay_at_hand(tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text(hostile.STUDY + "".join(f"[unknown_{number}]\n" for number in range(40)), encoding="utf-8")
    with pytest.raises(StudyError) as caught:
        vf.load_study(path)
    assert len(caught.value.mistakes) == 40
    assert len(str(caught.value)) <= LONGEST_SENTENCE
