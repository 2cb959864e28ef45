"""The forms of the page as data: fields of a run file with their labels, kinds and limits, and when each is shown.

One view of the page renders all of them (`static/js/fields.js`), where the keys of a field are described.  A test
compares limits, words and units with the tables of the run file; importing those here would delay the first page.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.web.forms import contact, others

if TYPE_CHECKING:
    from viscofric.web.forms.fields import Field

#: By their names on the page.
FORMS: dict[str, list[Field]] = {
    "source": others.SOURCE,
    "questions": others.QUESTIONS,
    "making": others.MAKING,
    "shift": others.SHIFT,
    "amplitude": others.AMPLITUDE,
    "spectrum": others.SPECTRUM,
    "shape": contact.SHAPE,
    "scan": contact.SCAN,
    "load": contact.LOAD,
    "conditions": contact.CONDITIONS,
    "interface": contact.INTERFACE,
    "heating": contact.HEATING,
    "motion": others.MOTION,
    "history": others.HISTORY,
    "separation": others.SEPARATION,
    "master": others.MASTER,
    "identify": others.IDENTIFY,
    "solving": others.SOLVING,
    "card": others.CARD,
}
