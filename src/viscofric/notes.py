"""A note: a sentence about a result or an error, with a code for programs and a remedy for each kind of reader."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal, TypeAlias

from viscofric.datasets import plain

#: Who reads a sentence: users of the library, of the commands, of run files (and reports), and of the local page.
Reader: TypeAlias = Literal["python", "shell", "run_file", "page"]
READERS: tuple[Reader, ...] = ("python", "shell", "run_file", "page")


@dataclass(frozen=True)
class Remedy:
    """What to do, as the end of a sentence, in the words of each reader.

    Remedies are joined with each other and with text by ``+``.
    """

    python: str  # for users of the library, and for all readers without words of their own
    shell: str | None = None  # for users of the commands
    run_file: str | None = None  # for users of a run file; without it, as for users of the commands
    page: str | None = None  # for users of the local page
    field: str | None = None  # path of the run file's key, and of the page's field, to change

    def words(self, reader: Reader) -> str:
        """Return the remedy in the words of a reader."""
        said: str | None = getattr(self, reader)
        if said is None and reader == "run_file":
            said = self.shell
        return self.python if said is None else said

    def __add__(self, other: Remedy | str) -> Remedy:
        after = Remedy(other) if isinstance(other, str) else other
        return by_reader(lambda reader: self.words(reader) + after.words(reader), self.field or after.field)

    def __radd__(self, other: str) -> Remedy:
        return Remedy(other) + self

    def reworded(self, change: Callable[[str], str]) -> Remedy:
        """Return the remedy with its words changed."""
        given = {reader: said for reader in READERS if (said := getattr(self, reader)) is not None}
        return replace(self, **{reader: change(said) for reader, said in given.items()})


def by_reader(words: Callable[[Reader], str], field: str | None = None) -> Remedy:
    """Return a remedy from a function of the reader."""
    return Remedy(words("python"), words("shell"), words("run_file"), words("page"), field)


def setting(field: str, label: str, value: str = "") -> Remedy:
    """Return the name of a setting for each reader: argument, option, key of a run file, or field of the page.

    `field` is its table and key in a run file, `label` that of the page's field, `value` a proposed value, text in
    quotes.
    """
    table, _, key = field.partition(".")
    typed = f"'{value}'" if " " in value and "'" not in value else value
    option = f"--{key.replace('_', '-')}"
    return Remedy(
        f"{key} = {value}" if value else f"{key}=",
        f"{option} {typed}" if value else option,
        (f"{key} = {value}" if value else key) + f" under [{table}]",
        f"“{label}”: {value}" if value else f"“{label}”",
        field,
    )


def without(name: str, after: str = "") -> Remedy:
    """Return the advice to leave out an argument, which is an option or a key of the same name."""
    said = f"leave out {name}{after}."
    return Remedy(said, f"leave out --{name.replace('_', '-')}{after}.", said)


class Note(str):
    """One sentence for people, with a code for programs.

    A note is text: it prints, joins and is stored as its sentence in the words of Python.  Programs use the code.
    """

    # What the note is about, in lower case with hyphens, such as ``"few-replicates"``. Codes stay the same when a
    # sentence is reworded.
    code: str
    text: str  # the sentence, without the remedy
    where: str  # its place, such as a file, a key of a run file or a condition; it precedes the text
    remedy: Remedy | None  # follows the text
    # For programs: text, numbers and lists of these by name, such as the headings that a file has.
    values: Mapping[str, Any]

    def __new__(
        cls,
        code: str,
        text: str,
        where: str = "",
        remedy: Remedy | None = None,
        values: Mapping[str, Any] | None = None,
    ) -> Note:
        """Return the sentence with its code."""
        said = (f"{where}: " if where else "") + text + ("" if remedy is None else remedy.python)
        note = super().__new__(cls, said)
        note.code, note.text, note.where, note.remedy = code, str(text), where, remedy
        note.values = dict(values or {})
        return note

    def __getnewargs__(  # type: ignore[override]  # pickled with all
        self,
    ) -> tuple[str, str, str, Remedy | None, Mapping[str, Any]]:
        return self.code, self.text, self.where, self.remedy, self.values

    def words(self, reader: Reader) -> str:
        """Return the sentence in the words of a reader."""
        if self.remedy is None:
            return str(self)
        return str(Note(self.code, self.text, self.where)) + self.remedy.words(reader)

    def at(self, where: str) -> Note:
        """Return the note with a wider place in front; an empty one changes nothing."""
        return Note(self.code, self.text, ": ".join(filter(None, (where, self.where))), self.remedy, self.values)

    def advising(self, more: Remedy | str) -> Note:
        """Return the note with further advice at its end."""
        return Note(self.code, self.text, self.where, (self.remedy or Remedy("")) + more, self.values)

    def coded(self, code: str) -> Note:
        """Return the note with another code."""
        return Note(code, self.text, self.where, self.remedy, self.values)

    def valued(self, **values: Any) -> Note:
        """Return the note with more values."""
        return Note(self.code, self.text, self.where, self.remedy, {**self.values, **values})

    def reworded(self, change: Callable[[str], str]) -> Note:
        """Return the note with its words changed, such as with the user's own file names."""
        remedy = None if self.remedy is None else self.remedy.reworded(change)
        return Note(self.code, change(self.text), change(self.where), remedy, self.values)

    def record(self) -> dict[str, Any]:
        """Return the note as JSON: code and text, and place, remedy and values if there are any."""
        found: dict[str, Any] = {"code": self.code, "text": self.text}
        if self.where:
            found["where"] = self.where
        if self.remedy is not None:
            found["remedy"] = {name: said for name, said in asdict(self.remedy).items() if said is not None}
        if self.values:
            found["values"] = dict(self.values)
        return found


class Warned:
    """A result with warnings, which are its notes."""

    warnings: tuple[str, ...]

    @property
    def notes(self) -> tuple[str, ...]:
        """`warnings` under the name that they have in curves, theories and materials."""
        return self.warnings


def note_of(record: Mapping[str, Any] | str) -> Note:
    """Return the note of a record; a sentence alone has no code."""
    if isinstance(record, Note):
        return record
    if isinstance(record, str):
        return Note("", record)
    remedy = record.get("remedy")
    remedy = None if remedy is None else Remedy(**remedy)
    return Note(record["code"], record["text"], record.get("where", ""), remedy, record.get("values"))


def counted(
    each: Sequence[Iterable[str]], rank: Sequence[float] | None = None, *, of: str = "contacts"
) -> tuple[Note, ...]:
    """Return the notes of many contacts (in words, `of`), one of each code, with the number of those that have it.

    Notes that are the same of all, such as those on the material, do not say so.
    Where they differ, the note is the one of the highest ``severity``, if it has this value, else that of the contact
    with the highest `rank`, or the first.
    """

    def place(number: int) -> float:
        return 0.0 if rank is None else rank[number]

    by_code: dict[str, dict[int, Note]] = {}
    for number, notes in enumerate(each):
        for note in map(note_of, notes):
            by_code.setdefault(note.code or note, {}).setdefault(number, note)
    found = []
    for with_it in by_code.values():
        shown = max(with_it, key=lambda number: (with_it[number].values.get("severity", 0.0), place(number)))
        of_all = len(with_it) == len(each) and len(set(with_it.values())) == 1
        where = "" if of_all else f"In {len(with_it)} of {len(each)} {of}"
        found.append(with_it[shown].at(where).valued(contacts=len(with_it), of=len(each)))
    return tuple(found)


def records(notes: Iterable[str]) -> list[dict[str, Any]]:
    """Return notes as JSON."""
    return [note_of(note).record() for note in notes]


def note_attributes(notes: Iterable[str]) -> dict[str, str]:
    """Return notes as attributes of a data set, none without notes: sentences, one a line, and records as JSON."""
    found = [note_of(note) for note in notes]
    return {"notes": "\n".join(found), "note_records": dumped(records(found))} if found else {}


def dumped(record: Any) -> str:
    """Return records of notes as JSON on one line."""
    return json.dumps(plain(record, None), ensure_ascii=False)


def notes_in(attributes: Mapping[Any, Any], name: str) -> tuple[Note, ...]:
    """Return an attribute of results that is a list of notes: as JSON, as it is stored, or as it is."""
    found = from_json(attributes.get(name, []))
    return tuple(map(note_of, [found] if isinstance(found, str) and found else found))


def table_in(attributes: Mapping[Any, Any], name: str) -> dict[str, str]:
    """Return an attribute of results that is a mapping of texts, see `notes_in`."""
    found = from_json(attributes.get(name, {}))
    return {str(key): str(value) for key, value in found.items()} if isinstance(found, dict) else {}


def from_json(value: Any) -> Any:
    """Return what a text of JSON holds; all else as it is."""
    if not isinstance(value, str):
        return value
    try:
        return json.loads(value)
    except ValueError:
        return value


def listed(name: str, notes: Iterable[str], reader: Reader = "python") -> dict[str, list[Any]]:
    """Return notes as two entries of a JSON object: sentences under `name`, and their records."""
    found = [note_of(note) for note in notes]
    sentences = [note.words(reader) for note in found]
    return {name: sentences, f"{name.removesuffix('s')}_records": plain(records(found), None)}


def codes(notes: Iterable[str]) -> set[str]:
    """Return the codes of those notes that have one."""
    return {note.code for note in notes if isinstance(note, Note) and note.code}


@contextmanager
def warned() -> Iterator[list[Note]]:
    """Collect the notes issued as warnings inside, for another way of display; other warnings stay warnings."""
    found: list[Note] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield found
    for one in caught:
        said = one.message.args[0] if isinstance(one.message, Warning) and one.message.args else None
        if isinstance(said, Note):
            found.append(said)
        else:
            warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
