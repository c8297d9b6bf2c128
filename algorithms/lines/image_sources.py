"""Line images and frames as parameters, shared by the algorithms that work with images."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr


def add_images(algorithm) -> None:
    """Declare IMAGES, TRAJECTORY and CALIBRATION of line cameras, and FRAMES, CAMERA and EXTERIOR of frames."""
    algorithm.add_files("IMAGES", "Line images", "Strip images of line cameras, one column a time, each with the table "
                        "of its columns' times beside it (column,time).", optional=True)
    algorithm.add_trajectory(optional=True)
    algorithm.add_trajectory_reading()
    algorithm.add_calibration(optional=True)
    algorithm.add_files("FRAMES", "Frames", "Perspective images, each named in the exterior orientation.",
                        optional=True)
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
    lines, frames = (algorithm.files_of(parameters, name, context) for name in ("IMAGES", "FRAMES"))
    if not lines and not frames and not parameters.get(other):
        raise InputError(tr("No image was given; give line images, frames or an orthophoto.") if other else
                         tr("No image was given; give line images or frames."))
    for given, needed in ((lines, ("TRAJECTORY", "CALIBRATION")), (frames, ("CAMERA", "EXTERIOR"))):
        missing = [algorithm.label_of(name) for name in needed if not parameters.get(name)]
        if given and missing:
            raise InputError(tr("{0}: is needed for these images; give it.").format(", ".join(missing)))


def image_sources(algorithm, parameters, context, crs_wkt, progress) -> list:
    """Line images and frames as the core takes them; `crs_wkt` is that of the map coordinates."""
    from ...urbanmap_qgis.imagery.views.views import frame_sources, strip_sources

    found = []
    lines = algorithm.files_of(parameters, "IMAGES", context)
    if lines:
        read = algorithm.read_trajectory(parameters, "TRAJECTORY", context, crs_wkt, progress)
        found += strip_sources(lines, read.trajectory, algorithm.input_path(parameters, "CALIBRATION", context))
    frames = algorithm.files_of(parameters, "FRAMES", context)
    if frames:
        found += frame_sources(frames, algorithm.input_path(parameters, "CAMERA", context),
                               algorithm.input_path(parameters, "EXTERIOR", context), len(found))
    return found
