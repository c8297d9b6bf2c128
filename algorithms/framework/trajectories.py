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

from ...urbanmap_qgis.errors import InputError, OutputError
from . import layers
from .crs import crs_from
from .parameters import Declarations, tr

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

    def add_trajectory_output(self, name: str = "OUTPUT", label: str = "Corrected trajectory", help: str = "",
                              optional: bool = False, by_default: bool = False):
        """A trajectory to write in the format of the one that was given; see `write_trajectory`."""
        text = help or "The same epochs in the format of the trajectory given."
        return self.add_file_output(name, label, text, TRAJECTORY_FILTER, optional, by_default)

    def add_calibration(self, name: str = "CALIBRATION", optional: bool = False):
        """A calibration file; read it with the core's `read_calibration(self.input_path(...))`."""
        return self.add_file(name, "Calibration", "JSON file of the scanners' (and cameras') lever arms and angles on "
                             "the vehicle.", "Calibration (*.json)", optional=optional)

    def read_trajectory(self, parameters: Mapping, name: str, context: QgsProcessingContext,
                        crs_wkt: str | None = None, progress=None):
        """The core's `TrajectoryFile` of a parameter, None where an optional one was not given.

        `crs_wkt` is the survey's CRS, into which SBET's latitudes and longitudes go. What was put right or looks wrong
        in the trajectory is told as warnings.
        """
        text = self.parameterAsFile(parameters, name, context)
        if not text:
            return None
        read = trajectory_of(text, self.label_of(name), context, crs_wkt)
        for note in read.notes if progress is not None else ():
            progress.warn(note)
        return read

    def write_trajectory(self, parameters: Mapping, name: str, context: QgsProcessingContext, like, trajectory,
                         crs_wkt: str | None = None) -> str | None:
        """Write a trajectory of the same epochs in the format of `like`; None where it is not wanted.

        `crs_wkt` is needed where `like` came as a layer.
        """
        path = self.output_path(parameters, name, context)
        return None if path is None else str(write_trajectory_file(path, like, trajectory, crs_wkt, context))


def write_trajectory_file(path: Path, like, trajectory, crs_wkt: str | None, context: QgsProcessingContext) -> Path:
    """Write a trajectory of the same epochs in the format of `like`; the path that it got."""
    from ...urbanmap_qgis.mobile.trajectory_files import write_trajectory

    if like.format != "layer":
        write_trajectory(path, like, trajectory)
        return path
    path = path.with_suffix(".gpkg") if path.suffix.lower() in TABLE_SUFFIXES else path
    _write_layer(path, like, trajectory, crs_wkt or like.crs_wkt or "", context)
    return path


def trajectory_of(text: str, label: str, context: QgsProcessingContext, crs_wkt: str | None = None):
    """The core's `TrajectoryFile` of a file (CSV, SBET, vector file) or of a layer that QGIS knows."""
    from ...urbanmap_qgis.mobile.trajectory_files import TrajectoryFile, read_trajectory, trajectory_from_columns

    if Path(text).suffix.lower() in TABLE_SUFFIXES:
        return read_trajectory(text, crs_wkt)
    table = _layer_table(text, label, context)
    columns = dict(table.columns)
    lower = {key.lower() for key in columns}
    if not {"x", "y"} <= lower and table.geometries is not None:
        import shapely

        columns["x"], columns["y"] = shapely.get_x(table.geometries), shapely.get_y(table.geometries)
    made = trajectory_from_columns(columns, label)
    return TrajectoryFile(made.trajectory, "layer", made.notes, made.columns, tuple(table.columns), "",
                          table.crs_wkt or crs_wkt)


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

    from ...urbanmap_qgis.io.atomic import written_beside
    from ...urbanmap_qgis.mobile.trajectory_files import COLUMNS, columns_of

    values = {**columns_of(trajectory), **like.columns}
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
