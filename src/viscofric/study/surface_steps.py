"""Steps that prepare a measured surface, as a run file writes them, such as "remove tilt"."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

from viscofric.errors import InputError, brief
from viscofric.units import positive, to_si

if TYPE_CHECKING:
    from viscofric.roughness.topography import Topography

_Applied: TypeAlias = Callable[["Topography"], "Topography"]

#: First words of a step -> what they may be followed by, and an example.
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
_FILL, _REMOVE = ("harmonic", "nearest"), ("mean", "tilt", "curvature")


def step_of(words: str) -> _Applied:
    """Return what a step does to a topography.

    Parameters
    ----------
    words : str
        Its name, and what it needs beside: see `STEPS`.

    Raises
    ------
    InputError
        If it is no step, or what stands behind its name cannot be used.
    """
    name, rest = _parted(words)
    known: dict[str, Callable[[str], _Applied]] = {
        "fill": _fill,
        "remove": _remove,
        "window": _window,
        "resample": lambda rest: _length("resample", rest, lambda one, step: one.resample(step)),
        "shortest": lambda rest: _length("shortest", rest, lambda one, cut: one.keep_wavelengths(shortest=cut)),
        "longest": lambda rest: _length("longest", rest, lambda one, cut: one.keep_wavelengths(longest=cut)),
        "crop": _crop,
        "mirror": lambda rest: _alone("mirror", rest, lambda one: one.mirror()),
        "periodic": lambda rest: _alone("periodic", rest, _as_period),
        "inverted": lambda rest: _alone("inverted", rest, lambda one: one.inverted()),
        "along y": lambda rest: _alone("along y", rest, lambda one: one.along_y()),
    }
    return known[name](rest)


def _parted(words: str) -> tuple[str, str]:
    """Return the name of a step and what follows it."""
    said = " ".join(words.split())
    for name in STEPS:
        if said == name or said.startswith(f"{name} "):
            return name, said.removeprefix(name).strip()
    near = difflib.get_close_matches(said[:_LONGEST_STEP], [*STEPS, *STEPS.values()], n=1, cutoff=0.5)
    hint = f"did you mean '{near[0]}'?" if near else f"right would be {', '.join(repr(one) for one in STEPS.values())}"
    raise InputError(f"{brief(words)} is no step of preparation; {hint}")


def _alone(name: str, rest: str, applied: _Applied) -> _Applied:
    if rest:
        raise InputError(f"{brief(f'{name} {rest}')}: '{name}' stands alone")
    return applied


def _fill(rest: str) -> _Applied:
    method: Any = rest or _FILL[0]
    if method not in _FILL:
        raise InputError(f"{brief(f'fill {rest}')}: missing heights are filled 'harmonic' or 'nearest'")
    return lambda one: one.fill(method)


def _remove(rest: str) -> _Applied:
    what: Any = rest
    if what not in _REMOVE:
        raise InputError(
            f"{brief(f'remove {rest}')}: right would be 'remove mean', 'remove tilt' or 'remove curvature'"
        )
    return lambda one: one.remove(what)


def _window(rest: str) -> _Applied:
    try:
        edge = float(rest) if rest else 0.1
    except ValueError:
        edge = -1.0
    if not 0.0 < edge <= 0.5:
        raise InputError(f"{brief(f'window {rest}')}: right would be a share of each length, as in 'window 0.1'")
    return lambda one: one.window(edge)


def _length(name: str, rest: str, applied: Callable[[Topography, float], Topography]) -> _Applied:
    if not rest:
        raise InputError(f"'{name}' needs a length, such as '{STEPS[name]}'")
    value = positive(rest, "m", name)
    return lambda one: applied(one, value)


def _crop(rest: str) -> _Applied:
    found = re.fullmatch(r"([xy]) (.+) to (.+)", rest)
    if found is None:
        raise InputError(f"{brief(f'crop {rest}')}: right would be '{STEPS['crop']}'")
    first, last = (to_si(text, "m", "crop") for text in found.groups()[1:])
    if found[1] == "x":
        return lambda one: one.crop(x=(first, last))
    return lambda one: one.crop(y=(first, last))


def _as_period(one: Topography) -> Topography:
    from viscofric.roughness.topography import Topography

    return Topography(one.heights, one.spacing, True, one.name, (*one.history, "taken as one period of the surface"))
