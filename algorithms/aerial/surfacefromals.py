"""urbanmap:surfacefromals."""

from __future__ import annotations

from ...urbanmap_qgis.settings.terrain import ClothSettings, SurfaceSettings
from ..framework.base import UrbanMapAlgorithm

MESH_FILTER = "PLY mesh (*.ply)"


class SurfaceFromAls(UrbanMapAlgorithm):
    ID = "surfacefromals"
    NAME = "Surface and ground from ALS"
    SOURCE = "Javanmardi, 3.2.1.1 and 4.1; cloth filter: Zhang et al. 2016"
    KEYWORDS = ("DSM", "DTM", "DEM", "surface", "ground", "terrain", "Delaunay", "TIN", "cloth", "CSF", "lidar")
    REQUIRES = ("numpy", "scipy", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    HELP = (
        "Makes the surface (DSM) and the ground elevation of a laser point cloud as rasters.\n"
        "The surface is the 2.5D Delaunay triangulation of the highest point of each cell. The ground is the "
        "triangulation of the ground points, which also spans buildings: it has no gap under them. Ground "
        "points are those classified so (classes 2, 8, 10, 11; not water) or, where the cloud is unclassified, those "
        "that a cloth drawn up from below touches.\n"
        "Noise (classes 7 and 18), withheld points and points alone in space are left out. The files may be larger "
        "than memory. Cells without a height hold -9999."
    )

    def declare(self):
        self.add_points()
        self.add_settings(SurfaceSettings, "resolution", "ground")
        self.add_settings(ClothSettings)
        self.add_settings(SurfaceSettings)
        self.add_points_crs()
        self.add_raster_output("OUTPUT", "Surface", "Heights of the surface (DSM) in metres.")
        self.add_raster_output("OUTPUT_GROUND", "Ground", "Heights of the ground in metres, without gaps inside the "
                               "surface's outline.", optional=True)
        self.add_file_output("OUTPUT_MESH", "Surface mesh", "The triangles of the surface as binary PLY, which QGIS "
                             "opens as a mesh layer.", MESH_FILTER, optional=True)
        self.add_number_output("POINTS_READ", "Points read", "All points in the files.")
        self.add_number_output("POINTS_USED", "Points used", "Points that are not noise or withheld.")
        self.add_number_output("GROUND_SHARE", "Ground share", "Ground points as a share of the points used, 0 to 1; "
                               "no value without a ground raster.")
        self.add_number_output("EMPTY_SHARE", "Empty share", "Share of the surface's cells without a height, 0 to 1.")
        self.add_number_output("FAR_SHARE", "Share far from points", "Share of the cells in triangles with a side of "
                               "10 m or more, where the surface is a guess, 0 to 1.")
        self.add_number_output("TRIANGLES", "Triangles", "Triangles of the surface.")
        self.add_number_output("TRIANGLES_LEFT_OUT", "Triangles left out", "Those longer than the longest edge.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.io.points.pointcloud import open_cloud
        from ...urbanmap_qgis.terrain.surface_files import surfaces_from_files

        paths = self.point_files(parameters, "POINTS", context)
        self.require_projected("POINTS", open_cloud(paths).crs_wkt)
        settings = self.settings(SurfaceSettings, parameters, context,
                                 cloth=self.settings(ClothSettings, parameters, context))
        surface = self.output_layer_path(parameters, "OUTPUT", context, style="dsm")
        ground = self.output_layer_path(parameters, "OUTPUT_GROUND", context, style="ground")
        mesh = self.output_path(parameters, "OUTPUT_MESH", context)
        result = surfaces_from_files(paths, surface, ground, mesh, settings, progress)
        results = {"OUTPUT": str(surface), "POINTS_READ": result.points_read, "POINTS_USED": result.points_used,
                   "EMPTY_SHARE": result.empty_share, "FAR_SHARE": result.far_share, "TRIANGLES": result.triangles,
                   "TRIANGLES_LEFT_OUT": result.triangles_left_out}
        if ground:
            results["OUTPUT_GROUND"] = str(ground)
            results["GROUND_SHARE"] = result.ground_points / result.points_used
        if mesh:
            results["OUTPUT_MESH"] = str(mesh)
        return results
