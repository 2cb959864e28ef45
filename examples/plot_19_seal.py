"""
Seal on a rod: friction against speed and temperature
=====================================================

In a seal the same rubber stays in contact with the rod, so that a smooth rod deforms it once and hysteresis friction is
zero. The roughness of the rod travels through the contact and deforms the rubber again and again: seal engineers find
hysteresis friction there, and it depends on speed and temperature as the rubber does.
"""

# %%
# A generated rod surface, 0.18 µm rms, under the built-in fluoroelastomer: rod and rubber are **synthetic**. The mean
# pressure is that of the lip on the rod.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf

rubber = vf.synthetic_fluoroelastomer()
rod = vf.self_affine(0.8, shape=(128, 128), spacing="0.5 um", shortest="4 um", rolloff="16 um", rms_slope=0.1, seed=5)
speeds = np.geomspace(1e-3, 1.0, 7)
temperatures = (10.0, 30.0, 60.0, 90.0)


def slide(speed, celsius):
    """Return the solved contact of the lip with the rod's asperities."""
    return vf.solve_periodic(rubber, rod.to_surface(), speed=speed, pressure="1 MPa", temperature=celsius + 273.15)


solved = {(celsius, speed): slide(speed, celsius) for celsius in temperatures for speed in speeds}

# %%
# Friction has a maximum where the rod's waves deform the rubber at its glass transition. A warm seal has it beyond the
# rod's speeds, one at 10 °C has it near 20 mm/s.

figure, axes = plt.subplots(figsize=(7.5, 4.4), layout="constrained")
for celsius in temperatures:
    friction = [solved[celsius, speed].friction_coefficient for speed in speeds]
    axes.plot(speeds, friction, "o-", label=f"{celsius:.0f} °C")
axes.set(xscale="log", xlabel="speed (m/s)", ylabel="hysteresis friction coefficient", title="SYNTHETIC data")
axes.legend()

# %%
# A cold lip is stiff and touches the rod at its summits only, which leaves gaps for the fluid. Area and friction come
# from the same solution.

for celsius in temperatures:
    one = solved[celsius, speeds[3]]
    area = vf.roughness.contact_statistics(one).corrected_area_fraction
    print(f"{celsius:3.0f} °C: μ = {one.friction_coefficient:.4f} ± {one.diagnostics.friction_error:.4f}", end="")
    print(f", {100 * area:.0f} % in contact")

# %%
# This is the part by hysteresis. ``predict_rough_friction(interface=…)`` adds the friction of a dry interface; a film
# of lubricant is outside the model. Temperature and speed change together: at 60 °C, the friction of one speed is that
# of 30 °C at α times this speed.

alpha = float(rubber.shift("60 degC") / rubber.shift("30 degC"))
ratio = slide(alpha * speeds[-1], 30.0).friction_coefficient / solved[60.0, speeds[-1]].friction_coefficient
print(f"μ(30 °C, αv)/μ(60 °C, v) = {ratio:.9f}")
friction = solved[30.0, speeds[3]].friction_coefficient

plt.show()
