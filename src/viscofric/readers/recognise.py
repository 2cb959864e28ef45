"""What kind of mechanical test a file holds: sweeps, temperature ramps, an amplitude sweep, creep or relaxation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Literal, TypeAlias

from viscofric.errors import DataFileError, InputError
from viscofric.readers.dma.ramps import read_amplitude_sweep, read_ramps
from viscofric.readers.dma.read import trace_dma
from viscofric.readers.source import Source, bytes_of, temperatures_of
from viscofric.readers.steps.columns import STEPS
from viscofric.readers.steps.read import step_kind
from viscofric.units import Quantity

#: Kinds of tests; all but the amplitude sweep are keys of [material].
TestKind: TypeAlias = Literal["dma", "ramps", "creep", "relaxation", "amplitude"]

#: Code of the error of `read_dma` -> the kind of test that the file holds instead.
_INSTEAD: dict[str, TestKind] = {
    "temperature-ramp": "ramps",
    "temperature-sweep": "ramps",
    "amplitude-sweep": "amplitude",
}


def kind_of_test(
    path: str | PathLike[str],
    *,
    temperature: Quantity | None = None,
    modulus_unit: str | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> TestKind:
    """Return the kind of test that a file holds, by its columns, steps and points, or raise `read_dma`'s error."""
    try:
        trace_dma(path, temperature=temperature, modulus_unit=modulus_unit, columns=columns, sheet=sheet)
    except InputError as error:
        if (instead := _INSTEAD.get(error.code)) is not None:
            return instead
        needless = error.code == "temperature-not-needed"
        if needless or "frequency" in error.note.values.get("known", {}):  # no creep, but a modulus called otherwise
            raise
        if (step := _step_kind(path, columns, sheet)) is not None:
            return step
        options = {"deformation": "tension", "modulus_unit": modulus_unit, "columns": columns, "sheet": sheet}
        for kind, read in (("amplitude", read_amplitude_sweep), ("ramps", read_ramps)):
            if _is_read(read, path, options):
                return kind  # type: ignore[return-value]
        raise
    return "dma"


def by_kind(
    paths: Sequence[Path],
    *,
    temperatures: Sequence[Quantity] = (),
    modulus_unit: str | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> dict[TestKind, list[Path]]:
    """Return files by the kind of test that they hold, in their order; sweeps may need several files to be such."""
    stated = {"modulus_unit": modulus_unit, "columns": columns, "sheet": sheet}
    each = temperatures_of(temperatures or None, len(paths))
    if len(paths) > 1:
        try:
            trace_dma(*paths, temperature=each, **stated)  # type: ignore[arg-type]
        except InputError:
            pass  # one by one
        else:
            return {"dma": [*paths]}
    found: dict[TestKind, list[Path]] = {}
    for path, temperature in zip(paths, each, strict=True):
        found.setdefault(kind_of_test(path, temperature=temperature, **stated), []).append(path)  # type: ignore[arg-type]
    return found


def _step_kind(path: str | PathLike[str], columns: Mapping[str, str] | None, sheet: str | None) -> TestKind | None:
    try:
        return step_kind(Source(str(path), bytes_of(str(path)), columns=STEPS.checked(columns), sheet=sheet or ""))
    except DataFileError as error:
        if error.code == "no-kind":
            raise
        return None
    except InputError:  # columns of other tests
        return None


def _is_read(read: object, path: str | PathLike[str], options: Mapping[str, object]) -> bool:
    try:
        read(path, **options)  # type: ignore[operator]
    except InputError:
        return False
    return True
