"""What is known of a file without reading it whole: one record for each file, or each layer of a file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..wording import known, mark, say

POINTS, TEXT_POINTS, SCANS = "points", "text_points", "scans"
FRAME, LINE_IMAGE, FRAME_MASK = "frame", "line_image", "frame_mask"
ORTHOPHOTO, ELEVATION, MARKING_MASK, RASTER = "orthophoto", "elevation", "marking_mask", "raster"
CAMERA, CALIBRATION, EXTERIOR = "camera", "calibration", "exterior"
TRAJECTORY, IMAGE_POSES, CONTROL, TIE_POINTS, IMAGE_TIMES = "trajectory", "poses", "control", "ties", "image_times"
CLOUD_CONTROL, FRAME_CONTROL = "cloud_control", "frame_control"
OUTLINES, GSI_OUTLINES, GSI_DEM, GSI_OTHER = "outlines", "gsi_outlines", "gsi_dem", "gsi_other"
MARKINGS, BUILDING_MODELS, CITY_MODEL, ROOFS = "markings", "building_models", "city_model", "roofs"
LANE_MAP, ROADS, AREAS, LINES, PLACES = "lane_map", "roads", "areas", "lines", "places"
OBSERVATIONS, NAVIGATION, ORBITS = "observations", "navigation", "orbits"
JOB, TABLE, MESH, TEXTURE, REPORT, OTHER = "job", "table", "mesh", "texture", "report", "other"

KIND_NAMES = {
    POINTS: mark("Point cloud"), TEXT_POINTS: mark("Points as text"), SCANS: mark("Line scans"),
    FRAME: mark("Aerial frame"), LINE_IMAGE: mark("Line image"), FRAME_MASK: mark("Mask of an image"),
    ORTHOPHOTO: mark("Orthophoto"), ELEVATION: mark("Elevation raster"), MARKING_MASK: mark("Marking mask"),
    RASTER: mark("Raster of another kind"), CAMERA: mark("Camera"), CALIBRATION: mark("Calibration"),
    EXTERIOR: mark("Exterior orientation"), TRAJECTORY: mark("Trajectory"), IMAGE_POSES: mark("Image poses"),
    CLOUD_CONTROL: mark("Control points of a point cloud"), FRAME_CONTROL: mark("Points in frames"),
    CONTROL: mark("Control points"), TIE_POINTS: mark("Tie points"), IMAGE_TIMES: mark("Times of a line image"),
    OUTLINES: mark("Building outlines"), GSI_OUTLINES: mark("Building outlines (GSI)"),
    GSI_DEM: mark("Elevation model (GSI)"), GSI_OTHER: mark("Other objects (GSI)"),
    MARKINGS: mark("Road markings"), BUILDING_MODELS: mark("Building models"), CITY_MODEL: mark("City model"),
    ROOFS: mark("Roof polygons"), LANE_MAP: mark("Lane map"),
    ROADS: mark("Road edges or surfaces"), AREAS: mark("Areas of another kind"),
    LINES: mark("Lines"), PLACES: mark("Points of a layer"), OBSERVATIONS: mark("GNSS observations"),
    NAVIGATION: mark("GNSS navigation"), ORBITS: mark("GNSS orbits"), JOB: mark("UrbanMap job"),
    TABLE: mark("Table of another kind"), MESH: mark("Mesh"), TEXTURE: mark("Texture of a model"),
    REPORT: mark("Report"), OTHER: mark("Of no known use"),
}
"""English name of each kind."""

UNKNOWN_HEIGHTS = "unknown"


@dataclass(frozen=True)
class FileFacts:
    """What a file, or one layer of it, is.

    Attributes
    ----------
    path : the file.
    kind : a key of `KIND_NAMES`.
    layer : name of the layer where the file holds several.
    detail : more on it in a few words, such as "RINEX 3.03".
    crs_wkt : its coordinate reference system, "" where it states none.
    heights : its height system in a word, "unknown" where it states none.
    extent : x_min, y_min, x_max, y_max in its own system; None where it has no place or it is not known cheaply.
    times : first and last time, s, as it counts them; None where it has none.
    count : of points, epochs, features, pixels' columns times rows; None where not known.
    doubt : why the kind may be another one, "" where the content says it.
    notes : sentences on what is odd but does not keep it from being used.
    problem : why it cannot be used, a sentence; "" for a sound file.
    use : what the user says that it is used as, a key of `roles.USES`; "" where he left it to the program.
    """

    path: Path
    kind: str
    layer: str = ""
    detail: str = ""
    crs_wkt: str = ""
    heights: str = UNKNOWN_HEIGHTS
    extent: tuple[float, float, float, float] | None = None
    times: tuple[float, float] | None = None
    count: int | None = None
    doubt: str = ""
    notes: tuple[str, ...] = ()
    problem: str = ""
    use: str = ""

    @property
    def usable(self) -> bool:
        """Whether it is sound and of a use."""
        return not self.problem and self.kind not in (OTHER, TABLE, RASTER, AREAS, REPORT, GSI_OTHER, TEXTURE)

    @property
    def source(self) -> str:
        """How an input names it: the path, with the layer where it has several."""
        return f"{self.path}|layername={self.layer}" if self.layer else str(self.path)

    @property
    def label(self) -> str:
        """Its name without folders, for messages."""
        return f"{self.path.name} ({self.layer})" if self.layer else self.path.name


def without_system(name: str, wkt: str) -> tuple[str, ...]:
    """A sentence on a file that states no system, none for others: `notes` of its facts."""
    return () if wkt else (say("{name} states no coordinate reference system: say it where it is used.", name=name),)


def kind_name(kind: str) -> str:
    """Name of a kind in the user's language."""
    return known(KIND_NAMES[kind])
