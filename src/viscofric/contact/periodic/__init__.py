"""Periodic contact: rough surfaces that repeat themselves, on a half-space or a layer."""
