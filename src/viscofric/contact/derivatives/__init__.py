"""Derivatives of the friction coefficient by an adjoint solve."""
