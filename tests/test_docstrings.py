"""Docstrings tell the truth: parameters are those of the signature, and examples print what they show."""

from __future__ import annotations

import dataclasses
import doctest
import inspect
import io
import itertools
import pkgutil
import re

import pytest

from viscofric.lazy import full_names

#: public name -> the object, of the front door and of its submodules, but for the functions that draw
PUBLIC = {name: pkgutil.resolve_name(full) for name, full in full_names().items() if ".report." not in full}


def documented(docstring: str) -> list[str]:
    """Names in the section "Parameters" of a numpydoc docstring."""
    lines = inspect.cleandoc(docstring).splitlines()
    if "Parameters" not in lines:
        return []
    names: list[str] = []
    body = lines[lines.index("Parameters") + 2 :]
    for line, following in zip(body, [*body[1:], ""], strict=True):
        if re.fullmatch(r"-{3,}", following):  # the next section
            break
        if line and not line.startswith(" "):
            names += [name.strip().lstrip("*") for name in line.split(":")[0].split(",")]
    return names


def signature(function: object) -> list[str]:
    return [name for name in inspect.signature(function).parameters if name not in ("self", "cls")]


def methods() -> list[tuple[str, object]]:
    """Functions and public methods that have a section of parameters."""
    found = []
    for name, one in PUBLIC.items():
        if not inspect.isclass(one):
            found.append((name, one))
            continue
        for key, member in vars(one).items():
            function = getattr(member, "__func__", member)
            if not key.startswith("_") and inspect.isfunction(function) and documented(function.__doc__ or ""):
                found.append((f"{name}.{key}", function))
    return found


@pytest.mark.parametrize(("name", "function"), methods(), ids=lambda value: value if isinstance(value, str) else "")
def test_documented_parameters_are_those_of_the_signature(name, function):
    assert function.__doc__, f"{name} has no docstring"
    assert documented(function.__doc__) == signature(function)


@pytest.mark.parametrize("name", [name for name, one in PUBLIC.items() if dataclasses.is_dataclass(one)])
def test_documented_parameters_of_a_dataclass_are_those_it_takes(name):
    one = PUBLIC[name]
    reported = documented(one.__doc__)
    assert not reported or reported == signature(one)


#: Names of results, which verbs return and users do not make: their verbs have the examples.  And errors.
RETURNED = {
    "ContactAtStrain",
    "GlassTransition",
    "LinearRange",
    "PayneFit",
    "RampCheck",
    "RampSuperposition",
    "Agreement",
    "AssumptionCheck",
    "Card",
    "CatalogueEntry",
    "Citations",
    "ContactHeating",
    "TransientHeating",
    "ContactSolution",
    "HeatedFrictionCurves",
    "HeatedPerssonTheory",
    "HeatedRoughFriction",
    "ContactStatistics",
    "Diagnostics",
    "FrictionByWavelength",
    "FrictionDerivatives",
    "FittedRecord",
    "FrictionMasterCurve",
    "Identified",
    "IdentifiedMaterial",
    "MaterialFromIndentation",
    "JointSuperposition",
    "LawComparison",
    "MaterialSamples",
    "OverlapQuality",
    "PeriodicDiagnostics",
    "PeriodicSolution",
    "PerssonTheory",
    "ResultsComparison",
    "RoughFriction",
    "ShearStress",
    "ShiftAgreement",
    "SpectrumFit",
    "StepCheck",
    "StepSuperposition",
    "Study",
    "StudyResults",
    "Superposition",
    "SuperpositionCheck",
    "TractionStep",
    "CycleSolution",
    "ImpactContact",
    "ImpactSolution",
    "RestitutionCurve",
    "TransientErrors",
    "TransientSolution",
}
#: What other names need that no example can have: a class to be derived from, a workbook of an instrument.
WITHOUT_EXAMPLE = {"InterfaceLaw", "ShiftLaw", "VerticalShift", "read_vendor_law"}


def examples() -> list[doctest.DocTest]:
    """Examples of all public names and of their methods."""
    finder = doctest.DocTestFinder(exclude_empty=True)
    found = [found for name, one in PUBLIC.items() for found in finder.find(one, name, module=False)]
    return [one for one in found if one.examples]


#: Examples that take more than a second, and run apart: tests of each room call these functions.
LONG = {"identify_material", "open_results", "run_study"}


@pytest.mark.parametrize(
    "example",
    [pytest.param(one, id=one.name, marks=[pytest.mark.apart] if one.name in LONG else []) for one in examples()],
)
def test_examples_of_docstrings_print_what_they_show(example, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    said = io.StringIO()
    example.globs = {}
    doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(example, out=said.write)
    assert not said.getvalue(), said.getvalue()


def test_an_example_that_is_wrong_is_found(tmp_path):
    wrong = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "wrong", None, 0)
    said = io.StringIO()
    assert doctest.DocTestRunner().run(wrong, out=said.write).failed == 1
    assert "Expected" in said.getvalue()


def sections(docstring: str) -> set[str]:
    lines = inspect.cleandoc(docstring).splitlines()
    return {line for line, below in itertools.pairwise(lines) if re.fullmatch(r"-{3,}", below)}


@pytest.mark.parametrize("name", PUBLIC)
def test_docstrings_are_complete(name):
    one = PUBLIC[name]
    has = sections(one.__doc__)
    is_error = inspect.isclass(one) and issubclass(one, Exception)
    if inspect.isclass(one):
        assert is_error or name in WITHOUT_EXAMPLE or has & {"Parameters", "Attributes"}
    else:
        assert has >= {"Parameters", "Raises"} or not signature(one)
        returns = inspect.signature(one).return_annotation
        assert ("Returns" in has) == (returns not in (None, "None"))
    assert "Examples" in has or is_error or name in RETURNED | WITHOUT_EXAMPLE


def test_lists_of_names_without_examples_hold_only_such():
    for name in RETURNED | WITHOUT_EXAMPLE:
        assert "Examples" not in sections(PUBLIC[name].__doc__), name
