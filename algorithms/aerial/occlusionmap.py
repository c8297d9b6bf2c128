"""urbanmap:occlusionmap."""

from __future__ import annotations

from dataclasses import replace

from ...urbanmap_qgis.settings.aerial import OcclusionSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from .frame_inputs import ANGLE_ORDERS, ANGLE_UNITS, read_camera_and_poses

METHODS = ("refined", "paper")


class OcclusionMap(UrbanMapAlgorithm):
    ID = "occlusionmap"
    NAME = "Occlusion map of a frame"
    SOURCE = "Javanmardi, 3.2.1.1, eq. 1 to 3"
    KEYWORDS = ("perspective occlusion map", "POM", "relief displacement", "building lean", "hidden", "visibility",
                "mask", "aerial", "photograph")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "cv2")
    HELP = (
        "Masks the pixels of an aerial frame that show a building or the ground that a building hides.\n"
        "The surface that is higher above the ground than the threshold is projected into the frame with its camera "
        "and exterior orientation, lens distortion included, and filled, walls too. Trees and bridges as high as that "
        "are masked as well.\n"
        "The edges are as good as the surface: use a resolution near the distance between the laser points. Building "
        "outlines add low buildings and roofs with missing points. The mask has the rows and columns of the frame and "
        "no place in the world."
    )

    def declare(self):
        self.add_file("FRAME", "Frame", "The image: TIFF or JPEG, 8 or 16 bit.",
                      "Images (*.tif *.tiff *.jpg *.jpeg *.TIF *.TIFF *.JPG *.JPEG)")
        self.add_file("CAMERA", "Camera", "JSON with focal_length_mm, pixel_pitch_mm, image_width, image_height, "
                      "principal_point_mm and distortion, if there is any.", "Camera (*.json)")
        self.add_file("EXTERIOR", "Exterior orientation", "CSV with the columns image, x, y, z, omega, phi, kappa, or "
                      "what Metashape or Pix4D wrote; the frame is found by its file name.", "Table (*.csv *.txt)")
        self.add_raster("DSM", "Surface", "Heights of the surface, from “Surface and ground from ALS”, in the CRS and "
                        "height system of the exterior orientation.")
        self.add_raster("GROUND", "Ground", "Heights of the ground, likewise.")
        self.add_settings(OcclusionSettings, "threshold")
        self.add_polygons("FOOTPRINTS", "Building outlines", "Buildings that are masked even if they are lower than "
                          "the threshold or partly missing in the surface. Outlines where nothing stands are left "
                          "alone.",
                          optional=True)
        self.add_settings(OcclusionSettings)
        self.add_choice("METHOD", "Method", "Refined: as set above. Paper: the triangles of the surface higher than "
                        "the threshold as they are; low parts, steep walls and walls at the cells' borders are off.",
                        METHODS, "refined", advanced=True)
        self.add_choice("ANGLE_UNIT", "Unit of the angles", "Automatic takes degrees and stops where the angles look "
                        "like gon or radians.", ANGLE_UNITS, "automatic", advanced=True)
        self.add_choice("ANGLE_ORDER", "Order of the angles", "R_omega R_phi R_kappa as in the papers, or the usual "
                        "R_kappa R_phi R_omega of most bundle adjustments.", ANGLE_ORDERS, "papers", advanced=True)
        self.add_raster_output("OUTPUT", "Occlusion map", "255 = shows a building or is hidden by one, otherwise 0.")
        self.add_number_output("HIDDEN_SHARE", "Hidden share", "Share of the frame that is masked, 0 to 1.")
        self.add_number_output("UNCOVERED_SHARE", "Share not covered", "Share of the frame that looks beyond the "
                               "surface or the ground, where nothing is masked, 0 to 1.")
        self.add_number_output("FOOTPRINTS_RAISED", "Outlines with a building", "Outlines that were masked.")
        self.add_number_output("FOOTPRINTS_FLAT", "Outlines without a building", "Outlines near the frame in which the "
                               "surface shows nothing that stands.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.aerial.frames.frame_images import FrameImage, find_frames
        from ...urbanmap_qgis.aerial.frames.occlusion import PAPER_OCCLUSION, occlusion_map

        camera, poses = read_camera_and_poses(self, parameters, context)
        frame = find_frames([self.input_path(parameters, "FRAME", context)], poses)[0]
        with FrameImage(frame.path, camera):
            progress.message(tr("{0}: {1} x {2} pixels").format(frame.path.name, camera.width, camera.height))
        dsm, ground, outlines = self._heights_and_outlines(parameters, context, progress)
        paper = self.parameterAsString(parameters, "METHOD", context) == "paper"
        settings = self.settings(OcclusionSettings, parameters, context)
        if paper:
            settings = replace(PAPER_OCCLUSION, threshold=settings.threshold)
        output = self.output_layer_path(parameters, "OUTPUT", context)
        result = occlusion_map(camera, frame.pose, dsm, ground, output, settings, outlines, progress)
        if result.footprints_flat:
            progress.message(tr("In {0} outlines the surface shows no building.").format(result.footprints_flat))
        return {"OUTPUT": str(output), "HIDDEN_SHARE": result.hidden_share, "UNCOVERED_SHARE": result.uncovered_share,
                "FOOTPRINTS_RAISED": result.footprints_raised, "FOOTPRINTS_FLAT": result.footprints_flat}

    def _heights_and_outlines(self, parameters, context, progress):
        """Paths of the surface and of the ground, and the outlines' polygons, all in one CRS."""
        from ...urbanmap_qgis.io.raster import RasterSampler

        dsm, ground = (self.raster_path(parameters, name, context) for name in ("DSM", "GROUND"))
        with RasterSampler(dsm) as surface, RasterSampler(ground) as below:
            crs = surface.crs_wkt
            self.require_projected("DSM", crs)
            self.same_crs("DSM", crs, "GROUND", below.crs_wkt)
        table = self.read_polygons(parameters, "FOOTPRINTS", context, progress.part(0.0, 0.0))
        if table is None:
            return dsm, ground, ()
        self.same_crs("DSM", crs, "FOOTPRINTS", table.crs)
        return dsm, ground, table.geometries
