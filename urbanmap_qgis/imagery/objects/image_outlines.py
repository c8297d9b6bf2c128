"""Outlines drawn on images: from a layer's coordinates to pixels.

QGIS shows an image without a place with x along its columns and y downwards negative, both from the image's corner:
(0, 0) is the upper left corner of the first pixel, (12.5, -3.5) the middle of the pixel in column 12, row 3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely

from ...errors import InputError, InsufficientDataError
from ...wording import say
from ..views.views import Source

POLYGON, LINE, POINT = "polygon", "line", "point"

_KINDS = {0: POINT, 4: POINT, 1: LINE, 5: LINE, 3: POLYGON, 6: POLYGON}


@dataclass(frozen=True, eq=False)
class ImageOutline:
    """An outline drawn on an image.

    Attributes
    ----------
    feature : row of the layer it came from.
    kind : "polygon", "line" or "point".
    source : the image.
    pixels : geometry in columns and rows; 0, 0 is the middle of the first pixel.
    """

    feature: int
    kind: str
    source: Source
    pixels: shapely.Geometry


def image_outlines(geometries: Sequence[shapely.Geometry | None], images: Sequence[str | None] | None,
                   sources: Sequence[Source]) -> list[ImageOutline]:
    """Outlines of a layer on their images; parts of multi-geometries become outlines of their own.

    Parameters
    ----------
    geometries : polygons, lines or points in the coordinates in which QGIS shows the images.
    images : name of the image of each, with or without folder and ending; None where there is one image only.

    Raises
    ------
    InputError : a feature does not say which image, names an unknown one, or lies outside its image.
    InsufficientDataError : there is no outline.
    """
    found = []
    for number, geometry in enumerate(geometries):
        if geometry is None or shapely.is_empty(geometry):
            continue
        source = _source_of(number, images[number] if images is not None else None, sources)
        for part in shapely.get_parts(shapely.force_2d(geometry)):
            found.append(ImageOutline(number, _KINDS[int(shapely.get_type_id(part))], source, _pixels(part)))
            _require_inside(number, found[-1])
    if not found:
        raise InsufficientDataError(say("No outline was drawn: draw polygons, lines or points on the images first."))
    return found


def _source_of(number: int, name: str | None, sources: Sequence[Source]) -> Source:
    if name is None or not str(name).strip():
        if len(sources) == 1:
            return sources[0]
        raise InputError(say("Outline {number} does not say on which of the {sources_count} images it was drawn: "
                             "fill the field “image” with the file's name.", number=number + 1,
                             sources_count=len(sources)))
    wanted = Path(str(name).replace("\\", "/")).name.casefold()
    for source in sources:
        if wanted in (source.name.casefold(), Path(source.name).stem.casefold()):
            return source
    known = ", ".join(source.name for source in sources[:5])
    raise InputError(say("Outline {number} was drawn on {name}, which was not given (images: {known}): add the image "
                         "or correct the field “image”.", number=number + 1, name=name, known=known))


def _pixels(part: shapely.Geometry) -> shapely.Geometry:
    """Columns and rows of an outline in QGIS's coordinates."""
    return shapely.transform(part, lambda xy: np.column_stack([xy[:, 0] - 0.5, -xy[:, 1] - 0.5]))


def _require_inside(number: int, outline: ImageOutline) -> None:
    columns, rows = outline.source.size()
    left, top, right, bottom = outline.pixels.bounds
    if right < -0.5 or bottom < -0.5 or left > columns - 0.5 or top > rows - 0.5:
        raise InputError(say("Outline {number} lies outside {source} ({columns} x {rows} pixels): draw it on the "
                             "image without a coordinate reference system, where y is negative.", number=number + 1,
                             source=outline.source.name, columns=columns, rows=rows))
