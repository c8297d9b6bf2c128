"""Self-contained HTML reports: text, tables, simple charts and pictures in one file."""

from __future__ import annotations

import base64
import html
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from ..errors import InputError
from .atomic import written_beside
from .svg import bars

_STYLE = """
body { font-family: sans-serif; color: #222; max-width: 62em; margin: 2em auto; padding: 0 1em;
  line-height: 1.45; }
h1 { font-size: 1.6em; border-bottom: 3px solid #2f6f8f; padding-bottom: .3em; }
h2 { font-size: 1.2em; margin-top: 2em; color: #2f6f8f; }
table { border-collapse: collapse; margin: 1em 0; font-size: .92em; }
th, td { border-bottom: 1px solid #ddd; padding: .3em .8em; text-align: left; vertical-align: top; }
th { background: #eef4f7; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
p.warning { background: #fff4e0; border-left: 4px solid #e09a2b; padding: .6em 1em; }
figure { margin: 1em 0; display: inline-block; }
figure img { max-width: 100%; }
figcaption { font-size: .9em; color: #555; }
""".strip()

_PICTURES = ((b"\x89PNG\r\n\x1a\n", "image/png"), (b"\xff\xd8\xff", "image/jpeg"))
"""How picture files begin, and their media types."""

Cell = object


class Report:
    """An HTML page that is built up section by section and written in one piece.

    Parameters
    ----------
    title : heading of the page.
    language : language code of the texts, for the page's header.
    """

    def __init__(self, title: str, language: str = "en"):
        self._title = title
        self._language = language
        self._parts: list[str] = []

    def section(self, heading: str) -> None:
        """Begin a new section."""
        self._parts.append(f"<h2>{html.escape(heading)}</h2>")

    def paragraph(self, text: str) -> None:
        """Add a paragraph of plain text."""
        self._parts.append(f"<p>{html.escape(text)}</p>")

    def warning(self, text: str) -> None:
        """Add a paragraph that the reader must not miss."""
        self._parts.append(f'<p class="warning">{html.escape(text)}</p>')

    def table(self, header: Sequence[str], rows: Iterable[Sequence[Cell]]) -> None:
        """Add a table; numbers are aligned right, missing ones (None, NaN) shown as a dash."""
        head = "".join(f"<th>{html.escape(name)}</th>" for name in header)
        body = "\n".join("<tr>" + "".join(map(_cell, row)) + "</tr>" for row in rows)
        self._parts.append(f"<table><thead><tr>{head}</tr></thead><tbody>\n{body}\n</tbody></table>")

    def facts(self, facts: Mapping[str, Cell]) -> None:
        """Add a two-column table of names and values."""
        rows = "\n".join(f"<tr><th>{html.escape(name)}</th>{_cell(value)}</tr>"
                         for name, value in facts.items())
        self._parts.append(f"<table><tbody>\n{rows}\n</tbody></table>")

    def histogram(self, values: np.ndarray, label: str, caption: str, bins: int = 24,
                  upper: float | None = None) -> None:
        """Add a bar chart of the distribution of `values`; those above `upper` fall into the last bar.

        `label` names the axis with its unit. Missing values are left out and counted in the caption.
        """
        finite = np.asarray(values, float)
        missing = int(np.count_nonzero(~np.isfinite(finite)))
        finite = finite[np.isfinite(finite)]
        if missing:
            caption = f"{caption} ({missing} without a value)"
        if not len(finite):
            self.paragraph(caption)
            return
        top = float(upper if upper is not None else finite.max())
        low = min(0.0, float(finite.min()))
        counts, edges = np.histogram(np.minimum(finite, top), bins=bins, range=(low, max(top, low + 1e-9)))
        self.figure(bars(counts, edges, label), caption)

    def figure(self, svg: str, caption: str) -> None:
        """Add a picture given as SVG."""
        self._parts.append(f"<figure>{svg}<figcaption>{html.escape(caption)}</figcaption></figure>")

    def picture(self, path: str | os.PathLike, caption: str) -> None:
        """Add a picture from a PNG or JPEG file; the page holds the picture itself.

        Raises
        ------
        InputError : the file is no PNG or JPEG.
        """
        data = Path(path).read_bytes()
        media = next((media for start, media in _PICTURES if data.startswith(start)), None)
        if media is None:
            raise InputError(f"{path} is no PNG or JPEG picture: a report can hold only these.")
        text = html.escape(caption)
        self._parts.append(f'<figure><img src="data:{media};base64,{base64.b64encode(data).decode("ascii")}" '
                           f'alt="{text}"><figcaption>{text}</figcaption></figure>')

    def write(self, path: str | os.PathLike) -> None:
        """Write the page; it appears at `path` when it is whole.

        Raises
        ------
        OutputError : the file cannot be written there.
        """
        title = html.escape(self._title)
        page = (f'<!DOCTYPE html>\n<html lang="{self._language}">\n<head>\n<meta charset="utf-8">\n'
                f"<title>{title}</title>\n<style>\n{_STYLE}\n</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
                + "\n".join(self._parts) + "\n</body>\n</html>\n")
        with written_beside(path) as temporary:
            temporary.write_text(page, encoding="utf-8")


def _cell(value: Cell) -> str:
    """One table cell."""
    if value is None or (isinstance(value, (float, np.floating)) and not math.isfinite(value)):
        return '<td class="number">–</td>'
    if isinstance(value, (bool, np.bool_)):
        return f"<td>{'yes' if value else 'no'}</td>"
    if isinstance(value, (int, np.integer)):
        return f'<td class="number">{int(value):,}</td>'
    if isinstance(value, (float, np.floating)):
        return f'<td class="number">{float(value):,.3f}</td>'
    return f"<td>{html.escape(str(value))}</td>"
