"""Files as users hand them over: opened with care, limited in size, decoded whatever instrument wrote them."""

from __future__ import annotations

import stat
from pathlib import Path
from typing import TYPE_CHECKING

from viscofric.errors import DataFileError

if TYPE_CHECKING:
    from os import PathLike

#: A file of measurements is far smaller; what is larger was chosen by mistake.
LARGEST_FILE = 200_000_000  # bytes


def read_bytes(path: str | PathLike[str]) -> bytes:
    """Return what a regular file holds.

    Parameters
    ----------
    path : str or path
        The file.

    Raises
    ------
    DataFileError
        If there is no such file, it cannot be opened, is a folder, device or pipe, or is too large.
    """
    shown = str(path)
    try:
        file = Path(path)
        status = file.stat()
        if stat.S_ISDIR(status.st_mode):
            raise DataFileError(shown, "is a folder, not a data file.")
        if not stat.S_ISREG(status.st_mode):  # a device or a pipe may never end
            raise DataFileError(shown, "is a device or a pipe, not a data file.")
        if status.st_size > LARGEST_FILE:
            size, most = status.st_size / 1e6, LARGEST_FILE / 1e6
            raise DataFileError(shown, f"holds {size:.0f} MB; a table of measurements has at most {most:.0f} MB.")
        return file.read_bytes()
    except FileNotFoundError:
        raise DataFileError(shown, "no such file.") from None
    except ValueError as error:
        if isinstance(error, DataFileError):
            raise
        raise DataFileError(shown.replace("\0", "\\0"), f"is not the name of a file ({error}).") from None
    except OSError as error:
        raise DataFileError(shown, f"cannot be opened ({error.strerror or error}).") from None


def decoded(data: bytes, path: str | PathLike[str]) -> str:
    """Return bytes as text: UTF-16 with its mark, UTF-8 with or without, else Windows-1252.

    Parameters
    ----------
    data : bytes
        What the file holds.
    path : str or path
        Named in errors.

    Raises
    ------
    DataFileError
        If it is no text.
    """
    try:
        text = data.decode("utf-16") if data.startswith((b"\xff\xfe", b"\xfe\xff")) else data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Instrument software under Windows; the five bytes that its code page leaves open stand for no letter.
        text = data.decode("cp1252", errors="replace")
    # Text has no control characters but tabs and ends of lines; a workbook or an image is full of them.
    if any(ord(character) < 32 and character not in "\t\r\n\f\v" for character in text):
        raise DataFileError(path, "is a binary file; a text table is wanted (export it as CSV).")
    return text


def read_text(path: str | PathLike[str]) -> str:
    """Return a text file; see `read_bytes` and `decoded`."""
    return decoded(read_bytes(path), path)
