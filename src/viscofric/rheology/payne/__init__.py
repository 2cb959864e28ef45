"""The Payne effect: linear range of an amplitude sweep, Kraus's law, and a material at a strain."""
