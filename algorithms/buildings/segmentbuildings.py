"""urbanmap:segmentbuildings."""

from __future__ import annotations

from ...urbanmap_qgis.settings.buildings import SegmentationParameters
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import (
    BUILDING_ID,
    NOTE,
    building_names,
    dated_columns,
    footprints_of,
    open_points,
)
from ..framework.layers.reprojection import ground_heights, with_heights_of_points


class SegmentBuildings(UrbanMapAlgorithm):
    ID = "segmentbuildings"
    NAME = "Segment buildings"
    SOURCE = "Javanmardi, 5.3.1"
    KEYWORDS = ("building", "footprint", "outline", "ALS", "lidar", "segmentation")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "rasterio")
    HELP = (
        "Takes the laser points of each building out of a point cloud, with the help of rough outlines.\n"
        "Each outline is first moved to where the points show its building, then expanded, and takes the points "
        "inside. Where expanded outlines overlap, a point goes to the building whose own surface is nearest to it. "
        "Points of class 6 are used where the cloud is classified; elsewhere what stands high above the ground.\n"
        "The outlines in the result carry what was found: points, density, ground height, displacement and its "
        "standard deviation. A building without points keeps its row and says so, and so does one that is dated "
        "after the flight or ended before it, where the points have full GPS times and the outlines their dates."
    )

    def declare(self):
        self.add_points()
        self.add_polygons("FOOTPRINTS", "Building outlines", "Rough outlines, one feature a building, in the same "
                          "coordinate system as the points. A field building_id, of any type, names the buildings and "
                          "comes back in every result; ids that a point cloud cannot hold get a number beside them "
                          "(bldg_no). Without it, buildings are numbered from 1 in the layer's order.")
        self.add_settings(SegmentationParameters, "expansion", "method")
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres. Without it the ground is "
                        "made from the points.", optional=True)
        self.add_settings(SegmentationParameters)
        self.add_workers()
        self.add_points_output("OUTPUT", "Building points", "The points of the buildings with the attribute "
                               "building_id, building after building; all other attributes are kept.")
        self.add_layer_output("OUTPUT_BUILDINGS", "Buildings", "The outlines at their found places, with "
                              "building_id, points, density (points a m2), ground (m), shift_x, shift_y, "
                              "shift_sigma (m), shift_status, status, open_share (share of the outline cut out "
                              "as open ground), cloud_density (points a m2 of the cloud round it) and beyond "
                              "(share of the outline beyond the cloud's edge).")
        self.add_number_output("BUILDINGS", "Buildings", "Number of outlines.")
        self.add_number_output("WITHOUT_POINTS", "Buildings without points", "Outlines with too few points for a "
                               "model.")
        self.add_number_output("POINT_COUNT", "Points", "Points given to buildings.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.buildings.outlines.outline_dates import BEGINS, ENDS, dated_outlines
        from ...urbanmap_qgis.buildings.segmentation import segment_buildings

        table = self.read_polygons(parameters, "FOOTPRINTS", context, progress)
        footprints = footprints_of(table, progress)
        cloud = open_points(self, parameters, context, table, progress)
        table = with_heights_of_points(table, cloud, progress)
        settings = self.settings(SegmentationParameters, parameters, context)
        ground = ground_heights(self, parameters, context, table, progress)
        points = self.output_path(parameters, "OUTPUT", context)
        with self.workers(parameters, context) as executor:
            buildings = segment_buildings(cloud, footprints, points, settings, ground, executor,
                                          progress.part(0.0, 0.95))
        dates = dated_outlines(cloud, dated_columns(table, BEGINS + ENDS), len(footprints))
        layer = self._write(parameters, context, table, footprints, buildings, dates, progress.part(0.95, 1.0))
        if dates.younger.any() or dates.gone.any():
            progress.message(tr("Flown {0} to {1}: {2} of {3} outlines are dated after it ({4} of them have no "
                                "points), {5} had ended before it.").format(
                *dates.flown, int(dates.younger.sum()), len(footprints),
                int((dates.younger & (buildings.points == 0)).sum()), int(dates.gone.sum())))
        without = int((buildings.status != "ok").sum())
        if without:
            progress.warn(tr("{0} of {1} buildings have too few points for a model.").format(
                without, len(footprints)))
        return {
            "OUTPUT": str(points), **layer,
            "BUILDINGS": len(footprints), "WITHOUT_POINTS": without, "POINT_COUNT": int(buildings.points.sum()),
        }

    def _write(self, parameters, context, table, footprints, buildings, dates, progress):
        fields = make_fields((BUILDING_ID, "int"), "points", "density", "ground", "shift_x", "shift_y", "shift_sigma",
                             "shift_status", "status", "open_share", "cloud_density", "beyond", (NOTE, "text"),
                             base=table.fields)
        names = building_names(table)
        takers = [names.own.get(footprints.ids[row], footprints.ids[row]) if row >= 0 else None
                  for row in buildings.takers()]
        columns = {**table.columns, BUILDING_ID: footprints.ids, "points": buildings.points,
                   "density": buildings.density, "ground": buildings.ground, "shift_x": buildings.shift_x,
                   "shift_y": buildings.shift_y, "shift_sigma": buildings.shift_sigma,
                   "shift_status": buildings.shift_status, "status": buildings.status,
                   "open_share": buildings.open_share, "cloud_density": buildings.cloud_density,
                   "beyond": buildings.beyond,
                   NOTE: [_note(*row) for row in zip(footprints.notes, footprints.usable, buildings.points,
                                                     buildings.status, takers, dates.notes(buildings.points))]}
        return self.write_layer(parameters, "OUTPUT_BUILDINGS", context, fields, columns, table.crs,
                                buildings.outlines, "MultiPolygon", "segmented_buildings", progress, names)


def _note(note: str, usable: bool, points: int, status: str, taker, dated: str) -> str:
    """What is to be said of an outline: its flaws, that nothing or trees stand in it or which building has its points,
    and what its dates say of the flight."""
    nothing = "there are no points of a building in its outline" if usable and not points else ""
    if status == "trees":
        nothing = "trees stand in its outline and no building"
    elif nothing and taker is not None:
        nothing = f"its points went to building {taker}, whose outline covers it"
    return "; ".join(filter(None, (note, nothing, dated)))
