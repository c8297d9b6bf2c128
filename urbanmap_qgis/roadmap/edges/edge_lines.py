"""The courses of edges measured in the points, station by station, and drawn as lines."""

from __future__ import annotations

from ...progress import Progress
from ...settings.roadmap import EdgeSettings
from .assembly import kerb_lines
from .borders import border_lines, measure_borders
from .doubts import with_doubts
from .edge_courses import EdgeCourses
from .edge_points import EdgePoints
from .edge_records import RoadEdge
from .ground_profile import Heights, above_ground, near_ground
from .stations import Stations, measure_stations
from .uprights import Uprights, measure_uprights, upright_lines


def edge_lines(courses: EdgeCourses, survey: EdgePoints, settings: EdgeSettings, ground: Heights | None,
               progress: Progress) -> list[RoadEdge]:
    """Edges along the courses: kerbs first, then rails and walls, then borders.

    Doubts are cast on kerbs, rails and walls by each other; borders are drawn where none of these is beside.
    """
    kerbs, faces, verges = Stations.of(courses.kerbs), Uprights.of(courses.faces), Stations.of(courses.verges)
    for tile in survey.tiles(progress):
        height = above_ground(tile.points, ground)
        low = near_ground(tile.points, height)
        measure_stations(kerbs, tile, low)
        measure_uprights(faces, tile, height)
        measure_borders(verges, tile, low)
    first_face = len(courses.kerbs)
    first_verge = first_face + len(courses.faces)
    edges = kerb_lines(kerbs, settings, survey.corner)
    edges += upright_lines(faces, settings, survey.corner, first_face)
    edges = with_doubts(edges, survey.path + survey.corner[:2], float(survey.chainage[-1]))
    return edges + border_lines(verges, edges, survey.path, settings, survey.corner, first_verge)
