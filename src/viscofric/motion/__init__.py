"""Contacts in motion: histories of load, depth, path and temperature, and what they do to the material."""
