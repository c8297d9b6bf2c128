"""Measures the demo's city model files against the sample city's truth, read by other means than they were written."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import shapely
from osgeo import osr

from scripts.demo.checks import CITY_EPSG, MILLIMETRES, Figure, true_outlines
from scripts.layers import read_layer

_GML, _BLDG = "{http://www.opengis.net/gml}", "{http://www.opengis.net/citygml/building/2.0}"


def city_files(folder: Path) -> list[Figure]:
    """Footprints in CityGML against the true outlines and the models; tiles against the buildings."""
    models, (numbers,) = read_layer(folder / "models.gpkg", "building_id")
    modelled = [number for number, model in zip(numbers, models) if model is not None]
    plans, heights = _footprints(folder / "citygml")
    true = shapely.union_all(list(true_outlines(folder / "city").values()))
    written = shapely.union_all(plans)
    overlap = shapely.area(shapely.intersection(written, true)) / shapely.area(shapely.union(written, true))
    low = np.sort([shapely.get_coordinates(model, include_z=True)[:, 2].min() for model in models if model is not None])
    return [Figure("buildings in CityGML, share of those modelled", len(plans) / max(len(modelled), 1), "{:.0%}"),
            Figure("their overlap with the true outlines", float(overlap), "{:.2f}"),
            Figure("their height against that of the models, greatest difference",
                   float(np.abs(np.sort(heights) - low).max()) if len(heights) == len(low) else np.nan, MILLIMETRES,
                   "other buildings than the models"),
            Figure("buildings in 3D Tiles, share of those modelled",
                   _in_tiles(folder / "tiles") / max(len(modelled), 1), "{:.0%}")]


def _footprints(folder: Path) -> tuple[list[shapely.Polygon], list[float]]:
    """Plans in the city's plane system and heights of the outlines on the ground in all CityGML files."""
    degrees, plane = osr.SpatialReference(), osr.SpatialReference()
    degrees.ImportFromEPSG(6668)
    plane.ImportFromEPSG(CITY_EPSG)
    plane.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    transform = osr.CoordinateTransformation(degrees, plane)  # from latitude, longitude
    plans, heights = [], []
    for path in sorted(folder.rglob("*.gml")):
        for building in ElementTree.parse(path).getroot().iter(f"{_BLDG}Building"):
            rings = building.findall(f"{_BLDG}lod0FootPrint//{_GML}exterior//{_GML}posList")
            corners = [np.array(ring.text.split(), float).reshape(-1, 3) for ring in rings]
            plans.append(shapely.union_all([shapely.Polygon(
                [transform.TransformPoint(*row[:2].tolist())[:2] for row in ring]) for ring in corners]))
            heights.append(min(float(ring[:, 2].min()) for ring in corners))
    return plans, heights


def _in_tiles(folder: Path) -> int:
    """Buildings in the detailed tiles that the tileset names."""
    count, waiting = 0, [json.loads((folder / "tileset.json").read_text(encoding="utf-8"))["root"]]
    while waiting:
        tile = waiting.pop()
        waiting += tile.get("children", [])
        if "content" in tile and not tile.get("children"):
            data = (folder / tile["content"]["uri"]).read_bytes()
            document = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
            count += document["extensions"]["EXT_structural_metadata"]["propertyTables"][0]["count"]
    return count
