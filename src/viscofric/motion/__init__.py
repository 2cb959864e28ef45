"""Contacts in motion: histories of load, depth, path and temperature, and the response of the material."""
