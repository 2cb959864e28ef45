"""Labelled data as netCDF files: those that xarray writes and reads through h5netcdf, in a fraction of its time.

h5netcdf looks up each data set of HDF5 some thirty times; here h5py creates or opens each of them once.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any
from uuid import uuid4

import numpy as np

from viscofric.datasets import Dataset, DataTree
from viscofric.errors import DataFileError
from viscofric.files import write_atomically

if TYPE_CHECKING:
    import h5py

#: NAME of the scale of a dimension without coordinates, before its length.
_NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable."
#: Attributes by which HDF5 and netCDF link dimensions and variables.
_LINKS = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_NCProperties", "_Netcdf4Coordinates", "_Netcdf4Dimid"}


def write_netcdf(data: Dataset | DataTree, target: Path) -> None:
    """Write a data set or a tree of them, whole or not at all."""
    import h5py
    import xarray

    if target.is_dir():
        raise DataFileError(target, "is a folder; give the name of a file.", code="is-folder")
    tree = xarray.DataTree(data) if isinstance(data, xarray.Dataset) else data
    # In memory, where names must differ while files are open at once.
    with h5py.File(uuid4().hex, "w", driver="core", backing_store=False, track_order=True) as file:
        file.attrs["_NCProperties"] = f"version=2,h5py={h5py.__version__},hdf5={h5py.version.hdf5_version}"
        _write_group(file, tree, count())
        file.flush()
        content = file.id.get_file_image()
    write_atomically(target, content)


def _write_group(group: h5py.Group, node: DataTree, numbers: Iterator[int]) -> None:
    """Write a node of a tree and all below it, each with dimensions of its own, given numbers for these."""
    import h5py
    from xarray.conventions import encode_cf_variable, encode_dataset_coordinates

    data = node.to_dataset(inherit=False)
    variables, attributes = encode_dataset_coordinates(data)
    _write_attributes(group, attributes)
    written: dict[str, h5py.Dataset] = {}
    for name, variable in variables.items():
        encoded = encode_cf_variable(variable, name=name)
        values, dtype = encoded.values, encoded.dtype
        if dtype.kind in "OUT":
            values, dtype = values.astype(object), h5py.string_dtype()
        written[name] = _create(group, name, values.shape, dtype, values)
        _write_attributes(written[name], encoded.attrs)
    scales = {}
    for name, length in ((str(name), length) for name, length in data.sizes.items()):
        scale, title = written.get(name), name
        if scale is None:
            scale, title = _create(group, name, (length,), ">f4"), f"{_NO_VARIABLE}{length:10}"
        scale.make_scale(title)
        scale.attrs["_Netcdf4Dimid"] = np.int32(next(numbers))
        scales[name] = scale
    for name, variable in variables.items():
        if variable.dims != (name,):
            for axis, dimension in enumerate(variable.dims):
                written[name].dims[axis].attach_scale(scales[dimension])
    for name, child in node.children.items():
        _write_group(group.create_group(name, track_order=True), child, numbers)


def _create(group: h5py.Group, name: str, shape: tuple[int, ...], dtype: Any, values: Any = None) -> h5py.Dataset:
    """Create a variable in a group; dimensions without length are unlimited in netCDF."""
    unlimited = {} if all(shape) else {"maxshape": tuple(length or None for length in shape)}
    return group.create_dataset(name, shape, dtype, values, track_order=True, **unlimited)


def _write_attributes(place: h5py.HLObject, attributes: Mapping[str, Any]) -> None:
    for name, value in attributes.items():
        number = np.isscalar(value) and not isinstance(value, str)
        place.attrs[name] = np.atleast_1d(value) if number else value  # as netCDF has numbers


def read_netcdf(file: h5py.File) -> DataTree:
    """Return all groups of an open file, which `write_netcdf` or xarray wrote."""
    import h5py
    import xarray

    groups: dict[str, Dataset] = {}

    def read(group: h5py.Group) -> None:
        variables = {}
        for name, item in group.items():
            if isinstance(item, h5py.Group):
                continue
            if not item.is_scale:
                dimensions = tuple(scales[0].name.rpartition("/")[2] for scales in item.dims)
            elif item.attrs["NAME"].decode().startswith(_NO_VARIABLE):
                continue
            else:
                dimensions = (name,)
            values = np.asarray(item.asstr()[()], dtype=str) if h5py.check_string_dtype(item.dtype) else item[()]
            variables[name] = (dimensions, values, _read_attributes(item))
        groups[group.name] = xarray.decode_cf(xarray.Dataset(variables, attrs=_read_attributes(group)))
        for item in group.values():
            if isinstance(item, h5py.Group):
                read(item)

    read(file)
    return xarray.DataTree.from_dict(groups)


def _read_attributes(place: h5py.HLObject) -> dict[str, Any]:
    found = {}
    for name in place.attrs:
        if name not in _LINKS:
            value = place.attrs[name]
            if isinstance(value, np.ndarray):
                value = value.tolist() if value.dtype == object else value
                value = value[0] if len(value) == 1 else value
            found[name] = value.decode() if isinstance(value, bytes) else value
    return found
