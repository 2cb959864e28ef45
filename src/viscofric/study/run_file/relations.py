"""Contradictions between the tables of a run file."""

from __future__ import annotations

import difflib
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

from viscofric.study.cases.sweep import CONDITIONS, MOST_CASES, axes_of, body_of, coordinates, count_cases
from viscofric.study.run_file.contact import BallTable
from viscofric.study.run_file.tables import PerLength, Problem, worded

#: Valid tables by their names in the file.
Tables: TypeAlias = Mapping[str, Any]


def relations(tables: Tables) -> Iterator[Problem]:
    """Yield the contradictions between tables that are valid by themselves, each with its path in the file."""
    yield from _names_of_materials(tables)
    yield from _body(tables)
    yield from _loads(tables)
    if tables.get("layer") is not None and getattr(tables.get("conditions"), "thickness", None) is not None:
        words = "checks the half-space assumption, which does not apply with [layer]; leave it out"
        yield "conditions.thickness", words
    wrong = list(_sweep(tables))
    yield from wrong
    if not wrong:
        yield from _size(tables)
    yield from _measurement(tables)
    yield from _history(tables)
    yield from _interface(tables)
    yield from _heating(tables)
    yield from _members(tables)


def _names_of_materials(tables: Tables) -> Iterator[Problem]:
    materials = tables.get("material", ())
    if len(materials) < 2:
        return
    times = Counter(material.name for material in materials)
    for number, material in enumerate(materials):
        if not material.name:
            yield f"material.{number}.name", "is missing; several materials need names"
        elif times[material.name] > 1:
            yield f"material.{number}.name", f"{material.name!r} is the name of {times[material.name]} materials"


def _body(tables: Tables) -> Iterator[Problem]:
    """Yield the errors of a file without exactly one of [indenter] and [surface], and conditions of the other one."""
    if "indenter" not in tables or "surface" not in tables:
        return
    indenter, surface, conditions = tables["indenter"], tables["surface"], tables.get("conditions")
    if indenter is None and surface is None:
        yield "indenter", "is missing; give it, or [surface] for a rough surface"
        return
    if indenter is not None and surface is not None:
        yield "surface", "is given besides [indenter]; a study has one of them"
        return
    if conditions is None:
        return
    needed, other, of = ("load", "pressure", "an indenter") if surface is None else ("pressure", "load", "a [surface]")
    if getattr(conditions, other):
        yield f"conditions.{other}", f"is not for {of}; give {needed} instead, such as {_EXAMPLES[needed]!r}"
    elif not getattr(conditions, needed):
        yield f"conditions.{needed}", f"is missing; {of} needs one, such as {_EXAMPLES[needed]!r}"
    if surface is None and conditions.direction:
        yield "conditions.direction", "is for a rough [surface]; the motion of an indenter is along x"


_EXAMPLES = {"load": "25 N", "pressure": "50 kPa"}


def _loads(tables: Tables) -> Iterator[Problem]:
    if tables.get("indenter") is None or "conditions" not in tables:
        return
    indenter, loads = tables["indenter"], tables["conditions"].load
    wrong = [(place, load) for place, load in enumerate(loads) if isinstance(load, PerLength) != indenter.LINE]
    for place, load in wrong[:1] if len(wrong) == len(loads) else wrong:
        if indenter.LINE:
            words = f"{load:.6g} N is a force; the load of a cylinder is per length, such as '2 N/mm'"
        else:
            words = f"{load:.6g} N/m is a load per length; the load of a {indenter.shape} is a force, such as '25 N'"
        yield "conditions.load" if len(wrong) == len(loads) else f"conditions.load.{place}", words


def _together(tables: Tables, known: dict[str, tuple[Any, ...]]) -> list[list[str]]:
    """Return the groups of axes that vary together, without unknown names."""
    groups = tables["sweep"].together if "sweep" in tables else ()
    return [[name for name in group if name in known] for group in groups]


def _sweep(tables: Tables) -> Iterator[Problem]:
    known = coordinates(tables)
    whole = all(name in tables for name in ("material", "indenter", "surface", "conditions", "layer"))
    whole = whole and body_of(tables) is not None
    choices = [name for name in known if name != "sample"]
    for number, group in enumerate(tables["sweep"].together if "sweep" in tables else ()):
        for place, name in enumerate(group):
            if name not in choices and whole:
                near = difflib.get_close_matches(name, choices, n=1, cutoff=0.5)
                hint = f"did you mean {near[0]!r}?" if near else f"the axes are {', '.join(choices)}"
                yield f"sweep.together.{number}.{place}", f"{name!r} is not an axis of this study; {hint}"
        lengths = {name: len(known[name]) for name in group if name in choices}
        if len(set(lengths.values())) > 1:
            counts = ", ".join(f"{name} has {count}" for name, count in lengths.items())
            yield f"sweep.together.{number}", f"axes that vary together need the same number of values, but {counts}"
    if whole:
        yield from _twice(tables, known)


def _twice(tables: Tables, known: dict[str, tuple[Any, ...]]) -> Iterator[Problem]:
    """Yield axes with a repeated point."""
    for axis in axes_of(known, _together(tables, known)):
        if "material" in axis.columns:
            continue  # reported by their names
        points = list(zip(*axis.columns.values(), strict=False))
        twice = _repeated(points)
        if twice:
            places = " and ".join(_place(name) for name in axis.columns)
            where = f" (entry {twice[0] + 1})" if len(twice) == 1 else f" ({len(twice)} entries)"
            yield places, f"contains the same value twice{where}"


def _repeated(points: list[tuple[Any, ...]]) -> list[int]:
    seen: set[tuple[Any, ...]] = set()
    again = []
    for place, point in enumerate(points):
        # The same value in two units differs by rounding.
        rounded = tuple(f"{value:.12g}" if isinstance(value, float) else value for value in point)
        if rounded in seen:
            again.append(place)
        seen.add(rounded)
    return again


def _size(tables: Tables) -> Iterator[Problem]:
    known = coordinates(tables)
    count = count_cases(axes_of(known, _together(tables, known)))
    if count > MOST_CASES:
        counts = " × ".join(f"{len(values):,} {name}" for name, values in known.items() if len(values) > 1)
        yield (
            "",
            f"requests {count:,} cases ({counts}), more than {MOST_CASES:,}; give fewer points, or several run files",
        )


def _measurement(tables: Tables) -> Iterator[Problem]:
    if tables.get("measurement") is None:
        return
    if len(tables.get("material", ())) > 1:
        yield "measurement", f"needs one material, but there are {len(tables['material'])}"
    indenter = tables.get("indenter")
    if tables.get("surface") is not None:
        yield "measurement", "needs a ball, but there is a rough surface"
    if indenter is not None and not isinstance(indenter, BallTable):
        yield "measurement", f"needs a ball, but the shape of the indenter is {indenter.shape}"
    elif indenter is not None and len(indenter.radius) > 1:
        yield "measurement", f"needs one ball, but indenter.radius has {len(indenter.radius)} values"
    if tables.get("layer") is not None:
        yield "measurement", "needs a half-space, but there is a layer"


def _history(tables: Tables) -> Iterator[Problem]:
    history = tables.get("history")
    returns = history is None or not history.cycle or history.slide is None or history.strokes % 2 == 0
    if history is not None and not returns and tables.get("indenter") is not None:
        yield (
            "history.strokes",
            f"is {history.strokes}, but the period of a cycle ends where it begins; give an even number",
        )
    if tables.get("impact") is None:
        return
    indenter = tables.get("indenter")
    if tables.get("surface") is not None:
        yield "impact", "needs an indenter, but there is a rough surface"
    elif indenter is not None and indenter.shape not in ("ball", "cone"):
        yield "impact", f"needs a ball or a cone, but the shape of the indenter is {indenter.shape}"
    if tables.get("layer") is not None:
        yield "impact", "needs a half-space, but there is a layer"


def _interface(tables: Tables) -> Iterator[Problem]:
    interface = tables.get("interface")
    if interface is None:
        return
    if not interface.is_given and tables.get("measurement") is None:
        said = "needs a [measurement] with Coulomb friction (of a ball), or a law with its constants"
        page = "needs measured Coulomb friction of a ball, in the step Measurement, or another law of the shear stress"
        yield "interface", worded(said, page)


def _heating(tables: Tables) -> Iterator[Problem]:
    heating, indenter = tables.get("heating"), tables.get("indenter")
    if heating is None:
        return
    if tables.get("surface") is not None and heating.passes > 0 and heating.nominal_radius is None:
        yield "heating.nominal_radius", "is missing; passes of a rough surface are those of its nominal contact"
    if indenter is not None and heating.nominal_radius is not None:
        yield "heating.nominal_radius", "is of rough surfaces; the contact of an indenter has its own radius"
    if tables.get("layer") is not None:
        page = "friction on layers is not computed with heating"
        yield "heating", worded("needs a half-space, but there is a layer", page)
    if indenter is not None and indenter.LINE and heating.passes > 0:
        yield "heating.passes", "are of round contacts; a cylinder leaves no circular track"
    if tables.get("interface") is not None:
        if max(heating.coulomb) > 0.0:
            said = "is given besides [interface], whose shear stress makes this heat; leave it out"
            page = "is already that of the dry interface, whose shear stress makes this heat; empty this field"
            yield "heating.coulomb", worded(said, page)
        if heating.slip is not None:
            page = "is already the slip speed of the dry interface; empty this field"
            yield "heating.slip", worded("is given besides [interface]; give interface.slip instead", page)


def _members(tables: Tables) -> Iterator[Problem]:
    if "uncertainty" not in tables or tables["uncertainty"].members == 0:
        return
    for number, material in enumerate(tables.get("material", ())):
        if not (material.dma or material.steps):
            which = f"material[{number}]" if len(tables["material"]) > 1 else "[material]"
            yield ("uncertainty.members", f"needs sweeps (dma), whose scatter gives the uncertainty; {which} has none")


def _place(name: str) -> str:
    """Return the key of an axis."""
    table = "conditions" if name in CONDITIONS else _TABLES.get(name, "indenter")
    return f"{table}.{name}"


_TABLES = {"thickness": "layer", "seed": "surface"}
