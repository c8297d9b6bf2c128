"""From surfaces of roads to the pieces that PLATEAU's LOD1 asks for, with their middle lines.

Source: Project PLATEAU, standard product specification 5.0, 4.3.1.2 (LOD1: surfaces between the edges of roads, cut at
junctions, where bridges and tunnels begin and end, and where accuracy changes), and its working procedure, annex D.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from ..geometry.tolerances import LEAST_DIVISOR
from ..progress import SILENT, Progress
from ..wording import say
from .junctions import Junction, junctions_of
from .road_axis import Skeleton, skeleton_of
from .road_cuts import cut_surface
from .road_ends import with_ends_drawn_on
from .road_records import BRIDGE, JUNCTION, ROAD, TUNNEL, AxisPiece, RoadFinding, RoadPiece, RoadSurfaceModel
from .road_surface import RoadSurface

SMOOTHING = 0.1
"""Corners of edges that lie nearer to a straight line are none for contacts and middle lines, m."""


@dataclass(frozen=True, eq=False)
class Structures:
    """Outlines of bridges and tunnels, m."""

    bridges: Sequence[shapely.Geometry] = ()
    tunnels: Sequence[shapely.Geometry] = ()


def with_functions(model: RoadSurfaceModel, surfaces: Sequence[shapely.Geometry | None],
                   codes: Sequence[str | None]) -> RoadSurfaceModel:
    """A model whose pieces have the code of `Road_function` of the given surface that covers most of them.

    Parameters
    ----------
    surfaces : polygons that the model was made of, m; others are passed over.
    codes : one for each; those that are None or empty are passed over.
    """
    known = [(shape, code) for shape, code in zip(surfaces, codes)
             if code and shape is not None and shape.geom_type in ("Polygon", "MultiPolygon")]
    if not known:
        return model
    shapes = [shape if shape.is_valid else shapely.make_valid(shape) for shape, _ in known]
    tree = shapely.STRtree(shapes)
    pieces = []
    for piece in model.pieces:
        covered: dict[str, float] = defaultdict(float)
        for number in tree.query(piece.polygon).tolist():
            covered[known[number][1]] += shapely.area(shapely.intersection(piece.polygon, shapes[number]))
        most = max(covered, key=lambda code: covered[code], default="")
        pieces.append(replace(piece, function=most if most and covered[most] > 0 else ""))
    return replace(model, pieces=tuple(pieces))


@dataclass(eq=False)
class _Built:
    """What grows surface by surface."""

    pieces: list[RoadPiece] = field(default_factory=list)
    axes: list[AxisPiece] = field(default_factory=list)
    findings: list[RoadFinding] = field(default_factory=list)


def build_road_model(surface: RoadSurface, structures: Structures | None = None,
                     progress: Progress = SILENT) -> RoadSurfaceModel:
    """Cut surfaces of roads at their junctions, bridges and tunnels.

    Parameters
    ----------
    surface : valid polygons, m.
    """
    structures = structures or Structures()
    bridge, tunnel = (shapely.union_all(list(shapes)) for shapes in (structures.bridges, structures.tunnels))
    built = _Built(findings=list(surface.findings))
    total = max(sum(polygon.area for polygon in surface.polygons), LEAST_DIVISOR)
    done = 0.0
    for polygon in surface.polygons:
        progress.check()
        _add_surface(built, polygon, bridge, tunnel)
        done += polygon.area
        progress.step(done / total)
    return RoadSurfaceModel(tuple(built.pieces), tuple(built.axes), tuple(built.findings))


def _add_surface(built: _Built, polygon: shapely.Polygon, bridge, tunnel) -> None:
    skeleton = skeleton_of(with_ends_drawn_on(_smooth(polygon)))
    built_up = shapely.union(bridge, tunnel)
    found = junctions_of(_without_ends_on(skeleton, built_up))
    every = [np.vstack([cut.left, cut.right]) for junction in found for cut in junction.cuts]
    within = shapely.buffer(polygon, -SMOOTHING)
    every = [line for line in every if _mostly_on(line, within)]
    cuts = [line for line in every if not _mostly_on(line, built_up)]
    pieces = cut_surface(polygon, cuts)
    if len(cuts) < len(every):
        pieces = [part for piece in pieces for part in cut_surface(piece, _structure_lines(piece, built_up))]
    nodes = shapely.points(np.array([node for junction in found for node in junction.places]).reshape(-1, 2))
    owner = [junction for junction in found for _ in junction.places]
    first = len(built.pieces)
    for piece in pieces:
        inside = np.flatnonzero(shapely.intersects(piece, nodes)) if len(nodes) else []
        owners = list({id(owner[number]): owner[number] for number in inside}.values())
        if owners:
            built.pieces.append(_junction_piece(piece, owners, built.findings))
        else:
            built.pieces += [RoadPiece(part, _kind(part, bridge, tunnel), np.nan)
                             for part in cut_surface(piece, _structure_lines(piece, built_up))]
    _add_axes(built, skeleton, first)


def _without_ends_on(skeleton: Skeleton, built_up) -> Skeleton:
    """A skeleton without the loose ends that are bridges or tunnels alone: with them no road meets another."""
    if built_up.is_empty:
        return skeleton
    left_out = set()
    for number, branch in enumerate(skeleton.branches):
        for end, way in ((branch.start, branch.turned()), (branch.end, branch)):
            if len(skeleton.nodes[end]) == 1:
                away = np.hypot(*(way.points - way.points[0]).T) > way.clearance[0]
                line = shapely.linestrings(way.points[away]) if away.sum() > 1 else None
                if line is not None and shapely.intersects(line, built_up) and (
                        shapely.length(shapely.difference(line, built_up)) < way.clearance[away].mean()):
                    left_out.add(number)
    nodes = {node: [number for number in numbers if number not in left_out] for node, numbers in skeleton.nodes.items()}
    return Skeleton(skeleton.rings, skeleton.branches, nodes)


def _mostly_on(line: np.ndarray, shape) -> bool:
    """Whether more than half of a line (n, 2) lies on a shape."""
    line = shapely.linestrings(line)
    return shapely.length(shapely.intersection(line, shape)) > 0.5 * line.length


def _smooth(polygon: shapely.Polygon) -> shapely.Polygon:
    """A polygon without corners that no one sees; as it is where it would not stay one."""
    smooth = shapely.simplify(polygon, SMOOTHING)
    return smooth if smooth.geom_type == "Polygon" and smooth.is_valid and not smooth.is_empty else polygon


def _junction_piece(piece: shapely.Polygon, junctions: list[Junction], findings: list[RoadFinding]) -> RoadPiece:
    """A junction; one whose arms are not all cut is to be looked at."""
    uncut = sum(len(junction.uncut) for junction in junctions)
    arms = sum(len(junction.cuts) + len(junction.uncut) for junction in junctions)
    if not uncut and len(junctions) == 1:
        return RoadPiece(piece, JUNCTION, np.nan, arms)
    text = say("{uncut} of {arms} roads that meet here have no corner at which to cut: cut them by hand.",
               uncut=uncut, arms=arms) if uncut else say("Two junctions that could not be parted: look whether they "
                                                         "are one.")
    x, y = junctions[0].point.tolist()
    findings.append(RoadFinding("arm not cut" if uncut else "junctions not parted", text, x, y))
    return RoadPiece(piece, JUNCTION, np.nan, arms, status="to look at", finding=text)


def _structure_lines(piece: shapely.Polygon, built_up) -> list[np.ndarray]:
    """Where the outlines of bridges and tunnels run across a piece."""
    if built_up.is_empty or not shapely.intersects(piece, built_up):
        return []
    across = shapely.intersection(shapely.boundary(built_up), shapely.buffer(piece, -SMOOTHING))
    lines = [line for line in shapely.get_parts(shapely.line_merge(across)) if line.geom_type == "LineString"]
    return [shapely.get_coordinates(line) for line in lines if line.length > SMOOTHING]


def _kind(piece: shapely.Polygon, bridge, tunnel) -> str:
    """Bridge or tunnel where more than half of a piece lies on one."""
    for kind, shape in ((BRIDGE, bridge), (TUNNEL, tunnel)):
        if shapely.area(shapely.intersection(piece, shape)) > 0.5 * piece.area:
            return kind
    return ROAD


def _add_axes(built: _Built, skeleton: Skeleton, first: int) -> None:
    """Middle lines by pieces, and with them the mean width of each piece: area by length."""
    new = built.pieces[first:]
    lines = [shapely.simplify(shapely.linestrings(branch.points), SMOOTHING) for branch in skeleton.branches]
    if not lines:
        return
    tree = shapely.STRtree([piece.polygon for piece in new])
    line_numbers, numbers = tree.query(lines, predicate="intersects")
    lengths = np.zeros(len(new))
    for line, number in zip(line_numbers.tolist(), numbers.tolist()):
        for part in shapely.get_parts(shapely.line_merge(shapely.intersection(lines[line], new[number].polygon))):
            if part.geom_type == "LineString" and part.length > 0:
                lengths[number] += part.length
                built.axes.append(AxisPiece(shapely.get_coordinates(part), first + number))
    for number, length in enumerate(lengths):
        if length > 0 and new[number].kind != JUNCTION:
            piece = new[number]
            built.pieces[first + number] = replace(piece, width=piece.polygon.area / length)
