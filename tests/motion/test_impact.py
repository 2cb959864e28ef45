"""Impacts: Ting's solution, asymptotes for small losses, energy, scales, rebounds under gravity."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import viscofric as vf
from refusals import refused
from viscofric.notes import codes, note_of
from viscofric.rheology.spectra.quality import SpectrumFit

BALL = vf.Ball("10 mm")
MASS, SPEED = 0.03267256359733385, 0.1  # kg, m/s


def rubber(tau, E0=1e6, E_inf=1e7):
    return vf.Material.standard_linear_solid(E0=E0, E_inf=E_inf, tau=tau)


#: tau (s) -> restitution, contact time, largest indentation, peak force, separation indentation, time of the largest
#: indentation: independent solution (Ting's closed form as an ordinary differential equation), good to 1e-6.
TING = {
    1e-5: (0.995160686471316, 0.01030740006897339, 0.000349657994307089, 1.1623741609352352, 8.956447546843926e-07,
           0.005151826677746865),
    1e-4: (0.9533716689531873, 0.01027150063274756, 0.00034369993747298866, 1.133631486159823, 8.58033909992177e-06,
           0.00511730402197443),
    1e-3: (0.6601652799332051, 0.009907517647036405, 0.0002961894706328782, 0.9707336584350278, 5.940375525784494e-05,
           0.004794365451386769),
    1e-2: (0.2793460125184263, 0.00461823509022671, 0.00016918139709124212, 1.715668999904165, 0.00013155298646644743,
           0.0027669054850617534),
    1e-1: (0.8519936909229843, 0.0040610109659726485, 0.00014206969501338876, 2.7295035684855873, 2.844622008165259e-05,
           0.0021094353429179724),
    1e0: (0.9837556102554637, 0.004099583379246513, 0.00013972769079019506, 2.9070410814333405, 3.1787154104543205e-06,
          0.0020580762155153454),
    1e1: (0.9983597576277792, 0.004104481400953733, 0.0001394973202138627, 2.926107406570115, 3.216112065626186e-07,
          0.00205307334915745),
}  # fmt: skip


@pytest.mark.parametrize("tau", TING)
def test_an_impact_is_that_of_tings_solution(tau):
    hit = vf.motion.solve_impact(rubber(tau), BALL, mass=MASS, speed=SPEED)
    restitution, duration, deepest, peak, separation, when = TING[tau]
    assert hit.restitution == pytest.approx(restitution, abs=3e-5)  # a third of the accuracy asked for
    assert hit.restitution_error < 1e-4
    # largest values lie between steps: second order, 100 steps a contact
    first = hit.contacts[0]
    assert (hit.contact_time, first.time_of_largest) == pytest.approx((duration, when), rel=3e-5)
    assert (hit.largest_indentation, hit.peak_force) == pytest.approx((deepest, peak), rel=5e-5)
    assert first.separation_indentation == pytest.approx(separation, rel=1e-4)
    assert hit.run.energy_imbalance < 1e-4


def test_small_losses_of_long_contacts_are_those_of_ramirez():
    """1 − e to first order in the times; the next order is as large as 1 − e itself, 5e-4 of it."""
    tau, E0, R = 1e-6, 1e6, 0.01
    kappa = 4.0 * math.sqrt(R) / (3.0 * 0.75)
    depth = (5.0 * MASS * SPEED**2 / (4.0 * kappa * E0)) ** 0.4
    beta = math.gamma(0.6) * math.gamma(1.5) / math.gamma(2.1)
    loss = 3.0 * kappa * E0 * (E0 * 9e-7 * tau) * SPEED * depth**1.5 * 0.4 * beta / (MASS * SPEED**2)
    hit = vf.motion.solve_impact(rubber(tau), BALL, mass=MASS, speed=SPEED, accuracy=3e-6)
    assert 1.0 - hit.restitution == pytest.approx(loss, rel=5e-3)


def test_an_elastic_impact_is_that_of_hertz():
    """T = 2.94328 δ/v, with δ by the energy."""
    hit = vf.motion.solve_impact(rubber(1e9), BALL, mass=MASS, speed=SPEED, accuracy=1e-5)
    depth = (15.0 * 0.75 * MASS * SPEED**2 / (16.0 * 1e7 * 0.1)) ** 0.4
    assert hit.restitution == pytest.approx(1.0, abs=1e-5)
    assert hit.largest_indentation == pytest.approx(depth, rel=1e-5)
    assert hit.contact_time == pytest.approx(2.94328 * depth / SPEED, rel=1e-5)


def ting(spectrum, radius, mass, speed):
    """Return the restitution by T. C. T. Ting, J. Appl. Mech. 33 (1966) 845, as ordinary differential equations."""
    prony = spectrum.to_relaxation()
    E0, E, rate, n = prony.E0, prony.E, 1.0 / prony.tau, len(prony)

    def elastic(depth):
        return 4.0 / 3.0 * math.sqrt(radius) / 0.75 * max(depth, 0.0) ** 1.5

    def approach(_, y):  # δ, v, relaxing depths M and relaxing loads Q
        depth, v, M, Q = y[0], y[1], y[2 : n + 2], y[n + 2 :]
        pressing = 2.0 * math.sqrt(radius * max(depth, 0.0)) / 0.75 * v
        return [v, -(E0 * elastic(depth) + E @ Q) / mass, *(v - rate * M), *(pressing - rate * Q)]

    def turned(_, y):
        return y[1]

    turned.terminal, turned.direction = True, -1.0
    tight = {"rtol": 1e-7, "atol": 1e-13}
    there = solve_ivp(approach, (0.0, 1.0), [0.0, speed, *np.zeros(2 * n)], events=turned, dense_output=True, **tight)
    top, past = there.t[-1], there.sol

    def earlier(t, depth, M):
        """Return the time at which the contact was as wide while it grew."""

        def strain(t1):
            old = past(t1)
            return E0 * (depth - old[0]) + E @ (M - np.exp(-rate * (t - t1)) * old[2 : n + 2])

        return 0.0 if strain(0.0) <= 0.0 else brentq(strain, 0.0, top, xtol=1e-16) if strain(top) < 0.0 else top

    def retreat(t, y):
        t1 = earlier(t, y[0], y[2:])
        old = past(t1)
        force = E0 * elastic(old[0]) + E @ (np.exp(-rate * (t - t1)) * old[n + 2 :])
        return [y[1], -force / mass, *(y[1] - rate * y[2:])]

    def left(t, y):
        return E0 * y[0] + E @ y[2:]

    left.terminal, left.direction = True, -1.0
    back = solve_ivp(retreat, (top, top + 1.0), there.y[: n + 2, -1], events=left, **tight)
    return -back.y[1, -1] / speed


def broad(count):
    """Return a spectrum of many modes from 0.1 ms to 10 s, E∞/E0 = 10."""
    tau = np.geomspace(1e-4, 1e1, count)
    weight = np.exp(-0.5 * (np.log10(tau / 1e-2) / 1.2) ** 2)
    return vf.RetardationSpectrum(1e6, 1e7, 9e-7 * weight / weight.sum(), tau)


@pytest.mark.slow
def test_forty_modes_agree_with_tings_solution():
    spectrum = broad(40)
    hit = vf.motion.solve_impact(vf.Material(spectrum), BALL, mass=MASS, speed=SPEED)
    assert hit.restitution == pytest.approx(ting(spectrum, 0.01, MASS, SPEED), abs=1e-4)
    assert hit.run.energy_imbalance < 1e-4


def test_scales_do_not_matter():
    """Times alike; moduli by 1e6, lengths by 1e-3 and times by 1e9: the same restitution."""
    hit = vf.motion.solve_impact(rubber(1e-3), BALL, mass=MASS, speed=SPEED)
    slow = vf.motion.solve_impact(rubber(1.0), BALL, mass=1e6 * MASS, speed=1e-3 * SPEED)
    assert slow.restitution == pytest.approx(hit.restitution, abs=1e-9)
    assert slow.contact_time == pytest.approx(1e3 * hit.contact_time, rel=1e-9)
    E, L, T = 1e6, 1e-3, 1e9
    other = vf.motion.solve_impact(
        rubber(1e-3 * T, 1e6 * E, 1e7 * E), vf.Ball(0.01 * L), mass=MASS * E * L * T**2, speed=SPEED * L / T
    )
    assert other.restitution == pytest.approx(hit.restitution, abs=1e-9)
    assert other.peak_force == pytest.approx(E * L**2 * hit.peak_force, rel=1e-9)


def test_a_cone_of_an_elastic_body_bounces_back_as_fast():
    """F = (2 E*/π tan θ) δ², so that m v²/2 = (2 E*/3π tan θ) δ³."""
    angle, stiffness = 0.1, 1e7 / 0.75
    hit = vf.motion.solve_impact(rubber(1e9), vf.Cone(angle), mass=MASS, speed=SPEED)
    depth = (0.75 * math.pi * math.tan(angle) * MASS * SPEED**2 / stiffness) ** (1.0 / 3.0)
    assert hit.restitution == pytest.approx(1.0, abs=1e-4)
    assert hit.largest_indentation == pytest.approx(depth, rel=1e-4)


def test_a_punch_bounces_as_a_mass_on_a_spring():
    """F = 2 a E* δ: half a period is π √(m/2aE*)."""
    hit = vf.motion.solve_impact(rubber(1e9), vf.FlatPunch("1 mm"), mass=MASS, speed=SPEED)
    stiffness = 2.0 * 1e-3 * 1e7 / 0.75
    assert hit.restitution == pytest.approx(1.0, abs=1e-4)
    assert hit.contact_time == pytest.approx(math.pi * math.sqrt(MASS / stiffness), rel=1e-4)
    assert hit.largest_indentation == pytest.approx(SPEED * math.sqrt(MASS / stiffness), rel=1e-4)


def test_an_elastic_ball_adds_its_compliance():
    """With E_i* = E∞*, depths are those of half the modulus."""
    hit = vf.motion.solve_impact(
        rubber(1e9), BALL, mass=MASS, speed=SPEED, indenter_modulus=1e7, indenter_poisson_ratio=0.5, accuracy=1e-5
    )
    depth = (15.0 * 0.75 * MASS * SPEED**2 / (16.0 * 0.5e7 * 0.1)) ** 0.4
    assert hit.largest_indentation == pytest.approx(depth, rel=1e-5)


@pytest.mark.slow
def test_rebounds_under_gravity_go_on_until_the_ball_rests():
    hit = vf.motion.solve_impact(rubber(1e-3), BALL, mass=0.03, speed=1.0, gravity=9.81, rebounds=8)
    each = hit.contacts
    assert len(each) == 5
    assert each[-1].restitution == 0.0
    assert math.isinf(each[-1].contact_time)
    assert "no-rebound" in codes(hit.warnings)
    assert hit.run.energy_imbalance < 1e-4
    for one, following in itertools.pairwise(each):
        leaving = one.restitution * one.speed
        pause = following.start - one.start - one.contact_time
        assert pause == pytest.approx(2.0 * leaving / 9.81, rel=0.1)  # the dent is shallower at the next touch
        # It falls from where it left at v g t: the speed at the touch is that of the parabola.
        assert following.speed == pytest.approx(9.81 * pause - leaving, rel=1e-4)
        assert following.speed < leaving
        flight = (hit.run.time > one.start + one.contact_time) & (hit.run.time < following.start)
        # It rises to v²/2g above where it left, and nothing acts on the material, which relaxes.
        top = one.separation_indentation - leaving**2 / (2.0 * 9.81)
        assert hit.run.indentation[flight].min() == pytest.approx(top, rel=0.02)
        np.testing.assert_allclose(np.ptp(hit.run.work[flight]), 0.0, atol=1e-12)
        assert np.all(np.diff(hit.run.stored[flight]) <= 0.0)


@pytest.mark.slow
def test_a_slow_ball_sinks_in_and_stays():
    hit = vf.motion.solve_impact(rubber(1e-2), BALL, mass=0.03, speed=1e-3, gravity=9.81)
    assert hit.restitution == 0.0
    still = (0.75 * 0.75 * 0.03 * 9.81 / (1e6 * 0.1)) ** (2.0 / 3.0)
    assert 0.9 * still < hit.largest_indentation < 2.0 * still  # it oscillates about it
    assert "quasi-static" not in codes(hit.warnings)  # waves take little of the work of gravity


def test_the_error_of_an_indenter_that_nearly_leaves_includes_its_restitution_if_it_did():
    """Restitution jumps where the surface just catches up with the indenter: at 0.112352 m/s."""
    stays, limit, leaves = (
        vf.motion.solve_impact(rubber(1e-2), BALL, mass=0.03, speed=speed, gravity=9.81, accuracy=1e-2)
        for speed in (0.1123, 0.11235, 0.1124)
    )
    assert (stays.restitution, limit.restitution) == (0.0, 0.0)
    assert stays.restitution_error < 1e-6
    (values,) = [note.values for note in map(note_of, stays.warnings) if note.code == "no-rebound"]
    assert 0.0 < values["nearest"] < 2e-4 * stays.largest_indentation
    assert leaves.restitution == pytest.approx(values["restitution"], rel=0.1)
    assert limit.restitution_error == pytest.approx(leaves.restitution, rel=0.1)


def test_the_error_of_an_indenter_that_hardly_leaves_includes_its_restitution() -> None:
    """Within 1e-4 of the limit, at 0.11236 m/s, one of two accuracies lets it leave, the other stay."""
    hit, finer, above = (
        vf.motion.solve_impact(rubber(1e-2), BALL, mass=0.03, speed=speed, gravity=9.81, accuracy=accuracy)
        for speed, accuracy in ((0.112357, 1e-2), (0.112357, 1e-4), (0.1124, 1e-2))
    )
    assert (hit.restitution > 0.1, finer.restitution) == (True, 0.0)
    assert min(hit.restitution_error, finer.restitution_error) >= hit.restitution - 0.01
    assert "rebound-not-certain" in codes(hit.warnings)
    assert above.restitution_error < 1e-2
    assert "rebound-not-certain" not in codes(above.warnings)


@pytest.mark.slow
def test_the_curve_over_temperature_has_a_minimum_in_the_transition():
    warm = vf.Material(broad(12), shift=vf.WLF(C1=8.0, C2=100.0, reference=300.0))
    kelvin = [260.0, 300.0, 400.0]
    curve = vf.motion.restitution_curve(warm, BALL, speeds=[0.05, 0.1], temperatures=kelvin, mass="30 g")
    assert curve.restitution.shape == (3, 2)
    assert np.argmin(curve.restitution[:, 0]) == 1
    one = vf.motion.solve_impact(warm, BALL, speed=0.1, temperature=300.0, mass="30 g")
    assert curve.restitution[1, 1] == one.restitution
    data = curve.to_dataset()
    assert data.restitution.dims == ("temperature", "speed")
    assert data.peak_force.units == "N"
    assert one.to_dataset().velocity.size == one.velocity.size


def test_adhesion_of_several_impacts_is_noted_once() -> None:
    material, ball, how = rubber(1e-3), vf.Ball("1 mm"), {"mass": "10 mg", "accuracy": 1e-2}
    speeds = [1e-4, 1e-3]  # m/s, with forces below those of adhesion
    (note,) = vf.motion.restitution_curve(material, ball, speeds=speeds, **how).warnings
    assert [note.code, note.values["contacts"], note.values["of"]] == ["adhesion", 2, 2]
    alike = vf.motion.restitution_curve(material, ball, speeds=[1e-4, 1e-4], **how)
    assert alike.warnings == vf.motion.solve_impact(material, ball, speed=1e-4, **how).warnings


def test_what_cannot_fall_is_refused():
    with refused("negative"):
        vf.motion.solve_impact(rubber(1e-3), BALL, mass=1.0, speed=1.0, gravity=-9.81)
    with refused("out-of-range"):
        vf.motion.solve_impact(rubber(1e-3), BALL, mass=1.0, speed=1.0, accuracy=0.5)


@pytest.mark.apart
@pytest.mark.parametrize("accuracy", [1e-2, 1e-4])
def test_the_error_of_restitution_includes_merged_modes_and_springs(accuracy: float) -> None:
    """Restitution at this accuracy and at a much finer one differ by no more than the stated error."""
    tau = np.geomspace(1e-4, 1.0, 8)
    nearly_elastic = vf.RetardationSpectrum(100e6, 1.0 / (1e-8 - 8e-11), np.full(8, 1e-11), tau)
    stiff = vf.RetardationSpectrum(1e6, 1.0 / (1e-6 - 0.999e-6), [0.999e-6], [2e-3])
    for spectrum in (nearly_elastic, stiff):
        hit, finer = (
            vf.motion.solve_impact(vf.Material(spectrum), vf.Ball("20 mm"), mass="50 g", speed="0.1 m/s", accuracy=one)
            for one in (accuracy, 1e-6)
        )
        assert abs(hit.restitution - finer.restitution) <= hit.restitution_error <= accuracy
        assert abs(hit.largest_indentation - finer.largest_indentation) <= hit.run.errors.indentation[0]


def test_the_error_of_the_largest_force_includes_springs_that_are_touched_one_by_one() -> None:
    """Where glass is ten thousand times as stiff as rubber, each spring that is touched adds a spike of force."""
    share = np.array([0.0256, 0.0668, 0.2584, 0.5822, 0.0036, 0.0633])
    tau = [5.18e-4, 2.107e-3, 2.485e-3, 5.905e-3, 2.2625e-2, 0.56956]
    spectrum = vf.RetardationSpectrum(85e6, 4.8e12, share / share.sum() * (1.0 / 85e6 - 1.0 / 4.8e12), tau)
    hit, finer = (
        vf.motion.solve_impact(vf.Material(spectrum), vf.Ball("3.564 mm"), mass=0.2256, speed=0.0111, accuracy=one)
        for one in (1e-3, 3e-5)
    )
    assert abs(hit.peak_force - finer.peak_force) <= hit.run.errors.load[0] < 0.05 * hit.peak_force


@pytest.mark.parametrize("speed", [1e-6, 1e-3])
def test_a_ball_that_is_laid_down_falls_to_the_depth_that_its_weight_alone_gives(speed: float) -> None:
    """An elastic half-space: m g δ = 2/5 κ δ^(5/2), κ = 4√R E*/3: (5/2)^(2/3) of the depth at rest."""
    elastic = rubber(1e-2, E_inf=1.0001e6)
    hit = vf.motion.solve_impact(elastic, BALL, mass=0.03, speed=speed, gravity=9.81, accuracy=1e-2)
    still = (0.75 * 0.75 * 0.03 * 9.81 / (1e6 * 0.1)) ** (2.0 / 3.0)
    assert hit.largest_indentation == pytest.approx(2.5 ** (2.0 / 3.0) * still, rel=2e-3)
    assert hit.peak_force == pytest.approx(2.5 * 0.03 * 9.81, rel=2e-3)


@pytest.mark.parametrize(("ratio", "tau", "speed"), [(9.93e3, 0.0183, 5.05e-3), (1.9e3, 0.11, 0.0352)])
def test_the_error_of_the_energy_of_an_impact_includes_its_imbalance(ratio: float, tau: float, speed: float) -> None:
    one, finer = (
        vf.motion.solve_impact(rubber(tau, E_inf=ratio * 1e6), BALL, mass=0.03, speed=speed, accuracy=accuracy).run
        for accuracy in (1e-3, 1e-5)
    )
    off = abs(one.dissipated[-1] - finer.dissipated[-1])
    assert off <= one.errors.energy[-1] < 1e-3 * one.dissipated[-1]
    assert np.all(one.errors.energy >= np.abs(one.errors.balance))


@pytest.mark.apart
def test_waves_take_the_energy_of_an_elastic_impact_that_hunter_found() -> None:
    density, modulus, part = 1150.0, 1e7, 0.01  # of the note, kg/m³; Pa; of the speed of waves in a bar
    elastic = vf.Material.standard_linear_solid(E0=modulus, E_inf=1.0001 * modulus, tau=1.0, poisson_ratio=0.3)
    hit = vf.motion.solve_impact(
        elastic, BALL, mass=4.0 / 3.0 * math.pi * 1e-6 * density, speed=part * math.sqrt(modulus / density),
        indenter_modulus=modulus,
    )  # fmt: skip
    (note,) = (one for one in map(note_of, hit.warnings) if one.code == "quasi-static")
    # J. Mech. Phys. Solids 5 (1957) 162; his force is not quite Hertz's, which radiates 8 % more
    assert -math.log1p(-note.values["change"]) == pytest.approx(1.04 * part**0.6, rel=0.1)
    slow = vf.motion.solve_impact(elastic, BALL, mass="5 g", speed="0.01 m/s", indenter_modulus=modulus)
    assert "quasi-static" not in codes(slow.warnings)


@pytest.mark.parametrize(("tau", "speed", "restitution"), [(1e-5, 0.1, 0.9618), (1e-3, 1.0, 0.4919)])
def test_waves_lower_the_restitution_as_the_equation_of_motion_with_them_does(tau, speed, restitution) -> None:
    # Springs displaced by the waves of their own force, iterated by Fourier's transform, with other steps and springs.
    hit = vf.motion.solve_impact(rubber(tau), BALL, mass=0.033, speed=speed)
    (note,) = (one for one in map(note_of, hit.warnings) if one.code == "quasi-static")
    assert hit.restitution * math.sqrt(1.0 - note.values["change"]) == pytest.approx(restitution, abs=0.013)


def test_motion_faster_than_the_material_was_measured_is_noted() -> None:
    solid = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms").modes_at()
    material = vf.Material(replace(solid, fit=SpectrumFit(None, None, False, False, (100.0, 2e3))))

    def noted(result: vf.motion.TransientSolution | vf.motion.ImpactSolution) -> list[float]:
        return [note.values["highest"] for note in map(note_of, result.warnings) if note.code == "beyond-measured"]

    def slide(speed: float, *, back: bool = False, times: list[float] | None = None, rest: float = 0.0) -> list[float]:
        history = vf.motion.History(
            time=[0.0, rest + 1e-3, rest + 2e-3, *[3e-3] * back],
            load="1 N",
            position=[0.0, 0.0, 1e-3 * speed, *[0.0] * back],
            before="untouched" if rest else "at rest",
        )
        times = [rest, rest + 2e-3] if rest else times
        return noted(vf.motion.solve_transient(material, vf.Ball("10 mm"), history, times=times, accuracy=3e-2))

    def hit(mass: str) -> list[float]:
        return noted(vf.motion.solve_impact(material, vf.Ball("10 mm"), mass=mass, speed="0.1 m/s"))

    # A contact about 1 mm long to either side; one that lasts 4 ms, or a tenth of a second.
    assert slide(1.0) == []
    (rate,) = slide(10.0)
    assert 2e3 < rate < 1e5
    # Only the end is asked for, where the contact has grown; or the stroke ends where it began.
    for (again,) in (slide(10.0, times=[2e-3]), slide(10.0, back=True, times=[3e-3])):
        assert 0.5 * rate < again <= rate
    # What is asked for after a rest of half a second rests on creep for as long, at 2 rad/s.
    assert slide(1.0, rest=0.5) == pytest.approx([2.0])
    assert hit("4 g") == []
    (slow,) = hit("10 kg")
    assert slow < 100.0

    def press(time: list[float], load: list[float], before: str, times: list[float]) -> list[float]:
        history = vf.motion.History(time, load=load, before=before)
        return noted(vf.motion.solve_transient(material, vf.Ball("10 mm"), history, times=times))

    # 1/t after a jump, and the rate of a load that grows from that at rest.
    assert press([0.0, 5e-3], [1.0, 1.0], "untouched", [0.0, 1e-3, 5e-3]) == []
    assert press([0.0, 5e-3], [1.0, 1.0], "untouched", [1e-4, 5e-3]) == pytest.approx([1e4])
    assert press([0.0, 1.0], [1.0, 1.0], "untouched", [1.0]) == pytest.approx([1.0])
    assert press([0.0, 1e-4, 1.0], [0.5, 1.0, 1.0], "at rest", [1.0]) == pytest.approx([5e3])
    for load in (1.0, 0.0):
        assert press([0.0, 1.0], [load, load], "at rest", [1.0]) == []


@pytest.mark.parametrize(("E0", "mass", "speed"), [(1e-60, 1e-60, 0.1), (1e6, 0.01, 1e-99)])
def test_an_impact_whose_rebound_is_lost_in_rounding_is_refused(E0: float, mass: float, speed: float) -> None:
    """The indenter leaves downwards where the body yields without limit, or faster than it came."""
    rubber = vf.Material.standard_linear_solid(E0=E0, E_inf=1e7, tau=0.01)
    with refused("steps-not-converged", vf.ConvergenceError):
        vf.motion.solve_impact(rubber, vf.Ball("10 mm"), mass=mass, speed=speed)
