"""One file of heights, in whatever format its content tells."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.errors import DataFileError, InputError, brief, check_choice
from viscofric.files import file_path, read_bytes
from viscofric.readers.source import Source
from viscofric.readers.topography.package import read_with_package
from viscofric.readers.topography.tables import NUMPY, is_table, read_array, read_text_table
from viscofric.units import conversion

if TYPE_CHECKING:
    from viscofric.readers.topography.scan import Asked, Scan


def read_scan(path: object, asked: Asked) -> Scan:
    """Read a file of heights; its format is told by its content.

    Parameters
    ----------
    path : str or path
    asked : Asked

    Returns
    -------
    Scan

    Raises
    ------
    DataFileError
        If the file cannot be read, or does not say what is needed.
    InputError
        If what was asked makes no sense.
    """
    check_choice(asked.lines, "lines", "x", "y")
    if asked.unit:
        conversion(asked.unit, "m", "unit")
    if not (asked.channel is None or isinstance(asked.channel, (str, int))):
        raise InputError(f"channel = {brief(asked.channel)}: must be the name of a channel or its number.")
    file = str(file_path(path))
    source = Source(file, read_bytes(file))
    try:
        if source.data.startswith(NUMPY):
            return read_array(source, asked)
        if is_table(source.text):
            return read_text_table(source, asked)
        return read_with_package(source, asked)
    except DataFileError:
        raise
    except InputError as error:  # a unit that the file names, and that is none
        raise DataFileError(file, str(error)) from None
