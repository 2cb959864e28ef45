"""
Master curve and spectrum (the paper's Figure 5)
================================================

Shifted isotherms make one master curve over more decades than any instrument can measure. A contact solution needs it
as a sum of retardation modes, :math:`1/E(\\omega) = 1/E_\\infty + \\sum_k C_k/(1 + i\\omega\\tau_k)`, each with its
own retardation time.
"""

# %%
# The sweeps are **synthetic**, of the built-in fluoroelastomer, with 1 % of noise.

from importlib.resources import files

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric import report

sweeps = vf.read_dma(files("viscofric") / "example" / "dma.csv", deformation="tension")
fit = vf.superpose(sweeps, reference="30 degC")

# %%
# As in the paper, the times are in geometric progression with ratio e. The compliances of the modes are found by
# non-negative least squares: a negative one would return more energy than it received.

spectrum = vf.fit_retardation_spectrum(fit)
misfit = 10.0**spectrum.fit.rms_storage - 1.0, 10.0**spectrum.fit.rms_loss - 1.0  # given in decades
print(f"{len(spectrum)} modes; root mean square misfit {100 * misfit[0]:.2f} % of E', {100 * misfit[1]:.2f} % of E''")

# %%
# Squares and circles are the shifted sweeps, lines the spectrum. The panel below shows the residuals: the noise.

figure, (above, below) = plt.subplots(
    2, 1, figsize=(7.5, 6.6), sharex=True, layout="constrained", height_ratios=[3.0, 1.0]
)
report.plot_master_curve(above, fit.master_curve, spectrum)
report.plot_residuals(below, fit.master_curve, spectrum)
above.set_xlabel("")
report.mark_synthetic([above])

# %%
# The spectrum. The modes on the left, at short times, belong to the glass transition, the steep end
# of the curve above; the broad group on the right is a slow relaxation below it.

figure, axes = plt.subplots(figsize=(7.5, 3.8), layout="constrained")
report.plot_retardation_spectrum(axes, spectrum)

# %%
# Spectrum and shift factors together are the material of a contact.

rubber = vf.Material(spectrum, shift=fit.shift_factors, poisson_ratio=0.5)
modulus = rubber.complex_modulus(2.0 * np.pi, "60 degC")  # at 1 Hz
storage_modulus = modulus.real
print(f"at 60 °C and 1 Hz: E' = {1e-6 * modulus.real:.3f} MPa, E'' = {1e-6 * modulus.imag:.3f} MPa")

plt.show()
