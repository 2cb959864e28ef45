"""
Ball rolling on rubber
======================

Rubber needs time to deform and to recover. Under a moving ball, the rubber at the leading edge is still stiff, and the
rubber at the trailing edge has not yet recovered. The pressure is therefore asymmetric, its resultant lies ahead of the
ball's axis, and this lever arm causes the friction force.
"""

# %%
# The material is synthetic: one retardation time of 1 ms between a soft and a stiff elastic state. Text carries its
# units; plain numbers are SI.

import matplotlib.pyplot as plt

import viscofric as vf
from viscofric import report

rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
ball = vf.Ball(radius="10 mm")
solution = vf.solve_steady(rubber, ball, speed="1 m/s", load="1 N")

friction = solution.friction_coefficient
print(f"friction coefficient {friction:.5f} ± {solution.diagnostics.friction_error:.5f}")
print(f"indentation          {1e3 * solution.indentation:.4f} mm")
print(f"contact              {1e3 * solution.front:.3f} mm ahead of the axis, {1e3 * solution.rear:.3f} mm behind it")

# %%
# Window and grid are chosen for an error of friction of one part in a thousand, which is the default
# (``accuracy=1e-3``). The error printed above is estimated from the nested grids.
#
# The map shows the pressure from above; the ball moves to the right. The contact is truncated behind the axis, where
# the rubber recovers too slowly. In the profile along the centre line, the dashed line marks the centre of pressure:
# its distance from the axis divided by the radius of the ball is the friction coefficient.

figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.2), layout="constrained", width_ratios=[1.15, 1.0])
colours = report.plot_pressure_map(left, solution)
figure.colorbar(colours, ax=left, label="pressure (kPa)", shrink=0.85)
report.plot_pressure_profile(right, solution)

# %%
# The same line, seen from the side (heights are exaggerated): behind the ball the rubber lies lower than at the same
# distance ahead of it. It recovers in the trail.

figure, axes = plt.subplots(figsize=(7.0, 3.6), layout="constrained")
report.plot_surface_profile(axes, solution, ball)

# %%
# Friction is also computed from the energy that the rubber dissipates. The agreement of both is a check that every
# solution contains.

from_pressure = solution.pressure_friction_coefficient
from_energy = solution.energy_friction_coefficient
print(f"from the pressure {from_pressure:.5f}, from the dissipated energy {from_energy:.5f}")

plt.show()
