"""Materials as cards of finite-element programs, as JSON and as CSV: written, and read back without loss."""

from viscofric.rheology.cards.card import Card
from viscofric.rheology.cards.card_files import CardFormat, open_card, read_card, write_card

__all__ = ["Card", "CardFormat", "open_card", "read_card", "write_card"]
