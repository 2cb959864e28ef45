"""The forms of the page agree with the tables of the run file: keys, limits, words, units and defaults."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from viscofric.web.jobs import export_card, export_study, identify, master, motion
from viscofric.web.start import FORMS, SHAPES
from viscofric.web.study_text import study_of
from web.run_file_schema import found, keys

_FIELDS = [
    pytest.param(field, id=f"{form}:{field['path']}")
    for form, fields in FORMS.items()
    for field in fields
    if not field["path"].startswith("@")  # of the page alone
]
#: Unit of the examples of a quantity -> its kind on the page.
_KINDS = {
    "mm": {"length"},
    "N": {"load"},
    "N/mm": {"line_load"},
    "mm/s": {"speed"},
    "deg": {"angle"},
    "GPa": {"modulus"},
    "kPa": {"pressure"},
    "degC": {"temperature"},
    "s": {"time"},
}


#: Keys that are in no form, on purpose: the page keeps them and shows them in the run file.
WITHOUT_A_FORM = {
    # set where files are dropped, or materials, columns and points are chosen
    *("title", "data_origin", "measurement.curves", "measurement.mtm", "measurement.columns"),
    *("material.dma", "material.creep", "material.relaxation", "material.ramps", "material.amplitude_sweep"),
    *("material.master_curve", "material.file", "material.catalogue", "material.columns"),
    *("material.shift_factors", "material.fixed_shift_factors"),
    # of run files alone
    *("author", "citation", "comment", "licence", "sample"),
    *("cluster.account", "cluster.cores", "cluster.extra", "cluster.jobs", "cluster.memory", "cluster.prologue"),
    *("cluster.queue", "cluster.walltime", "sweep.together", "outputs.formats", "conditions.thickness"),
    *("material.shift_by", "material.shift_weights", "material.shift_factor_columns", "material.shift_factor_sheet"),
    *("interface.activation_energy", "interface.reference", "interface.area_error", "interface.level_error"),
    *("solver.cases", "solver.master_curve_points", "uncertainty.members", "uncertainty.seed"),
    # the page solves motions and impacts one by one
    *("history.before", "history.columns", "history.cycle", "history.sheet"),
    *("impact.gravity", "impact.mass", "impact.speed"),
    # of instrument files, and of patterns
    *("surface.channel", "surface.missing", "surface.exact", "surface.lines", "surface.period"),
    *("surface.angle", "surface.aspect", "surface.longest", "surface.rms_height"),
}


def test_a_key_in_no_form_is_left_out_on_purpose() -> None:
    assert keys() - {field["path"] for fields in FORMS.values() for field in fields} == WITHOUT_A_FORM


@pytest.mark.parametrize("field", _FIELDS)
def test_field_agrees_with_the_run_file(field: dict[str, Any]) -> None:
    schema = found(field["path"])
    assert schema, "no such key"
    for name, limits in (("min", ("minimum", "exclusiveMinimum")), ("max", ("maximum",))):
        least = [node[one] for node in schema for one in limits if one in node]
        if name in field and least:  # the page may ask for more than the file must have: a grid of few points
            assert field[name] >= min(least) if name == "min" else field[name] <= max(least)
    units = {example.partition(" ")[2] for node in schema for example in node.get("examples", ())}
    kinds = set().union(*(_KINDS.get(unit, set()) for unit in units))
    if field.get("kind", "plain") != "plain":
        assert field["kind"] in kinds
    words = {word for node in schema for word in node.get("enum", ())}
    if field.get("as") == "choice" and words:
        assert {one[0] if isinstance(one, list) else one for one in field["options"]} - {None} <= words | set(SHAPES)
    defaults = [node["default"] for node in schema if "default" in node]
    if field.get("otherwise") is not None and field["as"] == "choice" and defaults:
        assert field["otherwise"] == defaults[0]
    if field.get("placeholder", "").replace(".", "").isdigit() and defaults:
        assert float(field["placeholder"]) == pytest.approx(defaults[0] if defaults[0] != [0.0] else 0.0)


@pytest.mark.parametrize("field", _FIELDS)
def test_a_condition_is_about_keys_of_the_run_file(field: dict[str, Any]) -> None:
    conditions = [path for one in field.get("when", ()) for path in one]
    keys = [
        *conditions,
        *field.get("keys", ()),
        *(path for changes in field.get("sets", {}).values() for path in changes),
    ]
    assert [path for path in keys if path != "shape" and not found(path)] == []


@pytest.mark.parametrize("shape", SHAPES)
def test_what_a_shape_begins_with_is_a_study(shape: str, tmp_path: Path) -> None:
    begun = dict(SHAPES[shape])
    loads = {key: begun.pop(key) for key in ("load", "pressure") if key in begun}
    if shape == "scan":
        begun["surface"] = {**begun["surface"], "file": "heights.txt"}
    study = {
        "material": {"catalogue": "synthetic fluoroelastomer"},
        "conditions": {**loads, "speed": "20 mm/s", "temperature": "60 degC"},
        **begun,
    }
    _, checked = study_of(study, tmp_path)
    assert (checked.surface if "surface" in begun else checked.indenter) is not None
    assert shape in ("made", "scan", getattr(checked.indenter, "shape", None))


def test_options_of_a_card_are_those_of_its_job() -> None:
    options = {field["path"].removeprefix("@card."): field for field in FORMS["card"]}
    assert set(options) == set(export_card.Options.model_fields)
    begun = {name: field["otherwise"] for name, field in options.items() if "otherwise" in field}
    assert export_card.Options(**begun) == export_card.Options()
    for name, field in options.items():
        for value, _ in field.get("options", ()):
            export_card.Options(**{name: value})  # refuses what it does not know


def names_of(form: str, prefix: str) -> dict[str, list[Any]]:
    """Return the options of a form's fields that are no part of the study: their names, and the words of a choice."""
    own = [field for field in FORMS[form] if field["path"].startswith(prefix)]
    words = [[one[0] if isinstance(one, list) else one for one in field.get("options", ())] for field in own]
    return {field["path"].removeprefix(prefix): some for field, some in zip(own, words, strict=True)}


def test_options_of_an_identification_are_those_of_its_job() -> None:
    options = names_of("identify", "@identify.")
    for shift in options.pop("shift"):
        identify.Options(shift=shift)
    identify.Options(temperature_error="".join(options.pop("temperature_error")) or "1 K")
    for of in set(options.pop("anchor")) - {"nothing"}:
        identify.AnchorOptions(of=of, temperature="30 degC")
    assert set(options) == set(identify.AnchorOptions.model_fields) - {"of"}


def test_options_of_a_master_curve_and_a_motion_are_those_of_their_jobs() -> None:
    for law in names_of("master", "@friction.")["law"]:
        master.Options(law=law)
    options = names_of("motion", "@motion.")
    for name in ("path", "before"):
        for word in options[name]:
            motion.Options(**{name: word})
    begun = {field["path"].rpartition(".")[2]: field.get("otherwise") for field in FORMS["motion"]}
    assert set(names_of("motion", "@motion.impact.")) == set(motion.Impact.model_fields)
    motion.Impact(**{name: begun[name] for name in motion.Impact.model_fields})


def test_a_temperature_of_a_motion_may_have_a_unit() -> None:
    assert motion.Options(temperature="60 degC").temperature == pytest.approx(333.15)
    assert motion.Options(temperature=333.15).temperature == 333.15
    with pytest.raises(ValueError, match="temperature"):
        motion.Options(temperature="-300 degC")


def test_processes_of_a_study_are_an_option_of_its_job() -> None:
    (field,) = (one for one in FORMS["solving"] if one["path"].startswith("@"))
    assert field["path"] == "@export.workers"
    for workers in (field["min"], field["max"]):
        export_study.Options(workers=workers)
