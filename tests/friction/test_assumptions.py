"""What friction takes for granted: judged by the right numbers, said in plain words."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from friction.made_runs import friction_curves
from refusals import refused
from viscofric.errors import InputError
from viscofric.friction import warming
from viscofric.friction.assumption_check import AssumptionCheck, ContactSize, assumption_checks_of, assumptions_dataset
from viscofric.friction.identification.forward import FirstOrder
from viscofric.notes import Note, Remedy, codes
from viscofric.thermal import FILLED_RUBBER, PTFE, STEEL

RUBBER = vf.synthetic_fluoroelastomer()
BALL = vf.Ball(radius="9.525 mm")
SPEED, KELVIN = np.tile([0.02, 0.2], 2), np.repeat([303.15, 333.15], 2)


def curves(load: float = 25.0) -> vf.FrictionCurves:
    """Friction that falls by half over a decade of speed."""
    return friction_curves(SPEED, KELVIN, 0.02 * (SPEED / 0.02) ** -0.301, load=load)


def solved_curves() -> vf.FrictionCurves:
    """Friction of the half-space at these points, from solutions to 1e-3."""
    return friction_curves(SPEED, KELVIN, np.array([0.00781, 0.00493, 0.02516, 0.01585]))


def checks(*arguments, **settings) -> dict[str, vf.friction.AssumptionCheck]:
    return {check.name: check for check in vf.check_assumptions(*arguments, **settings)}


def test_the_widest_contact_is_judged_by_hertz_at_the_rubber_modulus() -> None:
    """a³ = 3 F R (1 − ν²)/(4 E0) with E0 = 3 MPa: 3.9 mm under 25 N, more than |E(v/a)| gives."""
    widest = (0.75 * 25.0 * 9.525e-3 * 0.75 / 3e6) ** (1 / 3)
    found = checks(RUBBER, BALL, curves(), thickness="20 mm")
    assert found["half-space"].value == pytest.approx(widest / 20e-3)
    assert found["small contact"].value == pytest.approx(widest / 9.525e-3)
    assert found["linearity"].value == pytest.approx(0.2 * widest / 9.525e-3)
    assert found["half-space"].holds
    slow_and_warm = {"temperature": 333.15, "speed": 0.02, "load": 25.0}  # widest by either bound
    assert slow_and_warm.items() <= found["half-space"].values.items()


def test_the_contact_that_is_solved_lies_between_its_bounds() -> None:
    solution = vf.solve_steady(RUBBER, BALL, speed=0.02, load=25.0, temperature=333.15)
    size = checks(RUBBER, BALL, curves())["half-space"].values
    radius = max(solution.half_width, 0.5 * (solution.front + solution.rear))
    # the estimate at |E(v/a)| to a tenth
    assert 0.9 * size["smallest_radius"] < radius < size["largest_radius"]


def test_inertia_counts_where_the_rubber_moves_a_fifth_as_fast_as_its_shear_waves() -> None:
    """An elastic rubber, 3 MPa and 1000 kg/m³, of ν = ½ has shear waves of √(1000) = 31.6 m/s."""
    spectrum = vf.RetardationSpectrum(E0="3 MPa", E_inf="3 MPa", C=[], tau=[])
    material = vf.Material(spectrum, shift=vf.WLF(C1=10.0, C2=100.0, reference="30 degC"))
    light = vf.ThermalProperties(0.28, 1000.0, 1700.0, "light rubber")
    for speed, holds in ((7.0, True), (7.2, False)):  # the square of 1/31.6 of it is 0.049 and 0.0518
        at_speed = friction_curves(np.array([0.1, speed]), np.full(2, 303.15), np.full(2, 0.01))
        check = checks(material, BALL, at_speed, rubber=light)["quasi-static"]
        assert (check.holds, check.values["speed"]) == (holds, speed)
        assert check.value == pytest.approx(speed**2 / 1000.0)
        assert check.values["wave_speed"] == pytest.approx(1000.0**0.5)


def test_heat_beyond_any_shift_law_has_a_finite_effect() -> None:
    """Friction in wrong units heats by thousands of K, and α(T) falls by hundreds of decades."""
    huge = friction_curves(SPEED, KELVIN, np.full(4, 3e4))
    found = checks(RUBBER, BALL, huge)["one temperature"]
    assert not found.holds
    assert np.isfinite(found.value)


@pytest.mark.parametrize(("thickness", "holds"), [("8 mm", False), ("13 mm", None), ("16 mm", True)])
def test_what_depends_on_the_contacts_size_is_left_open(thickness: str, holds: bool | None) -> None:
    """Four times 2.4 mm, an estimate, and four times 3.5 mm, the bound, are 9.7 and 14.2 mm."""
    check = checks(RUBBER, BALL, solved_curves(), thickness=thickness)["half-space"]
    assert check.holds is holds
    assert check.code == {True: "half-space", None: "radius-not-known", False: "too-thin"}[holds]


def test_four_contact_radii_do_not_do_for_a_broad_spectrum() -> None:
    """The layer is solved: 7.7 % less friction than on the half-space, 20 % less indentation (at 30 °C, 20 mm/s)."""
    deep = vf.solve_steady(RUBBER, BALL, speed=0.02, load=25.0, temperature=303.15)
    radius = max(deep.half_width, 0.5 * (deep.front + deep.rear))
    layer = vf.Layer(4.01 * radius)
    thin = vf.solve_steady(RUBBER, BALL, speed=0.02, load=25.0, temperature=303.15, layer=layer)
    less = thin.friction_coefficient / deep.friction_coefficient - 1.0
    sunk = thin.indentation / deep.indentation - 1.0
    one = vf.FrictionCurves.from_solutions([deep])
    check = checks(RUBBER, BALL, one, thickness=layer.thickness, contact_radius=radius)["half-space"]
    assert check.value < 0.25
    assert check.holds is False
    assert check.limit < check.value
    assert check.values["friction"] == pytest.approx(less, rel=0.07)
    assert check.values["indentation"] == pytest.approx(sunk, rel=0.1)
    assert check.values["least_thickness"] == pytest.approx(4.0 * radius)
    # the thickness that it names is enough
    for share, holds in ((0.98, False), (1.02, True)):
        enough = share * check.values["thickness_for_friction"]
        again = checks(RUBBER, BALL, one, thickness=enough, contact_radius=radius)["half-space"]
        assert again.holds is holds
        assert (again.value <= again.limit) is holds


def test_less_than_four_contact_radii_never_pass() -> None:
    """However little friction changes: here, with memory a hundredth of the contact, by a tenth of a per cent."""
    rubber = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3)
    short = replace(rubber, shift=RUBBER.shift)
    points = friction_curves(np.array([0.02, 0.04]), np.full(2, 303.15), np.array([0.0017, 0.0034]), load=1.0)
    check = checks(short, vf.Ball(radius="10 mm"), points, thickness="7 mm", contact_radius="1.78 mm")["half-space"]
    assert check.holds is False
    assert check.values["least_thickness"] == pytest.approx(4.0 * 1.78e-3)
    assert abs(check.values["friction"]) < 1.5e-3


def test_a_layer_thinner_than_the_contact_is_not_estimated() -> None:
    check = checks(RUBBER, BALL, solved_curves(), thickness="1 mm")["half-space"]
    assert check.holds is False
    assert check.code == "too-thin"
    assert not {"friction", "indentation"} & set(check.values)


def test_a_line_contact_does_not_forget_the_thickness() -> None:
    line = friction_curves(SPEED[:2], KELVIN[2:], np.array([0.024, 0.018]), load=2000.0)
    line = replace(line, load_unit="N/m")
    said = checks(RUBBER, vf.Cylinder(radius="10 mm"), line, thickness="10 mm", contact_radius="1.5 mm")["half-space"]
    assert said.holds is False
    assert said.values["indentation"] is None  # has no reference level on a half-space


@pytest.mark.slow
def test_without_a_thickness_the_one_that_serves_is_reported() -> None:
    check = checks(RUBBER, BALL, solved_curves(), contact_radius="2.4 mm")["half-space"]
    assert (check.value, check.holds) == (None, None)
    assert check.code == "thickness-not-given"
    assert check.values["least_thickness"] == pytest.approx(4.0 * 2.4e-3)
    for share, holds in ((0.98, False), (1.02, True)):
        given = {"thickness": share * check.values["thickness_for_friction"], "contact_radius": "2.4 mm"}
        assert checks(RUBBER, BALL, solved_curves(), **given)["half-space"].holds is holds


def test_a_solved_contact_settles_it() -> None:
    radii = [2e-3, 2.1e-3, 2.5e-3, 3e-3]
    found = checks(RUBBER, BALL, curves(), thickness="10 mm", contact_radius=radii)
    assert found["half-space"].value == pytest.approx(0.3)
    assert found["half-space"].holds is False
    assert found["small contact"].value == pytest.approx(3.0 / 9.525)
    assert found["small contact"].holds is False
    size = {"smallest_radius": 3e-3, "largest_radius": 3e-3, "temperature": 333.15, "speed": 0.2, "load": 25.0}
    assert size.items() <= found["half-space"].values.items()
    small = checks(RUBBER, BALL, curves(), contact_radius="1 mm")
    assert small["small contact"].holds
    assert small["linearity"].value == pytest.approx(0.2 / 9.525)


@pytest.mark.parametrize("counterbody", [STEEL, PTFE])
@pytest.mark.slow
def test_warming_is_that_of_the_heated_contact(counterbody: vf.ThermalProperties) -> None:
    """Hertz's pressure on a disc of the same radius for the solved one; Coulomb friction 0.5 at 20 % slip.

    The rise of the face agrees to 15 %, and with it the change of friction, which is to first order in the loss.
    Below, all of the loss is counted near the contact, of which the solved one releases a fifth farther behind.
    """
    place = {"speed": 0.2, "load": 25.0, "temperature": 333.15}
    heating = vf.Heating(rubber=FILLED_RUBBER, counterface=counterbody, coulomb=0.5, slip=0.04, average="contact")
    contact = vf.solve_steady(RUBBER, BALL, **place, heating=heating)
    assert contact.heating is not None
    friction = np.array([contact.heating.isothermal_friction])
    one = friction_curves(np.array([0.2]), np.array([333.15]), friction, load=25.0)
    one = replace(one, coulomb=np.array([0.5]), slip=np.array([0.04]))
    radius = float(np.sqrt(contact.contact_area / np.pi))
    check = checks(RUBBER, BALL, one, contact_radius=radius, counterbody=counterbody)["one temperature"]
    assert check.values["face_rise"] == pytest.approx(contact.heating.face_rise, rel=0.15)
    assert check.values["loss_weighted_rise"] == pytest.approx(contact.heating.loss_weighted_rise, rel=0.25)
    change = contact.friction_coefficient / contact.heating.isothermal_friction - 1.0
    if check.values["face_rise"] > check.values["loss_weighted_rise"]:
        assert check.value == pytest.approx(change, rel=0.2)
    assert place.items() <= check.values.items()
    assert check.values["least_change"] < check.value


def test_the_warmest_point_is_found_behind_two_whose_heat_is_overrated() -> None:
    """The loss alone, released below the face, warms a sixth as much as its rough estimate: less than Coulomb heat."""
    lossy = friction_curves(np.full(3, 0.2), np.full(3, 303.15), np.array([0.3, 0.28, 1e-6]), load=25.0)
    made = replace(lossy, coulomb=np.array([0.0, 0.0, 0.03]), slip=np.full(3, 0.2))
    mode = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    rubber = replace(mode, shift=RUBBER.shift)
    rough = [warming._Contact.of(made, row, 2e-3, FILLED_RUBBER, STEEL).rough_rise() for row in range(3)]
    assert rough[0] > rough[1] > rough[2]
    assert warming.Warming.worst(rubber, BALL, made, [2e-3] * 3, FILLED_RUBBER, STEEL).row == 2


def test_warming_has_the_same_effect_in_similar_contacts_whatever_their_load() -> None:
    """On a ball, friction depends on v/a, and a³ on the load; near its maximum a small error of v/a changes much."""
    mode = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    rubber, ball, times = replace(mode, shift=RUBBER.shift), vf.Ball(radius="10 mm"), np.array([1.0, 1.01, 1.1, 1.4])
    made = friction_curves(2.0 * np.cbrt(times), np.full(4, 303.15), np.full(4, 0.05), load=5.0 * times)
    solved: dict[float, FirstOrder] = {}
    change = warming._change(rubber, ball, made, np.full(4, 0.05), solved)
    # loads are equal to 2.5 %, and v/a to 0.8 %; the slope is 1.9 of it per relative change of v/a here
    assert change == pytest.approx(np.full(4, change[0]), rel=0.02)
    assert len(solved) == 3  # the first two loads are equal to a hundredth: one solution serves both


@pytest.mark.apart
def test_warming_of_a_contact_does_not_depend_on_the_speeds_that_were_asked_beside() -> None:
    """One mode, whose friction has its maximum near 3 m/s; 30 m/s is beyond it, where warming raises friction."""
    mode = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    rubber, ball = replace(mode, shift=RUBBER.shift), vf.Ball(radius="10 mm")
    found = []
    for speeds in (np.geomspace(0.3, 30.0, 7), np.array([10.0, 30.0]), np.array([29.0, 30.0]), np.array([30.0])):
        n = len(speeds)
        friction = np.append(np.full(n - 1, 1e-6), 0.03)  # so that the last contact is the warmest
        made = friction_curves(speeds, np.full(n, 303.15), friction, load=5.0)
        made = replace(made, coulomb=np.append(np.zeros(n - 1), 0.3), slip=np.full(n, 1.0))
        sizes = [one.smallest for one in ContactSize.all_of(rubber, ball, made)]
        warmest = warming.Warming.worst(rubber, ball, made, sizes, FILLED_RUBBER, STEEL)
        assert warmest.row == n - 1
        found.append(warmest.change)
    np.testing.assert_allclose(found, found[-1], rtol=1e-12)
    # A straight line through the first speeds is nearly flat, and would let anything pass; the slope there is −0.7.
    assert found[0] == pytest.approx(0.7 * np.log(10.0) * warmest.decades, rel=0.2)


def test_a_maximum_on_the_way_is_seen() -> None:
    """Warming shifts a contact at its maximum: friction falls by the second order, not by the slope, which is zero."""
    mode = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    rubber, ball, n = replace(mode, shift=RUBBER.shift), vf.Ball(radius="10 mm"), 41
    made = friction_curves(np.geomspace(0.1, 10.0, n), np.full(n, 303.15), np.full(n, 0.05), load=5.0)
    change = warming._change(rubber, ball, made, np.full(n, 0.4), {})
    small = warming._change(rubber, ball, made, np.full(n, 1e-3), {})
    assert small.min() < 1e-4  # the maximum is among them
    assert change.min() > 0.01


def test_changes_at_several_temperatures_are_those_at_each_alone() -> None:
    made, decades = curves(), np.full(4, 0.4)
    alone = [warming._change(RUBBER, BALL, made.select(np.array([row])), decades[:1], {})[0] for row in range(4)]
    assert warming._change(RUBBER, BALL, made, decades, {}) == pytest.approx(alone, rel=1e-9)


def test_a_hot_contact_is_reported() -> None:
    """The same under PTFE, which is no better a conductor than the rubber."""
    measured = replace(curves(), coulomb=np.full(4, 0.5), slip=0.2 * SPEED)
    check = checks(RUBBER, BALL, measured, contact_radius="2 mm")["one temperature"]
    assert check.holds is None  # the rubber below is warmed much less
    assert check.value > 0.05 > check.values["least_change"]


def test_without_coulomb_friction_its_heat_is_said_not_to_count() -> None:
    check = checks(RUBBER, BALL, curves())["one temperature"]
    assert check.holds
    assert not check.values["coulomb_counted"]
    assert check.value < 0.01


def test_curves_predicted_with_heating_hold_their_coulomb_friction_and_its_effect() -> None:
    """The change that the isothermal curve is warned of is in the heated one, to the first order of the estimate."""
    body = vf.ThermalProperties("0.3 W/m/K", "1200 kg/m**3", "1500 J/kg/K", "rubber")
    heating = vf.Heating(rubber=body, counterface=PTFE, coulomb=0.5, slip="0.4 m/s", average="contact")
    asked = {"speeds": 0.2, "temperatures": 333.15, "load": 25.0, "accuracy": 1e-2}
    cold, hot = (vf.predict_friction(RUBBER, BALL, heating=one, **asked) for one in (None, heating))
    assert isinstance(hot, vf.friction.HeatedFrictionCurves)
    assert (hot.coulomb.tolist(), hot.slip.tolist(), hot.coulomb_error) == ([0.5], [0.4], None)
    np.testing.assert_array_equal(hot.total, hot.viscoelastic + 0.5)
    assert cold.coulomb is None
    included = checks(RUBBER, BALL, hot)["one temperature"]
    assert (included.code, included.holds) == ("warming-included", True)
    assert included.values["change"] == pytest.approx(abs(hot.viscoelastic[0] / hot.isothermal_friction[0] - 1.0))
    assert included.values["rise"] == hot.temperature_rise[0]
    rubbed = replace(cold, coulomb=hot.coulomb, slip=hot.slip)
    settings = {"contact_radius": "2.5 mm", "rubber": body}
    warned = checks(RUBBER, BALL, rubbed, **settings)["one temperature"]
    assert warned.values["coulomb_counted"]
    assert warned.values["change"] == pytest.approx(included.values["change"], rel=0.3)  # of Hertz's contact


def test_of_a_solved_layer_the_half_space_is_not_checked() -> None:
    """Its shear is judged by its own base: without one that is bonded, the same as with the thickness alone."""
    rubbed = replace(curves(), coulomb=np.full(4, 0.2), slip=SPEED)
    known, bonded, sliding = (
        checks(RUBBER, BALL, rubbed, contact_radius="2 mm", **body)
        for body in (
            {"thickness": "4 mm"},
            {"layer": vf.Layer("4 mm")},
            {"layer": vf.Layer("4 mm", bonded=False)},
        )
    )
    assert "half-space" in known
    assert not {"half-space"} & {*bonded, *sliding}
    assert known["uncoupled"].value == bonded["uncoupled"].value != sliding["uncoupled"].value


def test_a_slow_contact_is_hardly_warmer() -> None:
    """Its heat falls with the speed, and has the time to leave."""
    slow, fast = (
        checks(RUBBER, BALL, replace(curves(), speed=factor * SPEED), contact_radius="2 mm")["one temperature"]
        for factor in (1e-6, 1.0)
    )
    assert 0.0 < slow.values["loss_weighted_rise"] < 1e-2 * fast.values["loss_weighted_rise"]


def test_line_contacts_and_shift_tables_are_judged_too() -> None:
    """At the ends of a table α is known on one side only."""
    table = vf.ShiftFactors(np.array([303.15, 333.15]), RUBBER.shift.log10(np.array([303.15, 333.15])), 303.15)
    line = replace(curves(load=500.0), load_unit="N/m", coulomb=np.full(4, 0.1), slip=0.1 * SPEED)
    found = checks(replace(RUBBER, shift=table), vf.Cylinder(radius="10 mm"), line)
    assert 0.0 < found["one temperature"].value < 0.05
    # a² = 4 F R (1 − ν²)/(π E0)
    assert found["small contact"].value == pytest.approx(np.sqrt(4 * 500.0 * 0.01 * 0.75 / (np.pi * 3e6)) / 0.01)


def test_a_slope_of_the_shift_that_is_not_known_leaves_the_other_checks(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(*_: object) -> float:
        raise InputError("shift is known at 30.0 °C alone.")

    before = checks(RUBBER, BALL, curves())
    monkeypatch.setattr(warming, "_decades_per_kelvin", unknown)
    found = checks(RUBBER, BALL, curves())
    assert found["one temperature"].holds is None
    assert found["one temperature"].code == "warming-unknown"
    assert {**found, "one temperature": None} == {**before, "one temperature": None}


@pytest.mark.parametrize(
    ("poisson_ratio", "thickness", "holds"),
    [(0.5, None, True), (0.5, "40 mm", True), (0.5, "2 mm", False), (0.499, None, True), (0.49, None, False)],
)
@pytest.mark.slow
def test_coulomb_friction_that_changes_the_pressure_is_reported(
    poisson_ratio: float, thickness: str | None, holds: bool
) -> None:
    """X (1 − ν²) τ/|E(v/a)| 5/4, at the point where it is the largest part of friction; layers couple for any ν."""
    rubbed = replace(curves(), coulomb=np.full(4, -0.5), slip=0.2 * SPEED)
    rubber = replace(RUBBER, poisson_ratio=poisson_ratio)
    check = checks(rubber, BALL, rubbed, thickness=thickness, contact_radius="2 mm")["uncoupled"]
    assert check.holds is holds
    assert codes([check.sentence]) == {"tangential-coupling"}
    if thickness is None:
        stress, beta = 0.5 * 25.0 / (np.pi * 2e-3**2), (1.0 - 2.0 * poisson_ratio) / (2.0 * (1.0 - poisson_ratio))
        modulus = [
            abs(complex(RUBBER.modes_at(T).complex_modulus(v / 2e-3))) for v, T in zip(SPEED, KELVIN, strict=True)
        ]
        change = 1.25 * beta * (1.0 - poisson_ratio**2) * stress / np.array(modulus)
        # The mean of S over the waves of the pressure differs from that at v/a by 3 % here.
        assert check.value == pytest.approx(float(np.max(change / np.abs(rubbed.viscoelastic))), rel=0.05)


def test_without_coulomb_friction_the_pressure_has_none_to_change_it() -> None:
    rubber = replace(RUBBER, poisson_ratio=0.49)
    assert "uncoupled" not in checks(rubber, BALL, curves(), contact_radius="2 mm")


def test_what_cannot_be_checked_is_refused() -> None:
    with refused("no-points"):
        vf.check_assumptions(RUBBER, BALL, curves().select(np.zeros(4, dtype=bool)))
    with refused("no-shift"):
        vf.check_assumptions(replace(RUBBER, shift=None), BALL, curves())  # at two temperatures
    with refused("contact-radius"):
        vf.check_assumptions(RUBBER, BALL, curves(), contact_radius=[1e-3, 2e-3])
    with refused("not-positive", naming="thickness"):
        vf.check_assumptions(RUBBER, BALL, curves(), thickness="-1 mm")


@pytest.mark.parametrize("shift", [None, vf.rheology.OneTemperature("60 degC")])
def test_warming_is_unknown_of_a_material_without_shift_factors(shift: vf.rheology.ShiftLaw | None) -> None:
    at_one = curves().select(KELVIN == 333.15)
    found = checks(replace(RUBBER.at_reference("60 degC"), shift=shift), BALL, at_one, thickness="10 mm")
    known = checks(RUBBER, BALL, at_one, thickness="10 mm")
    assert found["one temperature"].holds is None
    assert found["quasi-static"].value == pytest.approx(known["quasi-static"].value)


def test_the_narrowest_contact_is_hertz_at_the_modulus_of_its_own_frequency() -> None:
    """a³ = 3 F R (1 − ν²)/(4 |E(v/a)|), iterated here from its formula; both bounds are given."""
    one = friction_curves(SPEED[:1], KELVIN[-1:], np.array([0.02]))
    modes, a = RUBBER.modes_at(float(KELVIN[-1])), 1e-3
    for _ in range(100):
        modulus = abs(complex(modes.complex_modulus(SPEED[0] / a)))
        a = (3.0 * 25.0 * 9.525e-3 * 0.75 / (4.0 * modulus)) ** (1.0 / 3.0)
    found = checks(RUBBER, BALL, one)["small contact"].values
    # iterated until the radius changes by less than a thousandth
    assert found["smallest_radius"] == pytest.approx(a, rel=1e-3)
    assert found["lowest"] == pytest.approx(a / 9.525e-3, rel=1e-3)
    relaxed = (0.75 * 25.0 * 9.525e-3 * 0.75 / 3e6) ** (1 / 3)
    assert found["largest_radius"] == pytest.approx(relaxed)
    assert found["highest"] == pytest.approx(relaxed / 9.525e-3)


def test_checks_make_a_data_set() -> None:
    """What is not known is NaN, what cannot be judged −1; sentences are in the words of their reader."""
    layer = Remedy("layer=Layer(…)", run_file="[layer]")
    checks = (
        AssumptionCheck.of(
            "half-space", False, Note("too-thin", "Thin: ", remedy=layer, values={"H": 2e-3}), 0.5, 0.25
        ),
        AssumptionCheck.of("linearity", None, "Unknown.", None, 0.06),
    )
    data = assumptions_dataset(checks, "run_file")
    assert data["assumption_name"].values.tolist() == ["half-space", "linearity"]
    np.testing.assert_array_equal(data["value"], [0.5, np.nan])
    np.testing.assert_array_equal(data["limit"], [0.25, 0.06])
    np.testing.assert_array_equal(data["holds"], [0, -1])
    assert data["sentence"].values.tolist() == ["Thin: [layer]", "Unknown."]
    assert assumption_checks_of(data) == [replace(checks[0], sentence="Thin: [layer]"), checks[1]]
    assert (data["code"][0].item(), assumption_checks_of(data)[0].values) == ("too-thin", {"H": 2e-3})
    assert checks[0].to_dataset()["sentence"].item() == "Thin: layer=Layer(…)"
