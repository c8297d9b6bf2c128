"""urbanmap:filtervehicles."""

from __future__ import annotations

from qgis.core import QgsProcessing, QgsProcessingParameterMultipleLayers

from ..urbanmap_qgis.errors import InputError
from .base import UrbanMapAlgorithm
from .parameters import tr

METHODS = ("vote", "darkest")


class FilterVehicles(UrbanMapAlgorithm):
    ID = "filtervehicles"
    NAME = "Filter vehicles"
    GROUP = "aerial"
    SOURCE = "Javanmardi 2018, 3.2.1.2"
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
        self.add_choice("METHOD", "Vehicle filter", "Vote: what most of them agree on, which also keeps dark vehicles "
                        "from winning over paint. Darkest: the one with the lowest sum of channels, as the "
                        "dissertation.", METHODS, "vote", advanced=True)
        self.add_boolean("EVEN_EXPOSURE", "Even exposure", "Bring all to one brightness and contrast before they are "
                         "compared.", True, advanced=True)
        self.add_raster_output("OUTPUT", "Orthophoto", "Without moving vehicles; 0 where there is no data.")
        self.add_number_output("SHARE_SEEN", "Share with data", "Share of the pixels that hold an image, 0 to 1.")

    def compute(self, parameters, context, feedback):
        from ..urbanmap_qgis.aerial.mosaic import Choice
        from ..urbanmap_qgis.aerial.vehicle_filter import filter_vehicles

        layers = self.parameterAsLayerList(parameters, "ORTHOPHOTOS", context)
        if not layers:
            raise InputError(tr("{0}: no raster can be opened; check the files.").format(self.label_of("ORTHOPHOTOS")))
        choice = Choice(self.parameterAsString(parameters, "METHOD", context),
                        self.parameterAsBool(parameters, "EVEN_EXPOSURE", context))
        output = self.output_layer_path(parameters, "OUTPUT", context)
        made = filter_vehicles([layer.source().split("|")[0] for layer in layers], output, choice,
                               self.progress(feedback))
        return {"OUTPUT": str(output), "SHARE_SEEN": made.pixels_seen / (made.grid.rows * made.grid.columns)}
