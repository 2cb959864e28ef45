"""Spectra of retardation and relaxation times, how they are fitted, and tables of moduli without any."""
