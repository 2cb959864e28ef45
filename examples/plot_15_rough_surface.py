"""
Rough surface
=============

Tyres and soles slide on tracks with asperities of all sizes. Each wavelength of the roughness deforms the rubber at its
own frequency, short waves at high ones, and contributes to friction.
"""

# %%
# One period of a generated, self-affine track slides over the built-in **synthetic** fluoroelastomer. The contact with
# all asperities is solved, under a mean pressure.

import matplotlib.pyplot as plt

import viscofric as vf
from viscofric import report

rubber = vf.synthetic_fluoroelastomer()
track = vf.self_affine(0.8, shape=(128, 128), spacing="8 um", shortest="64 um", rolloff="250 um", rms_slope=0.2, seed=7)
solutions = {
    speed: vf.solve_periodic(rubber, track.to_surface(), speed=speed, pressure="0.2 MPa", temperature="30 degC")
    for speed in ("1 mm/s", "0.1 m/s", "10 m/s")
}

# %%
# Heights, and contact patches at 0.1 m/s. The track moves along x, as the arrow shows, and the pressure is
# higher on the leading flanks.

figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
colours, label = report.plot_topography(left, track)
figure.colorbar(colours, ax=left, label=label)
colours, label = report.plot_contact_map(right, solutions["0.1 m/s"])
figure.colorbar(colours, ax=right, label=label)

# %%
# The energies dissipated by waves of different lengths add up, so that friction is a sum over wavelengths. Waves
# shorter than the shortest of the track are those of the pressure: the edges of the contact patches.

figure, axes = plt.subplots(figsize=(7.5, 4.3), layout="constrained")
report.plot_friction_by_wavelength(
    axes, {name: vf.roughness.friction_by_wavelength(one) for name, one in solutions.items()}
)

# %%
# At high speed the rubber is stiff, and the contact area is smaller. The errors are estimated discretisation
# errors, to an order of magnitude.

for name, one in solutions.items():
    print(f"{name:>8s}: μ = {one.friction_coefficient:.4f} ± {one.diagnostics.friction_error:.4f}", end="")
    print(f", {100 * vf.roughness.contact_statistics(one).corrected_area_fraction:.2f} % in contact")
friction = solutions["0.1 m/s"].friction_coefficient

plt.show()
