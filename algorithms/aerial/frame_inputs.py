"""The camera and the orientations of aerial frames, which several algorithms take."""

from __future__ import annotations

ANGLE_ORDERS = ("papers", "usual")
ANGLE_UNITS = ("automatic", "degrees", "gon", "radians")


def read_camera_and_poses(algorithm, parameters, context):
    """The camera of CAMERA and the orientations of EXTERIOR, their angles as ANGLE_UNIT and ANGLE_ORDER say."""
    from ...urbanmap_qgis.aerial.frames.camera import read_camera
    from ...urbanmap_qgis.aerial.frames.exterior_files import read_exterior

    unit, order = (algorithm.parameterAsString(parameters, name, context) for name in ("ANGLE_UNIT", "ANGLE_ORDER"))
    camera = read_camera(algorithm.input_path(parameters, "CAMERA", context))
    return camera, read_exterior(algorithm.input_path(parameters, "EXTERIOR", context), unit, order)
