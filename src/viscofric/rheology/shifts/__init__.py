"""Shift factors α(T) and b(T): measured tables, shift laws and their fits, files of them."""
