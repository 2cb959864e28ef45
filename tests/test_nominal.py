"""Nominal values: found behind scatter, whatever the order; chains without a gap are no nominal value."""

from __future__ import annotations

import numpy as np

from refusals import refused
from viscofric.nominal import clusters, numbered
from viscofric.notes import Note


def refusal(low, high):
    return Note("no-gap", f"speed from {low:g} to {high:g} has no gap.")


def test_a_gap_starts_the_next_nominal_value():
    values = np.array([2.01, 1.0, 1.99, 1.01, 0.99])
    assert list(numbered(values, 0.05 * values)) == [1, 0, 1, 0, 0]
    assert list(clusters(values, 0.05 * values, refusal)) == [1, 0, 1, 0, 0]


def test_scatter_that_stretches_on_and_on_is_refused_by_name():
    values = np.linspace(1.0, 2.0, 101)
    assert not numbered(values, np.full(values.shape, 0.05)).any()
    with refused("no-gap", naming="from 1 to 2"):
        clusters(values, np.full(values.shape, 0.05), refusal)


def test_speeds_that_double_and_double_are_no_nominal_value_however_wide_the_gaps_allowed():
    values = np.geomspace(0.1, 1.6, 9)  # steps of 29 % of the higher value
    with refused("no-gap", naming="from 0.1 to 1.6"):
        clusters(values, 0.4 * values, refusal)
    assert not clusters(values[:2], 0.4 * values[:2], refusal).any()


def test_no_values_have_no_nominal_values():
    assert numbered(np.empty(0), np.empty(0)).size == 0
    assert clusters(np.empty(0), np.empty(0), refusal).size == 0
