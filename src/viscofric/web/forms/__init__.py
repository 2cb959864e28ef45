"""The forms of the page as data: fields of a run file with labels, kinds and limits, which `fields.js` renders."""

from __future__ import annotations

from viscofric.web.forms import contact, others
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
