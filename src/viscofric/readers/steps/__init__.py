"""Creep and relaxation tests: tables of responses over time, exports of instruments, what is left out of them."""
