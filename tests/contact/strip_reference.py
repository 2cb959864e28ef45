"""A dense solver of a sheared line contact on a strip that shares nothing with viscofric.contact.

R. H. Bentall and K. L. Johnson, Int. J. Mech. Sci. 10 (1968) 637, solve an elastic strip in plane contact by its
Fourier integrals and tractions that are linear between points; so does this, for a strip that slips everywhere.  Waves
are solved by a matrix exponential of the equations through the thickness rather than from their closed form.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import expm

Array = np.ndarray

#: Deeper waves, times the thickness, see a half-space: e^−16 of their motion is left at the base.
_DEEP = 8.0


@dataclass(frozen=True)
class SlidingStrip:
    """A strip of one retardation time that a rigid cylinder slides over, with Coulomb friction everywhere."""

    radius: float  # of the cylinder
    load: float  # per length
    thickness: float
    poisson_ratio: float
    coulomb: float
    E0: float
    E_inf: float
    memory: float  # speed times retardation time
    bonded: bool = True  # or sliding on its base without friction

    def friction(self, half_width: float, points: int) -> tuple[float, float, float]:
        """Return the friction of the pressure, and the front and rear edge, on points within ±`half_width`."""
        step = 2.0 * half_width / (points - 1)
        x = np.linspace(-half_width, half_width, points)
        response = self._response(step, points)
        matrix = response[points - 1 + np.subtract.outer(np.arange(points), np.arange(points))]
        height, loaded = x**2 / (2.0 * self.radius), np.ones(points, dtype=bool)
        for _ in range(200):
            held = np.flatnonzero(loaded)
            ones = np.ones((len(held), 1))
            system = np.block([[matrix[np.ix_(held, held)], -ones], [step * ones.T, np.zeros((1, 1))]])
            *inside, depth = np.linalg.solve(system, np.append(-height[held], self.load))
            pressure = np.zeros(points)
            pressure[held] = inside
            gap = matrix @ pressure + height - depth
            wrong = (loaded & (pressure < 0.0)) | (~loaded & (gap < 0.0))
            if not wrong.any():
                break
            loaded ^= wrong
        else:
            raise AssertionError("the contact was not found")
        assert not loaded[0]
        assert not loaded[-1]
        return step * float(pressure @ x) / (self.load * self.radius), x[loaded][-1], -x[loaded][0]

    def _response(self, step: float, points: int) -> Array:
        """Displacement into the strip by a load of height 1 on one point, at distances from −(points − 1) steps on."""
        pressed, sheared = self._waves()
        # Images are thirty windows away; the tail of the integral is 1e-5 of it.
        period = 30 * points  # steps
        dq = 2.0 * np.pi / (period * step)
        q = dq * (0.5 + np.arange(int(80.0 / step / dq)))
        compliance = 1.0 / self.E_inf + (1.0 / self.E0 - 1.0 / self.E_inf) / (1.0 - 1j * q * self.memory)
        depth = np.minimum(q * self.thickness, _DEEP)
        waves = (pressed(depth) - 1j * self.coulomb * sheared(depth)) / q * compliance
        waves *= step * np.square(np.sinc(0.5 * q * step / np.pi)) * dq / np.pi  # of linear pieces
        # Σ exp(iqx) at the steps is one FFT: waves whose numbers differ by a period have the same values there.
        folded = np.append(waves, np.zeros(-len(waves) % period)).reshape(-1, period).sum(axis=0)
        away = np.arange(1 - points, points)
        return (np.exp(1j * np.pi * away / period) * period * np.fft.ifft(folded)[away]).real

    def _waves(self) -> tuple[CubicSpline, CubicSpline]:
        """E q times the displacement into the strip by pressure 1, and that out of it by shear 1, over qH."""
        nu = self.poisson_ratio
        rows = np.array(
            [
                [0.0, 1.0, 2.0 * (1.0 + nu), 0.0],
                [-nu / (1.0 - nu), 0.0, 0.0, (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu)],
                [1.0 / (1.0 - nu**2), 0.0, 0.0, nu / (1.0 - nu)],
                [0.0, 0.0, -1.0, 0.0],
            ]
        )
        depth = np.linspace(1e-4, _DEEP, 400)
        through = expm(depth[:, None, None] * rows)
        loads = np.array([[0.0, 1.0], [-1.0, 0.0]])  # columns: pressure, shear
        base = [2, 3] if self.bonded else [0, 3]  # what is not zero at the base
        given = np.linalg.solve(through[:, 2:, base], np.broadcast_to(loads, (len(depth), 2, 2)))
        moved = through[:, :2, base] @ given
        return CubicSpline(depth, -moved[:, 1, 0]), CubicSpline(depth, moved[:, 1, 1])
