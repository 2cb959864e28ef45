"""Rough surfaces: measured ones prepared, made ones, their power spectra, Persson's theory, and sliding on them."""
