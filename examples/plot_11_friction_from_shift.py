"""
Any temperature from one curve
==============================

Shift factors of the modulus also shift friction, exactly and without approximation: a contact at the temperature T has
the same pressure as one at :math:`T_0` that moves with :math:`\\alpha(T)\\,v`. Friction over all speeds
at one temperature is therefore friction over all temperatures at one speed.
"""

# %%
# The material is the built-in **synthetic** fluoroelastomer, with its WLF law and without a vertical shift. One curve
# is solved, at 30 °C.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf

rubber = vf.synthetic_fluoroelastomer()
ball = vf.Ball(radius="20 mm")
reduced_speed = np.geomspace(1e-8, 1e6, 36)  # m/s at 30 °C
curve = vf.predict_friction(rubber, ball, speeds=reduced_speed, temperatures="30 degC", load="10 N", accuracy=1e-2)

# %%
# From it follows friction at 10 cm/s and every temperature: read the curve at :math:`\alpha(T)` times the speed.
# Markers are contacts that were solved at their own temperature.

speed = 0.1  # m/s
temperatures = np.linspace(263.15, 373.15, 111)  # K
log_friction = np.interp(np.log(rubber.shift(temperatures) * speed), np.log(curve.speed), np.log(curve.viscoelastic))
marks = np.linspace(263.15, 373.15, 8)
solved = vf.predict_friction(rubber, ball, speeds=speed, temperatures=marks, load="10 N", accuracy=1e-2)

figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.0), sharey=True, layout="constrained")
left.loglog(curve.speed, curve.viscoelastic, color="C0")
left.set_xlabel("speed at 30 °C (m/s)")
left.set_ylabel("friction coefficient")
right.plot(temperatures - 273.15, np.exp(log_friction), color="C0", label="from the curve on the left")
right.plot(marks - 273.15, solved.viscoelastic, "o", color="C1", label="computed at each temperature")
right.set_xlabel("temperature (°C), at 0.1 m/s")
right.legend(frameon=False)
left.set_ylim(1e-3, 1e-1)

# %%
# The right panel is the left one, mirrored and stretched by the WLF law: low temperature is equivalent to high speed.
# The two maxima belong to the two relaxations of this material, the glass transition and a slower one. One contact,
# computed both ways, tests that the equivalence is exact:

temperature = "60 degC"
alpha = rubber.shift(temperature)
warm = vf.solve_steady(rubber, ball, speed=speed, load="10 N", temperature=temperature)
slow = vf.solve_steady(rubber, ball, speed=alpha * speed, load="10 N", temperature="30 degC")
friction = warm.friction_coefficient
print(f"at 60 °C and 100 mm/s            μ = {friction:.8f}")
print(f"at 30 °C and {1e3 * alpha * speed:.4f} mm/s         μ = {slow.friction_coefficient:.8f}")

plt.show()
