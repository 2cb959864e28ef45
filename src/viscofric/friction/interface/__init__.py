"""The dry interface: its shear stress from measured Coulomb friction, and its share of predicted friction."""
