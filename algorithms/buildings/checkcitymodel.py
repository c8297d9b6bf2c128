"""urbanmap:checkcitymodel."""

from __future__ import annotations

from collections import Counter

from qgis.core import QgsProcessing

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import HTML_FILTER, tr
from ..framework.layers.layers import make_fields
from ..framework.running.workers import workers

CSV_FILTER = "CSV (*.csv)"
FIELDS = (("rule", "text"), ("requirement", "text"), ("severity", "text"), ("text", "text"), ("file", "text"),
          ("type", "text"), ("gml_id", "text"), ("lod", "int"), ("source", "text"))


class CheckCityModel(UrbanMapAlgorithm):
    ID = "checkcitymodel"
    NAME = "Check city model"
    KEYWORDS = ("PLATEAU", "CityGML", "quality", "validation", "check", "i-UR", "delivery", "品質", "検査",
                "都市モデル")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")
    SOURCE = "Project PLATEAU, standard product specification of 3D city models 5.0, chapters 4, 6 and 7"
    HELP = (
        "Checks CityGML files of PLATEAU (buildings, roads, city furniture; the common rules on all others) by the "
        "requirements of the standard product specification that a file alone can show, under its own codes (C01 to "
        "T-bldg-02), and tells what breaks them, with its place. The page “Rules of city models” of the documentation "
        "lists all, and what is not checked because it needs other data or eyes.\n"
        "Code lists are those beside the files (../../codelists); where the data set brings none, those that the "
        "specification prints. References, ids and overlaps are looked at over all files of a folder or zip. Solids "
        "that overlap are told by their plans and heights."
    )

    def declare(self):
        self.add_file("INPUT", "City model", "CityGML (.gml) or a .zip of a data set. The path of a folder can be "
                      "typed here as well.", filter="City models (*.gml *.GML *.zip);;All files (*)", optional=True)
        self.add_file("INPUT_FOLDER", "Folder of city models", "All CityGML files in this folder and its subfolders; "
                      "instead of the file or beside it.", folder=True, optional=True)
        self.add_text("EXCLUDE", "Rules left out", "Codes of rules that are not looked at, with commas between them; "
                      "the begin of a code stands for all that begin so, such as L-bldg.", "", optional=True,
                      advanced=True)
        self.add_workers()
        self.add_layer_output("OUTPUT", "Faults of the city model", "Points (longitude, latitude): rule (its code), "
                              "requirement (code of the specification), severity (error, warning), text, file, type "
                              "and gml_id of the feature, lod (-1 without), source of the rule. Faults without a place "
                              "have no geometry.", source_type=QgsProcessing.SourceType.TypeVectorPoint)
        self.add_file_output("OUTPUT_TABLE", "Table of results", "CSV, a line a file: its size and the number of "
                             "faults of each rule.", CSV_FILTER, optional=True)
        self.add_file_output("OUTPUT_COUNTS", "Table of instances", "CSV, a line a file: the number of features of "
                             "each type, to be compared with the reference data (C02).", CSV_FILTER, optional=True)
        self.add_file_output("OUTPUT_REPORT", "Quality report", "HTML report: requirements with their numbers and "
                             "verdicts, the faults, what is not checked.", HTML_FILTER, optional=True)
        self.add_number_output("OBJECTS", "City objects", "Number of city objects in the files.")
        self.add_number_output("ERRORS", "Errors", "Number of errors.")
        self.add_number_output("WARNINGS", "Warnings", "Number of warnings.")

    def check(self, parameters, context):
        paths = self._paths(parameters, context)
        if not paths:
            raise InputError(tr("No file was given: choose a city model (.gml, .zip) or a folder."))
        for path in paths:
            if path.suffix.lower() in (".json", ".jsonl"):
                raise InputError(tr("{0}: the rules are those of CityGML; write {1} as CityGML by “Export city model” "
                                    "first.").format(self.label_of("INPUT"), path.name))

    def compute(self, parameters, context, feedback):
        import numpy as np
        import shapely

        from ...urbanmap_qgis.buildings.solids.validity import check_solid
        from ...urbanmap_qgis.citymodel.checks.city_check import check_city
        from ...urbanmap_qgis.citymodel.checks.quality_forms import write_counts, write_results

        progress = self.progress(feedback)
        excluded = self.parameterAsString(parameters, "EXCLUDE", context)
        with workers(self.parameterAsInt(parameters, "WORKERS", context)) as executor:
            found = check_city(self._paths(parameters, context), check_solid,
                               [code.strip() for code in excluded.split(",") if code.strip()],
                               progress.part(0.0, 0.9), executor)
        for (severity, rule), count in sorted(Counter((one.severity, one.rule) for one in found.faults).items()):
            progress.message(f"{severity}: {rule}: {count}")
        places = [shapely.points(one.longitude, one.latitude) if np.isfinite(one.longitude) else None
                  for one in found.faults]
        layer = self.write_layer(parameters, "OUTPUT", context, make_fields(*FIELDS),
                                 {name: [getattr(one, name) for one in found.faults] for name, _ in FIELDS},
                                 "EPSG:6668" if found.geographic else found.plane, places, "Point",
                                 style="city_faults", progress=progress.part(0.9, 1.0))
        counts = Counter(one.severity for one in found.faults)
        results = {"OUTPUT": layer, "OBJECTS": found.objects, "ERRORS": counts["error"],
                   "WARNINGS": counts["warning"]}
        for name, write in (("OUTPUT_TABLE", write_results), ("OUTPUT_COUNTS", write_counts),
                            ("OUTPUT_REPORT", self._write_report)):
            path = self.output_path(parameters, name, context)
            if path is not None:
                write(path, found)
                results[name] = str(path)
        return results

    def _write_report(self, path, found):
        from ...urbanmap_qgis.citymodel.checks.quality_forms import quality_report

        quality_report(found).write(path)

    def _paths(self, parameters, context):
        """The file and the folder, as far as they were given."""
        paths = (self.input_path(parameters, name, context) for name in ("INPUT", "INPUT_FOLDER"))
        return [path for path in paths if path is not None]
