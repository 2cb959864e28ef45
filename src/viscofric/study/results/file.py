"""The results file: written and opened as a whole, or refused; and what its groups hold."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import numpy as np

from viscofric.datasets import Dataset, DataTree
from viscofric.errors import DataFileError, InputError
from viscofric.files import file_path
from viscofric.study.results.netcdf import read_netcdf, write_netcdf

RESULTS_FILE = "results.nc"
PREDICTION = "prediction"
#: Keys of a run file that describe a study in words, and attributes of its results.
DESCRIBED = ("author", "sample", "comment", "citation", "licence")
#: Attributes of the root that a data set of the tree keeps: title and provenance.
_ABOUT = (
    "title",
    "data_origin",
    *DESCRIBED,
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


#: Groups of cases beside the prediction, in words.
OTHER_CASES = {"heating": "cases with heat", "history": "cases over time", "impact": "impacts"}


def cases_of(tree: DataTree, folder: Path) -> Dataset:
    """Return the predicted cases of results; see `StudyResults.dataset`."""
    if PREDICTION not in tree.children:
        words = "these results have no prediction of friction; they are of a material alone."
        raise InputError(f"{folder}: {words}", code="no-prediction")
    found = tree[PREDICTION].to_dataset()
    return found.assign_attrs({name: tree.attrs[name] for name in _ABOUT if name in tree.attrs})


def rubbers_of(tree: DataTree) -> dict[str, DataTree]:
    """Return the groups of each material by its name; see `StudyResults.materials`."""
    branches = tree.children.get("materials")
    if branches is None:
        return {str(tree.attrs.get("material", "")): tree}
    given = tree[PREDICTION].coords["material"].values.tolist() if PREDICTION in tree.children else []
    names = dict(enumerate(map(str, given), 1))
    return {names.get(int(number), number): branch for number, branch in branches.children.items()}


def open_tree(path: str | Path) -> tuple[DataTree, Path]:
    """Return the tree of results and their folder; see `open_results`."""
    file = file_path(path)
    if file.is_dir():
        file = file / RESULTS_FILE
        solved = 0 if file.is_file() else sum(1 for _ in file.parent.glob("cases/*.json"))
        if solved:
            raise DataFileError(
                file,
                f"no such file: the study has not been finished.  Contacts solved so far: {solved}.  Run it with "
                "--resume to complete it, or with --finished-only to store the results so far.",
                code="unfinished",
            )
    if not file.is_file():
        raise DataFileError(file, f"no such results file; {_where_they_are(file.parent)}", code="no-results")
    try:
        tree = read_netcdf(file.read_bytes(), "viscofric_version")
        found = None if tree is None else digest(tree)
    except Exception as error:  # the libraries raise many kinds, and the file is more informative
        raise what_is_wrong(file, error) from error
    if tree is None:
        raise DataFileError(file, "is a netCDF file, but not one of results of viscofric.", code="not-results")
    if not tree.children:
        raise DataFileError(
            file,
            "contains the cases only, as exported for other programs (xarray.open_dataset reads it); give the folder "
            "of the study's results.",
            code="exported",
        )
    if tree.attrs.get(DIGEST) != found:
        what = "its contents have changed" if DIGEST in tree.attrs else "its checksum is missing"
        raise DataFileError(file, f"is damaged: {what}.{what_helps(file)}", code="damaged")
    return tree, file.parent


def _where_they_are(folder: Path) -> str:
    """Return a hint for a folder without results."""
    near = sorted(other.parent for other in folder.glob(f"*/{RESULTS_FILE}"))
    return f"there are results in {near[0]}." if near else "run the study first."


def save_results(tree: DataTree, folder: Path) -> Path:
    """Write a tree to ``results.nc`` of a folder, as a whole or not at all."""
    target = folder / RESULTS_FILE
    tree.attrs[DIGEST] = digest(tree)
    write_netcdf(tree, target)
    return target


def digest(tree: DataTree) -> str:
    """Return a digest of all numbers, names and attributes: HDF5 does not notice zeros left by a power cut."""
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
    """Return attributes in plain types that are the same before writing and after reading."""
    return [
        [str(name), np.ravel(np.asarray(value)).tolist()]
        for name, value in sorted(attributes.items(), key=str)
        if name != DIGEST
    ]


def what_is_wrong(path: Path, error: Exception) -> DataFileError:
    """Return the reason why a results file cannot be read, given the error of reading it."""
    try:
        with path.open("rb") as file:
            start = file.read(len(_SIGNATURE))
    except OSError as reason:
        return DataFileError(path, f"cannot be read ({reason.strerror or reason}).", code="unreadable")
    if start and start != _SIGNATURE[: len(start)]:
        return DataFileError(
            path,
            "is not a results file of viscofric (netCDF); give a study's results folder, or the results.nc in it.",
            code="not-results",
        )
    if not start:
        why = "it is empty; writing or copying it was cut short."
    elif len(start) < len(_SIGNATURE):
        why = f"it has only {len(start)} bytes."
    else:
        words = getattr(error, "strerror", None) or " ".join(str(error).split()) or type(error).__name__
        why = f"it is incomplete, or its bytes have changed ({words})."
    return DataFileError(path, f"is damaged: {why}{what_helps(path)}", code="damaged")


def what_helps(path: Path) -> str:
    """Return how to restore the results."""
    if any(path.parent.glob("cases/*.json")):
        return " The solved contacts are kept: run the study with --resume to store the results again."
    return " Run the study again, or use a copy of the file."
