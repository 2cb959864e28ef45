"""Tables of heights: what is read, and what is refused in one sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from readers.refusal import refused
from viscofric.readers.topography.tables import read_heights

if TYPE_CHECKING:
    from pathlib import Path

WANTED = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.5]])


@pytest.mark.parametrize(
    "text",
    ["1,2,3\n4,5,6.5\n", "# heights\n1;2;3;\n4;5;6.5;\n", "  1 2\t3\r\n\r\n 4  5 6.5\r\n", "1, 2, 3\n4, 5, 6.5"],
    ids=["commas", "semicolons", "blanks", "commas and blanks"],
)
def test_numbers_are_parted_by_what_people_use(text: str, tmp_path: Path) -> None:
    (tmp_path / "z.txt").write_bytes(text.encode())
    np.testing.assert_array_equal(read_heights(tmp_path / "z.txt"), WANTED)
    # One rounding of the unit.
    np.testing.assert_allclose(read_heights(tmp_path / "z.txt", "um"), 1e-6 * WANTED, rtol=1e-15)


def test_saved_arrays_are_read(tmp_path: Path) -> None:
    np.save(tmp_path / "z.npy", WANTED)
    np.testing.assert_array_equal(read_heights(tmp_path / "z.npy"), WANTED)
    np.save(tmp_path / "one.npy", np.arange(5))
    np.testing.assert_array_equal(read_heights(tmp_path / "one.npy"), np.arange(5.0)[:, None])


@pytest.mark.parametrize(
    ("text", "refusal"),
    [
        ("1,2\n3\n", ("row-length", 2, "1 heights", "2")),
        ("x,y\n1,2\n", ("not-a-number", 1, "'x,y'")),
        ("# nothing\n", ("no-points",)),
        ("1,nan\n2,3\n", ("not-a-number",)),
    ],
)
def test_what_is_no_table_is_refused(text: str, refusal: tuple[str, ...], tmp_path: Path) -> None:
    (tmp_path / "z.txt").write_text(text, encoding="utf-8")
    with refused(*refusal):
        read_heights(tmp_path / "z.txt")


@pytest.mark.parametrize(
    "array", [np.zeros((2, 2, 2)), np.array([1j]), np.zeros((0, 3))], ids=["3-D", "complex", "empty"]
)
def test_other_arrays_are_refused(array: np.ndarray, tmp_path: Path) -> None:
    np.save(tmp_path / "z.npy", array)
    with refused("not-heights"):
        read_heights(tmp_path / "z.npy")


def test_damaged_arrays_and_wrong_units_are_refused(tmp_path: Path) -> None:
    np.save(tmp_path / "z.npy", WANTED)
    (tmp_path / "z.npy").write_bytes((tmp_path / "z.npy").read_bytes()[:100])
    with refused("damaged"):
        read_heights(tmp_path / "z.npy")
    with refused("wrong-unit"):
        read_heights(tmp_path / "z.npy", "kg")
