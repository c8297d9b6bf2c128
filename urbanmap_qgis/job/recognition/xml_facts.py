"""XML and zips of it: GSI's files, CityGML, lane maps; told by the root element, sound if the root is closed."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

from ...errors import InputError
from ...io.conversion.reprojection import epsg_wkt
from ...io.osm import read_osm
from ...wording import say
from ..file_facts import CITY_MODEL, GSI_DEM, GSI_OTHER, GSI_OUTLINES, LANE_MAP, OTHER, FileFacts
from .kml_facts import LARGEST_READ, kml_facts, kmz_facts, whole_kml
from .vector_facts import named_system

_ROOT = re.compile(rb"<(?![?!])([\w.-]+:)?([\w.-]+)[\s/>]")
_SYSTEMS = {b"jgd2000.bl": 4612, b"jgd2011.bl": 6668, b"jgd2024.bl": 6668}
_HEIGHTS = {b"jgd2000.bl": "JGD2000", b"jgd2011.bl": "JGD2011", b"jgd2024.bl": "JGD2024"}
_CORNER = re.compile(rb"<(?:\w+:)?(lowerCorner|upperCorner)>\s*([^<]+)<")
_SRS = re.compile(rb"srsName=[\"']([^\"']+)[\"']")
_PLACE = re.compile(rb"(?:<gml:pos>|<gml:posList>|^)\s*(\d+\.\d+) (\d+\.\d+)\s", re.MULTILINE)
_TAIL = 4096
_BLOCK = 1 << 20


def xml_facts(path: Path, head: bytes) -> list[FileFacts]:
    """What an XML file is.

    Raises
    ------
    InputError : it has no root, or the root is not closed: it is cut off.
    """
    found = _ROOT.search(head)
    if found is None:
        raise InputError(say("{name} is no XML: it is damaged; copy or download it again.", name=path.name))
    root = (found.group(1) or b"") + found.group(2)
    with path.open("rb") as stream:
        stream.seek(max(path.stat().st_size - _TAIL, 0))
        if b"</" + root not in stream.read().replace(b" ", b"") and b"/>" not in head[found.start():][:200]:
            raise InputError(say("{name} is cut off: its end is missing; copy or download it again.", name=path.name))
    return [_of_root(path, found.group(2), head)]


def _of_root(path: Path, root: bytes, head: bytes) -> FileFacts:
    if root == b"Dataset" and b"fgd.gsi.go.jp" in head:
        return _gsi(path, head, _pieces(path))
    if root == b"CityModel":
        return _citygml(path, head)
    if root == b"OpenDRIVE":
        return FileFacts(path, LANE_MAP, detail="OpenDRIVE")
    if root == b"osm":
        return _lanelet(path)
    if root == b"kml":
        return kml_facts(path, whole_kml(path))
    return FileFacts(path, OTHER, detail=root.decode("ascii", "replace"))


def _pieces(path: Path) -> Iterator[bytes]:
    with path.open("rb") as stream:
        for _ in range(LARGEST_READ // _BLOCK):
            piece = stream.read(_BLOCK)
            if not piece:
                return
            yield piece


def _gsi(path: Path, head: bytes, pieces: Iterator[bytes]) -> FileFacts:
    """Files of Japan's Fundamental Geospatial Data; latitude comes before longitude in them."""
    kind, detail = _gsi_kind(head)
    system = next((name for name in _SYSTEMS if name in head.lower()), None)
    crs = epsg_wkt(_SYSTEMS[system]) if system else ""
    heights = _HEIGHTS[system] if system and kind == GSI_DEM else "unknown"
    low, high, count = [90.0, 180.0], [-90.0, -180.0], 0
    for piece in pieces:
        count += len(re.findall(rb"<BldA[ >]", piece))
        for place in _PLACE.finditer(piece):
            pair = [float(place.group(1)), float(place.group(2))]
            low, high = [min(a, b) for a, b in zip(low, pair)], [max(a, b) for a, b in zip(high, pair)]
    corners = [[float(part) for part in text.split()[:2]] for _, text in _CORNER.findall(head)[:2]]
    if len(corners) == 2:
        low, high = corners
    extent = (low[1], low[0], high[1], high[0]) if low[0] <= high[0] else None
    return FileFacts(path, kind, detail=detail, crs_wkt=crs, heights=heights, extent=extent, count=count or None)


def _gsi_kind(head: bytes) -> tuple[str, str]:
    if b"<DEM " in head or b"<DEM>" in head:
        return GSI_DEM, "DEM"
    for word in (b"BldA", b"BldL"):
        if b"<" + word + b" " in head or b"<" + word + b">" in head:
            return GSI_OUTLINES, word.decode()
    other = re.search(rb"<([A-Z][A-Za-z]{2,8}) gml:id", head)
    return GSI_OTHER, other.group(1).decode() if other else ""


def _citygml(path: Path, head: bytes) -> FileFacts:
    srs = _SRS.search(head)
    crs, heights = named_system(srs.group(1).decode("utf-8", "replace") if srs else "", path)
    corners = [[float(part) for part in text.split()[:2]] for _, text in _CORNER.findall(head)[:2]]
    extent = None
    if len(corners) == 2:
        (south, west), (north, east) = corners
        extent = (west, south, east, north) if abs(north) <= 90.0 and abs(east) <= 180.0 else (south, west, north, east)
    buildings = sum(piece.count(b"<bldg:Building ") + piece.count(b"<bldg:Building>") for piece in _pieces(path))
    detail = "CityGML" if buildings else say("CityGML without buildings")
    return FileFacts(path, CITY_MODEL, detail=detail, crs_wkt=crs, heights=heights, extent=extent,
                     count=buildings or None)


def _lanelet(path: Path) -> FileFacts:
    content = read_osm(path)
    lanes = sum(relation.tags.get("type") == "lanelet" for relation in content.relations.values())
    if not lanes:
        return FileFacts(path, OTHER, detail="OpenStreetMap")
    return FileFacts(path, LANE_MAP, detail="Lanelet2", count=lanes)


def zip_facts(path: Path, _head: bytes) -> list[FileFacts]:
    """What a zip holds, by the first file in it that is known.

    Raises
    ------
    InputError : it is damaged.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            names = sorted(info.filename for info in archive.infolist() if not info.is_dir())
            places = list(kmz_facts(path, archive, names))
            if places:
                return places
            for name in names:
                if name.lower().endswith((".xml", ".gml")):
                    with archive.open(name) as stream:
                        head = stream.read(65_536)
                    found = _ROOT.search(head)
                    if found and found.group(2) == b"Dataset" and b"fgd.gsi.go.jp" in head:
                        return [_gsi(path, head, iter((head,)))]
                    if found and found.group(2) == b"CityModel":
                        return [FileFacts(path, CITY_MODEL, detail="CityGML")]
            if any(name.lower().endswith(".xml.zip") or re.search(r"FG-GML.*\.zip$", name) for name in names):
                kind = GSI_DEM if any("DEM" in name for name in names) else GSI_OUTLINES
                return [FileFacts(path, kind, detail=say("zips in a zip"), doubt=say("told by the names in it"))]
    except (zipfile.BadZipFile, OSError, EOFError, NotImplementedError, RuntimeError) as error:
        raise InputError(say("{name} is not a sound zip file: fetch it again.", name=path.name)) from error
    return [FileFacts(path, OTHER, detail=say("{count} files", count=len(names)))]
