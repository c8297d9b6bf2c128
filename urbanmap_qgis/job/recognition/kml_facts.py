"""KML and KMZ: outlines, paths and places in longitude and latitude, told by their geometry and names.

Source: OGC KML 2.3 (OGC 12-007r2): coordinates are longitude,latitude[,altitude] of WGS 84.
"""

from __future__ import annotations

import html
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import shapely

from ...errors import InputError
from ...geometry.earth import WGS84
from ...io.conversion.reprojection import epsg_wkt
from ...wording import say
from ..file_facts import AREAS, LINES, OTHER, PLACES, FileFacts
from .layer_kind import LayerSample, kind_of_layer
from .vector_facts import SAMPLE

LARGEST_READ = 1 << 26
"""Bytes of XML that are looked through; of a longer file only so many."""

_NOTHING = np.zeros((0, 2))

_GEOMETRY = re.compile(rb"<(?:\w+:)?(Polygon|LineString|LinearRing|Point|Track)[\s>](.*?)</(?:\w+:)?\1>", re.DOTALL)
_COORDINATES = re.compile(rb"<coordinates>([^<]*)</coordinates>")
_TRACKED = re.compile(rb"<gx:coord>([^<]*)</gx:coord>")
_FIELD = re.compile(rb"<(?:SimpleField|SimpleData|Data)\s[^>]*?name=[\"']([^\"'<>]{1,100})[\"']")
_NAME = re.compile(rb"<name>([^<]{1,200})</name>")
_LINK = re.compile(rb"<(?:NetworkLink|GroundOverlay)[\s>]")


def kml_facts(path: Path, data: bytes, detail: str = "KML") -> FileFacts:
    """What the text of a KML file shows: of several geometries the first of polygons, lines and points that is there.

    Raises
    ------
    InputError : coordinates are no longitudes and latitudes.
    """
    found: dict[str, list[np.ndarray]] = {}
    for match in _GEOMETRY.finditer(data):
        kind, body = match.group(1).decode(), match.group(2)
        places = _tracked(body, path) if kind == "Track" else _first_coordinates(body, path)
        if len(places):
            found.setdefault({"Track": "LineString", "LinearRing": "LineString"}.get(kind, kind), []).append(places)
    if not found:
        linked = _LINK.search(data)
        return FileFacts(path, OTHER, detail=detail, problem=say(
            "{name} holds links or pictures only: open it in the program that it comes from and save the places "
            "themselves.", name=path.name) if linked else say("{name} holds no feature: choose another file.",
                                                              name=path.name))
    everything = np.vstack([places for group in found.values() for places in group])
    extent = (*map(float, everything.min(axis=0)), *map(float, everything.max(axis=0)))
    counts = ", ".join(f"{len(group)} {kind}" for kind, group in found.items())
    shape = next(kind for kind in ("Polygon", "LineString", "Point") if kind in found)
    kind, doubt = _kind(path, shape, found[shape], data)
    return FileFacts(path, kind, detail=f"{detail}: {counts}", crs_wkt=epsg_wkt(WGS84), extent=extent,
                     count=len(found[shape]), doubt=doubt, notes=(_advice(path, kind),))


def _first_coordinates(body: bytes, path: Path) -> np.ndarray:
    """(n, 2) longitude, latitude of the outer ring or line."""
    text = _COORDINATES.search(body)
    return _places([part.split(b",") for part in text.group(1).split()], path) if text else _NOTHING


def _tracked(body: bytes, path: Path) -> np.ndarray:
    return _places([text.split() for text in _TRACKED.findall(body)], path)


def _places(tuples: list[list[bytes]], path: Path) -> np.ndarray:
    if not tuples:
        return _NOTHING
    try:
        places = np.array([[float(value) for value in entry[:2]] for entry in tuples])
    except ValueError as error:
        raise InputError(say("{name} has coordinates that are no numbers: it is damaged; save it again.",
                             name=path.name)) from error
    if places.ndim != 2 or places.shape[1] != 2 or not (np.abs(places) <= [360.0, 90.0]).all():
        raise InputError(say("{name} has coordinates that are no longitude and latitude: KML counts in degrees, "
                             "longitude first; export it again.", name=path.name))
    return places


def _kind(path: Path, shape: str, group: list[np.ndarray], data: bytes) -> tuple[str, str]:
    if shape != "Polygon":
        return (LINES if shape == "LineString" else PLACES), ""
    shapes = [shapely.Polygon(ring) for ring in group[:SAMPLE] if len(ring) >= 4]
    names = [html.unescape(text.decode("utf-8", "replace")) for text in _NAME.findall(data)[:2]]
    fields = tuple(dict.fromkeys(text.decode("utf-8", "replace") for text in _FIELD.findall(data)))
    return kind_of_layer(LayerSample((path.stem, *names), fields, "Polygon", shapes), degrees=True)


def _advice(path: Path, kind: str) -> str:
    """What to do with it to use it here."""
    if kind == LINES:
        return say("{name} holds a path without roll, pitch and heading, which is no trajectory: export the trajectory "
                   "from the navigation software as text or SBET.", name=path.name)
    if kind == PLACES:
        return say("{name} holds places without the times at which the survey passed them: write control points as a "
                   "table with id, x, y, z, time, x_mms, y_mms, z_mms.", name=path.name)
    if kind == AREAS:
        return say("{name} holds areas that look like no buildings: where they are, say that they are used as building "
                   "outlines.", name=path.name)
    return say("{name} counts in degrees: open it in QGIS, save it with “Export” in the plane reference system of the "
               "points, and add that file.", name=path.name)


def kmz_facts(path: Path, archive: zipfile.ZipFile, names: list[str]) -> Iterator[FileFacts]:
    """What the KML in a KMZ shows: its main file is the first one (OGC 12-007r2, annex C).

    Raises
    ------
    InputError : it is damaged.
    """
    for name in [name for name in archive.namelist() if name in names and name.lower().endswith(".kml")][:1]:
        with archive.open(name) as stream:
            data = stream.read(LARGEST_READ)
        if b"</kml" not in data[-4096:] and archive.getinfo(name).file_size <= LARGEST_READ:
            raise InputError(say("{name} is cut off: its end is missing; copy or download it again.", name=path.name))
        yield kml_facts(path, data, "KMZ")


def whole_kml(path: Path) -> bytes:
    """The text of a KML file, as far as it is looked through."""
    with path.open("rb") as stream:
        return stream.read(LARGEST_READ)
