"""Pressure and displacement of one contact as a file: netCDF with labels and units, or a plain table."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import not_written
from viscofric.files import write_atomically

if TYPE_CHECKING:
    from viscofric.contact.solution import ContactSolution


def write_fields(path: Path, solution: ContactSolution) -> None:
    """Write the fields of a contact.

    Parameters
    ----------
    path : Path
        Ends in ``.nc`` (netCDF) or ``.csv`` (a line for each cell: x, y, pressure, displacement).  Replaced if it
        exists.
    solution : ContactSolution

    Raises
    ------
    DataFileError
        If it cannot be written.
    """
    write_atomically(path, _table(solution) if path.suffix.lower() == ".csv" else _netcdf(path, solution))


def _table(solution: ContactSolution) -> bytes:
    x, y = (values.ravel() for values in np.meshgrid(solution.x, solution.y, indexing="ij"))
    columns = np.column_stack([x, y, solution.pressure.ravel(), solution.displacement.ravel()])
    rows = [",".join(f"{number:.10g}" for number in row) for row in columns.tolist()]
    return "\n".join(["x (m),y (m),pressure (Pa),displacement (m)", *rows, ""]).encode()


def _netcdf(path: Path, solution: ContactSolution) -> bytes:
    try:
        with tempfile.TemporaryDirectory(prefix="viscofric") as folder:
            made = Path(folder) / "fields.nc"
            solution.to_dataset().to_netcdf(made, engine="h5netcdf")
            return made.read_bytes()
    except OSError as error:
        raise not_written(path, error) from error
