"""Text tables as people and spreadsheets write them."""

from __future__ import annotations

from pathlib import Path

from readers.samples.rubber import points


def plain(folder: Path) -> Path:
    """Write one row of headings, units in brackets, commas between columns."""
    rows = [f"{T:g},{f:g},{s / 1e6:.6g},{loss / 1e6:.6g}" for T, f, s, loss in points()]
    path = folder / "plain.csv"
    path.write_text("\n".join(["# synthetic", "T (degC),f (Hz),E' (MPa),E'' (MPa)", *rows, ""]), encoding="utf-8")
    return path


def two_rows(folder: Path) -> Path:
    """Write names in one row, units in the next, number of the set last; UTF-8 with its mark, as pyvisco wants it."""
    rows = [f"{f:g},{s / 1e6:.6g},{loss / 1e6:.6g},{T:g},{n // 5}" for n, (T, f, s, loss) in enumerate(points())]
    path = folder / "two_rows.csv"
    path.write_text("\n".join(["f,E_stor,E_loss,T,Set", "Hz, MPa, MPa, C, -", *rows, ""]), encoding="utf-8-sig")
    return path


def german(folder: Path) -> Path:
    """Write lines above the header, decimal commas, the names of a German spreadsheet in the Windows code page."""
    rows = [f"{T:g};{f:g};{s / 1e6:.6g};{loss / 1e6:.6g};0,1".replace(".", ",") for T, f, s, loss in points()]
    header = "Temperatur (°C);Frequenz (Hz);Speichermodul (N/mm²);Verlustmodul (N/mm²);Dehnung (%)"
    path = folder / "deutsch.csv"
    lines = ["Prüfbericht 12;synthetisch", "Prüfer: n. n.", "Einspannung;Zug", header, *rows, ""]
    path.write_bytes("\r\n".join(lines).encode("cp1252"))
    return path


def shear_in_utf16(folder: Path) -> Path:
    """Write shear moduli over angular frequency, tabs, UTF-16 with its mark."""
    rows = [f"{f * 6.283185307:.8g}\t{T + 273.15:g}\t{s / 3:.6g}\t{loss / 3:.6g}" for T, f, s, loss in points()]
    path = folder / "shear.txt"
    path.write_bytes("\n".join(["ω / rad/s\tT / K\tG' / Pa\tG'' / Pa", *rows, ""]).encode("utf-16"))
    return path


SAMPLES = {
    "delimited: plain": plain,
    "delimited: two rows": two_rows,
    "delimited: German": german,
    "delimited: shear in UTF-16": shear_in_utf16,
}
