"""Comparison with published and independent results: numbers of other programs, of papers, and closed forms.

``viscofric verify --published`` and the page "Published results" run them.
"""

from viscofric.verification.check import Check
from viscofric.verification.published import cards, closed_forms, contacts, persson

#: All checks, in the order of the page.
PUBLISHED: tuple[Check, ...] = (*contacts.CHECKS, *closed_forms.CHECKS, *persson.CHECKS, *cards.CHECKS)

__all__ = ["PUBLISHED"]
