"""urbanmap:roadmarkingsfromorthophoto."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.aerial import MarkingThreshold, PaintRules
from ...urbanmap_qgis.wording import mark
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import crs_from, horizontal, metres_per_unit
from .frame_shifts import read_pairs
from .marking_layer import write_doubtful, write_markings

METHODS = ("profile", "paper", "trained")


class RoadMarkingsFromOrthophoto(UrbanMapAlgorithm):
    ID = "roadmarkingsfromorthophoto"
    NAME = "Road markings from orthophoto"
    SOURCE = "Javanmardi, 3.2.2 and 4.1"
    KEYWORDS = ("road", "marking", "lane", "zebra", "crossing", "paint", "adaptive threshold", "aerial", "orthophoto")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "cv2")
    RETIRED = dict.fromkeys(("LABELS", "WEIGHTS", "OUTPUT_WEIGHTS"), mark(
        "{0} is no longer used: nothing is learned from answers. Raise or lower MIN_CONFIDENCE, and delete from the "
        "markings what is no paint."))
    HELP = (
        "Finds painted road markings, white, yellow and blue, in an orthophoto: a mask on the orthophoto's pixels and "
        "polygons whose outlines are finer than the pixels.\n"
        "After a level adjustment, pixels are kept that are brighter by the contrast than the Gaussian mean of the "
        "block round them (in shade in proportion less), and stand out on both sides. A model trained on made-up "
        "streets then tells how likely each piece is paint, by its shape and contrast, the ground round it and its "
        "company: that is its confidence.\n"
        "Any orthophoto of 0.5 m or finer will do, in grey or in red, green and blue, 8 or 16 bit, of any size. Give "
        "roads where you have them: bright lines on roofs, plots and paving are then left out. Give building "
        "outlines, or the mask of what buildings hide, where they lean in the image."
    )

    def declare(self):
        self.add_raster("INPUT", "Orthophoto", "Aerial image on the ground, in a projected CRS (metres or feet).")
        self.add_polygons("BUILDINGS", "Buildings", "No markings are looked for inside these polygons.", optional=True)
        self.add_raster("MASK", "Hidden areas", "Raster that is above 0 where the ground is not seen, such as an "
                        "occlusion mask. Its cells may differ from the orthophoto's.", optional=True)
        self.add_polygons("ROADS", "Roads", "Markings are looked for only inside these polygons; without them, "
                          "everywhere.", optional=True)
        self.add_raster("GROUND", "Ground", "Ground heights in metres, in the orthophoto's CRS: gives the polygons "
                        "their heights.", optional=True)
        self.add_choice("METHOD", "Method", "Profile: paint must stand out from the road on both sides, and what is no "
                        "paint is left out. Paper: the plain adaptive Gaussian threshold of the grey image after a "
                        "level adjustment, as in the paper; only block size and contrast matter then. Trained: the "
                        "same as profile.", METHODS, "profile", advanced=True)
        self.add_settings(MarkingThreshold)
        self.add_boolean("CLEAN", "Clean", "Leave out what is no paint by its width, contrast on both sides, shape and "
                         "surroundings; without it all stays that is brighter by the contrast than the block.", True)
        self.add_settings(PaintRules)
        self.add_vector("SHIFTS", "Shifts between images", "Points of “Orthorectify frames” that tell how far the "
                        "frames of this orthophoto disagree; shown in the report.", optional=True)
        self.add_raster("FRAME_COUNT", "Frames that see the ground", "Raster of “Orthorectify frames”; shown in the "
                        "report.", optional=True)
        self.add_text("NOTE", "Note for the report", "Text that the report shows with its settings.", advanced=True)
        self.add_text("LEVELS", "Levels", "Brightness (three numbers) and road (four) of the whole image that this one "
                      "is a part of; a run over tiles gives them. Left out: of this image.", advanced=True)
        self.add_workers()
        self.add_raster_output("OUTPUT", "Marking mask", "255 where there is a marking, otherwise 0; pixels as the "
                               "orthophoto's.")
        self.add_layer_output("OUTPUT_POLYGONS", "Road markings", "Outlines of the markings, with area (m2), length "
                              "and width of the stroke (m), mean contrast (grey values), colour and "
                              "confidence (0 to 1).", optional=True, by_default=True)
        self.add_layer_output("OUTPUT_DOUBTFUL", "Doubtful markings", "What was left out with a confidence of "
                              "0.2 or more, the most area in doubt first, with the empty field paint for your answers "
                              "when you look through it.", optional=True)
        self.add_report("HTML report: numbers and areas, shifts between frames, coverage, pictures of the markings "
                        "over the orthophoto, and what to distrust.")
        self.add_number_output("COUNT", "Markings", "Number of polygons.")
        self.add_number_output("MARKED_AREA", "Marked area", "Area of the mask's markings.", "m2")
        self.add_number_output("SEARCHED_AREA", "Searched area", "Area in which markings could be found.", "m2")

    def check(self, parameters, context):
        layer = self.parameterAsRasterLayer(parameters, "INPUT", context)
        label = self.label_of("INPUT")
        self.raster_path(parameters, "INPUT", context)
        crs = crs_from(layer.crs())
        if not crs.isValid():
            raise InputError(tr("{0}: the coordinate reference system is missing; assign the one that the image is "
                                "in (Layer > Set CRS).").format(label))
        if horizontal(crs).isGeographic():
            raise InputError(tr("{0}: its pixels are measured in degrees; warp it to a projected CRS, such as the "
                                "local plane rectangular or UTM zone.").format(label))
        for name in ("BUILDINGS", "ROADS"):
            source = self.parameterAsSource(parameters, name, context) if parameters.get(name) else None
            if source is not None:
                self.same_crs("INPUT", crs, name, source.sourceCrs())
        for name in ("MASK", "GROUND"):
            if parameters.get(name) and self.raster_path(parameters, name, context):
                self.same_crs("INPUT", crs, name, self.parameterAsRasterLayer(parameters, name, context).crs())

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto

        crs = self.parameterAsRasterLayer(parameters, "INPUT", context).crs()
        settings = self._settings(parameters, context)
        places = self._places(parameters, context, progress.part(0.0, 0.02))
        mask = self.output_layer_path(parameters, "OUTPUT", context, style="marking_mask")
        with self.workers(parameters, context) as executor:
            def search(settings, mask):
                return markings_from_orthophoto(self.raster_path(parameters, "INPUT", context), mask, places, settings,
                                                metres_per_unit(crs), progress=progress.part(0.02, 0.9),
                                                executor=executor)

            found, doubtful = search(settings, mask), write_doubtful(self, parameters, context, search, settings, crs)
        self._tell(found, progress)
        results = {"OUTPUT": str(mask), "COUNT": len(found.polygons), "MARKED_AREA": found.marked_area,
                   "SEARCHED_AREA": found.searched_area}
        if report := self._report(parameters, context, found, settings.contrast):
            results["OUTPUT_REPORT"] = report
        return {**results, **write_markings(self, parameters, context, found.polygons, crs, progress), **doubtful}

    def shared_settings(self, parameters, context, progress):
        """What all parts of the orthophoto must share when they are worked on apart."""
        from ...urbanmap_qgis.aerial.markings.marking_files import levels_of_orthophoto

        crs = self.parameterAsRasterLayer(parameters, "INPUT", context).crs()
        levels = levels_of_orthophoto(self.raster_path(parameters, "INPUT", context),
                                      self._places(parameters, context, progress),
                                      self._settings(parameters, context), metres_per_unit(crs), progress)
        return {"LEVELS": levels.text} if levels else {}

    def _places(self, parameters, context, progress):
        """Where markings are looked for."""
        from ...urbanmap_qgis.aerial.markings.orthophoto_reader import SearchArea

        return SearchArea(self._polygons(parameters, "ROADS", context, progress),
                          self._polygons(parameters, "BUILDINGS", context, progress),
                          self.raster_path(parameters, "MASK", context))

    def _settings(self, parameters, context):
        """How markings are told from the road."""
        from ...urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
        from ...urbanmap_qgis.aerial.markings.road_markings import LevelAdjustment, MarkingSettings

        method = self.parameterAsString(parameters, "METHOD", context)
        clean = self.parameterAsBool(parameters, "CLEAN", context) and method != "paper"
        rules = self.settings(CleanSettings, parameters, context) if clean else None
        return self.settings(MarkingSettings, parameters, context, paper=method == "paper", cleaning=rules,
                             levels=LevelAdjustment.of_text(
                                 self.parameterAsString(parameters, "LEVELS", context)))

    def _report(self, parameters, context, found, contrast):
        """Write the report where it is wanted; its path."""
        path = self.output_path(parameters, "OUTPUT_REPORT", context)
        if path is None:
            return None
        from ...urbanmap_qgis.aerial.markings import marking_report

        count = self.raster_path(parameters, "FRAME_COUNT", context)
        evidence = marking_report.OrthophotoQuality(
            read_pairs(self, parameters, context), count and marking_report.frame_count_shares(count),
            bool(parameters.get("ROADS")), contrast)
        marking_report.write_marking_report(path, self.raster_path(parameters, "INPUT", context), found, evidence,
                                            self.parameterAsString(parameters, "NOTE", context))
        return str(path)

    def _polygons(self, parameters, name, context, progress):
        """Polygons of a layer in any projected CRS, repaired where invalid; None where none was given."""
        import shapely

        table = self.read_vector(parameters, name, context, progress)
        if table is None:
            return None
        present = table.geometries[~shapely.is_missing(table.geometries)]
        if not len(present):
            raise InputError(tr("{0}: there are no polygons; check the layer and its filter, or leave it out.").format(
                self.label_of(name)))
        return list(shapely.make_valid(shapely.force_2d(present)))

    def _tell(self, found, progress):
        from ...urbanmap_qgis.aerial.markings.marking_verdict import marking_verdict

        if not found.searched_area:
            progress.warn(tr("Nothing of the orthophoto is left to look at: check that roads, buildings and hidden "
                             "areas lie where the image does; the mask is empty."))
        elif not len(found.polygons):
            progress.warn(tr("No markings were found: the mask is empty; check the roads, or lower the contrast."))
        for reason in marking_verdict(found).reasons if len(found.polygons) else ():
            progress.warn(reason)
        if found.pixel > 0.25:
            progress.warn(tr("With pixels of {0:.2f} m only wide markings can be seen; 0.15 m or finer shows lane "
                             "lines.").format(found.pixel))
