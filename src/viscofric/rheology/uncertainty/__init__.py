"""Uncertainty of a whole material: bootstrap samples of it."""
