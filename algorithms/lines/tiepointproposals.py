"""urbanmap:tiepointproposals."""

from __future__ import annotations

from contextlib import contextmanager

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import crs_from

FIELDS = ("set", "time", "length", "support", "fit")


class TiePointProposals(UrbanMapAlgorithm):
    ID = "tiepointproposals"
    NAME = "Propose tie points"
    SOURCE = "Zhao and Shibasaki, 3.2, where tie points are assigned by hand"
    KEYWORDS = ("tie points", "corners", "buildings", "walls", "rectification", "registration", "mobile")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs")
    HELP = (
        "Proposes tie points for “Rectify trajectory”: corners of buildings that both the survey and outlines or a "
        "surface show.\nWhere points of the survey stand over each other there are walls; the two walls of each corner "
        "are looked for along the building's edges, and meet in the survey's corner. Of several possible places the "
        "one is taken that is shifted like the corners measured about the same time. Corners are gathered in sets of "
        "two.\n"
        "Each line of the result runs from the survey to the reference. Look at them before they are used: delete "
        "wrong ones, move ends, add others. They are as good as the reference: give its accuracy as “Sigma of tie "
        "points” to the rectification. Edges of a surface are those of the roofs."
    )

    def declare(self):
        self.add_points(help="The survey, placed with the trajectory: one or several LAS, LAZ or COPC files with GPS "
                        "times.")
        self.add_trajectory()
        self.add_trajectory_reading()
        self.add_polygons("BUILDINGS", "Buildings", "Outlines of the walls in the survey's coordinate system. Without "
                          "them give a surface.", optional=True)
        self.add_raster("SURFACE", "Surface", "Heights of a surface model (DSM) with its buildings, instead of "
                        "outlines: cells of 0.5 m give corners to 0.1 m, of 1 m to 0.4 m.", optional=True)
        self.add_distance("REACH", "Maximum distance", "Corners farther from the course, in metres, are left out.",
                          30.0, 1.0, 200.0)
        self.add_distance("SEARCH", "Search range", "How far survey and outlines may lie apart, in metres.", 2.5, 0.2,
                          20.0)
        self.add_distance("AGREEMENT", "Agreement", "Shifts of neighbouring corners that differ by less, in metres, "
                          "agree: as good as the outlines are.", 0.5, 0.05, 5.0, advanced=True)
        self.add_layer_output("OUTPUT", "Tie points", "Lines from the survey to the reference with set, time (s), "
                              "length (m), support (other corners shifted likewise) and fit of the walls (m).",
                              kind="line")
        self.add_number_output("CORNERS", "Corners", "Corners of buildings near the course.")
        self.add_number_output("FOUND", "Corners found", "Corners that the survey shows.")
        self.add_number_output("SETS", "Sets", "Sets of two tie points.")
        self.add_number_output("MEAN_LENGTH", "Mean length", "Mean distance between survey and reference.", unit="m")

    def check(self, parameters, context):
        if bool(parameters.get("BUILDINGS")) == bool(parameters.get("SURFACE")):
            raise InputError(tr("Give either {0} or {1}.").format(self.label_of("BUILDINGS"), self.label_of("SURFACE")))

    def work(self, parameters, context, progress):
        import numpy as np
        import shapely

        from ...urbanmap_qgis.io.points.pointcloud import open_cloud
        from ...urbanmap_qgis.mobile.gps_time import time_shift
        from ...urbanmap_qgis.mobile.lines.tie_point_proposals import propose_tie_points

        with self._reference(parameters, context, progress.part(0.0, 0.05)) as (crs_wkt, corners_of):
            cloud = open_cloud(self.point_files(parameters, "POINTS", context), crs_wkt)
            self.same_crs("POINTS", cloud.crs_wkt, "BUILDINGS" if parameters.get("BUILDINGS") else "SURFACE", crs_wkt)
            trajectory = self.read_trajectory(parameters, "TRAJECTORY", context, cloud.crs_wkt, progress).trajectory
            corners = corners_of(trajectory, self.parameterAsDouble(parameters, "REACH", context))
        reach, search, agreement = (self.parameterAsDouble(parameters, name, context)
                                    for name in ("REACH", "SEARCH", "AGREEMENT"))
        result = propose_tie_points(cloud, trajectory, corners, reach, search, agreement,
                                    time_shift(cloud, trajectory), progress.part(0.1, 0.95))
        ties = result.ties
        length = np.hypot(*(ties.reference - ties.measured).T)
        lines = shapely.linestrings(np.stack([ties.measured, ties.reference], axis=1))
        columns = dict(zip(FIELDS, (ties.sets, ties.time, length, result.support, result.fit)))
        layer = self.write_layer(parameters, "OUTPUT", context, None, columns, crs_from(cloud.crs_wkt),
                                 lines, "LineString", "tie_point_proposals", progress.part(0.95, 1.0))
        return {**layer, "CORNERS": result.corners, "FOUND": result.found, "SETS": len(ties) // 2,
                "MEAN_LENGTH": float(length.mean())}

    @contextmanager
    def _reference(self, parameters, context, progress):
        """CRS of the reference, and what gives its corners near a course."""
        from ...urbanmap_qgis.io.raster import RasterSampler
        from ...urbanmap_qgis.mobile.lines.reference_corners import outline_corners
        from ...urbanmap_qgis.mobile.lines.surface_corners import surface_corners

        if parameters.get("BUILDINGS"):
            outlines = self.read_polygons(parameters, "BUILDINGS", context, progress)
            yield outlines.crs_wkt, lambda trajectory, reach: outline_corners(outlines.geometries)
            return
        with RasterSampler(self.raster_path(parameters, "SURFACE", context)) as surface:
            yield surface.crs_wkt, lambda trajectory, reach: surface_corners(surface, trajectory, reach, progress)
