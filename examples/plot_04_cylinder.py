"""
Cylinder: comparison with an exact solution
===========================================

A long cylinder that rolls across its axis makes a line contact, a problem of plane strain. For a material with one
retardation time it was solved exactly by Hunter in 1961. This example compares the numerical solution with the exact
one.
"""

# %%
# The load of a line contact is a force per length. Material and cylinder are synthetic.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric.contact.reference import hunter_line

E0, E_inf, tau = "1 MPa", "10 MPa", "1 ms"
radius, load = "10 mm", "1 N/mm"
rubber = vf.Material.standard_linear_solid(E0=E0, E_inf=E_inf, tau=tau, poisson_ratio=0.5)
cylinder = vf.Cylinder(radius=radius)
speeds = np.geomspace(1e-2, 1e2, 7)
solutions = [vf.solve_steady(rubber, cylinder, speed=speed, load=load) for speed in speeds]


def exact(speed):
    """Hunter's exact solution of the same contact."""
    return hunter_line(load, radius, E0, E_inf, tau, speed, poisson_ratio=0.5)


# %%
# Friction over four decades of speed, and the pressure at one of them. The line is the exact solution, the markers are
# numerical solutions; the axis of the cylinder is at zero and it moves to the right.

fine = np.geomspace(speeds[0], speeds[-1], 60)
one = solutions[3]
figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.0), layout="constrained")
left.semilogx(fine, [exact(speed).friction_coefficient for speed in fine], color="C1", label="Hunter, exact")
left.semilogx(speeds, [each.friction_coefficient for each in solutions], "o", color="C0", label="numerical")
left.set_xlabel("speed (m/s)")
left.set_ylabel("friction coefficient")
left.set_ylim(bottom=0.0)
left.legend(frameon=False)
x = np.linspace(-5e-3, 5e-3, 600)
every = slice(None, None, max(1, len(one.x) // 60))
right.plot(1e3 * x, 1e-3 * exact(speeds[3]).pressure(x), color="C1", label="Hunter, exact")
right.plot(1e3 * one.x[every], 1e-3 * one.pressure[every, 0], "o", markersize=3.5, color="C0", label="numerical")
right.set_xlim(-5.0, 5.0)
right.set_xlabel("along the motion (mm)")
right.set_ylabel(f"pressure at {speeds[3]:.0f} m/s (kPa)")
right.legend(frameon=False)

# %%
# The difference over the whole range:

errors = [
    each.friction_coefficient / exact(speed).friction_coefficient - 1.0
    for speed, each in zip(speeds, solutions, strict=True)
]
friction = one.friction_coefficient
print(f"friction at {speeds[3]:.0f} m/s: numerical {friction:.6f}, exact {exact(speeds[3]).friction_coefficient:.6f}")
print(f"largest relative difference at any speed: {np.max(np.abs(errors)):.1e}")

plt.show()
