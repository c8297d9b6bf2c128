"""Line images behind a report's pictures of models before and after a trajectory was corrected."""

from __future__ import annotations

from collections.abc import Callable

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr
from ..framework.layers.overlays import pictures


def add_report_images(algorithm) -> None:
    """Declare IMAGES, CALIBRATION and LINES, which only the report uses."""
    algorithm.add_files("IMAGES", "Line images for the report", "Strip images of line cameras: the report shows the "
                        "models or lines over them, before and after.", advanced=True, optional=True)
    algorithm.add_calibration(optional=True)
    algorithm.add_vector("LINES", "Models or lines for the report", "Building models (MultiPolygonZ) or lines with "
                         "heights, drawn over the line images.", True, kind="geometry")


def check_report_images(algorithm, parameters, context) -> None:
    """Refuse line images without what they need.

    Raises
    ------
    InputError : with what is missing.
    """
    if any(algorithm.parameterAsFileList(parameters, "IMAGES", context)):
        missing = [algorithm.label_of(name) for name in ("CALIBRATION", "LINES") if not parameters.get(name)]
        if missing:
            raise InputError(tr("{0}: is needed for these images; give it.").format(", ".join(missing)))


def report_pictures(algorithm, parameters, context, trajectories, crs, progress) -> Callable:
    """Function that adds models over the line images to a report, as placed by two trajectories, before and after."""
    images = [path for path in algorithm.parameterAsFileList(parameters, "IMAGES", context) if path]
    if not images:
        return lambda report: None
    from ...urbanmap_qgis.imagery.views.views import strip_sources

    table = algorithm.read_vector(parameters, "LINES", context, progress)
    if crs:
        algorithm.same_crs("LINES", table.crs, "TRAJECTORY", crs)
    calibration = algorithm.input_path(parameters, "CALIBRATION", context)
    return pictures(*(strip_sources(images, one, calibration) for one in trajectories), table.geometries,
                    table.geometries)
