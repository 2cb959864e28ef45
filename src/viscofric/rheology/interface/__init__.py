"""The dry interface: laws of its shear stress over slip speed and temperature, and their fit."""
