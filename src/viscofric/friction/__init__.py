"""Friction of viscoelastic solids: separated from measurements, predicted, shifted and compared."""
