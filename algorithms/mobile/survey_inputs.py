"""Points, trajectory and reference of a survey as parameters, checked against each other before any work."""

from __future__ import annotations

from typing import NamedTuple

from .marking_reference import read_reference


class SurveyInputs(NamedTuple):
    """Files of POINTS, their CRS as WKT, and the core's `TrajectoryFile` and `Reference`."""

    paths: list
    crs: str
    trajectory: object
    reference: object


def read_survey(algorithm, parameters, context, progress):
    """Files of POINTS, their CRS as WKT, and the core's `TrajectoryFile` of TRAJECTORY, of one place and time."""
    from ...urbanmap_qgis.io.points.coordinate_steps import told_steps
    from ...urbanmap_qgis.mobile.survey_checks import require_survey

    paths = algorithm.point_files(parameters, "POINTS", context)
    cloud = algorithm.projected_cloud(parameters, context)
    trajectory = algorithm.read_trajectory(parameters, "TRAJECTORY", context, cloud.crs_wkt, progress)
    algorithm.same_crs("POINTS", cloud.crs_wkt, "TRAJECTORY", trajectory.crs_wkt)
    require_survey(cloud, trajectory.trajectory)
    told_steps(cloud)
    return paths, cloud.crs_wkt, trajectory


def read_survey_and_reference(algorithm, parameters, context, progress) -> SurveyInputs:
    """The same with MARKINGS and GROUND, in the survey's CRS and at its place."""
    from ...urbanmap_qgis.io.points.pointcloud import open_cloud
    from ...urbanmap_qgis.io.raster import RasterSampler
    from ...urbanmap_qgis.mobile.survey_checks import require_reference, survey_span

    paths, crs, trajectory = read_survey(algorithm, parameters, context, progress)
    ground = algorithm.raster_path(parameters, "GROUND", context)
    if ground is not None:
        with RasterSampler(ground) as source:
            algorithm.same_crs("POINTS", crs, "GROUND", source.crs_wkt)
    reference, reference_crs = read_reference(algorithm, parameters, context, ground, progress)
    algorithm.same_crs("POINTS", crs, "MARKINGS", reference_crs)
    span = survey_span(open_cloud(paths), trajectory.trajectory)
    require_reference(trajectory.trajectory, span, reference, progress)
    return SurveyInputs(paths, crs, trajectory, reference)
