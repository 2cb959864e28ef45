"""What a job is handed besides the study: its folders, and how it tells of progress and of parts of its result."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

from viscofric.errors import ViscofricError
from viscofric.notes import Note

if TYPE_CHECKING:
    from pathlib import Path

_BETWEEN_TOLD = 0.05  # s, of progress: a browser shows no more
_EXACT = 22  # powers of ten up to this one are exact as floats


class JobError(ViscofricError):
    """What keeps a job from being done, in one sentence, with the field of the study that it is about.

    Parameters
    ----------
    message : str or Note
    field : str, optional
        Path in the study, such as ``conditions.load``.
    """

    def __init__(self, message: str | Note, field: str | None = None) -> None:
        super().__init__(message, field=field)


def beside_field(problem: Note) -> dict[str, str]:
    """Return what the page writes beside the field that a problem is about."""
    words = Note(problem.code, problem.text, remedy=problem.remedy).words("page")
    return {"field": problem.where, "message": words[:1].upper() + words[1:]}


def plain(value: Any, digits: int | None = 6) -> Any:
    """Return a value as JSON can hold it.

    Parameters
    ----------
    value : object
        Of dicts, lists, tuples, NumPy arrays and scalars, numbers, text, truth values, None, paths.
    digits : int, optional
        Significant ones that floats are rounded to; None: all.

    Returns
    -------
    object
        Dicts, lists, int, float, str, bool and None; what is not finite is None.
    """
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, float):
        return _rounded(value, digits)
    if isinstance(value, Mapping):
        return {str(key): plain(entry, digits) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        if value and all(type(entry) is float for entry in value):
            import numpy as np

            return _of_array(np.array(value), digits)
        return [plain(entry, digits) for entry in value]
    if hasattr(value, "__array__"):
        import numpy as np

        return _of_array(np.asarray(value), digits)
    if isinstance(value, (set, frozenset)):
        return [plain(entry, digits) for entry in sorted(value)]
    return str(value)


def _rounded(value: float, digits: int | None) -> float | None:
    if not math.isfinite(value):
        return None
    return float(value) if digits is None else float(f"{value:.{digits}g}")


def _of_array(values: Any, digits: int | None) -> Any:
    import numpy as np

    if values.dtype.kind != "f":
        return plain(values.tolist(), digits)
    values = values.astype(float)
    finite = np.isfinite(values)
    if digits is not None:
        values = _significant(np.where(finite, values, 0.0), digits)
    if finite.all():
        return values.tolist()
    shown: Any = np.array(values, dtype=object)
    shown[~finite] = None
    return shown.tolist()


def _significant(values: Any, digits: int) -> Any:
    """Round to significant digits, so that the shortest way of writing the results has no more."""
    import numpy as np

    size = np.abs(values)
    power = digits - 1 - np.floor(np.log10(np.where(size > 0.0, size, 1.0)))
    if np.any(np.abs(power) > _EXACT):
        return np.vectorize(partial(_rounded, digits=digits), otypes=[float])(values)
    # multiplied and divided by exact powers only: 123457 / 1e-3 would not be 123457000
    up, down = 10.0 ** np.maximum(power, 0.0), 10.0 ** np.maximum(-power, 0.0)
    return np.round(values * up / down) / up * down


@dataclass
class Context:
    """What a job is handed.

    Parameters
    ----------
    files : Path
        Folder of what the user uploaded; file names in the study are relative to it.
    downloads : Path
        Folder for what the user may fetch, at ``/api/downloads/<name>``.
    cache : Path
        Folder for what later jobs of the same page can use again.
    tell : callable, optional
        Called with the event (``"progress"`` or ``"part"``) and what it says.
    """

    files: Path
    downloads: Path
    cache: Path
    tell: Callable[[str, dict[str, Any]], object] = lambda event, message: None
    _told: float = field(default=-math.inf, repr=False)

    plain = staticmethod(plain)

    def progress(self, done: float, total: float, label: str = "") -> None:
        """Say how much of the work is done; may be called as often as one likes."""
        now = time.monotonic()
        if now - self._told >= _BETWEEN_TOLD or done >= total:
            self._told = now
            self.tell("progress", {"done": plain(done), "total": plain(total), "label": label})

    def part(self, part: dict[str, Any]) -> None:
        """Hand over a part of the result that can be shown already."""
        self.tell("part", {"part": part})
