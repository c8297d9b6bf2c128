"""City furniture and trees of a city model as rows of a table, taken out of the objects that are walked through."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator

import numpy as np
import shapely

from ...wording import say
from ..model import SINGLE_TREE, STREET_KINDS, CityObject, CitySurface, Measure
from ..objects import placed
from ..plain_values import code_text, plain_attributes
from ..unknown_values import UNKNOWN_HEIGHT, known_value

FURNITURE, TREE = "furniture", "tree"
"""Kinds of rows."""


class StreetTable:
    """Rows of what stands in streets: its faces of the most detailed level, and what it says.

    Attributes
    ----------
    columns : object_id, kind (`FURNITURE` or `TREE`), lod (levels there are), class, function, usage, species (codes),
        ground, top, height (m; the attribute where it is given), note, attributes (all, as JSON).
    models : MultiPolygon with z of each object, m; None where it has no surface.
    """

    def __init__(self, places: Callable[[np.ndarray], np.ndarray], unknown: Counter) -> None:
        """`places` : function from corners (n, 3) as read to corners in the wanted reference.
        `unknown` : gets the number of values that stand for "unknown", by attribute.
        """
        self._places, self._unknown = places, unknown
        self.columns: dict[str, list] = {name: [] for name in (
            "object_id", "kind", "lod", "class", "function", "usage", "species", "ground", "top", "height", "note",
            "attributes")}
        self.models: list[shapely.MultiPolygon | None] = []

    def without_street_objects(self, objects: Iterable[CityObject]) -> Iterator[CityObject]:
        """The other objects as they come; furniture and trees become rows."""
        for item in objects:
            if item.type in STREET_KINDS:
                self._add(placed(item, self._places))
            else:
                yield item

    def _add(self, item: CityObject) -> None:
        surfaces = _most_detailed(item)
        z = np.concatenate([surface.rings[0][:, 2] for surface in surfaces]) if surfaces else np.empty(0)
        z = z[z != UNKNOWN_HEIGHT]
        ground, top = (float(z.min()), float(z.max())) if len(z) else (None, None)
        given = item.attributes.get("height")
        height = known_value("height", given.value, self._unknown) if isinstance(given, Measure) else None
        problems = [*item.problems, *([] if surfaces else [say("it has no surface that could be read")])]
        row = {"object_id": item.id, "kind": TREE if item.type == SINGLE_TREE else FURNITURE,
               "lod": ",".join(sorted({shape.lod for shape in item.shapes})),
               **{name: code_text(item.attributes.get(name)) for name in ("class", "function", "usage", "species")},
               "ground": ground, "top": top,
               "height": height if height is not None else None if top is None else top - ground,
               "note": "; ".join(dict.fromkeys(problems)),
               "attributes": json.dumps(plain_attributes(item.attributes), ensure_ascii=False)}
        for name, column in self.columns.items():
            column.append(row[name])
        self.models.append(shapely.multipolygons([shapely.Polygon(outer, inner) for outer, *inner in (
            surface.rings for surface in surfaces)]) if surfaces else None)


def _most_detailed(item: CityObject) -> list[CitySurface]:
    """Surfaces of the highest level that has some."""
    level = max((shape.lod for shape in item.shapes if shape.surfaces), default=None)
    return [surface for shape in item.shapes if shape.lod == level for surface in shape.surfaces]
