"""The paper: what it cites is in its bibliography, and its table has the numbers of the check that it names.

Its code block is run by `test_readme.py`.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from viscofric.cli import main
from viscofric.literature.references import REFERENCES

PAPER = Path(__file__).parents[1] / "paper"
TEXT = (PAPER / "paper.md").read_text(encoding="utf-8")
BIBLIOGRAPHY = (PAPER / "paper.bib").read_text(encoding="utf-8")


def test_bibliography_has_what_is_cited_as_the_package_cites_it() -> None:
    cited = set(re.findall(r"(?<![\w/])@([a-z]+\d*)", TEXT))
    entries = {re.split(r"[{,]", entry)[1]: entry.strip() for entry in re.findall(r"(?ms)^@.*?^\}$", BIBLIOGRAPHY)}
    assert cited == set(entries)
    assert {key for key in cited if re.search(r"\d", key)} - set(REFERENCES) == {"grosch1963"}
    for key in cited & set(REFERENCES):
        assert entries[key] == REFERENCES[key].bibtex()


@pytest.mark.apart
def test_table_has_the_numbers_of_its_command() -> None:
    rows = [tuple(map(float, row)) for row in re.findall(r"(?m)^\| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", TEXT)]
    (command,) = re.findall(r"`viscofric (verify .*) --details`", TEXT)
    done = CliRunner().invoke(main, [*command.split(), "--json"], catch_exceptions=False)
    (check,) = json.loads(done.stdout)["checks"]
    found = [(one["expected"], one["computed"]) for one in check["comparisons"]]
    assert len(rows) == len(found) == 3
    for (_, published, printed), (expected, value) in zip(rows, found, strict=True):
        assert published == expected
        assert printed == pytest.approx(value, abs=0.51e-5)  # printed to five decimals
