"""[material] of a run file: where the rubber comes from, and how sweeps are made into one."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from viscofric.study.quantities import Table, Temperature, kelvin

#: Keys that say where the rubber comes from, one of them in every run file.
SOURCES = ("dma", "file", "catalogue")
#: Keys that say how sweeps are made into a rubber; without meaning for one that is ready.
_HOW = (
    "deformation",
    "temperature",
    "modulus_unit",
    "poisson_ratio",
    "vertical_shift",
    "shift",
    "shift_factors",
    "fixed_shift_factors",
    "spectrum",
    "modes",
    "tau_ratio",
)


def _listed(value: object) -> object:
    """Let one entry stand for a list of one."""
    return [value] if isinstance(value, str) else value


def _by_kelvin(value: object) -> object:
    """Turn the temperatures that are the keys of a table into K."""
    if not isinstance(value, dict):
        return value
    return {kelvin(key): entry for key, entry in value.items()}


class MaterialTable(Table):
    """[material]: the DMA files and how the rubber is made of them, or a rubber that is ready."""

    dma: Annotated[tuple[Path, ...], BeforeValidator(_listed), Field(min_length=1)] | None = None
    file: Path | None = None
    catalogue: str | None = None

    deformation: Literal["tension", "shear"] | None = None
    temperature: Annotated[tuple[Temperature, ...], BeforeValidator(_listed), Field(min_length=1)] | None = None
    modulus_unit: str | None = None
    poisson_ratio: float = Field(default=0.5, ge=0.0, le=0.5)
    reference_temperature: Temperature | None = None
    vertical_shift: Literal["none", "free", "density"] = "none"
    shift: Literal["measured", "best", "wlf", "arrhenius", "vft", "wlf+arrhenius", "polynomial"] = "measured"
    shift_factors: Path | None = None
    fixed_shift_factors: Annotated[dict[float, float], BeforeValidator(_by_kelvin)] = Field(default_factory=dict)
    spectrum: Literal["non-negative", "regularised", "sparse"] = "non-negative"
    modes: int | None = Field(default=None, ge=1, le=200)
    tau_ratio: float = Field(default=math.e, gt=1.0, le=100.0)

    @model_validator(mode="after")
    def _has_one_source(self) -> Self:
        given = [name for name in SOURCES if getattr(self, name) is not None]
        if not given:
            raise ValueError(
                'nothing says where the rubber comes from; give dma = "sweeps.csv" (or file = a material file, '
                "or catalogue = a name)"
            )
        if len(given) > 1:
            raise ValueError(f"{' and '.join(given)} are both given; the rubber comes from one of them")
        if self.dma is None:
            useless = [name for name in _HOW if name in self.model_fields_set]
            if useless:
                raise ValueError(f"{' and '.join(useless)} cannot be chosen for a rubber that is ready ({given[0]})")
        elif self.reference_temperature is None:
            raise ValueError('reference_temperature is missing; sweeps are shifted to it, e.g. "30 degC"')
        if self.shift_factors is not None and self.fixed_shift_factors:
            raise ValueError("shift_factors and fixed_shift_factors are both given; the first gives them all")
        if self.modes is not None and self.spectrum != "sparse":
            raise ValueError('modes is for spectrum = "sparse" only')
        return self

    def beside(self, folder: Path) -> MaterialTable:
        """Return the table with its paths relative to a folder, and patterns such as ``*.txt`` written out."""
        changes: dict[str, Any] = {}
        if self.dma is not None:
            changes["dma"] = tuple(path for one in self.dma for path in _found(folder, one))
        for name in ("file", "shift_factors"):
            if (path := getattr(self, name)) is not None:
                changes[name] = folder / path
        return self.model_copy(update=changes)

    @property
    def inputs(self) -> tuple[Path, ...]:
        """All files that the rubber comes from."""
        return (*(self.dma or ()), *(path for path in (self.file, self.shift_factors) if path is not None))


def _found(folder: Path, path: Path) -> tuple[Path, ...]:
    """Return the files that a path with ``*`` or ``?`` stands for, by name; the path itself if there are none."""
    whole = folder / path
    if not any(mark in str(path) for mark in "*?") or whole.exists():
        return (whole,)
    base = Path(whole.anchor) if path.is_absolute() else folder
    pattern = path.relative_to(path.anchor) if path.is_absolute() else path
    return tuple(sorted(found for found in base.glob(str(pattern)) if found.is_file())) or (whole,)
