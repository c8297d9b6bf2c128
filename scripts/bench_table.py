"""Tables of the benchmarks, in Markdown, so that they can go into the documentation as they are."""

from __future__ import annotations


def print_table(title: str, header: tuple[str, ...], rows: list[tuple]) -> None:
    """One table with its title."""
    print(f"\n{title}\n")
    print("| " + " | ".join(header) + " |")
    print("|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(f"{value:.3f}" if isinstance(value, float) else str(value) for value in row) + " |")
