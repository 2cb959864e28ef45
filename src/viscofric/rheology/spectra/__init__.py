"""Spectra of retardation and relaxation times, their fits, and tables of moduli without a spectrum."""
