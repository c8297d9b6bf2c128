"""urbanmap:localisationaccuracy."""

from __future__ import annotations

from dataclasses import replace

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from .localisation_inputs import LocalisationInputs


class LocalisationAccuracy(LocalisationInputs, UrbanMapAlgorithm):
    ID = "localisationaccuracy"
    NAME = "Map of localisation accuracy"
    SOURCE = "Javanmardi, 6.2"
    KEYWORDS = ("localization", "localisation", "accuracy", "NDT", "ICP", "map matching", "HD map", "reliability",
                "automated driving", "covariance", "DOP")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio")
    HELP = (
        "Tells from the map alone where a vehicle will know its place, before anyone drives: standard deviations along "
        "and across the road and of the heading, by laser scans matched to walls, by road markings, by satellites, and "
        "together.\n"
        "What matters most is how accurately walls and markings stand in the map: give their sigmas. A wall that is "
        "displaced displaces the vehicle however many points it gives.\n"
        "Places that look alike within the search distance are told with their distance and their share of the "
        "probability. A place of which the map tells nothing has no sigma and a status with the reason; a direction of "
        "which it tells nothing keeps the sigma from before matching."
    )

    def declare(self):
        self.add_map_inputs()
        self.add_satellites()
        self.add_sensors()
        self.add_simulation()
        self.add_layer_output("OUTPUT", "Localisation accuracy", "Points along the roads: sigma_along, sigma_across "
                              "(m), sigma_heading (degrees) together, and of each source (…_walls, …_markings, "
                              "…_satellites); major, minor (m) and weakest (bearing of the major axis) of the error "
                              "ellipse; undetermined (directions that keep what was known before) and elsewhere (share "
                              "of scans that end beside the place); alias_share, alias_distance, alias_bearing; "
                              "points, n_walls, horizon and sky (share with walls), cell_rms, two_surfaces, "
                              "satellites, pdop; class and status.", kind="point")
        self.add_raster_output("OUTPUT_RASTER", "Localisation accuracy, raster", "Sigma of the weakest direction, m, "
                               "in cells of the spacing.", optional=True)
        self.add_report("Road by class, the worst stretches with pictures, and what was simulated.", by_default=True)
        self.add_number_output("PLACES", "Places", "Number of places.")
        self.add_number_output("MEDIAN_SIGMA", "Median sigma", "Of the weakest direction, over the places that have "
                               "one.", "m")
        self.add_number_output("LENGTH_GOOD", "Length of good road", "Road of class good.", "m")
        self.add_number_output("LENGTH_USABLE", "Length of usable road", "Road of class usable.", "m")
        self.add_number_output("LENGTH_POOR", "Length of poor road", "Road of class poor.", "m")
        self.add_number_output("LENGTH_NONE", "Length of road without", "Road of which nothing can be said.", "m")
        self.add_number_output("REPEATED", "Repeated places", "Number of places that look like others.")
        self.add_number_output("RANK", "Spearman's coefficient", "Of observed and predicted errors, where scans were "
                               "simulated.")
        self.add_number_output("INSIDE", "Share within the ellipse", "Of simulated errors within the 95 % ellipse.")

    def check(self, parameters, context):
        if not parameters.get("BUILDINGS") and not parameters.get("MARKINGS"):
            raise InputError(tr("Give buildings, markings or both: there is no map without them."))
        if parameters.get("ROADS") and self.files_of(parameters, "TRAJECTORY", context):
            raise InputError(tr("Give roads or trajectories, not both."))
        if self.files_of(parameters, "NAVIGATION", context) and not parameters.get("BUILDINGS"):
            raise InputError(tr("{0}: satellites need buildings that hide them; give these too.").format(
                self.label_of("NAVIGATION")))
        if self.parameterAsBool(parameters, "SIMULATE", context) and not parameters.get("BUILDINGS"):
            raise InputError(tr("{0}: scans are simulated of buildings; give these.").format(
                self.label_of("SIMULATE")))

    def work(self, parameters, context, progress):
        import numpy as np
        import shapely

        from ...urbanmap_qgis.localisation.accuracy_map import accuracy_map
        from ...urbanmap_qgis.localisation.report.accuracy_tables import accuracy_columns, lengths_by_class
        from ...urbanmap_qgis.localisation.report.localisation_report import write_localisation_report

        settings = self.settings_from(parameters, context)
        city, places, crs = self.read_map(parameters, context, progress.part(0.0, 0.2))
        result = accuracy_map(city, places, settings, progress.part(0.2, 0.4))
        check = self._simulated(parameters, context, city, result, settings, crs, progress.part(0.4, 0.9))
        columns = accuracy_columns(result)
        place = np.where(np.isfinite(result.places.place), result.places.place, 0.0)
        results = self.write_layer(parameters, "OUTPUT", context, None, columns, crs,
                                              shapely.points(place), "PointZ", "localisation_accuracy",
                                              progress.part(0.9, 1.0))
        self._raster(parameters, context, result, crs, results)
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_localisation_report, city, result, check)
        if check is not None:
            results |= {"RANK": check.rank, "INSIDE": check.inside}
        known = np.isfinite(result.ellipse.major)
        length = lengths_by_class(result)
        if not known.any():
            progress.warn(tr("Nothing can be said of any place: see the field status."))
        return results | {
            "PLACES": len(places),
            "MEDIAN_SIGMA": float(np.median(result.ellipse.major[known])) if known.any() else None,
            **{f"LENGTH_{name.upper()}": value for name, value in length.items()},
            "REPEATED": int((result.alias_share >= settings.alias_share).sum())}

    def _simulated(self, parameters, context, city, accuracy, settings, crs, progress):
        """The core's check of the prediction; None where it is not asked for."""
        if not self.parameterAsBool(parameters, "SIMULATE", context):
            return None
        from ...urbanmap_qgis.localisation.simulation.prediction_check import check_prediction

        truth = self.read_truth(parameters, context, crs, progress)
        if city.walls is None:
            progress.warn(tr("Nothing was simulated: no building has a height."))
            return None
        return check_prediction(city.walls, accuracy, settings,
                                self.parameterAsInt(parameters, "SIMULATE_EVERY", context),
                                self.parameterAsInt(parameters, "DRAWS", context),
                                self.parameterAsInt(parameters, "SEED", context), truth, progress)

    def read_map(self, parameters, context, progress):
        """The core's map, the places, and the CRS of both."""
        from ...urbanmap_qgis.localisation.accuracy_records import LocalisationMap

        buildings = self.read_walls(parameters, context, progress.part(0.0, 0.5))
        markings = self.read_markings(parameters, context, progress.part(0.5, 0.8))
        table = buildings[0] if buildings else markings[0]
        if buildings and markings:
            self.same_crs("BUILDINGS", table.crs, "MARKINGS", markings[0].crs)
            self.same_heights("BUILDINGS", table.crs, "MARKINGS", markings[0].crs)
        if buildings and len(buildings[2]):
            progress.warn(tr("{0}: {1} of {2} features have no heights and are left out; give the field with the "
                             "height of their tops.").format(table.label, len(buildings[2]), len(table)))
        read = self.read_trajectories(parameters, context, table.crs_wkt, progress, "BUILDINGS")
        drives = [item.trajectory for item in read]
        sky, shift = self.read_sky(parameters, context, table, drives, progress)
        places = self._places(parameters, context, table, drives, shift)
        city = LocalisationMap(buildings[1] if buildings else None, markings[1] if markings else None, sky,
                               buildings[2] if buildings else None)
        return city, self._on_ground(parameters, context, table, places), table.crs

    def _places(self, parameters, context, table, drives, shift):
        import numpy as np

        from ...urbanmap_qgis.gnss.rays.visibility import area_grid
        from ...urbanmap_qgis.localisation.places.road_places import (
            joined_places,
            places_on_drive,
            places_on_grid,
            places_on_roads,
            tunnels,
        )

        spacing = self.parameterAsDouble(parameters, "SPACING", context)
        if drives:
            return joined_places([places_on_drive(drive.place, drive.time + shift, spacing, number)
                                  for number, drive in enumerate(drives)])
        roads = self.read_vector(parameters, "ROADS", context)
        if roads is not None:
            self.same_crs("ROADS", roads.crs, "BUILDINGS", table.crs)
            return places_on_roads(roads.geometries, spacing, tunnels(roads.columns, len(roads)))
        box = self.parameterAsExtent(parameters, "EXTENT", context, table.crs)
        if box.isNull() or box.isEmpty():
            import shapely

            bounds = tuple(shapely.total_bounds([shape for shape in table.geometries if shape is not None]))
        else:
            bounds = (box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum())
        grid = area_grid(bounds, spacing)
        return places_on_grid(grid, np.full(grid.shape, np.nan))

    def _on_ground(self, parameters, context, table, places):
        """The places with the heights of the ground raster, where one is given."""
        from ...urbanmap_qgis.localisation.report.accuracy_tables import ground_under_places

        with self.sampled_raster(parameters, "GROUND", context, "BUILDINGS", table.crs) as ground:
            return places if ground is None else replace(places, ground=ground_under_places(ground, places))

    def _raster(self, parameters, context, accuracy, crs, results):
        from ...urbanmap_qgis.io.raster import write_raster
        from ...urbanmap_qgis.localisation.report.accuracy_tables import accuracy_raster

        path = self.output_layer_path(parameters, "OUTPUT_RASTER", context, style="localisation_raster")
        if path:
            values, grid = accuracy_raster(accuracy, self.parameterAsDouble(parameters, "SPACING", context))
            write_raster(path, values, grid, crs.toWkt())
            results["OUTPUT_RASTER"] = str(path)
