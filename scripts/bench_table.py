"""Tables of benchmarks and judges, in Markdown, so that they can go into the documentation as they are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass


def table_lines(header: Sequence[str], rows: Iterable[Sequence]) -> list[str]:
    """Lines of a table; numbers with three decimals."""
    cells = [[f"{value:.3f}" if isinstance(value, float) else str(value) for value in row] for row in rows]
    return ["| " + " | ".join(header) + " |", "|" + "---|" * len(header),
            *("| " + " | ".join(row) + " |" for row in cells)]


def print_table(title: str, header: Sequence[str], rows: Iterable[Sequence]) -> None:
    """One table with its title."""
    print("\n".join(["", title, "", *table_lines(header, rows)]))


@dataclass(frozen=True)
class Table:
    """A table of results, with the paper's own figures beside them."""

    title: str
    header: tuple[str, ...]
    rows: list[tuple]
    note: str = ""

    def markdown(self) -> str:
        """As text."""
        note = [self.note, ""] if self.note else []
        return "\n".join([f"### {self.title}", "", *table_lines(self.header, self.rows), "", *note])
