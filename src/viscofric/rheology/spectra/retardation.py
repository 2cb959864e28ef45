"""The two spectra of a material at one temperature: retardation (creep), and relaxation, a Prony series."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import insist_on
from viscofric.arrays import Array, ComplexArray
from viscofric.data import MasterCurve
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, wrong_argument
from viscofric.rheology.spectra.interconversion import largest_position, reciprocal_modes
from viscofric.rheology.spectra.quality import FrequenciesOfModes, KnownFrequencies, SpectrumFit
from viscofric.rheology.spectra.response import FrequencyResponse, checked_shift, checked_times
from viscofric.showing import Items, Rows, rows_of
from viscofric.step_tests import StepMasterCurve, step_columns
from viscofric.units import Quantity, checked_modes, in_si, positive, to_si

#: Modes of a measured rubber, rather than of a model of one process.
_SEVERAL = 2

#: Largest difference of 1/E_inf + ΣC from 1/E0, relative to 1/E0.
BALANCE = 1e-6


class ModeSpectrum(FrequencyResponse, Items[tuple[float, float]]):
    """What retardation and relaxation spectra have in common: modes with their times, and step responses."""

    tau: Array

    def _set_modes(self, name: str, strengths: ArrayLike, unit: str, tau: ArrayLike) -> None:
        """Set the strengths, called `name`, and the times of the modes."""
        values, times = checked_modes(strengths, name, unit, tau)
        object.__setattr__(self, name, values)
        object.__setattr__(self, "tau", times)

    @abstractmethod
    def _creep(self, seconds: Array) -> Array: ...

    @abstractmethod
    def _relaxation(self, seconds: Array) -> Array: ...

    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return J(t) after a step of stress, 1/Pa; not for a liquid.

        Parameters
        ----------
        time : array_like
            s, not below zero.

        Returns
        -------
        array
            In the shape of `time`.

        Raises
        ------
        InputError
            If a time is below zero, or E0 is zero.
        """
        return self._creep(checked_times(time, "creep compliance"))

    def relaxation_modulus(self, time: ArrayLike) -> Array:
        """Return E(t) after a step of strain, Pa.

        Parameters
        ----------
        time : array_like
            s, not below zero.

        Returns
        -------
        array
            In the shape of `time`.

        Raises
        ------
        InputError
            If a time is below zero.
        """
        return self._relaxation(checked_times(time, "relaxation modulus"))


@dataclass(frozen=True, eq=False)
class RetardationSpectrum(ModeSpectrum):
    """Retardation modes of a rubber at one temperature.

    Creep compliance and complex compliance are (Eqs. 5 and 3 of [1]_; convention e^{+iωt})::

        J(t) = 1/E0 − Σ C_k exp(−t/τ_k)
        S(ω) = 1/E(ω) = 1/E_inf + Σ C_k / (1 + iωτ_k),    1/E_inf = 1/E0 − Σ C_k

    Parameters
    ----------
    E0 : float or quantity
        Rubber modulus E(0), above zero, Pa.
    E_inf : float or quantity
        Glass modulus E(∞), Pa.
    C : (n,) array
        Compliance of each mode, not below zero, 1/Pa.
    tau : (n,) array
        Retardation times, above zero, s.
    fit : SpectrumFit, optional
        How it was found, where it was fitted.

    Raises
    ------
    InputError
        If a value is out of range, the arrays differ in length, E0 is zero (a liquid has no rubber
        plateau), or 1/E_inf + ΣC differs from 1/E0 by more than a millionth.

    References
    ----------
    .. [1] C. Putignano, T. Reddyhoff, D. Dini, Tribol. Int. 100 (2016) 338–343.

    Examples
    --------
    >>> import viscofric as vf
    >>> creep = vf.RetardationSpectrum(E0="1 MPa", E_inf="10 MPa", C=[9e-7], tau=[1e-3])
    >>> f"{creep.to_relaxation().tau[0]:.4g} s", f"{creep.creep_compliance(1e9) * 1e6:.3g} 1/MPa"
    ('0.0001 s', '1 1/MPa')
    """

    E0: float
    E_inf: float
    C: Array
    tau: Array
    fit: SpectrumFit | None = field(default=None, repr=False)

    def __init__(
        self, E0: Quantity, E_inf: Quantity, C: ArrayLike, tau: ArrayLike, fit: SpectrumFit | None = None
    ) -> None:
        if to_si(E0, "Pa", "E0") == 0.0:
            raise InputError("E0 = 0: a liquid has no rubber plateau; a spectrum needs E0 above zero.", code="liquid")
        object.__setattr__(self, "E0", positive(E0, "Pa", "E0"))
        object.__setattr__(self, "E_inf", positive(E_inf, "Pa", "E_inf"))
        insist_on(fit, "fit", SpectrumFit, type(None), right="a SpectrumFit or None")
        object.__setattr__(self, "fit", fit)
        self._set_modes("C", C, "1/Pa", tau)
        glass = 1.0 / self.E0 - float(np.sum(self.C))
        if abs(glass - 1.0 / self.E_inf) > BALANCE / self.E0:
            raise InputError(
                f"the modes do not join E0 to E_inf: 1/E0 − ΣC = {glass:.6g} 1/Pa, but 1/E_inf = "
                f"{1.0 / self.E_inf:.6g} 1/Pa; give C with ΣC = 1/E0 − 1/E_inf.",
                code="modes-contradict",
            )

    def _items(self) -> Sequence[tuple[float, float]]:
        return rows_of(self.C, self.tau)

    def _shown(self) -> Rows:
        return (
            ("E0", self.E0, "Pa"),
            ("E_inf", self.E_inf, "Pa"),
            ("modes", len(self)),
            ("τ", self.tau, "s"),
            ("E0 extrapolated", None if self.fit is None else self.fit.E0_extrapolated),
            ("E_inf extrapolated", None if self.fit is None else self.fit.E_inf_extrapolated),
        )

    def compliance(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return S(ω) = 1/E(ω), 1/Pa, in the shape of `angular_frequency` (rad/s, any sign)."""
        omega = in_si(angular_frequency, "rad/s", "angular_frequency")
        # Mode by mode: a grid of a million frequencies does not fit into memory forty times.
        total = np.full(omega.shape, 1.0 / self.E_inf, dtype=complex)
        for compliance, time in zip(self.C, self.tau, strict=True):
            total += compliance / (1.0 + 1j * omega * time)
        return total

    def complex_modulus(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return E(ω) = E' + iE'', Pa, in the shape of `angular_frequency` (rad/s)."""
        return np.asarray(1.0 / self.compliance(angular_frequency))

    def _creep(self, seconds: Array) -> Array:
        total = np.full(seconds.shape, 1.0 / self.E_inf)
        for compliance, retardation in zip(self.C, self.tau, strict=True):
            total -= compliance * np.expm1(-seconds / retardation)
        return total

    def _relaxation(self, seconds: Array) -> Array:
        return self.to_relaxation()._relaxation(seconds)

    def to_relaxation(self) -> RelaxationSpectrum:
        """Return the same material as a Prony series, exactly; see `viscofric.rheology.spectra.interconversion`.

        Modes without compliance are left out and those of one time joined.  E0 becomes 1/(1/E_inf + ΣC), so that
        E(ω) stays what it is where the given E0 and ΣC agree only roughly.
        """
        E, rates = reciprocal_modes(1.0 / self.E_inf, self.C, 1.0 / self.tau)
        rubber = 1.0 / (1.0 / self.E_inf + float(np.sum(self.C)))
        return RelaxationSpectrum(rubber, E[::-1], 1.0 / rates[::-1])

    def to_dataset(self) -> Dataset:
        """Return the modes as a labelled data set; `modulus_dataset` returns the moduli over frequency.

        ``retardation_time`` (s) and ``creep_coefficient`` (1/Pa) along ``mode``.  Attributes: ``E0`` and ``E_inf``
        (Pa), and remarks on them where the spectrum was fitted.
        """
        return dataset(
            "mode",
            {
                "retardation_time": (self.tau, "s", "retardation time"),
                "creep_coefficient": (self.C, "1/Pa", "compliance C of the mode"),
            },
            attributes={"E0": self.E0, "E_inf": self.E_inf} | ({} if self.fit is None else self.fit.attributes),
        )

    def master_curve_dataset(self, master_curve: MasterCurve) -> Dataset:
        """Return a master curve with this spectrum at the same points as a labelled data set.

        Parameters
        ----------
        master_curve : MasterCurve
            At the temperature of the spectrum.

        Returns
        -------
        xarray.Dataset
            As `MasterCurve.to_dataset`, with ``fitted_storage_modulus`` and ``fitted_loss_modulus`` (Pa).  Attributes
            where the spectrum was fitted: ``rms_log10_storage``, ``rms_log10_loss`` and ``misfit_limit``, the largest
            that is good (decades), and ``misfit_holds`` (0 or 1).
        """
        insist_on(master_curve, "master_curve", MasterCurve)
        fitted, of_fit = self.complex_modulus(master_curve.angular_frequency), "modulus of the fitted spectrum"
        columns = dataset(
            "reading",
            {
                "fitted_storage_modulus": (fitted.real, "Pa", f"storage {of_fit}"),
                "fitted_loss_modulus": (fitted.imag, "Pa", f"loss {of_fit}"),
            },
            attributes={} if self.fit is None else self.fit.modulus_misfit,
        )
        return master_curve.to_dataset().assign(columns.data_vars).assign_attrs(columns.attrs)

    def step_curve_dataset(self, curve: StepMasterCurve) -> Dataset:
        """Return a creep or relaxation master curve with this spectrum at the same points as a labelled data set.

        Parameters
        ----------
        curve : StepMasterCurve
            At the temperature of the spectrum.

        Returns
        -------
        xarray.Dataset
            As `StepMasterCurve.to_dataset`, with ``fitted_creep_compliance`` (1/Pa) or ``fitted_relaxation_modulus``
            (Pa).  Attributes where the spectrum was fitted: ``rms_log10_step`` and ``misfit_limit``, the largest that
            is good (decades), and ``misfit_holds`` (0 or 1).
        """
        insist_on(curve, "curve", StepMasterCurve)
        fitted = self.creep_compliance(curve.time) if curve.kind == "creep" else self.relaxation_modulus(curve.time)
        columns = dataset(
            "reading",
            step_columns(curve.kind, curve.temperature, curve.time, fitted, fitted=True),
            attributes={} if self.fit is None else self.fit.step_misfit,
        )
        return curve.to_dataset().assign(columns.data_vars).assign_attrs(columns.attrs)

    @property
    def known_frequencies(self) -> KnownFrequencies | None:
        """Frequencies at which the spectrum is known: of its measurement, or of several modes; else None."""
        C, rates = self.C[self.C > 0.0], 1.0 / self.tau[self.C > 0.0]
        if self.fit is not None or len(rates) < _SEVERAL:
            return self.fit
        return FrequenciesOfModes((float(rates.min()), largest_position(1.0 / self.E_inf, C, rates)))

    def noted(self, *notes: str) -> RetardationSpectrum:
        """Return the spectrum with notes before those of its fit, if it has one."""
        return self if self.fit is None else replace(self, fit=replace(self.fit, notes=(*notes, *self.fit.notes)))

    def shifted(self, alpha: float, b: float = 1.0) -> RetardationSpectrum:
        """Return the spectrum at a temperature with shift factor α (and vertical shift b).

        From E(ω, T) = b E(αω, T0): every τ becomes ατ, every modulus b times what it was.
        """
        alpha, b = checked_shift(alpha, b)
        return RetardationSpectrum(
            b * self.E0,
            b * self.E_inf,
            self.C / b,
            alpha * self.tau,
            None if self.fit is None else self.fit.shifted(alpha, b),
        )


@dataclass(frozen=True, eq=False)
class RelaxationSpectrum(ModeSpectrum):
    """Relaxation modes of a rubber, or of a liquid, at one temperature.

    Relaxation modulus and complex modulus of the generalised Maxwell model are (convention e^{+iωt})::

        E(t) = E0 + Σ E_k exp(−t/τ_k)
        E(ω) = E0 + Σ E_k iωτ_k / (1 + iωτ_k),    E_inf = E0 + Σ E_k

    Parameters
    ----------
    E0 : float or quantity
        Rubber modulus E(t → ∞), Pa; zero for a liquid, which has no creep compliance here and cannot become a
        `RetardationSpectrum` or a `Material`.
    E : (n,) array
        Modulus of each mode, not below zero, Pa.
    tau : (n,) array
        **Relaxation** times, above zero, s.

    Raises
    ------
    InputError
        If a value is out of range, the arrays differ in length, or all moduli are zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> prony = vf.RelaxationSpectrum(E0="1 MPa", E=[9e6], tau=[1e-4])
    >>> creep = prony.to_retardation()
    >>> f"{creep.tau[0]:.4g} s"  # the retardation time is longer by E_inf/E0
    '0.001 s'
    """

    E0: float
    E: Array
    tau: Array

    def __init__(self, E0: Quantity, E: ArrayLike, tau: ArrayLike) -> None:
        rubber = to_si(E0, "Pa", "E0")
        if rubber < 0.0:
            raise wrong_argument("E0", E0, "must not be below zero; write, for example, '3 MPa'.", "not-positive")
        object.__setattr__(self, "E0", rubber)
        self._set_modes("E", E, "Pa", tau)
        if not self.E_inf > 0.0:
            raise InputError("E0 and all E are zero: there is no modulus at all.", code="no-modulus")

    def _items(self) -> Sequence[tuple[float, float]]:
        return rows_of(self.E, self.tau)

    def _shown(self) -> Rows:
        return (("E0", self.E0, "Pa"), ("E_inf", self.E_inf, "Pa"), ("modes", len(self)), ("τ", self.tau, "s"))

    @property
    def E_inf(self) -> float:
        """Glass modulus E0 + ΣE, Pa."""
        return self.E0 + float(np.sum(self.E))

    def complex_modulus(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return E(ω) = E' + iE'', Pa, in the shape of `angular_frequency` (rad/s, any sign)."""
        omega = in_si(angular_frequency, "rad/s", "angular_frequency")
        total = np.full(omega.shape, self.E0, dtype=complex)
        for modulus, time in zip(self.E, self.tau, strict=True):
            total += modulus * (1j * omega * time) / (1.0 + 1j * omega * time)
        return total

    def compliance(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return S(ω) = 1/E(ω), 1/Pa, in the shape of `angular_frequency` (rad/s, any sign).

        Raises
        ------
        InputError
            If the compliance of a liquid at ω = 0 is requested, which has no bound.
        """
        modulus = self.complex_modulus(angular_frequency)
        if np.any(modulus == 0.0):
            raise InputError("compliance at frequency 0: E0 = 0, a liquid flows without bound at rest.", code="liquid")
        return np.asarray(1.0 / modulus)

    def _relaxation(self, seconds: Array) -> Array:
        total = np.full(seconds.shape, self.E0)
        for modulus, relaxation in zip(self.E, self.tau, strict=True):
            total += modulus * np.exp(-seconds / relaxation)
        return total

    def _creep(self, seconds: Array) -> Array:
        return self.to_retardation()._creep(seconds)

    def to_retardation(self) -> RetardationSpectrum:
        """Return the same material as retardation modes, exactly; see `viscofric.rheology.spectra.interconversion`.

        Modes without modulus are left out and those of one time joined.

        Raises
        ------
        InputError
            If E0 is zero: the creep of a liquid has no end.
        """
        if self.E0 == 0.0:
            raise InputError(
                "E0 = 0: a liquid has no rubber plateau and creeps without end, so that it has no retardation "
                "spectrum; give E0 above zero.",
                code="liquid",
            )
        C, tau = reciprocal_modes(self.E0, self.E, self.tau)
        return RetardationSpectrum(self.E0, self.E_inf, C, tau)

    def to_dataset(self) -> Dataset:
        """Return the modes as a labelled data set; `modulus_dataset` returns the moduli over frequency.

        ``relaxation_time`` (s) and ``modulus`` (Pa) along ``mode``.  Attributes: ``E0`` and ``E_inf`` (Pa).
        """
        return dataset(
            "mode",
            {"relaxation_time": (self.tau, "s", "relaxation time"), "modulus": (self.E, "Pa", "modulus of the mode")},
            attributes={"E0": self.E0, "E_inf": self.E_inf},
        )

    def shifted(self, alpha: float, b: float = 1.0) -> RelaxationSpectrum:
        """Return the spectrum at a temperature with shift factor α (and vertical shift b).

        From E(ω, T) = b E(αω, T0): every τ becomes ατ, every modulus b times what it was.
        """
        alpha, b = checked_shift(alpha, b)
        return RelaxationSpectrum(b * self.E0, b * self.E, alpha * self.tau)
