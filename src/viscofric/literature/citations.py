"""The papers behind results, with the reasons: `citations`."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import version

from viscofric.errors import InputError
from viscofric.literature.basis import basis
from viscofric.literature.references import Reference
from viscofric.showing import Rows, Shown

_WIDTH = 118


@dataclass(frozen=True)
class Citation:
    """A reference, and the reasons to cite it."""

    reference: Reference
    reasons: tuple[str, ...]  # the parts of the result that use it, a few words each

    def __str__(self) -> str:
        return f"{str(self.reference).removesuffix('.')}. Cited for: {'; '.join(self.reasons)}."


@dataclass(frozen=True)
class Citations(Shown):
    """References of results, the software first; printed as a list, or as BibTeX.

    Attributes
    ----------
    entries : tuple of Citation
        Each reference once, in the order of the work.
    """

    entries: tuple[Citation, ...]

    def __len__(self) -> int:
        return len(self.entries)

    def _shown(self) -> Rows:
        return (("references", ", ".join(self.keys)),)

    def __iter__(self) -> Iterator[Citation]:
        return iter(self.entries)

    def __str__(self) -> str:
        return "\n".join(
            textwrap.fill(
                f"[{number}] {entry}", _WIDTH, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False
            )
            for number, entry in enumerate(self.entries, 1)
        )

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of the BibTeX entries, in their order."""
        return tuple(entry.reference.key for entry in self.entries)

    def bibtex(self) -> str:
        """Return all BibTeX entries, in UTF-8, one below the other."""
        return "\n\n".join(entry.reference.bibtex() for entry in self.entries) + "\n"


def citations(*results: object) -> Citations:
    """Return the papers behind results: methods, laws and data, each with the reason to cite it.

    Parameters
    ----------
    *results : Material, Superposition, ContactSolution, FrictionCurves, StudyResults and others
        One or several: a material, its spectrum, shifts, laws and samples; a `Layer`; solutions of contacts, friction
        curves and master curves; an identified material; surfaces' spectra, Persson's theory and friction on rough
        surfaces; results of a study, which contain all of these.

    Returns
    -------
    Citations
        Readable when printed; `bibtex()` for a bibliography.

    Raises
    ------
    InputError
        If nothing is given, or something that is not a result.

    Notes
    -----
    A contact does not contain its material, nor do friction curves contain the fit of theirs: give these, too, as in
    the example.  Titles and DOIs that could not be confirmed are left out of the references.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> solution = vf.solve_steady(
    ...     rubber, vf.Cylinder("10 mm"), speed="1 m/s", load="1 N/mm", temperature="30 degC", accuracy=1e-2
    ... )
    >>> cited = vf.citations(solution, rubber)
    >>> print(cited.entries[-1].reference)
    M. L. Williams, R. F. Landel, J. D. Ferry, “The temperature dependence of relaxation mechanisms in amorphous \
polymers and other glass-forming liquids”, J. Am. Chem. Soc. 77 (1955) 3701–3707, doi:10.1021/ja01619a008
    >>> "hunter1961" in cited.keys
    True
    """
    if not results:
        raise InputError(
            "citations() needs a result: a material, a contact, friction curves, results of a study …", code="no-result"
        )
    reasons: dict[Reference, list[str]] = {_software(): ["what everything here was computed with"]}
    for result in results:
        for reference, reason in basis(result):
            known = reasons.setdefault(reference, [])
            if reason not in known:
                known.append(reason)
    return Citations(tuple(Citation(reference, tuple(known)) for reference, known in reasons.items()))


def _software() -> Reference:
    return Reference("viscofric", ("viscofric developers",), title="viscofric", note=f"version {version('viscofric')}")
