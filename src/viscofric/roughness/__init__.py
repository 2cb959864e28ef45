"""Rough surfaces: preparation, generation, power spectra, Persson's theory, and sliding on them."""
