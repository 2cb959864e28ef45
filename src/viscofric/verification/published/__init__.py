"""Comparison with published and independent results: numbers of other programs, of papers, and closed forms.

``viscofric verify --published`` and the page "Published results" run them.
"""

from viscofric.verification.check import checks_in
from viscofric.verification.published import cards, closed_forms, contacts, persson

#: All checks, in the order of the page.
PUBLISHED = checks_in(contacts, closed_forms, persson, cards)

__all__ = ["PUBLISHED"]
