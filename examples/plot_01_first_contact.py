"""
A ball rolls on rubber
======================

Rubber that is pressed needs time to give way, and time to come back. Under a ball that moves, the rubber ahead is still
stiff while the rubber behind has not yet recovered: the pressure leans forward, its resultant passes ahead of the
ball's axis, and that lever arm is the friction force.
"""

# %%
# The rubber here is made up: one retardation time of 1 ms between a soft and a stiff elastic state. Numbers carry their
# units as text; plain numbers are SI.

import matplotlib.pyplot as plt

import viscofric as vf
from viscofric.report.contact_figures import plot_pressure_map, plot_pressure_profile, plot_surface_profile

rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
ball = vf.Ball(radius="10 mm")
solution = vf.solve_steady(rubber, ball, speed="1 m/s", load="1 N")

friction = solution.friction_coefficient
print(f"friction coefficient {friction:.5f} ± {solution.diagnostics.friction_error:.5f}")
print(f"indentation          {1e3 * solution.indentation:.4f} mm")
print(f"contact              {1e3 * solution.front:.3f} mm ahead of the axis, {1e3 * solution.rear:.3f} mm behind it")

# %%
# Window and grid were chosen for an error of friction of one part in a thousand, which is the default
# (``accuracy=1e-3``). The error printed above is an estimate from the nested grids that led there.
#
# The map shows the pressure from above; the ball moves to the right. Its contact is cut off behind, where the rubber is
# too slow to follow. In the profile along the centre line, the dashed line marks the centre of pressure: divided by the
# radius of the ball, its distance from the axis is the friction coefficient.

figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.2), layout="constrained", width_ratios=[1.15, 1.0])
colours = plot_pressure_map(left, solution)
figure.colorbar(colours, ax=left, label="pressure (kPa)", shrink=0.85)
plot_pressure_profile(right, solution)

# %%
# The same line, seen from the side (heights are exaggerated): behind the ball the rubber lies lower than at the same
# distance ahead of it. It has not yet recovered, and does so in the trail.

figure, axes = plt.subplots(figsize=(7.0, 3.6), layout="constrained")
plot_surface_profile(axes, solution, ball)

# %%
# Friction is found a second time, on another way: from the energy that the rubber dissipates. That both agree is a
# check that every solution carries with it.

from_the_lean = solution.pressure_friction_coefficient
from_the_energy = solution.energy_friction_coefficient
print(f"from the lean of the pressure {from_the_lean:.5f}, from the dissipated energy {from_the_energy:.5f}")

plt.show()
