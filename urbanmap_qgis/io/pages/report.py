"""Self-contained HTML reports: a verdict, text, tables, simple charts and pictures in one file.

Its methods put constant texts into the user's language; sentences with values in them are `say`'s. A report tells by
itself how it was made (`RunFacts`), as far as its run was told by `run_told`.
"""

from __future__ import annotations

import base64
import html
import math
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...geometry.tolerances import LEAST_DIVISOR
from ...wording import known, language, say
from ..files.atomic import written_beside
from .svg import bars

_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
"""What a browser lets a report do: its own styles and pictures; no script, nothing from elsewhere. Names and reasons
in it come from files."""

_STYLE = """
body { font-family: sans-serif; color: #222; background: #fff; max-width: 62em; margin: 2em auto; padding: 0 1em;
  line-height: 1.45; overflow-wrap: anywhere; }
h1 { font-size: 1.6em; border-bottom: 3px solid #2f6f8f; padding-bottom: .3em; }
h2 { font-size: 1.2em; margin-top: 2em; color: #2f6f8f; }
div.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 1em 0; font-size: .92em; overflow-wrap: normal; }
th, td { border-bottom: 1px solid #ddd; padding: .3em .8em; text-align: left; vertical-align: top; min-width: 3.1em; }
th { background: #eef4f7; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.long { min-width: 15em; }
table.form { width: 100%; }
table.form th { width: 33%; }
p.verdict { font-size: 1.1em; padding: .7em 1em; border-left: 6px solid #7b8b95; background: #eef1f3; }
p.good { background: #e6f4ea; border-color: #1a9850; }
p.look { background: #fff4e0; border-color: #e09a2b; }
p.bad { background: #fdeaea; border-color: #d7263d; }
p.warning { background: #fff4e0; border-left: 4px solid #e09a2b; padding: .6em 1em; }
figure { margin: 1em 0; display: inline-block; max-width: 100%; }
figure img, figure svg { max-width: 100%; height: auto; }
figure.switch label { padding: .2em .8em; margin-right: .3em; border: 1px solid #2f6f8f; border-radius: .3em; }
figure.switch input { position: absolute; opacity: 0; }
figure.switch input:checked + label { background: #2f6f8f; color: #fff; }
figure.switch input:focus-visible + label { outline: 2px solid #e09a2b; }
figure.switch div { margin-top: .5em; }
figure.switch img { display: none; }
figure.switch input:nth-of-type(1):checked ~ div img:nth-of-type(1),
figure.switch input:nth-of-type(2):checked ~ div img:nth-of-type(2),
figure.switch input:nth-of-type(3):checked ~ div img:nth-of-type(3) { display: block; }
figcaption { font-size: .9em; color: #555; }
@media (max-width: 30em) {
  body { margin: .6em auto; padding: 0 .6em; font-size: .95em; }
  th, td { padding: .25em .4em; min-width: 3.6em; }
  figure.broad { overflow-x: auto; }
  figure.broad svg { min-width: 46rem; }
  figure.broad figcaption { position: sticky; left: 0; }
}
@page { size: A4; margin: 14mm; }
@media print {
  body { max-width: none; margin: 0; font-size: 10pt; }
  div.wide { overflow: visible; }
  h2 { break-after: avoid; }
  figure, tr, p, div.whole { break-inside: avoid; }
  table { font-size: 8pt; margin: .4em 0; }
  th, td { padding: .12em .6em; min-width: 0; }
  thead { display: table-header-group; }
  h2 { margin: 1em 0 .4em; }
  figure { margin: .4em 0; }
  figure svg { max-height: 110mm; }
  figure.half { width: 49%; vertical-align: top; }
  figure.switch img { display: block; margin-bottom: .5em; }
  figure.switch label { display: none; }
  p.verdict, p.warning, th { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
""".strip()

_PICTURES = ((b"\x89PNG\r\n\x1a\n", "image/png"), (b"\xff\xd8\xff", "image/jpeg"))
"""How picture files begin, and their media types."""

_SIZE = re.compile(r'<svg((?:(?!viewBox)[^>])*?)width="(\d+)" height="(\d+)"(?![^>]*viewBox)')

_WIDTH = re.compile(r'<svg[^>]*? width="(\d+)"')
_BROAD = 600
"""Pictures of more pixels are not shrunk to the width of a phone, where their words would be too small: they scroll."""

_LONG = 30
"""Texts of more letters keep a width at which they can be read, where a table is wider than its page."""

Cell = object

WORST = 10
"""So many of the worst are shown in a table or on a map."""

GOOD, LOOK, BAD = "good", "look", "bad"
"""How good a result is: it can be used; look at what is named first; it cannot be used as it is."""


@dataclass(frozen=True)
class RunFacts:
    """What a report tells of the run that made it.

    Attributes
    ----------
    work : name of the algorithm.
    version : of the program.
    crs, heights : reference and height system, as text.
    inputs, settings : by their labels, as the user knows them.
    day : of the run.
    """

    work: str
    version: str = ""
    crs: str = ""
    heights: str = ""
    inputs: Mapping[str, str] = field(default_factory=dict)
    settings: Mapping[str, str] = field(default_factory=dict)
    day: date = field(default_factory=date.today)

    def rows(self) -> dict[str, str]:
        """What is known, by its name."""
        facts = {say("Made by"): f"UrbanMap {self.version}, {self.work}".replace(" ,", ","),
                 say("Day"): self.day.isoformat(), say("Coordinate reference system"): self.crs,
                 say("Height system"): self.heights, **self.inputs}
        return {name: value for name, value in facts.items() if value}


_RUN: ContextVar[RunFacts | None] = ContextVar("run of a report", default=None)


@contextmanager
def run_told(facts: RunFacts) -> Iterator[None]:
    """Context in which reports tell `facts` of their run; of nested runs they tell the outermost, the user's."""
    before = _RUN.get()
    token = _RUN.set(before or facts)
    try:
        yield
    finally:
        _RUN.reset(token)


class Report:
    """An HTML page that is built up section by section and written in one piece.

    Parameters
    ----------
    title : heading of the page.
    """

    def __init__(self, title: str):
        self._title = title
        self._verdict = ""
        self._switchers = 0
        self._parts: list[str] = []

    def verdict(self, grade: str, text: str) -> None:
        """Say first of all what was reached, whether that is good enough and what to do; `grade`: GOOD, LOOK, BAD."""
        self._verdict = f'<p class="verdict {grade}">{html.escape(known(text))}</p>\n'

    def section(self, heading: str) -> None:
        """Begin a new section."""
        self._parts.append(f"<h2>{html.escape(known(heading))}</h2>")

    def paragraph(self, text: str) -> None:
        """Add a paragraph of plain text."""
        self._parts.append(f"<p>{html.escape(known(text))}</p>")

    def warning(self, text: str) -> None:
        """Add a paragraph that the reader must not miss."""
        self._parts.append(f'<p class="warning">{html.escape(known(text))}</p>')

    def table(self, header: Sequence[str], rows: Iterable[Sequence[Cell]], whole: bool = False) -> None:
        """Add a table; numbers are aligned right, missing ones (None, NaN) shown as a dash. `whole`: of few rows, not
        to be broken over printed pages."""
        words = "".join(f"<th>{html.escape(known(name))}</th>" for name in header)
        body = "\n".join("<tr>" + "".join(map(_cell, row)) + "</tr>" for row in rows)
        self._parts.append(f'<div class="wide{" whole" if whole else ""}"><table><thead><tr>'
                           f"{words}</tr></thead><tbody>\n{body}\n</tbody></table></div>")

    def facts(self, facts: Mapping[str, Cell], form: bool = False) -> None:
        """Add a two-column table of names and values; nothing where there are none. `form`: as wide as the page, as
        blanks are filled in by hand."""
        if not facts:
            return
        rows = "\n".join(f"<tr><th>{html.escape(known(name))}</th>{_cell(value)}</tr>" for name, value in facts.items())
        kind = ' class="form"' if form else ""
        self._parts.append(f'<div class="wide"><table{kind}><tbody>\n{rows}\n</tbody></table></div>')

    def histogram(self, values: np.ndarray, label: str, caption: str, bins: int = 24,
                  upper: float | None = None) -> None:
        """Add a bar chart of the distribution of `values`; those above `upper` fall into the last bar.

        `label` names the axis with its unit. Missing values are left out and counted in the caption.
        """
        label, caption = known(label), known(caption)
        finite = np.asarray(values, float)
        missing = int(np.count_nonzero(~np.isfinite(finite)))
        finite = finite[np.isfinite(finite)]
        if missing:
            caption = say("{caption} ({missing} without a value)", caption=caption, missing=missing)
        if not len(finite):
            self.paragraph(caption)
            return
        top = float(upper if upper is not None else finite.max())
        low = min(0.0, float(finite.min()))
        counts, edges = np.histogram(np.minimum(finite, top), bins=bins, range=(low, max(top, low + LEAST_DIVISOR)))
        self.figure(bars(counts, edges, label), caption, half=True)

    def figure(self, svg: str, caption: str, half: bool = False) -> None:
        """Add a picture given as SVG; it shrinks with the page. `half`: two of them stand side by side in print."""
        svg = _SIZE.sub(r'<svg\1viewBox="0 0 \2 \3" width="\2" height="\3"', svg, count=1)
        size = _WIDTH.search(svg)
        kind = ' class="broad"' if size and int(size[1]) > _BROAD else ' class="half"' if half else ""
        self._parts.append(f"<figure{kind}>{svg}<figcaption>{html.escape(known(caption))}</figcaption></figure>")

    def picture(self, path: str | os.PathLike, caption: str) -> None:
        """Add a picture from a PNG or JPEG file; the page holds the picture itself.

        Raises
        ------
        InputError : the file is no PNG or JPEG.
        """
        data = Path(path).read_bytes()
        media = next((media for start, media in _PICTURES if data.startswith(start)), None)
        if media is None:
            raise InputError(say("{path} is no PNG or JPEG picture: a report can hold only these.", path=path))
        text = html.escape(known(caption))
        self._parts.append(f'<figure><img src="data:{media};base64,{base64.b64encode(data).decode("ascii")}" '
                           f'alt="{text}"><figcaption>{text}</figcaption></figure>')

    def switcher(self, pictures: Sequence[tuple[str, bytes]], caption: str) -> None:
        """Add JPEG pictures of one size that a click switches between, by their names; the last is shown first."""
        self._switchers += 1
        group = f"switch{self._switchers}"
        buttons = "".join(
            f'<input type="radio" name="{group}" id="{group}_{number}"'
            f'{" checked" if number == len(pictures) else ""}>'
            f'<label for="{group}_{number}">{html.escape(name)}</label>'
            for number, (name, _) in enumerate(pictures, 1))
        images = "".join(f'<img src="data:image/jpeg;base64,{base64.b64encode(data).decode("ascii")}" '
                         f'alt="{html.escape(name)}">' for name, data in pictures)
        self._parts.append(f'<figure class="switch">{buttons}<div>{images}</div>'
                           f"<figcaption>{html.escape(caption)}</figcaption></figure>")

    def write(self, path: str | os.PathLike) -> None:
        """Write the page; it appears at `path` when it is whole.

        Raises
        ------
        OutputError : the file cannot be written there.
        """
        title = html.escape(known(self._title))
        self._about_run()
        page = (f'<!DOCTYPE html>\n<html lang="{language()}">\n<head>\n<meta charset="utf-8">\n'
                f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">\n'
                '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
                f"<title>{title}</title>\n<style>\n{_STYLE}\n</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
                + self._verdict + "\n".join(self._parts) + "\n</body>\n</html>\n")
        with written_beside(path) as temporary:
            temporary.write_text(page, encoding="utf-8")

    def note(self, text: str) -> None:
        """Add a note of whoever made the run; one of settings ("name: value; name: value") becomes a table."""
        pairs = [part.partition(": ") for part in text.split("; ")]
        if not text:
            return
        self.section(say("Note"))
        if len(pairs) > 1 and all(sign for _, sign, _ in pairs):
            self.facts({name: value for name, _, value in pairs})
        else:
            self.paragraph(text)

    def _about_run(self) -> None:
        """Add what the run was, as far as it was told."""
        facts = _RUN.get()
        if facts is None:
            return
        self.section(say("How this was made"))
        self.facts(facts.rows())
        if facts.settings:
            self.section(say("Settings"))
            self.facts(facts.settings)


class Fixed(str):
    """A number as text with the decimals that it needs, as GPS seconds and coordinates have; set like a number."""

    @classmethod
    def of(cls, value: float, decimals: int = 2) -> Fixed:
        text = f"{value:.{decimals}f}" if math.isfinite(value) else "–"
        return cls(text if text.strip("-0.") else text.lstrip("-"))  # nothing is -0


def percent(share: float) -> Fixed:
    """A share, 0 to 1, in whole percent; a dash where it is not known."""
    return Fixed(f"{100.0 * share:.0f} %" if math.isfinite(share) else "–")


def rounded(value: float) -> str:
    """A number with as many decimals as it means: three below 1, two below 100, one below 1000, none above; 0 where
    four decimals show nothing."""
    size = abs(value)
    if size < 0.00005:
        return "0"
    if size < 0.001:
        return f"{value:.4f}"
    whole = size >= 1000 or (size >= 100 and value == int(value))
    return f"{value:,.{0 if whole else 1 if size >= 100 else 2 if size >= 1 else 3}f}"


def _cell(value: Cell) -> str:
    """One table cell."""
    if value is None or (isinstance(value, (float, np.floating)) and not math.isfinite(value)):
        return '<td class="number">–</td>'
    if isinstance(value, (bool, np.bool_)):
        return f"<td>{html.escape(say('yes') if value else say('no'))}</td>"
    if isinstance(value, (int, np.integer)):
        return f'<td class="number">{int(value):,}</td>'
    if isinstance(value, (float, np.floating)):
        return f'<td class="number">{rounded(float(value))}</td>'
    if isinstance(value, Fixed):
        return f'<td class="number">{value}</td>'
    text = known(str(value))
    long = ' class="long"' if len(text) > _LONG else ""
    return f"<td{long}>{html.escape(text)}</td>"
