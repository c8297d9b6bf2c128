"""urbanmap:checkvectormap."""

from __future__ import annotations

from collections import Counter

from qgis.core import QgsProcessing

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import HTML_FILTER, tr
from ..framework.layers.layers import make_fields

SEVERITIES = ("error", "warning", "info")


class CheckVectorMap(UrbanMapAlgorithm):
    ID = "checkvectormap"
    NAME = "Check lane map"
    KEYWORDS = ("lane", "HD map", "vector map", "Lanelet2", "Autoware", "validation", "check")
    REQUIRES = ("numpy", "shapely", "pyproj")
    HELP = (
        "Checks any Lanelet2 file (OSM) by the rules of Lanelet2's and Autoware's validators that need no other file, "
        "with their codes and severities, and by some of our own, and tells what breaks them, with its place. The page "
        "“Rules of lane maps” of the documentation lists all.\n"
        "Errors hinder a reader or change the map's sense: repeated ids, references to what is not in the file, "
        "coordinates that are none, lanelets without one left and one right bound, bounds that cross, regulatory "
        "elements that the library cannot make, stop lines, crosswalks and areas that no rule refers to. Warnings: "
        "missing tags, values that are not known, points that fall together, odd widths, lanelets without a next and a "
        "previous one. Infos: ends of the map, elements that need Autoware's extension."
    )

    def declare(self):
        self.add_file("INPUT", "Lanelet2 file", "OSM file, such as that of “Lane map”.", "Lanelet2 (*.osm)")
        self.add_text("EXCLUDE", "Rules left out", "Codes of rules that are not looked at, with commas between them; "
                      "the begin of a code stands for all that begin so, such as Lane.BorderSharing.", "",
                      optional=True, advanced=True)
        self.add_layer_output("OUTPUT", "Faults of the map", "Points (longitude, latitude): rule (its code), severity "
                              "(error, warning, info), text, element, source of the rule. Faults without a place have "
                              "no geometry.",
                              source_type=QgsProcessing.SourceType.TypeVectorPoint)
        self.add_file_output("OUTPUT_REPORT", "Report", "HTML report: numbers by rule, and the faults.", HTML_FILTER,
                             optional=True)
        self.add_number_output("LANELETS", "Lanelets", "Number of lanelets in the file.")
        self.add_number_output("ERRORS", "Errors", "Number of errors.")
        self.add_number_output("WARNINGS", "Warnings", "Number of warnings.")

    def compute(self, parameters, context, feedback):
        import numpy as np
        import shapely

        from ...urbanmap_qgis.io.osm import read_osm
        from ...urbanmap_qgis.roadmap.checks.map_check import check_map

        progress = self.progress(feedback)
        content = read_osm(self.input_path(parameters, "INPUT", context))
        lanelets = sum(relation.tags.get("type") == "lanelet" for relation in content.relations.values())
        if not lanelets:
            raise InputError(tr("{0}: the file holds no lanelets (relations of type lanelet); give a Lanelet2 map.")
                             .format(self.label_of("INPUT")))
        progress.step(0.2)
        excluded = self.parameterAsString(parameters, "EXCLUDE", context)
        faults = check_map(content, [code.strip() for code in excluded.split(",") if code.strip()])
        counts = Counter(fault.severity for fault in faults)
        for (severity, rule), count in sorted(Counter((fault.severity, fault.rule) for fault in faults).items()):
            progress.message(f"{tr(severity)}: {rule}: {count}")
        names = ("rule", "severity", "text", "element", "source")
        places = [shapely.points(fault.longitude, fault.latitude) if np.isfinite(fault.longitude) else None
                  for fault in faults]
        layer = self.write_layer(parameters, "OUTPUT", context, make_fields(*((name, "text") for name in names)),
                                 {name: [getattr(fault, name) for fault in faults] for name in names}, "EPSG:4326",
                                 places, "Point", style="map_faults", progress=progress.part(0.7, 1.0))
        results = {"OUTPUT": layer, "LANELETS": lanelets, "ERRORS": counts["error"], "WARNINGS": counts["warning"]}
        report = self.output_path(parameters, "OUTPUT_REPORT", context)
        if report is None:
            return results
        self._write_report(report, parameters, faults, lanelets)
        return {**results, "OUTPUT_REPORT": str(report)}

    def _write_report(self, path, parameters, faults, lanelets):
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
