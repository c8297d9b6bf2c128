"""urbanmap:orthorectifyframes."""

from __future__ import annotations

from dataclasses import replace

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from .frame_inputs import ANGLE_ORDERS, ANGLE_UNITS, read_camera_and_poses
from .frame_shifts import FrameShiftsOutput

METHODS = ("vote", "darkest", "paper")
OCCLUSION = ("ground", "frame")


class OrthorectifyFrames(FrameShiftsOutput, UrbanMapAlgorithm):
    ID = "orthorectifyframes"
    NAME = "Orthorectify frames"
    SOURCE = "Javanmardi, 3.2.1"
    KEYWORDS = ("orthophoto", "orthorectification", "true ortho", "mosaic", "aerial", "frames", "vehicles")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "cv2")
    HELP = (
        "Lays aerial frames on the ground as one mosaic. Ground that a building, tree or bridge hides from one frame "
        "is taken from another that sees it; buildings themselves and ground that no frame sees hold no data (0).\n"
        "Differences in exposure between frames are evened out first. With the vehicle filter moving vehicles go, "
        "because another frame shows the road where they stood; vehicles that stand still in all frames stay.\n"
        "Frames, ground and surface must be in one projected coordinate system in metres."
    )

    def declare(self):
        self.add_files("FRAMES", "Frames", "8 or 16 bit TIFF or JPEG images as the camera took them, each named in the "
                       "exterior orientation.")
        self.add_file("CAMERA", "Camera", "JSON file of the camera: focal_length_mm, pixel_pitch_mm, image_width, "
                      "image_height, principal_point_mm, distortion.", "Camera (*.json)")
        self.add_file("EXTERIOR", "Exterior orientation", "CSV file image,x,y,z,omega,phi,kappa (metres, degrees), or "
                      "what Metashape (Omega Phi Kappa) or Pix4D wrote, whose order of angles is known.",
                      "Exterior orientation (*.csv *.txt)")
        self.add_raster("GROUND", "Ground", "Heights of the bare ground in metres; the mosaic has its coordinate "
                        "system.")
        self.add_raster("DSM", "Surface", "Heights of the surface (DSM) in metres, with which hidden ground is told.",
                        optional=True)
        self.add_polygons("FOOTPRINTS", "Building outlines", "Ground inside them is masked too.", optional=True)
        self.add_field("HEIGHT_FIELD", "Field with the buildings' height", "Field of the outlines with the height "
                       "above the ground in metres. Such buildings also hide what lies behind them, where the surface "
                       "lacks them; without it only what the surface shows hides anything.", "FOOTPRINTS",
                       advanced=True)
        self.add_distance("RESOLUTION", "Resolution", "Side of a pixel in metres; 0 for that of the frames.", 0.0, 0.0,
                          100.0)
        self.add_boolean("FILTER_VEHICLES", "Filter vehicles", "Take each pixel so that moving vehicles go; otherwise "
                         "from the frame that looks down most steeply.", True)
        self.add_choice("METHOD", "Vehicle filter", "Majority vote: what most frames agree on, which also keeps dark "
                        "vehicles from winning over paint. Darkest: the frame with the lowest sum of channels. Paper: "
                        "as in the paper, darkest without gain compensation, of frames masked by their plain "
                        "occlusion maps.", METHODS, "vote", advanced=True)
        self.add_boolean("EVEN_EXPOSURE", "Gain compensation", "Bring all frames to one brightness and contrast "
                         "before they are compared.", True, advanced=True)
        self.add_choice("OCCLUSION", "Hidden ground", "Ground: told by lines of sight from the ground to the frame. "
                        "Frame: told by an occlusion map of each frame, which masks it before ground is taken from it, "
                        "as in the paper.", OCCLUSION, "ground", advanced=True)
        self.add_files("MASKS", "Occlusion maps", "Occlusion maps of the frames, from “Occlusion map of a frame”, one "
                       "for each frame in the frames' order; they are then taken instead of being made.", advanced=True,
                       optional=True)
        self.add_distance("HEIGHT_THRESHOLD", "Height threshold", "What stands higher than this above the ground, in "
                          "metres, hides ground; vehicles should not.", 5.0, 0.0, 100.0, advanced=True)
        self.add_choice("ANGLE_ORDER", "Order of the angles", "Papers: R_omega R_phi R_kappa. Usual: R_kappa R_phi "
                        "R_omega, as most bundle adjustments write.", ANGLE_ORDERS, "papers", advanced=True)
        self.add_choice("ANGLE_UNIT", "Unit of the angles", "Automatic: degrees, and an error where they look "
                        "otherwise.", ANGLE_UNITS, "automatic", advanced=True)
        self.add_workers()
        self.add_raster_output("OUTPUT", "Orthophoto", "Mosaic of the frames; 0 where there is no data.")
        self.add_raster_output("OUTPUT_COUNT", "Frames that see the ground", "How many frames see each pixel.",
                               optional=True)
        self.add_number_output("SHARE_SEEN", "Visible share", "Share of the ground in the frames, outside buildings, "
                               "that has an image, 0 to 1.")
        self.add_number_output("HOLE_AREA", "Area of holes", "Ground in the frames, outside buildings, that no frame "
                               "sees.", "m2")
        self.add_number_output("FRAMES_USED", "Frames used", "Frames that gave pixels.")
        self.add_shifts_output()

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.aerial.frames.frame_images import find_frames
        from ...urbanmap_qgis.aerial.orthophotos.mosaic import MosaicFiles
        from ...urbanmap_qgis.aerial.orthophotos.orthorectification import ElevationInputs, orthorectify
        from ...urbanmap_qgis.io.raster import RasterSampler

        camera, poses = read_camera_and_poses(self, parameters, context)
        frames = find_frames(self.parameterAsFileList(parameters, "FRAMES", context), poses)
        ground = self.raster_path(parameters, "GROUND", context)
        surface = self.raster_path(parameters, "DSM", context)
        with RasterSampler(ground) as raster:
            crs = raster.crs_wkt
        self.require_projected("GROUND", crs)
        if surface:
            with RasterSampler(surface) as raster:
                self.same_crs("GROUND", crs, "DSM", raster.crs_wkt)
        outlines = self.read_polygons(parameters, "FOOTPRINTS", context, progress.part(0.0, 0.02))
        if outlines:
            self.same_crs("GROUND", crs, "FOOTPRINTS", outlines.crs)
        settings = self._settings(parameters, context)
        output = self.output_layer_path(parameters, "OUTPUT", context)
        count = self.output_layer_path(parameters, "OUTPUT_COUNT", context)
        place = ElevationInputs(ground, surface, *self._buildings(parameters, context, outlines),
                                self._masks(parameters, context, frames))
        shifts = []
        with self.workers(parameters, context) as executor:
            result = orthorectify(frames, camera, place, MosaicFiles(output, count), settings,
                                  progress.part(0.02, 0.98), shifts=shifts, executor=executor)
        progress.message(tr("{0} frames used; {1:.1f} % of the ground outside buildings seen, {2:.0f} m2 in holes.")
                         .format(result.used, 100 * result.share_seen, result.hidden_area))
        results = {"OUTPUT": str(output), "SHARE_SEEN": result.share_seen, "HOLE_AREA": result.hidden_area,
                   "FRAMES_USED": result.used}
        if count:
            results["OUTPUT_COUNT"] = str(count)
        return results | self.write_shifts(parameters, context, shifts, result.grid.cell, crs, progress.part(0.98, 1.0))

    def _settings(self, parameters, context):
        """How the frames are laid on the ground."""
        from ...urbanmap_qgis.aerial.frames.occlusion import PAPER_OCCLUSION
        from ...urbanmap_qgis.aerial.orthophotos.mosaic import PixelSelection
        from ...urbanmap_qgis.aerial.orthophotos.orthorectification import OrthoSettings
        from ...urbanmap_qgis.settings.aerial import OcclusionSettings

        method = self.parameterAsString(parameters, "METHOD", context)
        paper, even = method == "paper", self.parameterAsBool(parameters, "EVEN_EXPOSURE", context)
        choice = PixelSelection.of(method, even)
        if not self.parameterAsBool(parameters, "FILTER_VEHICLES", context):
            choice = PixelSelection("nadir", choice.even)
        threshold = self.parameterAsDouble(parameters, "HEIGHT_THRESHOLD", context)
        masked = paper or self.parameterAsString(parameters, "OCCLUSION", context) == "frame"
        occlusion = replace(PAPER_OCCLUSION if paper else OcclusionSettings(), threshold=threshold) if masked else None
        return OrthoSettings(self.parameterAsDouble(parameters, "RESOLUTION", context), choice, threshold, occlusion)

    def _masks(self, parameters, context, frames):
        """Paths of the occlusion maps of the frames, None where none are given."""
        masks = self.parameterAsFileList(parameters, "MASKS", context) if parameters.get("MASKS") else []
        if masks and len(masks) != len(frames):
            raise InputError(tr("{0}: {1} are given for {2} frames; give one for each frame, in the same order.")
                             .format(self.label_of("MASKS"), len(masks), len(frames)))
        return masks or None

    def _buildings(self, parameters, context, outlines):
        """Polygons of the outlines and their heights (None where no field is given)."""
        if outlines is None:
            return (), None
        name = self.parameterAsString(parameters, "HEIGHT_FIELD", context)
        if not name:
            return outlines.geometries, None
        if name not in outlines.columns:
            raise InputError(tr("{0} has no field {1}; choose another.").format(outlines.label, name))
        try:
            return outlines.geometries, [None if value is None else float(value) for value in outlines.columns[name]]
        except (TypeError, ValueError):
            raise InputError(tr("The field {0} of {1} must hold numbers: heights above the ground in metres.").format(
                name, outlines.label)) from None
