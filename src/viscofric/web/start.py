"""What a fresh page shows: a study of the synthetic rubber, the catalogue, and the limits of requests."""

from __future__ import annotations

import copy
from typing import Any

#: What the page opens with, as a run file would say it; a curve that is there in a second or two.
FIRST_STUDY: dict[str, Any] = {
    "title": "Friction of a synthetic fluoroelastomer",
    "data_origin": "synthetic",
    "material": {"catalogue": "synthetic fluoroelastomer"},
    "indenter": {"shape": "ball", "radius": "9.525 mm"},
    "conditions": {
        "load": "10 N",
        "speed": {"from": "1 mm/s", "to": "10 m/s", "points": 25, "spacing": "log"},
        "temperature": ["30 degC", "60 degC", "90 degC"],
    },
    "solver": {"accuracy": 1e-2},
}


def start(study: dict[str, Any] | None = None) -> dict[str, Any]:
    """Return what the page requests first; `study`: the run file's tables it opens with, instead of the first study."""
    from importlib.metadata import version

    from viscofric.web.forms import FORMS
    from viscofric.web.forms.contact import SHAPES
    from viscofric.web.glossary import GLOSSARY
    from viscofric.web.workspace import LARGEST_UPLOAD, MOST_FILES

    return {
        "version": version("viscofric"),
        "study": copy.deepcopy(FIRST_STUDY if study is None else study),
        "catalogue": rubbers(),
        "limits": {"upload": LARGEST_UPLOAD, "files": MOST_FILES},
        "forms": FORMS,
        "shapes": SHAPES,
        "glossary": GLOSSARY,
    }


def rubbers() -> list[dict[str, Any]]:
    """Return the rubbers of the catalogue."""
    from viscofric.rheology.catalogue import catalogue

    return [
        {"name": entry.name, "synthetic": entry.kind == "SYNTHETIC", "description": f"{entry.holds} {entry.citation}"}
        for entry in catalogue()
    ]
