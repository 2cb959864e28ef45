"""Creep and relaxation files of RepTate; their layout was tried on genuine files."""

from __future__ import annotations

import numpy as np
import pytest

from readers.refusal import refused
from readers.written import write
from viscofric.readers.steps.read import read_step_tests

TIMES = np.geomspace(0.01, 100.0, 9)


def test_creep_has_strain_and_stress(tmp_path):
    compliance = 1e-5 * TIMES**0.3
    rows = [f"{t:.6g}\t{10 * J:.6g}\t10\t149.9" for t, J in zip(TIMES, compliance, strict=True)]
    path = write(
        tmp_path, "chem=PE;label=CM3;T=150;stress=10;", "t\tstrain\tstress\tT", "s\t-\tPa\tC", *rows, name="a.creep"
    )
    tests = read_step_tests(path)
    assert (tests.kind, tests.deformation) == ("creep", "shear")
    assert tests.tests[0].temperature == pytest.approx(149.9 + 273.15)
    assert tests.tests[0].response == pytest.approx(compliance, rel=1e-5)


@pytest.mark.parametrize(("gamma", "strain"), [("gamma=2;", 2.0), ("", 1.0)])
def test_relaxation_has_the_strain_in_its_parameters(tmp_path, gamma, strain):
    modulus = 1e7 * TIMES**-0.3
    rows = [f" {t:.6E}      {strain * G:.6E}     " for t, G in zip(TIMES, modulus, strict=True)]
    path = write(tmp_path, f"ncontri=1;Mw=224;{gamma}T=30;", "t sxy", *rows, name="a.gt")
    tests = read_step_tests(path)
    assert (tests.kind, tests.deformation) == ("relaxation", "shear")
    assert tests.tests[0].temperature == pytest.approx(303.15)
    assert tests.tests[0].response == pytest.approx(modulus, rel=1e-5)


def test_without_a_temperature_it_is_asked_for(tmp_path):
    rows = [f"{t:.6g}\t{t**-0.3:.6g}" for t in TIMES]
    path = write(tmp_path, "gamma=1; ", "t sxy", *rows, name="a.gt")
    with refused("no-temperature"):
        read_step_tests(path)
    assert read_step_tests(path, temperature="30 degC").tests[0].temperature == pytest.approx(303.15)


def test_a_word_among_the_numbers_is_named_by_its_line(tmp_path):
    path = write(tmp_path, "gamma=1;T=30;", "t sxy", *[f"{t:.6g}\t1" for t in TIMES], "200\tx", name="a.gt")
    with refused("not-a-number", 12):
        read_step_tests(path)
