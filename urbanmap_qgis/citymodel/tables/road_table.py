"""Roads of a city model as rows of a table, taken out of the objects that are walked through."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator

import numpy as np
import shapely

from ..model import ROAD, AttributeGroup, CityObject, Measure
from ..plain_values import code_text, plain_attributes
from ..unknown_values import known_value


class RoadTable:
    """Rows of roads: their surfaces of the plainest level of detail, and what they say.

    Attributes
    ----------
    columns : road_id, lod (levels there are), class, function and usage (codes), section (code of the kind of section),
        width (m), note, attributes (all, as JSON).
    outlines : MultiPolygon of each road, m; None where it has no surface.
    """

    def __init__(self, places: Callable[[np.ndarray], np.ndarray], unknown: Counter) -> None:
        """`places` : function from corners (n, 3) as read to corners in the wanted reference.
        `unknown` : gets the number of values that stand for "unknown", by attribute.
        """
        self._places, self._unknown = places, unknown
        self.columns: dict[str, list] = {name: [] for name in (
            "road_id", "lod", "class", "function", "usage", "section", "width", "note", "attributes")}
        self.outlines: list[shapely.MultiPolygon | None] = []

    def without_roads(self, objects: Iterable[CityObject]) -> Iterator[CityObject]:
        """The other objects as they come; roads become rows."""
        for item in objects:
            if item.type == ROAD:
                self._add(item)
            else:
                yield item

    def _add(self, road: CityObject) -> None:
        structure = road.attributes.get("uro:roadStructureAttribute")
        more = structure.values if isinstance(structure, AttributeGroup) else {}
        width = more.get("uro:width")
        row = {"road_id": road.id, "lod": ",".join(sorted({shape.lod for shape in road.shapes})),
               **{name: code_text(road.attributes.get(name)) for name in ("class", "function", "usage")},
               "section": code_text(more.get("uro:sectionType")),
               "width": known_value("width", width.value, self._unknown) if isinstance(width, Measure) else None,
               "note": "; ".join(road.problems),
               "attributes": json.dumps(plain_attributes(road.attributes), ensure_ascii=False)}
        for name, column in self.columns.items():
            column.append(row[name])
        self.outlines.append(self._outline(road))

    def _outline(self, road: CityObject) -> shapely.MultiPolygon | None:
        """Surfaces of the plainest level that has some."""
        level = min((shape.lod for shape in road.shapes if shape.surfaces), default=None)
        polygons = []
        for surface in (surface for shape in road.shapes if shape.lod == level for surface in shape.surfaces):
            outer, *inner = (self._places(ring)[:, :2] for ring in surface.rings)
            polygons.append(shapely.Polygon(outer, inner))
        return shapely.multipolygons(polygons) if polygons else None
