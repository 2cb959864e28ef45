"""Labelled data as netCDF files, through xarray and the library netCDF4."""

from __future__ import annotations

import math
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from viscofric.datasets import Dataset, DataTree
from viscofric.errors import DataFileError
from viscofric.files import announces_too_much, write_atomically

#: The library is not made for several threads.
_ONE_AT_A_TIME = threading.Lock()


def write_netcdf(data: Dataset | DataTree, target: Path) -> None:
    """Write a data set or a tree of them, whole or not at all."""
    if target.is_dir():
        raise DataFileError(target, "is a folder; give the name of a file.", code="is-folder")
    with tempfile.TemporaryDirectory(prefix="viscofric-") as folder:
        # a file, since the library loses the order of groups and attributes in memory
        made = Path(folder, "data.nc")
        try:
            with _ONE_AT_A_TIME:
                data.to_netcdf(made, engine="netcdf4")
        except RuntimeError as error:  # all that the library says of a full disk
            problem = f"cannot be written: its temporary file in {tempfile.gettempdir()} failed ({error})."
            raise DataFileError(target, problem, code="not-written") from error
        content = made.read_bytes()
    write_atomically(target, content)


def read_netcdf(content: bytes, attribute: str) -> DataTree | None:
    """Return all groups of the content of a file, or None if its root lacks an attribute.

    Raises `ValueError` for a damaged file that announces more than it can hold, before reading that; OSError and others
    for what the libraries cannot read.
    """
    import netCDF4
    import xarray

    store: Any = xarray.backends.NetCDF4DataStore
    # from memory, since the library takes no name of a file that is not UTF-8, and some for addresses
    with _ONE_AT_A_TIME, netCDF4.Dataset("in memory", memory=content) as file:
        groups = list(_groups(file))
        size = sum(_size(variable) for group in groups for variable in group.variables.values())
        if announces_too_much(size, len(content)):
            raise ValueError(f"it announces {size / 1e6:.0f} MB, far more than it can hold")
        if attribute not in file.ncattrs():
            return None
        return xarray.DataTree.from_dict({one.path: xarray.open_dataset(store(one)).load() for one in groups})


def _groups(group: Any) -> Iterator[Any]:
    yield group
    for child in group.groups.values():
        yield from _groups(child)


def _size(variable: Any) -> int:
    """Return the number of bytes of an array, or of one of its chunks if that is larger; of texts, their number."""
    chunk = variable.chunking()
    largest = max(math.prod(variable.shape), 0 if chunk == "contiguous" else math.prod(chunk))
    return int(largest * getattr(variable.dtype, "itemsize", 1))
