"""Documents made by chance: what the page's jobs tell is what the package finds when it is asked directly."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any, NamedTuple

import pytest

import viscofric as vf
from viscofric.web.jobs import contact, curve
from web.contact_studies import Desk

#: Numbers have six digits.
ROUNDING = 1e-5
_NAMES = ("friction_coefficient", "load", "indentation", "contact_area", "front", "rear", "half_width", "max_pressure")


class Drawn(NamedTuple):
    """A document, and the same as arguments of `solve_steady`."""

    document: dict[str, Any]
    rubber: vf.Material
    indenter: Any
    more: dict[str, Any]


def drawn(seed: int) -> Drawn:
    chance = random.Random(seed)
    rubbers = {entry.name: vf.catalogue_material(entry.name) for entry in vf.catalogue()}
    name = chance.choice([name for name, rubber in rubbers.items() if rubber.shift is not None])
    rubber = rubbers[name]
    assert rubber.reference is not None
    speed, temperature = 10.0 ** chance.uniform(-3.0, 0.5), rubber.reference + chance.uniform(0.0, 30.0)
    load = chance.uniform(5.0, 50.0)
    shapes: dict[str, tuple[dict[str, Any], Any]] = {
        "ball": ({"shape": "ball", "radius": "12 mm"}, vf.Ball("12 mm")),
        "cylinder": ({"shape": "cylinder", "radius": "12 mm"}, vf.Cylinder("12 mm")),
        "cone": ({"shape": "cone", "angle": "8 deg"}, vf.Cone("8 deg")),
        "ellipsoid": (
            {"shape": "ellipsoid", "radius_x": "20 mm", "radius_y": "8 mm"},
            vf.Ellipsoid("20 mm", "8 mm"),
        ),
    }
    table, indenter = shapes[chance.choice([*shapes])]
    scale = 100.0 if table["shape"] == "cylinder" else 1.0
    more: dict[str, Any] = {"speed": speed, "load": scale * load, "temperature": temperature, "accuracy": 1e-2}
    document: dict[str, Any] = {
        "material": {"catalogue": name},
        "conditions": {
            "load": f"{scale * load!r} N{'/m' if scale > 1.0 else ''}",
            "speed": f"{speed!r} m/s",
            "temperature": f"{temperature!r} K",
        },
        "solver": {"accuracy": 1e-2},
    }
    if chance.random() < 0.3:
        table |= {"modulus": "3 GPa", "poisson_ratio": 0.3}
        more |= {"indenter_modulus": "3 GPa", "indenter_poisson_ratio": 0.3}
    if chance.random() < 0.3:
        document["layer"] = {"thickness": "10 mm"}
        more["layer"] = vf.Layer("10 mm")
    return Drawn(document | {"indenter": table}, rubber, indenter, more)


@pytest.mark.parametrize("seed", range(6))
def test_jobs_show_what_the_package_finds(seed: int, tmp_path: Path) -> None:
    desk, case = Desk(tmp_path), drawn(seed)
    solved = vf.solve_steady(case.rubber, case.indenter, **case.more)
    where = {"speed": case.more["speed"], "temperature": case.more["temperature"]}
    answer = desk.run(contact, case.document, stages="sharp", **where)
    for name in _NAMES:
        expected = float(getattr(solved, name))
        reported = answer["numbers"][name]["value"]
        assert reported is None if expected == float("inf") else reported == pytest.approx(expected, rel=ROUNDING), name
    error = answer["numbers"]["friction_coefficient"]["error"]
    assert error == pytest.approx(solved.diagnostics.friction_error, rel=ROUNDING)
    assert set(solved.warnings) <= set(answer["warnings"])
    along = desk.run(curve, case.document)
    assert along["friction"] == [answer["numbers"]["friction_coefficient"]["value"]]
    assert along["error"] == [error]
    assert {one.code for one in solved.warnings} <= set(along["doubts"][0])
