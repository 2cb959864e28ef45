"""Friction curves of several temperatures shifted onto one."""
