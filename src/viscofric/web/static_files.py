"""The page's own files: scripts, styles, pictures; packed once, and sent again only when they changed."""

from __future__ import annotations

import gzip
import hashlib
import mimetypes
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parent / "static"
_PACKED = {".html", ".css", ".js", ".svg", ".json", ".txt"}
_TYPES = {".js": "text/javascript", ".css": "text/css", ".html": "text/html", ".svg": "image/svg+xml"}
_WORTH_PACKING = 1_000  # bytes


class StaticFile(NamedTuple):
    """A file of the page.

    Parameters
    ----------
    content, packed : bytes
        As it is, and by gzip; the latter empty where it is not worth it.
    media_type : str
    tag : str
        Hash of the content.
    """

    content: bytes
    packed: bytes
    media_type: str
    tag: str


_known: dict[tuple[Path, int, int], StaticFile] = {}


def static_file(name: str) -> StaticFile | None:
    """Return a file by its place below the folder ``static``; None if there is none of that name.

    Only names that a listing of the folder gives are found, so that none leads out of it.
    """
    path = _listing().get(name)
    if path is None:
        return None
    status = path.stat()
    key = (path, status.st_mtime_ns, status.st_size)
    if key not in _known:
        content = path.read_bytes()
        packs = path.suffix in _PACKED and len(content) >= _WORTH_PACKING
        media_type = _TYPES.get(path.suffix) or mimetypes.guess_type(path.name)[0] or "application/octet-stream"
        if media_type.startswith("text/"):
            media_type += "; charset=utf-8"
        tag = f'"{hashlib.sha256(content).hexdigest()[:24]}"'
        _known[key] = StaticFile(content, gzip.compress(content, 6) if packs else b"", media_type, tag)
    return _known[key]


def _listing() -> dict[str, Path]:
    return {path.relative_to(ROOT).as_posix(): path for path in ROOT.rglob("*") if path.is_file()}
