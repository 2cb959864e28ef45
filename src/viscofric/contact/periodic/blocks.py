"""Coarse correction of the linear problem on a rough contact: the pressures of whole blocks of cells at once.

The inverse symbol, restricted to the contact, answers within each spot of contact almost exactly, but knows nothing
of how the spots press on one another: the wider the range of scales, the more waves it leaves, edge by edge.  So
other search directions are made of pressures that are uniform on what a block of cells has in contact, for large
blocks and for some half as long in turn: two sizes spare a third of the FFTs that one takes.  Blocks answer
one another by the exact influence of uniformly loaded squares (sampled from the grid's own influence function).
A block with the fraction f of its cells in contact, under the mean pressure y, adds to that at home what a smaller
square under y/f yields more than the whole one: a uniformly loaded area yields like the inverse of its width, so
(1/√f − 1) of the block's own answer.  That need not be exact: generalised conjugate residuals choose the steps along
both kinds of directions.

Deflation by piecewise constant vectors: R. A. Nicolaides, SIAM J. Numer. Anal. 24 (1987) 355, doi:10.1137/0724027.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.contact.complementarity import solve_on_contact
from viscofric.contact.periodic.operator import PeriodicOperator

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.contact.arrays.backend import AnyArray

_SIZES = range(8, 3, -1)  # cells along an edge of a block, the first that divides the grid
_FEWEST = 16  # blocks along an edge
_REDUCTION = 1e-2  # of the residual of the problem of the blocks
_STEPS = 16  # at most, for it


class Blocks:
    """Blocks of cells of a periodic grid, as a coarse correction for `solve_complementarity`.

    Parameters
    ----------
    operator : PeriodicOperator
        Of the grid.
    size : (int, int)
        Cells of a block along x and y, see `block_sizes`.
    """

    def __init__(self, operator: PeriodicOperator, size: tuple[int, int]) -> None:
        self.size = size
        bx, by = size
        self.shape = operator.shape[0] // bx, operator.shape[1] // by
        backend, xp = operator.backend, operator.backend.xp
        box = xp.zeros(operator.shape, dtype=operator.dtype, device=backend.device)
        box[:bx, :by] = 1.0 / (bx * by)
        waves = backend.transforms.forward(box)
        waves *= xp.conj(waves)
        waves *= operator.transfer
        # Mean displacement of each block under a unit mean pressure on one of them
        kernel = backend.transforms.inverse(waves, operator.shape)[::bx, ::by] * float(bx * by)
        operator.ffts += 2
        self.own = float(kernel[0, 0])
        transfer = backend.transforms.forward(xp.asarray(kernel, copy=True))
        if not xp.isdtype(operator.transfer.dtype, "complex floating"):
            transfer = xp.real(transfer)
        transfer = xp.asarray(transfer, copy=True)
        transfer[0, 0] = 0.0
        self.operator = PeriodicOperator(transfer, self.shape, operator.precision, backend)

    def on(self, contact: AnyArray, *, fixed_load: bool) -> Callable[[AnyArray], AnyArray]:
        """Return what answers a residual with pressures that are uniform on what each block has in contact.

        Parameters
        ----------
        contact : (nx, ny) array of bool
        fixed_load : bool
            Whether the load is given, so that the correction must not change it.
        """
        backend, xp = self.operator.backend, self.operator.backend.xp
        area = float(self.size[0] * self.size[1])
        touching = self._sums(xp.astype(contact, self.operator.dtype))
        cells = xp.clip(touching, min=1.0)
        partial = _PartialBlocks(self.operator, self.own, cells / area)
        blocks = backend.cells(touching > 0.0)

        def correction(residual: AnyArray) -> AnyArray:
            gap = blocks.gathered(self._sums(residual) / -cells)
            found, _, _ = solve_on_contact(
                partial, gap, blocks, reduction=_REDUCTION, floor=0.0, directions=_STEPS, fixed_load=fixed_load,
                most_steps=_STEPS,
            )  # fmt: skip
            return self._spread(blocks.scattered(found) * area / cells)

        return correction

    def _sums(self, field: AnyArray) -> AnyArray:
        (nx, ny), (bx, by) = self.shape, self.size
        xp = self.operator.backend.xp
        return xp.sum(xp.reshape(field, (nx, bx, ny, by)), axis=(1, 3))

    def _spread(self, values: AnyArray) -> AnyArray:
        (nx, ny), (bx, by) = self.shape, self.size
        xp = self.operator.backend.xp
        return xp.reshape(xp.broadcast_to(values[:, None, :, None], (nx, bx, ny, by)), (nx * bx, ny * by))


def block_sizes(shape: tuple[int, int]) -> list[tuple[int, int]]:
    """Return how many cells along x and y make a block, largest first; none if the grid is small or does not divide."""
    bx, by = (next((size for size in _SIZES if points % size == 0), 0) for points in shape)
    if not (bx and by) or shape[0] // bx < _FEWEST or shape[1] // by < _FEWEST:
        return []
    return [(bx, by)] if bx % 2 or by % 2 else [(bx, by), (bx // 2, by // 2)]


class _PartialBlocks:
    """Mean pressures on blocks to their mean displacements, each averaged over what is in contact."""

    def __init__(self, operator: PeriodicOperator, own: float, fraction: AnyArray) -> None:
        self.operator = operator
        self.backend, self.dtype = operator.backend, operator.dtype
        more = 1.0 / operator.backend.xp.sqrt(fraction) - 1.0
        self.own = own * more
        self.damping = 1.0 / (1.0 + more)
        self.products = 0

    def __call__(self, pressure: AnyArray) -> AnyArray:
        self.products += 1
        return self.operator(pressure) + self.own * pressure

    def precondition(self, residual: AnyArray) -> AnyArray:
        return self.operator.precondition(residual) * self.damping
