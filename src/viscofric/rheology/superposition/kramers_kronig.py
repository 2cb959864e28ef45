"""Whether E' and E'' of one master curve are consistent, as causality requires (Kramers and Kronig)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array, Mask, non_negative_fit
from viscofric.data import MasterCurve
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.showing import with_error

#: Bins per decade in which points are averaged: the relations need no more, and noise averages out.
BINS = 8
#: Modes per decade, and decades that they extend beyond the measured frequencies.
MODES = 3
BEYOND = 1.0
#: Frequencies nearer than this to an end are not judged: they depend on moduli beyond it.
EDGE = 0.5  # decades
#: Largest rms difference of log10 E' from what E'' requires.  Planted rubbers with 0.3, 1 and 3 % noise have
#: 0.001, 0.003 and 0.009; an acrylic and an NBR/PVC foam that superpose 0.018 and 0.03; an EVA that does not 0.1;
#: a glass transition whose E'' is multiplied by 1.3 has 0.06 to 0.11, one with E' and E'' swapped more than 0.6.
LARGEST_RMS = 0.05
#: Largest factor of E'', as a whole, over the E'' that E' requires; found to 3 % on the same materials.
LARGEST_SCALE = 1.15
#: … and by this many of its standard errors.
SURE = 3.0
#: Residuals of neighbouring bins are correlated, so that a decade of them counts as one independent value.
INDEPENDENT = 1.0 / BINS
#: From here on no factor describes the disagreement.
SWAPPED = 0.2  # decades rms


@dataclass(frozen=True, eq=False)
class KramersKronig:
    """Agreement of E' with E'' on a master curve.

    Notes
    -----
    Non-negative relaxation modes are fitted to E'' alone, and give E'; and the other way round.  That is the pair
    of relations E'(ω) − E'(0) = (2ω²/π) ∫ E''(u)/u / (ω² − u²) du and its inverse (R. de L. Kronig, J. Opt. Soc.
    Am. 12 (1926) 547), with the integrals continued beyond the measurement by the modes at its ends.
    """

    angular_frequency: Array  # (n,), reduced, of the bins that the master curve was averaged in, rad/s
    # (n,), log10 of E' that E'' alone requires (up to a constant, the relaxed modulus) over the measured one.
    storage_deviation: Array
    loss_deviation: Array  # (n,), log10 of E'' that E' alone requires over the measured one
    judged: Mask  # (n,), frequencies at least half a decade from the ends, over which the rms are taken
    rms_storage: float  # root mean square of the first two deviations, decades
    rms_loss: float
    # Factor by which the measured E'' as a whole exceeds what the rise of E' requires; 1 if they agree.
    loss_scale: float
    loss_scale_error: float  # its standard error

    def __repr__(self) -> str:
        return f"KramersKronig(loss scale {with_error(self.loss_scale, self.loss_scale_error)})"

    def to_dataset(self) -> Dataset:
        """Return the deviations as a labelled data set along ``angular_frequency`` (reduced, rad/s)."""
        return dataset(
            "angular_frequency",
            {
                "storage_deviation": (self.storage_deviation, "1", "log10 of E' from E'' alone over the measured E'"),
                "loss_deviation": (self.loss_deviation, "1", "log10 of E'' from E' alone over the measured E''"),
                "judged": (self.judged.astype(np.int8), "1", "whether the point is at least half a decade inside (1)"),
            },
            coordinates={"angular_frequency": (self.angular_frequency, "rad/s", "reduced angular frequency")},
            attributes={
                "holds": int(self.holds),
                "rms_log10_storage": self.rms_storage,
                "rms_log10_loss": self.rms_loss,
                "loss_scale": self.loss_scale,
                "loss_scale_error": self.loss_scale_error,
                "sentence": self.sentence,
            },
        )

    @property
    def scale_differs(self) -> bool:
        """Whether E'' is off as a whole, by more than 15 % and three standard errors."""
        off = abs(float(np.log(self.loss_scale)))
        return off > float(np.log(LARGEST_SCALE)) and off > SURE * self.loss_scale_error / self.loss_scale

    @property
    def holds(self) -> bool:
        """Whether E' and E'' agree within 0.05 decades rms and, as a whole, within 15 %."""
        return self.rms_storage <= LARGEST_RMS and not self.scale_differs

    @property
    def sentence(self) -> str:
        """The verdict in a plain sentence."""
        verdict = f"E' and E'' are {'consistent' if self.holds else 'inconsistent'} (Kramers–Kronig)"
        rms = f"{self.rms_storage:.2g} decades rms"
        if self.holds:
            return f"{verdict}: E' calculated from E'' agrees with E' within {rms} (good if ≤ {LARGEST_RMS:g})."
        if self.scale_differs and self.rms_storage < SWAPPED:
            scale = with_error(self.loss_scale, self.loss_scale_error)
            return (
                f"{verdict}: E'' is {scale} times what the rise of E' requires; look for a wrong loss modulus, for "
                "a vertical shift that was left out, or for wrong shift factors."
            )
        return (
            f"{verdict}: E' calculated from E'' differs from E' by {rms} (good if ≤ {LARGEST_RMS:g}); look for "
            "swapped columns, wrong moduli, or shifts that do not make one master curve."
        )


def kramers_kronig(master_curve: MasterCurve) -> KramersKronig:
    """Test E' against E'' on a master curve; see `KramersKronig`."""
    omega, storage, loss, count = _binned(master_curve)
    span = float(np.log10(omega[-1] / omega[0])) if len(omega) else 0.0
    if span < 3.0 * EDGE:
        raise InputError(
            f"a master curve over {span:.2g} decades is too short to test E' against E''; give {3 * EDGE:g} or more.",
            code="too-short",
        )
    weight = np.sqrt(count)
    tau = 10.0 ** np.arange(-np.log10(omega[-1]) - BEYOND, -np.log10(omega[0]) + BEYOND, 1.0 / MODES)
    product = np.outer(omega, tau)
    viscous = product / (1.0 + product**2)
    elastic = product * viscous
    judged = (omega >= omega[0] * 10.0**EDGE) & (omega <= omega[-1] / 10.0**EDGE)

    modes = _non_negative(viscous, loss, weight)
    fast, slow = tau < 1.0 / omega[-1], tau > 1.0 / omega[0]
    # Slow modes add a constant, which E'' does not tell: it is a part of the plateau.
    rise = elastic @ modes - modes[slow].sum()
    constant = np.ones((len(omega), 1))
    plateau = float(_non_negative(constant, storage, weight, storage - rise)[0])
    storage_deviation = np.log10(np.maximum((plateau + rise) / storage, _FLOOR))
    unseen = elastic[:, fast] @ modes[fast] + (1.0 - elastic[:, slow]) @ modes[slow]

    back = _non_negative(np.concatenate([constant, elastic], axis=1), storage, weight)
    loss_deviation = np.log10(np.maximum(viscous @ back[1:], _FLOOR * loss) / loss)
    scale, scale_error = _scale(rise, storage, weight)
    misfit = _rms(viscous @ modes / loss - 1.0) / np.sqrt(len(omega) * INDEPENDENT)
    beyond = float(np.mean((unseen / (plateau + rise))[judged]))
    scale_error = scale * float(np.sqrt(scale_error**2 + misfit**2 + beyond**2))
    return KramersKronig(
        omega,
        storage_deviation,
        loss_deviation,
        judged,
        _rms(storage_deviation[judged]),
        _rms(loss_deviation[judged]),
        scale,
        scale_error,
    )


_FLOOR = 1e-6


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _binned(master_curve: MasterCurve) -> tuple[Array, Array, Array, Array]:
    """Average the logarithms of frequency and moduli in bins; return them and the number of points in each."""
    decades = np.log10(master_curve.angular_frequency)
    place = np.floor((decades - decades[0]) * BINS).astype(int)
    _, place = np.unique(place, return_inverse=True)
    count = np.bincount(place)
    columns = (master_curve.angular_frequency, master_curve.storage_modulus, master_curve.loss_modulus)
    omega, storage, loss = (10.0 ** (np.bincount(place, np.log10(column)) / count) for column in columns)
    return omega, storage, loss, count.astype(float)


def _non_negative(basis: Array, size: Array, weight: Array, target: Array | None = None) -> Array:
    """Minimise Σ weight² ((basis g − target)/size)² over g ≥ 0; the target is `size` unless given."""
    rows = weight / size
    aim = weight if target is None else rows * target
    return non_negative_fit(basis * rows[:, None], aim)


def _scale(rise: Array, storage: Array, weight: Array) -> tuple[float, float]:
    """Return the factor by which the rise that E'' requires exceeds that of E', and its relative standard error."""
    # E' = E0 + rise/factor by least squares of relative errors, E0 not below zero.
    rows = weight / storage
    matrix = np.stack([rows, rows * rise], axis=1)
    size = np.linalg.norm(matrix, axis=0)
    (plateau, inverse), *_ = np.linalg.lstsq(matrix / size, weight, rcond=None)
    if plateau < 0.0:
        plateau, inverse = 0.0, matrix[:, 1] @ weight / size[1]
    residual = weight - matrix @ np.array([plateau, inverse] / size)
    freedom = max(len(storage) * INDEPENDENT - 2.0, 1.0)
    normal = (matrix / size).T @ (matrix / size)
    error = float(np.sqrt(residual @ residual / freedom * np.linalg.pinv(normal)[1, 1]))
    inverse = max(float(inverse), 1e-6)
    return float(size[1]) / inverse, error / inverse
