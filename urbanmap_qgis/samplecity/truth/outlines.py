"""Official outlines of the sample city's buildings, as rough as a 1:2500 map: generalised, shifted, rotated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape  # nosec B406 # writes, reads nothing

import numpy as np
import pyproj
import shapely
from shapely import affinity

from ...progress import SILENT, Progress
from ..scene.model import Building
from ..scene.world import CRS, SURVEYED, Scene
from .geopackage import Layer, write_geopackage

MAX_SHIFT, MAX_ROTATION = 0.5, 1.2
"""Maximum shift of an outline, m, and rotation about its middle, degrees."""

DETAIL = 0.6
"""Corners that stand out less than this are left out, m."""

JGD2011 = "EPSG:6668"
_HEAD = """<?xml version="1.0" encoding="utf-8"?>
<Dataset xsi:schemaLocation="http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema FGD_GMLSchema.xsd"
\txmlns:gml="http://www.opengis.net/gml/3.2"
\txmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
\txmlns:xlink="http://www.w3.org/1999/xlink"
\txmlns="http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema"
\tgml:id="Dataset1">
"""


@dataclass(frozen=True)
class Outline:
    """An official outline: number of the true building, plan in projected coordinates, GSI type of building."""

    building: int
    plan: shapely.Polygon
    type: str


def write_outlines(scene: Scene, folder: Path, seed: np.random.SeedSequence, progress: Progress = SILENT) -> dict:
    """Write footprints/gsi_buildings.gpkg and the same as GSI GML (FG-GML-...-BldA-...xml) below `folder`.

    Returns a summary: number of outlines and their mean and greatest shift, m.
    """
    progress.step(0.0)
    outlines = rough_outlines(scene.buildings, np.random.default_rng(seed))
    target = folder / "footprints"
    target.mkdir(parents=True, exist_ok=True)
    mesh = mesh_code(*scene.ground.origin)
    ids = [gml_id(mesh, number) for number in range(1, len(outlines) + 1)]
    write_geopackage(target / "gsi_buildings.gpkg", [Layer("BldA", [outline.plan for outline in outlines], {
        "gml_id": ids, "type": [outline.type for outline in outlines], "orgGILvl": ["2500"] * len(outlines)})])
    name = f"FG-GML-{mesh}-BldA-{SURVEYED:%Y%m%d}-0001"
    (target / f"{name}.xml").write_bytes(gsi_gml(outlines, ids, name).encode("utf-8"))
    progress.step(1.0)
    plans = {building.id: building.outline for building in scene.buildings}
    shift = [plans[outline.building].centroid.distance(outline.plan.centroid) for outline in outlines]
    return {"outlines": len(outlines), "mean_shift": float(np.mean(shift)), "max_shift": float(np.max(shift)),
            "building_of": {name: outline.building for name, outline in zip(ids, outlines)}}


def rough_outlines(buildings: Sequence[Building], rng: np.random.Generator) -> list[Outline]:
    """Outlines as an official map has them, in an order of its own."""
    outlines = []
    for building in buildings:
        plan = building.outline.simplify(DETAIL)
        distance, bearing = MAX_SHIFT * np.sqrt(rng.random()), rng.uniform(0.0, 2 * np.pi)
        plan = affinity.rotate(plan, rng.uniform(-MAX_ROTATION, MAX_ROTATION), origin=building.outline.centroid)
        plan = affinity.translate(plan, distance * np.sin(bearing), distance * np.cos(bearing))
        kind = "普通建物" if building.shape == "gable" else "堅ろう建物"
        outlines.append(Outline(building.id, shapely.set_precision(plan, 0.001), kind))
    return [outlines[number] for number in rng.permutation(len(outlines))]


def mesh_code(x: float, y: float) -> str:
    """Second-order mesh code of a projected place: the map sheet that the file is named after."""
    longitude, latitude = _to_jgd2011().transform(x, y)
    first = f"{int(latitude * 1.5):02d}{int(longitude) - 100:02d}"
    return f"{first}{int(latitude * 1.5 % 1 * 8)}{int(longitude % 1 * 8)}"


def gml_id(mesh: str, number: int) -> str:
    """Id of an object in GSI's manner."""
    return f"K13_{mesh}_{number}"


def gsi_gml(outlines: Sequence[Outline], ids: Sequence[str], name: str) -> str:
    """The outlines as GSI Fundamental Geospatial Data (latitude, longitude, JGD2011)."""
    objects = "".join(_object(outline, identity, number)
                      for number, (outline, identity) in enumerate(zip(outlines, ids), start=1))
    return f"{_HEAD}<!-- {escape(name)} -->\n{objects}</Dataset>\n"


def _to_jgd2011() -> pyproj.Transformer:
    """From x, y (east, north) to longitude, latitude."""
    return pyproj.Transformer.from_crs(CRS, JGD2011, always_xy=True)


def _object(outline: Outline, identity: str, number: int) -> str:
    ring = shapely.get_coordinates(outline.plan.exterior)
    longitude, latitude = _to_jgd2011().transform(ring[:, 0], ring[:, 1])
    places = [f"{a:.9f} {b:.9f}" for a, b in zip(latitude, longitude)]
    # As in GSI's own files, a ring comes as one curve or as several, end on start.
    middle = len(places) // 2
    curves = [places] if number % 3 else [places[:middle + 1], places[middle:]]
    members = "".join(_CURVE.format(id=f"{identity}-{3 + k}", places="\n".join(curve))
                      for k, curve in enumerate(curves))
    return _OBJECT.format(id=identity, fid=f"20240401-13101-{number:05d}-s-{999 + number}", date=SURVEYED.isoformat(),
                          members=members, type=outline.type)


_CURVE = """<gml:curveMember>
<gml:Curve gml:id="{id}">
<gml:segments>
<gml:LineStringSegment>
<gml:posList>
{places}
</gml:posList>
</gml:LineStringSegment>
</gml:segments>
</gml:Curve>
</gml:curveMember>
"""
_OBJECT = """<BldA gml:id="{id}">
<fid>{fid}</fid>
<lfSpanFr gml:id="{id}-1">
<gml:timePosition>2023-10-01</gml:timePosition>
</lfSpanFr>
<devDate gml:id="{id}-2">
<gml:timePosition>{date}</gml:timePosition>
</devDate>
<orgGILvl>2500</orgGILvl>
<area>
<gml:Surface gml:id="{id}-g" srsName="fguuid:jgd2011.bl">
<gml:patches>
<gml:PolygonPatch>
<gml:exterior>
<gml:Ring>
{members}</gml:Ring>
</gml:exterior>
</gml:PolygonPatch>
</gml:patches>
</gml:Surface>
</area>
<type>{type}</type>
</BldA>
"""
