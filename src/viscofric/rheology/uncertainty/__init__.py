"""Uncertainty of a whole rubber: samples of it, as other measurements might have given them."""
