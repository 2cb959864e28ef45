"""
Persson's theory and numerical solutions
========================================

Persson's theory needs only the power spectrum of a surface, and takes milliseconds. It is exact in full contact
and an approximation at small contact areas. This example compares it with contacts solved with all asperities.
"""

# %%
# Three generated tracks that differ in their random phases only, under the built-in **synthetic** fluoroelastomer.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric import report

rubber = vf.synthetic_fluoroelastomer()
waves = {"shortest": "64 um", "rolloff": "250 um", "rms_slope": 0.2}
tracks = [vf.self_affine(0.8, shape=(128, 128), spacing="8 um", seed=seed, **waves) for seed in range(3)]
contact = {"temperatures": "30 degC", "pressure": "50 kPa"}
solved = vf.predict_rough_friction(rubber, tracks, speeds=np.geomspace(1e-4, 1.0, 7), **contact)

# %%
# The theory, from the power spectrum of the tracks. In partial contact the rubber follows a wave only in
# part; the factor :math:`S = \gamma + (1-\gamma)P^2` of the theory reduces the energy accordingly, with P the share in
# contact: 1 for :math:`\gamma = 1`, the theory of 2001, and less in later work with :math:`\gamma = 1/2`.

spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, longest="1.024 mm", **waves)
theories = {
    f"Persson, γ = {gamma:g}": vf.persson_theory(
        rubber, spectrum, speeds=np.geomspace(1e-4, 1.0, 25), gamma=gamma, **contact
    )
    for gamma in (0.5, 1.0)
}

# %%
# Points are the mean over the tracks, with the 95 % interval of the mean over all such tracks. The theory gives the
# shape of the curve, and its magnitude within a factor of about two. The contact area is a fifth to a third too small.

figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 4.3), layout="constrained")
report.plot_rough_friction(left, solved, theories)
report.plot_rough_friction(right, solved, {"Persson": theories["Persson, γ = 1"]}, area=True)

# %%
# Eight points in the shortest wave are few at small contact areas; ``friction_error`` is the estimated error.

theory = theories["Persson, γ = 1"]
ratio = theory.contact_area_fraction[0, ::4] / solved.mean_area[0]
print("area: theory over numerical solution:", np.array2string(ratio, precision=2))
grid_error = np.max(solved.friction_error / solved.friction_coefficient)
print(f"discretisation error: {100 * grid_error:.0f} % of friction at most")
friction_by_theory = float(theory.friction_coefficient[0, 12])

plt.show()
