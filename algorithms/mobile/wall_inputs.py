"""Buildings and facades as a second witness beside the markings: parameters of the registration."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr
from ..framework.layers.building_layers import read_buildings

FEATURES = ("automatic", "paint", "walls", "all")


def add_buildings(algorithm) -> None:
    """Declare BUILDINGS and FEATURES."""
    algorithm.add_polygons("BUILDINGS", "Buildings", "Outlines, or models with their heights (MultiPolygonZ of "
                           "“Building models” or “Load city model”), whose walls are a second witness beside the "
                           "markings. How far facades stand inside them is found.", optional=True)
    algorithm.add_choice("FEATURES", "Features", "What the survey is laid by. Automatic: paint, and walls where "
                         "buildings are given. Paint: the markings alone. Walls: the markings give the start only. "
                         "All: both; without buildings walls say only where the correction breaks them.", FEATURES,
                         "automatic", advanced=True)


def add_walls(algorithm) -> None:
    """Declare BUILDINGS, FEATURES, ALS and SURVEY."""
    add_buildings(algorithm)
    algorithm.add_points("ALS", "Airborne laser points", "Instead of buildings: walls stand where these points "
                         "step from roof to ground beside facades that the survey saw. In the height system of the "
                         "survey.", optional=True)
    algorithm.add_points("SURVEY", "Survey with its facades", "All points of the survey, where “Point clouds” holds "
                         "its markings alone.", optional=True)


def read_walls(algorithm, parameters, context, survey, run, progress):
    """The core's `WallWitness` of the survey (files, CRS, trajectory), None where paint alone is asked for."""
    from ...urbanmap_qgis.mobile.registration.walls.survey_walls import walls_of

    features = asked_features(algorithm, parameters, context)
    if features == "paint":
        return None
    if algorithm.parameterAsString(parameters, "METHOD", context) == "paper":
        if algorithm.parameterAsString(parameters, "FEATURES", context) == "automatic":
            progress.warn(tr("The paper's method knows no walls: the buildings are not used."))
            return None
        raise InputError(tr("{0}: the paper's method knows no walls; choose paint, or the full method.").format(
            algorithm.label_of("FEATURES")))
    paths, crs, trajectory = survey
    laser = _read_laser(algorithm, parameters, context, crs)
    edges = read_edges(algorithm, parameters, context, crs, progress)
    files = algorithm.point_files(parameters, "SURVEY", context) or paths
    return walls_of(files, trajectory, run.correction.time_weight, edges, features == "walls", progress, laser)


def _read_laser(algorithm, parameters, context, crs):
    """The core's `PointCloud` of ALS, in the CRS of the survey; None where none is given."""
    from ...urbanmap_qgis.io.points.pointcloud import open_cloud

    files = algorithm.point_files(parameters, "ALS", context)
    if not files:
        return None
    if parameters.get("BUILDINGS") is not None:
        raise InputError(tr("{0}: the walls are taken from buildings or from airborne laser points; give one of "
                            "both.").format(algorithm.label_of("ALS")))
    cloud = open_cloud(files)
    algorithm.same_crs("POINTS", crs, "ALS", cloud.crs_wkt)
    return cloud


def asked_features(algorithm, parameters, context) -> str:
    """What FEATURES asks for: paint, walls or all.

    Raises
    ------
    InputError : walls alone are asked for, but neither buildings nor airborne points are given.
    """
    features = algorithm.parameterAsString(parameters, "FEATURES", context)
    given = parameters.get("BUILDINGS") is not None or bool(parameters.get("ALS"))
    if features == "automatic":
        return "all" if given else "paint"
    if features == "walls" and not given:
        raise InputError(tr("{0}: walls alone need buildings; give outlines or models of them.").format(
            algorithm.label_of("BUILDINGS")))
    return features


def read_edges(algorithm, parameters, context, crs, progress):
    """The core's `WallEdges` of BUILDINGS; None where none are given."""
    if parameters.get("BUILDINGS") is None:
        return None
    from ...urbanmap_qgis.facades.building_plans import building_plans, outline_edges
    from ...urbanmap_qgis.mobile.registration.walls.outline_walls import WallEdges

    table = read_buildings(algorithm, parameters, "BUILDINGS", context, progress)
    algorithm.same_crs("POINTS", crs, "BUILDINGS", table.crs)
    plans = building_plans(table.geometries, range(len(table.geometries)))
    return WallEdges.joined([outline_edges(plan) for plan in plans.plan if plan is not None])
