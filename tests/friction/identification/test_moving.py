"""Materials planted into unloading, oscillation and rebound come back; contacts by springs agree with the solvers."""

from __future__ import annotations

import functools

import numpy as np
import pytest
from tests.friction.identification.test_indentation import (
    BALL,
    KELVIN,
    PLANE_STRAIN,
    check_derivatives,
    creep,
    planted,
    relaxation,
)

import viscofric as vf
from viscofric.errors import InputError
from viscofric.friction.identification.indentation.contact import Nearby, Shared
from viscofric.friction.identification.indentation.moving import _turns
from viscofric.friction.identification.indentation.setting_up import usable_records
from viscofric.notes import codes

#: Modes half a decade apart, of which the wide spectrum of the other tests has four times as many.
TAU = np.geomspace(1e-4, 1e3, 15)
STRENGTHS = 4e-7 * np.exp(-0.5 * (np.log10(TAU) / 1.5) ** 2) / 7.5
RUBBER = vf.Material(
    vf.RetardationSpectrum(1.0 / (1e-7 + float(STRENGTHS.sum())), 1e7, STRENGTHS, TAU),
    vf.WLF(C1=10.0, C2="120 K", reference=KELVIN),
)
EXACT = Shared()
SHARED = Shared(radius=0.01, gain=0.02, zero=1e-6)


@functools.cache
def shrinking(control: str) -> vf.friction.IndentationRecord:
    """Return a ramp, a hold and an unloading, solved over time."""
    time = np.concatenate([np.linspace(0.1, 1.0, 7), 1.0 + np.geomspace(0.05, 9.0, 9), 10.0 + np.linspace(0.1, 0.5, 5)])
    most = {"load": 2.0, "indentation": 2e-4}[control]
    knots, values = [0.0, 1.0, 10.0, 11.0], [0.0, most, most, 0.0]
    history = vf.motion.History(knots, **{control: values}, temperature=KELVIN)
    run = vf.motion.solve_transient(RUBBER, BALL, history, times=time, accuracy=1e-3)
    rows = {"load": run.load, "indentation": run.indentation, control: np.interp(time, knots, values)}
    rows = {name: np.append(0.0, one) for name, one in rows.items()}
    return vf.friction.IndentationRecord(np.append(0.0, time), **rows, temperature=KELVIN, control=control, error=1e-9)


@functools.cache
def rebounds(kelvin: float = KELVIN, speeds: tuple[float, ...] = (0.4, 1.6)) -> vf.friction.ReboundRecord:
    hits = [
        vf.motion.solve_impact(RUBBER, BALL, mass=0.033, speed=v, temperature=kelvin, accuracy=1e-3) for v in speeds
    ]
    columns = {
        "restitution": "restitution", "contact_time": "contact_time", "peak_force": "peak_force",
        "indentation": "largest_indentation",
    }  # fmt: skip
    values = {name: [getattr(hit, own) for hit in hits] for name, own in columns.items()}
    return vf.friction.ReboundRecord(speeds, kelvin, mass=0.033, error=0.01, **values)


MADE = {
    "creep": lambda: creep(noise=0.0),
    "relaxation": lambda: relaxation(noise=0.0),
    "unloading": lambda: shrinking("load"),
    "withdrawal": lambda: shrinking("indentation"),
    "rebounds": rebounds,
}


def contact_of(record, shared: Shared = EXACT):
    return usable_records([record], BALL, shared).contacts[0]


@pytest.mark.parametrize("control", ["load", "indentation"])
def test_unloading_agrees_with_the_solver_over_time(control: str) -> None:
    contact, trial = contact_of(shrinking(control)), planted(KELVIN, RUBBER)
    assert contact.by_springs
    # Springs and steps are good to 1e-3, and the solver's accuracy is 1e-3 of the largest value.
    allowed = 3e-3 * contact.response.max()
    assert np.exp(contact.answer(trial).log_value) == pytest.approx(contact.response, abs=allowed)


def test_impacts_agree_with_their_solver() -> None:
    record = rebounds()
    contact, trial = contact_of(record), planted(KELVIN, RUBBER)
    # Steps of a hundredth of the contact: 1e-4 of the restitution; 64 springs: 1e-4 of the force.
    assert np.exp(contact.answer(trial).log_value) == pytest.approx(contact.response, rel=1e-3)
    assert 1.0 / contact.ends(trial)[1] == pytest.approx(record.contact_time.min() / np.pi, rel=0.3)


@pytest.mark.parametrize("name", ["unloading", "withdrawal", pytest.param("rebounds", marks=pytest.mark.slow)])
def test_derivatives_by_springs_are_those_of_differences(name: str, monkeypatch) -> None:
    contact = contact_of(MADE[name]())
    trial = planted(KELVIN, RUBBER)._replace(
        compliances=np.log(np.array([4e-7, 2e-7, 1e-7, 3e-7])), tau=np.array([1e-3, 0.1, 10.0]), extra=1e-9
    )
    steps = type(contact)._steps if hasattr(contact, "_steps") else None
    if steps is not None:  # the same steps and springs for all differences
        fixed = steps(contact, trial)
        monkeypatch.setattr(type(contact), "_steps", lambda self, trial: fixed)
        check_derivatives(contact.answer, trial, 1e-5)
    else:  # steps and springs follow the material: their errors change by little
        check_derivatives(contact.answer, trial, 2e-2)


def test_nearby_materials_are_those_solved_again() -> None:
    for record in (shrinking("load"), rebounds()):
        contact, trial = contact_of(record), planted(KELVIN, RUBBER)
        near = Nearby.of(contact, trial)
        harder = trial._replace(compliances=trial.compliances - 0.5)
        bend = 0.1 * np.sin(np.arange(len(trial.compliances)) / 8.0)
        other = trial._replace(compliances=trial.compliances + bend, log_alpha=0.1)
        # A change of all moduli by one factor is exact, up to the derivative: a spring in or out is 2 % of the load.
        # Second order remains of any other: a tenth, squared.
        for there, allowed in ((harder, 0.02 * 0.5), (other, 1e-2)):
            if record.__class__ is vf.friction.ReboundRecord and there is harder:
                continue  # contact times change, and with them what of the spectrum counts
            assert near(there).log_value == pytest.approx(contact.answer(there).log_value, abs=allowed)


@pytest.mark.parametrize(
    "name", ["creep", "relaxation", *(pytest.param(one, marks=pytest.mark.slow) for one in list(MADE)[2:])]
)
def test_common_errors_are_those_of_wrong_radius_load_and_zero(name: str) -> None:
    record = MADE[name]()
    contact, trial = contact_of(record, SHARED), planted(record.temperature, RUBBER)
    found = contact.answer(trial).shared
    measured = np.log(contact.response)
    true = vf.Ball(BALL.radius * (1.0 + SHARED.radius))
    away = usable_records([record], true, EXACT).contacts[0]
    moved = away.answer(trial).log_value - np.log(away.response)
    at_first = contact.answer(trial).log_value - measured
    # To first order in 1 %, by springs to their error.
    assert found[:, 0] == pytest.approx(moved - at_first, abs=1e-3)
    if isinstance(record, vf.friction.IndentationRecord):
        other = vf.friction.IndentationRecord(
            record.time, record.load * (1.0 + SHARED.gain), record.indentation, record.temperature,
            control=record.control, start=record.start, error=record.error,
        )  # fmt: skip
        away = contact_of(other)
        moved = away.answer(trial).log_value - np.log(away.response)
        assert found[:, 1] == pytest.approx(moved - at_first, abs=2e-3)
        deeper = np.where(record.indentation > 0.0, record.indentation + SHARED.zero, record.indentation)
        other = vf.friction.IndentationRecord(
            record.time, record.load, deeper, record.temperature, control=record.control, start=record.start,
            error=record.error,
        )  # fmt: skip
        away = contact_of(other)
        moved = away.answer(trial).log_value - np.log(away.response)
        size = np.abs(moved - at_first).max()
        assert found[:, 2] == pytest.approx(moved - at_first, abs=0.1 * size + 1e-3)


def test_scatter_of_what_was_prescribed_is_no_oscillation() -> None:
    time, random = np.linspace(0.0, 4.0, 401), np.random.default_rng(2)
    scatter = 1e-3 * random.standard_normal(401)
    assert _turns(time, np.minimum(time, 4.0 - time) + scatter).tolist() == pytest.approx([2.0], abs=0.02)
    assert len(_turns(time, 1.0 + 0.1 * np.sin(np.pi * time) + scatter)) == 4


@pytest.mark.slow
def test_stiffness_of_small_oscillations_is_that_of_the_contact_radius() -> None:
    omega, depth, part = 20.0, 1e-4, 0.02
    phase = 2.0 * np.pi * np.arange(0, 3 * 32 + 1) / 32
    time = np.concatenate([[0.0, 0.01], 100.0 + phase / omega])
    values = np.concatenate([[0.0, depth], depth * (1.0 + part * np.sin(phase))])
    history = vf.motion.History(time, indentation=values, temperature=KELVIN)
    run = vf.motion.solve_transient(RUBBER, BALL, history, times=time[-33:], accuracy=1e-3)
    turned = np.exp(-1j * phase[-33:])
    stiffness = np.trapezoid(run.load * turned) / np.trapezoid(values[-33:] * turned)
    expected = 2.0 * np.sqrt(BALL.radius * depth) * RUBBER.complex_modulus(omega, KELVIN) / PLANE_STRAIN
    # The edge follows the oscillation: some 0.3 of its amplitude; accuracy in time 1e-3 of the load, over 2 % of it.
    assert stiffness.real == pytest.approx(expected.real, rel=0.01)
    assert stiffness.imag == pytest.approx(expected.imag, rel=0.03)


def test_stiffness_gives_the_modulus() -> None:
    omega = 2.0 * np.pi * np.geomspace(0.1, 10.0, 9)
    E = RUBBER.complex_modulus(omega, KELVIN)
    K = 2.0 * np.sqrt(0.01 * 1e-4) / PLANE_STRAIN * E
    record = vf.friction.OscillationRecord(
        omega, K.real, K.imag, KELVIN, indentation="100 um", amplitude="2 um", error=0.01, source="synthetic"
    )
    found = vf.identify_from_indentation(record, BALL, samples=20, modes=8, radius_error=0.02, load_error=0.01)
    assert found.material.complex_modulus(omega[4]) == pytest.approx(E[4], rel=0.01)
    # K ∝ √R: 1 % of the modulus from the radius, 1 % from the load.
    assert found.standard_error(omega[4]) == pytest.approx(np.hypot(0.01, 0.01), rel=0.5)
    assert set(found.common_errors) == {"radius", "load"}
    assert [one.quantity for one in found.records] == ["storage_stiffness", "loss_stiffness"]
    assert found.records[0].to_dataset()["angular_frequency"].attrs["units"] == "rad/s"


@pytest.mark.apart
def test_planted_modulus_comes_back_from_rebounds_and_unloading() -> None:
    records = [rebounds(kelvin, (0.3, 0.7, 1.5)) for kelvin in (283.15, 303.15, 323.15)]
    found = vf.identify_from_indentation(records, BALL, shift=RUBBER.shift, reference=KELVIN, samples=20)
    omega = np.geomspace(*found.frequency_range, 5)
    away = found.material.complex_modulus(omega) / RUBBER.complex_modulus(omega, KELVIN) - 1.0
    assert np.abs(away).max() < 0.03  # errors of 1 %, without noise
    # Impacts of up to 1.5 m/s are wide, and waves take some of their energy.
    assert codes(found.notes) == {"errors-not-scatter", "large-strain", "quasi-static"}
    unloading = vf.friction.IndentationRecord(**{
        name: getattr(shrinking("load"), name) for name in ("time", "load", "indentation", "temperature", "control")
    })  # fmt: skip
    found = vf.identify_from_indentation(unloading, BALL, samples=20, modes=16)
    omega = np.geomspace(*found.frequency_range, 5)
    away = found.material.complex_modulus(omega) / RUBBER.complex_modulus(omega, KELVIN) - 1.0
    assert np.abs(away).max() < 0.02


def test_restitution_alone_needs_an_anchor() -> None:
    record = vf.friction.ReboundRecord([0.4, 1.6], KELVIN, mass=0.033, error=0.01, restitution=rebounds().restitution)
    with pytest.raises(InputError) as caught:
        vf.identify_from_indentation(record, BALL)
    assert caught.value.code == "level-unknown"
    E = abs(RUBBER.complex_modulus(100.0, KELVIN))
    found = vf.identify_from_indentation(
        [record, vf.friction.ModulusAnchor(E, 100.0, KELVIN)], BALL, samples=20, modes=12
    )
    assert abs(found.material.complex_modulus(100.0)) == pytest.approx(E, rel=0.03)
    assert [one.quantity for one in found.records] == ["restitution", "magnitude_modulus"]
    (waves,) = (note for note in found.notes if note.code == "quasi-static")
    hit = vf.motion.solve_impact(RUBBER, BALL, mass=0.033, speed=1.6, temperature=KELVIN)
    same = next(note for note in hit.warnings if note.code == "quasi-static").values["change"]
    assert waves.values["change"] == pytest.approx(same, rel=0.1)  # moduli to 3 %, at one frequency


def test_almost_a_single_retardation_time_has_a_note() -> None:
    solid = vf.Material.standard_linear_solid(E0="2 MPa", E_inf="20 MPa", tau="1 s")
    time = np.geomspace(0.01, 100.0, 40)
    depth = (0.75 * solid.at().creep_compliance(time) * 2.0 * 0.75 / 0.1) ** (2.0 / 3.0)
    depth *= 1.0 + 1e-3 * np.random.default_rng(1).standard_normal(40)
    record = vf.friction.IndentationRecord(time, np.full(40, 2.0), depth, 300.0, control="load", start=0.0)
    found = vf.identify_from_indentation(record, BALL, samples=20, modes=16)
    assert "narrow-spectrum" in codes(found.notes)
    assert found.identified_loss.decades == 0.0


@pytest.mark.parametrize(
    ("change", "code"),
    [
        ({"restitution": None}, "give-one"),
        ({"restitution": [0.6]}, "wrong-length"),
        ({"restitution": [0.6, 0.0]}, "not-positive"),
        ({"error": {"contact_time": 0.01}}, "wrong-names"),
        ({"error": 2.0}, "out-of-range"),
        ({"gravity": -9.8}, "negative"),
    ],
)
def test_rebounds_that_cannot_be(change: dict, code: str) -> None:
    given = {"speed": [1.0, 2.0], "temperature": 300.0, "mass": 0.03, "restitution": [0.6, 0.5], "error": 0.01}
    with pytest.raises(InputError) as caught:
        vf.friction.ReboundRecord(**(given | change))
    assert caught.value.code == code


def test_large_oscillations_are_no_stiffness() -> None:
    with pytest.raises(InputError) as caught:
        vf.friction.OscillationRecord([1.0], [1e4], [1e3], 300.0, indentation=1e-4, amplitude=4e-6, error=0.01)
    assert caught.value.code == "out-of-range"


def test_tables_of_rebounds_and_oscillations(tmp_path) -> None:
    path = tmp_path / "rebound.csv"
    path.write_text("speed (m/s),restitution (1),temperature (degC)\n1,0.6,20\n2,0.5,20.1\n1,0.7,40\n")
    cold, warm = vf.friction.read_rebound(path, mass="33 g", error=0.01)
    assert (len(cold), len(warm)) == (2, 1)
    assert warm.temperature == pytest.approx(313.15)
    assert cold.to_dataset()["restitution"].values.tolist() == [0.6, 0.5]
    path.write_text("frequency (Hz),storage stiffness (N/mm),loss stiffness (N/mm)\n1,10,1\n")
    (one,) = vf.friction.read_oscillation(path, indentation=1e-4, amplitude=1e-6, error=0.01, temperature=300.0)
    assert (one.angular_frequency[0], one.storage_stiffness[0]) == pytest.approx((2.0 * np.pi, 1e4))
    assert one.to_dataset().attrs["loss_stiffness_error"] == 0.01
    still = tmp_path / "still.csv"
    still.write_text("frequency (Hz),storage stiffness (N/mm),loss stiffness (N/mm)\n0,10,1\n")
    with pytest.raises(vf.DataFileError) as caught:
        vf.friction.read_oscillation(still, indentation=1e-4, amplitude=1e-6, error=0.01, temperature=300.0)
    assert caught.value.path == str(still)
    with pytest.raises(vf.DataFileError) as caught:
        vf.friction.read_rebound(path, mass="33 g", error=0.01, temperature=300.0)
    assert caught.value.code == "missing-columns"


def test_all_columns_of_rebounds_and_oscillations_can_be_named(tmp_path) -> None:
    path = tmp_path / "rebound.csv"
    path.write_text("v1 (m/s),tc (ms),Fmax (N)\n1,2,3\n")
    columns = {"speed": "v1 (m/s)", "contact_time": "tc (ms)", "peak_force": "Fmax (N)"}
    (one,) = vf.friction.read_rebound(path, mass="33 g", error=0.01, temperature=300.0, columns=columns)
    assert one.contact_time is not None
    assert one.peak_force is not None
    assert (one.speed[0], one.contact_time[0], one.peak_force[0]) == pytest.approx((1.0, 2e-3, 3.0))
    path.write_text("f (Hz),S1 (N/m),S2 (N/m)\n1,200,20\n")
    columns = {"storage_stiffness": "S1 (N/m)", "loss_stiffness": "S2 (N/m)"}
    (stiffness,) = vf.friction.read_oscillation(
        path, indentation=1e-4, amplitude=1e-6, error=0.01, temperature=300.0, columns=columns
    )
    assert (stiffness.storage_stiffness[0], stiffness.loss_stiffness[0]) == pytest.approx((200.0, 20.0))


@pytest.mark.parametrize(
    ("heading", "values", "code"), [("restitution", "60", "out-of-range"), ("height (mm)", "3", "missing-columns")]
)
def test_tables_that_are_no_rebounds_name_their_file(tmp_path, heading: str, values: str, code: str) -> None:
    path = tmp_path / "rebound.csv"
    path.write_text(f"speed (m/s),{heading}\n1,{values}\n")
    with pytest.raises(vf.DataFileError) as caught:
        vf.friction.read_rebound(path, mass="33 g", error=0.01, temperature=300.0)
    assert (caught.value.code, caught.value.path) == (code, str(path))
