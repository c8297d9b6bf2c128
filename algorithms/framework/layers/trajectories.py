"""Trajectories and calibrations as parameters: CSV, SBET or a point layer in, the same format out."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from qgis.core import (
    QgsCoordinateTransformContext,
    QgsProcessingContext,
    QgsProcessingFeatureSource,
    QgsProcessingUtils,
    QgsVectorFileWriter,
    QgsWkbTypes,
)

from ....urbanmap_qgis.errors import InputError, OutputError
from ..declaring.parameters import Declarations, is_optional, is_plain_table, tr
from . import layers
from .crs import crs_from

ANGLES = ("degrees", "radians", "degrees_from_east", "radians_from_east")

GEOID_FILTER = "Geoid model (*.tif *.tiff *.gtx *.asc *.isg);;All files (*)"

TABLE_SUFFIXES = (".csv", ".txt", ".out", ".sbet")

# QGIS refuses a value that does not fit the filter, also a layer's name.
TRAJECTORY_FILTER = "Trajectory (*.csv *.txt *.out *.sbet *.gpkg *.shp *.geojson);;All files (*)"


class TrajectoryParameters(Declarations):
    """Methods with which an algorithm declares, reads and writes trajectories."""

    def trajectory_names(self) -> set[str]:
        """Names of the parameters that take a trajectory."""
        if not hasattr(self, "_trajectory_names"):
            self._trajectory_names: set[str] = set()
        return self._trajectory_names

    def add_trajectory(self, name: str = "TRAJECTORY", label: str = "Trajectory", help: str = "",
                       optional: bool = False):
        """A trajectory; read with `read_trajectory`."""
        text = help or ("Where the vehicle was: CSV time,x,y,z,roll,pitch,heading (GPS seconds, metres, degrees), "
                        "Applanix SBET, or a point layer with these fields.")
        self.trajectory_names().add(name)
        return self.add_file(name, label, text, TRAJECTORY_FILTER, optional=optional)

    def add_trajectories(self, help: str = "", optional: bool = False) -> None:
        """TRAJECTORY of several drives and how all of them are read; read with `read_trajectories`."""
        self.add_files("TRAJECTORY", "Trajectories", help or "The trajectory of each drive, with which its points were "
                       "placed: CSV time,x,y,z,roll,pitch,heading, SBET, or point layers.", optional)
        self.add_trajectory_reading()

    def add_trajectory_output(self, label: str = "Corrected trajectory"):
        """OUTPUT, a trajectory in the format of the one that was given; see `write_trajectory`."""
        return self.add_file_output("OUTPUT", label, "The same epochs in the format of the trajectory given.",
                                    TRAJECTORY_FILTER)

    def add_calibration(self, optional: bool = False):
        """CALIBRATION; read with `read_calibration`."""
        return self.add_file("CALIBRATION", "Calibration", "JSON file of the scanners' (and cameras') lever arms and "
                             "angles on the vehicle.", "Calibration (*.json)", optional=optional)

    def read_calibration(self, parameters: Mapping, context: QgsProcessingContext):
        """The core's `Calibration` of CALIBRATION, None where none was given."""
        from ....urbanmap_qgis.mobile.calibration import read_calibration

        path = self.input_path(parameters, "CALIBRATION", context)
        return read_calibration(path) if path else None

    def add_trajectory_reading(self) -> None:
        """Declare ANGLES, GEOID and GEOID_HEIGHT, which hold for all trajectories of the algorithm."""
        self.add_choice("ANGLES", "Angles of the trajectory", "How roll, pitch and heading of tables and layers are "
                        "counted: degrees or radians, headings clockwise from grid north or counter-clockwise from "
                        "east. SBET says it itself.", ANGLES, "degrees", advanced=True)
        self.add_file("GEOID", "Geoid model", "GeoTIFF, GTX or text grid of GSI (.asc, .isg) of the geoid's heights "
                      "above the ellipsoid: with it the ellipsoidal heights of SBET become heights above sea level, as "
                      "those of the points must be.", GEOID_FILTER, optional=True, advanced=True)
        self.add_number("GEOID_HEIGHT", "Height of the geoid", "One height above the ellipsoid for all places, instead "
                        "of a model.", None, -120.0, 120.0, unit="m", optional=True, advanced=True)

    def trajectory_reading(self, parameters: Mapping, context: QgsProcessingContext):
        """The core's `TrajectoryReading` of ANGLES, GEOID and GEOID_HEIGHT; the usual one where none is declared."""
        from ....urbanmap_qgis.mobile.trajectory_reading import USUAL, TrajectoryReading

        if self.parameterDefinition("ANGLES") is None:
            return USUAL
        return TrajectoryReading(self.parameterAsString(parameters, "ANGLES", context), self.geoid(parameters, context))

    def geoid(self, parameters: Mapping, context: QgsProcessingContext):
        """The core's `Geoid` of GEOID or GEOID_HEIGHT, None where neither is given."""
        from ....urbanmap_qgis.io.conversion.geoid import Geoid, read_geoid

        path = self.input_path(parameters, "GEOID", context)
        if parameters.get("GEOID_HEIGHT") is None:
            return read_geoid(path) if path else None
        if path:
            raise InputError(tr("{0} and {1} are both given: give one of them.").format(
                self.label_of("GEOID"), self.label_of("GEOID_HEIGHT")))
        return Geoid.constant(self.parameterAsDouble(parameters, "GEOID_HEIGHT", context))

    def read_trajectory(self, parameters: Mapping, name: str, context: QgsProcessingContext,
                        crs_wkt: str | None = None, progress=None):
        """The core's `TrajectoryFile` of a parameter, None where an optional one was not given.

        `crs_wkt` is the survey's CRS, into which SBET's latitudes and longitudes go. What was put right or looks wrong
        in the trajectory is told as warnings, what was done to its heights as a message.
        """
        text = self.parameterAsFile(parameters, name, context)
        if not text:
            return None
        read = trajectory_of(text, self.label_of(name), context, crs_wkt, self.trajectory_reading(parameters, context))
        if progress is not None:
            tell_of(read, progress)
        return read

    def check_trajectory(self, parameters: Mapping, name: str, context: QgsProcessingContext) -> None:
        """Refuse a file or layer that does not exist."""
        text = self.parameterAsFile(parameters, name, context)
        if text and not trajectory_exists(text, context):
            raise InputError(tr("{0}: {1} does not exist; check its name.").format(self.label_of(name), text))

    def files_of(self, parameters: Mapping, name: str, context: QgsProcessingContext) -> list[str]:
        """What a parameter of several files names, each once; trajectories may be layers.

        Raises
        ------
        InputError : a file or layer does not exist, or none was given where one is needed.
        """
        texts = list(dict.fromkeys(text for text in self.parameterAsFileList(parameters, name, context) if text))
        for text in texts:
            if not (trajectory_exists(text, context) if name == "TRAJECTORY" else Path(text).exists()):
                raise InputError(tr("{0}: {1} does not exist; check its name.").format(self.label_of(name), text))
        if not texts and not is_optional(self.parameterDefinition(name)):
            raise InputError(tr("{0}: no file was given.").format(self.label_of(name)))
        return texts

    def read_trajectories(self, parameters: Mapping, context: QgsProcessingContext, crs_wkt: str, progress,
                          other: str = "POINTS") -> list:
        """The core's `TrajectoryFile` of each one that TRAJECTORY names, in the CRS of the parameter `other`."""
        reading = self.trajectory_reading(parameters, context)
        read = [trajectory_of(text, self.label_of("TRAJECTORY"), context, crs_wkt, reading)
                for text in self.files_of(parameters, "TRAJECTORY", context)]
        for item in read:
            if item.crs_wkt:
                self.same_crs("TRAJECTORY", item.crs_wkt, other, crs_wkt)
            tell_of(item, progress)
        return read

    def trajectory_files(self, parameters: Mapping, context: QgsProcessingContext) -> list[Path]:
        """The files that TRAJECTORY names, which name the drives."""
        return [Path(text.split("|")[0]) for text in self.files_of(parameters, "TRAJECTORY", context)]

    def joined_trajectory(self, parameters: Mapping, context: QgsProcessingContext, crs_wkt: str, progress):
        """One trajectory of all that TRAJECTORY names, in the CRS of BUILDINGS."""
        from ....urbanmap_qgis.mobile.trajectory import joined_trajectory

        read = self.read_trajectories(parameters, context, crs_wkt, progress, "BUILDINGS")
        return joined_trajectory([item.trajectory for item in read],
                                 [path.name for path in self.trajectory_files(parameters, context)])

    def write_trajectory(self, parameters: Mapping, name: str, context: QgsProcessingContext, like, trajectory,
                         crs_wkt: str | None = None) -> str | None:
        """Write a trajectory of the same epochs in the format of `like`; None where it is not wanted.

        `crs_wkt` is needed where `like` came as a layer.
        """
        path = self.output_path(parameters, name, context)
        return None if path is None else str(write_trajectory_file(path, like, trajectory, crs_wkt, context))


def write_trajectory_file(path: Path, like, trajectory, crs_wkt: str | None, context: QgsProcessingContext) -> Path:
    """Write a trajectory of the same epochs in the format of `like`; the path that it got."""
    from ....urbanmap_qgis.mobile.trajectory_files import write_trajectory

    if like.format != "layer":
        write_trajectory(path, like, trajectory)
        return path
    path = path.with_suffix(".gpkg") if path.suffix.lower() in TABLE_SUFFIXES else path
    _write_layer(path, like, trajectory, crs_wkt or like.crs_wkt or "", context)
    return path


def tell_of(read, progress) -> None:
    """Tell what was put right, looks wrong or was done to the heights of a core's `TrajectoryFile`."""
    from ....urbanmap_qgis.progress import notice

    for note in read.notes:
        notice(note)
    if read.applied:
        progress.message(read.applied)


def trajectory_of(text: str, label: str, context: QgsProcessingContext, crs_wkt: str | None = None, reading=None):
    """The core's `TrajectoryFile` of a file (CSV, SBET, vector file) or of a layer that QGIS knows.

    `reading` is the core's `TrajectoryReading`, None for the usual one.
    """
    from dataclasses import replace

    from ....urbanmap_qgis.mobile.trajectory_files import read_trajectory, trajectory_from_columns
    from ....urbanmap_qgis.mobile.trajectory_reading import USUAL

    reading = reading or USUAL
    if Path(text).suffix.lower() in TABLE_SUFFIXES or is_plain_table(text):
        return read_trajectory(text, crs_wkt, reading)
    table = _layer_table(text, label, context)
    columns = dict(table.columns)
    lower = {key.lower() for key in columns}
    if not {"x", "y"} <= lower and table.geometries is not None:
        import shapely

        columns["x"], columns["y"] = shapely.get_x(table.geometries), shapely.get_y(table.geometries)
    result = trajectory_from_columns(columns, label, reading)
    return replace(result, header=tuple(table.columns), delimiter="", crs_wkt=table.crs_wkt or crs_wkt)


def trajectory_exists(text: str, context: QgsProcessingContext) -> bool:
    """Whether there is such a file or layer."""
    return (Path(text.split("|")[0]).is_file()
            or QgsProcessingUtils.mapLayerFromString(text, context, False) is not None)


def _layer_table(text: str, label: str, context: QgsProcessingContext) -> layers.VectorTable:
    layer = QgsProcessingUtils.mapLayerFromString(text, context)
    if layer is None or not hasattr(layer, "fields"):
        raise InputError(tr("{0}: {1} is neither a CSV, an SBET nor a point layer; check the file.").format(
            label, text))
    return layers.read_source(QgsProcessingFeatureSource(layer, context), label)


def _write_layer(path: Path, like, trajectory, crs_wkt: str, context: QgsProcessingContext) -> None:
    """A GeoPackage (or what the name says) of points with the trajectory's fields."""
    import shapely

    from ....urbanmap_qgis.io.files.atomic import written_beside
    from ....urbanmap_qgis.mobile.trajectory_files import COLUMNS, columns_in_file

    values = {**columns_in_file(like, trajectory), **like.columns}
    text = [name for name in like.columns if any(isinstance(value, str) for value in like.columns[name])]
    fields = layers.make_fields(*((name, "real") for name in COLUMNS),
                                *((name, "text" if name in text else "real") for name in like.columns))
    values = {name: values[name] if name in COLUMNS or name in text else
              [None if value is None else float(value) for value in values[name]] for name in values}
    points = shapely.points(trajectory.place)
    options = QgsVectorFileWriter.SaveVectorOptions()
    options.driverName = QgsVectorFileWriter.driverForExtension(path.suffix)
    options.layerName = path.stem
    with written_beside(path) as temporary:
        writer = QgsVectorFileWriter.create(str(temporary), fields, QgsWkbTypes.Type.PointZ, crs_from(crs_wkt),
                                            QgsCoordinateTransformContext(), options)
        if writer.hasError():
            raise OutputError(tr("{0} cannot be written: {1}").format(path, writer.errorMessage()))
        for batch in layers.features_of(fields, values, points):
            writer.addFeatures(batch)
        del writer
        layers.without_times(temporary)
