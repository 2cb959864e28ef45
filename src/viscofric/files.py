"""Files of users: opened with care, decoded from any instrument's encoding, written completely or not at all."""

from __future__ import annotations

import contextlib
import io
import json
import math
import os
import re
import stat
import tempfile
import zipfile
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from viscofric.errors import DataFileError, InputError, brief, not_written
from viscofric.notes import Note, note_of

if TYPE_CHECKING:
    from collections.abc import Iterable
    from os import PathLike

    import numpy as np
    from numpy.typing import NDArray

#: A table of measurements has a few million bytes.  A text of this size takes about 15 s and 1.4 GB to read.
LARGEST_TABLE = 50_000_000  # bytes
#: Heights of a surface in binary form, and viscofric's own files.
LARGEST_FILE = 200_000_000  # bytes
#: Largest size of an unpacked file, and largest ratio to its packed size.
LARGEST_UNPACKED = 500_000_000  # bytes
LARGEST_RATIO = 400
_SMALL = 10_000_000  # bytes, of any ratio
#: Dots in all keys, or texts, of TOML that have more than a few: the parser's time grows with the square of a key's.
_MOST_DOTS, _FEW_DOTS = 1000, 10
# One key of TOML with its dots, or one text; without a closing quotation mark it ends with its line, so that every
# character is scanned once.
_PART = r"""(?:[\w-]++|"(?:\\.|[^"\\\n])*+"?|'[^'\n]*+'?)"""
_KEY = re.compile(rf"{_PART}(?:[ \t]*+\.[ \t]*+{_PART})*+")
_HDF5 = b"\x89HDF\r\n\x1a\n"
# Below the space, but for tabs and ends of lines.
_CONTROL = re.compile(r"[\x00-\x08\x0e-\x1f]")
# In remarks of files, unless it is the kind of a substance, which may well be measured.
_SUBSTANCE = "(natural )?rubber|caoutchouc|elastomer|(poly)?isoprene|polymer|resin|fib(re|er)|leather|silica|graphite"
_FLUID = "(base )?oil|ester|grease|lubricant|sweat|sebum|saliva"
_SYNTHETIC = re.compile(rf"(?<!not )(?<!non-)\bsynthetic\b(?!\s+({_SUBSTANCE}|{_FLUID}))", re.IGNORECASE)
#: Beginnings of remarks, in tables and in material cards.
_MARKS = ("#", "%", "//", "!", "$", "**")
#: Code of the note on such files, by which a material that is made of them is synthetic, too.
SYNTHETIC = "synthetic"
_OF_ELEMENT = re.compile(r">([^<]+)<")
_REMARKED = 64_000  # bytes at the beginning of a file whose remarks say where its data come from


def file_path(path: object) -> Path:
    """Return the name of a file as a path, or raise `InputError` for anything else."""
    if not isinstance(path, (str, os.PathLike)):
        raise InputError(f"{brief(path)} is not the name of a file (text or a pathlib.Path).", code="not-a-name")
    if str(path) == "" or "\0" in str(path):
        raise DataFileError(brief(path), "is not the name of a file.", code="not-a-name")
    return Path(path)


def read_bytes(path: str | PathLike[str], most: int | None = None) -> bytes:
    """Return the content of a regular file of at most so many bytes, by default those of a table of measurements."""
    file = file_path(path)
    shown = str(path)
    try:
        status = file.stat()
        if stat.S_ISDIR(status.st_mode):
            raise DataFileError(shown, "is a folder, not a data file.", code="folder")
        if not stat.S_ISREG(status.st_mode):  # a device or a pipe may never end
            raise DataFileError(shown, "is a device or a pipe, not a data file.", code="not-a-file")
        if status.st_size > (most or LARGEST_TABLE):
            size, right = math.ceil(status.st_size / 1e6), (most or LARGEST_TABLE) / 1e6
            what = "such a file has" if most else "a table of measurements may have"
            hint = "" if most else "; keep every tenth row, for example, or divide it into several files"
            raise DataFileError(shown, f"holds {size} MB; {what} at most {right:.0f} MB{hint}.", code="too-large")
        return file.read_bytes()
    except FileNotFoundError:
        raise DataFileError(shown, "no such file.", code="no-file") from None
    except OSError as error:
        raise DataFileError(shown, f"cannot be opened ({error.strerror or error}).", code="not-opened") from None


def insist_on_short_text(data: bytes, path: str | PathLike[str]) -> None:
    """Refuse heights as long text, which takes far more time and memory to read than in binary form."""
    if len(data) > LARGEST_TABLE:
        size, right, binary = math.ceil(len(data) / 1e6), LARGEST_TABLE / 1e6, LARGEST_FILE / 1e6
        problem = f"holds {size} MB of text, at most {right:.0f} MB of which are read; save the heights with "
        raise DataFileError(path, f"{problem}numpy.save, as a file (.npy) of up to {binary:.0f} MB.", code="too-large")


#: Code pages of Windows in East Asia, and words of headings whose bytes no western text has.
_EASTERN = {
    "gb18030": ("温度", "频率", "模量", "速度", "摩擦"),
    "cp932": ("温度", "周波数", "弾性率", "速度", "摩擦"),
    "big5": ("溫度", "頻率"),
    "cp949": ("온도", "주파수"),
}


def decoded(data: bytes, path: str | PathLike[str]) -> str:
    """Return bytes as text (UTF-16 with its mark, UTF-8, else as Windows has it); binary ones are a `DataFileError`."""
    try:
        # some instruments end their UTF-16 with half a character
        wide = data.startswith((b"\xff\xfe", b"\xfe\xff"))
        text = data[: len(data) & ~1].decode("utf-16") if wide else data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Instrument software under Windows; bytes of its code pages are undefined.
        words = ((page, word) for page, some in _EASTERN.items() for word in some)
        page = next((page for page, word in words if word.encode(page) in data), "cp1252")
        text = data.decode(page, errors="replace")
    # Text has no control characters except tabs and ends of lines; workbooks and images have many.
    if _CONTROL.search(text):
        raise DataFileError(path, "is a binary file; a text table is needed (export it as CSV).", code="binary")
    return text


def read_text(path: str | PathLike[str], most: int | None = None) -> str:
    """Return a text file; see `read_bytes` and `decoded`."""
    return decoded(read_bytes(path, most), path)


def says_synthetic(path: str | PathLike[str]) -> bool:
    """Whether a file says of itself that it was not measured.

    A text does so in a remark (#, or as material cards have it) among its first lines, a workbook in a cell with such a
    remark or in its properties.
    """
    try:
        with file_path(path).open("rb") as file:
            data = file.read(_REMARKED)
        lines = _remarks_of_workbook(path) if data.startswith(b"PK") else decoded(data, path).splitlines()[:50]
    except (OSError, DataFileError, zipfile.BadZipFile):
        return False
    return any(_SYNTHETIC.search(line) for line in lines if line.startswith(_MARKS))


def on_synthetic(paths: Iterable[str | PathLike[str]]) -> list[Note]:
    """Return a note on files that say of themselves that they were not measured, none where no file does."""
    found = [Path(path).name for path in paths if says_synthetic(path)]
    named = f"{found[0]} says" if len(found) == 1 else f"{len(found)} files say"
    return [Note(SYNTHETIC, f"{named} that the data are synthetic: nothing was measured.")] if found else []


def of_synthetic(notes: Iterable[str]) -> tuple[Note, ...]:
    """Return those of some notes that say that nothing was measured, each once."""
    return tuple(dict.fromkeys(note for note in map(note_of, notes) if note.code == SYNTHETIC))


def on_source(source: str) -> list[Note]:
    """Return a note if the source of some data says that they are synthetic; see `marked`."""
    return [Note(SYNTHETIC, f"The data are synthetic ({source}).")] if _SYNTHETIC.search(source) else []


def _remarks_of_workbook(path: str | PathLike[str]) -> list[str]:
    """Return the first texts of the cells of a workbook, and its properties as remarks."""
    found = []
    with zipfile.ZipFile(path) as book:
        for name, start in (("docProps/core.xml", "#"), ("xl/sharedStrings.xml", "")):
            if name in book.namelist():
                with book.open(name) as part:
                    text = part.read(_REMARKED).decode("utf-8", errors="replace")
                found += [start + words for words in _OF_ELEMENT.findall(text)]
    return found


def marked(source: str, *, synthetic: bool) -> str:
    """Return where data come from, with a mark if they are synthetic; a file whose remarks have it says so."""
    return f"{source} (synthetic)" if synthetic and not _SYNTHETIC.search(source) else source


def parse_json(text: str | bytes, **options: Any) -> Any:
    """Return the content of JSON, or raise `ValueError` with a sentence; options are those of `json.loads`."""
    try:
        return json.loads(text, **options)
    except RecursionError:
        raise ValueError("lists or objects are nested too deeply") from None


def parse_toml(text: str) -> dict[str, Any]:
    """Return the content of TOML; `InputError` if it is nested too deeply, `ValueError` if it is not TOML."""
    import tomllib

    deep = InputError("lists or tables are nested too deeply", code="too-deep")
    dots = (key[0].count(".") for key in _KEY.finditer(text))
    if sum(count for count in dots if count > _FEW_DOTS) > _MOST_DOTS:
        raise deep
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise deep from None


def saved_array(data: bytes, path: str | PathLike[str]) -> NDArray[np.generic]:
    """Return the array of an .npy file; a damaged one, of objects, or larger than the file is a `DataFileError`."""
    import numpy as np

    file = io.BytesIO(data)
    try:
        version = np.lib.format.read_magic(file)
        read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
        shape, _, kind = read(file)
        if math.prod(shape) * kind.itemsize > len(data):
            raise ValueError(f"its header announces {math.prod(shape):.3g} numbers, more than it holds")
        file.seek(0)
        return np.asarray(np.load(file, allow_pickle=False))
    except (ValueError, OSError, EOFError, MemoryError, RecursionError, SyntaxError) as error:
        raise DataFileError(path, f"is not an array that NumPy can read ({error}).", code="damaged") from None


def insist_on_size(data: bytes, path: str | PathLike[str]) -> None:
    """Raise `DataFileError` for a zip archive or HDF5 that is damaged or unpacks to far more than measurements need."""
    try:
        if data.startswith(b"PK"):
            with zipfile.ZipFile(io.BytesIO(data)) as archive:
                parts = archive.infolist()
            sizes = sum(part.file_size for part in parts), sum(part.compress_size for part in parts)
        elif data.startswith(_HDF5) and find_spec("h5py") is not None:  # without it nobody reads such a file
            sizes = _unpacked(io.BytesIO(data)), len(data)
        else:
            return
    except Exception as error:  # noqa: BLE001 - damaged archives and HDF5 raise anything
        reason = (str(error).splitlines() or [type(error).__name__])[0][:120].rstrip(".")
        raise DataFileError(path, f"is damaged ({reason}).", code="damaged") from None
    size, packed = sizes
    if size > LARGEST_UNPACKED or announces_too_much(size, packed):
        raise DataFileError(
            path, f"would unpack to {size / 1e6:.0f} MB, far more than its size suggests.", code="too-large"
        )


def announces_too_much(size: int, packed: int) -> bool:
    """Whether a file of so many bytes (`packed`) cannot hold arrays of `size` bytes, if these are measured."""
    return size > _SMALL and size > LARGEST_RATIO * max(1, packed)


def _unpacked(file: io.BytesIO) -> int:
    """Return the number of bytes of the arrays of HDF5, or of their chunks if those are larger."""
    import h5py

    total = 0

    def count(_: str, node: object) -> None:
        nonlocal total
        if isinstance(node, h5py.Dataset) and node.shape is not None:
            chunk = math.prod(node.chunks) if node.chunks else 0
            total += node.dtype.itemsize * max(math.prod(node.shape), chunk)

    with h5py.File(file, "r") as opened:
        opened.visititems(count)
    return total


def _umask() -> int:
    """Return the process's file mode mask, which can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def sync_folder(folder: Path) -> None:
    """Have a folder's names on the disk, so that a power failure does not lose a renamed file; not on Windows."""
    if os.name == "nt":
        return
    with contextlib.suppress(OSError):  # some network folders refuse
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def write_atomically(path: Path, content: bytes, make_folder: bool = True) -> None:
    """Write a file through a temporary one in its folder, moved into place when complete.

    An existing file is replaced, and of a symbolic link the link itself.  If folder or file cannot be written,
    `DataFileError` is raised.
    """
    try:
        if make_folder:
            path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        temporary = Path(name)
        try:
            with os.fdopen(handle, "wb") as file:
                # Temporary files are private; this one gets the usual permissions.
                temporary.chmod(0o666 & ~_umask())
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            temporary.replace(path)
            sync_folder(path.parent)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise not_written(path, error) from error
