"""urbanmap:checkmodel."""

from __future__ import annotations

from collections import Counter

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields

CSV_FILTER = "CSV (*.csv)"
MODELS_FILTER = "City models and lane maps (*.gml *.GML *.zip *.osm);;All files (*)"
SEVERITIES = ("error", "warning", "info")
CITY_FIELDS = (("rule", "text"), ("requirement", "text"), ("severity", "text"), ("text", "text"), ("file", "text"),
               ("type", "text"), ("gml_id", "text"), ("lod", "int"), ("source", "text"))
MAP_FIELDS = tuple((name, "text") for name in ("rule", "severity", "text", "element", "source"))


class CheckModel(UrbanMapAlgorithm):
    ID = "checkmodel"
    NAME = "Check city model or lane map"
    KEYWORDS = ("PLATEAU", "CityGML", "quality", "validation", "check", "i-UR", "delivery", "lane", "HD map",
                "vector map", "Lanelet2", "Autoware", "品質", "検査", "都市モデル")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")
    SOURCE = "Project PLATEAU, standard product specification of 3D city models 5.0, chapters 4, 6 and 7"
    HELP = (
        "Checks a city model or a lane map, whichever the file is, and tells what breaks the rules, with its place.\n"
        "CityGML files of PLATEAU (buildings, roads, city furniture; the common rules on all others) are checked by "
        "the requirements of the standard product specification that a file alone can show, under its own codes (C01 "
        "to T-bldg-02). The page “Rules of city models” of the documentation lists all, and what is not checked "
        "because it needs other data or eyes. Code lists are those beside the files (../../codelists); where the data "
        "set brings none, those that the specification prints. References, ids and overlaps are looked at over all "
        "files of a folder or zip. Solids that overlap are told by their plans and heights.\n"
        "Lanelet2 files (OSM) are checked by the rules of Lanelet2's and Autoware's validators that need no other "
        "file, with their codes and severities, and by some of our own; the page “Rules of lane maps” lists all. "
        "Errors hinder a reader or change the map's sense; warnings are missing tags, values that are not known, "
        "points that fall together, odd widths, lanelets without a next and a previous one; infos are ends of the map "
        "and elements that need Autoware's extension."
    )

    def declare(self):
        self.add_file("INPUT", "City model or lane map", "CityGML (.gml), a .zip of a data set, or a Lanelet2 file "
                      "(.osm). The path of a folder can be typed here as well.", filter=MODELS_FILTER, optional=True)
        self.add_file("INPUT_FOLDER", "Folder of city models", "All CityGML files in this folder and its subfolders; "
                      "instead of the file or beside it.", folder=True, optional=True)
        self.add_text("EXCLUDE", "Rules left out", "Codes of rules that are not looked at, with commas between them; "
                      "the begin of a code stands for all that begin so, such as L-bldg or Lane.BorderSharing.", "",
                      optional=True, advanced=True)
        self.add_workers()
        self.add_layer_output("OUTPUT", "Faults", "Points (longitude, latitude): rule (its code), severity (error, "
                              "warning, info), text, source of the rule; of a city model also requirement (code of the "
                              "specification), file, type and gml_id of the feature, lod (-1 without); of a map also "
                              "element. Faults without a place have no geometry.", kind="point")
        self.add_file_output("OUTPUT_TABLE", "Table of results", "CSV, a line a file: its size and the number of "
                             "faults of each rule; of city models only.", CSV_FILTER, optional=True)
        self.add_file_output("OUTPUT_COUNTS", "Table of instances", "CSV, a line a file: the number of features of "
                             "each type, to be compared with the reference data (C02); of city models only.",
                             CSV_FILTER, optional=True)
        self.add_report("HTML report: numbers by rule or requirement, verdicts, the faults, what is not checked.")
        self.add_number_output("OBJECTS", "City objects", "Number of city objects in the files.")
        self.add_number_output("LANELETS", "Lanelets", "Number of lanelets in the file.")
        self.add_number_output("ERRORS", "Errors", "Number of errors.")
        self.add_number_output("WARNINGS", "Warnings", "Number of warnings.")

    def check(self, parameters, context):
        paths = self.input_paths(parameters, context)
        if not paths:
            raise InputError(tr("No file was given: choose a city model (.gml, .zip), a folder of them, or a lane map "
                                "(.osm)."))
        for path in paths:
            if path.suffix.lower() in (".json", ".jsonl") or _kind(path) == "json":
                raise InputError(tr("{0}: the rules are those of CityGML; write {1} as CityGML by “Export city model” "
                                    "first.").format(self.label_of("INPUT"), path.name))
        tables = [name for name in ("OUTPUT_TABLE", "OUTPUT_COUNTS") if parameters.get(name)]
        if _is_map(paths) and (len(paths) > 1 or tables):
            raise InputError(tr("{0}: a lane map is checked by itself, and has no tables of files and features: leave "
                                "the folder and these outputs out.").format(self.label_of("INPUT")))

    def work(self, parameters, context, progress):
        paths = self.input_paths(parameters, context)
        excluded = self.parameterAsString(parameters, "EXCLUDE", context)
        codes = [code.strip() for code in excluded.split(",") if code.strip()]
        work = self._check_map if _is_map(paths) else self._check_city
        return work(parameters, context, paths, codes, progress)

    def _check_city(self, parameters, context, paths, codes, progress):
        from ...urbanmap_qgis.buildings.solids.validity import check_solid
        from ...urbanmap_qgis.citymodel.checks.city_check import check_city
        from ...urbanmap_qgis.citymodel.checks.quality_forms import quality_report, write_counts, write_results

        with self.workers(parameters, context) as executor:
            found = check_city(paths, check_solid, codes, progress.part(0.0, 0.9), executor)
        results = self._faults(parameters, context, found.faults, CITY_FIELDS,
                               "EPSG:6668" if found.geographic else found.plane, "city_faults", progress)
        results["OBJECTS"] = found.objects
        for name, write in (("OUTPUT_TABLE", write_results), ("OUTPUT_COUNTS", write_counts),
                            ("OUTPUT_REPORT", lambda path, city: quality_report(city).write(path))):
            results |= self.write_file(parameters, name, context, write, found)
        return results

    def _check_map(self, parameters, context, paths, codes, progress):
        from ...urbanmap_qgis.io.osm import read_osm
        from ...urbanmap_qgis.roadmap.checks.map_check import check_map

        content = read_osm(paths[0])
        lanelets = sum(relation.tags.get("type") == "lanelet" for relation in content.relations.values())
        if not lanelets:
            raise InputError(tr("{0}: the file holds no lanelets (relations of type lanelet); give a Lanelet2 map.")
                             .format(self.label_of("INPUT")))
        progress.step(0.2)
        faults = check_map(content, codes)
        results = self._faults(parameters, context, faults, MAP_FIELDS, "EPSG:4326", "map_faults", progress)
        results["LANELETS"] = lanelets
        return results | self.write_file(parameters, "OUTPUT_REPORT", context, self._write_map_report, faults, lanelets)

    def _faults(self, parameters, context, faults, fields, crs, style, progress) -> dict:
        """Tell the faults in the log, write their layer and count them."""
        import numpy as np
        import shapely

        for (severity, rule), count in sorted(Counter((fault.severity, fault.rule) for fault in faults).items()):
            progress.message(f"{tr(severity)}: {rule}: {count}")
        places = [shapely.points(fault.longitude, fault.latitude) if np.isfinite(fault.longitude) else None
                  for fault in faults]
        layer = self.write_layer(parameters, "OUTPUT", context, make_fields(*fields),
                                 {name: [getattr(fault, name) for fault in faults] for name, _ in fields}, crs, places,
                                 "Point", style=style, progress=progress.part(0.9, 1.0))
        counts = Counter(fault.severity for fault in faults)
        return {**layer, "ERRORS": counts["error"], "WARNINGS": counts["warning"]}

    def _write_map_report(self, path, faults, lanelets):
        from ...urbanmap_qgis.io.pages.report import BAD, GOOD, LOOK, Report

        report = Report(tr("Check of a lane map"))
        number = Counter(fault.severity for fault in faults)
        errors, warnings = number["error"], number["warning"]
        text = tr("{0} lanelets, {1} errors, {2} warnings.").format(lanelets, errors, warnings)
        if errors:
            text += " " + tr("Put the errors right first: with them programs refuse the map or lead the wrong way.")
        elif warnings:
            text += " " + tr("The map can be loaded; look at the warnings before routes rely on it.")
        report.verdict(BAD if errors else LOOK if warnings else GOOD, text)
        report.section(tr("Faults by rule"))
        counts = Counter((fault.severity, fault.rule) for fault in faults)
        report.table((tr("Severity"), tr("Rule"), tr("Number")),
                     [(severity, rule, count) for (severity, rule), count in sorted(
                         counts.items(), key=lambda item: (SEVERITIES.index(item[0][0]), -item[1]))])
        for severity in ("error", "warning"):
            rows = [(fault.rule, fault.element, fault.text) for fault in faults if fault.severity == severity]
            if not rows:
                continue
            report.section(tr("Errors") if severity == "error" else tr("Warnings"))
            report.table((tr("Rule"), tr("Element"), tr("What")), rows[:500])
            if len(rows) > 500:
                report.paragraph(tr("The first 500 of {0} are shown; the layer holds all.").format(len(rows)))
        report.write(path)


def _kind(path) -> str:
    """What a file holds: see the core's `content_kind`."""
    from ...urbanmap_qgis.io.files.packed import content_kind

    return content_kind(path)


def _is_map(paths) -> bool:
    return any(path.suffix.lower() == ".osm" or _kind(path) in ("osm", "OpenDRIVE") for path in paths)
