"""Results on disk: what is written is what is read, and a damaged file is told in a sentence."""

from __future__ import annotations

import json
import os
import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import hostile
import viscofric as vf
from refusals import refused
from study.sweeps import RECORD, made_outcomes, made_results, made_sweep
from viscofric.errors import DataFileError
from viscofric.report.texts.study import grouped_failures
from viscofric.study.cases.sweep import place, place_in
from viscofric.study.contacts import Solved
from viscofric.study.results.file import DIGEST, save_results
from viscofric.study.results.netcdf import read_netcdf, write_netcdf
from viscofric.study.results.results import input_hashes
from viscofric.study.results.tree import master_prediction
from viscofric.study.study_rubber import curves_of

#: Which an earlier version wrote, through h5py.
STORED = Path(__file__).parents[1] / "data" / "stored" / "results" / "results.nc"


@pytest.mark.slow
def test_what_is_stored_is_what_is_read(tmp_path: Path) -> None:
    made = made_results(tmp_path, made_sweep(materials=("NBR", "EPDM / carbon black")), failed=[3])
    for path in (tmp_path, tmp_path / "results.nc", str(tmp_path)):
        found = vf.open_results(path)
        for group in made.tree.subtree:
            xarray.testing.assert_identical(
                found.tree[group.path].to_dataset().drop_attrs(deep=False), group.to_dataset().drop_attrs(deep=False)
            )
        assert found.failures == made.failures
        assert list(found.materials) == ["NBR", "EPDM / carbon black"]
        assert list(found.fields) == [36]
    assert list(found.materials["NBR"].children) == ["spectrum"]


@pytest.fixture
def of_all_kinds() -> xarray.DataTree:
    """Return a tree with every kind of variable, dimension and attribute that netCDF knows and results have."""
    attributes = {"one": "ω", "lines": ["a", "b"], "none": [], "number": 0.5, "range": np.array([1.0, 2.0])}
    root = xarray.Dataset(
        {"curve": (("point", "speed"), np.arange(6.0).reshape(2, 3))}, {"speed": [1.0, 2.0, 4.0]}, {"title": "all"}
    )
    child = xarray.Dataset(
        {
            "inherited": ("speed", [1, 2, 3], {"units": "m"}),
            "missing": ("mode", [np.nan, 1.0]),
            "flag": ("mode", [True, False]),
            "single": ((), 2.5),
        },
        {"name": ("mode", ["α", ""]), "alone": ((), 3), "point": [7, 8]},
        attributes,
    )
    empty = xarray.Dataset({"nothing": (("none", "mode"), np.empty((0, 2))), "no_text": ("none", np.array([], "<U1"))})
    return xarray.DataTree.from_dict({"/": root, "/child": child, "/child/empty": empty})


@pytest.mark.slow
def test_every_kind_of_data_is_read_as_it_was_written(of_all_kinds: xarray.DataTree, tmp_path: Path) -> None:
    (tmp_path / "größe #1").mkdir()
    path = tmp_path / "größe #1" / "all.nc"
    write_netcdf(of_all_kinds, path)
    found = read_netcdf(path.read_bytes(), "title")
    assert found is not None
    xarray.testing.assert_identical(found, of_all_kinds)
    for node in of_all_kinds.subtree:
        of_group, expected = found[node.path].to_dataset(inherit=False), node.to_dataset(inherit=False)
        assert list(found[node.path].children) == list(node.children)
        assert list(of_group.variables) == list(expected.variables)
        assert list(of_group.attrs) == list(expected.attrs)
        assert [one.dtype.kind for one in of_group.variables.values()] == [
            one.dtype.kind for one in expected.variables.values()
        ]
    assert read_netcdf(path.read_bytes(), "another") is None
    assert read_netcdf(STORED.read_bytes(), DIGEST) is not None


def test_files_are_written_and_read_in_several_threads(of_all_kinds: xarray.DataTree, tmp_path: Path) -> None:
    def there_and_back(number: int) -> xarray.DataTree | None:
        write_netcdf(of_all_kinds, tmp_path / f"{number}.nc")
        return read_netcdf((tmp_path / f"{number}.nc").read_bytes(), "title")

    with ThreadPoolExecutor(4) as threads:
        assert all(of_all_kinds.identical(found) for found in threads.map(there_and_back, range(12)))


@pytest.mark.skipif(sys.platform == "win32", reason="Windows limits no sizes of files")
def test_a_full_disk_for_temporary_files_is_reported(of_all_kinds: xarray.DataTree, tmp_path: Path) -> None:
    path = tmp_path / "all.nc"
    write_netcdf(of_all_kinds, path)
    before = path.read_bytes()
    import resource

    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limits[1]))
        with refused("not-written", DataFileError):
            write_netcdf(of_all_kinds, path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, ignored)
    assert path.read_bytes() == before


@pytest.mark.slow
def test_the_data_set_carries_its_provenance(tmp_path: Path) -> None:
    made_results(tmp_path)
    found = vf.open_results(tmp_path).dataset
    assert {"title", "viscofric_version", "input_hashes", "study_text", "accuracy", "created"} <= set(found.attrs)
    assert found.sel(speed=0.1)["friction_coefficient"].dims == ("load_radius", "temperature")


@pytest.mark.slow
def test_results_of_a_rubber_alone_have_no_data_set(tmp_path: Path) -> None:
    made = made_results(tmp_path)
    del made.tree["prediction"]
    save_results(made.tree, tmp_path)
    with refused("no-prediction"):
        _ = vf.open_results(tmp_path).dataset


@pytest.mark.parametrize(
    ("content", "code"),
    [
        (b"", "damaged"),
        (b"\x89HD", "damaged"),
        (b"speed,friction\n1,2\n", "not-results"),
        (b"\x89HDF\r\n\x1a\n", "damaged"),
    ],
)
def test_what_is_no_results_file_is_reported(tmp_path: Path, content: bytes, code: str) -> None:
    (tmp_path / "results.nc").write_bytes(content)
    with refused(code, DataFileError):
        vf.open_results(tmp_path)


def test_a_netcdf_file_of_others_is_reported(tmp_path: Path) -> None:
    xarray.Dataset({"a": 1.0}).to_netcdf(tmp_path / "other.nc", engine="netcdf4")
    with refused("not-results", DataFileError):
        vf.open_results(tmp_path / "other.nc")


@pytest.mark.slow
def test_exported_cases_and_the_folder_above_are_not_taken_for_results(tmp_path: Path) -> None:
    folder = tmp_path / "größe.results"
    made = made_results(folder)
    exported = made.export("netcdf")
    with refused("exported", DataFileError):
        vf.open_results(exported)
    with refused("no-results", DataFileError):
        vf.open_results(tmp_path)


def test_inputs_beside_the_run_file_are_named_from_there(tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    file = tmp_path / "data" / "dma.csv"
    file.write_text("1")
    elsewhere = tmp_path.parent / "away"
    assert list(json.loads(input_hashes([file], tmp_path))) == ["data/dma.csv"]
    assert list(json.loads(input_hashes([file], elsewhere))) == [file.as_posix()]


def test_a_place_shows_no_more_digits_than_matter() -> None:
    """Temperature and speed of measured points are means of readings: 89.9995 °C, 19.9996 mm/s."""
    assert place(SimpleNamespace(temperature=363.1495, speed=0.0199996)) == "90 °C, 20 mm/s"


def test_a_place_shows_all_that_varies(tmp_path: Path) -> None:
    sweep = made_sweep(materials=("NBR", "EPDM"), speeds=(0.02, 20.0))
    assert place_in(sweep, 0) == "30 °C, 20 mm/s, NBR, 10 N, radius 5 mm"
    assert place_in(sweep, len(sweep.cases) - 1) == "90 °C, 20 m/s, EPDM, 25 N, radius 10 mm"
    solved = Solved(sweep.cases, tuple(made_outcomes(sweep, failed=[5])), sweep)
    assert [str(one) for one in solved.failures] == [f"{place_in(sweep, 5)}: accuracy not reached."]
    assert grouped_failures([one.note for one in solved.failures], 5) == [
        "90 °C, 20 m/s, NBR, 10 N, radius 5 mm: accuracy not reached."
    ]


def test_missing_results_are_reported_and_what_helps(tmp_path: Path) -> None:
    with refused("no-results", DataFileError):
        vf.open_results(tmp_path)
    (tmp_path / "cases").mkdir()
    (tmp_path / "cases" / "a.json").touch()
    with refused("unfinished", DataFileError):
        vf.open_results(tmp_path)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    folder = tmp_path_factory.mktemp("whole")
    made_results(folder)
    return (folder / "results.nc").read_bytes()


@settings(max_examples=25, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(share=st.floats(0.0, 1.0, exclude_max=True))
def test_a_file_cut_short_anywhere_is_one_sentence(whole: bytes, tmp_path: Path, share: float) -> None:
    (tmp_path / "results.nc").write_bytes(whole[: int(share * len(whole))])
    with refused("damaged", DataFileError):
        vf.open_results(tmp_path)


@settings(max_examples=25, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(share=st.floats(0.02, 1.0, exclude_max=True))
def test_pages_that_a_power_cut_left_empty_are_never_taken_for_numbers(
    whole: bytes, tmp_path: Path, share: float
) -> None:
    start = int(share * len(whole))
    cut = whole[:start].ljust(len(whole), b"\0")
    (tmp_path / "results.nc").write_bytes(cut)
    if cut == whole:  # what was lost is the room that HDF5 leaves at the end
        return
    with pytest.raises(DataFileError) as caught:
        vf.open_results(tmp_path)
    assert caught.value.code in ("damaged", "not-results")


@pytest.mark.slow
def test_a_changed_number_is_noticed(whole: bytes, tmp_path: Path) -> None:
    number = np.float64(vf.synthetic_fluoroelastomer().poisson_ratio)
    friction = made_results(tmp_path).dataset["friction_coefficient"].values.ravel()[7]
    place = whole.find(np.float64(friction).tobytes())
    assert place > 0
    (tmp_path / "results.nc").write_bytes(whole[:place] + number.tobytes() + whole[place + 8 :])
    with refused("damaged", DataFileError):
        vf.open_results(tmp_path)


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="folders are writable to all here")
def test_results_that_cannot_be_written_are_reported(tmp_path: Path) -> None:
    made = made_results(tmp_path / "made")
    (tmp_path / "made").chmod(0o500)
    try:
        with refused("not-written", DataFileError):
            save_results(made.tree, tmp_path / "made")
    finally:
        (tmp_path / "made").chmod(0o700)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no such names of files")
def test_a_run_file_whose_name_is_no_text_has_results(tmp_path: Path) -> None:
    path = tmp_path / os.fsdecode(b"a\xff.toml")
    path.write_text(hostile.STUDY + "[solver]\naccuracy = 0.1\n[outputs]\nfields = 'none'\n", encoding="utf-8")
    vf.run_study(path)
    assert vf.open_results(path.with_suffix(".results")).dataset.attrs["study_file"] == r"a\udcff.toml"


def test_interpolated_contacts_along_the_master_curve_are_marked() -> None:
    records = [RECORD, replace(RECORD, interpolated=True)]
    found = master_prediction(records, "point", None, curves_of(records))
    assert found["interpolated"].values.tolist() == [0, 1]
