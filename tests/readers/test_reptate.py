"""Text of RepTate: sweeps at one temperature, and master curves without headings."""

from __future__ import annotations

import numpy as np
import pytest

from readers.refusal import refused
from readers.samples.reptate import sweep
from readers.samples.rubber import FREQUENCIES, moduli
from readers.written import write
from viscofric import read_dma


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
