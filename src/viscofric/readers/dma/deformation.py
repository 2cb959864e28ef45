"""What says whether moduli are tensile or shear: their headings, the tool that held the sample, a torque."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from viscofric.notes import Note, setting

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from viscofric.data import Deformation

    #: What the moduli are and what in the file says so; (None, "") where nothing does.
    Said = tuple[Deformation | None, str]

#: What remains to do where nothing decides: the end of a sentence.
NOT_SAID = Note(
    "no-deformation",
    "does not say whether it was measured in tension or in shear, a factor of 3 in the modulus; give ",
    remedy=setting("material.deformation", "Measured in", "'tension' or 'shear'") + ".",
)

_SHEAR_WORDS = r"shear|schub|scher|cisaillement|cizall|cortante|taglio|cisalh|сдвиг"
_SHEAR = re.compile(rf"\|?g['*\s]|g-|gstor|gloss|.*(\bg['*]|{_SHEAR_WORDS})")
_TENSION = re.compile(r"\|?e['*\s]|e-|estor|eloss|.*(\be['*]|tensi|young|zug|traction|tracción|trazione|tração)")
_SHEARED = re.compile(_SHEAR_WORDS)

# Instruments give every modulus the same name, so that the tool which held the sample decides between E and G.  Plates
# shear in rotation; where they compress, in axial oscillation, a force stands beside the moduli, or a word says so.
_PLATES = re.compile(
    r"parallel[ -]?plat|plates?[ /–-]+plates?\b|platte[ /–-]+platte|plan[ /–-]+plan\b|(plaques|plateaux) parall"
    r"|(placas|pratos) paralel|piatti paralleli|\bPP ?-?\d",
    re.IGNORECASE,
)
_SHEARING = re.compile(
    rf"\b(torsion|cone|kegel|concentric|couette|double gap|(CP|CC|DG) ?-?\d)|{_SHEAR_WORDS}", re.IGNORECASE
)
_STRETCHING = re.compile(
    r"\b(tension|tensile|traction|films?\b|fib(er|re)|extension|axial|(TPB|UXF|SER)\b)"
    r"|compress|kompression|cantilever|\bbend|flexion|\b(zug|biege|druck)",
    re.IGNORECASE,
)
#: Lines and sheets beside a table in which an instrument or a person names the tool, by their label.
_TOOL_LABEL = re.compile(
    r"g[eé]om[eé]tr|clamp|fixture|einspannung|probenhalter|\btool\b|\bmode\b|deformation"
    r"|(measuring|measurement) (system|cell|device|body)|mess(system|zelle|körper|geometrie)"
    r"|syst[eè]me de mesure|sistema de (medi|medi[cç])|sistema di misura",
    re.IGNORECASE,
)
_TORQUE = re.compile(
    r"(oscillation |oscillatory )?torque( amplitude)?|drehmoment|moment de torsion|couple|momento torcente"
    r"|par de torsión|torque oscilatorio"
)
_FORCE = re.compile(
    r"((oscillation|oscillatory|dynamic|drive) )?force( amplitude)?|(dynamische )?kraft|force dynamique"
)


def deformation_of(name: str) -> Deformation | None:
    """Return whether a modulus of this name is tensile or shear, None if the name does not say it."""
    lower = re.sub(r"[’′‘`´]", "'", name).lower() + " "
    if _SHEAR.match(lower):
        return "shear"
    return "tension" if _TENSION.match(lower) else None


def tool_says(texts: Iterable[tuple[str, str]], *, axial: bool = False) -> Said:
    """Return what the tool that held the sample implies: shear, or tension (bending and compression give E too).

    Parameters
    ----------
    texts : pairs of str
        Label and value in the head of a file, such as ``("Geometry name", "Shear sandwich")``.
    axial : bool
        Whether the instrument oscillated along its axis as far as the columns show it, so that plates do not shear.
    """
    said: dict[Deformation, str] = {}
    for label, value in texts:
        words = f"{label} {value.strip()[:80]!r}"
        shears = _SHEARING.search(value) or (not axial and _PLATES.search(value))
        if shears:
            said.setdefault("shear", words)
        if _STRETCHING.search(value):
            said.setdefault("tension", words)
    return next(iter(said.items())) if len(said) == 1 else (None, "")


def tools_in(rows: Iterable[Sequence[str]]) -> list[tuple[str, str]]:
    """Return label and value of those rows of cells that name a tool: ``Geometry``, or ``# Clamp: film tension``."""
    found = []
    for row in rows:
        cells = [cell.strip().lstrip("#").strip() for cell in row if cell.strip()]
        label, colon, value = (cells or [""])[0].partition(":")
        value = " ".join([value.strip(), *cells[1:]] if colon else cells[1:])
        if value and len(label) < 60 and _TOOL_LABEL.search(label):
            found.append((label.strip(), value))
    return found


def said_by_columns(moduli: Iterable[str], columns: Iterable[str], tools: Iterable[tuple[str, str]] = ()) -> Said:
    """Decide between E and G by what a file says beside its numbers.

    The headings of the moduli come first, then the tool, then a column of shear strain, stress or rate, then a torque
    where there is no force.

    Parameters
    ----------
    moduli : iterable of str
        Headings of the moduli.
    columns : iterable of str
        Headings of all columns that hold numbers.
    tools : pairs of str
        Label and value of what names the tool; see `tools_in`.
    """
    for heading in moduli:
        kind = deformation_of(heading)
        if kind is not None:
            return kind, f"the heading {heading[:80]!r}"
    plain = {" ".join(column.lower().split()): column for column in columns}
    torques = [column for name, column in plain.items() if _TORQUE.fullmatch(name)]
    forces = [column for name, column in plain.items() if _FORCE.fullmatch(name)]
    tool = tool_says(tools, axial=bool(forces))
    if tool[0] is not None:
        return tool
    for name, column in plain.items():
        if _SHEARED.search(name):
            return "shear", f"the heading {column[:80]!r}"
    if torques and not forces:
        return "shear", f"the column {torques[0]!r}, as only a rotational rheometer writes it"
    return None, ""
