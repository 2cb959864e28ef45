"""Extension of displacements beyond many spots by the contact of blocks of cells.

What a preconditioner on the whole grid needs beyond the contact is the displacement that the pressures on the contact
cause there (see `viscofric.contact.extension`).  Where many spots act on each other over long distances, a mean of what
is known nearby misses most of it: nine tenths of what steps then leave is one value for each spot.  Instead, the linear
contact is solved on blocks of cells, which takes a few products on a grid with a sixty-fourth of the points, and its
displacement is that beyond the contact.

The inverse on the whole grid also gives pressures beyond the contact.  There they are lost, and with them much of what
distant spots need of each other.  So pressures on the contact are raised, evenly over some blocks, to the loads that
the blocks were found to carry.  That saves a sixth to a fifth of the FFTs at 4096² points, fewer on smaller grids.

Cells in contact that fill a block only in part give way more than the whole block would under the same load, as punches
of a smaller area do.  With K the transfer function of waves on the blocks and s the share of a block's cells in
contact, the blocks in contact have the displacement K p + d p under the mean pressures p, where
d = κ K₀₀ (1/√s − 1); K₀₀ is the displacement of a block under its own pressure.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viscofric.contact.arrays.backend import AnyArray, Cells
from viscofric.contact.complementarity import solve_on_contact
from viscofric.contact.extension import Extension
from viscofric.contact.periodic.operator import PeriodicOperator

_FILLED = 1.5  # κ, by which the fewest steps are left
_LEAST_SHARE = 1e-3  # of a block's cells in contact
_FEWEST = 16  # blocks in contact
_REDUCTION = 3e-2  # of the residual on the blocks: their contact is not known better
_DIRECTIONS = 20  # of the steps on the blocks; three are usual
_EVENLY = 2.0  # blocks: standard deviation of the Gaussian by which missing loads are distributed
_LEAST_CARRYING = 0.02  # share of the cells within it
_BLOCK, _REACH = 4, 1.2  # of the extension on the grid of blocks


@dataclass
class BlockOperator(PeriodicOperator):
    """K + d on blocks, with the inverse of K and the median d, scaled to each block's own compliance."""

    own: float = 0.0  # K₀₀
    added: AnyArray = None  # d, (mx, my)
    typical: float = 0.0  # d of the blocks in contact, the median

    def __post_init__(self) -> None:
        super().__post_init__()
        self.stiff = PeriodicOperator(self.transfer + self.typical, self.shape, self.precision, self.backend)
        self.scale = (self.own + self.typical) / (self.own + self.added)

    def __call__(self, pressure: AnyArray) -> AnyArray:
        """Displacement of the cells in contact under mean pressures on blocks."""
        return super().__call__(pressure) + self.added * pressure

    def precondition(self, residual: AnyArray) -> AnyArray:
        """Approximate inverse of the operator."""
        return self.stiff.precondition(residual) * self.scale


class BlockExtension(Extension):
    """Extends values on a contact by the displacement that its blocks cause.

    For corrections by a periodic operator, with a given load or a given indentation.
    """

    def __init__(
        self, operator: PeriodicOperator, toward: tuple[float, float], lag: float, *, fixed_load: bool
    ) -> None:
        super().__init__(operator.backend, operator.shape, operator.dtype, toward, lag, inverse=operator.inverse)
        self._motion, self._precision, self._fixed_load = (toward, lag), operator.precision, fixed_load
        nx, ny = self.shape
        rows, columns = np.rint(np.fft.fftfreq(nx) * nx).astype(int), np.arange(ny // 2 + 1)
        wave_number = 2.0 * np.pi * np.hypot(np.fft.fftfreq(nx)[:, None], np.fft.rfftfreq(ny))
        self._evenly = self._array(np.exp(-0.5 * (_EVENLY * wave_number) ** 2))
        self._loads: AnyArray = None  # (mx, my), mean pressures on the blocks for the last residual
        # Of pressures that are constant over blocks, the means over blocks.
        means = np.sinc(rows / nx)[:, None] ** 2 * np.sinc(columns / ny) ** 2
        self._transfer = operator.backend.to_numpy(operator.transfer)[np.ix_(rows, columns)] * means
        self._own = float(np.fft.irfft2(self._transfer, self.shape)[0, 0])

    def beyond(self, contact: Cells) -> Callable[[AnyArray], AnyArray]:
        """Return what gives each block (mx, my) its displacement, from those (n,) of the cells in contact."""
        xp = self.backend.xp
        share = self.means(contact.scattered(xp.ones_like(contact.indices, dtype=self.dtype)))
        blocks = self.backend.cells(share > _LEAST_SHARE)
        if len(blocks) < _FEWEST:
            self._loads = None
            return super().beyond(contact)
        share = xp.clip(share, min=_LEAST_SHARE)
        added = _FILLED * self._own * (share**-0.5 - 1.0)
        typical = float(np.median(self.backend.to_numpy(blocks.gathered(added))))
        operator = BlockOperator(
            self._transfer, self.shape, self._precision, self.backend, own=self._own, added=added, typical=typical
        )
        extension = Extension(
            self.backend, self.shape, self.dtype, *self._motion,
            inverse=operator.stiff.inverse, block=_BLOCK, reach=_REACH,
        )  # fmt: skip

        def solved(values: AnyArray) -> AnyArray:
            wanted = blocks.gathered(self.means(contact.scattered(values)) / share)
            pressure, _, _ = solve_on_contact(
                operator, -wanted, blocks, reduction=_REDUCTION, floor=0.0, directions=_DIRECTIONS,
                fixed_load=self._fixed_load, extension=extension,
            )  # fmt: skip
            loaded = self._loads = blocks.scattered(pressure)
            found = operator.filtered(operator.transfer, loaded)
            if self._fixed_load:  # which leaves the level open
                found = found - xp.mean(blocks.gathered(found + added * loaded) - wanted)
            return xp.astype(found, self.dtype)

        return solved

    def collecting(self, contact: Cells) -> Callable[[AnyArray], AnyArray]:
        """Return what brings pressures, (nx, ny), onto a contact, (n,), and raises them to the loads of its blocks."""
        xp, collected, transforms = self.backend.xp, super().collecting(contact), self.backend.transforms

        def distributed(means: AnyArray) -> AnyArray:
            return transforms.inverse(transforms.forward(means) * self._evenly, self.shape)

        share = self.means(contact.scattered(xp.ones_like(contact.indices, dtype=self.dtype)))
        carrying = xp.clip(distributed(share), min=_LEAST_CARRYING)
        (over_x, over_y), ny = self._means, contact.chosen.shape[1]
        block = contact.indices // (ny * over_x.shape[1]) * self.shape[1] + contact.indices % ny // over_y.shape[1]

        def raised(field: AnyArray) -> AnyArray:
            found = collected(field)
            if self._loads is not None:
                missing = distributed(self._loads - self.means(contact.scattered(found))) / carrying
                found += xp.take(xp.reshape(missing, (-1,)), block)
            return found

        return raised
