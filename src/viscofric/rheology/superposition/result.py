"""The result of a superposition of isotherms, and whether superposition holds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, overload

import numpy as np

from viscofric.arguments import insist_on
from viscofric.data import Isotherm, MasterCurve
from viscofric.rheology.superposition import consistency
from viscofric.rheology.superposition.consistency import SuperpositionCheck
from viscofric.rheology.superposition.quantity import ShiftBy
from viscofric.rheology.superposition.step_result import StepCheck, StepSuperposition, Superposed
from viscofric.showing import Rows
from viscofric.threads import one_blas_thread


@dataclass(frozen=True, eq=False)
class Superposition(Superposed[MasterCurve, Isotherm]):
    """The result of `superpose`.

    Parameters
    ----------
    shift_factors : ShiftFactors
        α at the temperatures that were joined, with standard errors.
    master_curve : MasterCurve
        Tensile, at the reference, free of vertical shift: E(ω, T)/b(T) against α(T) ω.
    quality : OverlapQuality
        How well neighbours overlap: rms of log10 E' and of log10 E''.
    notes : tuple of str
        What the reader noted, and what was converted, left out or not identified here: one sentence each.
    isotherms : tuple of Isotherm
        Those that were joined, tensile and as measured (no vertical shift taken off), in ascending temperature:
        one for each entry of `shift_factors.temperatures`.
    vertical_shift : VerticalShift or None
        b(T), where one was requested.
    cross_covariance : (n, n) array or None
        Of log10 α (rows) with log10 b (columns), where b was fitted.
    offsets : IsothermOffsets or None
        How far whole isotherms are off, found from their overlaps where shifts were fitted.
    unidentified : tuple of (float, float)
        Colder and warmer temperature (K) of the steps of α that the sweeps do not fix.
    shifted_by : {"both", "storage", "loss", "loss-tangent"}
        The quantities that α was found from.
    weights : (float, float) or None
        Of log E' and log E'', with mean 1, where they were given.
    """

    shifted_by: ShiftBy = "both"
    weights: tuple[float, float] | None = None

    def _shown(self) -> Rows:
        return (
            ("isotherms", len(self.isotherms)),
            *super()._shown(),
            ("vertical shift", None if self.vertical_shift is None else type(self.vertical_shift).__name__),
            ("notes", self.notes),
        )

    @property
    def reduced_isotherms(self) -> tuple[Isotherm, ...]:
        """The isotherms as they lie on the master curve: moduli over b(T) at α(T) ω."""
        b = np.ones(len(self.isotherms))
        if self.vertical_shift is not None:
            b = 10.0 ** np.asarray(self.vertical_shift.log10(self.shift_factors.temperatures))
        return tuple(
            replace(
                one,
                angular_frequency=10.0**shift * one.angular_frequency,
                storage_modulus=one.storage_modulus / factor,
                loss_modulus=one.loss_modulus / factor,
            )
            for one, shift, factor in zip(self.isotherms, self.shift_factors.log10_values, b, strict=True)
        )

    def _attributes(self) -> dict[str, Any]:
        quality = self.quality
        return {
            "overlap_rms_log10_storage": quality.storage,
            "overlap_rms_log10_loss": quality.loss,
            **quality.attributes,
            "shifted_by": self.shifted_by,
            **({} if self.weights is None else {"shift_weights": list(self.weights)}),
        }

    @cached_property
    @one_blas_thread
    def check(self) -> SuperpositionCheck:
        """Whether superposition holds, evaluated at first use; see `check_superposition`."""
        return consistency.check(
            self.isotherms, self.shift_factors, self.vertical_shift, self.unidentified, self.quality, self.master_curve
        )


@overload
def check_superposition(fit: Superposition) -> SuperpositionCheck: ...
@overload
def check_superposition(fit: StepSuperposition) -> StepCheck: ...
def check_superposition(fit: Superposition | StepSuperposition) -> SuperpositionCheck | StepCheck:
    """Say whether time–temperature superposition holds, and whether E' and E'' belong to each other.

    Parameters
    ----------
    fit : Superposition or StepSuperposition
        As `superpose` returns it.

    Returns
    -------
    SuperpositionCheck, or StepCheck of step tests

    Notes
    -----
    Isotherms that superpose lie on one curve of tan δ against |E*|, whatever their shifts (H. C. Booij, J. H. M.
    Palmen, Theoretical and Applied Rheology, 1992, 321; M. van Gurp, J. Palmen, Rheol. Bull. 67 (1998) 5).  Each is
    compared with its neighbour, at right angles to that curve, so that plateaus, where it runs steeply, count as
    well; the noise is the scatter of each isotherm about its own smooth curve.  Distances within reproducibility that
    add up over a run of isotherms are no errors of single isotherms: a vertical shift is missing, or superposition
    fails slowly (`Drift`).

    Examples
    --------
    >>> from importlib.resources import files
    >>> import viscofric as vf
    >>> path = files("viscofric") / "example" / "dma.csv"  # synthetic
    >>> sweeps = vf.read_dma(path, deformation="tension")
    >>> fit = vf.superpose(sweeps, reference="30 degC")
    >>> vf.rheology.check_superposition(fit).holds
    True
    """
    insist_on(fit, "fit", Superposition, StepSuperposition, right="what superpose(…) returned")
    return fit.check
