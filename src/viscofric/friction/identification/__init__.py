"""Identification of the material from its friction."""
