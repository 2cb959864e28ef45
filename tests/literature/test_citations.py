"""Papers that results rest on: the right ones for each kind of result, whole, readable, and valid BibTeX."""

from __future__ import annotations

import re
import tomllib
from dataclasses import FrozenInstanceError
from pathlib import Path

import numpy as np
import pytest
import xarray
import yaml

import viscofric as vf
from viscofric.contact.derivatives.friction import FrictionDerivatives
from viscofric.literature.references import PAPER, REFERENCES
from viscofric.study import StudyResults

SOURCE = Path(vf.__file__).parent
RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
CONTACT = {PAPER.key, "carbone2013", "hertz1882", "johnson1985", "eisenstat1983"}
POINT, LINE = CONTACT | {"love1929"}, CONTACT | {"hunter1961"}
SWEPT = {PAPER.key, "golub1973", "wood2011", "vangurp1998"}


def keys(*results: object) -> set[str]:
    """Keys without that of the software, which always comes first."""
    first, *others = vf.citations(*results).keys
    assert first == "viscofric"
    return set(others)


def curves(source: str = "predicted", load_unit: str = "N", **columns: object) -> vf.FrictionCurves:
    speed, temperature = np.tile(np.geomspace(0.02, 0.2, 10), 3), np.repeat([303.15, 308.15, 313.15], 10)
    law = vf.WLF(C1=9.0, C2=100.0, reference=303.15)
    friction = 0.01 * (1.0 + (law(temperature) * speed / 0.02) ** -0.4)
    zero, one = np.zeros(30), np.ones(30)
    return vf.FrictionCurves(
        speed, temperature, 25.0 * one, friction, zero, zero, one, source=source, load_unit=load_unit, **columns
    )


def test_contacts_rest_on_the_paper_and_on_the_solution_they_are_held_against() -> None:
    contact = {"speed": "1 m/s", "accuracy": 1e-1}
    point = vf.solve_steady(RUBBER, vf.Ball("10 mm"), load="1 N", derivatives=True, **contact)
    assert isinstance(point.derivatives, FrictionDerivatives)
    assert keys(point) == POINT | {"giles2000"}
    assert keys(vf.solve_steady(RUBBER, vf.Cylinder("10 mm"), load="1 N/mm", **contact)) == LINE


def test_rough_surfaces() -> None:
    made = vf.self_affine(0.8, shape=(16, 16), spacing="8 um", shortest="32 um", rms_slope=0.1, seed=1)
    solution = vf.solve_periodic(RUBBER, made.to_surface(), speed="1 m/s", pressure="50 kPa")
    surface = {PAPER.key, "lions1979", "anderson1965", "eisenstat1983"}
    assert keys(solution) == surface
    assert keys(vf.roughness.contact_statistics(solution)) == {"yastrebov2017"}
    spectrum = vf.roughness.power_spectrum(made)
    assert keys(spectrum) == {"persson2005", "jacobs2017"}
    asked = {"speeds": 1.0, "pressure": "50 kPa"}
    theory = {"persson2001", "lorenz2015"}
    assert keys(vf.persson_theory(RUBBER, spectrum, temperatures=None, **asked)) == theory
    hot = vf.ThermalProperties("0.25 W/m/K", "1200 kg/m**3", "1500 J/kg/K", "rubber")
    warm = vf.persson_theory(vf.synthetic_fluoroelastomer(), spectrum, temperatures=300.0, thermal=hot, **asked)
    assert keys(warm) == theory | {"persson2006"}


def test_rubber_rests_on_its_law_and_on_those_who_measured_it() -> None:
    assert keys(RUBBER) == {PAPER.key}
    assert keys(vf.synthetic_fluoroelastomer()) == {PAPER.key, "williams1955"}
    vft = vf.Material(RUBBER.spectrum, shift=vf.VFT(B=2000.0, T0=200.0, reference=300.0))
    assert keys(vft) == {PAPER.key, "vogel1921", "fulcher1925", "tammann1926"}
    arrhenius = vf.Material(RUBBER.spectrum, shift=vf.Arrhenius(activation_energy=8e4, reference=300.0))
    assert keys(arrhenius) == {PAPER.key}
    published = vf.catalogue_material("PVB interlayer")
    assert published.citation in str(vf.citations(published).entries[-1].reference)
    omega = np.geomspace(1.0, 1e6, 30)
    modulus = RUBBER.complex_modulus(omega)
    assert keys(vf.rheology.ModulusTable(omega, modulus.real, modulus.imag)) == {"fritsch1984"}
    assert keys(RUBBER.spectrum.to_relaxation()) == {"park1999"}
    assert keys(vf.Layer("1 mm")) == {"carbone2008", "putignano2015", "johnson1985"}


@pytest.mark.slow
def test_sweeps_become_a_rubber() -> None:
    planted = vf.synthetic_fluoroelastomer()
    omega = np.geomspace(1.0, 100.0, 8)
    moduli = {kelvin: planted.complex_modulus(omega, kelvin) for kelvin in (293.15, 298.15, 303.15, 308.15, 313.15)}
    sweeps = vf.IsothermalSweeps(tuple(vf.Isotherm(kelvin, omega, E.real, E.imag) for kelvin, E in moduli.items()))
    fit = vf.superpose(sweeps, "30 degC")
    assert keys(fit) == SWEPT
    assert keys(fit.shift_factors) == {PAPER.key}
    assert "akaike1974" in keys(fit.shift_factors.compare_laws())
    spectrum = vf.fit_retardation_spectrum(fit.master_curve)
    assert keys(spectrum) == {PAPER.key, "lawson1974"}
    smooth = vf.fit_retardation_spectrum(fit.master_curve, method="regularised")
    assert keys(smooth) == {PAPER.key, "lawson1974", "hansen1993"}
    assert keys(vf.sample_materials(fit, spectrum, samples=20)) == {"efron1993"}


def test_friction_curves_distinguish_predicted_from_measured() -> None:
    assert keys(curves()) == POINT
    assert keys(curves(load_unit="N/m")) == LINE
    assert keys(curves(material_error=np.ones(30))) == POINT | {"efron1993", "giles2000"}
    assert keys(curves("predicted (synthetic)")) == POINT  # as files keep it
    assert keys(curves("predicted_and_measured.csv")) == set()
    assert keys(curves("mtm.csv")) == set()
    assert keys(curves("mtm.csv", coulomb=np.ones(30))) == {PAPER.key}


def test_master_curve_with_given_and_with_found_shifts() -> None:
    law = vf.WLF(C1=9.0, C2=100.0, reference="30 degC")
    given = vf.shift_friction(curves("table"), shift=law)
    assert keys(given) == {PAPER.key, "williams1955", "cleveland1979"}
    found = vf.shift_friction(curves("table"), reference="30 degC")
    assert keys(found) == {PAPER.key, "golub1973", "cleveland1979"}


RUN_FILE = """
[material]
dma = "dma.csv"
shift = "best"
spectrum = "regularised"
[indenter]
shape = "{shape}"
[layer]
thickness = "1 mm"
"""


def results(text: str, **groups: xarray.Dataset) -> StudyResults:
    tree = xarray.DataTree.from_dict({f"/{name}": data for name, data in groups.items()})
    tree.attrs["study_text"] = text
    return StudyResults(tree, Path("study.results"))


@pytest.mark.parametrize(("shape", "contact"), [("ball", POINT), ("cylinder", LINE)])
def test_study_rests_on_all_of_its_parts(shape: str, contact: set[str]) -> None:
    """The run file says what was asked for, the groups what was found."""
    numbers = xarray.Dataset({"friction_lower": ("speed", np.ones(2)), "coulomb": ("point", np.ones(3))})
    study = results(
        RUN_FILE.format(shape=shape),
        superposition=xarray.Dataset(),
        master_curve=xarray.Dataset(),
        shift_law=xarray.Dataset(attrs={"law": "VFT"}),
        prediction=numbers,
        measurement=numbers,
        measurement_master=xarray.Dataset(),
    )
    rubber = SWEPT | {"lawson1974", "hansen1993", "vogel1921", "fulcher1925", "tammann1926", "akaike1974"}
    layer = {"carbone2008", "putignano2015", "johnson1985"}
    assert keys(study) == rubber | contact | layer | {"efron1993", "giles2000", "cleveland1979"}


def test_study_of_a_catalogue_rubber_on_a_rough_surface() -> None:
    study = results('[material]\ncatalogue = "PVB interlayer"\n[surface]\nhurst = 0.8\n', prediction=xarray.Dataset())
    assert {"lions1979", "williams1955"} < keys(study)
    assert "Van Duser" in str(vf.citations(study))
    assert "hertz1882" not in keys(study)


def test_several_results_are_one_list_without_repetition() -> None:
    rubber = vf.synthetic_fluoroelastomer()
    together = vf.citations(rubber, curves(), rubber)
    assert len(set(together.keys)) == len(together)
    assert set(together.keys) == {"viscofric"} | keys(rubber) | keys(curves())
    (paper,) = (entry for entry in together if entry.reference is PAPER)
    assert len(paper.reasons) == len(set(paper.reasons)) == 3  # Eq. 4, Eqs. 3 and 5, Eq. 8
    with pytest.raises(FrozenInstanceError):
        together.entries = ()  # type: ignore[misc]


@pytest.mark.parametrize("wrong", [(), (3,), ("solution",), (RUBBER, None)])
def test_what_is_no_result_is_said_in_a_sentence(wrong: tuple[object, ...]) -> None:
    with pytest.raises(vf.InputError) as caught:
        vf.citations(*wrong)
    assert caught.value.code == ("no-references" if wrong else "no-result")


def test_printed_list_is_readable() -> None:
    lines = str(vf.citations(vf.synthetic_fluoroelastomer(), curves())).splitlines()
    assert lines[0].startswith(f"[1] viscofric developers, “viscofric”, version {vf.__version__}")
    assert max(map(len, lines)) <= 120
    heads = [int(line[1 : line.index("]")]) for line in lines if line.startswith("[")]
    assert heads == list(range(1, len(heads) + 1))
    assert all(line.startswith(("[", "    ")) for line in lines)


def test_bibtex_is_well_formed() -> None:
    everything = "\n".join(reference.bibtex() for reference in REFERENCES.values())
    entries = re.findall(r"^@(article|book|misc)\{(\w+),\n((?:  \w+ = \{.*\},\n)+)\}$", everything, re.MULTILINE)
    assert [key for _, key, _ in entries] == list(REFERENCES)
    for kind, key, fields in entries:
        names = dict(re.findall(r"^  (\w+) = \{(.*)\},$", fields, re.MULTILINE))
        assert fields.count("{") == fields.count("}")
        needed = {"article": {"author", "journal", "year"}, "book": {"author", "title", "publisher", "year"}}
        assert needed.get(kind, set()) <= set(names)
        assert not re.search(r"(?<!\\)[&%#$]", re.sub(r"(?m)^  doi.*$", "", fields)), key
    assert r"Chapman \& Hall" in everything


@pytest.mark.parametrize("reference", REFERENCES.values(), ids=lambda reference: reference.key)
def test_reference_agrees_with_its_key_and_with_the_docstrings(reference) -> None:
    """Volume, year and first page are those of the docstrings that cite the same paper, with the same DOI."""
    assert not reference.doi or re.fullmatch(r"10\.\d{4,9}/\S+", reference.doi)
    family = re.sub(r"[^a-z]", "", reference.authors[0].split(". ")[-1].lower())
    assert reference.key == f"{family}{reference.year}"
    if reference.key in {PAPER.key, "hertz1882", "carbone2013"} or not reference.journal:
        return  # not in a docstring, or a book
    volume, page = reference.volume.replace("--", "–"), reference.pages.split("--")[0]
    gap = r"[ \n#]+"  # may go on in the next line of a comment
    cited = rf"{volume}{gap}\({reference.year}\){gap}{page}\b(?:,{gap}doi:(\S+?)[.,;:\"]*(?=\s))?"
    found = re.findall(cited, TEXT)
    assert found, f"no docstring cites {reference}"
    assert {doi for doi in found if doi} <= {reference.doi}


TEXT = "\n".join(path.read_text("utf-8") for path in SOURCE.rglob("*.py") if path.parent.name != "literature")


def test_citation_file_names_the_software_and_the_paper() -> None:
    """As pyproject.toml does: same authors, same licence; keys are those that CFF 1.2.0 knows and asks for."""
    root = Path(__file__).parents[2]
    reported = yaml.safe_load((root / "CITATION.cff").read_text("utf-8"))
    project = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["project"]
    assert {"cff-version", "message", "title", "authors"} <= set(reported)
    known = {"cff-version", "message", "title", "authors", "abstract", "type", "license", "references", "keywords"}
    assert set(reported) <= known
    (paper,) = reported["references"]
    assert paper["title"] == PAPER.title
    assert tuple(f"{one['given-names']} {one['family-names']}" for one in paper["authors"]) == PAPER.authors
    assert (str(paper["volume"]), f"{paper['start']}--{paper['end']}") == (PAPER.volume, PAPER.pages)
    assert paper["year"] == PAPER.year
    assert reported["title"] == project["name"]
    assert reported["authors"] == project["authors"]
    assert reported["license"] == project["license"]
    assert PAPER.title in reported["abstract"]
