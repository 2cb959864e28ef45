"""Sentences of readers and studies in the words of the page: its own places instead of run files and the shell."""

from __future__ import annotations

_MASTER = "; under “Data” choose “A master curve” as the source, and drop it there."
_SWEEPS = "; under “Data” choose “Sweeps of a DMA or rheometer” as the source, and drop it there."
# What a sentence holds, the words from which on it speaks to users of Python or the shell, what the page says instead,
# and the field of the study that mends it.
_PAGE_WORDS = (
    (
        "modulus_unit=",
        ", or say it by modulus_unit=",
        "; or say under “Data” which unit it is.",
        "material.modulus_unit",
    ),
    (
        "temperature='25 degC'",
        "; for a sweep at one temperature say it",
        "; say under “Data” at which temperature it was measured.",
        "material.temperature",
    ),
    (
        "lies outside the measured",
        "; fit a law",
        "; leave it out, or use a law under “Shift” to go beyond.",
        "conditions.temperature",
    ),
    ("looks like a master curve", "; use read_master_curve", _MASTER, "material.dma"),
    ("is a master curve of RepTate", "; use read_master_curve", _MASTER, "material.dma"),
    ("not a table of a master curve", "; use read_dma", _SWEEPS, "material.master_curve"),
    ("no master curve", "; use read_dma", _SWEEPS, "material.master_curve"),
    ("tension or in shear", "; give deformation=", "; say under “Data” which it was.", "material.deformation"),
    ("a table of traction runs", "; use read_mtm", "; drop it under “Measurement”.", "material.dma"),
    ('law="best"', '; law="best"', "; choose a law under “Shift law” to write it.", None),
    ("a table of DMA sweeps", "; use read_dma", "; drop it under “Data”.", "measurement.mtm"),
)


def page_words(sentence: str) -> tuple[str, str | None]:
    """Return a sentence as the page says it.

    Parameters
    ----------
    sentence : str
        Of an error.

    Returns
    -------
    str
        The sentence itself, where it names nothing that only Python or the shell has.
    str or None
        The field of the study in which the answer belongs, where the sentence asks for one.
    """
    for held, start, instead, field in _PAGE_WORDS:
        if held in sentence and start in sentence:
            return sentence.split(start, maxsplit=1)[0] + instead, field
    return sentence, None
