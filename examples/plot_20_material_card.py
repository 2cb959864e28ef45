"""
Material card for finite elements
=================================

Finite-element programs take a rubber as a Prony series with a shift law. A fit of DMA sweeps usually has thirty terms;
each costs time in every element. This example writes a card with twelve terms, reads it back, and shows the error that
the shorter series makes.
"""

# %%
# The sweeps are **synthetic**, of the built-in fluoroelastomer, with 1 % of noise.

import tempfile
from importlib.resources import files
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf

sweeps = vf.read_dma(files("viscofric") / "example" / "dma.csv", deformation="tension")
fit = vf.superpose(sweeps, reference="30 degC")
spectra = {
    "all modes": vf.fit_retardation_spectrum(fit),
    "12 modes": vf.fit_retardation_spectrum(fit, method="sparse", modes=12),
}
for name, spectrum in spectra.items():
    misfit = spectrum.fit
    print(f"{name}: {len(spectrum)} terms, misfit {misfit.rms_storage:.4f} and {misfit.rms_loss:.4f} decades")

# %%
# The card has its own units (N, mm, MPa) and one of the laws that the program knows, here fitted WLF. Incompressible
# rubber is given as nearly so, as elements permit. Comments in the card repeat what it leaves out.

rubber = vf.Material(spectra["12 modes"], shift=fit.shift_factors, poisson_ratio=0.49, name="example rubber")
with tempfile.TemporaryDirectory() as folder:
    card = Path(folder) / "rubber.inp"
    vf.write_card(rubber, card, format="abaqus", modulus_unit="MPa", law="best")
    lines = card.read_text(encoding="utf-8").splitlines()
    again = vf.read_card(card)
print(*[line for line in lines if line.startswith("*") and not line.startswith("**")], sep="\n")

# %%
# What the program will compute with, against the measured master curve.

curve = fit.master_curve
figure, axes = plt.subplots(figsize=(7.5, 4.6), layout="constrained")
omega = np.geomspace(curve.angular_frequency.min(), curve.angular_frequency.max(), 200)
modulus = again.complex_modulus(omega)
axes.loglog(curve.angular_frequency, curve.storage_modulus, "s", mfc="none", label="sweeps, E'")
axes.loglog(curve.angular_frequency, curve.loss_modulus, "o", mfc="none", label="sweeps, E''")
axes.loglog(omega, modulus.real, "k-", label="card")
axes.loglog(omega, modulus.imag, "k-")
axes.set(xlabel="reduced angular frequency α ω (rad/s)", ylabel="modulus (Pa)", title="SYNTHETIC data")
axes.legend()

# %%
# The terms must reach the frequencies of the job: v/a of the finest feature, times α at its temperature. One element,
# strained at two frequencies, tests that the program reads the card as meant.

storage_modulus = float(again.complex_modulus(2.0 * np.pi * 100.0).real)
print(f"E' at 100 Hz and 30 °C: {storage_modulus / 1e6:.2f} MPa")

plt.show()
