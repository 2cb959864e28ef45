"""
Friction master curve (the paper's Figure 7)
============================================

If temperature shifts the modulus along the frequency axis, it shifts friction along the speed axis by the same factor:
:math:`\\mu(v, T) = \\mu(\\alpha(T)\\,v, T_0)` at the same load. Measurements at a few temperatures then make one
curve over more speeds than any tribometer reaches.
"""

# %%
# **Synthetic** data of the built-in fluoroelastomer again: runs of a traction machine, and sweeps for the shift
# factors. Friction itself is not used to find them.

from importlib.resources import files

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric import report

example = files("viscofric") / "example"
measured = vf.separate(vf.read_mtm(example / "mtm.csv"))
fit = vf.superpose(vf.read_dma(example / "dma.csv", deformation="tension"), reference="30 degC")
rubber = vf.Material(vf.fit_retardation_spectrum(fit), shift=fit.shift_factors, poisson_ratio=0.5)

# %%
# Shifted to 30 °C, friction at 90 °C is equivalent to friction at less than a micrometre per second, and friction at
# 10 °C to friction at hundreds of metres per second.

master = vf.shift_friction(measured, shift=fit.shift_factors, reference="30 degC")
slowest, fastest = master.reduced_range
print(f"measured from 1 mm/s to 3 m/s; as reduced speeds from {slowest:.1e} to {fastest:.0f} m/s")

# %%
# The line is predicted at 30 °C, over the whole range: it passes through all temperatures, and beyond.

ball = vf.Ball(radius="9.525 mm")
predicted = vf.predict_friction(
    rubber, ball, speeds=np.geomspace(1e-7, 1e3, 41), temperatures="30 degC", load="10 N", accuracy=3e-3
)
figure, axes = plt.subplots(figsize=(7.5, 4.8), layout="constrained")
report.plot_friction_master_curve(axes, predicted, master)
report.mark_synthetic([axes])

# %%
# Friction is thus known where it was not measured. At 75 °C, which was not tested, the measured curve gives friction at
# all speeds whose reduced speed it covers:

speed, temperature = "60 mm/s", "75 degC"
from_the_curve = float(master(speed, temperature))
solved = vf.solve_steady(rubber, ball, speed=speed, load="10 N", temperature=temperature).friction_coefficient
print(f"friction at {speed} and {temperature}: {from_the_curve:.4f} from the curve, {solved:.4f} computed directly")

plt.show()
