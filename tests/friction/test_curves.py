"""Friction curves: predicted by solving contacts, at one load or several, picked by temperature and load, labelled."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from friction.made_runs import friction_curves, traction_runs
from refusals import refused
from rheology.planted import write_moduli
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.measurement.tribometry import separate
from viscofric.friction.prediction import predict_friction
from viscofric.notes import codes

ACCURACY = 1e-2
BALL, CYLINDER = vf.Ball(radius="10 mm"), vf.Cylinder("10 mm")
FLUOROELASTOMER = vf.synthetic_fluoroelastomer()
CASE: dict[str, Any] = {"speeds": ["0.1 m/s", "1 m/s"], "accuracy": ACCURACY}


@pytest.fixture(scope="module")
def rubber() -> vf.Material:
    """One retardation time, 5:1, and a WLF shift."""
    solid = vf.Material.standard_linear_solid(E0="2 MPa", E_inf="10 MPa", tau="5 ms")
    return replace(solid, shift=vf.WLF(C1=8.86, C2=101.6, reference="50 degC"))


@pytest.fixture(scope="module")
def predicted(rubber: vf.Material) -> FrictionCurves:
    return predict_friction(
        rubber,
        BALL,
        speeds=["50 mm/s", "200 mm/s"],
        temperatures=["45 degC", "60 degC"],
        load="2 N",
        accuracy=ACCURACY,
    )


@pytest.mark.slow
def test_friction_is_shifted_like_the_modulus(rubber: vf.Material, predicted: FrictionCurves) -> None:
    """Eq. 10: μ(v, T) at the load equals μ(α(T) v, T0); only rounding of the memory lengths v τ α differs."""
    assert rubber.shift is not None
    for row in range(len(predicted)):
        alpha = float(rubber.shift(float(predicted.temperature[row])))
        at_reference = predict_friction(
            rubber,
            BALL,
            speeds=alpha * predicted.speed[row],
            temperatures="50 degC",
            load="2 N",
            accuracy=ACCURACY,
        )
        # The same equations on the same grids: the solver's tolerance of 1e-8 with room for its propagation.
        np.testing.assert_allclose(at_reference.viscoelastic, predicted.viscoelastic[row], rtol=1e-6)


def test_prediction_covers_every_speed_and_temperature(predicted: FrictionCurves) -> None:
    np.testing.assert_allclose(predicted.speed, [0.05, 0.2, 0.05, 0.2])
    np.testing.assert_allclose(predicted.temperature, np.repeat([318.15, 333.15], 2))
    assert np.all(predicted.load == 2.0)
    assert np.all(predicted.viscoelastic > 0)
    assert np.all(predicted.viscoelastic_error <= ACCURACY * predicted.viscoelastic)
    assert np.all(predicted.viscoelastic_error > 0)
    assert predicted.coulomb is None


@pytest.mark.slow
def test_processes_that_share_the_contacts_find_the_same_digits(rubber: vf.Material, predicted: FrictionCurves) -> None:
    shared = predict_friction(
        rubber,
        BALL,
        speeds=["50 mm/s", "200 mm/s"],
        temperatures=["45 degC", "60 degC"],
        load="2 N",
        accuracy=ACCURACY,
        workers=2,
    )
    np.testing.assert_array_equal(shared.speed, predicted.speed)
    np.testing.assert_array_equal(shared.viscoelastic, predicted.viscoelastic)
    np.testing.assert_array_equal(shared.viscoelastic_error, predicted.viscoelastic_error)


@pytest.mark.slow
def test_settings_of_the_contact_are_passed_on(rubber: vf.Material) -> None:
    """The same digits as the contact solved for itself."""
    ellipsoid = vf.Ellipsoid("10 mm", "20 mm")
    settings: dict[str, Any] = {
        "layer": vf.Layer("5 mm", bonded=False),
        "direction": (1.0, 1.0),
        "indenter_modulus": "50 MPa",
        "indenter_poisson_ratio": 0.4,
        "tolerance": 1e-5,
        "window": ("4 mm", "4 mm", "4 mm"),
        "grid": 128,
    }
    wanted = {"load": "2 N", "accuracy": 0.1, **settings}
    curves = predict_friction(rubber, ellipsoid, speeds=0.05, temperatures=320.0, **wanted)
    alone = vf.solve_steady(rubber, ellipsoid, speed=0.05, temperature=320.0, **wanted)
    assert curves.viscoelastic == [alone.friction_coefficient]
    assert curves.load_unit == "N"
    with pytest.raises(TypeError, match="unexpected keyword argument 'indentation'"):
        predict_friction(rubber, BALL, speeds=0.1, temperatures=320.0, load=2.0, indentation=1e-4)  # type: ignore[call-arg]


def test_curves_of_line_contacts_count_their_load_per_length(rubber: vf.Material) -> None:
    curves = predict_friction(
        rubber, vf.Cylinder("10 mm"), speeds=[0.05, 0.2], temperatures=320.0, load="0.2 kN/m", accuracy=ACCURACY
    )
    assert curves.load_unit == "N/m"
    assert curves.to_dataset()["load"].attrs["units"] == "N/m"
    assert len(curves.at_load("202 N/m")) == 2
    with refused("no-such-load"):
        curves.at_load("300 N/m")
    with refused("wrong-unit", naming="load = '2 N'"):
        predict_friction(rubber, vf.Cylinder("1 cm"), speeds=0.1, temperatures=320.0, load="2 N")
    line, point = (
        vf.solve_steady(rubber, shape, speed=0.1, load=load, temperature=320.0, accuracy=0.1)
        for shape, load in ((vf.Cylinder("10 mm"), 200.0), (BALL, 2.0))
    )
    with refused("mixed-geometries"):
        FrictionCurves.from_solutions([line, point])


def test_progress_is_reported(rubber: vf.Material) -> None:
    calls: list[tuple[int, int]] = []
    predict_friction(
        rubber,
        BALL,
        speeds=[0.1, 0.2],
        temperatures="50 degC",
        load=2.0,
        accuracy=0.1,
        progress=lambda done, total: calls.append((done, total)),
    )
    assert calls == [(0, 2), (1, 2), (2, 2)]


@pytest.mark.parametrize(
    ("change", "refusal"),
    [
        ({"speeds": [0.1, 0.0]}, ("not-positive",)),
        ({"speeds": ["100 mm/s", "-1 mm/s"]}, ("not-positive",)),
        ({"speeds": []}, ("empty-list",)),
        ({"temperatures": 0.0}, ("not-positive",)),
        ({"load": "-1 N"}, ("not-positive", "'-1 N'")),
        ({"workers": 0}, ("not-a-whole-number",)),
    ],
)
def test_senseless_conditions_are_refused(
    rubber: vf.Material, change: dict[str, object], refusal: tuple[str, ...]
) -> None:
    wanted = {"speeds": 0.1, "temperatures": "50 degC", "load": "2 N", **change}
    with refused(refusal[0], naming=refusal[1:]):
        predict_friction(rubber, BALL, **wanted)  # type: ignore[arg-type]


def test_solutions_moving_either_way_give_the_same_curve(rubber: vf.Material) -> None:
    """A mirrored contact drags as much; warnings of the contacts become one note."""
    forth, back = (
        vf.solve_steady(rubber, BALL, speed=speed, load="60 N", temperature="50 degC", accuracy=0.1)
        for speed in (0.1, -0.1)
    )
    curves = FrictionCurves.from_solutions([forth, back])
    assert curves.viscoelastic[0] == curves.viscoelastic[1] > 0
    np.testing.assert_array_equal(curves.speed, [0.1, 0.1])
    assert forth.warnings
    assert len(curves.notes) == 1
    assert curves.notes[0].values["contacts"] == curves.notes[0].values["of"] == 2
    assert curves.notes[0].code == forth.warnings[0].code
    with refused("no-temperature"):
        FrictionCurves.from_solutions([replace(forth, temperature=None)])
    with refused("no-speed"):
        FrictionCurves.from_solutions([replace(forth, speed=0.0)])


def test_one_temperature_is_picked_in_ascending_speed() -> None:
    curves = friction_curves(np.array([0.2, 0.1, 0.3]), np.array([303.2, 303.2, 333.2]), np.array([2.0, 1.0, 3.0]))
    warm = curves.at_temperature("30 degC")
    np.testing.assert_array_equal(warm.speed, [0.1, 0.2])
    np.testing.assert_array_equal(warm.viscoelastic, [1.0, 2.0])
    with refused("no-such-temperature") as caught:
        curves.at_temperature("40 degC")
    assert caught.value.note.values["known"] == [303.2, 333.2]
    with refused("no-such-load"):
        curves.at_load(10.0)


def test_measured_temperatures_that_scatter_are_one_temperature() -> None:
    speed, kelvin = np.array([0.1, 0.2, 0.3, 0.1]), np.array([302.9, 303.3, 303.15, 313.15])
    measured = friction_curves(speed, kelvin, speed)
    np.testing.assert_array_equal(measured.at_temperature("30 degC").speed, [0.1, 0.2, 0.3])
    solved = replace(measured, mean_pressure=np.full(4, 1e5))  # exact
    np.testing.assert_array_equal(solved.at_temperature("30 degC").speed, [0.3])


def test_data_set_is_labelled() -> None:
    """Units and names on every column, notes in the attributes, and nothing that netCDF cannot hold."""
    curves = separate(traction_runs(viscoelastic=lambda v, T: -0.03, replicates=3, noise=0.01))
    data = curves.points_dataset()
    assert dict(data.sizes) == {"point": 6}
    assert set(data.coords) == {"speed", "temperature", "load", "slip"}
    for name in (*data.coords, *data.data_vars):
        assert data[name].attrs["units"]
        assert data[name].attrs["long_name"]
    assert data["temperature"].attrs["units"] == "K"
    np.testing.assert_array_equal(data["coulomb"], curves.coulomb)  # type: ignore[arg-type]
    np.testing.assert_array_equal(data["speed"], curves.speed)
    assert data["load"].attrs == {"units": "N", "long_name": "normal load"}
    assert data.attrs["notes"] == "\n".join(curves.notes)
    assert "negative-friction" in codes(curves.notes)


def test_a_grid_of_points_is_a_data_set_over_temperature_and_speed() -> None:
    speed, kelvin = np.array([1.0, 0.1, 0.1, 1.0]), np.array([303.15, 333.15, 303.15, 333.15])
    curves = friction_curves(speed, kelvin, np.array([0.01, 0.02, 0.03, 0.04]))
    data = curves.to_dataset()
    assert dict(data.sizes) == {"temperature": 2, "speed": 2}
    assert data["viscoelastic"].values.tolist() == [[0.03, 0.01], [0.02, 0.04]]
    assert data["viscoelastic"].attrs == curves.points_dataset()["viscoelastic"].attrs
    assert float(data["viscoelastic"].sel(temperature=333.15, speed=1.0)) == 0.04
    assert curves.select([0, 1, 2]).to_dataset().sizes == {"point": 3}
    twice = friction_curves(speed[[0, 0, 1, 1]], kelvin[[0, 0, 1, 1]], np.full(4, 0.01))
    assert twice.to_dataset().sizes == {"point": 4}
    several = replace(
        friction_curves(np.tile(speed, 2), np.tile(kelvin, 2), np.arange(1.0, 9.0)), load=np.repeat([10.0, 5.0], 4)
    )
    assert several.to_dataset()["viscoelastic"].dims == ("load", "temperature", "speed")
    assert float(several.to_dataset()["viscoelastic"].sel(load=5.0, temperature=303.15, speed=1.0)) == 5.0
    assert curves.to_dataframe().shape == (4, len(data.data_vars) + len(data.coords) - 2)


def test_curves_have_items_and_indices() -> None:
    curves = friction_curves(np.array([0.1, 1.0, 2.0]), np.full(3, 303.15), np.array([0.01, 0.02, 0.03]))
    assert [float(one.viscoelastic[0]) for one in curves] == [0.01, 0.02, 0.03]
    assert curves[-1].viscoelastic.tolist() == [0.03]
    assert curves[:2].viscoelastic.tolist() == curves[curves.speed < 1.5].viscoelastic.tolist() == [0.01, 0.02]
    with pytest.raises(IndexError):
        curves[3]


def test_columns_are_checked_and_frozen() -> None:
    curves = friction_curves(np.array([0.1]), np.array([303.15]), np.array([0.03]))
    with pytest.raises(ValueError, match="read-only"):
        curves.viscoelastic[0] = 1.0
    for name, value, code in (
        ("speed", [0.0], "not-positive"),
        ("viscoelastic", [np.nan], "not-finite"),
        ("viscoelastic_error", [np.nan], "negative"),
        ("coulomb", [1.0, 2.0], "wrong-length"),
        ("replicates", [1.5], "not-a-whole-number"),
    ):
        with refused(code):
            replace(curves, **{name: np.array(value)})


def test_several_loads_are_those_of_single_predictions() -> None:
    steps: list[tuple[int, int]] = []
    law = vf.friction.ConstantShearStress("10 kPa")
    two = {"temperatures": ["30 degC", "60 degC"], "interface": law, "layer": "5 mm"}
    found = vf.predict_friction(
        FLUOROELASTOMER, CYLINDER, **CASE, **two, loads=["500 N/m", "1 N/mm"], progress=lambda *now: steps.append(now)
    )
    alone = [vf.predict_friction(FLUOROELASTOMER, CYLINDER, **CASE, **two, load=load) for load in (500.0, 1000.0)]
    for name in ("viscoelastic", "coulomb", "load", "temperature", "speed", "mean_pressure"):
        assert np.array_equal(getattr(found, name), np.concatenate([getattr(one, name) for one in alone])), name
    assert codes(found.notes) == {code for one in alone for code in codes(one.notes)}
    assert len(found.notes) == len(codes(found.notes))  # each once, of all loads
    (share,) = (note.values for note in found.notes if note.code == "interface-share")
    parts = found.coulomb / found.total
    assert share == {"lowest": pytest.approx(parts.min()), "highest": pytest.approx(parts.max())}
    assert found.to_dataset()["viscoelastic"].dims == ("load", "temperature", "speed")
    assert steps[0] == (0, 8)
    assert steps[-1] == (8, 8)
    assert [done for done, _ in steps] == sorted(done for done, _ in steps)


def test_one_load_or_several_must_be_given() -> None:
    for loads in ({}, {"load": 1.0, "loads": [1.0]}):
        with refused("give-one"):
            vf.predict_friction(FLUOROELASTOMER, CYLINDER, **CASE, temperatures=300.0, **loads)
    with refused("empty-list"):
        vf.predict_friction(FLUOROELASTOMER, CYLINDER, **CASE, temperatures=300.0, loads=[])
    with refused("out-of-range"):  # degrees taken for kelvin
        vf.predict_friction(FLUOROELASTOMER, CYLINDER, **CASE, temperatures=5.0, load=500.0)
    with refused("out-of-range", naming=("'60 degC'",)):
        vf.solve_steady(FLUOROELASTOMER, vf.Ball("1 cm"), speed=0.1, temperature=60.0, load=5.0)
    with refused("wrong-unit"):
        vf.predict_friction(FLUOROELASTOMER, CYLINDER, **CASE, temperatures=300.0, loads=["5 N"])


def test_temperature_left_out_is_the_reference_of_the_material() -> None:
    found = vf.predict_friction(FLUOROELASTOMER, CYLINDER, **CASE, load=500.0)
    assert found.temperature == pytest.approx(FLUOROELASTOMER.reference)
    one = vf.solve_steady(FLUOROELASTOMER, CYLINDER, speed="1 m/s", load=500.0, accuracy=1e-2)
    assert found.friction_coefficient[1] == pytest.approx(one.friction_coefficient, rel=1e-2)


@pytest.mark.parametrize(("given", "kelvin"), [(None, 293.15), ("40 degC", 313.15)])
def test_material_without_shift_factors_has_one_temperature_which_is_noted(given: str | None, kelvin: float) -> None:
    alone, body = vf.Material(FLUOROELASTOMER.spectrum), vf.ThermalProperties(0.3, 1200.0, 1700.0, "rubber")
    found = vf.predict_friction(alone, CYLINDER, **CASE, temperatures=given, loads=[500.0, 600.0])
    known = vf.predict_friction(FLUOROELASTOMER, CYLINDER, **CASE, loads=[500.0, 600.0])  # at its reference
    np.testing.assert_array_equal(found.viscoelastic, known.viscoelastic)
    np.testing.assert_allclose(found.temperature, kelvin)
    (note,) = (one for one in found.notes if one.code == "temperature-assumed")
    assert note.values == {"temperature": pytest.approx(kelvin)}
    assert not codes(known.notes) & {"temperature-assumed"}
    stated = replace(alone, shift=vf.rheology.OneTemperature("40 degC"))
    there = vf.predict_friction(stated, CYLINDER, **CASE, loads=[500.0, 600.0])
    np.testing.assert_array_equal(there.viscoelastic, found.viscoelastic)
    assert there.temperature == pytest.approx(313.15)
    assert not codes(there.notes) & {"temperature-assumed"}
    done: list[int] = []
    with refused("outside-measured"):  # before any contact is solved
        both, watch = ["40 degC", "60 degC"], lambda now, total: done.append(now)
        vf.predict_friction(stated, CYLINDER, **CASE, temperatures=both, load=500.0, progress=watch)
    assert not done
    with refused("outside-measured"):
        vf.predict_friction(stated, CYLINDER, **CASE, temperatures="60 degC", load=500.0)
    with refused("no-shift"):
        vf.predict_friction(alone, CYLINDER, **CASE, temperatures=["30 degC", "60 degC"], load=500.0)
    with refused("no-shift"):
        vf.predict_friction(alone, CYLINDER, **CASE, load=500.0, heating=vf.Heating(rubber=body, counterface=body))
    with refused("no-shift"):
        vf.predict_friction(stated, CYLINDER, **CASE, load=500.0, heating=vf.Heating(rubber=body, counterface=body))


def test_predictions_repeat_what_sweeps_contradict(tmp_path: Path) -> None:
    def swapped(omega: float, kelvin: float) -> complex:
        return 1j * complex(FLUOROELASTOMER.complex_modulus(omega, kelvin)).conjugate()

    moduli = {"right": FLUOROELASTOMER.complex_modulus, "swapped": swapped}
    found = {}
    for name, modulus in moduli.items():
        path = write_moduli(tmp_path / f"{name}.csv", modulus, (20, 30, 40), (0.1, 0.3, 1, 3, 10, 30, 100))
        fit = vf.superpose(vf.read_dma(path, deformation="tension"), "30 degC")
        material = vf.Material(vf.fit_retardation_spectrum(fit), shift=fit.shift_factors)
        curves = vf.predict_friction(material, CYLINDER, **CASE, load=500.0)
        alone = vf.solve_steady(material, CYLINDER, speed="1 m/s", load=500.0, accuracy=ACCURACY)
        doubts = {"kramers-kronig-fails", "spectrum-misfit"}
        found[name] = [codes(notes) & doubts for notes in (curves.notes, alone.warnings)]
        assert len(curves.notes) == len(codes(curves.notes))
    assert found == {"right": [set(), set()], "swapped": [doubts, doubts]}


SOFT = vf.Material.standard_linear_solid(E0="50 kPa", E_inf="200 kPa", tau="10 ms")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("indenter", "load", "pull_off"),
    [  # W = 50 mJ/m²: 3πWR/2; of a cylinder 3 (π E* W² R/16)^(1/3)
        (vf.Ball("10 mm"), 1e-3, 1.5 * np.pi * 0.05 * 0.01),
        (vf.Ball("10 mm"), 3e-2, None),
        (vf.Cylinder("10 mm"), 1.0, 3.0 * (np.pi * 5e4 / 0.75 * 0.05**2 * 0.01 / 16.0) ** (1.0 / 3.0)),
        (vf.Cylinder("10 mm"), 30.0, None),
    ],
)
def test_adhesion_is_noted_where_it_would_pull_with_a_tenth_of_the_load(
    indenter: Any, load: float, pull_off: float | None
) -> None:
    contact: dict[str, Any] = {"load": load, "accuracy": 0.1}
    held = vf.motion.History(time=[0.0, 0.1], load=load)
    found = [
        vf.solve_steady(SOFT, indenter, speed="10 mm/s", **contact).warnings,
        predict_friction(SOFT, indenter, speeds=np.geomspace(1e-3, 1.0, 20), **contact).notes,  # interpolated
        vf.motion.solve_transient(SOFT, indenter, held, times=["50 ms"]).warnings,
    ]
    for notes in found:
        assert [one.values["pull_off"] for one in notes if one.code == "adhesion"] == [
            pytest.approx(one) for one in [pull_off] if one is not None
        ]
        assert not [one for one in notes if one.code == "adhesion" and one.values["load"] != pytest.approx(load)]


def test_inertia_is_noted_where_the_rubber_moves_a_fifth_as_fast_as_its_shear_waves() -> None:
    """Rubber of 50 kPa, 200 kPa when fast, has shear waves of √(E/3ρ) = 3.8 to 7.6 m/s."""
    speeds = [0.1, 0.5, 2.0]
    curves = predict_friction(SOFT, vf.Ball("10 mm"), speeds=speeds, loads=["0.1 N", "0.2 N"], accuracy=0.1)
    (note,) = (note for note in curves.notes if note.code == "quasi-static")
    alone = [vf.solve_steady(SOFT, vf.Ball("10 mm"), speed=v, load="0.2 N", accuracy=0.1).warnings for v in speeds]
    assert ["quasi-static" in codes(notes) for notes in alone] == [False, False, True]
    (own,) = (one for one in alone[-1] if one.code == "quasi-static")
    assert own.values["change"] == pytest.approx((2.0 / own.values["wave_speed"]) ** 2)
    assert 3.8 < own.values["wave_speed"] < 7.7
    # The wider contact has the lower frequency v/a, the softer rubber, and the larger effect.
    assert (note.values["contacts"], note.values["of"]) == (2, 6)
    assert note.values["change"] == pytest.approx(own.values["change"], rel=1e-2)
