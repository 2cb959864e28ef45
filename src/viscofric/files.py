"""Files of users: opened with care, decoded whatever instrument wrote them, written whole or not at all."""

from __future__ import annotations

import os
import re
import stat
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from viscofric.errors import DataFileError, InputError, brief

if TYPE_CHECKING:
    from os import PathLike

#: A file of measurements is far smaller; what is larger was chosen by mistake.
LARGEST_FILE = 200_000_000  # bytes
# Below the space, but for tabs and ends of lines.
_CONTROL = re.compile(r"[\x00-\x08\x0e-\x1f]")


def file_path(path: object) -> Path:
    """Return the name of a file as a path; raise `InputError` where something else is given."""
    if not isinstance(path, (str, os.PathLike)):
        raise InputError(f"{brief(path)} is not the name of a file, which is text or a pathlib.Path.")
    if str(path) == "" or "\0" in str(path):
        raise DataFileError(brief(path), "is not the name of a file.")
    return Path(path)


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
    file = file_path(path)
    shown = str(path)
    try:
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
    if _CONTROL.search(text):
        raise DataFileError(path, "is a binary file; a text table is wanted (export it as CSV).")
    return text


def read_text(path: str | PathLike[str]) -> str:
    """Return a text file; see `read_bytes` and `decoded`."""
    return decoded(read_bytes(path), path)


def _umask() -> int:
    """Return the process's file mode mask, which can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def write_atomically(path: Path, content: bytes, make_folder: bool = True) -> None:
    """Write a file by way of a temporary one beside it, moved into place when it is complete.

    Parameters
    ----------
    path : Path
        Replaced if it exists; a symbolic link itself, not what it points to.
    content : bytes
    make_folder : bool
        Whether to make its folder where there is none.

    Raises
    ------
    DataFileError
        If the folder or the file cannot be written.
    """
    try:
        if make_folder:
            path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        temporary = Path(name)
        try:
            with os.fdopen(handle, "wb") as file:
                # Temporary files are for their owner alone; what is written here is to be handed on.
                temporary.chmod(0o666 & ~_umask())
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            temporary.replace(path)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise DataFileError(path, f"cannot be written ({error.strerror or error}).") from error
