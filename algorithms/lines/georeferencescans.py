"""urbanmap:georeferencescans."""

from __future__ import annotations

from pathlib import Path

from ...urbanmap_qgis.settings.lines import ScanSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import wkt_of

ANGLE_UNITS = ("degrees", "radians")


class GeoreferenceScans(UrbanMapAlgorithm):
    ID = "georeferencescans"
    NAME = "Georeference range scans"
    SOURCE = "Zhao and Shibasaki, 2.2, eq. 1 and 4 to 7"
    KEYWORDS = ("line scanner", "laser scanner", "range", "profile", "direct georeferencing", "VLMS", "mobile", "LAZ")
    REQUIRES = ("numpy", "pyproj", "laspy", "lazrs")
    HELP = (
        "Places raw measurements of line scanners in the map with the vehicle's trajectory and the calibration.\n"
        "Scans are tables with the columns time (s), angle (degrees), range (m) and, if wanted, intensity and scanner: "
        "CSV (also .gz), Parquet where pyarrow is installed, or LAS and LAZ with gps_time, point_source_id and the "
        "extra dimensions angle and range. The beam at angle a points along (cos a, sin a, 0) in the scanner's axes.\n"
        "Position and angles of the vehicle are linear between epochs. What was measured outside the trajectory's time "
        "or in gaps of it of more than a second is left out and counted. The points keep angle and range."
    )

    def declare(self):
        self.add_files("SCANS", "Range scans", "One or several tables of time, angle, range, intensity and scanner "
                       "(CSV, CSV.GZ, Parquet, LAS, LAZ).")
        self.add_trajectory()
        self.add_trajectory_reading()
        self.add_calibration()
        self.add_crs("CRS", "Coordinate reference system", "Of the trajectory, where its layer does not say it; it is "
                     "written into the point cloud, and needed for SBET trajectories.", optional=True)
        self.add_settings(ScanSettings)
        self.add_choice("ANGLE_UNIT", "Unit of the angles", "Unit of the angles in the file.", ANGLE_UNITS, "degrees",
                        advanced=True)
        self.add_points_output("OUTPUT", "Point cloud", "Points with gps_time, intensity, point_source_id, angle and "
                               "range.")
        self.add_number_output("RETURNS", "Returns", "Returns in the file.")
        self.add_number_output("POINTS", "Points", "Points written.")
        self.add_number_output("WITHOUT_RANGE", "Without a range", "Returns left out for want of a range or angle.")
        self.add_number_output("BEYOND_RANGE", "Beyond the range", "Returns left out because they are too near or far.")
        self.add_number_output("OUTSIDE_TIME", "Outside the time", "Returns left out because they were measured "
                               "outside the trajectory or in a gap of it.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.mobile.lines.georeferencing import georeference_scans

        scans = [Path(text) for text in self.files_of(parameters, "SCANS", context)]
        calibration = self.read_calibration(parameters, context)
        given = self.parameterAsCrs(parameters, "CRS", context)
        file = self.read_trajectory(parameters, "TRAJECTORY", context, wkt_of(given) or None, progress)
        crs = wkt_of(given) or file.crs_wkt
        if crs:
            self.require_projected("CRS" if given.isValid() else "TRAJECTORY", crs)
        else:
            progress.warn(tr("The coordinate reference system is not known: the point cloud is written without one."))
        settings = self.settings(ScanSettings, parameters, context, radians=self.parameterAsString(
            parameters, "ANGLE_UNIT", context) == "radians")
        output = self.output_path(parameters, "OUTPUT", context)
        placed = georeference_scans(scans, file.trajectory, calibration, output, crs, settings, progress)
        for scanner, count in placed.by_scanner.items():
            progress.message(tr("Scanner {0}: {1} points").format(scanner, count))
        if placed.outside:
            progress.warn(tr("{0} returns were measured outside the trajectory or in a gap of it and are left "
                             "out.").format(placed.outside))
        return {"OUTPUT": str(output), "RETURNS": placed.read, "POINTS": placed.written,
                "WITHOUT_RANGE": placed.no_return, "BEYOND_RANGE": placed.too_near + placed.too_far,
                "OUTSIDE_TIME": placed.outside}

