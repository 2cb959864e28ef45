"""
Modulus and temperature (the paper's Figure 1)
==============================================

Relaxation is faster at higher temperature. If all relaxation times change by the same factor, a change of temperature
only shifts the modulus along the frequency axis, :math:`E(\\omega, T) = E(\\alpha(T)\\,\\omega, T_0)`. By this
time-temperature superposition a short range of measured frequencies covers a long one.
"""

# %%
# The material is the built-in **synthetic** fluoroelastomer: an assumption of this project, not a measurement.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf

rubber = vf.synthetic_fluoroelastomer()
frequency = np.geomspace(1e-4, 1e12, 400)  # rad/s
temperatures = ["0 degC", "30 degC", "60 degC", "90 degC"]

# %%
# Storage and loss modulus at four temperatures. From one to the next both curves keep their shape and shift to the
# right, by less at higher temperatures.

figure, panels = plt.subplots(1, 2, figsize=(10.0, 4.0), layout="constrained")
for temperature, colour in zip(temperatures, plt.cm.viridis(np.linspace(0.0, 0.85, len(temperatures))), strict=True):
    modulus = rubber.complex_modulus(frequency, temperature)
    for axes, part in zip(panels, (modulus.real, modulus.imag), strict=True):
        name = temperature.replace("deg", "°")
        axes.loglog(frequency, 1e-6 * part, color=colour, label=name)
for axes, name in zip(panels, ("storage modulus $E'$ (MPa)", "loss modulus $E''$ (MPa)"), strict=True):
    axes.set_xlabel(r"angular frequency $\omega$ (rad/s)")
    axes.set_ylabel(name)
panels[0].legend(frameon=False)
panels[1].set_ylim(bottom=1e-2)

# %%
# Multiplied by their shift factors, the frequencies of all temperatures give one curve, that of the reference
# temperature, 30 °C. For this material it is so by construction; for measured sweeps it is checked.

alpha = rubber.shift("60 degC")
shifted = rubber.complex_modulus(alpha * frequency, "30 degC")
warm = rubber.complex_modulus(frequency, "60 degC")
log10_shift = float(np.log10(alpha))
print(f"from 30 to 60 °C, log10 α = {log10_shift:.4f}: the rubber is {1.0 / alpha:.0f} times faster")
print(f"largest difference of the shifted modulus: {np.max(np.abs(shifted / warm - 1.0)):.0e}")

plt.show()
