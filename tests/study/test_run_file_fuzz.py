"""Run files with anything wrong in them: a sentence that names the file, never a traceback, never a long wait."""

from __future__ import annotations

import os
import time
from importlib.resources import files
from pathlib import Path

import pytest

from study.run_file_mutations import mutated
from viscofric.errors import LONGEST_SENTENCE, StudyError
from viscofric.study.run_file.study import decoded, parse_study

HOME = files("viscofric")
SOURCES = [
    (HOME / "example" / "study.toml").read_text(encoding="utf-8"),
    *(
        (HOME / "templates" / f"{name}.toml").read_text(encoding="utf-8")
        for name in ("cylinder", "layer", "sweep", "surface")
    ),
]
# So many in every run of the tests; VISCOFRIC_FUZZ asks for more.
HOW_MANY = int(os.environ.get("VISCOFRIC_FUZZ", "800"))
PATH = Path("study.toml")
#: Words in messages of Python and of its libraries that are no sentences for users.
LEAKS = ("Traceback", "pydantic", "Input should", "object at 0x", "NoneType", "<range>:", "Value error", "Error(")


def refusal(data: bytes) -> str | None:
    try:
        parse_study(decoded(data, PATH), PATH)
    except StudyError as error:
        return str(error)
    return None


@pytest.mark.apart
@pytest.mark.timeout(600)
def test_mutated_run_files_are_refused_in_sentences_or_taken() -> None:
    taken = 0
    slowest = 0.0
    for number in range(HOW_MANY):
        data = mutated(SOURCES[number % len(SOURCES)], number)
        start = time.process_time()
        said = refusal(data)
        slowest = max(slowest, time.process_time() - start)
        if said is None:
            taken += 1
            continue
        first, *more = said.splitlines()
        assert first.startswith("study.toml"), (number, said)
        for line in [first, *more]:
            assert line.endswith((".", "?")) or (more and line is first and line.endswith(":")), (number, said)
            assert len(line) <= LONGEST_SENTENCE, (number, said)
        assert not any(leak in said for leak in LEAKS), (number, said)
    # Moved lines, changed numbers and unused tables leave some of them right, most of them wrong.
    assert 0.05 * HOW_MANY < taken < 0.5 * HOW_MANY
    # Without a hang: a run file takes some milliseconds; the factor is for slow machines.
    assert slowest < 2.0
