"""One file of heights, whose format is recognised by its content."""

from __future__ import annotations

from viscofric.errors import DataFileError, InputError, check_choice, wrong_argument
from viscofric.files import LARGEST_FILE, file_path, insist_on_short_text, read_bytes
from viscofric.readers.source import Source
from viscofric.readers.topography.package import read_with_package
from viscofric.readers.topography.scan import Scan, ScanOptions
from viscofric.readers.topography.tables import NUMPY, is_table, read_array, read_text_table
from viscofric.units import conversion


def read_scan(path: object, options: ScanOptions) -> Scan:
    """Read a file of heights, whose format is recognised by its content."""
    check_choice(options.lines, "lines", "x", "y")
    if not isinstance(options.unit, str):
        raise wrong_argument("unit", options.unit, "must be text, such as 'um'.", "not-text")
    if options.unit:
        conversion(options.unit, "m", "unit")
    if not (options.channel is None or isinstance(options.channel, (str, int))):
        raise wrong_argument("channel", options.channel, "must be the name of a channel or its number.", "no-channel")
    file = str(file_path(path))
    source = Source(file, read_bytes(file, LARGEST_FILE))
    if not source.data:
        raise DataFileError(file, "is empty.", code="empty")
    try:
        plain = source.data.startswith(NUMPY) or is_table(source)
        if plain and options.channel not in (None, 0):
            raise DataFileError(
                file,
                f"contains one field of heights, without a name; leave channel = {options.channel!r} out.",
                code="no-channel",
            )
        if source.data.startswith(NUMPY):
            return read_array(source, options)
        if plain:
            insist_on_short_text(source.data, file)
        return read_text_table(source, options) if plain else read_with_package(source, options)
    except DataFileError:
        raise
    except InputError as error:  # the file's unit is not one of length
        raise DataFileError(file, error.note) from None
