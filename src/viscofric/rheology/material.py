"""A viscoelastic material: its modulus at one temperature, its shift with temperature, and its Poisson ratio."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import flag, insist_on, text
from viscofric.arrays import Array, ComplexArray
from viscofric.datasets import Dataset
from viscofric.errors import InputError
from viscofric.files import SYNTHETIC
from viscofric.notes import Note, Remedy, codes, without
from viscofric.rheology.shifts.laws import VFT, WLF, OneTemperature, ShiftLaw, WLFArrhenius
from viscofric.rheology.shifts.shift_law import NOMINAL, in_kelvin
from viscofric.rheology.shifts.vertical_shift import VerticalShift
from viscofric.rheology.spectra.modulus_table import ModulusTable, modes_of_table, what_was_fitted
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantities, Quantity, checked_poisson_ratio, positive, shown_celsius, to_si_array

#: Code of the note on shift factors that are extrapolated.
EXTRAPOLATED = "extrapolated"
#: WLF is a law of the hundred kelvin above Tg (Williams, Landel & Ferry 1955), and its reference is not below that.
FREE_VOLUME_RANGE = 100.0  # K
_MOST_SHOWN = 10
Spectrum = TypeVar("Spectrum", RetardationSpectrum, ModulusTable)


@dataclass(frozen=True, eq=False)
class Material(Plotted):
    """A linear viscoelastic, incompressible or nearly incompressible rubber.

    E(ω, T) = b(T) E(α(T) ω, reference) (Eq. 4 of [1]_, with a vertical shift); the Poisson ratio is constant.

    Parameters
    ----------
    spectrum : RetardationSpectrum, RelaxationSpectrum or ModulusTable
        At the shift's reference temperature.  A table has no modes: it has a modulus, a compliance and shifts, but no
        creep.  A free contact, which needs modes, fits them to it (`modes_at`).
    shift : ShiftLaw or ShiftFactors, optional
        α(T).  Without it the material is valid at one temperature only, which is not known unless by `OneTemperature`.
    poisson_ratio : float
        0 to 0.5.
    name : str
        Shown in reports.
    vertical_shift : VerticalShift, optional
        b(T), used about the reference of `shift`; b = 1 without it.
    citation : str
        Where the parameters were published or measured.
    synthetic : bool
        Whether it is neither measured nor published; results and material files of it then say so.  True in any case
        where a file that the spectrum was fitted to says so.

    Raises
    ------
    InputError
        If the Poisson ratio is out of range, spectrum or shift are not what they should be, or there is a vertical
        shift without a shift.

    References
    ----------
    .. [1] C. Putignano, T. Reddyhoff, D. Dini, Tribol. Int. 100 (2016) 338–343.

    Examples
    --------
    >>> import viscofric as vf
    >>> spectrum = vf.RetardationSpectrum(E0="1 MPa", E_inf="10 MPa", C=[9e-7], tau=[1e-3])
    >>> rubber = vf.Material(spectrum, shift=vf.WLF(C1=8.0, C2=100.0, reference="30 degC"))
    >>> f"{rubber.shift('60 degC'):.3g}", f"{abs(rubber.complex_modulus(1e5, '60 degC')) / 1e6:.3f} MPa"
    ('0.0143', '1.724 MPa')
    """

    spectrum: RetardationSpectrum | ModulusTable
    shift: ShiftLaw | None = None
    poisson_ratio: float = 0.5
    name: str = ""
    vertical_shift: VerticalShift | None = None
    citation: str = ""
    synthetic: bool = False

    if TYPE_CHECKING:  # what is given, converted when made

        def __init__(
            self,
            spectrum: RetardationSpectrum | RelaxationSpectrum | ModulusTable,
            shift: ShiftLaw | None = None,
            poisson_ratio: Quantity = 0.5,
            name: str = "",
            vertical_shift: VerticalShift | None = None,
            citation: str = "",
            synthetic: bool = False,
        ) -> None: ...

    def __post_init__(self) -> None:
        given: object = self.spectrum
        if isinstance(given, RelaxationSpectrum):
            object.__setattr__(self, "spectrum", given.to_retardation())
        right = "a RetardationSpectrum, a RelaxationSpectrum or a ModulusTable"
        insist_on(self.spectrum, "spectrum", RetardationSpectrum, ModulusTable, right=right)
        insist_on(self.shift, "shift", ShiftLaw, type(None), right="a law, ShiftFactors or None")
        if self.vertical_shift is not None:
            insist_on(
                self.vertical_shift, "vertical_shift", VerticalShift, right="a DensityShift or VerticalShiftFactors"
            )
            if self.shift is None:
                raise InputError(
                    "vertical_shift of a material needs a shift too, which gives its reference.", code="no-shift"
                )
            about = self.vertical_shift.at_reference(self.shift.reference)
            object.__setattr__(self, "vertical_shift", about)
        object.__setattr__(self, "poisson_ratio", checked_poisson_ratio(self.poisson_ratio))
        text(self.name, "name of a material")
        text(self.citation, "citation of a material")
        flag(self.synthetic, "synthetic")
        if SYNTHETIC in codes(getattr(getattr(self.spectrum, "fit", None), "notes", ())):
            object.__setattr__(self, "synthetic", True)

    def _shown(self) -> Rows:
        return (
            ("name", self.name or None),
            ("synthetic", self.synthetic or None),
            ("spectrum", self.spectrum),
            ("Poisson ratio", self.poisson_ratio),
            ("shift", None if self.shift is None else self.shift),
            ("reference", self.reference, "°C"),
            ("vertical shift", None if self.vertical_shift is None else type(self.vertical_shift).__name__),
        )

    @classmethod
    def standard_linear_solid(
        cls, E0: Quantity, E_inf: Quantity, tau: Quantity, poisson_ratio: float = 0.5
    ) -> Material:
        """Return the rubber with one mode, C = 1/E0 − 1/E_inf.

        Parameters
        ----------
        E0, E_inf : float or quantity
            Rubber and glass modulus, E0 below E_inf, Pa.
        tau : float or quantity
            **Retardation** time, s; the relaxation time is tau E0/E_inf.
        poisson_ratio : float
            0 to 0.5.

        Raises
        ------
        InputError
            If a value is not above zero, or E0 is not below E_inf.
        """
        rubber, glass = positive(E0, "Pa", "E0"), positive(E_inf, "Pa", "E_inf")
        if not rubber < glass:
            raise InputError(f"E0 = {rubber:g} Pa must be below E_inf = {glass:g} Pa.", code="modulus-order")
        time = positive(tau, "s", "tau")
        spectrum = RetardationSpectrum(rubber, glass, [1.0 / rubber - 1.0 / glass], [time])
        return cls(spectrum, poisson_ratio=poisson_ratio, name="standard linear solid")

    @property
    def reference(self) -> float | None:
        """Temperature of `spectrum`, K; None without a shift."""
        return None if self.shift is None else float(self.shift.reference)

    @property
    def has_shift_factors(self) -> bool:
        """Whether the material is known at several temperatures."""
        return self.shift is not None and not isinstance(self.shift, OneTemperature)

    def at(self, temperature: Quantity | None = None) -> RetardationSpectrum | ModulusTable:
        """Return the spectrum, or the table, at a temperature.

        Parameters
        ----------
        temperature : float or quantity, optional
            K, or text such as ``"60 degC"``; None means the reference.

        Raises
        ------
        InputError
            If a temperature is given for a material without a shift, or one where a shift has no meaning.
        """
        return self._moved(self.spectrum, temperature)  # type: ignore[type-var]

    def to_dataset(self, temperature: Quantity | None = None) -> Dataset:
        """Return the modes, or the table of moduli, at a temperature as a labelled data set; see `at`."""
        return self.at(temperature).to_dataset()

    def _moved(self, spectrum: Spectrum, temperature: Quantity | None) -> Spectrum:
        if temperature is None:
            return spectrum
        if self.shift is None:
            raise InputError(
                "temperature: this material has no shift, so its temperature cannot be chosen; ",
                code="no-shift",
                remedy=Remedy(
                    "give Material(spectrum, shift=WLF(…)) or ",
                    "give its shift factors (material fit --shift-factors) or ",
                    "give its shift_factors under [material] or ",
                    "",
                )
                + without("temperature"),
                values={"argument": "temperature"},
            )
        kelvin = positive(temperature, "K", "temperature")
        alpha, b = alpha_and_b(self, kelvin)
        return spectrum if alpha == 1.0 and b == 1.0 else spectrum.shifted(alpha, b)

    def at_reference(self, reference: Quantity) -> Material:
        """Return the same material, described about another reference temperature.

        Parameters
        ----------
        reference : float or quantity
            K, or text such as ``"60 degC"``.

        Raises
        ------
        InputError
            As for `at`.
        """
        spectrum = self.at(reference)
        shift = None if self.shift is None else self.shift.at_reference(reference)
        return replace(self, spectrum=spectrum, shift=shift)

    def modes_at(self, temperature: Quantity | None = None) -> RetardationSpectrum:
        """Return the retardation modes at a temperature, for what cannot do without: creep and the free contact.

        Those of a table are fitted to it once, at its reference (`notes_on_modes` says how well).

        Parameters
        ----------
        temperature : float or quantity, optional
            As for `at`.

        Raises
        ------
        InputError
            If the material is a table that no modes describe to 0.05 decades (rms of log10 E' and log10 E''), or for
            the reasons of `at`.
        """
        if isinstance(self.spectrum, RetardationSpectrum):
            return self._moved(self.spectrum, temperature)
        return self._moved(self._modes_of_table, temperature)

    @property
    def notes_on_modes(self) -> tuple[str, ...]:
        """How well `modes_at` describes the material, one sentence each; empty where its modes are its own."""
        return () if isinstance(self.spectrum, RetardationSpectrum) else what_was_fitted(self._modes_of_table)

    @cached_property
    def _modes_of_table(self) -> RetardationSpectrum:
        return modes_of_table(self.spectrum)  # type: ignore[arg-type]

    def complex_modulus(self, angular_frequency: ArrayLike, temperature: Quantity | None = None) -> ComplexArray:
        """Return E(ω, T) = E' + iE'', Pa.

        Parameters
        ----------
        angular_frequency : array_like
            rad/s.
        temperature : float, str or pint.Quantity, optional
            K if a plain number; that of the spectrum or table if left out.

        Returns
        -------
        complex array
            In the shape of `angular_frequency`.

        Raises
        ------
        InputError
            If a frequency is outside a table that is not extrapolated, or the shift is unknown at the temperature.
        """
        return self.at(temperature).complex_modulus(angular_frequency)

    def notes_at(self, temperature: Any = None) -> tuple[Note, ...]:
        """Return notes on contacts at temperatures: what is in doubt of the measurement behind the material.

        Parameters
        ----------
        temperature : float, str, quantity, or an array or list of them, optional
            Plain numbers are in K; left out, it is the reference.

        Returns
        -------
        tuple of Note
            Where the sweeps do not superpose (codes from ``superposition-``), E' and E'' contradict each other
            (``kramers-kronig-fails``) or the spectrum does not follow them (``spectrum-misfit``), and where the shift
            law extrapolates beyond the temperatures that it was fitted to, or more than 100 K above the reference of a
            WLF law for which they are not known (``extrapolated``), unless the material as a whole was assumed.
        """
        fit = getattr(self.spectrum, "fit", None)
        return (*(() if fit is None else fit.doubts), *self._extrapolated(temperature))

    def _extrapolated(self, temperature: Any) -> tuple[Note, ...]:
        if temperature is None or self.shift is None:
            return ()
        every = np.unique(in_kelvin(temperature))
        beyond = every[np.asarray(self.shift.extrapolates(every))]
        said = "At {} the law extrapolates the shift factor beyond the temperatures that it was fitted to."
        if isinstance(self.shift, (WLF, VFT, WLFArrhenius)) and self.shift.fitted_range is None:
            if self.synthetic and getattr(self.spectrum, "fit", None) is None:  # assumed, and so exact
                return ()
            beyond = every[every > self.shift.reference + FREE_VOLUME_RANGE]
            said = (
                f"At {{}}, more than {FREE_VOLUME_RANGE:g} K above its reference, the {self.shift.title} law may not "
                "hold; the temperatures that it was fitted to are not known."
            )
        if not beyond.size:
            return ()
        at = ", ".join(shown_celsius(float(one), "z.4g") for one in beyond[:_MOST_SHOWN]) + " °C"
        at += f" and {beyond.size - _MOST_SHOWN} more temperatures" if beyond.size > _MOST_SHOWN else ""
        return (Note(EXTRAPOLATED, said.format(at), values={"lowest": float(beyond[0]), "highest": float(beyond[-1])}),)


#: Temperature of a material without shift factors where none is given.
_ROOM = 293.15  # K


def known_at(material: Material, temperatures: Quantities | None) -> tuple[Material, Array, tuple[Note, ...]]:
    """Return a material for contacts at temperatures, these in K, (n,), and what is assumed of it.

    Left out, there is one temperature, that of the material.  Where that is not known, it is taken to be the one that
    is given, or 20 °C; several are refused.
    """
    given = material.reference if temperatures is None else temperatures
    kelvins = to_si_array(_ROOM if given is None else given, "K", "temperatures")
    if material.shift is not None or not kelvins.size:
        return material, kelvins, ()
    if np.ptp(kelvins) > NOMINAL:
        raise InputError(
            "the material has no shift factors, so that its modulus is known at one temperature only; ",
            code="no-shift",
            remedy=Remedy(
                "give one of the temperatures.",
                "give one --temperature.",
                "give one temperature under [conditions].",
                "give one temperature.",
                field="conditions.temperature",
            ),
        )
    known = float(kelvins[0])
    said = f"The material has no shift factors: its modulus is taken to be that at {shown_celsius(known)} °C."
    assumed = Note("temperature-assumed", said, values={"temperature": known})
    return replace(material, shift=OneTemperature(known)), kelvins, (assumed,)


def alpha_and_b(material: Material, kelvin: float) -> tuple[float, float]:
    """Return α and b of a material at a temperature, 1 where it has none."""
    alpha = 1.0 if material.shift is None else float(material.shift(kelvin))
    return alpha, 1.0 if material.vertical_shift is None else float(material.vertical_shift(kelvin))


def unknown_frequencies(material: Material) -> tuple[Note, ...]:
    """Return a note on a spectrum whose measured frequencies are unknown; a table of moduli has its own."""
    if not isinstance(material.spectrum, RetardationSpectrum) or material.spectrum.fit is not None:
        return ()
    several = material.spectrum.known_frequencies is not None
    taken = "those between its modes are taken for measured." if several else "extrapolation cannot be checked."
    said = f"The frequencies at which the material was measured are unknown: {taken}"
    return (Note("frequencies-unknown", said),)


def insist_on_material(given: object) -> None:
    """Raise `InputError` unless a Material is given."""
    insist_on(given, "material", Material, right="a Material, such as vf.read_card('rubber.json')")
