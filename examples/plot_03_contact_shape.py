"""
Contact shape from low to high speed
====================================

At rest a ball touches rubber in Hertz's circle. In motion the contact first loses its rear part, where the rubber
recovers too late to touch; it becomes shorter and asymmetric. At very high speed, the rubber is glassy everywhere, and
the contact is a circle again, only smaller.
"""

# %%
# Five speeds of the same ball under the same load on a synthetic material. Zero and infinity are valid speeds: the two
# elastic limits.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf

rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="100 MPa", tau="1 ms")
ball = vf.Ball(radius="10 mm")
speeds = {"at rest": 0.0, "0.1 m/s": 0.1, "1 m/s": 1.0, "10 m/s": 10.0, "infinite": np.inf}
solutions = {name: vf.solve_steady(rubber, ball, speed=speed, load="1 N") for name, speed in speeds.items()}

print("speed      ahead   behind  half width (mm)      μ")
for name, one in solutions.items():
    print(f"{name:9s} {1e3 * one.front:6.3f}  {1e3 * one.rear:6.3f}  {1e3 * one.half_width:6.3f}", end="")
    print(f"           {one.friction_coefficient:8.5f}")

# %%
# Outlines from above, at a twentieth of the mean pressure, and pressures along the centre line. The ball
# moves to the right; its axis is at zero. Slow contacts have a peak at their leading edge, where the rubber is
# still glassy. The peak may be narrower than any cell; then ``diagnostics.peak_resolved`` is false and the largest
# pressure is a lower bound.

figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.2), layout="constrained")
colours = plt.cm.viridis(np.linspace(0.0, 0.85, len(solutions)))
for (name, one), colour in zip(solutions.items(), colours, strict=True):
    edge = 0.05 * one.load / one.contact_area
    left.contour(1e3 * one.x, 1e3 * one.y, one.pressure.T, levels=[edge], colors=[colour])
    middle = one.pressure.shape[1] // 2
    right.plot(1e3 * one.x, 1e-3 * one.pressure[:, middle], color=colour, label=name)
left.plot(0.0, 0.0, "k+")
left.set_aspect("equal")
left.set_ylabel("across the motion (mm)")
for axes in (left, right):
    axes.set_xlim(-2.2, 2.2)
    axes.set_xlabel("along the motion (mm)")
left.set_ylim(-2.2, 2.2)
right.set_yscale("log")
right.set_ylim(10.0, 2e4)
right.set_ylabel("pressure (kPa)")
right.legend(title="speed", frameon=False)

# %%
# Hertz's formulae give both limits: the radius of the contact shrinks by :math:`(E_\infty/E_0)^{1/3}`, here 4.64. At 10
# m/s the rear edge has passed the axis: only the front of the ball carries the load.

shrinkage = solutions["at rest"].half_width / solutions["infinite"].half_width
print(f"half width at rest over that at infinite speed: {shrinkage:.4f}")

plt.show()
