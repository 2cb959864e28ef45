"""Thermal resistances along a curve of speeds, from those of some of its contacts."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf
from viscofric.contact import heated_curve
from viscofric.contact.heated_knots import Between, Knot
from viscofric.heat.heating import ThermalResistances

RUBBER = vf.ThermalProperties(0.2, 1200.0, 1500.0, "rubber")
PTFE = vf.ThermalProperties(0.25, 2170.0, 1010.0, "PTFE")
SPEEDS = np.geomspace(1e-3, 1.0, 16)


def _knot(speed: float, drop: float = 0.0) -> Knot:
    return Knot(drop, ThermalResistances(2.0, speed**-0.5, speed**-0.4, speed**-0.9, 0.0, 1.1, 0.2), 0.01)


def test_power_laws_are_found_between_knots() -> None:
    """To 1e-3 at five knots a decade, by cubics in the logarithm of the speed."""
    found = Between(SPEEDS.tolist(), [_knot(one) for one in SPEEDS.tolist()])(0.0123)
    assert found is not None
    assert found.relative == pytest.approx(_knot(0.0123).relative, rel=1e-3)
    assert found.rise == pytest.approx(0.01)


def test_no_state_is_followed_across_a_jump_or_beyond_the_last_knot() -> None:
    jump = [_knot(one, 0.0 if row < 8 else 1.0) for row, one in enumerate(SPEEDS.tolist())]
    gap: list[Knot | None] = [None if row == 3 else one for row, one in enumerate(jump)]
    between = Between(SPEEDS.tolist(), gap)
    within = np.sqrt(SPEEDS[:-1] * SPEEDS[1:])
    assert [row for row, one in enumerate(within.tolist()) if between(one) is None] == [2, 3, 7]
    assert between(0.9e-3) is None
    assert between(1.1) is None


def test_what_changes_sign_is_found_between_knots() -> None:
    """Spots of a rough surface may be colder than its mean by the loss beside them."""
    knots = [Knot(0.0, ThermalResistances(2.0, np.log(one / 0.02), 1.0, 1.0, 0.0, 1.0), 0.0) for one in SPEEDS.tolist()]
    found = Between(SPEEDS.tolist(), knots)
    assert [found(one).relative.loss for one in (0.0123, 0.3)] == pytest.approx(np.log([0.0123 / 0.02, 15.0]), rel=1e-6)  # type: ignore[union-attr]


@pytest.mark.apart
def test_resistances_between_knots_are_those_of_the_contacts(monkeypatch: pytest.MonkeyPatch) -> None:
    """To 1 % of the rise: the residual of each state may be as large; the friction to half the contacts' accuracy."""
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    material = vf.Material(solid.spectrum, shift=vf.WLF(C1=8.0, C2=100.0, reference=300.0))
    heating = vf.Heating(rubber=RUBBER, counterface=PTFE, coulomb=0.3, slip="0.05 m/s", average="contact")

    def curve() -> vf.FrictionCurves:
        return vf.predict_friction(
            material, vf.Ball("10 mm"), speeds=np.geomspace(0.02, 0.3, 13), temperatures=300.0, load="2 N",
            accuracy=1e-2, heating=heating,
        )  # fmt: skip

    found = curve()
    monkeypatch.setattr(heated_curve, "knots_of", lambda contacts: list(range(len(contacts))))
    each = curve()
    assert isinstance(found, vf.friction.HeatedFrictionCurves)
    assert isinstance(each, vf.friction.HeatedFrictionCurves)
    assert each.temperature_rise.max() > 0.5
    assert found.temperature_rise == pytest.approx(each.temperature_rise, rel=1e-2)
    assert found.viscoelastic == pytest.approx(each.viscoelastic, rel=5e-3)


@pytest.mark.apart
@pytest.mark.parametrize("slip", [None, "0.1 m/s"])
def test_resistances_between_knots_are_those_of_rough_contacts(
    slip: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where the slip is the speed and the counterface rests below the contact; backwards is another curve."""
    solid = vf.Material.standard_linear_solid(E0="3 MPa", E_inf="300 MPa", tau="1 ms")
    material = vf.Material(solid.spectrum, shift=vf.WLF(C1=8.0, C2=100.0, reference=300.0))
    heating = vf.Heating(rubber=RUBBER, counterface=PTFE, coulomb=0.45, slip=slip, nominal_radius="5 mm")
    road = vf.self_affine(0.8, shape=(64, 64), spacing=1.5e-5, shortest=1.2e-4, rms_slope=0.2, seed=1)
    speeds = np.concatenate([np.geomspace(0.02, 0.5, 15), [-0.1]])

    def curve() -> vf.roughness.HeatedRoughFriction:
        found = vf.predict_rough_friction(
            material, road, speeds=speeds, temperatures=303.15, pressure="0.2 MPa", heating=heating
        )
        assert isinstance(found, vf.roughness.HeatedRoughFriction)
        return found

    found = curve()
    monkeypatch.setattr(heated_curve, "knots_of", lambda contacts: list(range(len(contacts))))
    each = curve()
    assert each.temperature_rise.max() > 0.5
    assert found.face_rise == pytest.approx(each.face_rise, rel=2e-2)
    assert found.loss_weighted_rise == pytest.approx(each.loss_weighted_rise, rel=3e-2)
    assert found.mean_friction_coefficient == pytest.approx(each.mean_friction_coefficient, rel=5e-3)
