"""Results for other programs: a tidy table (CSV), a workbook, or the labelled data set alone (netCDF, zarr)."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Literal, get_args

from viscofric.errors import DataFileError, InputError, check_choice, not_imported
from viscofric.files import file_path, write_atomically
from viscofric.study.columns import table_text
from viscofric.study.results import RESULTS_FILE

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray

    from viscofric.study.results import StudyResults

Form = Literal["csv", "excel", "netcdf", "zarr"]
FORMS: tuple[Form, ...] = get_args(Form)
#: Format -> the file that it is written into, where no other is named.
NAMES: dict[Form, str] = {
    "csv": "results.csv",
    "excel": "results.xlsx",
    "netcdf": "prediction.nc",
    "zarr": "prediction.zarr",
}


def export_results(results: StudyResults, form: Form, path: str | Path | None = None) -> Path:
    """Write results for other programs.

    Parameters
    ----------
    results : StudyResults
        Of a study with a prediction.
    form : {"csv", "excel", "netcdf", "zarr"}
        A table with a row for each case; a workbook with all tables; the labelled cases alone, as netCDF or zarr.
    path : str or Path, optional
        File, or for zarr folder, replaced if it exists; in the folder of the results if not given.

    Returns
    -------
    Path
        What was written.

    Raises
    ------
    InputError
        If there is no prediction, the format is unknown, or zarr is not installed.
    DataFileError
        If it cannot be written.
    """
    check_choice(form, "form", *FORMS)
    target = results.folder / NAMES[form] if path is None else file_path(path)
    if target.resolve() == (results.folder / RESULTS_FILE).resolve():
        raise InputError(f"{target} holds the results themselves; choose another name.")
    if form == "csv":
        write_atomically(target, table_text(results).encode())
    elif form == "excel":
        from viscofric.study.workbook import workbook

        write_atomically(target, workbook(results))
    elif form == "netcdf":
        _write_netcdf(results.dataset, target)
    else:
        _write_zarr(results.dataset, target)
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
        number = getattr(error, "errno", None)
        raise DataFileError(target, f"cannot be written ({os.strerror(number) if number else error}).") from error
