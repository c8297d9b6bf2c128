"""Damaged layers of QGIS for the algorithms whose inputs are no files: a part of `fuzz.py`, as its formats are.

Each layer of `LAYERS` is damaged by a seeded generator (places that are not finite, far off, doubled, turned round or
missing; fields of other types, empty, huge or gone; rows left out, doubled or put in another order) and given to its
algorithm beside sound ones. Needs a Python that sees QGIS.
"""

from __future__ import annotations

import math
import random
import re
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

import numpy as np  # noqa: E402
import shapely  # noqa: E402

SOUND = "sound"
"""In the place of the number of a damage: the layer as it is."""
SECONDS = 90.0
"""That a run may take."""
ORIGIN = np.array([-5000.0, -35000.0])
CRS = "EPSG:6677"
NUMBERS = (math.nan, math.inf, -math.inf, 1e308, -1e308, 1e15, -1e15, 1e6, -1.0, 0.0, 1e-300, -0.5, 2.0**31, 99999999.0)
TEXTS = ("nan", "inf", "", "abc", "-inf", "1e999", "9" * 400, "\x00", "いいえ", "stop line", "lane", "kerb",
         "lowered kerb", "road border", "0x10", "1_000", " 3 ")
OBJECT_FIELDS = [("kind", str), ("status", str), *((name, float) for name in (
    "height", "diameter", "azimuth", "arm", "arm_height", "head_height", "board_width", "board_height", "board_z"))]
EMPTY = {0: "POINT EMPTY", 1: "LINESTRING EMPTY", 3: "POLYGON EMPTY", 5: "MULTILINESTRING EMPTY",
         6: "MULTIPOLYGON EMPTY"}
_NO_NUMBER = re.compile(r'"-?(nan|inf)"')
POINT, LINE, POLYGON = 0, 1, 3
"""Numbers of kinds of shapes in shapely."""


@dataclass
class Table:
    """A layer: rows of a shape (or None) and its attributes, the fields with their types, and QGIS's kind of shape."""

    rows: list[tuple[shapely.Geometry | None, dict]]
    fields: list[tuple[str, type]]
    kind: str


# Damage

def _other_corners(corners: np.ndarray, ch: random.Random) -> np.ndarray:
    """Corners (n, 2 or 3) in one of a dozen ways no longer what they were."""
    count, axes = corners.shape
    one, axis, corners = ch.randrange(count), ch.randrange(axes), corners.copy()
    ways: tuple[Callable[[], np.ndarray], ...] = (
        lambda: np.where((np.arange(count)[:, None] == one) & (np.arange(axes) == axis), ch.choice(NUMBERS), corners),
        lambda: np.where(np.arange(axes) == axis, ch.choice(NUMBERS), corners),
        lambda: corners[:1].repeat(max(2, min(4, count)), axis=0),
        lambda: corners[::-1],
        lambda: corners.repeat(3, axis=0),
        lambda: corners[ch.sample(range(count), count)],
        lambda: corners[:2],
        lambda: corners * ch.choice((1e-3, 1e3, -1, 1.0001)),
        lambda: corners + np.array([ch.choice((0, 1, -1, 0.01, 100, 1e6, 1e8)), ch.choice((0, 1, -3, 1e7)), 0][:axes]),
        lambda: np.where(np.arange(count)[:, None] == one, corners[ch.randrange(count)], corners),
        lambda: corners + np.array([0, 0, ch.choice((0.5, -0.5, 30, -1000, 1e5))])[:axes],
        lambda: np.round(corners, ch.choice((0, 1, -1, -2))),
        lambda: corners + np.random.default_rng(ch.randrange(2**31)).normal(0, ch.choice((1e-9, 0.01, 1, 20)),
                                                                              corners.shape))
    return ch.choice(ways)()


def _other_shape(shape: shapely.Geometry | None, ch: random.Random) -> shapely.Geometry | None:
    """A shape with other corners, empty, of several parts, or none."""
    kind, way = shapely.get_type_id(shape), ch.random()
    if kind not in (POINT, LINE, POLYGON) or shape.is_empty:
        return shape
    if way < 0.07:
        return None
    if way < 0.14:
        return shapely.from_wkt(EMPTY.get(kind, "LINESTRING EMPTY"))
    if way < 0.2:
        return {POINT: shapely.multipoints, LINE: shapely.multilinestrings, POLYGON: shapely.multipolygons}[kind](
            [shape, shape])
    corners = _other_corners(shapely.get_coordinates(shape, include_z=shape.has_z), ch)
    if kind == POINT:
        return shapely.points(corners[0]) if len(corners) else None
    if kind == LINE:
        return shapely.linestrings(corners) if len(corners) > 1 else None
    try:
        return shapely.polygons(np.vstack([corners, corners[:1]])) if len(corners) > 2 else None
    except shapely.GEOSException:  # a ring is not closed where its first corner is no number
        return None


def _other_values(table: Table, ch: random.Random) -> None:
    """One value of a field, or all, is another; or the field is of another type, or gone."""
    place = ch.randrange(len(table.fields))
    name, kind = table.fields[place]
    way = ch.random()
    if way < 0.6:
        value = None if ch.random() < 0.15 else ch.choice(TEXTS if kind is str else NUMBERS)
        for _shape, values in table.rows if ch.random() < 0.3 else [ch.choice(table.rows)]:
            values[name] = value
    elif way < 0.9:
        table.fields[place] = (name, ch.choice((str, float, int)))
        if table.fields[place][1] is str:
            ch.choice(table.rows)[1][name] = ch.choice(TEXTS)
    else:
        del table.fields[place]


def _other_rows(table: Table, ch: random.Random) -> None:
    """Rows are doubled, left out, put in another order, or all moved and scaled."""
    rows, one = table.rows, ch.randrange(len(table.rows))
    way = ch.randrange(6)
    if way == 0:
        rows.append(rows[one])
    elif way == 1:
        del rows[one]
    elif way == 2:
        table.rows = rows * ch.choice((2, 3))
    elif way == 3:
        ch.shuffle(rows)
    elif way == 4:
        table.rows = rows[:ch.choice((0, 1, 2))]
    else:
        scale, shift = ch.choice((1e-3, 1e3, 1.0, -1)), ch.choice((0, 1e5, 30, 0.5))
        table.rows = [(shape and shapely.transform(shape, lambda c: c * scale + shift), values)
                      for shape, values in rows]


def damaged(table: Table, ch: random.Random) -> Table:
    """A layer that is no longer sound."""
    table = Table([(shape, dict(values)) for shape, values in table.rows], list(table.fields), table.kind)
    for _ in range(ch.choice((1, 1, 2, 4, 8))):
        way = ch.random()
        if not table.rows:
            break
        if way < 0.5:
            one = ch.randrange(len(table.rows))
            table.rows[one] = (_other_shape(table.rows[one][0], ch), table.rows[one][1])
        elif way < 0.82 and table.fields:
            _other_values(table, ch)
        else:
            _other_rows(table, ch)
    return table


# Sound layers

def _moved(shape: shapely.Geometry) -> shapely.Geometry:
    """A shape about 0, 0 where the grid of the survey is."""
    return shapely.transform(shape, lambda c: c + np.append(ORIGIN, [0.0])[:c.shape[1]], include_z=shape.has_z)


def road_layers(_folder: Path) -> dict[str, Table]:
    """A crossing as `roadmodel` takes it."""
    from tests.core.surveyed_scene import crossing, official

    edges, tops = [], []
    for number, line in enumerate(crossing()):
        some = np.r_[0:len(line.foot) - 1:4, len(line.foot) - 1]
        edges.append((_moved(shapely.linestrings(line.foot[some])), {
            "edge_id": number, "kind": "kerb", "height": line.height, "sigma": line.sigma, "sigma_z": line.sigma_z,
            "chain": line.chain, "gap": 0.0}))
        tops.append((_moved(shapely.linestrings(line.top[some])), {"edge_id": number}))
    stops = ([[-18, 0], [-18, 6]], [[18, 0], [18, -6]], [[0, 18], [4, 18]], [[0, -18], [-4, -18]])
    lanes = ((-40, -6, -8, 0), (-40, 0, -8, 6), (8, -6, 40, 0), (8, 0, 40, 6), (-4, 8, 0, 40), (0, 8, 4, 40),
             (-4, -40, 0, -8), (0, -40, 4, -8))
    return {"EDGES": Table(edges, [("edge_id", int), ("kind", str), ("height", float), ("sigma", float),
                                   ("sigma_z", float), ("chain", int), ("gap", float)], "LineStringZ"),
            "TOPS": Table(tops, [("edge_id", int)], "LineStringZ"),
            "ROADS": Table([(_moved(official()), {})], [], "Polygon"),
            "STOP_LINES": Table([(_moved(shapely.LineString(one)), {"class": "stop line"}) for one in stops],
                                [("class", str)], "LineString"),
            "LANES": Table([(_moved(shapely.box(*one)), {"kind": "lane"}) for one in lanes], [("kind", str)],
                           "Polygon")}


def map_layers(_folder: Path) -> dict[str, Table]:
    """Two lanes to a stop line with the things beside them, as `vectormap` takes them."""
    def line(*points):
        return _moved(shapely.LineString([(x, y, 12.0) for x, y in points]))

    kinds = {0.0: "solid", 3.25: "dashed", 6.5: "solid"}
    bounds = [(line((0, y), (60, y)), {"class": kind}) for y, kind in kinds.items()]
    stop = (line((59.7, 0.1), (59.7, 3.2)), {"class": "stop line"})
    unknown = dict.fromkeys((name for name, _ in OBJECT_FIELDS))
    things = [("signal", 62.0, 9.0, {"azimuth": 180.0, "arm": 5.0, "arm_height": 5.5, "head_height": 5.0}),
              ("sign", 20.0, 9.0, {"azimuth": 270.0, "board_width": 0.8, "board_height": 0.8, "board_z": 2.4}),
              ("tree", 30.0, 9.5, {"diameter": 0.3}), ("lamp post", 40.0, 9.0, {}), ("pole", 50.0, -3.0, {})]
    objects = [(_moved(shapely.Point(x, y, 12.0)), {**unknown, "height": 6.0, "status": "ok", **more, "kind": kind})
               for kind, x, y, more in things]
    rails = [(line(*((x, y) for x in range(5, 56, 5))), {"height": 0.7, "length": 50.0}) for y in (7.5, -1.0)]
    return {"LINES": Table([*bounds, stop], [("class", str)], "LineStringZ"),
            "OBJECTS": Table(objects, OBJECT_FIELDS, "PointZ"),
            "RAILS": Table(rails, [("height", float), ("length", float)], "LineStringZ")}


def _road_outputs(folder: Path, ch: random.Random) -> dict:
    outputs = dict.fromkeys(("OUTPUT", "OUTPUT_AREAS", "OUTPUT_STEPS", "OUTPUT_FINDINGS"), "memory:")
    files = {"OUTPUT_CITYGML": str(folder / "city"), "OUTPUT_REPORT": str(folder / "report.html")}
    return {**outputs, **(files if ch.random() < 0.15 else {}), "LOD": ch.choice(("3.3", "3.1", "3.0")),
            "DATA_DATE": "2026-04-01"}


def _map_outputs(folder: Path, _ch: random.Random) -> dict:
    outputs = dict.fromkeys(("OUTPUT_LANES", "OUTPUT_BOUNDS", "OUTPUT_FINDINGS"), "memory:")
    return {**outputs, "OUTPUT_LANELET2": str(folder / "map.osm"), "OUTPUT_OPENDRIVE": str(folder / "map.xodr")}


ALGORITHMS = {"roadmodel": (road_layers, _road_outputs), "vectormap": (map_layers, _map_outputs)}
LAYERS = {**dict.fromkeys(("EDGES", "TOPS", "ROADS", "STOP_LINES", "LANES"), "roadmodel"),
          **dict.fromkeys(("LINES", "OBJECTS", "RAILS"), "vectormap")}
"""Inputs that are damaged, and the algorithms that take them."""


# A process that runs

def _as_layer(table: Table):
    """The table as a layer in memory."""
    from qgis.core import QgsFeature, QgsGeometry, QgsVectorLayer

    types = {int: "integer", float: "double", str: "string"}
    layer = QgsVectorLayer("&".join([f"{table.kind}?crs={CRS}", *(f"field={name}:{types[kind]}"
                                                                  for name, kind in table.fields)]), "layer", "memory")
    features = []
    for shape, values in table.rows:
        feature = QgsFeature(layer.fields())
        feature.setAttributes([_as_type(values.get(name), kind) for name, kind in table.fields])
        if shape is not None:
            geometry = QgsGeometry()
            geometry.fromWkb(shapely.to_wkb(shape))
            feature.setGeometry(geometry)
        features.append(feature)
    layer.dataProvider().addFeatures(features)
    layer.updateExtents()
    return layer


def _as_type(value, kind: type):
    """A value as a field of a type holds it; None where it cannot."""
    if value is None or kind is str:
        return value if value is None or isinstance(value, str) else repr(value)
    try:
        number = float(value)
    except ValueError:
        return None
    if kind is float:
        return number
    return int(min(max(number, -2**31), 2**31 - 1)) if math.isfinite(number) else None


def _made(results: dict) -> list:
    """Numbers of the layers and of a map's file that were made, to be searched for values that are not finite."""
    from qgis.core import QgsVectorLayer

    found: list = []
    for layer in results.values():
        if str(layer).endswith((".osm", ".xodr")) and _NO_NUMBER.search(Path(layer).read_text(encoding="utf-8")):
            found.append(math.nan)
        for feature in layer.getFeatures() if isinstance(layer, QgsVectorLayer) else ():
            found += [value for value in feature.attributes() if isinstance(value, float)]
            if not feature.geometry().isNull():
                shape = shapely.from_wkb(bytes(feature.geometry().asWkb()))
                found.append(shapely.get_coordinates(shape, include_z=shape.has_z))
    return found


def layer_reader(name: str, seed: int) -> Callable[[Path], list]:
    """Starts QGIS; a function that runs the layer's algorithm on the damage of a number, or on `SOUND`.

    What the algorithm refuses is an `UrbanMapError`, with a cause where the sentence names no row.
    """
    sys.path.insert(0, str(ROOT / "tests" / "algorithms"))
    import conftest

    folder = Path(tempfile.mkdtemp(prefix="urbanmap-fuzz-"))
    started = conftest.start_qgis(folder / "profile")  # lives as long as the function
    make, outputs = ALGORITHMS[LAYERS[name]]
    layers = make(folder)

    def run(number: Path, _qgis=started) -> list:
        import processing
        from qgis.core import QgsProcessingException, QgsProcessingFeedback

        from urbanmap_qgis.errors import UrbanMapError

        ch = random.Random(f"{name}-{seed}-{number}")
        harmed = {name: damaged(layers[name], ch)} if number.name != SOUND else {}
        given = {one: _as_layer(table) for one, table in {**layers, **harmed}.items()}
        try:
            return _made(processing.run(f"urbanmap:{LAYERS[name]}", {**given, **outputs(folder, ch)},
                                        feedback=QgsProcessingFeedback(False)))
        except QgsProcessingException as error:
            told = str(error)
        if "Traceback" in told:
            raise RuntimeError(told[-400:])
        raise UrbanMapError(told) from (ValueError() if "damaged or of another kind" in told else None)

    return run
