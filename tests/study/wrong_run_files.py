"""Wrong run files: the change to a correct one, the codes of the errors by their places, and the message."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

BALL = """
title = "a rubber"
[material]
dma = "dma.csv"
reference_temperature = "30 degC"
[indenter]
radius = "9.525 mm"
[conditions]
load = "25 N"
speed = { from = "20 mm/s", to = "200 mm/s", points = 3 }
temperature = ["30 degC", "60 degC"]
"""
TWO = 'temperature = ["30 degC", "60 degC"]'
MEASURED = f'{TWO}\n[measurement]\nmtm = "a.csv"'

_MATERIAL = '[material]\ncatalogue = "synthetic fluoroelastomer"\n'
GENERATED = """[surface]
hurst = 0.8
rms_slope = 0.2
rolloff = "200 um"
shortest = "40 um"
spacing = "10 um"
points = 32
seed = { from = 3, to = 5 }
"""
SURFACE = (
    _MATERIAL
    + GENERATED
    + """[conditions]
pressure = ["20 kPa", "50 kPa"]
speed = ["1 mm/s", "1 m/s"]
temperature = "30 degC"
"""
)
SWEEP = (
    _MATERIAL
    + """[indenter]
radius = ["5 mm", "10 mm"]

[conditions]
load = ["1 N", "4 N"]
speed = { from = "1 mm/s", to = "1 m/s", points = 4 }
temperature = ["30 degC", "60 degC", "90 degC"]
"""
)


class Wrong(NamedTuple):
    """A run file that is refused: `bad` replaces the first `good` of `base`, or is appended where `good` is empty."""

    base: str
    good: str
    bad: str
    codes: dict[str, str]
    message: str

    @property
    def text(self) -> str:
        assert self.good in self.base
        return self.base.replace(self.good, self.bad, 1) if self.good else self.base + self.bad


def _listed() -> Iterator[Wrong]:
    """Yield the run files of ``wrong_run_files.txt``."""
    base = ""
    for block in Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").strip().split("\n\n")[1:]:
        if block.startswith("# "):
            base = globals()[block[2:]]
            continue
        lines = block.split("\n")
        good, bad = ("\n".join(line[2:] for line in lines if line.startswith(mark)) for mark in "-+")
        errors = [re.fullmatch(r"(.*?) ?\[([a-z-]+)\] (.*)", line) for line in lines if line[0] not in "-+"]
        places, codes, words = zip(*(one.groups() for one in errors if one), strict=True)
        said = [f"{place}: {word}" if place else word for place, word in zip(places, words, strict=True)]
        if len(said) > 1:
            more = [f"… and {len(said) - _MOST} more."] if len(said) > _MOST else []
            said = [f"{len(said)} things are wrong:", *(f"  {one}" for one in (*said[:_MOST], *more))]
        yield Wrong(base, good, bad, dict(zip(places, codes, strict=True)), "\n".join(said))


_MOST = 5  # that a message names
WRONG = list(_listed())
#: Text that is not TOML for a run file, the code of the error, and the message after the name of the file.
NO_TOML = [
    ('title = "a\n', "not-toml", ", line 1, column 11: is not valid TOML: Illegal character '\\n'."),
    ("a = 1\na = 2\n", "not-toml", ", line 2, column 6: a key is given twice in the same table."),
    (
        "[solver]\n[solver]\n",
        "not-toml",
        ", line 2, column 8: the table [solver] is given twice, or has keys in two places.",
    ),
    ("[material", "not-toml", ", at its end: is not valid TOML: Expected ']' at the end of a table declaration."),
    ("a = " + "[" * 5000, "too-deep", ": lists or tables are nested too deeply for a run file."),
    (".".join("a" * 5000) + " = 1", "too-deep", ": lists or tables are nested too deeply for a run file."),
    ("a = " + "9" * 5000, "not-toml", ": a whole number has thousands of digits."),
    ("#" * 1000001, "too-long", ": has more than 1,000,000 characters; is this a run file?"),
]
