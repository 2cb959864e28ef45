"""The formats of traction files that are known, and which of them a file is, told by its content."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.errors import DataFileError
from viscofric.readers.mtm import delimited, pcs_text

if TYPE_CHECKING:
    from viscofric.readers.mtm.readings import Thermometer, TractionReadings
    from viscofric.readers.source import Source


def read(source: Source, thermometer: Thermometer) -> TractionReadings:
    """Return the readings of a file.

    Raises
    ------
    DataFileError
        If the file is empty or binary, or cannot be read as what it is.
    """
    if not source.data.strip(b"\0 \t\r\n\xef\xbb\xbf\xff\xfe"):
        raise DataFileError(source.path, "the file is empty; it must hold a header and rows of numbers.")
    if pcs_text.recognises(source):
        return pcs_text.read(source, thermometer)
    if source.text is None:
        what = f"what can be read: {pcs_text.NAME} and {delimited.NAME}"
        raise DataFileError(source.path, f"is a binary file of no known kind; {what}.")
    return delimited.read(source)


def name_of(source: Source) -> str:
    """Return what a file is taken for, in words."""
    return pcs_text.NAME if pcs_text.recognises(source) else delimited.NAME
