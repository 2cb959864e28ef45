"""Text of RepTate: sweeps at one temperature, creep and relaxation; their layout was tried on genuine files."""

from __future__ import annotations

import numpy as np
import pytest

from readers.refusal import refused
from readers.samples.reptate import sweep
from readers.samples.rubber import FREQUENCIES, moduli
from readers.written import write
from viscofric import read_dma
from viscofric.readers.steps.read import read_step_tests

TIMES = np.geomspace(0.01, 100.0, 9)


def test_a_sweep_is_read_with_its_measured_temperature_and_strain(tmp_path):
    sweeps = read_dma(sweep(tmp_path))
    assert sweeps.deformation == "shear"
    (isotherm,) = sweeps.isotherms
    assert isotherm.temperature - 273.15 == pytest.approx(-9.98)  # mean of -10.00 … -9.96
    # five digits are printed
    assert isotherm.angular_frequency == pytest.approx(2 * np.pi * np.array(FREQUENCIES), rel=1e-4)
    assert isotherm.storage_modulus == pytest.approx([moduli(-10.0, f)[0] / 3 for f in FREQUENCIES], rel=1e-4)
    assert isotherm.loss_modulus == pytest.approx([moduli(-10.0, f)[1] / 3 for f in FREQUENCIES], rel=1e-4)
    assert isotherm.strain_amplitude == pytest.approx(np.full(5, 0.0199))


def test_without_a_column_the_first_line_shows_the_temperature(tmp_path):
    path = write(tmp_path, "T=40;Mw=88;", "Freq\tG'\tG''", "[Hz]\t[kPa]\t[kPa]", "1 5 0.5", "2 6 0.6")
    (isotherm,) = read_dma(path).isotherms
    assert isotherm.temperature == pytest.approx(313.15)
    assert isotherm.angular_frequency == pytest.approx([2 * np.pi, 4 * np.pi])
    assert isotherm.storage_modulus == pytest.approx([5e3, 6e3])


def test_without_units_they_are_those_of_reptate(tmp_path):
    path = write(tmp_path, "T=40;Mw=88;", "Freq\tG'\tG''", "1 5 0.5", "2 6 0.6")
    (isotherm,) = read_dma(path).isotherms
    assert isotherm.angular_frequency == pytest.approx([1.0, 2.0])
    assert isotherm.storage_modulus == pytest.approx([5.0, 6.0])


@pytest.mark.parametrize(
    ("lines", "refusal"),
    [
        (["T=40;Mw=88;", "1 5 0.5", "2 6 0.6"], ("master-curve", None, "40 °C")),
        (["T=40;Mw=88;"], ("no-points",)),
        (["T=40;Mw=88;", "Freq\tG'\tG''", "rad/s\tPa\tPa", "1 5"], ("row-length", 4, "3 columns")),
        (["T=40;Mw=88;", "Freq\tG'\tG''", "rad/s\tPa\tPa", "1 5 x"], ("not-a-number", 4, "'x'")),
        (["T=40;Mw=88;", "Freq\tG'\teta", "rad/s\tPa\tPas", "1 5 2"], ("missing-columns", None, "loss modulus")),
        (["T=40;Mw=88;", "Freq\tG'\tG''", "rad/s\tmm\tPa", "1 5 2"], ("wrong-unit", None, "'mm'")),
        (["Mw=88;", "Freq\tG'\tG''", "rad/s\tPa\tPa", "1 5 2"], ("no-temperature",)),
    ],
)
def test_what_is_wrong_is_said_in_one_sentence(tmp_path, lines, refusal):
    with refused(*refusal):
        read_dma(write(tmp_path, *lines))


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


def test_a_step_test_without_a_temperature_asks_for_it(tmp_path):
    rows = [f"{t:.6g}\t{t**-0.3:.6g}" for t in TIMES]
    path = write(tmp_path, "gamma=1; ", "t sxy", *rows, name="a.gt")
    with refused("no-temperature"):
        read_step_tests(path)
    assert read_step_tests(path, temperature="30 degC").tests[0].temperature == pytest.approx(303.15)


def test_a_word_among_the_numbers_is_named_by_its_line(tmp_path):
    path = write(tmp_path, "gamma=1;T=30;", "t sxy", *[f"{t:.6g}\t1" for t in TIMES], "200\tx", name="a.gt")
    with refused("not-a-number", 12):
        read_step_tests(path)
