"""urbanmap:filtervehicles."""

from __future__ import annotations

from qgis.core import QgsProcessing, QgsProcessingParameterMultipleLayers

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import crs_from, metres_per_unit
from .frame_shifts import FrameShiftsOutput

METHODS = ("vote", "darkest", "paper")


class FilterVehicles(FrameShiftsOutput, UrbanMapAlgorithm):
    ID = "filtervehicles"
    SUCCESSOR = "orthorectifyframes"
    NAME = "Filter vehicles"
    SOURCE = "Javanmardi, 3.2.1.2"
    KEYWORDS = ("vehicles", "cars", "traffic", "orthophoto", "darkest", "aerial")
    REQUIRES = ("numpy", "scipy", "rasterio", "cv2")
    HELP = (
        "Makes one orthophoto without moving vehicles from several of the same ground: where a vehicle stands in one, "
        "another shows the road. Vehicles that stand still in all of them stay.\n"
        "The others are resampled onto the first, also from another coordinate system, and their exposures are evened "
        "out. Pixels without data in one are taken from the others."
    )

    def declare(self):
        self.declare_parameter(QgsProcessingParameterMultipleLayers(
            "ORTHOPHOTOS", tr("Orthophotos"), QgsProcessing.SourceType.TypeRaster), "Two or more rasters of the same "
            "ground, grey or red, green, blue, of 8 or 16 bit. The result lies on the first.")
        self.add_choice("METHOD", "Vehicle filter", "Majority vote: what most of them agree on, which also keeps dark "
                        "vehicles from winning over paint. Darkest: the one with the lowest sum of channels. Paper: "
                        "darkest without gain compensation.", METHODS, "vote", advanced=True)
        self.add_boolean("EVEN_EXPOSURE", "Gain compensation", "Bring all to one brightness and contrast before they "
                         "are compared.", True, advanced=True)
        self.add_workers()
        self.add_raster_output("OUTPUT", "Orthophoto", "Without moving vehicles; 0 where there is no data.")
        self.add_number_output("SHARE_SEEN", "Share with data", "Share of the pixels that hold an image, 0 to 1.")
        self.add_shifts_output()

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.aerial.orthophotos.mosaic import PixelSelection
        from ...urbanmap_qgis.aerial.orthophotos.vehicle_filter import filter_vehicles

        layers = self.parameterAsLayerList(parameters, "ORTHOPHOTOS", context)
        if not layers:
            raise InputError(tr("{0}: no raster can be opened; check the files.").format(self.label_of("ORTHOPHOTOS")))
        choice = PixelSelection.of(self.parameterAsString(parameters, "METHOD", context),
                                   self.parameterAsBool(parameters, "EVEN_EXPOSURE", context))
        output = self.output_layer_path(parameters, "OUTPUT", context)
        shifts, crs = [], crs_from(layers[0].crs())
        metres = 1.0 if crs.isGeographic() else metres_per_unit(crs)
        with self.workers(parameters, context) as executor:
            result = filter_vehicles([layer.source().split("|")[0] for layer in layers], output, choice,
                                     progress.part(0.0, 0.98), shifts, metres, executor)
        results = {"OUTPUT": str(output), "SHARE_SEEN": result.pixels_seen / (result.grid.rows * result.grid.columns)}
        return results | self.write_shifts(parameters, context, shifts, result.grid.cell * metres, crs,
                                           progress.part(0.98, 1.0))
