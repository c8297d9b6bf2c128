"""Areas of a road from its lines: all of them in one net, whose faces share their borders to the bit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from ...geometry.linked_groups import linked_members
from ...geometry.short_sides import without_short_sides
from ...wording import say
from ..road_records import JUNCTION, ROAD, RoadFinding, RoadPiece
from ..road_surface import GRID
from .area_records import (
    CARRIAGEWAY,
    CONTINUED,
    CROSSING,
    DOUBTFUL,
    ISLAND,
    LANE,
    MEASURED,
    OFFICIAL,
    SIDEWALK,
    UNDIVIDED,
    TrafficSurface,
)
from .carriageways import GAP, NARROW, Carriageways
from .stop_cuts import CutJunctions

SLIVER = 0.05  # m2; smaller faces go to a neighbour
THIN = 0.12  # m, mean width; likewise
SIDEWALK_WIDTH = 12.0  # m; what lies farther from a kerb is none of its sidewalk
BESIDE = 0.5  # m of kerb that a sidewalk has at least
WEAK = 0.1  # share of a border from which its source counts
LANE_END = 1.5  # m between the end of a lane and the cut of its junction, which is the lane's
LANE_SKEW = 0.5  # m by which one side of a lane may end before the other


@dataclass(eq=False)
class _Net:
    """Faces of the net with their kind and number of section; -1 for none."""

    faces: list[shapely.Polygon]
    kinds: list[str]
    roads: list[int]
    pieces: list[RoadPiece] = field(default_factory=list)
    findings: list[RoadFinding] = field(default_factory=list)


def road_areas(ways: Carriageways, cut: Sequence[CutJunctions], official: Sequence[shapely.Polygon],
               lanes: Sequence[shapely.Polygon], sigma_at,
               ) -> tuple[list[RoadPiece], list[TrafficSurface], list[RoadFinding]]:
    """Sections and junctions, areas with neither heights nor steps, and findings.

    Parameters
    ----------
    cut : junctions of each carriageway.
    official : surfaces of roads up to the outer borders of sidewalks; empty where not known.
    lanes : empty where carriageways are not divided.
    sigma_at : standard deviation, m, of the edge nearest to a place (2,).
    """
    lanes = [lane for lane in lanes if lane.is_valid]
    lanes = [_reaching(lane, [one.line for group in cut for one in group.cuts]) for lane in lanes]
    net = _faces(ways, cut, official, lanes)
    findings = list(net.findings)
    _name_ways(net, ways, cut, findings)
    _name_beside(net, ways, official, findings)
    _divide_lanes(net, lanes)
    merged = _without_slivers(_merged(net))
    areas = [_area(polygon, kind, road, ways, sigma_at) for polygon, kind, road in merged]
    polygons = without_short_sides([*(piece.polygon for piece in net.pieces), *(area.polygon for area in areas)])
    pieces = [replace(piece, polygon=polygon) for piece, polygon in zip(net.pieces, polygons)]
    areas = [replace(area, polygon=polygon) for area, polygon in zip(areas, polygons[len(pieces):])]
    return pieces, areas, findings


def _faces(ways: Carriageways, cut: Sequence[CutJunctions], official: Sequence[shapely.Polygon],
           lanes: Sequence[shapely.Polygon]) -> _Net:
    whole = shapely.union_all(list(ways.polygons))
    lines = [polygon.boundary for polygon in ways.polygons]
    lines += [shapely.linestrings(_longer(one.line)) for group in cut for one in group.cuts]
    # Lanes are divided where they lie on a carriageway.
    lines += [shapely.intersection(lane.boundary, shapely.buffer(whole, 2 * GRID)) for lane in lanes]
    if official:
        outer = shapely.union_all(list(official))
        lines.append(outer.boundary)
        lines += _outward(ways, outer)
    net = shapely.union_all([shapely.line_merge(line) if line.geom_type != "LineString" else line for line in lines
                             if not line.is_empty], grid_size=GRID)
    faces = [face for face in shapely.get_parts(shapely.polygonize(shapely.get_parts(net))) if face.area > 0]
    return _Net(faces, [""] * len(faces), [-1] * len(faces))


def _longer(line: np.ndarray, by: float = 0.02) -> np.ndarray:
    """A cut whose ends reach a little over the border."""
    direction = (line[1] - line[0]) / max(np.hypot(*(line[1] - line[0])), 1e-12)
    return np.vstack([line[0] - by * direction, line[1] + by * direction])


def _outward(ways: Carriageways, outer: shapely.Geometry) -> list[shapely.LineString]:
    """Lines from where the survey or an edge ends at each side to the outer border of the sidewalk."""
    lines = []
    for corner, outwards in _outward_rays(ways):
        ray = shapely.linestrings(np.vstack([corner, corner + SIDEWALK_WIDTH * outwards]))
        met = shapely.intersection(ray, outer.boundary)
        if met.is_empty:
            continue
        points = shapely.get_coordinates(met)
        nearest = points[np.hypot(*(points - corner).T).argmin()]
        if np.hypot(*(nearest - corner)) > GRID:
            lines.append(shapely.linestrings(np.vstack([corner, nearest + 2 * GRID * outwards])))
    return lines


def _outward_rays(ways: Carriageways) -> list[tuple[np.ndarray, np.ndarray]]:
    """Corners (2,) at which the sidewalk ends with its kerb, and unit vectors away from the road: onwards from a line
    across it, square to a gap along it."""
    rays = []
    for end in ways.ends:
        direction = (end[1] - end[0]) / np.hypot(*(end[1] - end[0]))
        rays += [(end[0], -direction), (end[1], direction)]
    for gap in ways.gaps:
        x, y = (gap[1] - gap[0]) / np.hypot(*(gap[1] - gap[0]))
        rays += [(corner, np.array([y, -x])) for corner in gap]
    return rays


def _inside(net: _Net, shape: shapely.Geometry) -> np.ndarray:
    """Numbers of the faces that lie in a shape and have no kind yet."""
    shapely.prepare(shape)
    points = shapely.point_on_surface(net.faces)
    return np.array([number for number in np.flatnonzero(shapely.contains(shape, points))
                     if not net.kinds[number]], int)


def _name_ways(net: _Net, ways: Carriageways, cut: Sequence[CutJunctions], findings: list[RoadFinding]) -> None:
    """Sections and junctions of carriageways; holes whose border was measured are islands."""
    for polygon, junctions in zip(ways.polygons, cut):
        for number in _inside(net, polygon):
            net.kinds[number] = CARRIAGEWAY
        unnamed = [number for number, kind in enumerate(net.kinds) if kind == CARRIAGEWAY and net.roads[number] < 0]
        groups = _between_cuts(net, unnamed, junctions)
        surfaces = [shapely.union_all([net.faces[number] for number in members]) for members in groups]
        meeting = _where_roads_meet(surfaces, junctions)
        for members, surface, nodes in zip(groups, surfaces, meeting):
            if surface.area < SLIVER:
                continue  # it goes to a neighbour in the end
            net.pieces.append(_piece(surface, nodes, findings))
            for number in members:
                net.roads[number] = len(net.pieces) - 1
                net.kinds[number] = CROSSING if nodes else CARRIAGEWAY
        for ring in polygon.interiors:
            hole = shapely.Polygon(ring)
            shown = _seen(hole, ways.near)
            for number in _inside(net, hole):
                net.kinds[number] = ISLAND if shown > 0.5 else UNDIVIDED
                net.roads[number] = _nearest_road(net, net.faces[number])
            if shown <= 0.5 or 2 * hole.area / hole.length > GAP:
                x, y = shapely.get_coordinates(shapely.point_on_surface(hole))[0]
                findings.append(RoadFinding("island not shown", say(
                    "The edges leave out a part of the carriageway here of which less than half of the border was "
                    "measured: look whether it is an island."), x, y))


def _where_roads_meet(surfaces: Sequence[shapely.Geometry], cut: CutJunctions) -> list[list]:
    """The junctions of each surface: that on which most of a junction's cuts border.

    Where the survey ends within a junction, the middle lines may meet beyond a cut.
    """
    meeting: list[list] = [[] for _ in surfaces]
    borders = [shapely.buffer(surface.boundary, 5 * GRID) for surface in surfaces]
    for number, node in enumerate(cut.junctions):
        cuts = [shapely.linestrings(one.line) for one in cut.cuts if one.junction == number]
        places = shapely.multipoints(node.places)
        found = [(sum(shapely.length(shapely.intersection(line, border)) > 0.5 * line.length for line in cuts),
                  bool(shapely.intersects(surface, places)), surface.area)
                 for surface, border in zip(surfaces, borders)]
        meeting[max(range(len(found)), key=found.__getitem__)].append(node)
    return meeting


def _between_cuts(net: _Net, numbers: list[int], junctions: CutJunctions) -> list[list[int]]:
    """Faces that lie together with no cut between them."""
    cuts = shapely.union_all([shapely.linestrings(one.line) for one in junctions.cuts]) if junctions.cuts else None
    barrier = None if cuts is None else shapely.buffer(cuts, 5 * GRID)
    faces = [net.faces[number] for number in numbers]
    links = []
    for a, b in shapely.STRtree(faces).query(faces, predicate="touches").T.tolist():
        common = shapely.intersection(faces[a].boundary, faces[b].boundary) if a < b else shapely.LineString()
        free = common if barrier is None else shapely.difference(common, barrier)
        if shapely.length(free) > 10 * GRID:
            links.append((a, b))
    groups = linked_members(*np.array(links, np.int64).reshape(-1, 2).T, len(faces))
    return [[numbers[k] for k in group.tolist()] for group in groups]


def _piece(surface: shapely.Geometry, nodes: list, findings: list[RoadFinding]) -> RoadPiece:
    polygon = max(shapely.get_parts(surface), key=shapely.area)
    if not nodes:
        return RoadPiece(polygon, ROAD, _strip_width(polygon), source=MEASURED)
    arms = sum(len(node.arms) for node in nodes)
    uncut = sum(len(node.uncut) for node in nodes)
    text = say("{uncut} of {arms} roads that meet here have neither a corner nor a stop line at which to cut: cut "
               "them by hand.", uncut=uncut, arms=arms) if uncut else ""
    if uncut:
        findings.append(RoadFinding("arm not cut", text, *nodes[0].point.tolist()))
    return RoadPiece(polygon, JUNCTION, np.nan, arms, MEASURED, "to look at" if uncut else "made", text)


def _strip_width(polygon: shapely.Polygon) -> float:
    """Width of a strip of the same area and border, m."""
    half = polygon.length / 2.0
    return float((half - np.sqrt(max(half**2 - 4.0 * polygon.area, 0.0))) / 2.0)


def _seen(polygon: shapely.Polygon, near: shapely.Geometry) -> float:
    """Share of a border that lies in what is near to measured lines."""
    return shapely.length(shapely.intersection(polygon.exterior, near)) / polygon.exterior.length


def _nearest_road(net: _Net, face: shapely.Polygon) -> int:
    """Number of the section with which a face has the longest border; the nearest without one."""
    if not net.pieces:
        return -1
    shared = [shapely.length(shapely.intersection(face.boundary, piece.polygon.boundary)) for piece in net.pieces]
    if max(shared) > 0:
        return int(np.argmax(shared))
    return int(np.argmin(shapely.distance(face, [piece.polygon for piece in net.pieces])))


def _name_beside(net: _Net, ways: Carriageways, official: Sequence[shapely.Polygon],
                 findings: list[RoadFinding]) -> None:
    """Sidewalks between kerbs and the outer border of the road; what was not surveyed stays undivided."""
    if not official:
        return
    whole = shapely.union_all(list(ways.polygons))
    kerbs = whole.boundary
    ends = shapely.union_all([shapely.linestrings(end) for end in (*ways.ends, *ways.gaps)])
    kerbs = shapely.difference(shapely.difference(kerbs, shapely.buffer(ways.open_sides, 5 * GRID)), ways.end_zones)
    at_kerbs, at_ends = shapely.buffer(kerbs, GRID), shapely.buffer(ends, GRID)
    for number in _inside(net, shapely.union_all(list(official))):
        face = net.faces[number]
        beside, open_end = (shapely.length(shapely.intersection(face.boundary, zone)) for zone in (at_kerbs, at_ends))
        farthest = shapely.hausdorff_distance(face, shapely.intersection(whole, face.buffer(SIDEWALK_WIDTH))) if (
            beside) else np.inf
        sidewalk = beside > BESIDE and open_end < NARROW and (
            face.area / beside < SIDEWALK_WIDTH) and np.isfinite(farthest)
        net.kinds[number] = SIDEWALK if sidewalk else UNDIVIDED
        net.roads[number] = _nearest_road(net, face) if sidewalk else -1
        if not sidewalk and face.area > NARROW**2:
            x, y = shapely.get_coordinates(shapely.point_on_surface(face))[0]
            findings.append(RoadFinding("not surveyed", say(
                "{area:.0f} m² of the given roads were not surveyed: they are left undivided.", area=face.area), x, y))


def _divide_lanes(net: _Net, lanes: Sequence[shapely.Polygon]) -> None:
    """Faces of carriageways that lie in a lane; each lane is an area of its own."""
    if not lanes:
        return
    tree = shapely.STRtree(list(lanes))
    for number, face in enumerate(net.faces):
        if net.kinds[number] != CARRIAGEWAY:
            continue
        point = shapely.point_on_surface(face)
        for lane in tree.query(point, predicate="within")[:1]:
            net.kinds[number] = f"{LANE} {lane}"


def _reaching(lane: shapely.Polygon, cuts: Sequence[np.ndarray]) -> shapely.Polygon:
    """A lane drawn on to the cut of its junction, where it ends before it."""
    corners = shapely.get_coordinates(lane.exterior)[:-1]
    for cut in cuts:
        line = shapely.linestrings(cut)
        away = shapely.distance(line, shapely.points(corners))
        if not GRID < away.min() < LANE_END:
            continue
        end = corners[away < away.min() + LANE_SKEW]
        distance = np.hypot(*(end[:, None] - end[None]).transpose(2, 0, 1))
        one, other = np.unravel_index(int(np.argmax(distance)), distance.shape)
        if distance[one, other] < LANE_SKEW:
            continue
        feet = shapely.get_coordinates(shapely.line_interpolate_point(line, shapely.line_locate_point(
            line, shapely.points(end[[one, other]]))))
        strip = shapely.convex_hull(shapely.multipoints(np.vstack([end[[one, other]], feet])))
        joined = shapely.union(lane, shapely.buffer(strip, GRID, cap_style="square", join_style="mitre"))
        lane = joined if joined.geom_type == "Polygon" else lane
    return lane


def _merged(net: _Net) -> list[tuple[shapely.Polygon, str, int]]:
    """Faces of one kind and section as polygons."""
    groups: dict[tuple[str, int], list[shapely.Polygon]] = {}
    for face, kind, road in zip(net.faces, net.kinds, net.roads):
        if kind:
            groups.setdefault((kind, road), []).append(face)
    merged = []
    for (kind, road), faces in groups.items():
        whole = shapely.coverage_union_all(faces)
        merged += [(part, kind.split(" ")[0] if kind.startswith(LANE) else kind, road)
                   for part in shapely.get_parts(whole) if part.geom_type == "Polygon"]
    return merged


def _without_slivers(areas: list[tuple[shapely.Polygon, str, int]]) -> list[tuple[shapely.Polygon, str, int]]:
    """Areas with those too small or thin given to the neighbour with the longest common border."""
    areas = list(areas)
    while True:
        small = next((k for k, (polygon, kind, _) in enumerate(areas) if polygon.area < SLIVER
                      or (kind != ISLAND and 2.0 * polygon.area / polygon.length < THIN)), None)
        if small is None:
            return areas
        polygon = areas.pop(small)[0]
        shared = [shapely.length(shapely.intersection(polygon.boundary, other.boundary)) for other, _, _ in areas]
        if not shared or max(shared) <= 0:
            continue
        k = int(np.argmax(shared))
        joined = shapely.coverage_union_all([areas[k][0], polygon])
        if joined.geom_type == "Polygon":
            areas[k] = (joined, *areas[k][1:])


def _area(polygon: shapely.Polygon, kind: str, road: int, ways: Carriageways, sigma_at) -> TrafficSurface:
    """An area with where its border comes from."""
    polygon = shapely.geometry.polygon.orient(polygon)
    seen = _seen(polygon, ways.near_sure) if kind != UNDIVIDED else 0.0
    kerb = shapely.difference(shapely.intersection(polygon.exterior, ways.border), ways.end_zones)
    unseen, unsure = (shapely.length(shapely.difference(kerb, near)) for near in (ways.near, ways.near_sure))
    source = MEASURED
    if kind == UNDIVIDED:
        source = OFFICIAL
    elif kerb.length and unseen > WEAK * kerb.length:
        source = CONTINUED
    elif kerb.length and unsure > WEAK * kerb.length:
        source = DOUBTFUL
    elif kind == SIDEWALK:
        source = OFFICIAL  # its outer border is that of the given roads
    sigma = float(sigma_at(shapely.get_coordinates(shapely.centroid(polygon))[0])) if kind != UNDIVIDED else np.nan
    return TrafficSurface(polygon, kind, road, source, float(seen), _strip_width(polygon), {}, sigma)
