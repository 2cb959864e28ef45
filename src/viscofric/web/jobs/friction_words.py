"""Sentences on friction as the page says them: its own fields instead of the options of Python and the shell."""

from __future__ import annotations

import re

#: What Python and the shell are told to do, as a pattern -> what the page calls it.
_SAID = tuple(
    (re.compile(pattern), words)
    for pattern, words in (
        (r"by runs\.select\(except_steps=\[([\d, ]+)\]\) \([^)]* in the shell\)", r"by “Steps to leave out”: \1"),
        (r"such as by runs\.select\(abs\([^)]*\) < [\d.e+-]+\)", "by “Steps to leave out”"),
        (r"\(coulomb= in Python, --coulomb in the shell\)", "(“Assumed Coulomb friction”)"),
        (r"\(zero= in Python, --zero in the shell\)", "(“Zero of the force cell”)"),
        (r"temperature_tolerance = ([\d.e+-]+ K)", r"“Gap between temperatures” = \1"),
        (r"speed_tolerance = ([\d.e+-]+)", r"“Gap between speeds” = \1"),
        (r"speed_tolerance, in the shell --speed-tolerance,", "“Gap between speeds”"),
        (r"choose one with curves\.at_load\(\), or give the indenter \(in the shell --ball\),", "give a ball,"),
        (r"except_steps = \(([\d, ]+?),?\)", r"“Steps to leave out” = \1"),
        (r"; thermometer='pot' takes that one", ""),
        (r"use read_dma, or name it as dma under \[material\] of a run file", "drop it at the step “Data”"),
        (r" with curves\.(?:select|at_load)\(\)", ""),
        (r" \(in the shell --[\w-]+\)", ""),
        (r" with select\(\)", ""),
    )
)


def for_the_page(sentence: str) -> str:
    """Return a sentence that names the page's fields where it names those of Python or the shell.

    Parameters
    ----------
    sentence : str
    """
    for pattern, words in _SAID:
        sentence = pattern.sub(words, sentence)
    return sentence
