"""Whether stored results are whole: a digest of all that they hold, and words for what is wrong with a file."""

from __future__ import annotations

import hashlib
import json
import re
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from pathlib import Path

    import xarray

#: Attribute of the root with the digest of everything else.
DIGEST = "content_sha256"
_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_CUT = re.compile(r"truncated file: eof = (\d+),.*stored_eof = (\d+)")


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
