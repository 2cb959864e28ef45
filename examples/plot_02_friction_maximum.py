"""
Maximum of friction against speed
=================================

Under a slow ball the rubber is fully relaxed, under a fast one it is glassy: in both limits it is elastic and
dissipates nothing. In between, where the time to cross the contact is close to the retardation time, energy is
dissipated, and friction has a maximum.
"""

# %%
# A synthetic material with one retardation time, and a ball at speeds over five decades.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf

rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
ball = vf.Ball(radius="10 mm")
speeds = np.geomspace(1e-2, 1e3, 26)  # m/s
solutions = [vf.solve_steady(rubber, ball, speed=speed, load="1 N", accuracy=3e-3) for speed in speeds]

friction = np.array([solution.friction_coefficient for solution in solutions])
area = np.array([solution.contact_area for solution in solutions])

# %%
# A contact of radius :math:`a` is crossed in the time :math:`a/v`, so that the rubber is deformed mostly at angular
# frequencies around :math:`\omega = v/a`. The loss tangent :math:`\tan\delta = E''/E'` at this frequency measures
# the dissipated share of the work.

frequency = speeds / np.sqrt(area / np.pi)
modulus = rubber.complex_modulus(frequency)
loss_tangent = modulus.imag / modulus.real

# %%
# The maxima of loss tangent and friction are close to each other, that of friction at a slightly lower speed: at higher
# speed the rubber is stiffer, the indentation smaller, and less rubber is deformed. The contact area falls from Hertz's
# at the modulus :math:`E_0` to Hertz's at :math:`E_\infty`, smaller by :math:`(E_\infty/E_0)^{2/3} = 4.64`.

figure, (above, below) = plt.subplots(2, 1, figsize=(7.0, 6.4), sharex=True, layout="constrained")
above.plot(speeds, friction, "o-", color="C0", label=r"friction coefficient $\mu$ of the ball")
above.plot(speeds, 0.1 * loss_tangent, "--", color="C1", label=r"$\tan\delta(v/a)$ of the rubber, divided by 10")
above.set_ylabel("friction coefficient")
above.set_ylim(0.0, 0.19)
above.legend(loc="upper right", frameon=False)
below.plot(speeds, 1e6 * area, "s-", color="C2")
below.set_xscale("log")
below.set_xlabel("speed (m/s)")
below.set_ylabel("contact area (mm²)")
below.set_ylim(bottom=0.0)

# %%
# The maximum, from a polynomial through the five highest points:

near = np.sort(np.argsort(friction)[-5:])
polynomial = np.polynomial.Polynomial.fit(np.log(speeds[near]), friction[near], 4)
log_speed, values = polynomial.linspace(1001)
highest_friction = float(values.max())
print(f"friction is highest at {np.exp(log_speed[values.argmax()]):.2f} m/s, where it is {highest_friction:.4f}")
print(f"contact areas from {1e6 * area[0]:.2f} to {1e6 * area[-1]:.2f} mm²")

plt.show()
