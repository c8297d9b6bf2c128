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
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
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
from .print_plan import (
    PAGE_WIDTH,
    VERDICT,
    PrintedBlock,
    figure_block,
    heading_block,
    page_map,
    paragraph_block,
    place_picture,
    table_block,
)
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
  figure.planned, figure.planned svg { display: block; width: 100%; max-height: none; }
  figure.half { width: 49%; vertical-align: top; }
  figure.switch img { display: block; margin-bottom: .5em; }
  figure.switch label { display: none; }
  p.verdict, p.warning, th { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
""".strip()

_PICTURES = ((b"\x89PNG\r\n\x1a\n", "image/png"), (b"\xff\xd8\xff", "image/jpeg"))
"""How picture files begin, and their media types."""

_SIZE = re.compile(r'<svg((?:(?!viewBox)[^>])*?)width="(\d+)" height="(\d+)"(?![^>]*viewBox)')

_BOX = re.compile(r'<svg[^>]*? viewBox="0 0 (\S+) (\S+)"')
_TAG = re.compile("<[^>]*>")
_WIDTH = re.compile(r'<svg[^>]*? width="(\d+)"')
_BROAD = 600
"""Pictures of more pixels are not shrunk to the width of a phone, where their words would be too small: they scroll."""

_LONG = 30
"""Texts of more letters keep a width at which they can be read, where a table is wider than its page."""

Cell = object

WORST = 10
"""So many of the worst are shown in a table or on a map."""

PIXELS = 4.0
"""Of a drawing whose height in print is planned, in a millimetre of the page."""
_TITLE = 16.0
"""Size of the letters of a page's title in print, points."""
_PICTURE = 114.0
"""Height of other pictures in print, mm: the most that they have there, with their captions."""

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


@dataclass(frozen=True)
class _Part:
    """A part of a page as HTML, and as what runs down printed pages; `is_half`: the next picture may stand beside."""

    html: str
    block: Callable[[], PrintedBlock]
    begins_section: bool = False
    is_half: bool = False


@dataclass(frozen=True)
class _Planned:
    """A section of one drawing, whose place and height follow from the pages that it is printed on."""

    heading: str
    caption: str
    drawing: Callable[..., str]
    shape: float


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
        self._parts: list[_Part] = []
        self._planned: tuple[int, _Planned] | None = None
        self._verdict_text = ""

    def verdict(self, grade: str, text: str) -> None:
        """Say first of all what was reached, whether that is good enough and what to do; `grade`: GOOD, LOOK, BAD."""
        self._verdict_text = known(text)
        self._verdict = f'<p class="verdict {grade}">{html.escape(self._verdict_text)}</p>\n'

    def section(self, heading: str) -> None:
        """Begin a new section."""
        self._parts.append(_heading(known(heading)))

    def paragraph(self, text: str) -> None:
        """Add a paragraph of plain text."""
        words = known(text)
        self._parts.append(_Part(f"<p>{html.escape(words)}</p>", lambda: paragraph_block(words)))

    def warning(self, text: str) -> None:
        """Add a paragraph that the reader must not miss."""
        words = known(text)
        self._parts.append(_Part(f'<p class="warning">{html.escape(words)}</p>',
                                 lambda: paragraph_block(words, around=4.5)))

    def table(self, header: Sequence[str], rows: Iterable[Sequence[Cell]], whole: bool = False) -> None:
        """Add a table; numbers are aligned right, missing ones (None, NaN) shown as a dash. `whole`: of few rows, not
        to be broken over printed pages."""
        head, rows = [known(name) for name in header], list(rows)
        words = "".join(f"<th>{html.escape(name)}</th>" for name in head)
        body = "\n".join("<tr>" + "".join(map(_cell, row)) + "</tr>" for row in rows)
        self._parts.append(_Part(f'<div class="wide{" whole" if whole else ""}"><table><thead><tr>'
                                 f"{words}</tr></thead><tbody>\n{body}\n</tbody></table></div>",
                                 lambda: table_block([head, *(list(map(_cell_text, row)) for row in rows)], True,
                                                     whole)))

    def facts(self, facts: Mapping[str, Cell], form: bool = False) -> None:
        """Add a two-column table of names and values; nothing where there are none. `form`: as wide as the page, as
        blanks are filled in by hand."""
        if not facts:
            return
        words = [(known(name), value) for name, value in facts.items()]
        rows = "\n".join(f"<tr><th>{html.escape(name)}</th>{_cell(value)}</tr>" for name, value in words)
        kind = ' class="form"' if form else ""
        self._parts.append(_Part(f'<div class="wide"><table{kind}><tbody>\n{rows}\n</tbody></table></div>',
                                 lambda: table_block([(name, _cell_text(value)) for name, value in words], False)))

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
        words = known(caption)
        second = half and bool(self._parts) and self._parts[-1].is_half
        block = PrintedBlock(()) if second else figure_block(_printed_height(svg, half), words)
        self._parts.append(_Part(f"<figure{kind}>{svg}<figcaption>{html.escape(words)}</figcaption></figure>",
                                 lambda: block, is_half=half and not second))

    def planned_figure(self, heading: str, drawing: Callable[..., str], caption: str, shape: float) -> None:
        """Add a section of one picture that is made to fill the pages it is printed on; a page has one at most.

        Parameters
        ----------
        drawing : makes the picture (SVG) of a `width` and `height`, pixels.
        shape : height by width at which it looks best.

        The section comes here or behind the next one, and its height is chosen so that in print few pages are needed
        and none is left half empty, as far as that can be.
        """
        self._planned = len(self._parts), _Planned(known(heading), known(caption), drawing, shape)

    def _place_planned(self) -> None:
        """Make the picture whose height is planned, and put it where it leaves the least of the pages empty."""
        if self._planned is None:
            return
        first, asked = self._planned
        behind = [number for number, part in enumerate(self._parts) if part.begins_section and number >= first][1:2]
        second = behind[0] if behind else len(self._parts)
        top = [PrintedBlock((1.45 * _TITLE * 25.4 / 72 + 6.4,))]
        top += [paragraph_block(self._verdict_text, VERDICT, around=8.0)] if self._verdict_text else []
        blocks = [part.block() for part in self._parts]
        heading, frame = heading_block(asked.heading), figure_block(0.0, asked.caption)
        picture = page_map((heading, frame), asked.shape)
        place, height = place_picture([*top, *blocks], [len(top) + first, len(top) + second], picture)
        svg = asked.drawing(width=round(PIXELS * PAGE_WIDTH), height=round(PIXELS * height))
        svg = _SIZE.sub(r'<svg\1viewBox="0 0 \2 \3" width="\2" height="\3"', svg, count=1)
        part = _Part(f'<figure class="broad planned">{svg}<figcaption>{html.escape(asked.caption)}</figcaption>'
                     "</figure>", lambda: figure_block(height, asked.caption))
        self._parts[place - len(top):place - len(top)] = [_heading(asked.heading), part]

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
        self._parts.append(_Part(f'<figure><img src="data:{media};base64,{base64.b64encode(data).decode("ascii")}" '
                                 f'alt="{text}"><figcaption>{text}</figcaption></figure>',
                                 lambda: PrintedBlock((_PICTURE,))))

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
        self._parts.append(_Part(f'<figure class="switch">{buttons}<div>{images}</div>'
                                 f"<figcaption>{html.escape(caption)}</figcaption></figure>",
                                 lambda: PrintedBlock((_PICTURE,) * len(pictures))))

    def write(self, path: str | os.PathLike) -> None:
        """Write the page; it appears at `path` when it is whole.

        Raises
        ------
        OutputError : the file cannot be written there.
        """
        title = html.escape(known(self._title))
        self._about_run()
        self._place_planned()
        page = (f'<!DOCTYPE html>\n<html lang="{language()}">\n<head>\n<meta charset="utf-8">\n'
                f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">\n'
                '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
                f"<title>{title}</title>\n<style>\n{_STYLE}\n</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
                + self._verdict + "\n".join(part.html for part in self._parts) + "\n</body>\n</html>\n")
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


def _heading(words: str) -> _Part:
    """The heading of a section."""
    return _Part(f"<h2>{html.escape(words)}</h2>", lambda: heading_block(words), begins_section=True)


def _printed_height(svg: str, half: bool) -> float:
    """How high a drawing stands on a printed page, mm: half of a pair has nothing beside the other."""
    size = _BOX.search(svg)
    if not size:
        return _PICTURE
    width, height = float(size[1]), float(size[2])
    room = 0.49 * PAGE_WIDTH if half else min(PAGE_WIDTH, width * 25.4 / 96)
    return min(height / width * room, 110.0)


def _cell_text(value: Cell) -> str:
    """What a cell shows."""
    return html.unescape(_TAG.sub("", _cell(value)))


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
