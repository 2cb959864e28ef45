"""Derivatives of the friction coefficient by material, speed and load, in SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.derivatives.adjoint import Gradient, differentiated
from viscofric.contact.derivatives.moving_cells import Motion, friction_gradient
from viscofric.contact.free.estimates import Way
from viscofric.contact.free.scale import Scale
from viscofric.contact.free.stage import Stage
from viscofric.datasets import Dataset, dataset
from viscofric.showing import Plotted, Rows

if TYPE_CHECKING:
    from viscofric.rheology.spectra.retardation import RetardationSpectrum


# Error as parts of the changes from grid to grid, and of the change by moving cells: with these, all of 111 random
# contacts had derivatives within their error; with the changes alone, 91 %.
_CHANGE_TRUST, _MOTION_SHARE = 1.5, 0.2


@dataclass(frozen=True, eq=False)
class LogarithmicDerivatives:
    """Derivatives of the friction coefficient with respect to logarithms, such as F ∂μ/∂F; pure numbers.

    Attributes
    ----------
    C, tau : (n,) array
        C_k ∂μ/∂C_k and τ_k ∂μ/∂τ_k.
    E_inf, speed : float
        E_inf ∂μ/∂E_inf and v ∂μ/∂v, the latter the sum of `tau`: times and speed have one effect.
    load, indentation : float or None
        F ∂μ/∂F or δ ∂μ/∂δ, whichever is given.
    """

    C: Array
    E_inf: float
    tau: Array
    speed: float
    load: float | None
    indentation: float | None


@dataclass(frozen=True, eq=False)
class FrictionDerivatives(Plotted):
    """Derivatives of the friction coefficient, each with all else held, at the material's modes at that temperature.

    Attributes
    ----------
    C : (n,) array
        ∂μ/∂C_k at fixed E_inf, so that E0 falls as C_k grows; Pa.
    E_inf : float
        ∂μ/∂E_inf at fixed C, so that E0 rises with it; 1/Pa.
    tau : (n,) array
        ∂μ/∂τ_k, 1/s.
    speed : float
        ∂μ/∂v, s/m.
    load : float or None
        ∂μ/∂F, 1/N or m/N; None where the indentation is given.
    indentation : float or None
        ∂μ/∂δ, 1/m; None where the load is given.
    logarithmic : LogarithmicDerivatives
        The same with respect to the logarithms.
    way : {"pressure", "balance"}
        Which friction coefficient was differentiated: that from the asymmetry of the pressure, or that from the
        dissipated energy, with the part that the cells at the edge leave out.
    error : float
        Error estimate of the logarithmic derivatives, from the largest of their changes on the last three grids and
        from what moving the cells takes away.

    Notes
    -----
    They are those of the solution on its cells, which move with the contact (see
    `viscofric.contact.derivatives.moving_cells`).
    Against the closed form of the line contact, at E∞/E0 from 1.3 to 1000 and v τ/a0 from 1e-4 to 1000, they are right
    to 3e-4 of the largest of them (median; nine in ten to 3e-3, all to 2e-2) at accuracy 1e-3, and to 2e-4 (nine in ten
    to 1e-3) at accuracy 1e-4.
    """

    C: Array
    E_inf: float
    tau: Array
    speed: float
    load: float | None
    indentation: float | None
    logarithmic: LogarithmicDerivatives
    way: Way
    error: float

    def _shown(self) -> Rows:
        return (
            ("by ln v", self.logarithmic.speed, "", self.error),
            ("by ln F", self.logarithmic.load, "", self.error),
            ("by ln δ", self.logarithmic.indentation, "", self.error),
            ("by ln E_inf", self.logarithmic.E_inf, "", self.error),
            ("by ln C", self.logarithmic.C),
            ("by ln τ", self.logarithmic.tau),
        )

    def to_dataset(self) -> Dataset:
        """Return the derivatives along ``mode`` and as single numbers, those by logarithms as ``log_…``.

        That by the load is given by its logarithm only, since its unit is that of the contact (1/N or m/N).
        """
        held = "load" if self.indentation is None else "indentation"
        units = {"C": "Pa", "tau": "1/s", "E_inf": "1/Pa", "speed": "s/m", "indentation": "1/m"}
        plain = {name: (getattr(self, name), unit, f"∂μ/∂{name}") for name, unit in units.items()}
        logarithmic = {
            f"log_{name}": (getattr(self.logarithmic, name), "1", f"∂μ/∂ln {name}")
            for name in ("C", "tau", "E_inf", "speed", held)
        }
        if self.indentation is None:
            del plain["indentation"]
        return dataset("mode", plain | logarithmic, attributes={"way": self.way, "error": self.error})


def differentiate(
    stages: list[Stage],
    scale: Scale,
    spectrum: RetardationSpectrum,
    plane_strain: float,
    velocity: float,
    *,
    with_error: bool = True,
) -> FrictionDerivatives:
    """Differentiate the friction coefficient of a converged contact, by an adjoint solve on each of the last grids.

    `stages`, at least three, coarsest first, were solved with `spectrum`; `plane_strain` is 1 − ν²; `velocity`, m/s, is
    neither zero nor infinite.  Without `with_error`, the error is infinite, and one adjoint solve on the last grid
    suffices.  Raises ConvergenceError if an adjoint problem is not solved.
    """
    way, last_grids = differentiated(stages), stages[-3:]
    motion = Motion.of(last_grids[0])
    grids = last_grids if with_error else last_grids[-1:]
    found = [
        [
            _in_si(one, stage, way, scale, spectrum, plane_strain, velocity)
            for one in friction_gradient(stage, way, motion)
        ]
        for stage in grids
    ]
    if not with_error:
        return found[0][0]
    moved, still = np.swapaxes([[_numbers(one.logarithmic) for one in pair] for pair in found], 0, 1)
    # Single ones may be small by chance; from grid to grid they halve.
    fading = 0.5 ** np.arange(len(grids) - 1.0, -1.0, -1.0)
    change = float((np.abs(np.diff(moved, axis=0)).max(axis=1) * fading[1:]).max())
    taken_away = float((np.abs(moved - still).max(axis=1) * fading).max())
    error = _CHANGE_TRUST * scale.geometry.scatter * change + _MOTION_SHARE * taken_away
    return replace(found[-1][0], error=error)


def _in_si(
    gradient: Gradient,
    stage: Stage,
    way: Way,
    scale: Scale,
    spectrum: RetardationSpectrum,
    plane_strain: float,
    velocity: float,
) -> FrictionDerivatives:
    # The units, and with them the cells, are fixed: the chain rule has only constant factors.
    slope = math.copysign(scale.slope, velocity)
    compliance = slope * plane_strain * scale.stiffness
    C = compliance * gradient.compliances
    E_inf = -compliance * gradient.glassy / spectrum.E_inf**2
    tau = (slope * abs(velocity) / scale.length) * gradient.memory_lengths
    log_tau = spectrum.tau * tau
    log_speed = float(log_tau.sum())
    loaded = stage.problem.control.load is not None
    unit, value = (scale.force, stage.load) if loaded else (scale.depth, stage.indentation)
    held, log_held = slope * gradient.held / unit, slope * gradient.held * value
    return FrictionDerivatives(
        C=C,
        E_inf=E_inf,
        tau=tau,
        speed=log_speed / velocity,
        load=held if loaded else None,
        indentation=None if loaded else held,
        logarithmic=LogarithmicDerivatives(
            C=spectrum.C * C,
            E_inf=spectrum.E_inf * E_inf,
            tau=log_tau,
            speed=log_speed,
            load=log_held if loaded else None,
            indentation=None if loaded else log_held,
        ),
        way=way,
        error=math.inf,
    )


def _numbers(derivatives: LogarithmicDerivatives) -> Array:
    held = derivatives.load if derivatives.indentation is None else derivatives.indentation
    return np.concatenate([derivatives.C, derivatives.tau, [derivatives.E_inf, held or 0.0]])
