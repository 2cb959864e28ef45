"""Docstrings of the package as pages: written as plain text, they are kept from being taken for markup."""

from __future__ import annotations

import pkgutil
import re
from typing import TYPE_CHECKING, Any

from docutils import nodes

from viscofric.lazy import full_names

if TYPE_CHECKING:
    from sphinx.addnodes import pending_xref
    from sphinx.application import Sphinx
    from sphinx.environment import BuildEnvironment

#: Code, which stays as it is, or a mark that would be taken for markup.
_MARK = re.compile(r"(``.+?``|`[^`]+`_?)|([*|])")
#: An author's initial at the beginning of a line, which would begin a list.
_INITIAL = re.compile(r"^(\s*)([A-Z]\. )")
_EXAMPLE = re.compile(r"\s*(>>>|\.\.\. )")
_NAME_AND_TYPE = re.compile(r"([\w, ]+) : (.+)")
_HOMES = full_names()
_PUBLIC = re.compile(r"\b(" + "|".join(sorted(_HOMES, key=len, reverse=True)) + r")\b")


def prepare(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Escape the stars and bars of formulas, such as |E*| and 2*x, and link the types of attributes."""
    example, section = False, ""
    for place, line in enumerate(lines):
        if line.startswith("---") and place > 0:
            section = lines[place - 1]
        example = bool(_EXAMPLE.match(line)) or (example and bool(line.strip()))
        if example:
            continue
        line = _INITIAL.sub(r"\1\\\2", line)
        line = _MARK.sub(lambda found: found[1] or "\\" + found[2], line)
        if section == "Attributes" and (found := _NAME_AND_TYPE.fullmatch(line)):
            line = f"{found[1]} : " + _PUBLIC.sub(r":py:obj:`\1`", found[2])
        lines[place] = line


def plain_code(app: Sphinx, env: BuildEnvironment, node: pending_xref, content: Any) -> nodes.Node | None:
    """Show `words` that name no public object as code; a full name of the package must exist."""
    target = node.get("reftarget", "")
    if node.get("refdomain") != "py":
        return None
    if node.get("reftype") == "class":
        return None
    if target.startswith("viscofric."):
        try:
            pkgutil.resolve_name(target)
        except (ImportError, AttributeError):
            return None  # and Sphinx warns of it
    elif full := _HOMES.get(target.split("(")[0]):
        document, domain = node["refdoc"], env.get_domain("py")
        return domain.resolve_xref(env, document, app.builder, "obj", full, node, content)  # of another submodule
    return nodes.literal(target, content.astext())


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect both."""
    app.connect("autodoc-process-docstring", prepare, priority=100)  # before napoleon
    app.connect("missing-reference", plain_code)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
