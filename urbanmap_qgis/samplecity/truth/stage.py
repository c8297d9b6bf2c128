"""Writes what is true in the sample city: markings, roofs, walls, areas and the ground."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import shapely

from ..scene.faces import ring_of
from ..scene.ground import KERB_RADIUS
from ..scene.model import AERIAL, GROUND, FaceKind
from ..scene.world import Scene
from .edges import true_kerbs, true_rails
from .geopackage import Layer, write_geopackage
from .geotiff import write_mask
from .lanes import true_lanes
from .lines import true_lines

CELL = 0.25
"""Of the raster of the ground, m."""

BORDER = 30.0
"""Ground and areas are given up to here beyond the city's square, m."""


def write_truth(scene: Scene, folder: Path) -> dict:
    """Write truth/ below `folder`: layers of markings, lines, roofs, footprints, areas, lanes, edges; ground.tif."""
    truth = folder / "truth"
    truth.mkdir(parents=True, exist_ok=True)
    write_geopackage(truth / "markings.gpkg", [_markings(scene, AERIAL, "aerial"), _markings(scene, GROUND, "mms")])
    write_geopackage(truth / "roofs.gpkg", [_roofs(scene), _wall_lines(scene)])
    write_geopackage(truth / "footprints.gpkg", [_footprints(scene)])
    write_geopackage(truth / "areas.gpkg", [_areas(scene)])
    write_geopackage(truth / "lanes.gpkg", [true_lanes(scene)])
    write_geopackage(truth / "edges.gpkg", [true_kerbs(scene), true_rails(scene)])
    write_geopackage(truth / "lines.gpkg", [true_lines(scene, AERIAL), true_lines(scene, GROUND)])
    if scene.before_fronts:
        write_geopackage(truth / "fronts.gpkg", [_before_fronts(scene)])
    _write_ground(scene, truth / "ground.tif")
    return {"buildings": len(scene.buildings), "roofs": sum(len(building.parts) for building in scene.buildings),
            "markings": len(scene.markings), "trees": len(scene.trees), "vehicles": len(scene.vehicles)}


def _markings(scene: Scene, epoch: str, name: str) -> Layer:
    markings = scene.markings_at(epoch)
    return Layer(name, [shapely.force_3d(m.plan, float(scene.ground_height(m.plan.centroid.x, m.plan.centroid.y)))
                        for m in markings],
                 {"kind": [m.kind for m in markings], "color": [m.colour for m in markings],
                  "wear": [m.wear for m in markings], "private": [int(m.private) for m in markings],
                  "both_epochs": [int(m.aerial and m.ground) for m in markings]})


def _roofs(scene: Scene) -> Layer:
    """Roofs of the parts and of their structures, as polygons at their height."""
    rows, plans = [], []
    for building in scene.buildings:
        for number, part in enumerate(building.parts):
            kind = "flat" if part.z_ridge is None else "gable"
            plans.append(shapely.force_3d(part.plan, part.z_roof))
            rows.append((building.id, number, building.shape, kind, "main", part.z_roof,
                         part.z_top if part.z_ridge is None else part.z_ridge, part.parapet_width,
                         part.parapet_height, part.plan.area, building.z_base))
            for structure in part.structures:
                top = part.z_roof + structure.height
                plans.append(shapely.force_3d(structure.plan, top))
                rows.append((building.id, number, building.shape, "flat", "structure", top, top, 0.0, 0.0,
                             structure.plan.area, building.z_base))
    names = ("building", "part", "shape", "kind", "role", "z_roof", "z_top", "parapet_w", "parapet_h", "area",
             "z_base")
    return Layer("roofs", plans, dict(zip(names, zip(*rows))))


def _wall_lines(scene: Scene) -> Layer:
    """Outer and inner walls as they can be seen: a line at the foot, with its heights."""
    faces = scene.static_faces(GROUND)
    upright = (faces.kind == FaceKind.WALL) & (faces.corners[:, 2, 2] == faces.corners[:, 3, 2])
    rows = np.flatnonzero(upright & (faces.corners[:, 2] != faces.corners[:, 3]).any(axis=1))
    return Layer("wall_lines", shapely.linestrings(faces.corners[rows, :2]), {
        "building": faces.building[rows], "part": faces.part[rows], "z_foot": faces.corners[rows, 0, 2],
        "z_top": faces.corners[rows, 2, 2]})


def _before_fronts(scene: Scene) -> Layer:
    """Outer faces of what stands before the fronts."""
    things = scene.before_fronts
    return Layer("fronts", [thing.line for thing in things], {
        "building": [thing.building for thing in things], "kind": [thing.kind for thing in things],
        "before": [thing.before for thing in things], "z_low": [thing.z_low for thing in things],
        "z_high": [thing.z_high for thing in things]})


def _footprints(scene: Scene) -> Layer:
    corners = [ring_of(building.outline) for building in scene.buildings]
    ground = [float(scene.ground_height(*ring.T).mean()) for ring in corners]
    return Layer("wall_footprints", [building.outline for building in scene.buildings], {
        "building": [building.id for building in scene.buildings],
        "shape": [building.shape for building in scene.buildings], "z_ground": ground,
        "z_max": [max(part.z_top if part.z_ridge is None else part.z_ridge for part in building.parts)
                  for building in scene.buildings]})


def _areas(scene: Scene) -> Layer:
    areas = list(_area_plans(scene))
    return Layer("areas", [plan for _, plan in areas], {"kind": [kind for kind, _ in areas]})


def _area_plans(scene: Scene) -> Iterator[tuple[str, shapely.Polygon]]:
    """Carriageways with rounded corners, parking lots and the whole city."""
    half_extent = scene.size / 2 + BORDER
    bands = [shapely.box(-2 * half_extent, s.at - s.half_width, 2 * half_extent, s.at + s.half_width) if s.along == "u"
             else shapely.box(s.at - s.half_width, -2 * half_extent, s.at + s.half_width, 2 * half_extent)
             for s in scene.ground.streets]
    streets = shapely.union_all(bands).buffer(KERB_RADIUS, quad_segs=32).buffer(-KERB_RADIUS, quad_segs=32)
    streets &= shapely.box(-half_extent, -half_extent, half_extent, half_extent)
    if scene.ground.islands:
        streets -= shapely.union_all(list(scene.ground.islands))
    yield "carriageway", scene.ground.plan_to_world(streets)
    for lot in scene.ground.parking:
        yield "parking", lot
    yield "city", scene.extent


def _write_ground(scene: Scene, path: Path) -> None:
    """Bare ground as float32 raster; cell centres hold the formula's height."""
    west, south, east, north = shapely.total_bounds(scene.extent.buffer(BORDER, join_style="mitre"))
    west, north = CELL * np.floor(west / CELL), CELL * np.ceil(north / CELL)
    x = np.arange(west + CELL / 2, east, CELL)
    y = np.arange(north - CELL / 2, south, -CELL)
    rows = [scene.ground_height(*np.meshgrid(x, part)).astype(np.float32)
            for part in np.array_split(y, max(1, len(y) // 256))]
    write_mask(path, np.concatenate(rows), (float(west), float(north), CELL))
