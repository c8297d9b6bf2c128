"""The textures of a building's facades packed into a few images."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

LARGEST = 4096
"""Rows and columns of an image at most."""

_MARGIN = 2
"""Border pixels repeated round each texture, so that neighbours do not bleed into it."""


@dataclass(frozen=True)
class AtlasPlace:
    """Where a texture lies: number of the image, its first row and column there."""

    page: int
    row: int
    column: int


def pack_textures(shapes: Sequence[tuple[int, int]]) -> list[AtlasPlace]:
    """Places for textures of the given rows and columns, in shelves of falling height.

    Textures larger than `LARGEST` less the margins must be made smaller before (see `coarsest_step`).
    """
    order = sorted(range(len(shapes)), key=lambda number: (-shapes[number][0], number))
    placed: list[AtlasPlace | None] = [None] * len(shapes)
    page = top = left = shelf = 0
    for number in order:
        rows, columns = (side + 2 * _MARGIN for side in shapes[number])
        if left + columns > LARGEST:
            top, left, shelf = top + shelf, 0, 0
        if top + rows > LARGEST:
            page, top, left, shelf = page + 1, 0, 0, 0
        placed[number] = AtlasPlace(page, top + _MARGIN, left + _MARGIN)
        left, shelf = left + columns, max(shelf, rows)
    return placed


def coarsest_step(width: float, height: float, step: float) -> float:
    """The texel's side (m) with which a facade fits into an image: `step`, or larger for a very large facade."""
    return max(step, max(width, height) / (LARGEST - 2 * _MARGIN - 1))


def draw_atlas(textures: Sequence[np.ndarray], placed: Sequence[AtlasPlace]) -> list[np.ndarray]:
    """The images (rows, columns, 3) uint8 with all textures in their places, each no larger than needed."""
    pages = []
    for page in range(max((place.page for place in placed), default=-1) + 1):
        of_page = [(texture, place) for texture, place in zip(textures, placed) if place.page == page]
        rows = max(place.row + texture.shape[0] for texture, place in of_page) + _MARGIN
        columns = max(place.column + texture.shape[1] for texture, place in of_page) + _MARGIN
        image = np.zeros((rows, columns, 3), np.uint8)
        for texture, place in of_page:
            wide = np.pad(texture, ((_MARGIN, _MARGIN), (_MARGIN, _MARGIN), (0, 0)), mode="edge")
            image[place.row - _MARGIN:place.row - _MARGIN + wide.shape[0],
                  place.column - _MARGIN:place.column - _MARGIN + wide.shape[1]] = wide
        pages.append(image)
    return pages
