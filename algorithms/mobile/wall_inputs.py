"""Facades and kerbs as a second witness beside the markings: parameters of the registration."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr
from ..framework.layers.building_layers import read_buildings

FEATURES = ("automatic", "paint", "walls", "all")


def add_buildings(algorithm) -> None:
    """Declare BUILDINGS, FEATURES and ALS."""
    algorithm.add_polygons("BUILDINGS", "Buildings", "Outlines, or models with their heights (MultiPolygonZ of "
                           "“Building models” or “Load city model”), whose walls are a second witness beside the "
                           "markings. How far facades stand inside them is found.", optional=True)
    algorithm.add_choice("FEATURES", "Features", "What the survey is laid by. Automatic: paint, and walls where "
                         "buildings are given. Paint: the markings alone. Walls: the markings give the start only. "
                         "All: both; without buildings walls tell the pitch alone.", FEATURES,
                         "automatic", advanced=True)
    algorithm.add_points("ALS", "Airborne laser points", "Instead of buildings: walls stand where these points "
                         "step from roof to ground beside facades that the survey saw. In the height system of the "
                         "survey.", optional=True)


def add_walls(algorithm) -> None:
    """Declare BUILDINGS, FEATURES, ALS, ROAD_EDGES and SURVEY."""
    add_buildings(algorithm)
    algorithm.add_vector("ROAD_EDGES", "Kerbs or road edges", "Instead of buildings: lines of a map on which the kerbs "
                         "that the survey saw are laid, across the line; “Features” counts them as walls. By how much "
                         "the lines are off is found.", optional=True, kind="line")
    algorithm.add_points("SURVEY", "Survey with its facades", "All points of the survey, where “Point clouds” holds "
                         "its markings alone.", optional=True)


def read_walls(algorithm, parameters, context, survey, run, progress):
    """The core's `WallWitness` of the survey (files, CRS, trajectory), None where paint alone is asked for."""
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
    refuse_two_kinds(algorithm, parameters)
    files = algorithm.point_files(parameters, "SURVEY", context) or paths
    about = (files, trajectory, run.correction.time_weight)
    lines = _read_lines(algorithm, parameters, context, crs)
    if lines is not None:
        from ...urbanmap_qgis.roadmap.edges.kerb_witness import kerbs_of

        return kerbs_of(*about, lines, features == "walls", progress)
    from ...urbanmap_qgis.mobile.registration.walls.survey_walls import walls_of

    laser = read_laser(algorithm, parameters, context, crs)
    edges = read_edges(algorithm, parameters, context, crs, progress)
    return walls_of(*about, edges, features == "walls", progress, laser)


def refuse_two_kinds(algorithm, parameters) -> None:
    """Refuse more than one of the sides that facades or kerbs can be laid on."""
    given = [name for name in ("BUILDINGS", "ALS", "ROAD_EDGES") if parameters.get(name)]
    if len(given) > 1:
        raise InputError(tr("{0} and {1}: the survey is laid on one of them beside the markings; give one of "
                            "both.").format(*(algorithm.label_of(name) for name in given[:2])))


def _read_lines(algorithm, parameters, context, crs):
    """Lines of ROAD_EDGES, in the CRS of the survey; None where none are given."""
    table = algorithm.read_vector(parameters, "ROAD_EDGES", context)
    if table is None:
        return None
    algorithm.same_crs("POINTS", crs, "ROAD_EDGES", table.crs)
    return table.geometries


def read_laser(algorithm, parameters, context, crs):
    """The core's `PointCloud` of ALS, in the CRS of the survey; None where none is given."""
    from ...urbanmap_qgis.io.points.pointcloud import open_cloud

    files = algorithm.point_files(parameters, "ALS", context)
    if not files:
        return None
    cloud = open_cloud(files)
    algorithm.same_crs("POINTS", crs, "ALS", cloud.crs_wkt)
    return cloud


def asked_features(algorithm, parameters, context) -> str:
    """What FEATURES asks for: paint, walls or all.

    Raises
    ------
    InputError : walls alone are asked for, but nothing is given that they could be laid on.
    """
    features = algorithm.parameterAsString(parameters, "FEATURES", context)
    given = any(parameters.get(name) for name in ("BUILDINGS", "ALS", "ROAD_EDGES"))
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
