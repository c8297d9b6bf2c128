"""Heights of pictures on printed pages: as many millimetres as leave no page half empty.

Blocks run down pages of A4 one after the other. Tables break between their rows; text and pictures do not break. A
picture that may have several heights gets the one that needs the fewest pages and leaves the least of them empty.
"""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass, replace

PAGE_HEIGHT, PAGE_WIDTH = 269.0, 182.0
"""What a page of A4 has between its margins of 14 mm, mm."""

POINT = 25.4 / 72.0
"""mm."""
LINE = 1.45
"""Height of a line by the size of its letters."""
LETTER = 0.44
"""Mean width of a letter by its size; Japanese letters are as wide as high."""
TEXT, HEADING, VERDICT, CELL, CAPTION = 10.0, 12.0, 11.0, 8.0, 9.0
"""Sizes of letters, points."""
CELL_ROOM = 1.2 * CELL * POINT
"""Empty at both sides of a cell together, mm."""

LOWEST, LEGIBLE, TALLEST = 58.0, 85.0, 190.0
"""Heights of maps, mm: the least of all, what one of an area as high as wide has at least, the most of all."""
FLATTEST = 0.6
"""Height by width to which a map may grow beyond its shape."""

_SPARE = 5.0
"""Left free on a page, mm, as lines that a browser breaks cannot be foreseen to the millimetre."""
_STEP = 2.0
"""Between heights that are tried, mm."""


@dataclass(frozen=True)
class PrintedBlock:
    """What runs down the pages.

    Attributes
    ----------
    pieces : height of each part that does not break, mm, with what is free below it.
    head : height of what each further page repeats, mm; the first page's stands in `pieces`.
    with_next : it stays on the page of what follows.
    """

    pieces: tuple[float, ...]
    head: float = 0.0
    with_next: bool = False


@dataclass(frozen=True)
class Picture:
    """A picture whose height is to be chosen.

    Attributes
    ----------
    frame : blocks of its heading and, the last, of what it needs besides its height.
    least, most, wished : of its height, mm.
    """

    frame: tuple[PrintedBlock, ...]
    least: float
    most: float
    wished: float


@dataclass(frozen=True)
class Filling:
    """How far pages are filled.

    Attributes
    ----------
    pages : their number.
    empty : what is left empty at the foot of all but the last, mm.
    last : how far down the last one is filled, mm.
    """

    pages: int
    empty: float
    last: float


def text_lines(text: str, width: float, size: float) -> int:
    """About how many lines a text of letters of `size` points takes in `width` mm."""
    return max(1, math.ceil(text_width(text, size) / width))


def text_width(text: str, size: float) -> float:
    """About how wide a text of letters of `size` points is, mm."""
    wide = sum(unicodedata.east_asian_width(letter) in "WF" for letter in text)
    return (wide + LETTER * (len(text) - wide)) * size * POINT


def paragraph_block(text: str, size: float = TEXT, around: float = 0.0) -> PrintedBlock:
    """Block of a paragraph with `around` mm of its own frame."""
    lines = text_lines(text, PAGE_WIDTH - around, size)
    return PrintedBlock((lines * LINE * size * POINT + size * POINT + around,))


def heading_block(text: str) -> PrintedBlock:
    """Block of a heading of a section."""
    lines = text_lines(text, PAGE_WIDTH, HEADING)
    return PrintedBlock(((LINE * lines + 1.4) * HEADING * POINT,), with_next=True)


def table_block(rows: Sequence[Sequence[str]], with_head: bool, whole: bool = False) -> PrintedBlock:
    """Block of a table by the texts of its cells; the first row is repeated on each page if it is a head. `whole`: it
    does not break."""
    columns = list(zip(*rows))
    wide = [max(text_width(text, CELL) for text in column) + CELL_ROOM for column in columns]
    share = min(1.0, PAGE_WIDTH / sum(wide)) if wide else 1.0
    room = [width * share - CELL_ROOM * share + 0.01 for width in wide]
    line = LINE * CELL * POINT
    heights = [max((text_lines(text, width, CELL) for text, width in zip(row, room)), default=1) * line
               + 0.24 * CELL * POINT + 0.27 for row in rows]
    margins = 0.4 * CELL * POINT
    if whole:
        return PrintedBlock((sum(heights) + margins,))
    if with_head and len(heights) > 1:  # a head alone at the foot of a page does not stand there
        return PrintedBlock((heights[0] + heights[1] + margins, *heights[2:]), head=heights[0])
    return PrintedBlock((*heights[:-1], *(height + margins for height in heights[-1:])))


def figure_block(height: float, caption: str) -> PrintedBlock:
    """Block of a picture with its caption."""
    return PrintedBlock((height + text_lines(caption, PAGE_WIDTH, CAPTION) * LINE * CAPTION * POINT + 1.8,))


def fill_pages(blocks: Sequence[PrintedBlock], page: float = PAGE_HEIGHT) -> Filling:
    """Let blocks run down pages of a height, mm."""
    reached, empty, pages = 0.0, 0.0, 1
    for number, block in enumerate(blocks):
        for row, piece in enumerate(block.pieces):
            follows = 0.0
            following = number
            while row == 0 and blocks[following].with_next and following + 1 < len(blocks):
                following += 1
                follows += blocks[following].pieces[0] if blocks[following].pieces else 0.0
            if reached and reached + piece + follows > page:
                empty, pages = empty + page - reached, pages + 1
                reached = block.head if row else 0.0
            reached += piece
    return Filling(pages, empty, reached)


def page_map(frame: Sequence[PrintedBlock], shape: float, width: float = PAGE_WIDTH) -> Picture:
    """A map that is `width` mm wide and looks best at a `shape` (height by width): not so low that its points run into
    each other, and higher than its shape asks for only as far as that fills a page."""
    wished = min(max(shape * width, LOWEST), TALLEST)
    return Picture(tuple(frame), min(max(0.5 * wished, LOWEST), LEGIBLE), max(wished, FLATTEST * width), wished)


def place_picture(blocks: Sequence[PrintedBlock], places: Sequence[int], picture: Picture,
                  page: float = PAGE_HEIGHT - _SPARE) -> tuple[int, float]:
    """Where among blocks a picture goes (before the block of that number), and its height, mm, on pages of a height.

    Fewest pages first, then the least of them empty (a last page filled by half is full enough), then the first of the
    places, then the height nearest to the one wished for.
    """
    steps = int(max(picture.most - picture.least, 0.0) / _STEP)
    heights = [picture.least + _STEP * step for step in range(steps + 1)]

    def cost(place: int, height: float) -> tuple:
        *before, frame = picture.frame
        whole = replace(frame, pieces=(frame.pieces[0] + height,))
        filling = fill_pages([*blocks[:place], *before, whole, *blocks[place:]], page)
        return *unfilled(filling, page), places.index(place), abs(height - picture.wished)

    return min(((place, height) for place in places for height in heights), key=lambda tried: cost(*tried))


def unfilled(filling: Filling, page: float = PAGE_HEIGHT) -> tuple[int, int]:
    """Pages, and what of them is empty beyond a half-filled last one in steps of 10 mm: the less the better."""
    last = max(0.0, 0.5 * page - filling.last) if filling.pages > 1 else 0.0
    return filling.pages, round((filling.empty + last) / 10.0)
