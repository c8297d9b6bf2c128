"""Tables as CSV that spreadsheets open without asking for the encoding."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable, Sequence

from .atomic import written_beside


def write_excel_table(path: str | os.PathLike, rows: Iterable[Sequence[object]]) -> None:
    """Write rows, the first with the columns' names, as CSV in UTF-8 with the mark by which Excel knows it.

    Raises
    ------
    OutputError : the file cannot be written there.
    """
    with written_beside(path) as temporary, temporary.open("w", encoding="utf-8-sig", newline="") as stream:
        csv.writer(stream).writerows(rows)
