"""Cases of a study: sweeps of them, contacts over time and with heat, and what they cost."""
