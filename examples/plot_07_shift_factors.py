"""
Shift factors from DMA sweeps (the paper's Figure 4)
====================================================

A dynamic mechanical analyser measures the modulus over two decades of frequency, at several temperatures. Each
isotherm is a part of one long master curve; the shift that places it there is the shift factor
:math:`\\alpha(T)`.
"""

# %%
# The sweeps are **synthetic**: calculated for the built-in fluoroelastomer, with 1 % of noise. They are part of
# viscofric; replace the path by that of your own file.

from importlib.resources import files

import matplotlib.pyplot as plt

import viscofric as vf
from viscofric import report

sweeps = vf.read_dma(files("viscofric") / "example" / "dma.csv", deformation="tension")
print(sweeps.format, len(sweeps), "isotherms")

figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.2), layout="constrained")
report.plot_isotherms(left, sweeps, "storage")
colours = report.plot_isotherms(right, sweeps, "loss")
figure.colorbar(colours, ax=right, label="temperature (°C)")

# %%
# All isotherms are fitted by one common curve at once, E' and E'' together, and every factor has a standard error.
# Around the glass transition, where the modulus is steep, the isotherms are 4 K apart, so that neighbours overlap.

fit = vf.superpose(sweeps, reference="30 degC")
factors = fit.shift_factors
print(*fit.notes, sep="\n")

# %%
# Then a law is chosen: those of Williams, Landel and Ferry, of Arrhenius and others are compared by Akaike's
# criterion (AIC), which weighs the misfit against the number of constants.

laws = factors.compare_laws()
print(laws.explanation)

# %%
# From −20 to 150 °C the shift factors of this material span fourteen decades. The line is the best law, with its 95 %
# band, which is hardly wider than the line.

figure, axes = plt.subplots(figsize=(7.0, 4.6), layout="constrained")
report.plot_shift_factors(axes, factors, laws.best)
report.mark_synthetic([axes])

# %%
# As the data are synthetic, the truth is known:

truth = vf.synthetic_fluoroelastomer().shift
log10_at_100 = float(laws.best.log10("100 degC"))
error = float(laws.best.standard_error("100 degC"))
print(f"log10 α at 100 °C: {log10_at_100:.3f} ± {error:.3f}, planted: {float(truth.log10('100 degC')):.3f}")

plt.show()
