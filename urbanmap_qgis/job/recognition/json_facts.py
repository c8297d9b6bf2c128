"""JSON files: cameras, calibrations, CityJSON, GeoJSON and jobs, told by what stands in them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import shapely

from ...aerial.frames.camera import read_camera
from ...geometry.earth import WGS84
from ...io.conversion.reprojection import epsg_wkt
from ...io.files.guard import read_json
from ...mobile.calibration import read_calibration
from ...wording import say
from ..file_facts import CALIBRATION, CAMERA, CITY_MODEL, JOB, OTHER, FileFacts
from .layer_kind import LayerSample
from .vector_facts import SAMPLE, layer_facts, named_system

JOB_MARK = "urbanmap_job"
"""Key that tells a job file."""


def json_facts(path: Path, _head: bytes) -> list[FileFacts]:
    """What a JSON file is.

    Raises
    ------
    InputError : it is no JSON, or a camera or calibration that cannot be used.
    """
    content = _content(path)
    if not isinstance(content, dict):
        return [FileFacts(path, OTHER)]
    if JOB_MARK in content:
        return [FileFacts(path, JOB, detail=str(content.get("wish", "")))]
    if content.get("type") in ("CityJSON", "CityJSONFeature"):
        return [_cityjson(path, content)]
    if content.get("type") == "FeatureCollection":
        return [_geojson(path, content)]
    if "focal_length_mm" in content or "pixel_pitch_mm" in content:
        camera = read_camera(path)
        return [FileFacts(path, CAMERA, detail=say("{width} x {height} pixels", width=camera.width,
                                                   height=camera.height))]
    if any(isinstance(content.get(key), (list, dict)) for key in ("scanners", "camera", "cameras")):
        mounted = read_calibration(path)
        return [FileFacts(path, CALIBRATION, notes=mounted.damaged_cameras, detail=say(
            "{scanners} scanners, {cameras} cameras", scanners=len(mounted.scanners), cameras=len(mounted.cameras)))]
    return [FileFacts(path, OTHER)]


def _content(path: Path) -> object:
    """The file's JSON; of CityJSONSeq, one object a line, the first."""
    with path.open("rb") as stream:
        first = stream.readline(1 << 24)
    if path.stat().st_size > len(first) > 2:
        try:
            found = json.loads(first)
        except ValueError:  # no object a line: the whole file is one
            found = None
        if isinstance(found, dict) and found.get("type") == "CityJSON":
            return found
    return read_json(path, "JSON")


def _cityjson(path: Path, content: Mapping) -> FileFacts:
    metadata = content.get("metadata") or {}
    crs, heights = named_system(str(metadata.get("referenceSystem", "")), path)
    box = metadata.get("geographicalExtent")
    extent = None
    if isinstance(box, list) and len(box) == 6:
        extent = (float(box[0]), float(box[1]), float(box[3]), float(box[4]))
    elif content.get("vertices") and content.get("transform"):
        moved = content["transform"]
        places = np.array(content["vertices"], float) * moved["scale"] + moved["translate"]
        (x_min, y_min), (x_max, y_max) = places[:, :2].min(axis=0), places[:, :2].max(axis=0)
        extent = (float(x_min), float(y_min), float(x_max), float(y_max))
    return FileFacts(path, CITY_MODEL, detail=f"CityJSON {content.get('version', '')}".strip(), crs_wkt=crs,
                     heights=heights, extent=extent, count=len(content.get("CityObjects") or ()) or None)


def _geojson(path: Path, content: Mapping) -> FileFacts:
    named = ((content.get("crs") or {}).get("properties") or {}).get("name", "")
    crs = named_system(str(named), path)[0] if named else epsg_wkt(WGS84)
    features = content.get("features") or []
    shapes = [shapely.geometry.shape(item["geometry"]) for item in features[:SAMPLE] if item.get("geometry")]
    everything = np.array([shapely.geometry.shape(item["geometry"]) for item in features if item.get("geometry")],
                          object)
    box = shapely.total_bounds(everything) if len(everything) else np.full(4, np.nan)
    fields = tuple(features[0].get("properties") or {}) if features else ()
    sample = LayerSample((path.stem,), fields, shapes[0].geom_type if shapes else "", shapes)
    return layer_facts(path, "", sample, crs, tuple(map(float, box)) if np.isfinite(box).all() else None,
                       len(features))
