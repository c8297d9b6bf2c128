"""Building outlines of the Geospatial Information Authority of Japan (GSI), the 2D map of J 5.3.1.

GSI Fundamental Geospatial Data gives buildings as areas (BldA) and as outlines (BldL). Both are read here to
polygons in longitude and latitude, and turned into a projected reference system.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace

import numpy as np
import shapely
from pyproj import CRS, Transformer
from pyproj.exceptions import CRSError, ProjError

from ...errors import InputError
from ...progress import SILENT, Progress
from ...wording import say
from ..files.guard import reads
from ..reference.plane_rectangular import ZONE_NAMES, zone_epsg, zone_numbers
from .gsi_gml import Harvest, Outlines, read_source
from .gsi_outlines import Buildings, buildings_from_lines, concatenated, one_of_each, repaired, without_known
from .gsi_sources import Listing, PathLike, list_sources, some_of

JGD2000, JGD2011 = "EPSG:4612", "EPSG:6668"
# The horizontal coordinates of JGD2024 are those of JGD2011: in 2025 the GSI revised the heights only, and
# EPSG's projected systems of JGD2024 stand on EPSG:6668.
_GEODETIC = {"fguuid:jgd2000.bl": JGD2000, "fguuid:jgd2011.bl": JGD2011, "fguuid:jgd2024.bl": JGD2011}
_METRES_A_DEGREE = 111_000


@dataclass(frozen=True)
class GsiBuildings:
    """Building outlines.

    Attributes
    ----------
    geometries : (n,) array of valid shapely polygons; x = longitude, y = latitude as read, x = easting,
        y = northing once projected.
    attributes : a list of n strings (or None where not given) for each of gml_id, fid, lfSpanFr, lfSpanTo,
        devDate, orgGILvl, orgMDId, type, name and source (the file).
    crs : reference system of the geometries.
    notes : sentences on everything that was not taken as it stands in the files.
    """

    geometries: np.ndarray
    attributes: dict[str, list[str | None]]
    crs: CRS
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.geometries)


@reads("GSI building outlines")
def read_gsi_buildings(path: PathLike | Sequence[PathLike], progress: Progress = SILENT) -> GsiBuildings:
    """Read GSI building outlines to polygons in longitude and latitude.

    Parameters
    ----------
    path : an .xml or .zip as downloaded (also a zip of zips), a folder of them, or several of these.
    progress : told of everything left out or changed, too.

    Buildings come in the order of the file names and of the objects in them, areas before outlines.
    A building that several map sheets hold (same fid, same polygon) is given once, and so is one that is
    there both as an area and as an outline.

    Raises
    ------
    InputError : a file cannot be read, is damaged or encrypted, or no buildings are in it.
    """
    harvest = Harvest()
    with ExitStack() as stack:
        listing = list_sources(path, stack)
        sizes = np.cumsum([0] + [max(source.size, 1) for source in listing.sources]) / max(
            sum(max(source.size, 1) for source in listing.sources), 1)
        for source, start, end in zip(listing.sources, sizes[:-1], sizes[1:]):
            read_source(source, harvest, progress.part(0.8 * start, 0.8 * end))
    if not harvest.areas.rings and not harvest.lines.rings:
        raise InputError(_nothing_found(listing, harvest))
    progress.step(0.8)
    notes = _reading_notes(listing, harvest)
    buildings = _assembled(harvest, progress, notes)
    crs = _crs(harvest, notes)
    for note in notes:
        progress.warn(note)
    progress.step(1.0)
    return GsiBuildings(buildings.polygons, buildings.attributes, crs, tuple(notes))


def reproject(buildings: GsiBuildings, crs: CRS | str | None = None,
              progress: Progress = SILENT) -> GsiBuildings:
    """Turn buildings into another reference system.

    Parameters
    ----------
    crs : projected system (anything that pyproj understands); by default the zone of the Japan Plane
        Rectangular CS (JGD2011, EPSG:6669 to 6687) in which the data lie, see `plane_rectangular`.

    Raises
    ------
    InputError : the system is unknown, or the buildings lie outside of where it can be computed.
    """
    notes = []
    target = _understood(crs) if crs is not None else CRS.from_epsg(fitting_zone(buildings, notes))
    try:
        transformer = Transformer.from_crs(buildings.crs, target, always_xy=True)
        geometries = shapely.transform(
            buildings.geometries,
            lambda xy: np.column_stack(transformer.transform(xy[:, 0], xy[:, 1], errcheck=True)))
    except ProjError as error:
        raise InputError(say("The buildings cannot be turned into {target}: choose a reference system made for Japan.",
                             target=target.name)) from error
    if _datum(buildings.crs) == JGD2000 and _datum(target) != JGD2000:
        notes.append(say("The outlines are in JGD2000 and were taken into {target} without the movements of the "
                         "ground in 2011, up to 5 m in north-east Japan: correct them there with PatchJGD.",
                         target=target.name))
    for note in notes:
        progress.warn(note)
    return replace(buildings, geometries=geometries, crs=target, notes=(*buildings.notes, *notes))


def fitting_zone(buildings: GsiBuildings, notes: list[str] | None = None) -> int:
    """EPSG code (6669 to 6687) of the Japan Plane Rectangular zone for buildings in longitude and latitude.

    It is the zone of most buildings. That some lie in another zone is added to `notes`.
    """
    middles = shapely.get_coordinates(shapely.centroid(buildings.geometries))
    zones = zone_numbers(middles[:, 0], middles[:, 1])
    counts = np.bincount(zones, minlength=len(ZONE_NAMES) + 1)
    chosen = int(np.argmax(counts))
    if notes is not None and counts[chosen] < len(zones):
        others = ", ".join(ZONE_NAMES[zone - 1] for zone in np.flatnonzero(counts) if zone != chosen)
        notes.append(say("{zones_count} of {zones_count_2} buildings seem to lie outside zone {zone_names}, in "
                         "{others}: choose the reference system if that is not wanted.",
                         zones_count=len(zones) - counts[chosen], zones_count_2=len(zones),
                         zone_names=ZONE_NAMES[chosen - 1], others=others))
    return zone_epsg(chosen)


def _assembled(harvest: Harvest, progress: Progress, notes: list[str]) -> Buildings:
    """Valid polygons, each building once, of areas and lines."""
    areas, same_areas = one_of_each(_polygons(harvest.areas))
    progress.step(0.85)
    lines, same_lines = one_of_each(_linestrings(harvest.lines))
    lines, known_lines = without_known(lines, areas)
    outlined, known_polygons = without_known(buildings_from_lines(lines, notes), areas)
    known = known_lines + known_polygons
    progress.step(0.9)
    if same_areas + same_lines:
        notes.append(say("{same_areas} objects that several files hold alike were taken once.",
                         same_areas=same_areas + same_lines))
    if known:
        notes.append(say("{known} outlines (BldL) of buildings that are there as areas (BldA) were left out.",
                         known=known))
    buildings, mended = repaired(concatenated(areas, outlined))
    if mended:
        notes.append(say("{mended} outlines that cross or touch themselves were repaired.", mended=mended))
    if len(buildings.polygons) == 0:
        raise InputError(say("No outline in {source} closes to a polygon: give all map sheets around the area, or "
                             "BldA files.", source=harvest.lines.attributes["source"][0]))
    return buildings


def _polygons(outlines: Outlines) -> Buildings:
    coordinates, of_ring = _indexed(outlines)
    rings = shapely.linearrings(coordinates, indices=of_ring)
    of_object = np.repeat(np.arange(len(outlines.rings)), outlines.rings)
    polygons = shapely.polygons(rings, indices=of_object) if len(rings) else np.empty(0, dtype=object)
    return Buildings(polygons, outlines.attributes)


def _linestrings(outlines: Outlines) -> Buildings:
    coordinates, of_line = _indexed(outlines)
    return Buildings(shapely.linestrings(coordinates, indices=of_line), outlines.attributes)


def _indexed(outlines: Outlines) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates as (n, 2) longitude and latitude, and the part each belongs to."""
    coordinates = np.frombuffer(outlines.coordinates, dtype=float) if outlines.coordinates else np.empty(0)
    return (coordinates.reshape(-1, 2)[:, ::-1], np.repeat(np.arange(len(outlines.parts)), outlines.parts))


def _crs(harvest: Harvest, notes: list[str]) -> CRS:
    """Geographic system named by the objects."""
    names = sorted(name.lower() for name in harvest.srs_names)
    unknown = [name for name in names if name not in _GEODETIC]
    if unknown:
        raise InputError(say("The reference system {unknown} of the outlines is not known: give data in JGD2000, "
                             "JGD2011 or JGD2024 (latitude and longitude).", unknown=unknown[0]))
    systems = sorted({_GEODETIC[name] for name in names})
    if len(systems) > 1:
        raise InputError(say("Some outlines are in JGD2000 and others in JGD2011 or JGD2024, which lie up to 5 m "
                             "apart: load them in separate runs."))
    if not names:
        notes.append(say("The outlines name no reference system; JGD2011 was taken."))
    if "fguuid:jgd2024.bl" in names:
        notes.append(say("JGD2024 was taken as JGD2011 (EPSG:6668): their horizontal coordinates are the same."))
    return CRS.from_user_input(systems[0] if systems else JGD2011)


def _understood(crs: CRS | str) -> CRS:
    try:
        return CRS.from_user_input(crs)
    except CRSError as error:
        raise InputError(say("The reference system {crs} is not known: choose another.", crs=crs)) from error


def _datum(crs: CRS) -> str:
    """EPSG name of the geographic system under a reference system."""
    geodetic = crs.geodetic_crs
    if geodetic is None:
        return ""
    for code in (JGD2000, JGD2011):
        if geodetic.equals(CRS.from_user_input(code), ignore_axis_order=True):
            return code
    return geodetic.name


def _reading_notes(listing: Listing, harvest: Harvest) -> list[str]:
    """Sentences on what the files held besides plain building outlines."""
    notes = []
    if listing.others:
        notes.append(say("{others_count} files with other objects than buildings were not opened ({some}).",
                         others_count=len(listing.others), some=some_of(listing.others)))
    if harvest.not_gsi:
        notes.append(say("{not_gsi_count} XML files that are not GSI data were passed over ({some}).",
                         not_gsi_count=len(harvest.not_gsi), some=some_of(harvest.not_gsi)))
    if harvest.other_objects:
        kinds = ", ".join(f"{count} {kind}" for kind, count in sorted(harvest.other_objects.items()))
        notes.append(say("Objects that are no building outlines were passed over ({kinds}).", kinds=kinds))
    if harvest.unusable:
        notes.append(say("{unusable_count} buildings have no usable outline and are missing in the result: {some}.",
                         unusable_count=len(harvest.unusable), some=some_of(harvest.unusable)))
    if harvest.gaps:
        notes.append(say("{gaps_count} gaps in outlines were closed by a straight line, the widest {gaps:.2g} m.",
                         gaps_count=len(harvest.gaps), gaps=max(harvest.gaps) * _METRES_A_DEGREE))
    if harvest.curved_objects:
        kinds = ", ".join(sorted(harvest.other_segments))
        notes.append(say("{curved_objects} curve segments ({kinds}) were replaced by straight lines between the "
                         "points they give.", curved_objects=harvest.curved_objects, kinds=kinds))
    return notes


def _nothing_found(listing: Listing, harvest: Harvest) -> str:
    """Why there are no buildings, in one sentence."""
    first = listing.sources[0].name
    if harvest.unusable:
        return say("None of the buildings in {first} has a usable outline: {some}.", first=first,
                   some=some_of(harvest.unusable))
    if harvest.other_objects:
        kinds = ", ".join(sorted(harvest.other_objects))
        return say("{first} holds no building outlines (BldA or BldL) but {kinds}: give the buildings' file.",
                   first=first, kinds=kinds)
    if harvest.not_gsi:
        return (say("{not_gsi} is not GSI Fundamental Geospatial Data (its root is not an FGD Dataset): give files "
                    "named FG-GML-...-BldA or -BldL as downloaded.", not_gsi=harvest.not_gsi[0]))
    return say("{first} holds no buildings: choose another map sheet.", first=first)
