"""What the page loads: libraries as the npm registry has them, with their licences, and small."""

from __future__ import annotations

import csv
import hashlib
import posixpath
import re

import pytest

from viscofric.web.app import ROOT

FOLDER = ROOT / "vendor"
LIBRARIES = list(csv.DictReader((FOLDER / "vendored.csv").read_text(encoding="utf-8").splitlines()))
#: What the page's elements, templates and signals may weigh together.
LARGEST_REACTIVE = 30_000  # bytes
_IMPORTED = re.compile(r'^(?:import|export)\b[^;]*? from "(.+?)";', re.MULTILINE)
#: The opening words of a licence's text, by its SPDX name.
OPENINGS = {"MIT": "MIT License", "Apache-2.0": "Apache License"}


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda one: one["file"])
def test_a_library_is_the_published_file_with_its_licence(library: dict[str, str]) -> None:
    content = (FOLDER / library["file"]).read_bytes()
    assert hashlib.sha256(content).hexdigest() == library["sha256"]
    text = (FOLDER / library["licence_file"]).read_text(encoding="utf-8")
    assert OPENINGS[library["licence"]] in " ".join(text.split())[:80].replace("The MIT License", "MIT License")


def test_every_script_and_licence_is_listed() -> None:
    listed = {library[key] for library in LIBRARIES for key in ("file", "licence_file")}
    assert {path.name for path in FOLDER.iterdir()} == listed | {"vendored.csv"}


def test_the_reactive_libraries_are_small() -> None:
    sizes = [len((FOLDER / one["file"]).read_bytes()) for one in LIBRARIES if not one["package"].startswith("plotly")]
    assert 0 < sum(sizes) <= LARGEST_REACTIVE


def test_the_document_names_in_advance_all_modules_of_the_first_step() -> None:
    found = {"vendor/plotly-cartesian.min.js"}  # figures.js imports it once there is something to draw
    left = ["js/main.js", "js/steps/contact.js"]
    while left:
        name = left.pop()
        if name in found:
            continue
        found.add(name)
        if not name.startswith("vendor/"):
            imported = _IMPORTED.findall((ROOT / name).read_text("utf-8"))
            left += [posixpath.normpath(posixpath.join(posixpath.dirname(name), one)) for one in imported]
    document = (ROOT / "index.html").read_text("utf-8")
    assert {f"/static/{name}" for name in found - {"js/main.js"}} == set(
        re.findall(r'rel="modulepreload" href="(.+?)"', document)
    )
