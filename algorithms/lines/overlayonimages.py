"""urbanmap:overlayonimages."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import HTML_FILTER, tr
from .image_sources import add_images, check_images, image_sources

COLOURS = ("height", "intensity", "class", "one")


class OverlayOnImages(UrbanMapAlgorithm):
    ID = "overlayonimages"
    NAME = "Overlay on images"
    SOURCE = "Zhao and Shibasaki, 4.1 and 4.2"
    KEYWORDS = ("overlay", "check", "strip", "frame", "orthophoto", "building frames", "before", "after", "image")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    HELP = (
        "Draws laser points and the edges of building models or other lines on line images, frames and orthophotos, so "
        "that one sees whether they fit.\n"
        "Edges that a building hides are left out, and points behind a nearer surface. With what was before a "
        "correction (trajectory, points, lines) each picture is made twice, and the page switches between them.\n"
        "Points are read once; each image keeps the nearest point of every 3 by 3 pixels."
    )

    def declare(self):
        add_images(self)
        self.add_raster("ORTHOPHOTO", "Orthophoto", "Image of the map, in the CRS of points and lines.", optional=True)
        self.add_points(help="Laser points to draw, LAS, LAZ or COPC.", optional=True)
        self.add_vector("LINES", "Models or lines", "Building models (MultiPolygonZ with all faces) or lines with "
                        "heights; their edges are drawn.", True, kind="geometry")
        self.add_choice("COLOUR", "Colour points by", "What the colours of points tell", COLOURS, "height")
        self.add_points("POINTS_BEFORE", "Laser points before", "The same points before a correction.", True)
        self.add_vector("LINES_BEFORE", "Models or lines before", "The same models or lines before a correction.", True,
                        kind="geometry")
        self.add_trajectory("TRAJECTORY_BEFORE", "Trajectory before", optional=True)
        self.add_distance("REACH", "Maximum range", "Line images show things up to this distance.", 60.0, 1.0,
                          500.0, advanced=True)
        self.add_number("PICTURES", "Pictures on the page", "At most so many; the fullest windows are taken.", 8, 1,
                        100, integer=True, advanced=True)
        self.add_folder_output("OUTPUT", "Folder of images", "Each image with the overlay as JPEG, and the pictures of "
                               "the page before and after beside each other.")
        self.add_file_output("OUTPUT_REPORT", "Page", "Page that switches between plain image, before and after.",
                             HTML_FILTER, optional=True, by_default=True)
        self.add_number_output("DRAWN", "Images drawn on", "Images in which points or edges lie.")
        self.add_number_output("EMPTY", "Images without", "Images in which nothing lies.")

    def check(self, parameters, context):
        check_images(self, parameters, context, "ORTHOPHOTO")
        if not parameters.get("POINTS") and not parameters.get("LINES"):
            raise InputError(tr("There is nothing to draw; give laser points, or models or lines."))
        for name in ("POINTS", "LINES"):
            if parameters.get(f"{name}_BEFORE") and not parameters.get(name):
                raise InputError(tr("{0} was given, but not {1}; give both.").format(
                    self.label_of(f"{name}_BEFORE"), self.label_of(name)))

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.imagery.overlays.overlay_stage import write_overlays

        states = [self._state(parameters, context, "", tr("after") if self._has_before(parameters) else tr("overlay"),
                              progress)]
        if self._has_before(parameters):
            states.insert(0, self._state(parameters, context, "_BEFORE", tr("before"), progress))
        folder = self.parameterAsString(parameters, "OUTPUT", context)
        page = self.output_path(parameters, "OUTPUT_REPORT", context)
        records = write_overlays(states, folder, page, self.parameterAsString(parameters, "COLOUR", context),
                                 self.parameterAsDouble(parameters, "REACH", context),
                                 self.parameterAsInt(parameters, "PICTURES", context), progress)
        empty = [record.image for record in records if record.empty]
        if empty:
            progress.warn(tr("Nothing lies in {0} of {1} images: {2}.").format(len(empty), len(records),
                                                                               ", ".join(empty[:5])))
        results = {"OUTPUT": folder, "DRAWN": len(records) - len(empty), "EMPTY": len(empty)}
        return {**results, "OUTPUT_REPORT": str(page)} if page else results

    @staticmethod
    def _has_before(parameters) -> bool:
        return any(parameters.get(f"{name}_BEFORE") for name in ("POINTS", "LINES", "TRAJECTORY"))

    def _state(self, parameters, context, ending, name, progress):
        """Data of one state; what was not given for it is that of the other."""
        from ...urbanmap_qgis.imagery.overlays.overlay_stage import edge_state

        def chosen(base):
            return f"{base}{ending}" if parameters.get(f"{base}{ending}") else base

        table = self.read_vector(parameters, chosen("LINES"), context, progress)
        cloud = self._cloud(parameters, chosen("POINTS"), context, table)
        crs = table.crs_wkt if table is not None else cloud.crs_wkt
        geometries = list(table.geometries) if table is not None else []
        if table is not None:
            self.require_projected("LINES", table.crs)
        given = {**parameters, "TRAJECTORY": parameters.get(chosen("TRAJECTORY"))}
        sources = image_sources(self, given, context, crs, progress)
        sources += self._orthophoto(parameters, context, crs, len(sources))
        return edge_state(name, sources, geometries, cloud)

    def _cloud(self, parameters, name, context, table):
        """The points, in the CRS of the lines where there are any; None where none were given."""
        paths = self.point_files(parameters, name, context)
        if not paths:
            return None
        from ...urbanmap_qgis.io.points.pointcloud import open_cloud

        cloud = open_cloud(paths, table.crs_wkt if table is not None else None)
        self.require_projected(name, cloud.crs_wkt)
        if table is not None:
            self.same_crs(name, cloud.crs_wkt, "LINES", table.crs)
        return cloud

    def _orthophoto(self, parameters, context, crs, number):
        """The orthophoto as an image, where one was given."""
        path = self.raster_path(parameters, "ORTHOPHOTO", context)
        if path is None:
            return []
        from ...urbanmap_qgis.imagery.views.orthophoto_source import orthophoto_source

        source = orthophoto_source(path, number)
        self.same_crs("ORTHOPHOTO", source.crs_wkt, "POINTS" if not parameters.get("LINES") else "LINES", crs)
        return [source]
