"""Indenters and their shapes."""
