"""Options that fix the level of an identified modulus: a modulus, or the size of a contact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.friction.identification.anchors import Anchor

_SIZES = ("indentation", "area", "half_width")
#: What an anchor takes besides the modulus or the size.
_OF_MODULUS, _OF_SIZE = ("frequency", "temperature"), ("speed", "temperature", "load")

_OPTIONS = (
    click.option(
        "--anchor-modulus", metavar="E", help="Known |E| at one frequency, e.g. '8 MPa'; fixes the magnitude."
    ),
    click.option("--anchor-frequency", metavar="F", help="Frequency of --anchor-modulus, e.g. '1 Hz' or '6.28 rad/s'."),
    click.option(
        "--anchor-indentation", metavar="DEPTH", help="Alternative: measured indentation of a moving contact."
    ),
    click.option(
        "--anchor-area", metavar="AREA", help="Alternative: contact area of a moving contact, e.g. '12 mm^2'."
    ),
    click.option("--anchor-half-width", metavar="LENGTH", help="Alternative: contact half-width across the motion."),
    click.option("--anchor-speed", metavar="V", help="Speed of the anchor contact, e.g. '100 mm/s'."),
    click.option("--anchor-load", metavar="F", help="Load of the anchor contact, e.g. '25 N'."),
    click.option("--anchor-temperature", metavar="T", help="Temperature of the anchor, e.g. '30 degC'."),
    click.option(
        "--anchor-error", type=float, metavar="SHARE", help="Relative standard error of the anchor [default: 0.01]."
    ),
)


def anchor_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of an anchor."""
    for option in reversed(_OPTIONS):
        function = option(function)
    return function


def check_anchor(asked: dict[str, Any]) -> str | None:
    """Return which modulus or size the anchor is of, or None without one.

    Raises
    ------
    click.UsageError
        If there is more than one, or something of it is missing or too much.
    """
    given = {name for name in ("modulus", *_SIZES, *_OF_MODULUS, *_OF_SIZE, "error") if _of(asked, name) is not None}
    what = [name for name in ("modulus", *_SIZES) if name in given]
    if not what:
        if given:
            raise click.UsageError(f"{_typed(min(given))} is of an anchor; give --anchor-modulus or a contact's size.")
        return None
    if len(what) > 1:
        raise click.UsageError(f"{_typed(what[0])} and {_typed(what[1])} are both given; one anchor is enough.")
    needed = _OF_MODULUS if what == ["modulus"] else _OF_SIZE
    for name in needed:
        if name not in given:
            raise click.UsageError(f"{_typed(what[0])} needs {_typed(name)} too.")
    useless = given - {*what, *needed, "error"}
    if useless:
        raise click.UsageError(f"{_typed(min(useless))} does not belong to {_typed(what[0])}.")
    return what[0]


def make_anchor(asked: dict[str, Any], what: str, load_unit: str) -> Anchor:
    """Return the anchor that was asked for and checked; a load is in N, or of a line contact in N/m.

    Raises
    ------
    InputError
        If a quantity cannot be used.
    """
    from viscofric.friction.identification.anchors import ContactAnchor, ModulusAnchor
    from viscofric.units import positive, to_si

    told: dict[str, Any] = {} if asked["anchor_error"] is None else {"error": asked["anchor_error"]}
    if what == "modulus":
        return ModulusAnchor(_of(asked, "modulus"), *(_of(asked, name) for name in _OF_MODULUS), **told)
    told |= {name: _of(asked, name) for name in _OF_SIZE}
    told["load"] = positive(told["load"], load_unit, "--anchor-load")
    if what == "area":
        return ContactAnchor(contact_area=to_si(_of(asked, "area"), "m**2", "--anchor-area"), **told)
    return ContactAnchor(**{what: _of(asked, what)}, **told)


def _of(asked: dict[str, Any], name: str) -> Any:
    return asked[f"anchor_{name}"]


def _typed(name: str) -> str:
    return f"--anchor-{name.replace('_', '-')}"
