"""The steady viscoelastic solid as a linear operator: pressure to displacement by FFT, zero-padded.

Its influence is even across the motion.  Under an indenter that is even too, so are the pressures, and half of the
cells are enough: with cosines across the motion instead of waves, products take little more than half of the time.
"""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np
import scipy.fft
from numpy.typing import ArrayLike, NDArray

from viscofric.arrays import Array, ComplexArray
from viscofric.contact.arrays.backend import AnyArray, Backend
from viscofric.contact.arrays.transforms import along_x
from viscofric.contact.complementarity import ComplementaritySolution, solve_complementarity
from viscofric.contact.extension import Extension, lag
from viscofric.contact.free.grids import Grid
from viscofric.contact.influence.line import HalfSpaceStrip
from viscofric.contact.influence.mixtures import memory_influence
from viscofric.contact.influence.potentials import CellPotential, HalfSpaceCell
from viscofric.threads import threads_for

# Memory length, in cells, from which on a mode's dissipation follows from slopes instead of bends.
_BEND_MEMORY = 10.0
# Cells processed together: few enough for the cache.
_CELLS_AT_ONCE = 20_000
# Cells from which on corrections are in single precision.
_FEWEST_SINGLE = 2**18
# Cells along an edge from which on residuals are extended.
_FEWEST_EXTENDED = 256
_SINGLE = {"f": np.float32, "c": np.complex64}
# Part of the largest value by which values that are even in y may differ, and do by rounding.
_ROUNDING = 1e-12
# Loss angle of waves four cells long from which displacements are taken behind the cell centres.
_TOLERATED_ANGLE = np.pi / 4.0


@dataclass(frozen=True)
class SteadyMaterial:
    """Compliances and memory lengths of a material at one speed and temperature."""

    glassy: float  # (1−ν²)/E∞, the compliance without memory
    compliances: Array  # (m,), (1−ν²) C_k
    memory_lengths: Array  # (m,), v τ_k > 0: distance behind the indenter over which a mode relaxes
    counterface: float = 0.0  # (1−ν_i²)/E_i of an elastic indenter, a half-space even where the material is a layer
    # Shear stress along the motion over the pressure, and (1−2ν)/(2(1−ν)) of the material and of the indenter.
    drag: float = 0.0
    coupling: float = 0.0
    counterface_coupling: float = 0.0

    @property
    def counterface_drag(self) -> float:
        """`drag` of the indenter's potential: the shear on it is the opposite one."""
        return -self.drag * self.counterface_coupling

    @property
    def edge_coupling(self) -> float:
        """Displacement of the shortest waves by the shear, over that by the pressure: μβ of a half-space.

        The pressure rises from the edges with the powers 1/2 ± arctan(μβ)/π of the distance.
        """
        sheared = self.glassy * self.coupling - self.counterface * self.counterface_coupling
        return self.drag * sheared / (self.glassy + self.counterface)

    def symbol(self, qx: Array, yielding: ArrayLike = 1.0) -> ComplexArray:
        """Return the compliance for a sinusoidal load of wavenumber q_x, (1−ν²) S(−q_x v) + (1−ν_i²)/E_i.

        `yielding` is Θ of a layer at these wavenumbers, the factor of the first term.
        """
        with np.errstate(over="ignore"):  # where the square of a phase overflows, its mode is practically rigid
            phase = np.multiply.outer(qx, self.memory_lengths)
            wave = 1.0 / (1.0 + phase**2)
        result = self.glassy + wave @ self.compliances + 1j * ((phase * wave) @ self.compliances)
        return np.asarray(result * yielding + self.counterface)


class Influence(NamedTuple):
    """Influence coefficients, each (2 nx − 1, ny), even in y.  "Dissipates": does work on some pressure.

    At x = −(nx−1) … nx−1 and y = 0 … ny−1 cells from the loaded one.
    """

    displacement: Array
    # the part of its slope that dissipates, of short memories from bends; see `ConvolutionOperator.dissipated_force`
    dissipation: Array

    def times(self, unit: float, length: float) -> Influence:
        """Return displacements in a unit times a length, their slopes in that unit; in place, since they are large."""
        self.displacement[...] *= unit * length
        self.dissipation[...] *= unit
        return self


@dataclass
class ConvolutionOperator(ABC):
    """Displacement under pressures on the cells of a grid, each cell's influence independent of its position.

    Linear and positive definite, but *not* symmetric, because of the solid's memory.
    """

    #: Factor of the cell's potential for a compliance of one, without the cell's length.
    unit: ClassVar[float]

    window: Grid
    material: SteadyMaterial
    # position behind the cell centres where the displacement is taken, in cells (0 to 0.5); see `collocation_shift`
    shift: float = 0.0
    backend: Backend = field(default_factory=Backend)
    # applications so far; each costs one forward and one inverse FFT of the padded window
    products: int = field(default=0, init=False)
    _displacement: Array = field(init=False, repr=False)
    _dissipation: Array = field(init=False, repr=False)
    _padded: tuple[int, int] = field(init=False, repr=False)
    _is_damped: bool = field(default=False, init=False, repr=False)
    _is_single: bool = field(default=False, init=False, repr=False)
    _is_even: bool = field(default=False, init=False, repr=False)

    def __post_init__(self) -> None:
        nx, ny = self.window.shape
        self._padded = (
            scipy.fft.next_fast_len(2 * nx - 1, real=False),
            scipy.fft.next_fast_len(2 * ny - 1, real=True),
        )
        # The dissipation is evaluated once, after the solve: its spectra are not kept.
        self._displacement, self._dissipation = self._influence()

    @cached_property
    def _transfer(self) -> AnyArray:
        return self._spectrum(self._displacement)

    @cached_property
    def _inverse_symbol(self) -> AnyArray:
        return self.backend.asarray(_optimal_circulant_inverse(self._displacement))

    @property
    @abstractmethod
    def cell(self) -> CellPotential:
        """Potential of a cell, in units of the cell's length."""

    def _influence(self) -> Influence:
        """Influence coefficients of the displacement and of its dissipating part."""
        found = cell_influence(self, self.cell, self.material.glassy)
        self._add_counterface(found)
        return found.times(self.unit, self.window.spacing)

    def _add_counterface(self, found: Influence) -> None:
        """Add the influence of an elastic indenter in place; in line contacts its displacement has no level."""
        compliance = self.material.counterface
        if compliance == 0.0:
            return
        nx, ny = self.window.shape
        drag = self.material.counterface_drag
        cell: CellPotential = HalfSpaceCell(self.window.width / self.window.spacing, drag)
        if ny == 1:
            cell = HalfSpaceStrip(drag)
        x, y = np.arange(-(nx - 1.0), nx)[:, None], cell.aspect * np.arange(float(ny))
        displacement = cell(x - self.shift, y)
        found.displacement[...] += compliance * (displacement - below(displacement) if ny == 1 else displacement)
        if cell.drag:
            found.dissipation[...] += compliance * cell.drag_slope(x, y)

    @property
    def dtype(self) -> Any:
        """Type of the arrays that it returns."""
        return self.backend.xp.float32 if self._is_single else self.backend.xp.float64

    @cached_property
    def even(self) -> Self:
        """The same operator for pressures that are even in y, on the cells at y > 0 only; for NumPy's arrays."""
        half = self._changed(self._displacement)
        (nx, ny), (px, _) = self.window.shape, self._padded
        half._is_even, half._padded = True, (px, scipy.fft.next_fast_len(ny, real=True))
        half._transfer = along_x(half._even_spectrum(self._displacement))
        half._inverse_symbol = along_x(self._inverse_symbol[: nx // 2 + 1, : ny // 2])
        return half

    def _changed(self, displacement: Array) -> Self:
        """Return the operator with other influence coefficients of the displacement."""
        changed = copy.copy(self)
        for cached in ("_transfer", "_inverse_symbol", "even"):
            changed.__dict__.pop(cached, None)
        changed.products, changed._displacement = 0, displacement
        return changed

    def for_corrections(self) -> Self:
        """Return the same operator in single precision, which is enough for corrections and takes half the time.

        The operator itself on small grids, where it would save nothing, and on other arrays than NumPy's.
        """
        if not self.backend.is_numpy or self.window.shape[0] * self.window.shape[1] < _FEWEST_SINGLE:
            return self
        single = copy.copy(self)
        single.products, single._is_single = 0, True
        single._transfer = self._transfer.astype(np.complex64)
        single._inverse_symbol = self._inverse_symbol.astype(_SINGLE[self._inverse_symbol.dtype.kind])
        return single

    def _spectrum(self, influence: Array) -> AnyArray:
        nx, ny = self.window.shape
        px, py = self._padded
        circulant = np.zeros(self._padded)
        rows = np.arange(-(nx - 1), nx) % px
        circulant[rows, :ny] = influence
        if ny > 1:
            circulant[rows, py - ny + 1 :] = influence[:, :0:-1]
        return self.backend.transforms.forward(self.backend.asarray(circulant))

    def _even_spectrum(self, influence: Array) -> ComplexArray:
        """Return the spectrum along x and the cosines along y, but those that alternate: even pressures have none."""
        nx, (px, py) = self.window.shape[0], self._padded
        circulant = np.zeros(self._padded)
        circulant[np.arange(-(nx - 1), nx) % px] = scipy.fft.dct(influence, 1, py + 1, axis=1)[:, :py]
        return np.asarray(scipy.fft.rfft(circulant, axis=0))

    def __call__(self, pressure: AnyArray) -> AnyArray:
        """Displacement (positive into the solid) at the cell centres under a pressure, both (nx, ny)."""
        self.products += 1
        return self._convolve(self._transfer, self.backend.asarray(pressure))

    def _convolve(self, spectrum: AnyArray, values: AnyArray) -> AnyArray:
        transforms = self.backend.transforms
        return (transforms.convolved_even if self._is_even else transforms.convolved)(values, spectrum, self._padded)

    def precondition(self, residual: AnyArray) -> AnyArray:
        """Approximate pressure of a displacement: the inverse of the nearest periodic operator."""
        if self._is_even:
            return self.backend.transforms.convolved_even(residual, self._inverse_symbol, residual.shape)
        waves = self.backend.transforms.forward(residual)
        waves *= self._inverse_symbol
        return self.backend.transforms.inverse(waves, self.window.shape)

    def overlaps(self, pressure: Array) -> Array:
        """Return Σ_j p_j p_(j+d) for each distance d at which influence coefficients stand, (2 nx − 1, ny).

        Those on either side of y = 0 are added up, and so are, since d and −d belong to the same pairs, those before
        and behind.  The energy that a pressure dissipates is the sum of their products with the coefficients.
        """
        nx, ny = self.window.shape
        if self.backend.is_numpy and is_even(pressure):
            return self._even_overlaps(upper_half(pressure))
        waves = self.backend.transforms.forward_padded(self.backend.asarray(pressure), self._padded)
        at_once = max(1, _CELLS_AT_ONCE // waves.shape[1])
        for start in range(0, waves.shape[0], at_once):
            rows = slice(start, min(start + at_once, waves.shape[0]))
            waves[rows, :] *= self.backend.xp.conj(waves[rows, :])
        found = self.backend.to_numpy(self.backend.transforms.inverse(waves, self._padded))
        folded: Array = np.concatenate([found[self._padded[0] - nx + 1 :, :ny], found[:nx, :ny]])
        folded[:, 1:] += folded[::-1, 1:]
        return folded

    def _even_overlaps(self, half: Array) -> Array:
        """Return the same for pressures that are even in y, given those at y > 0; the sums are then even in x too."""
        (nx, ny), (px, py) = self.window.shape, self.even._padded
        threads = threads_for(px * py, self.backend.threads)
        lines = scipy.fft.dct(half, 2, py, axis=1, workers=threads)
        waves = scipy.fft.rfft(lines, px, axis=0, workers=threads)
        squares = waves.real**2 + waves.imag**2
        lines = scipy.fft.irfft(squares, px, axis=0, workers=threads)[:nx]
        found = scipy.fft.idct(lines, 1, py + 1, axis=1, workers=threads)[:, :ny]
        found[:, 1:] *= 2.0
        return np.concatenate([found[:0:-1], found])

    def dissipated_force(self, pressure: Array) -> float:
        """Friction force from the energy that the material dissipates, per unit of distance slid.

        F_t = −∫ p ∂u/∂x dA, in which only the memory does work; in Fourier space the integral over q of
        2 q_x |p̂|² (−Im S)/|q| (see docs/theory/numerics.md).

        The displacement of one mode, y_k − l_k ∂y_k/∂x = c_k L p, dissipates −∫ p ∂y_k/∂x dA = −l_k ∫ p ∂²y_k/∂x² dA,
        since the slope of c_k L p does no work.  With second differences in place of ∂²/∂x² the part that cells leave
        out follows from the bends of the gap; see `viscofric.contact.free.balance`.  For modes whose memory is long
        against the cell the slope is more accurate; `bent_share` is the part of each mode that is found from bends.
        """
        return -self.window.cell_area * float(np.vdot(self._dissipation, self.overlaps(pressure)))

    def dissipated_force_gradient(self, pressure: Array) -> Array:
        """Change of `dissipated_force` with the pressure of each cell, (nx, ny)."""
        # The force is a quadratic form, which has a symmetric matrix: that of the influence and its mirror image.
        symmetric = self._spectrum(self._dissipation + self._dissipation[::-1])
        slope = self._convolve(symmetric, self.backend.asarray(pressure))
        return -self.window.cell_area * self.backend.to_numpy(slope)

    def extension(self, dtype: Any, *, even: bool = False) -> Extension | None:
        """Return what extends residuals before they are preconditioned, in some precision; `even`: for those at y > 0.

        None in small windows, where it would save nothing, in line contacts, and where cells have a compliance of their
        own: their displacement is discontinuous at the edge of a contact.
        """
        if min(self.window.shape) < _FEWEST_EXTENDED or self._is_damped:
            return None
        nx, ny = self.window.shape
        late = -lag(self._inverse_symbol, ny, (1.0, 0.0))  # an inverse has the opposite loss angle
        return Extension(self.backend, (nx, ny // 2 if even else ny), dtype, (1.0, 0.0), late, even=even)

    def transposed(self) -> Self:
        """Return the operator with the transposed matrix: the same influence, mirrored along the motion."""
        return self._changed(self._displacement[::-1])

    def damped(self, compliance: float) -> Self:
        """Return the operator with a compliance of each cell by itself added: a multiple of its pressure."""
        displacement = self._displacement.copy()
        displacement[self.window.shape[0] - 1, 0] += compliance
        damped = self._changed(displacement)
        damped._is_damped = True
        return damped


def solve_on_cells(
    operator: ConvolutionOperator, height: Array, load: float | None, guess: Array, **settings: Any
) -> ComplementaritySolution:
    """Solve the contact problem as `solve_complementarity` does, with corrections in single precision on large windows.

    Arguments as there, without `inner` and `extension`; the solution has NumPy's arrays.  Where the height is even in
    y, so is the solution, since there is only one, and half of the cells are solved.
    """
    even = operator.backend.is_numpy and is_even(height)
    if even:
        height, guess, load = upper_half(height), upper_half(guess), None if load is None else 0.5 * load
    solver = operator.even if even else operator
    inner = solver.for_corrections()
    extension = operator.extension(inner.dtype, even=even)
    found = solve_complementarity(solver, height, load, guess, inner=inner, extension=extension, **settings)
    found = found.on_numpy(operator.backend)
    if not even:
        return found
    return replace(found, pressure=both_halves(found.pressure), displacement=both_halves(found.displacement))


def is_even(values: Array) -> bool:
    """Return whether values (nx, ny) on a window are even in y, but for rounding."""
    if values.shape[1] % 2:
        return False
    half = values.shape[1] // 2
    upper, lower = values[:, half:], values[:, :half][:, ::-1]
    other = upper != lower
    if not other.any():
        return True
    difference = float(np.abs(upper[other] - lower[other]).max())
    return difference <= _ROUNDING * float(np.abs(values[np.isfinite(values)]).max(initial=0.0))


def upper_half(values: Array) -> Array:
    """Return those of values (nx, ny) at y > 0."""
    return np.ascontiguousarray(values[:, values.shape[1] // 2 :])


def both_halves(values: Array) -> Array:
    """Return all values (nx, ny) of those at y > 0."""
    return np.concatenate([values[:, ::-1], values], axis=1)


def cell_influence(operator: ConvolutionOperator, cell: CellPotential, instant: float) -> Influence:
    """Return displacement around a loaded cell, with its memory, and the part of its slope that dissipates.

    For the window, material and shift of `operator`; `instant` is the compliance without memory.  In units of the
    cell's potential, with lengths in cells.
    """
    nx, ny = operator.window.shape
    compliances = operator.material.compliances
    lengths = operator.material.memory_lengths / operator.window.spacing
    bent = bent_share(lengths)
    # ∂K/∂x = (K − L)/λ for each mode, and ∂L/∂x does no work on any pressure (it is odd).
    straight = (1.0 - bent) * compliances / lengths
    mixtures = np.stack([compliances, bent * compliances * lengths, straight])
    without_memory = np.array([instant, 0.0, -straight.sum()])
    displacement, bend, slope = memory_influence(
        (nx + 1, ny), mixtures, lengths, instant=without_memory, potential=cell
    )
    displacement, slope = displacement[1:-1], slope[1:-1]
    slope += second_difference(bend)
    if operator.shift > 0.0:
        (displacement,) = memory_influence(
            (nx, ny), mixtures[:1], lengths, operator.shift, instant=without_memory[:1], potential=cell
        )
    if cell.drag != 0.0:
        # ∂L/∂x has an even part, which works; it is in the differences of potentials of long memories only.
        instant_slope = cell.drag_slope(np.arange(-(nx - 1.0), nx)[:, None], cell.aspect * np.arange(float(ny)))
        slope += (instant + float((bent * compliances).sum())) * instant_slope
    return Influence(displacement, slope)


def below(values: Array) -> float:
    """Return a level a little below the least of values."""
    return float(values.min() - 0.1 * np.ptp(values))


def bent_share(memory_lengths: NDArray[Any]) -> Array:
    """Share of each mode's dissipation that is found from the bends of the surface, for memories in cells."""
    return np.asarray(1.0 / (1.0 + (memory_lengths / _BEND_MEMORY) ** 2))


def second_difference(values: Array) -> Array:
    """Second difference along the first axis, which it shortens by two."""
    found = -2.0 * values[1:-1]
    found += values[2:]
    found += values[:-2]
    return np.asarray(found)


def collocation_shift(material: SteadyMaterial, spacing: float) -> float:
    """Distance of the collocation points behind the cell centres, in cells: 0 to 1/2.

    Where a cell is long against the shortest memory but short against the next, pressures that alternate from cell
    to cell cause a displacement nearly a quarter of a wave behind: the operator is almost skew, like an advection
    evaluated at mid-cell, and no method for the complementarity problem converges well.  Evaluated farther behind (as
    in an upwind scheme), the displacement is in phase with these pressures.  The shift sets in where the loss angle of
    waves four cells long exceeds `_TOLERATED_ANGLE`; it vanishes as the grid is refined.
    """
    return 0.5 * max(0.0, (loss_angle(material, spacing) - _TOLERATED_ANGLE) / (0.5 * np.pi - _TOLERATED_ANGLE))


def loss_angle(material: SteadyMaterial, spacing: float) -> float:
    """Return the loss angle of waves four cells long."""
    return abs(float(np.angle(material.symbol(np.array([0.5 * np.pi / spacing])))[0]))


def _optimal_circulant_inverse(influence: Array) -> ComplexArray:
    """Inverse spectrum of the periodic operator that is nearest to the given one on the window.

    T. Chan, SIAM J. Sci. Stat. Comput. 9 (1988) 766: each diagonal is averaged with the one it wraps around to.  It
    inherits positive definiteness, and responds to short waves as the discrete operator does.  `influence` (2 nx − 1,
    ny) is even in its second index.
    """
    nx, ny = influence.shape[0] // 2 + 1, influence.shape[1]
    ahead, across = np.arange(nx)[:, None] / nx, np.arange(ny) / ny
    wrapped = np.zeros((nx, ny))
    wrapped[1:] = influence[: nx - 1]
    folded = (1.0 - ahead) * influence[nx - 1 :] + ahead * wrapped
    mirrored = np.zeros((nx, ny))
    mirrored[:, 1:] = folded[:, :0:-1]
    return np.asarray(1.0 / scipy.fft.rfft2((1.0 - across) * folded + across * mirrored))
