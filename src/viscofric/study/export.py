"""Results for other programs: a tidy table (CSV), a workbook, or the labelled data set alone (netCDF, zarr)."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Literal, get_args

from viscofric.errors import DataFileError, InputError, check_choice, not_imported, not_written
from viscofric.files import file_path, write_atomically
from viscofric.study.columns import table_text
from viscofric.study.results_file import RESULTS_FILE, cases_of

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray

Form = Literal["csv", "excel", "netcdf", "zarr"]
FORMS: tuple[Form, ...] = get_args(Form)
#: Format -> the file that it is written into, where no other is named.
NAMES: dict[Form, str] = {
    "csv": "results.csv",
    "excel": "results.xlsx",
    "netcdf": "prediction.nc",
    "zarr": "prediction.zarr",
}


def export_results(tree: xarray.DataTree, folder: Path, form: Form, path: str | Path | None = None) -> Path:
    """Write results that lie in a folder for other programs; see `StudyResults.export`."""
    check_choice(form, "form", *FORMS)
    target = folder / NAMES[form] if path is None else file_path(path)
    if target.resolve() == (folder / RESULTS_FILE).resolve():
        raise InputError(f"{target} holds the results themselves; choose another name.")
    cases = cases_of(tree, folder)
    if form == "csv":
        write_atomically(target, table_text(cases).encode())
    elif form == "excel":
        from viscofric.study.workbook import workbook

        write_atomically(target, workbook(tree, cases))
    elif form == "netcdf":
        _write_netcdf(cases, target)
    else:
        _write_zarr(cases, target)
    return target


def _write_netcdf(dataset: xarray.Dataset, target: Path) -> None:
    if target.is_dir():
        raise DataFileError(target, "is a folder; a name for a file is wanted.")

    def write(path: Path) -> None:
        dataset.to_netcdf(path, engine="h5netcdf")

    _moved_into_place(write, target)


def _write_zarr(dataset: xarray.Dataset, target: Path) -> None:
    try:
        import zarr  # noqa: F401
    except Exception as error:
        why = not_imported("zarr", error, "pip install 'viscofric[zarr]'")
        raise InputError(f"this format needs zarr, but {why}.") from error
    if target.exists() and not any((target / name).exists() for name in (".zgroup", "zarr.json")):
        raise DataFileError(target, "exists, and is no zarr folder that could be replaced; choose another name.")

    def write(path: Path) -> None:
        # Version 2 of the format has texts of any length, and is read everywhere.
        dataset.to_zarr(path, zarr_format=2, consolidated=True)

    _moved_into_place(write, target)


def _moved_into_place(write: Callable[[Path], None], target: Path) -> None:
    """Write beside the target and move it there when it is whole."""
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=target.parent, prefix=f".{target.name}.") as temporary:
            path = Path(temporary) / target.name
            write(path)
            if target.is_dir():
                shutil.move(target, Path(temporary) / "before")
            path.replace(target)
    except (OSError, RuntimeError) as error:
        raise not_written(target, error) from error
