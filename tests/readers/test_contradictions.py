"""What a file says twice, or cannot mean, is refused or told: thousands, swapped columns, amplitude sweeps, units."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest

from readers.refusal import noted, refused
from readers.samples import mettler, rheocompass, trios, universal_analysis
from readers.samples.eplexor import raw_tables, save
from readers.samples.workbook import write as write_workbook
from viscofric import read_dma
from viscofric.readers.dma.master_curves import read_master_curve
from viscofric.readers.source import decimal_comma, to_rad_per_second, unit_conversion
from viscofric.rheology.catalogue import catalogue_material

FREQUENCIES = (0.1, 0.316, 1.0, 3.16, 10.0, 31.6)  # Hz
HEADER = "T (degC),f (Hz),E' (MPa),E'' (MPa)"


def moduli(celsius, hertz):
    """Return storage and loss modulus, MPa, of a synthetic rubber that softens when it warms."""
    z = (1j * hertz * 10.0 ** (-0.08 * celsius)) ** 0.3
    E = 1.0 + 100.0 * z / (1.0 + z)
    return E.real, E.imag


def rows(temperatures=(0.0, 20.0, 40.0), factor=1.0):
    return [(T, f, *(factor * one for one in moduli(T, f))) for T in temperatures for f in FREQUENCIES]


def write(folder, points, header=HEADER, name="sweeps.csv"):
    path = folder / name
    path.write_text("\n".join([header, *(",".join(f"{x:.6g}" for x in row) for row in points)]), encoding="utf-8")
    return path


def notes_with(sweeps, code, *names):
    return noted(sweeps.notes, code, *names)


# Thousands


@pytest.mark.parametrize(
    ("cells", "comma"),
    [
        (["1,5", "2,345"], True),  # one cell cannot part thousands, so none does
        (["0,123", "2,345"], True),  # no thousands mark stands behind a zero
        (["1234,567"], True),
        (["1,234E5"], True),
        (["1.5", "2"], False),
    ],
)
def test_a_comma_is_decimal_where_it_can_be_nothing_else(cells, comma):
    assert decimal_comma("x.txt", [(cell, 1) for cell in cells]) == comma


def test_a_comma_before_three_digits_everywhere_is_refused(tmp_path):
    path = tmp_path / "kilo.tsv"
    path.write_text("T (degC)\tf (Hz)\tE' (kPa)\tE'' (kPa)\n0\t1\t33,468\t1158\n0\t2\t44,215\t1582\n", encoding="utf-8")
    with refused("ambiguous-decimals", 2, "'33,468'", "33.468", "33468"):
        read_dma(path)


def test_text_with_commas_beside_numbers_of_a_workbook_is_refused(tmp_path):
    cells = [["T (°C)", "f (Hz)", "E' (MPa)", "E'' (MPa)"], [0.0, 1.0, "1,234", 120.0], [0.0, 2.0, "2,234", 220.0]]
    with refused("ambiguous-decimals", 2, "'1,234'"):
        read_dma(write_workbook(tmp_path / "text.xlsx", {"DMA": cells}))


@pytest.mark.parametrize("kind", ["rheocompass", "trios", "eplexor", "mettler"])
def test_exports_of_instruments_do_not_part_thousands_in_silence(tmp_path, kind):
    path = tmp_path / "export.txt"
    if kind == "rheocompass":
        head = "Project:\tx\n\nInterval and data points:\t1\t2\nInterval data:\tPoint No.\tTemperature\t"
        head += "Angular Frequency\tStorage Modulus\tLoss Modulus\n\t\t[°C]\t[rad/s]\t[Pa]\t[Pa]\n"
        path.write_text(head + "\t1\t25\t1\t123,456\t13000\n\t2\t25\t10\t223,456\t23000\n", encoding="utf-8")
    elif kind == "trios":
        head = "Filename\tx\nInstrument name\ty\n[step]\nFrequency sweep\nTemperature\tFrequency\tStorage modulus\t"
        path.write_text(
            head + "Loss modulus\n°C\tHz\tPa\tPa\n20\t1\t123,456\t1000\n20\t2\t223,456\t2000\n", encoding="utf-8"
        )
    elif kind == "mettler":
        names = "Index Ts f E' E\"\n[#] [°C] [Hz] [MPa] [MPa]\n"
        path.write_text(names + "0 20 1 1,234 120\n1 20 2 2,234 220\n", encoding="utf-8")
    else:
        tables = raw_tables()
        for row in tables["Exported Data"][2:]:
            row[6] = "1,234"
        path = save(tmp_path / "export.xlsx", tables)
    with refused("ambiguous-decimals"):
        read_dma(path)


# Swapped columns


def with_tangent(points):
    return [(*row, row[3] / row[2]) for row in points]


def test_swapped_moduli_contradict_the_loss_tangent(tmp_path):
    header = HEADER + ",tan delta"
    assert len(read_dma(write(tmp_path, with_tangent(rows()), header))) == 3
    swapped = [(T, f, loss, storage, tangent) for T, f, storage, loss, tangent in with_tangent(rows())]
    with refused("columns-contradict", None, "18", "18 points"):
        read_dma(write(tmp_path, swapped, header))


def test_an_absolute_modulus_of_another_unit_is_refused(tmp_path):
    header = HEADER + ",|E*| (MPa)"
    agreeing = [(*row, math.hypot(row[2], row[3])) for row in rows()]
    assert len(read_dma(write(tmp_path, agreeing, header))) == 3
    with refused("columns-contradict", None, "18", "18 points"):
        read_dma(write(tmp_path, [(*row[:4], 10.0 * row[4]) for row in agreeing], header))


def test_few_contradictions_are_noise(tmp_path):
    points = with_tangent(rows())
    points[:8] = [(*row[:4], 3.0 * row[4]) for row in points[:8]]  # less than half
    assert len(read_dma(write(tmp_path, points, HEADER + ",tan delta"))) == 3


def test_tangents_of_two_decimals_agree(tmp_path):
    points = [(*row[:3], 0.024 * row[2], 0.02) for row in rows()]  # 0.024 as printed
    assert len(read_dma(write(tmp_path, points, HEADER + ",tan delta"))) == 3


@pytest.mark.parametrize("kind", ["trios", "universal analysis", "mettler", "mettler |E*|", "eplexor", "eplexor |E*|"])
def test_instruments_that_contradict_themselves_are_refused(tmp_path, kind):
    path = tmp_path / "export.txt"
    if kind == "trios":
        path = trios.write_short(tmp_path)
        text = path.read_text(encoding="utf-8").replace(
            "Storage modulus\tLoss modulus", "Loss modulus\tStorage modulus"
        )
        path.write_text(text, encoding="utf-8")
    elif kind == "universal analysis":
        text = "\n".join(universal_analysis.text_lines()).replace("Loss Modulus (MPa)", "Loss Modulus (kPa)")
        path.write_text(text, encoding="utf-8")
    elif kind.startswith("mettler"):
        if "|" in kind:  # both moduli are 1000 times the third, and tan δ stays
            mega, giga = (f"[{unit}]".rjust(mettler.WIDTH) for unit in ("MPa", "GPa"))
            text = mettler.text().replace(3 * mega, 2 * giga + mega)
        else:
            text = mettler.text().replace("E'".rjust(mettler.WIDTH) + 'E"'.rjust(mettler.WIDTH), "%s")
            text = text.replace("%s", 'E"'.rjust(mettler.WIDTH) + "E'".rjust(mettler.WIDTH))
        path.write_bytes(text.encode("iso-8859-1"))
    else:
        tables = raw_tables()
        names = tables["Exported Data"][0]
        place = names.index("|E*|" if "|" in kind else "tan delta")
        for row in tables["Exported Data"][2:]:
            row[place] *= 5.0
        path = save(tmp_path / "export.xlsx", tables)
    with refused("columns-contradict"):
        read_dma(path)


# Amplitude sweeps

STRAIN = HEADER + ",strain (%)"
AMPLITUDES = np.geomspace(0.1, 30.0, 12)  # %


def test_a_sweep_of_the_amplitude_is_refused(tmp_path):
    scatter = 1.0 + 0.01 * np.random.default_rng(0).standard_normal(12)
    held = [(25.0, 10.0 * s, 5.0 / (1.0 + a), 1.0 / (1.0 + a), a) for a, s in zip(AMPLITUDES, scatter, strict=True)]
    with refused("amplitude-sweep", None, "25.0 °C", "0.1", "30 %"):
        read_dma(write(tmp_path, held, STRAIN))
    at_three = [(25.0, f, 5.0 / (1.0 + a), 1.0 / (1.0 + a), a) for f in (1.0, 3.0, 10.0) for a in AMPLITUDES]
    with refused("amplitude-sweep"):
        read_dma(write(tmp_path, at_three, STRAIN))


def softened(row, amplitude):
    """Return a row at another amplitude, which a filled rubber answers with a lower modulus."""
    return (*row[:2], *(value / (1.0 + amplitude) for value in row[2:]), amplitude)


def test_of_sweeps_at_several_amplitudes_the_smallest_are_used(tmp_path):
    single = read_dma(write(tmp_path, [softened(row, 0.1) for row in rows()], STRAIN))
    mixed = [softened(row, amplitude) for amplitude in (1.0, 0.1) for row in rows()]
    sweeps = read_dma(write(tmp_path, mixed, STRAIN))
    assert len(sweeps) == len(single)
    for one, other in zip(sweeps.isotherms, single.isotherms, strict=True):
        assert np.array_equal(one.storage_modulus, other.storage_modulus)
    found = notes_with(sweeps, "other-amplitudes")
    assert [note.values["used"] for note in found] == pytest.approx([1e-3] * len(single))


def test_an_amplitude_sweep_before_the_frequency_sweep_is_left_out(tmp_path):
    frequency = [softened(row, 0.5) for row in rows()]
    warm = max(row[0] for row in rows())
    strain = [softened((warm, 1.0, 7.0, 0.9), amplitude) for amplitude in AMPLITUDES]
    sweeps = read_dma(write(tmp_path, [*strain, *frequency], STRAIN))
    alone = read_dma(write(tmp_path, frequency, STRAIN))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx(alone.isotherms[0].storage_modulus)
    assert len(sweeps.isotherms[-1]) == len(alone.isotherms[-1])
    assert np.ptp(sweeps.isotherms[-1].strain_amplitude) < 1e-3  # 0.1 %
    assert all(note.values["used"] < 0.01 for note in notes_with(sweeps, "other-amplitudes"))
    assert notes_with(sweeps, "other-amplitudes") != []


@pytest.mark.parametrize(
    ("header", "asked", "kind"),
    [
        ("E' (MPa),E'' (MPa)", "bending", "bending"),
        ("E' (MPa),E'' (MPa)", "compression", "compression"),
        ("E' (MPa),E'' (MPa)", None, "tension"),
        ("storage modulus (MPa),loss modulus (MPa)", "bending", "bending"),
        ("E' (MPa),E'' (MPa)", "shear", None),
        ("G' (MPa),G'' (MPa)", "bending", None),
    ],
)
def test_moduli_in_compression_and_bending_are_those_reported(tmp_path, header, asked, kind):
    lines = [f"T_C,f_Hz,{header}", *(",".join(map(str, row)) for row in rows())]
    path = tmp_path / "held.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    if kind is None:
        with refused("deformation-contradicts"):
            read_dma(path, deformation=asked)
        return
    sweeps = read_dma(path, deformation=asked)
    assert sweeps.deformation == kind
    assert len(notes_with(sweeps, f"{kind}-assumed")) == (kind != "tension")
    assert sweeps.in_tension(0.5) is sweeps


@pytest.mark.parametrize(
    ("clamp", "kind"),
    [
        ("Dual Cantilever", "bending"),
        ("3-Point Bending", "bending"),
        ("Dreipunktbiegung: Biegehalter", "bending"),
        ("Compression plates", "compression"),
        ("Tension: Film", "tension"),
    ],
)
def test_a_clamp_separates_bending_and_compression_from_tension(tmp_path, clamp, kind):
    lines = [f"# Clamp: {clamp}", "T_C,f_Hz,E' (MPa),E'' (MPa)", *(",".join(map(str, row)) for row in rows())]
    path = tmp_path / "held.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    assert read_dma(path).deformation == kind


def test_an_amplitude_that_changes_along_a_sweep_is_reported(tmp_path):
    def strained(ratio):
        return read_dma(write(tmp_path, [(*row, 1.0 if row[1] < 1.0 else ratio) for row in rows()], STRAIN))

    assert notes_with(strained(10.0), "amplitudes-differ", "within 3 isotherms", "1 to 10 % at 0.0 °C")
    assert notes_with(strained(1.3), "amplitudes-differ") != []
    assert notes_with(strained(1.15), "amplitudes-differ") == []


@pytest.mark.parametrize("kind", ["rheocompass", "trios"])
def test_a_frequency_that_scatters_is_no_sweep(tmp_path, kind):
    rng = np.random.default_rng(0)
    omega = 10.0 * (1.0 + 0.003 * rng.standard_normal(10))  # as measured while 10 rad/s is held
    path = tmp_path / "held.txt"
    if kind == "rheocompass":
        head = ["Project:\tx", "", "Interval and data points:\t1\t10", "Interval data:\tPoint No.\tTemperature\t"]
        head[-1] += "Angular Frequency\tStorage Modulus\tLoss Modulus"
        body = ["\t\t[°C]\t[rad/s]\t[Pa]\t[Pa]", *(f"\t{n}\t25\t{w:.5g}\t5e5\t1e5" for n, w in enumerate(omega, 1))]
    else:
        head = ["Filename\tx", "Instrument name\ty", "[step]", "Custom - 1"]
        head += ["Temperature\tAngular frequency\tStorage modulus\tLoss modulus", "°C\trad/s\tPa\tPa"]
        body = [f"25\t{w:.5g}\t5e5\t1e5" for w in omega]
    path.write_text("\n".join([*head, *body, ""]), encoding="utf-8")
    with refused("no-frequency-sweep"):
        read_dma(path)


# Temperatures


@pytest.mark.parametrize("last", [22.0, 24.0, 28.0])
def test_isotherms_one_kelvin_apart_are_not_averaged(tmp_path, last):
    steps = np.arange(20.0, last + 0.5)
    sweeps = read_dma(write(tmp_path, rows(steps)))
    assert sweeps.temperatures - 273.15 == pytest.approx(steps, abs=1e-9)  # rounding
    assert all(len(one) == len(FREQUENCIES) for one in sweeps.isotherms)


def test_measured_temperatures_one_kelvin_apart_may_scatter(tmp_path):
    rng = np.random.default_rng(1)
    points = [(T + 0.05 * rng.uniform(-1.0, 1.0), *rest) for T, *rest in rows(np.arange(20.0, 25.0))]
    assert [len(one) for one in read_dma(write(tmp_path, points)).isotherms] == [6] * 5


def test_temperatures_that_cannot_be_parted_are_refused(tmp_path):
    spread = np.linspace(20.0, 23.0, 24)  # four sweeps that drift into each other
    points = [(T, FREQUENCIES[n % 6], *moduli(T, FREQUENCIES[n % 6])) for n, T in enumerate(spread)]
    with refused("no-isotherms", None, "20.0", "23.0 °C"):
        read_dma(write(tmp_path, points))


def test_heating_and_cooling_are_reported_with_how_far_they_lie_apart(tmp_path):
    sweeps = read_dma(write(tmp_path, rows() + rows(factor=1.04)[::-1]))
    assert notes_with(sweeps, "measured-again", "at 0.0, 20.0 and 40.0 °C") != []
    assert notes_with(sweeps, "repeats-differ", "4 %") != []


def test_a_rubber_that_softens_when_it_cools_is_reported(tmp_path):
    assert notes_with(read_dma(write(tmp_path, rows())), "stiffer-when-warmer") == []
    mirrored = [(40.0 - T, *rest) for T, *rest in rows()]
    assert notes_with(read_dma(write(tmp_path, mirrored)), "stiffer-when-warmer") != []


# Units


@pytest.mark.parametrize(
    ("unit", "pascal"),
    [
        ("dyn/cm2", 0.1),
        ("dyne/cm2", 0.1),
        ("dyn/cm^2", 0.1),
        ("N/mm2", 1e6),
        ("MN/m2", 1e6),
        ("kgf/cm2", 98066.5),
        ("Mpa", 1e6),
        ("kpa", 1e3),
        ("KPa", 1e3),
        ("mPa", 1e-3),
        ("mpa", 1e6),
        ("MPA", 1e6),
    ],
)
def test_units_of_pressure_are_read_as_laboratories_write_them(unit, pascal):
    factor, offset = unit_conversion(unit, "Pa")
    assert (factor, offset) == (pytest.approx(pascal, rel=1e-12), 0.0)


@pytest.mark.parametrize(("unit", "code"), [("kg/cm2", "wrong-unit"), ("N", "wrong-unit")])
def test_units_of_another_dimension_are_refused(unit, code):
    with refused(code, None, unit.removesuffix("2")):
        unit_conversion(unit, "Pa")


@pytest.mark.parametrize(
    ("unit", "angular", "factor"),
    [
        ("rad/s", True, 1.0),
        ("rad s^-1", False, 1.0),
        ("1/s", True, 1.0),
        ("s^-1", True, 1.0),
        ("s-1", True, 1.0),
        ("s⁻¹", True, 1.0),
        ("1/s", False, None),
        ("s^-1", False, None),
        ("s⁻¹", False, None),
        ("Hz", True, None),
        ("Hz", False, 2 * math.pi),
        ("mHz", False, 2e-3 * math.pi),
        ("kHz", False, 2e3 * math.pi),
        ("MHz", False, 2e6 * math.pi),
        ("", False, None),
    ],
)
def test_hertz_and_radians_are_one_rule_for_all_formats(unit, angular, factor):
    found = to_rad_per_second(unit, angular=angular)
    assert found is None if factor is None else found == pytest.approx(factor, rel=1e-15)


def test_a_frequency_in_reciprocal_seconds_is_asked_for(tmp_path):
    with refused("wrong-unit", None, "'frequency (1/s)'", "'1/s'", "'Hz'", "'rad/s'"):
        read_dma(write(tmp_path, rows(), HEADER.replace("f (Hz)", "frequency (1/s)")))
    for unit in ("s^-1", "s⁻¹"):
        found = read_dma(write(tmp_path, rows(), HEADER.replace("f (Hz)", f"omega ({unit})")))
        assert found.isotherms[0].angular_frequency == pytest.approx(FREQUENCIES, rel=1e-6)  # printed digits
    osc = tmp_path / "sweep.osc"
    osc.write_text("T=20;Mw=1;\nFreq\tG'\tG\"\n1/s\tPa\tPa\n1\t2\t1\n2\t3\t1\n", encoding="utf-8")
    with refused("wrong-unit", None, "'1/s'", "'rad/s'", "'Hz'"):
        read_dma(osc)


def test_logarithms_and_liquids_are_reported(tmp_path):
    logs = [(T, f, math.log10(1e6 * a), math.log10(1e6 * b)) for T, f, a, b in rows()]
    assert notes_with(read_dma(write(tmp_path, logs, HEADER.replace("MPa", "Pa"))), "logarithms") != []
    liquid = [(T, f, a, 20.0 * a) for T, f, a, _ in rows()]
    assert notes_with(read_dma(write(tmp_path, liquid)), "columns-swapped", "20") != []
    plain = read_dma(write(tmp_path, rows()))
    assert notes_with(plain, "logarithms") == notes_with(plain, "columns-swapped") == []


def test_swapped_moduli_of_a_rubber_and_its_glass_are_reported(tmp_path):
    """SYNTHETIC: tan δ from 0.05 to 1.3, so that those of swapped columns are below 20."""
    rubber, hertz = catalogue_material("synthetic fluoroelastomer"), np.geomspace(0.1, 20.0, 8)
    points = [
        (celsius, f, modulus.real / 1e6, modulus.imag / 1e6)
        for celsius in (-20.0, -10.0, 0.0, 20.0, 60.0, 100.0)
        for f, modulus in zip(hertz, rubber.complex_modulus(2.0 * np.pi * hertz, celsius + 273.15), strict=True)
    ]
    assert notes_with(read_dma(write(tmp_path, points)), "columns-swapped") == []
    swapped = [(T, f, loss, storage) for T, f, storage, loss in points]
    assert notes_with(read_dma(write(tmp_path, swapped)), "columns-swapped") != []


def test_a_strain_without_unit_is_reported(tmp_path):
    points = [(*row, 0.01) for row in rows()]
    reported = read_dma(write(tmp_path, points, HEADER + ",strain"))
    assert notes_with(reported, "strain-without-unit", "'strain'") != []
    assert reported.isotherms[0].strain_amplitude == pytest.approx(np.full(6, 0.01), rel=1e-12)
    unread = read_dma(write(tmp_path, points, HEADER + ",strain (mm)"))
    assert unread.isotherms[0].strain_amplitude is None
    assert notes_with(unread, "strain-amplitude-not-read", "'strain (mm)'") != []


def test_a_strain_without_unit_in_an_interval_is_reported(tmp_path):
    text = "\n".join(rheocompass.lines(rheocompass.ENGLISH)).replace("[%]", "[]")
    path = tmp_path / "export.txt"
    path.write_text(text + "\n", encoding="utf-8")
    sweeps = read_dma(path)
    assert len(notes_with(sweeps, "strain-amplitude-not-read", "'Shear Strain'")) == 1
    assert sweeps.isotherms[0].strain_amplitude is None


def test_moduli_beyond_any_number_are_refused(tmp_path):
    points = [(0.0, f, 1.2e308, 1.2e308) for f in FREQUENCIES * 3]
    with refused("implausible-modulus", None, "1.2e+308 Pa"):
        read_dma(write(tmp_path, points, HEADER.replace("MPa", "Pa")))


# Master curves


def test_a_master_curve_is_checked_as_sweeps_are(tmp_path):
    points = [(f, f, *moduli(20.0, f)) for f in FREQUENCIES]
    header = "f (Hz),omega (rad/s),E' (MPa),E'' (MPa)"
    with refused("columns-contradict", 2):
        read_master_curve(write(tmp_path, points, header), 293.15)
    agreeing = [(f, 2 * math.pi * w, *rest) for f, w, *rest in points]
    found = read_master_curve(write(tmp_path, agreeing, header), 293.15)
    assert found.angular_frequency == pytest.approx(2 * math.pi * np.array(FREQUENCIES), rel=1e-5)  # printed digits
    bare = [row[1:] for row in agreeing]
    with refused("no-unit", None, "'omega'"):
        read_master_curve(write(tmp_path, bare, "omega,E' (MPa),E'' (MPa)"), 293.15)


# Encodings and headings


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_utf16_without_its_mark_is_read(tmp_path, encoding):
    path = write(tmp_path, rows(), "T (°C),f (Hz),E' (MPa),E'' (MPa)")
    path.write_bytes(path.read_text(encoding="utf-8").encode(encoding))
    assert read_dma(path).temperatures - 273.15 == pytest.approx([0.0, 20.0, 40.0])


def test_a_heading_of_thousands_of_blanks_takes_no_time(tmp_path):
    path = tmp_path / "blanks.csv"
    path.write_text(f"{HEADER},({' ' * 4000}x\n1,1,1,1,1\n", encoding="utf-8")
    begin = time.process_time()
    assert len(read_dma(path)) == 1
    assert time.process_time() - begin < 5.0  # a pattern that looks for a unit at every blank takes minutes
