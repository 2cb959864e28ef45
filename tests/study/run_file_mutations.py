"""Run files with something wrong: mutations of good ones, the same for the same number."""

from __future__ import annotations

import random
import string
from typing import Any

_QUANTITIES = (
    "25 N", "-25 N", "25", "0 N", "1e400 N", "nan N", "25 mm", "2 N/mm", "1,5 N", "30 degC", "-300 degC", "30 °C",
    "1 µm/s", "25 N N", "N", "", " ", "25 N", "2**9999 N", "9" * 400 + " N", "1 " + "m" * 60, "25 \\u0000", "١ N",
    "1e-320 m", "5 deg", "90 deg", "-5 deg", "50 kPa", "1e300 m", "1e9 um",
)  # fmt: skip
_VALUES = (
    "true", "false", "0", "-1", "1", "3", "1e-3", "nan", "inf", "-inf", "1e308", "0x7fffffffffffffff", "9" * 25,
    "9" * 5000, "-0.0", "1979-05-27", "07:32:00", "1979-05-27T07:32:00Z", "[]", "{}", "[[]]", "[[[[1]]]]",
    "[1, 'a', []]", "{ a = 1 }", "{ from = '1 mm/s' }", "{ from = '1 mm/s', to = '1 mm/s', points = 5 }",
    "{ from = '1 m/s', to = '2 m/s', points = 1e9 }", "{ from = '1 m/s', to = '2 m/s', points = 10000 }",
    "{ from = '1 N', to = '2 N/m', points = 3, spacing = 'log' }",
    "{ from = '1 degC', to = '9 degC', points = 3, spacing = 'log' }", "['load', 'radius']", "[['load', 'radius']]",
    "[['speed', 'temperature'], ['load', 'load']]", "'*'", "'**/*'", "'/dev/null'", "'../..'", "'.'",
    "'a\\nb'", '"\\u0000"', '"\\U0001F9E8"', "'" + "x" * 2000 + "'", "'cone'", "'ball'", "'cylinder'", "'constant'",
    "'sparse'", "['25 N', 25, '3 m']", "['1 mm', '1 mm']", "[64, 64]", "[512, 1]", "{ from = 0, to = 3 }",
    "{ from = 3, to = 0 }", "{ from = 0, to = 99999999 }", "[1, 1]", "['fill', 'remove tilt']", "'window 0.1'",
    "'filll'", "'crop x 0 um to 1 um'", "'remove N'",
)  # fmt: skip
_TABLES = (
    "material",
    "[material]",
    "indenter",
    "surface",
    "layer",
    "conditions",
    "sweep",
    "solver",
    "outputs",
    "cluster",
    "x",
    "uncertainty",
)
_MARKS = "\x00\x01\t\n\r\"'[]{}=.,#\\\ufeff\u202e" + string.ascii_letters + string.digits


def mutated(source: str, number: int) -> bytes:
    """Return a run file with one to four things changed at random, for a number always the same ones."""
    chance = random.Random(number)
    text = source
    for _ in range(chance.choice((1, 1, 1, 2, 3, 4))):
        text = chance.choice(_MUTATIONS)(text, chance)
    data = text.encode("utf-8", "surrogatepass")
    if chance.random() < 0.03:
        place = chance.randrange(len(data) + 1)
        data = data[:place] + chance.randbytes(chance.randrange(1, 40)) + data[place:]
    return data


def _lines(text: str, chance: random.Random) -> tuple[list[str], int]:
    lines = text.splitlines()
    return lines, chance.randrange(len(lines)) if lines else 0


def _setting(text: str, chance: random.Random) -> tuple[list[str], int] | None:
    """Return the lines and the place of one that sets a key."""
    lines = text.splitlines()
    places = [place for place, line in enumerate(lines) if "=" in line and not line.startswith("#")]
    return (lines, chance.choice(places)) if places else None


def _rename(text: str, chance: random.Random) -> str:
    if (found := _setting(text, chance)) is None:
        return text
    lines, place = found
    key, _, value = lines[place].partition("=")
    key = list(key.strip() or "k")
    spot = chance.randrange(len(key))
    key[spot] = chance.choice((chance.choice(_MARKS), "", key[spot] * 2))
    lines[place] = f"{''.join(key)} ={value}"
    return "\n".join(lines)


def _set(text: str, chance: random.Random) -> str:
    if (found := _setting(text, chance)) is None:
        return text
    lines, place = found
    key = lines[place].partition("=")[0]
    value = chance.choice(_VALUES) if chance.random() < 0.6 else _quoted(chance.choice(_QUANTITIES))
    lines[place] = f"{key}= {value}"
    return "\n".join(lines)


def _quoted(text: str) -> str:
    return '"' + text + '"'


def _drop(text: str, chance: random.Random) -> str:
    lines, place = _lines(text, chance)
    return "\n".join(lines[:place] + lines[place + 1 :])


def _double(text: str, chance: random.Random) -> str:
    lines, place = _lines(text, chance)
    return "\n".join([*lines[:place], *lines[place : place + 1], *lines[place:]])


def _move(text: str, chance: random.Random) -> str:
    lines, place = _lines(text, chance)
    if not lines:
        return text
    line = lines.pop(place)
    lines.insert(chance.randrange(len(lines) + 1), line)
    return "\n".join(lines)


def _add_key(text: str, chance: random.Random) -> str:
    lines, place = _lines(text, chance)
    words = [line.partition("=")[0].strip() for line in lines if "=" in line] or ["a"]
    key = chance.choice((chance.choice(words), '"a b"', '""', "a.b.c", ".".join("abc" * 200), "<range>", '"<list>"'))
    lines.insert(place, f"{key} = {chance.choice(_VALUES)}")
    return "\n".join(lines)


def _add_table(text: str, chance: random.Random) -> str:
    lines, place = _lines(text, chance)
    lines.insert(place, f"[{chance.choice(_TABLES)}]")
    return "\n".join(lines)


def _cut(text: str, chance: random.Random) -> str:
    return text[: chance.randrange(len(text) + 1)]


def _garble(text: str, chance: random.Random) -> str:
    marks: list[Any] = list(text)
    for _ in range(chance.randrange(1, 6)):
        marks.insert(chance.randrange(len(marks) + 1), chance.choice(_MARKS))
    return "".join(marks)


def _nest(text: str, chance: random.Random) -> str:
    depth = chance.choice((3, 30, 300, 3000))
    return f"{text}\nx = {'[' * depth}{']' * chance.choice((depth, 0))}"


_MUTATIONS = (_rename, _set, _set, _set, _set, _drop, _double, _move, _add_key, _add_table, _cut, _garble, _nest)
