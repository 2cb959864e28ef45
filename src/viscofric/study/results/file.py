"""The file of a study's results: written and opened whole, or refused; and what its groups hold."""

from __future__ import annotations

import hashlib
import json
import os
import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError, InputError, not_written
from viscofric.files import file_path, insist_on_true_size

if TYPE_CHECKING:
    import xarray

RESULTS_FILE = "results.nc"
_PREDICTION = "prediction"
#: Attributes of the whole that a data set taken out of it keeps: what it is, and where it comes from.
_ABOUT = (
    "title",
    "data_origin",
    "accuracy",
    "seed",
    "indenter",
    "study_file",
    "study_text",
    "input_hashes",
    "failures",
    "viscofric_version",
    "created",
    "software",
)
#: Attribute of the root with the digest of everything else.
DIGEST = "content_sha256"
_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_CUT = re.compile(r"truncated file: eof = (\d+),.*stored_eof = (\d+)")


def cases_of(tree: xarray.DataTree, folder: Path) -> xarray.Dataset:
    """Return the predicted cases of results that lie in a folder; see `StudyResults.dataset`."""
    if _PREDICTION not in tree.children:
        raise InputError(f"{folder}: these are results of a rubber alone, without a prediction of friction.")
    found = tree[_PREDICTION].to_dataset()
    return found.assign_attrs({name: tree.attrs[name] for name in _ABOUT if name in tree.attrs})


def rubbers_of(tree: xarray.DataTree) -> dict[str, xarray.DataTree]:
    """Return what results hold of each rubber, by its name; see `StudyResults.materials`."""
    branches = tree.children.get("materials")
    if branches is None:
        return {str(tree.attrs.get("material", "")): tree}
    told = tree[_PREDICTION].coords["material"].values.tolist() if _PREDICTION in tree.children else []
    names = dict(enumerate(map(str, told), 1))
    return {names.get(int(number), number): branch for number, branch in branches.children.items()}


def open_tree(path: str | Path) -> tuple[xarray.DataTree, Path]:
    """Return the tree of results and their folder; see `open_results`."""
    import h5netcdf  # noqa: F401 - what is wrong with it is nothing of the file's
    import xarray

    file = file_path(path)
    if file.is_dir():
        file = file / RESULTS_FILE
        solved = 0 if file.is_file() else sum(1 for _ in file.parent.glob("cases/*.json"))
        if solved:
            raise DataFileError(
                file,
                f"no such file: the study has not been finished.  Contacts solved so far: {solved}.  Running it with "
                "--resume completes it; with --finished-only, it puts together what is there.",
            )
    if not file.is_file():
        raise DataFileError(file, f"no such results file; {_where_they_are(file.parent)}")
    try:
        insist_on_true_size(file)
        with xarray.open_datatree(file, engine="h5netcdf", phony_dims="access") as stored:
            tree = stored.load()
            found = digest(tree)
    except Exception as error:  # h5py raises many kinds; the file tells more than they do
        raise DataFileError(file, what_is_wrong(file, error)) from error
    if "viscofric_version" not in tree.attrs:
        raise DataFileError(file, "is a netCDF file, but not one of results of viscofric.")
    if not tree.children:
        raise DataFileError(
            file,
            "holds the cases alone, as exported for other programs (xarray.open_dataset reads it); give the folder of "
            "the study's results.",
        )
    if tree.attrs.get(DIGEST, found) != found:
        raise DataFileError(file, f"is damaged: it does not hold what was written into it.{what_helps(file)}")
    return tree, file.parent


def _where_they_are(folder: Path) -> str:
    """Say what to do where a folder holds no results."""
    near = sorted(other.parent for other in folder.glob(f"*/{RESULTS_FILE}"))
    return f"there are results in {near[0]}." if near else "run the study first."


def save_results(tree: xarray.DataTree, folder: Path) -> Path:
    """Write a tree to a folder's ``results.nc``; the file is there whole or not at all."""
    target = folder / RESULTS_FILE
    tree.attrs[DIGEST] = digest(tree)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder, prefix=".results.") as temporary:
            path = Path(temporary) / RESULTS_FILE
            tree.to_netcdf(path, engine="h5netcdf")
            with path.open("rb+") as file:
                os.fsync(file.fileno())
            path.replace(target)
    except (OSError, RuntimeError) as error:  # RuntimeError: HDF5, where it closes a file on a full disk
        raise not_written(target, error) from error
    return target


def digest(tree: xarray.DataTree) -> str:
    """Return what changes with any number, name, unit or attribute of results (SHA-256).

    What HDF5 itself notices is a file that is too short; a page of zeros that a power cut left is a number like any
    other to it.
    """
    found = hashlib.sha256()
    for node in sorted(tree.subtree, key=lambda node: node.path):
        group = node.to_dataset(inherit=False)
        found.update(json.dumps([node.path, _attributes(group.attrs)]).encode())
        for name in sorted(map(str, group.variables)):
            variable = group[name]
            values = np.asarray(variable.values)
            plain = values.astype(str) if values.dtype.kind in "OUST" else values
            about = [name, list(variable.dims), list(values.shape), _attributes(variable.attrs)]
            found.update(json.dumps(about).encode())
            found.update(json.dumps(plain.tolist()).encode() if plain.dtype.kind == "U" else plain.tobytes())
    return found.hexdigest()


def _attributes(attributes: dict[object, object]) -> list[list[object]]:
    """Return attributes in plain types, as they are before they are written and after they are read alike."""
    return [
        [str(name), np.ravel(np.asarray(value)).tolist()]
        for name, value in sorted(attributes.items(), key=str)
        if name != DIGEST
    ]


def what_is_wrong(path: Path, error: Exception) -> str:
    """Say in a sentence why a results file cannot be read.

    Parameters
    ----------
    path : Path
    error : Exception
        That reading it raised.
    """
    try:
        with path.open("rb") as file:
            start = file.read(len(_SIGNATURE))
    except OSError as reason:
        return f"cannot be read ({reason.strerror or reason})."
    if not start:
        return f"is damaged: it is empty; writing or copying it was cut short.{what_helps(path)}"
    if start != _SIGNATURE[: len(start)]:
        return (
            "is no results file of viscofric (netCDF); give the folder of a study's results, or the results.nc in it."
        )
    if (cut := _CUT.search(str(error))) is not None:
        return f"is damaged: only {cut[1]} of its {cut[2]} bytes are there.{what_helps(path)}"
    if len(start) < len(_SIGNATURE):
        return f"is damaged: only {len(start)} bytes of it are there.{what_helps(path)}"
    said = " ".join(str(error).split()) or type(error).__name__
    return f"is damaged: it cannot be read as netCDF ({said}).{what_helps(path)}"


def what_helps(path: Path) -> str:
    """Return what gives the results back, where finished cases lie beside them."""
    if any(path.parent.glob("cases/*.json")):
        return " The finished cases beside it are kept: running the study with --resume puts results together."
    return " Run the study again, or take a copy of the file."
