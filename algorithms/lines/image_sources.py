"""Line images and frames as parameters, shared by the algorithms that work with images."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessing, QgsProcessingParameterMultipleLayers

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr


def add_images(algorithm) -> None:
    """Declare IMAGES, TRAJECTORY and CALIBRATION of line cameras, and FRAMES, CAMERA and EXTERIOR of frames."""
    files = QgsProcessing.SourceType.TypeFile
    algorithm.declare_parameter(QgsProcessingParameterMultipleLayers(
        "IMAGES", tr("Line images"), files, None, True), "Strip images of line cameras, one column a time, each with "
        "the table of its columns' times beside it (column,time).")
    algorithm.add_trajectory(optional=True)
    algorithm.add_trajectory_reading()
    algorithm.add_calibration(optional=True)
    algorithm.declare_parameter(QgsProcessingParameterMultipleLayers(
        "FRAMES", tr("Frames"), files, None, True), "Perspective images, each named in the exterior orientation.")
    algorithm.add_file("CAMERA", "Camera", "JSON file of the frames' camera.", "Camera (*.json)", optional=True)
    algorithm.add_file("EXTERIOR", "Exterior orientation", "CSV file image,x,y,z,omega,phi,kappa of the frames, or "
                       "what Metashape or Pix4D wrote.",
                       "Exterior orientation (*.csv *.txt)", optional=True)


def check_images(algorithm, parameters, context, other: str = "") -> None:
    """Refuse a run without images, or with images without what they need; `other` names a raster that is one too.

    Raises
    ------
    InputError : with what is missing.
    """
    lines, frames = (algorithm.parameterAsFileList(parameters, name, context) for name in ("IMAGES", "FRAMES"))
    if not any(lines) and not any(frames) and not parameters.get(other):
        raise InputError(tr("No image was given; give line images, frames or an orthophoto.") if other else
                         tr("No image was given; give line images or frames."))
    for given, needed in ((lines, ("TRAJECTORY", "CALIBRATION")), (frames, ("CAMERA", "EXTERIOR"))):
        missing = [algorithm.label_of(name) for name in needed if not parameters.get(name)]
        if any(given) and missing:
            raise InputError(tr("{0}: is needed for these images; give it.").format(", ".join(missing)))
    for name in ("IMAGES", "FRAMES"):
        for text in algorithm.parameterAsFileList(parameters, name, context):
            if text and not Path(text).exists():
                raise InputError(tr("{0}: {1} does not exist; check its name.").format(algorithm.label_of(name), text))


def image_sources(algorithm, parameters, context, crs_wkt, progress) -> list:
    """Line images and frames as the core takes them; `crs_wkt` is that of the map coordinates."""
    from ...urbanmap_qgis.imagery.views.views import frame_sources, strip_sources

    found = []
    lines = [path for path in algorithm.parameterAsFileList(parameters, "IMAGES", context) if path]
    if lines:
        read = algorithm.read_trajectory(parameters, "TRAJECTORY", context, crs_wkt, progress)
        found += strip_sources(lines, read.trajectory, algorithm.input_path(parameters, "CALIBRATION", context))
    frames = [path for path in algorithm.parameterAsFileList(parameters, "FRAMES", context) if path]
    if frames:
        found += frame_sources(frames, algorithm.input_path(parameters, "CAMERA", context),
                               algorithm.input_path(parameters, "EXTERIOR", context), len(found))
    return found
