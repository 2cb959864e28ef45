"""Options of a contact: the indenter, and the settings of the solver."""

from __future__ import annotations

import math
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click
import numpy as np

from viscofric.cli.commands import CONTACT, Decorator, quantity, together
from viscofric.cli.errors import placed_at, print_notes, typed_as
from viscofric.cli.files import FILE
from viscofric.cli.keys import key
from viscofric.cli.speed_options import list_of

if TYPE_CHECKING:
    from viscofric.roughness.topography import Topography

_SMOOTH = (
    quantity("--ball", "RADIUS", "Ball radius, e.g. '9.525 mm'."),
    quantity("--cylinder", "RADIUS", "Cylinder radius (axis across the motion; line contact, load per unit length)."),
    quantity("--ellipsoid", "RX,RY", "Ellipsoid: radii of curvature along x (the default direction of motion) and y."),
    quantity("--cone", "ANGLE", "Cone: angle between flank and surface, e.g. '5 deg'."),
)
_PUNCH = quantity("--punch", "RADIUS", "Radius of a flat circular punch with a sharp edge; not for sliding.")
_HEIGHTS = (
    click.option(
        "--height-map",
        type=FILE,
        help="Heights of the indenter above its lowest point, which touches first; one line of the file per position "
        "along the motion. Invert the scan of a surface whose summits touch.",
    ),
    click.option(
        "--profile", type=FILE, help="As --height-map, one column of heights along the motion (line contact)."
    ),
    quantity(
        "--spacing",
        "LENGTH",
        "Spacing of the heights if the file does not state it: '5 um', or '5 um,10 um' along and across.",
    ),
    click.option(
        "--height-unit", metavar="UNIT", help="Unit of the heights if the file does not state it [default: m]."
    ),
)
indenter_options = together(*_SMOOTH, _PUNCH, *_HEIGHTS, heading="Indenter")
#: Of contacts in motion, for which a sharp edge is refused.
sliding_indenter_options = together(*_SMOOTH, *_HEIGHTS, heading="Indenter")
#: Option -> class of `viscofric.contact.indenters.shapes` that it makes.
KINDS = {"ball": "Ball", "cylinder": "Cylinder", "ellipsoid": "Ellipsoid", "cone": "Cone", "punch": "FlatPunch"}
#: Options, one of which says what shape it is.
SHAPES = (*KINDS, "height_map", "profile")
surface_options = together(
    click.option(
        "--surface",
        type=FILE,
        help="Measured rough surface instead of an indenter, one period of it; --spacing and --height-unit if the file "
        "does not state them.",
    ),
    click.option(
        "--prepare",
        multiple=True,
        metavar="STEP",
        help="With --surface: preparation step, such as 'remove tilt', 'window' or 'shortest 40 um'; repeatable.",
    ),
    heading="Rough surface",
)


def option(name: str) -> str:
    """Return an option as it is typed."""
    typed = {"rubber_modulus": "E0", "glass_modulus": "E-inf", "columns": "column"}
    return "--" + typed.get(name, name.replace("_", "-"))


class NamedIndenter(NamedTuple):
    """An indenter or a rough surface, and what it is in words and in plain types."""

    indenter: Any
    words: str
    record: dict[str, Any]


def chosen_indenter(parameters: dict[str, Any]) -> NamedIndenter:
    """Return the indenter that the options name."""
    offered = [name for name in SHAPES if name in parameters]
    given = [name for name in offered if parameters[name] is not None]
    if len(given) != 1:
        if not given:
            raise click.UsageError(f"no indenter is given; give {', '.join(map(option, offered))}.")
        raise click.UsageError(f"{' and '.join(map(option, given))} are both given; there is one indenter.")
    (shape,) = given
    if shape in ("height_map", "profile"):
        return _mapped(shape, parameters)
    for name in ("spacing", "height_unit"):
        if parameters[name] is not None:
            of = "--height-map, --profile and --surface" if "surface" in parameters else "--height-map and --profile"
            raise click.UsageError(f"{option(name)} is for {of} only.")
    return _simple(shape, parameters[shape])


def chosen_body(parameters: dict[str, Any]) -> NamedIndenter:
    """Return the indenter or the rough surface that the options name."""
    path: Path | None = parameters.get("surface")
    if path is None:
        if parameters.get("prepare"):
            raise click.UsageError("--prepare is for --surface only.")
        return chosen_indenter(parameters)
    given = [option(name) for name in SHAPES if parameters.get(name) is not None]
    if given:
        raise click.UsageError(f"--surface and {given[0]} are both given; the contact has one of them.")
    from viscofric.friction.cases.surfaces import step_of
    from viscofric.notes import note_of

    topography = _read_heights(path, parameters)
    for words in parameters["prepare"]:
        with placed_at("--prepare"):
            topography = step_of(words)(topography)
    print_notes([note for note in map(note_of, topography.history) if note.code == "tilted"])
    surface = topography.to_surface()
    record = {
        "shape": "surface", "file": str(path), "prepare": list(parameters["prepare"]), "points": list(surface.shape),
        "spacing": list(surface.spacing),
    }  # fmt: skip
    words = f"Rough surface of {path.name}, {' × '.join(map(str, surface.shape))} points"
    return NamedIndenter(surface, words, record)


def _spacing(parameters: dict[str, Any]) -> Any:
    """Return one spacing, or two of x and y."""
    steps = tuple(list_of(parameters["spacing"]))
    return steps if len(steps) > 1 else steps[0]


def _simple(shape: str, text: str) -> NamedIndenter:
    from viscofric.contact.indenters import shapes
    from viscofric.study.cases.sweep import shown

    sizes = list_of(text) if shape == "ellipsoid" else [text]
    if shape == "ellipsoid" and len(sizes) != 2:
        raise click.UsageError(f"--ellipsoid {text!r}: give two radii, along x and y: '10 mm,40 mm'.")
    made = getattr(shapes, KINDS[shape])(*sizes)
    lengths = {one.name: float(getattr(made, one.name)) for one in fields(made)}
    words = " and ".join(f"{name.replace('_', ' ')} {shown(name, size)}" for name, size in lengths.items())
    return NamedIndenter(made, f"{made.noun.capitalize()} of {words}", {"shape": shape, **lengths})


def _read_heights(path: Path, parameters: dict[str, Any]) -> Topography:
    """Return heights of a file, and print what was assumed of them."""
    from viscofric.notes import note_of
    from viscofric.roughness.reading import read_topography

    steps = None if parameters["spacing"] is None else _spacing(parameters)
    with typed_as({"unit": "height_unit"}):
        topography = read_topography(path, unit=parameters["height_unit"] or "", spacing=steps)
    print_notes([note for note in map(note_of, topography.history) if note.code])
    return topography


def _mapped(shape: str, parameters: dict[str, Any]) -> NamedIndenter:
    from viscofric.contact.indenters.height_map import HeightMap, Profile
    from viscofric.errors import DataFileError, InputError

    path: Path = parameters[shape]
    topography = _read_heights(path, parameters)
    if topography.is_line != (shape == "profile"):
        held, other = ("one line", "--profile") if topography.is_line else ("a map", "--height-map")
        raise DataFileError(str(path), f"holds {held} of heights; give it by {other}.", code="not-heights")
    if topography.missing:
        problem = f"{topography.missing} of its {topography.heights.size} heights are missing; fill them in the file."
        raise DataFileError(str(path), problem, code="missing-heights")
    try:
        heights, (along, across) = topography.heights, topography.spacing
        made = Profile(heights[:, 0], along) if topography.is_line else HeightMap(heights, (along, across))
    except InputError as error:
        raise error.at(str(path)) from None
    points = [heights.size] if shape == "profile" else list(heights.shape)
    spacing = [float(step) for step in np.atleast_1d(made.spacing)]
    noun = "Profile" if shape == "profile" else "Height map"
    words = f"{noun} of {path.name}, {' × '.join(map(str, points))} points"
    return NamedIndenter(made, words, {"shape": shape, "file": str(path), "points": points, "spacing": spacing})


def load_option(also: str = "", **how: Any) -> Decorator:
    """Return a decorator that adds the normal load, or what else may be given."""
    words = f"Normal load, e.g. '25 N' (per unit length for a line contact: '1 kN/m'){also}."
    return click.option("--load", metavar="F", help=words, **how)


direction_option = quantity(
    "--direction",
    "ANGLE|DX,DY",
    "Direction of motion in the indenter's axes: angle from x towards y, e.g. '30 deg', or a vector '0,1'.",
    default="1,0",
)
elastic_options = together(
    quantity("--indenter-modulus", "E", "Modulus of an elastic indenter, e.g. '200 GPa' [default: rigid]."),
    click.option(
        "--indenter-poisson-ratio",
        type=float,
        metavar="ν",
        help="Poisson's ratio of an elastic indenter [default: 0.3].",
    ),
    heading="Elastic indenter",
)
accuracy_option = key("solver.accuracy", type=float, default=1e-3, help="Target relative error of the friction.")
contact_options = together(
    direction_option,
    elastic_options,
    quantity(
        "--coulomb",
        "μ",
        "Coulomb friction coefficient, whose shear changes the pressure; negative for slip against the motion.",
        default=0.0,
    ),
    accuracy_option,
    click.option("--backend", default="scipy", help="Array and FFT library, e.g. ducc0 or torch:cuda."),
    heading=CONTACT,
)


def inputs_of(parameters: dict[str, Any]) -> list[Path]:
    """Return the files that rubber, indenter and history are read from."""
    rubber = [] if parameters["material"] is None else [Path(parameters["material"])]
    names = ("shift_factors", "height_map", "profile", "surface", "history")
    others = [Path(parameters[name]) for name in names if parameters.get(name) is not None]
    return [path for path in (*rubber, *parameters["dma"], *others) if path.is_file()]


def elastic_settings(parameters: dict[str, Any]) -> dict[str, Any]:
    """Return the settings of an elastic indenter of the options."""
    if parameters["indenter_poisson_ratio"] is not None and parameters["indenter_modulus"] is None:
        raise click.UsageError("--indenter-poisson-ratio is for --indenter-modulus only; a rigid indenter has none.")
    ratio = parameters["indenter_poisson_ratio"]
    return {
        "indenter_modulus": parameters["indenter_modulus"],
        "indenter_poisson_ratio": 0.3 if ratio is None else float(ratio),
    }


def chosen_direction(text: str) -> tuple[float, float]:
    """Return the direction of the motion that an angle or two components name."""
    if "," in text:
        try:
            x, y = (float(part) for part in text.split(","))
        except ValueError:
            raise click.UsageError(f"--direction {text!r}: give an angle, '30 deg', or two numbers, '0,1'.") from None
        return x, y
    from viscofric.units import to_si

    angle = to_si(text, "rad", "direction")
    # So that a right angle is one, and 180° is motion along x.
    return round(math.cos(angle), 15), round(math.sin(angle), 15)
