"""A curve of closed forms: how few nodes it takes, and whether the errors that it claims hold."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from friction.planning.made_up_contacts import BALL, SLS, case_of, made_up
from marks import apart
from viscofric.contact.free.scale import Scale
from viscofric.friction.cases.indenter_case import LOGARITHMIC, node_of
from viscofric.friction.cases.interpolation import FRICTION, Node
from viscofric.friction.planning.curve import STEP, Curve
from viscofric.friction.planning.plan import Plan

RECORD = made_up(Plan([case_of(0.1)], [SLS], each=True).wanted()[0])
NODE = node_of(RECORD, Scale.for_load(BALL, 1e6 / 0.75, RECORD.load))
PLACES = np.linspace(-6.0, 6.0, 200)

#: Modes whose loss makes the friction: places of their maxima, and strengths.
MODES = st.lists(st.tuples(st.floats(-8.0, 8.0), st.floats(0.05, 1.0)), min_size=1, max_size=8)


def friction(places: np.ndarray, modes: list[tuple[float, float]]) -> np.ndarray:
    """Return the loss of Debye's modes, which vary more steeply with s than friction does."""
    apart = places[:, None] - np.array([place for place, _ in modes])
    return (np.array([strength for _, strength in modes]) / np.cosh(apart)).sum(axis=1) + 1e-3


def node_at(place: int, modes: list[tuple[float, float]]) -> Node:
    """Return a node with the friction of the modes, and no error to speak of."""
    values, errors = NODE.values.copy(), 1e-12 * NODE.values
    values[FRICTION] = friction(np.array([STEP * place]), modes)[0]
    return Node(NODE.record, values, np.abs(errors))


def solved_curve(modes: list[tuple[float, float]], accuracy: float) -> tuple[Curve, int]:
    """Answer all that a curve wants; it, and how many nodes that took."""
    curve, count = Curve(PLACES, accuracy, LOGARITHMIC), 0
    while curve.wanted:
        count += len(curve.wanted)
        curve.advance({place: node_at(place, modes) for place in curve.wanted})
    return curve, count


def random_modes(random: np.random.Generator) -> list[tuple[float, float]]:
    """Return one to eight modes."""
    return [(random.uniform(-8.0, 8.0), random.uniform(0.05, 1.0)) for _ in range(random.integers(1, 9))]


@pytest.mark.parametrize("accuracy", [1e-2, *apart(1e-3, 1e-4)])
def test_claimed_errors_hold(accuracy: float) -> None:
    random, held = np.random.default_rng(0), []
    for _ in range(15):
        modes = random_modes(random)
        curve = solved_curve(modes, accuracy)[0]
        for one in curve.closed:
            found = curve.between(one).found
            off = np.abs(found.values[:, FRICTION] - friction(PLACES[one.cases], modes))
            claimed = np.hypot(found.from_nodes[:, FRICTION], found.between[:, FRICTION])
            held += (off <= claimed).tolist()
    assert np.mean(held) >= 0.95


@pytest.mark.slow
@settings(max_examples=15, deadline=None, derandomize=True)
@given(modes=MODES, accuracy=st.sampled_from([1e-2, 1e-3, 1e-4]))
def test_accuracy_is_kept_and_no_case_is_lost(modes: list[tuple[float, float]], accuracy: float) -> None:
    curve = solved_curve(modes, accuracy)[0]
    seen = list(curve.alone)
    for one in curve.closed:
        found = curve.between(one).found
        true = friction(PLACES[one.cases], modes)
        assert np.all(np.abs(found.values[:, FRICTION] - true) <= accuracy * true)
        seen += one.cases.tolist()
    assert sorted(seen) == list(range(len(PLACES)))


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3])
@pytest.mark.slow
def test_errors_that_are_reported_are_within_the_accuracy(accuracy: float) -> None:
    """Those of the nodes are nearly as large as they may be, and interpolating adds to them."""
    random = np.random.default_rng(0)
    for _ in range(5):
        modes, curve = random_modes(random), Curve(PLACES, accuracy, LOGARITHMIC)
        while curve.wanted:
            found = {}
            for place in curve.wanted:
                node = node_at(place, modes)
                errors = node.errors.copy()
                errors[FRICTION] = random.uniform(0.3, 0.95) * accuracy * node.values[FRICTION]
                found[place] = Node(node.record, node.values, errors)
            curve.advance(found)
        seen = list(curve.alone)
        for one in curve.closed:
            reported = curve.between(one).found
            errors = np.hypot(reported.from_nodes[:, FRICTION], reported.between[:, FRICTION])
            assert np.all(errors <= accuracy * reported.values[:, FRICTION])
            seen += one.cases.tolist()
        assert sorted(seen) == list(range(len(PLACES)))


def test_nodes_grow_slowly_with_the_accuracy() -> None:
    counts = [solved_curve([(0.0, 1.0), (2.0, 0.5)], accuracy)[1] for accuracy in (1e-2, 1e-3, 1e-4)]
    assert counts[0] < counts[1] < counts[2]
    # Sixth order: an accuracy ten times better takes 10^(1/6) times as many in the limit, and never twice.
    assert counts[1] < 2 * counts[0]
    assert counts[2] < 2 * counts[1]


def test_a_law_of_powers_takes_no_more_than_the_first_nodes() -> None:
    curve, nodes = Curve(PLACES, 1e-3, LOGARITHMIC), 0
    while curve.wanted:
        nodes += len(curve.wanted)
        found = {}
        for place in curve.wanted:
            values = NODE.values.copy()
            values[FRICTION] = 0.1 * np.exp(0.7 * STEP * place)
            found[place] = Node(NODE.record, values, 1e-12 * np.abs(values))
        curve.advance(found)
    # Every unit of s from -6 to 7, within which the last place lies, and the middles of all but the last interval,
    # whose one case is solved by itself.
    assert nodes == 14 + 12
    assert len(curve.alone) == 1
