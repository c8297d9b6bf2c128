"""Buildings and facades as a second witness beside the markings: parameters of the registration."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr
from ..framework.layers.building_layers import read_buildings

FEATURES = ("automatic", "paint", "walls", "all")


def add_walls(algorithm) -> None:
    """Declare BUILDINGS, FEATURES and SURVEY."""
    algorithm.add_polygons("BUILDINGS", "Buildings", "Outlines, or models with their heights (MultiPolygonZ of "
                           "“Building models” or “Load city model”), whose walls are a second witness beside the "
                           "markings. How far facades stand inside them is found.", optional=True)
    algorithm.add_choice("FEATURES", "Features", "What the survey is laid by. Automatic: paint, and walls where "
                         "buildings are given. Paint: the markings alone. Walls: the markings give the start only. "
                         "All: both; without buildings walls say only where the correction breaks them.", FEATURES,
                         "automatic", advanced=True)
    algorithm.add_points("SURVEY", "Survey with its facades", "All points of the survey, where “Point clouds” holds "
                         "its markings alone.", optional=True)


def read_walls(algorithm, parameters, context, survey, run, progress):
    """The core's `WallWitness` of the survey (files, CRS, trajectory), None where paint alone is asked for."""
    from ...urbanmap_qgis.mobile.registration.walls.survey_walls import walls_of

    features = algorithm.parameterAsString(parameters, "FEATURES", context)
    buildings = parameters.get("BUILDINGS") is not None
    if features == "paint" or (features == "automatic" and not buildings):
        return None
    if algorithm.parameterAsString(parameters, "METHOD", context) == "paper":
        if features == "automatic":
            progress.warn(tr("The paper's method knows no walls: the buildings are not used."))
            return None
        raise InputError(tr("{0}: the paper's method knows no walls; choose paint, or the full method.").format(
            algorithm.label_of("FEATURES")))
    if features == "walls" and not buildings:
        raise InputError(tr("{0}: walls alone need buildings; give outlines or models of them.").format(
            algorithm.label_of("BUILDINGS")))
    paths, crs, trajectory = survey
    edges = _edges(algorithm, parameters, context, crs, progress) if buildings else None
    files = algorithm.point_files(parameters, "SURVEY", context) or paths
    return walls_of(files, trajectory, run.correction.time_weight, edges, features == "walls", progress)


def _edges(algorithm, parameters, context, crs, progress):
    """The core's `WallEdges` of BUILDINGS."""
    from ...urbanmap_qgis.facades.building_plans import building_plans, outline_edges
    from ...urbanmap_qgis.mobile.registration.walls.outline_walls import WallEdges

    table = read_buildings(algorithm, parameters, "BUILDINGS", context, progress)
    algorithm.same_crs("POINTS", crs, "BUILDINGS", table.crs)
    plans = building_plans(table.geometries, range(len(table.geometries)))
    return WallEdges.joined([outline_edges(plan) for plan in plans.plan if plan is not None])
