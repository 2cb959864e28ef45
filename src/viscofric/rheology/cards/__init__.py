"""Materials as cards of finite-element programs and as JSON: written, and read back without loss."""

from viscofric.rheology.cards.card import Card
from viscofric.rheology.cards.card_files import CardFormat, CardLaw, open_card, read_card, write_card

__all__ = ["Card", "CardFormat", "CardLaw", "open_card", "read_card", "write_card"]
