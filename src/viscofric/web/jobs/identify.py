"""Job ``identify``: the material inferred from measured friction."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, Literal

from pydantic import Field

from viscofric.datasets import plain, record
from viscofric.errors import InputError
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.identification.anchors import Anchor, ContactAnchor, ModulusAnchor
from viscofric.friction.identification.identify import LEVELS, deviation, identify_material
from viscofric.friction.identification.result import IdentifiedMaterial
from viscofric.notes import Note
from viscofric.rheology.cards import write_card
from viscofric.rheology.material import Material
from viscofric.study.run_file.settings import SolverTable
from viscofric.units import angular_frequency, celsius, positive
from viscofric.web.figures.friction import identified_view
from viscofric.web.jobs.context import Context, JobError, JobOptions
from viscofric.web.jobs.friction_data import by_temperature, measured_points, texts
from viscofric.web.jobs.friction_input import friction_curves, indenter_of, measured
from viscofric.web.jobs.rubbers import checked_part, made_rubber
from viscofric.web.study_text import study_of

_DOWNLOAD = "rubber_from_friction.json"
_DIGITS = 6
_OF_A_BAND = ("low", "high", "limit", "relative", "decades")
#: Steps that settle it as a rule, before the family of levels.
_STEPS = 4


_Text = Annotated[str, Field(max_length=100)]


class Options(JobOptions):
    """Options of the job."""

    shift: Literal["friction", "rubber"] = "friction"  # where α(T) comes from
    anchor: AnchorOptions | None = None  # what fixes the level of the modulus
    beside: bool = True  # whether to compare with the page's material
    #: Relative error of each contact that is solved; that of [solver] without
    accuracy: float | None = Field(None, ge=1e-4, le=0.1)
    samples: int = Field(200, ge=20, le=1_000)  # of the material, for the bands
    temperature_error: _Text = "0 K"  # standard error of every temperature


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Identify the rubber behind the friction of [measurement]; [material] counts where the options request it."""
    curves = friction_curves(study, context)
    indenter = indenter_of(study)
    if indenter is None:
        missing = Note("missing", "is missing; give the indenter of the test, such as a ball.", "indenter")
        raise JobError(missing, "indenter")
    leans = options.shift == "rubber" or (options.anchor is not None and options.anchor.of == "rubber")
    made = made_rubber(study, context) if options.beside or leans else None
    rubber = None if made is None else made.material
    accuracy = checked_part(solver=(SolverTable, study.get("solver", {}))).solver.accuracy
    chosen: dict[str, Any] = {"accuracy": options.accuracy or accuracy, "samples": options.samples}
    try:
        chosen["temperature_error"] = deviation(options.temperature_error, "delta_degC", "temperature_error")
    except InputError as error:
        raise JobError(str(error), "@identify.temperature_error", code=error.code) from error
    if options.shift == "rubber":
        if rubber is None or not rubber.has_shift_factors:
            words = "The page's material has no shift factors; choose “found from friction”."
            raise JobError(words, "@identify.shift", code="no-shift")
        chosen["shift"] = rubber.shift
    anchor = None if options.anchor is None else make_anchor(options.anchor, rubber, curves.load_unit)
    steps = _STEPS + (len(LEVELS) if anchor is None else 0)

    def report(step: int, done: int, total: int) -> None:
        whole = max(steps, step) * total
        context.progress((step - 1) * total + done, whole, f"step {step}, contact {done} of {total}")

    context.progress(0, 1, "Finding shift factors from friction" if options.shift == "friction" else "Setting up")
    found = identify_material(
        curves,
        indenter=indenter,
        anchor=anchor,
        poisson_ratio=_poisson_ratio(study, rubber),
        name="rubber identified from friction",
        progress=report,
        **chosen,
    )
    made_up = measured(study, context).synthetic
    of_rubber = made is not None and (made.synthetic or study.get("data_origin") == "synthetic")
    from_synthetic = made_up or (leans and of_rubber)
    material = replace(found.material, synthetic=from_synthetic)
    write_card(material, context.downloads / _DOWNLOAD, format="json")
    reply = _reply(found, curves, rubber if options.beside else None, anchor)
    about = {"temperature": _temperatures(study, material, context), "from_synthetic": from_synthetic}
    numbers: dict[str, Any] = plain(reply | about)
    synthetic = made_up or (None if options.beside else False)
    return numbers | identified_view(numbers, plain(measured_points(curves)), synthetic=synthetic)


def _temperatures(study: dict[str, Any], material: Material, context: Context) -> dict[str, Any] | None:
    """Return the ``given`` temperatures of a study and those ``kept`` that a material has; None where it has all."""
    try:
        kelvin = study_of(study, context.files)[1].conditions.temperature
    except InputError:
        return None  # other fields say what is wrong
    shift, given = material.shift, study["conditions"].get("temperature")
    if shift is None or (known := shift.valid_at(list(kelvin))).all():
        return None
    texts = given if isinstance(given, list) else [f"{celsius(one):.6g} degC" for one in kelvin]
    kept = [text for text, has in zip(texts, known, strict=True) if has]
    return {"given": given, "kept": kept or [f"{celsius(shift.reference):.6g} degC"]}


def _poisson_ratio(study: dict[str, Any], rubber: Material | None) -> float:
    """Return that of the page's rubber, for contacts of the same kind."""
    if rubber is not None:
        return float(rubber.poisson_ratio)
    material = study.get("material")
    if isinstance(material, list) and material:
        material = material[0]  # as everywhere where one rubber is meant
    given = material.get("poisson_ratio", 0.5) if isinstance(material, dict) else 0.5
    return float(given) if isinstance(given, int | float) else 0.5


def _reply(
    found: IdentifiedMaterial, curves: FrictionCurves, rubber: Material | None, anchor: Anchor | None
) -> dict[str, Any]:
    modulus, factors = record(found.to_dataset(), _DIGITS), found.shift_dataset()
    at = None
    if anchor is not None and hasattr(anchor, "modulus"):
        at = {name: getattr(anchor, name) for name in ("modulus", "angular_frequency", "temperature", "error")}
    return {
        "reference": found.material.reference,
        "modulus": modulus,
        "identified": {name: getattr(found.identified, name) for name in _OF_A_BAND},
        "middle": found.middle,
        "anchored": found.anchored,
        "anchor": at,
        "factors": None if factors is None or factors.sizes["temperature"] < 2 else record(factors, _DIGITS),
        "known": None if rubber is None else _known(rubber, found),
        "fit": _fit(found),
        "family": [
            {name: getattr(fit, name) for name in ("factor", "modulus", "rms", "penalty")} for fit in found.family
        ],
        "sentences": texts(found.sentences),
        "download": _DOWNLOAD,
    }


def _known(rubber: Material, found: IdentifiedMaterial) -> dict[str, Any] | None:
    """Return the page's rubber at the temperature at which the identified one is described; None if it is not known."""
    reference = found.material.reference
    if rubber.shift is not None and reference is not None:
        if not rubber.shift.valid_at(reference):
            return None
        rubber = rubber.at_reference(reference)
    return {"name": rubber.name, **record(rubber.spectrum.modulus_dataset(found.frequencies), _DIGITS)}


def _fit(found: IdentifiedMaterial) -> list[dict[str, Any]]:
    """Return how well the identified rubber meets the friction, by temperature."""
    fit = found.friction
    # ln μ is what is fitted, so that a residual times its error is a relative difference.
    band = {"lower": fit.viscoelastic_lower, "upper": fit.viscoelastic_upper}
    return by_temperature(fit.temperature, fit.speed, fitted=fit.viscoelastic, residual=found.residuals, **band)


#: Arguments of anchors that the page's fields name otherwise.
_FIELDS = dict.fromkeys(("indentation", "contact_area", "half_width"), "size")


class AnchorOptions(JobOptions):
    """An anchor; every quantity is text with its unit."""

    #: "modulus" that is given, that of the page's "rubber", or the size of a contact: "indentation", "contact_area"
    #: or "half_width"
    of: Literal["modulus", "rubber", "indentation", "contact_area", "half_width"]
    modulus: _Text | None = None  # modulus, frequency: |E| at one frequency; that of the rubber is read there
    frequency: _Text | None = None
    size: _Text | None = None  # size, speed, load: of the moving contact
    speed: _Text | None = None
    load: _Text | None = None
    temperature: _Text
    error: float = Field(0.01, gt=0.0, lt=1.0)  # relative standard error


def make_anchor(requested: AnchorOptions, rubber: Material | None, load_unit: str) -> Anchor:
    """Return the requested anchor, or that of a rubber's modulus; `JobError` if a quantity cannot be used."""
    try:
        of_modulus = requested.of in ("modulus", "rubber")
        return _of_modulus(requested, rubber) if of_modulus else _of_contact(requested, load_unit)
    except InputError as error:
        name = str(error.note.values.get("argument", "anchor"))
        field = f"@identify.{_FIELDS.get(name, name)}"
        raise JobError(f"The anchor cannot be used: {error}", field, code=error.code) from error


def _given(requested: AnchorOptions, *names: str) -> list[str]:
    for name in names:
        if not getattr(requested, name):
            raise InputError(f"its {name} is missing.", code="missing", values={"argument": name})
    return [getattr(requested, name) for name in names]


def _of_modulus(requested: AnchorOptions, rubber: Material | None) -> Anchor:
    known: Any = _given(requested, "modulus")[0] if requested.of == "modulus" else None
    at = angular_frequency(_given(requested, "frequency")[0], "frequency")
    if requested.of == "rubber":
        if rubber is None:
            raise InputError("there is no rubber whose modulus could be taken.", code="no-rubber")
        known = abs(complex(rubber.complex_modulus(at, requested.temperature)))
    return ModulusAnchor(known, at, requested.temperature, error=requested.error)


def _of_contact(requested: AnchorOptions, load_unit: str) -> Anchor:
    size, speed, load = _given(requested, "size", "speed", "load")
    given: dict[str, Any] = {requested.of: size, "load": positive(load, load_unit, "load")}
    return ContactAnchor(speed, requested.temperature, **given, error=requested.error)
