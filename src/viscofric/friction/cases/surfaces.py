"""Rough surfaces of a study as descriptions: small enough to send to every process, which computes the heights."""

from __future__ import annotations

import difflib
import functools
import hashlib
import math
import re
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

import numpy as np
import scipy.fft

from viscofric.contact.periodic.surface import PeriodicSurface, wave_number
from viscofric.errors import DataFileError, InputError, brief
from viscofric.notes import Note, note_of
from viscofric.roughness.made import self_affine
from viscofric.roughness.reading import read_topography
from viscofric.roughness.topography import Topography
from viscofric.units import positive, to_si

#: Complementarity of rough surfaces: far below the discretisation error of friction, at any accuracy.
TOLERANCE = 1e-7
# Surfaces that a process keeps: one of 2048² points takes 34 MB.
_KEPT = 2
#: Part of the mean square curvature that is no wave: heights in a file are rounded.
_ROUNDED = 1e-6


@dataclass(frozen=True)
class MadeSurface:
    """A self-affine surface, SI; see `viscofric.self_affine`."""

    hurst: float
    points: tuple[int, int]  # along x and y; one point along y for a profile
    spacing: tuple[float, float]  # m
    seed: int
    shortest: float  # wavelengths, m
    longest: float | None = None
    rolloff: float | None = None
    rms_height: float | None = None  # m; this or the slope
    rms_slope: float | None = None
    aspect: float = 1.0  # of the lay
    angle: float = 0.0  # rad
    exact: bool = True

    def topography(self) -> Topography:
        """Return the heights."""
        values = asdict(self)
        hurst, points = values.pop("hurst"), values.pop("points")
        return self_affine(hurst, shape=points, **values)

    def described(self) -> list[object]:
        """Return everything that determines the heights, in plain types."""
        return ["made", asdict(self)]

    @property
    def shape(self) -> tuple[int, int]:
        """Points along x and y."""
        return self.points

    @property
    def wavelengths(self) -> tuple[float, float]:
        """The shortest and the longest, m."""
        period = max(n * d for n, d in zip(self.points, self.spacing, strict=True) if n > 1)
        return self.shortest, period if self.longest is None else min(self.longest, period)


@dataclass(frozen=True)
class ScannedSurface:
    """A measured surface; see `viscofric.read_topography`."""

    path: Path
    digest: str  # SHA-256 of the file
    steps: tuple[str, ...] = ()  # of preparation; see `step_of`
    unit: str = ""  # this and the following as far as the file does not state them
    spacing: tuple[float, float] | None = None
    channel: str | int | None = None
    missing: float | None = None
    lines: Literal["x", "y"] = "x"

    def topography(self) -> Topography:
        """Return the prepared heights; raise `DataFileError` if the file changed since the study began."""
        if file_digest(self.path) != self.digest:
            raise DataFileError(
                self.path, "was changed while the study ran; run it again with --resume.", code="changed"
            )
        names = ("unit", "spacing", "channel", "missing", "lines")
        given: dict[str, Any] = {name: getattr(self, name) for name in names}
        found = read_topography(self.path, **given)
        for words in self.steps:
            found = step_of(words)(found)
        return found

    def described(self) -> list[object]:
        """Return everything that determines the heights, in plain types: the file's content, not its name."""
        values = asdict(self)
        del values["path"]
        return ["scanned", values]

    @property
    def shape(self) -> tuple[int, int]:
        """Points along x and y."""
        return surface_of(self).shape

    @property
    def wavelengths(self) -> tuple[float, float]:
        """The shortest that its heights have, and the longest that its points can represent, m."""
        return _wavelengths_of(self)


SurfaceSource: TypeAlias = MadeSurface | ScannedSurface


@functools.lru_cache(maxsize=_KEPT)
def surface_of(source: SurfaceSource) -> PeriodicSurface:
    """Return the surface of contacts, made once for many; InputError or DataFileError if it cannot be made."""
    return source.topography().to_surface()


@functools.lru_cache(maxsize=_KEPT)
def _wavelengths_of(source: ScannedSurface) -> tuple[float, float]:
    surface = surface_of(source)
    q = np.hypot(*wave_number(surface.shape, surface.spacing)).ravel()
    order = np.argsort(q)[::-1]
    shorter = np.cumsum((q**4 * np.square(np.abs(scipy.fft.rfft2(surface.z))).ravel())[order])
    first = order[int(np.argmax(shorter >= _ROUNDED * shorter[-1]))]
    along = [place for place, n in enumerate(surface.shape) if n > 1]
    least = 2.0 * min(surface.spacing[place] for place in along)
    return max(least, 2.0 * math.pi / float(q[first])), max(surface.period[place] for place in along)


@functools.lru_cache(maxsize=_KEPT)
def notes_on(source: SurfaceSource) -> tuple[Note, ...]:
    """Return what was assumed, doubted and changed in reading and preparing a measured surface."""
    if isinstance(source, MadeSurface):
        return ()
    return tuple(note for note in map(note_of, source.topography().history) if note.code)


def file_digest(path: Path) -> str:
    """Return the SHA-256 of a file; DataFileError if it cannot be read."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except FileNotFoundError:
        raise DataFileError(path, "no such file.", code="no-file") from None
    except (OSError, ValueError) as error:
        raise DataFileError(
            path, f"cannot be read ({getattr(error, 'strerror', None) or error}).", code="unreadable"
        ) from None


def unit_vector(angle: float) -> tuple[float, float]:
    """Return the direction of a motion at an angle from x towards y, rad; exact along the axes."""
    quarters = angle / (0.5 * math.pi)
    if quarters == round(quarters):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarters) % 4]
    return math.cos(angle), math.sin(angle)


_Applied: TypeAlias = Callable[["Topography"], "Topography"]

#: Name of a step -> an example.
STEPS = {
    "fill": "fill",
    "remove": "remove tilt",
    "window": "window",
    "mirror": "mirror",
    "periodic": "periodic",
    "shortest": "shortest 40 um",
    "longest": "longest 1 mm",
    "resample": "resample 5 um",
    "crop": "crop x 0 um to 200 um",
    "inverted": "inverted",
    "along y": "along y",
}
_LONGEST_STEP = 100
#: Words that follow a step; filling is harmonic by default.
_CHOICES = {"fill": ("harmonic", "nearest"), "remove": ("mean", "tilt", "curvature")}


def step_of(words: str) -> _Applied:
    """Return the function of a preparation step on a topography; `words` is its name with arguments: see `STEPS`."""
    name, rest = _parted(words)
    chosen: Any = rest or ("harmonic" if name == "fill" else "")
    if name in _CHOICES and chosen not in _CHOICES[name]:
        *most, last = (f"'{name} {one}'" for one in _CHOICES[name])
        raise _wrong_step(name, rest, f"expected {', '.join(most)} or {last}")
    match name:
        case "fill":
            return lambda one: one.fill(chosen)
        case "remove":
            return lambda one: one.remove(chosen)
        case "window":
            edge = _edge(rest)
            return lambda one: one.window(edge)
        case "crop":
            axis, ends = _ends(rest)
            return lambda one: one.crop(**{axis: ends})
        case "resample" | "shortest" | "longest":
            if not rest:
                raise InputError(f"'{name}' needs a length, such as '{STEPS[name]}'", code="wrong-step")
            length = positive(rest, "m", name)
            if name == "resample":
                return lambda one: one.resample(length)
            return lambda one: one.keep_wavelengths(**{name: length})
    if rest:
        raise _wrong_step(name, rest, f"'{name}' takes no argument")
    alone: dict[str, _Applied] = {
        "mirror": lambda one: one.mirror(),
        "periodic": _as_period,
        "inverted": lambda one: one.inverted(),
        "along y": lambda one: one.along_y(),
    }
    return alone[name]


def _parted(words: str) -> tuple[str, str]:
    """Return the name of a step and its arguments."""
    said = " ".join(words.split())
    for name in STEPS:
        if said == name or said.startswith(f"{name} "):
            return name, said.removeprefix(name).strip()
    near = difflib.get_close_matches(said[:_LONGEST_STEP], [*STEPS, *STEPS.values()], n=1, cutoff=0.5)
    hint = f"did you mean '{near[0]}'?" if near else f"expected {', '.join(repr(one) for one in STEPS.values())}"
    raise InputError(f"{brief(words)} is not a preparation step; {hint}", code="wrong-step")


def _wrong_step(name: str, rest: str, why: str) -> InputError:
    return InputError(f"{brief(f'{name} {rest}')}: {why}", code="wrong-step")


def _edge(rest: str) -> float:
    """Return the part of each length over which a window rises, 0.1 if none is given."""
    try:
        edge = float(rest) if rest else 0.1
    except ValueError:
        edge = -1.0
    if not 0.0 < edge <= 0.5:
        raise _wrong_step("window", rest, "expected a fraction of each length up to 0.5, such as 'window 0.1'")
    return edge


def _ends(rest: str) -> tuple[str, tuple[float, float]]:
    """Return the axis along which a scan is cropped, and the two ends, m."""
    found = re.fullmatch(r"([xy]) (.+) to (.+)", rest)
    if found is None:
        raise _wrong_step("crop", rest, f"expected '{STEPS['crop']}'")
    first, last = (to_si(text, "m", "crop") for text in found.groups()[1:])
    return found[1], (first, last)


def _as_period(one: Topography) -> Topography:
    said = Note("taken-as-period", "taken as one period of the surface")
    return Topography(one.heights, one.spacing, True, one.name, (*one.history, said))
