"""Elements of lane maps as the comparison takes them, from Lanelet2 files and from layers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pyproj
import shapely

from ...errors import InputError
from ...geometry.tolerances import LEAST_DIVISOR
from ...io.osm import OsmFile, OsmRelation
from ...wording import mark, say

LINE, STOP_LINE, CROSSWALK, SYMBOL = mark("line"), mark("stop line"), mark("crosswalk"), mark("symbol")
ELEMENTS = (LINE, STOP_LINE, CROSSWALK, SYMBOL)

LINE_TYPES = {"line_thin": "", "line_thick": "", "road_border": "road border", "curbstone": "road border",
              "guard_rail": "guard rail", "wall": "wall", "fence": "fence", "jersey_barrier": "jersey barrier",
              "zig-zag": "zig-zag", "rail": "rail"}
"""Types of Lanelet2's linestrings that are lines on the ground, and their kind; "" where the subtype tells it."""

NO_PAINT = ("virtual", "guiding strip")
"""Kinds of layers' lines that are not compared: nobody sees the first, the second is no marking of lanes."""


@dataclass(frozen=True)
class MapElement:
    """Something of a lane map that lies on the ground.

    Attributes
    ----------
    identifier : as its map has it.
    element : one of `ELEMENTS`.
    kind : class of it, such as "solid", "dashed" or "arrow left"; "" where unknown.
    points : (n, 2) m; of crosswalks and symbols the outline, closed.
    colour : "white", "yellow" or "".
    sigma : of its place, m; NaN where the map states none.
    double : a double line; None where the map does not tell.
    heading : (2,) direction of the traffic over it, NaN where unknown; of crosswalks and symbols alone.
    """

    identifier: str
    element: str
    kind: str
    points: np.ndarray
    colour: str = ""
    sigma: float = np.nan
    double: bool | None = None
    heading: np.ndarray = field(default_factory=lambda: np.full(2, np.nan))

    @property
    def plan(self) -> shapely.Geometry:
        return shapely.linestrings(self.points)

    @property
    def words(self) -> str:
        """Kind and colour, such as "double solid, yellow"."""
        kind = say("double {kind}", kind=self.kind) if self.double else self.kind
        return ", ".join(word for word in (kind, self.colour) if word)


def elements_of_lines(geometries: Sequence[shapely.Geometry | None],
                      columns: Mapping[str, Sequence]) -> list[MapElement]:
    """Lines and stop lines of a layer with the field class; fields colour, sigma and double are taken where they are.

    Ids are those of bound_id or line_id, else rows counted from 1.
    """
    def cell(name: str, row: int):
        return columns[name][row] if name in columns else None

    identifier = next((name for name in ("bound_id", "line_id", "id") if name in columns), "")
    elements = []
    for row, shape in enumerate(geometries):
        kind = str(cell("class", row) or "")
        if shape is None or kind in NO_PAINT:
            continue
        sigma, double, name = (cell(one, row) for one in ("sigma", "double", identifier))
        for part in shapely.get_parts(shape):
            if part.geom_type != "LineString" or not part.length > 0:
                continue
            element = STOP_LINE if kind == "stop line" else LINE
            elements.append(MapElement(str(row + 1 if name is None else name), element, kind,
                                       shapely.get_coordinates(part), str(cell("colour", row) or ""),
                                       np.nan if sigma is None else float(sigma),
                                       None if double is None else bool(double)))
    return elements


def elements_of_areas(geometries: Sequence[shapely.Geometry | None],
                      columns: Mapping[str, Sequence]) -> list[MapElement]:
    """Crosswalks and symbols of a layer with the field class; heading (degrees from grid north) where it is there.

    What has the class "unknown" is no element.
    """
    elements = []
    for row, shape in enumerate(geometries):
        kind = str(columns["class"][row] or "")
        if shape is None or shape.area == 0 or kind in ("", "unknown"):
            continue
        hull = shapely.convex_hull(shapely.force_2d(shape))
        angle = columns["heading"][row] if "heading" in columns else None
        angle = np.radians(np.nan if angle is None else float(angle))
        name = columns["area_id"][row] if "area_id" in columns else None
        elements.append(MapElement(str(row + 1 if name is None else name), CROSSWALK if kind == "crosswalk" else SYMBOL,
                                   kind, shapely.get_coordinates(hull.exterior),
                                   heading=np.array([np.sin(angle), np.cos(angle)])))
    return elements


def whole_area(geometries: Sequence[shapely.Geometry | None]) -> shapely.Geometry:
    """Polygons as one area."""
    return shapely.union_all([shape for shape in geometries if shape is not None])


def map_crs(files: Sequence[OsmFile]) -> str:
    """WKT of the UTM zone of Lanelet2 files; "" where they have only local coordinates.

    Raises
    ------
    InputError : one file has latitudes and longitudes, the other has none.
    """
    places = [np.array([(node.longitude, node.latitude) for node in one.nodes.values()]).reshape(-1, 2)
              for one in files]
    known = [len(one) > 0 and bool(np.isfinite(one).all()) for one in places]
    if not any(known):
        return ""
    if not all(known):
        raise InputError(say("One of the maps has only local coordinates (local_x, local_y), the other latitudes and "
                             "longitudes: give both in one kind."))
    longitude, latitude = np.median(np.concatenate(places), axis=0)
    zone = int((longitude + 180.0) // 6.0) % 60 + 1
    return pyproj.CRS.from_epsg((32600 if latitude >= 0 else 32700) + zone).to_wkt()


def elements_of_lanelet2(content: OsmFile, crs_wkt: str) -> list[MapElement]:
    """Lines, stop lines, crosswalks and symbols of a Lanelet2 file.

    Parameters
    ----------
    crs_wkt : projected CRS of the elements; "" takes the file's local coordinates as they are.

    Raises
    ------
    InputError : it has no latitudes and longitudes, or they are none of the CRS.
    """
    places = _places(content, crs_wkt)
    points = {number: np.array([places[node] for node in way.nodes if node in places]).reshape(-1, 2)
              for number, way in content.ways.items()}
    elements = [one for number, way in content.ways.items()
                if (one := _of_way(str(number), way.tags, points[number])) is not None]
    walks = [one for relation in content.relations.values()
             if relation.tags.get("subtype") == "crosswalk" and relation.tags.get("type") == "lanelet"
             and (one := _crosswalk(relation, points)) is not None]
    return elements + walks


def _places(content: OsmFile, crs_wkt: str) -> dict[int, np.ndarray]:
    """Coordinates (2,) of the nodes, m, by their ids."""
    nodes = list(content.nodes.values())
    if not crs_wkt:
        return {node.identifier: np.array([float(node.tags["local_x"]), float(node.tags["local_y"])])
                for node in nodes if "local_x" in node.tags and "local_y" in node.tags}
    degrees = np.array([(node.longitude, node.latitude) for node in nodes]).reshape(-1, 2)
    if not np.isfinite(degrees).all():
        raise InputError(say("The Lanelet2 file has only local coordinates (local_x, local_y): it can be compared "
                             "with another such file, but not with layers or with latitudes and longitudes."))
    into = pyproj.Transformer.from_crs("EPSG:4326", pyproj.CRS.from_wkt(crs_wkt).to_2d(), always_xy=True)
    xy = np.column_stack(into.transform(degrees[:, 0], degrees[:, 1]))
    if not np.isfinite(xy).all():
        raise InputError(say("Places of the Lanelet2 file lie outside of the CRS of the comparison: check whether "
                             "both maps are of one place."))
    return {node.identifier: place for node, place in zip(nodes, xy)}


def _of_way(identifier: str, tags: Mapping[str, str], points: np.ndarray) -> MapElement | None:
    """The element that a way is; None where it is none, or too short to be one."""
    kind = tags.get("type", "")
    if len(points) < 2 or not np.ptp(points, axis=0).any():
        return None
    colour, sigma = tags.get("color", ""), _number(tags.get("sigma", ""))
    if kind == "stop_line":
        return MapElement(identifier, STOP_LINE, "stop line", points, colour, sigma)
    if kind in LINE_TYPES:
        subtype = tags.get("subtype", "")
        double = "_" in subtype and not LINE_TYPES[kind]
        word = LINE_TYPES[kind] or ("solid" if subtype == "solid_solid" else subtype.replace("_", " "))
        return MapElement(identifier, LINE, word, points, colour, sigma, double)
    if kind in ("arrow", "symbol") and len(points) > 3:
        return MapElement(identifier, SYMBOL, tags.get("subtype", kind), _closed(points), colour, sigma)
    return None


def _crosswalk(relation: OsmRelation, points: Mapping[int, np.ndarray]) -> MapElement | None:
    """A crosswalk from the two bounds of its lanelet; its heading is across them."""
    sides = [points[number] for role in ("left", "right") for kind, number, part in relation.members
             if kind == "way" and part == role and len(points.get(number, ())) > 1]
    if len(sides) != 2:
        return None
    left, right = sides
    if (left[-1] - left[0]) @ (right[-1] - right[0]) < 0:
        right = right[::-1]
    walk = (left[-1] - left[0]) + (right[-1] - right[0])
    walk = walk / max(np.linalg.norm(walk), LEAST_DIVISOR)
    return MapElement(str(relation.identifier), CROSSWALK, "crosswalk", _closed(np.vstack([left, right[::-1]])),
                      heading=np.array([-walk[1], walk[0]]))


def _closed(points: np.ndarray) -> np.ndarray:
    return points if (points[0] == points[-1]).all() else np.vstack([points, points[:1]])


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return np.nan
