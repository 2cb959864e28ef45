"""A whole material as JSON, viscofric's own material file, and as CSV, the same for people and spreadsheets."""

from __future__ import annotations

import csv
import io
import json
from typing import TYPE_CHECKING, Any

from viscofric.errors import InputError
from viscofric.files import parse_json
from viscofric.rheology.cards.native import from_plain, to_plain

if TYPE_CHECKING:
    from viscofric.rheology.material import Material

NAME_JSON = "viscofric JSON"
NAME_CSV = "viscofric CSV"
_FIRST_LINE = "# viscofric material"
#: Columns of the table: kind of spectrum -> field and how it is headed.
_COLUMNS = {
    "RetardationSpectrum": {"tau": "retardation time (s)", "C": "compliance (1/Pa)"},
    "ModulusTable": {
        "angular_frequency": "angular frequency (rad/s)",
        "storage_modulus": "storage modulus (Pa)",
        "loss_modulus": "loss modulus (Pa)",
    },
}


def recognises_json(text: str) -> bool:
    """Tell whether a text is JSON."""
    return text.lstrip().startswith("{")


def write_json(material: Material) -> str:
    """Return the material as JSON; numbers to their last digit."""
    return json.dumps(to_plain(material), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def read_json(text: str) -> Material:
    """Return the material of a JSON text."""
    try:
        content = parse_json(text, parse_constant=_no_constant)
    except InputError:
        raise
    except json.JSONDecodeError as error:
        raise InputError(f"line {error.lineno}: is not JSON ({error.msg}).") from None
    except ValueError as error:  # nested too deeply, or with numbers of thousands of digits
        raise InputError(f"is no JSON of a material ({error}).") from None
    return from_plain(content)


def _no_constant(name: str) -> float:
    raise InputError(f"holds {name}; numbers of a material must be finite.")


def recognises_csv(text: str) -> bool:
    """Tell by the first line whether a text is one of our CSV files."""
    return text.startswith(_FIRST_LINE)


def write_csv(material: Material) -> str:
    """Return the material as CSV: a line ``# name = value`` for each property, then the table of modes or moduli."""
    content = to_plain(material)
    spectrum = content.pop("spectrum")
    columns = _COLUMNS[spectrum["kind"]]
    scalars = {f"spectrum.{name}": value for name, value in spectrum.items() if name not in columns}
    out = io.StringIO()
    out.write(f"{_FIRST_LINE}; units Pa, s, K, rad/s; tensile moduli; S = 1/E = 1/E_inf + sum C/(1 + i omega tau)\n")
    for name, value in {**content, **scalars}.items():
        if name != "format":
            out.write(f"# {name} = {json.dumps(value, ensure_ascii=False, allow_nan=False)}\n")
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns.values())
    writer.writerows([repr(value) for value in row] for row in zip(*(spectrum[name] for name in columns), strict=True))
    return out.getvalue()


def read_csv(text: str) -> Material:
    """Return the material of such a CSV text."""
    content: dict[str, Any] = {"format": "viscofric material"}
    spectrum: dict[str, Any] = {}
    rows: list[tuple[int, str]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.startswith("#"):
            if line.strip():
                rows.append((number, line))
            continue
        name, equals, value = line[1:].partition("=")
        if number == 1 or not equals:
            continue
        name = name.strip()
        home, key = (spectrum, name.removeprefix("spectrum.")) if name.startswith("spectrum.") else (content, name)
        try:
            home[key] = parse_json(value, parse_constant=_no_constant)
        except InputError:
            raise
        except ValueError:
            raise InputError(f"line {number}: the value of {name} is damaged; text wants quotation marks.") from None
    columns = _COLUMNS.get(str(spectrum.get("kind")))
    if columns is None:
        raise InputError(
            f"spectrum.kind must be one of {', '.join(_COLUMNS)}; the line '# spectrum.kind = …' is missing."
        )
    spectrum.update(_table(rows, columns))
    return from_plain({**content, "spectrum": spectrum})


def _table(rows: list[tuple[int, str]], columns: dict[str, str]) -> dict[str, list[float]]:
    if not rows or next(csv.reader([rows[0][1]])) != list(columns.values()):
        raise InputError(f"the table must be headed {','.join(columns.values())}.")
    table: dict[str, list[float]] = {name: [] for name in columns}
    for number, line in rows[1:]:
        cells = line.split(",")
        try:
            values = [float(cell) for cell in cells]
        except ValueError:
            raise InputError(f"line {number}: {line[:40]!r} is not a row of numbers parted by commas.") from None
        if len(values) != len(columns):
            raise InputError(f"line {number}: {len(values)} numbers where {len(columns)} are wanted.")
        for name, value in zip(columns, values, strict=True):
            table[name].append(value)
    return table
