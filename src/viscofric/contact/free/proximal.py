"""Proximal points, for contacts where the active set does not converge.

The contact problem asks for the pressures at which 0 ∈ A p + N(p), A p = K p + h − δ and N the normal cone of p ≥ 0.
Where the solid's short waves lag by a quarter of a wave, K is nearly skew and the active set cycles even near the
solution.  With some compliance σ added to each cell, like a Winkler foundation's, K + σ is not skew for waves with
|K̂| < σ.  Rockafellar's iteration [1]_ removes the addition step by step: ::

    p_{n+1}  solves  0 ∈ (K + σ_n) p + h − σ_n p_n − δ + N(p)

It converges for every positive K, symmetric or not, and all σ_n > 0, faster for smaller ones; each step need be
solved only to a part of σ_n |p_{n+1} − p_n|.  So σ falls as long as its steps converge and rises where one does not.
Once σ is negligible, the problem itself is tried.

.. [1] R. T. Rockafellar, SIAM J. Control Optim. 14 (1976) 877, doi:10.1137/0314056.
"""

from __future__ import annotations

import logging
import math
from dataclasses import replace

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.complementarity import ComplementaritySolution
from viscofric.contact.free.problem import Control
from viscofric.contact.operators.convolution import ConvolutionOperator

logger = logging.getLogger(__name__)

# σ, relative to the compliance of waves four cells long: at first, and its later factors.  Where a step failed at some
# σ, the next ones approach it slowly, and the failure has less weight from step to step.
_FIRST, _FALL, _QUICK_FALL, _SLOW_FALL, _RISE, _FADE = 3.0, 0.5, 0.35, 0.8, 3.0, 0.9
_QUICK = 4  # updates of the contact set within which a step is an easy one
_LOOKS = 4  # updates without progress that end a step's attempt
_STEP_TOLERANCE = 0.3  # of each step, relative to the violation before it
_NEAR = 1e-6  # violation at which the problem itself is tried, if the tolerance is not larger
_HIGHEST = 1e4  # largest σ
# Limit of products: products times cells, about a minute's work, but not fewer products than the second number.
_CELL_PRODUCTS, _FEWEST_PRODUCTS = 6e8, 150


def proximal_points(
    control: Control, operator: ConvolutionOperator, height: Array, start: ComplementaritySolution, tolerance: float
) -> ComplementaritySolution:
    """Solve the contact problem from a pressure at which the active set makes no progress.

    `height` (nx, ny) is the indenter's, where the gap is evaluated; `tolerance` that of the complementarity.  Does not
    raise: check ``converged``.  The counts are those of the last active set, except ``products`` and the violations,
    which are those of all.
    """
    wavenumber = 0.5 * math.pi / operator.window.spacing
    unit = 2.0 * float(np.abs(operator.material.symbol(np.array([wavenumber])))[0]) / wavenumber
    most = max(_FEWEST_PRODUCTS, int(_CELL_PRODUCTS / height.size))
    pressure, violated, relative, failed, products = start.pressure, start.complementarity, _FIRST, 0.0, 0
    found = start
    while not found.converged and products < most and relative < _HIGHEST:
        damping = relative * unit
        damped, surface = operator.damped(damping), height - damping * pressure
        step = control.solve(damped, surface, pressure, max(tolerance, _STEP_TOLERANCE * violated), _LOOKS)
        products += step.products
        logger.debug("σ %.2g: %s after %d updates", relative, "solved" if step.converged else "not", step.set_changes)
        if not step.converged:
            failed, relative = relative, _RISE * relative
            continue
        pressure = step.pressure
        gap = step.displacement - damping * pressure + height - step.indentation
        violated = max(-float(gap.min()), float(np.abs(gap[pressure > 0.0]).max())) / abs(step.indentation)
        if violated < max(_NEAR, 2.0 * tolerance):
            found = control.solve(operator, height, pressure, tolerance, _LOOKS)
            products += found.products
        fall = _QUICK_FALL if step.set_changes <= _QUICK else _FALL
        relative *= fall if fall * relative > failed else _SLOW_FALL
        failed *= _FADE
    least = found.complementarity if found.converged else min(found.complementarity, violated)
    return replace(found, complementarity=least, products=start.products + products)
