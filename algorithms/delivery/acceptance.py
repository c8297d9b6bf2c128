"""urbanmap:acceptance."""

from __future__ import annotations

from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from .control_residuals import ControlResiduals
from .edge_runs import EdgeRuns

LEVELS = ("250", "500", "1000", "2500", "5000", "given")
PRODUCTS = ("survey", "buildings")
EDGES_SHOWN_BY = ("roof edges", "walls")
JOB = {"job": "Job", "area": "Area of the work", "client": "Client", "surveyor": "Surveyor",
       "dates": "Dates of the work", "chief": "Chief engineer", "leader": "Survey party leader",
       "quantity": "Quantity of work", "instrument": "Instrument", "method": "Method", "heights": "Height system",
       "checked_by": "Checked by", "remarks": "Remarks"}
NUMBERS = {"POINTS": ("Check points", ""), "RMSE_PLAN": ("Standard deviation in plan about 0", "m"),
           "RMSE_HEIGHT": ("Standard deviation in height about 0", "m"), "MEAN_PLAN": ("Mean error in plan", "m"),
           "MAX_PLAN": ("Maximum error in plan", "m"), "MAX_HEIGHT": ("Maximum error in height", "m")}


class Acceptance(ControlResiduals, EdgeRuns, UrbanMapAlgorithm):
    ID = "acceptance"
    NAME = "Acceptance report"
    KEYWORDS = ("accuracy", "acceptance", "quality control", "check points", "map level", "report", "PDF")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs")
    HELP = (
        "Judges a survey or building models by check points, in the form of the tables of quality control of Japan's "
        "public surveys: figures in plan and in height apart, the limits of the map level, passed or failed for each "
        "criterion, a map of the errors, all points.\n"
        "A mobile survey is judged by control points: with its trajectory, and a corrected one where there is one, the "
        "residuals are worked out here.\n"
        "Check points must have been measured independently; those that the product was adjusted to are left out "
        "where a column “role” names them. Where there are too few points nothing is accepted.\n"
        "The standard deviation is that about a mean of 0. With few points it says little: the report gives the value "
        "that it is below with a confidence of 95 %.\n"
        "Building models without check points yet: their edges are drawn at random, 21 of each quarter regional mesh, "
        "into a table in which the survey fills in what it measured. That table is then given as check points.\n"
        "Building models with laser points instead: 84 edges of each mesh are looked for in the points, and the models "
        "judged by those that the points show. If the models were made from the same points, that checks the modelling "
        "and not the accuracy, and nothing is judged."
    )

    def flags(self):
        """In the window's thread, as QGIS's printing needs."""
        return super().flags() | self.Flag.FlagNoThreading

    def declare(self):
        self.add_table("INPUT", "Check points", "Table or layer with x, y, z (true, metres) and x_product, y_product, "
                        "z_product; id, and role (check or adjusted), where there are such columns; or the residuals "
                        "of an earlier run; or the table of edges with x, y, z filled in; or control points, with a "
                        "trajectory. Without check points nothing is judged.", optional=True)
        self.add_survey()
        self.add_vector("BUILDINGS", "Building models", "MultiPolygonZ with all faces of each building: edges to be "
                        "surveyed are drawn from them.", optional=True, kind="polygon")
        self.add_points("POINTS", "Laser points of the edges", "LAS, LAZ or COPC files in the CRS of the models, in "
                        "which edges of the building models are looked for; not together with check points.",
                        optional=True)
        self.add_choice("EDGES_SHOWN_BY", "Edges shown by", "roof edges: where the roof's points end, of airborne "
                        "points, with heights; walls: faces of walls, of points from the street, without heights.",
                        EDGES_SHOWN_BY, "roof edges")
        self.add_boolean("INDEPENDENT", "Points of another, more accurate survey", "The laser points are of another "
                         "survey than the models and more accurate: only then are the models judged.", default=False)
        self.add_choice("PRODUCT", "Product", "Building models are judged as PLATEAU's tables P05 to P08 ask: 42 check "
                        "points (21 edges with two each) in each unit.", PRODUCTS, "survey")
        self.add_choice("MAP_LEVEL", "Map level", "Whose limits hold: the standard deviation may be 0.12, 0.25, 0.70, "
                        "1.75, 3.50 m in plan and 0.25, 0.25, 0.33, 0.66, 1.66 m in height; given: the limits below.",
                        LEVELS, "500")
        self.add_number("LIMIT_PLAN", "Limit in plan", "Greatest standard deviation in plan; it takes the place of the "
                        "map level's.", minimum=0.0001, unit="m", optional=True)
        self.add_number("LIMIT_HEIGHT", "Limit in height", "Greatest standard deviation in height; it takes the place "
                        "of the map level's.", minimum=0.0001, unit="m", optional=True)
        self.add_number("MINIMUM_POINTS", "Minimum number of points", "With fewer check points in a unit nothing is "
                        "judged. If none is given: 42 for buildings, 1 for a survey.", minimum=1, integer=True,
                        optional=True)
        self.add_field("UNIT", "Unit of inspection", "Field that names the unit of each point, such as a mesh or a "
                       "drive: each unit is judged by itself. If none is chosen, all points are one.", "INPUT",
                       optional=True)
        self.add_vector("PATCHES", "Patches of the registration", "From “Register mobile survey”: mean, standard "
                        "deviation and maximum of its figures are told.", optional=True)
        for name, label in JOB.items():
            self.add_text(name.upper(), label, "For the head of the report; what is left out stays blank, to be filled "
                          "in by hand.")
        self.add_report("HTML report, which prints on A4.", by_default=True)
        self.add_file_output("OUTPUT_PDF", "Report as PDF", "The same as PDF pages of A4, made by QGIS's printing.",
                             "PDF (*.pdf)", optional=True)
        self.add_file_output("OUTPUT_EDGES", "Edges to be surveyed", "Both ends of the drawn edges with their place in "
                             "the models; x, y and z are left blank for the survey.", "CSV (*.csv)", optional=True)
        self.add_file_output("OUTPUT_CSV", "All points", "Every check point, or every drawn edge, with its errors.",
                             "CSV (*.csv)", optional=True)
        self.add_file("TEMPLATE", "Layout of the PDF", "Layout template of QGIS (.qpt): a changed copy of the plugin's "
                      "resources/layouts/acceptance.qpt, whose items are filled by their ids.",
                      filter="Layout templates (*.qpt)", optional=True, advanced=True)
        self.add_survey_outputs()
        for name, (label, unit) in NUMBERS.items():
            self.add_number_output(name, label, label, unit=unit)
        self.add_text_output("OUTCOME", "Outcome", "passed, failed, or not checked.")

    def check(self, parameters, context):
        from ...urbanmap_qgis.errors import InputError

        if not parameters.get("INPUT") and not parameters.get("BUILDINGS"):
            raise InputError(tr("Give check points, or building models whose edges are to be surveyed."))
        self.check_survey(parameters)
        self.check_edge_inputs(parameters)
        given = [self._number(parameters, name, context) for name in ("LIMIT_PLAN", "LIMIT_HEIGHT")]
        if self.parameterAsString(parameters, "MAP_LEVEL", context) == "given" and given == [None, None]:
            raise InputError(tr("Map level: “given” needs a limit in plan or in height; give one of them."))

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.acceptance.acceptance_report import (
            pdf_content,
            write_acceptance_report,
            write_points_csv,
        )
        from ...urbanmap_qgis.acceptance.criteria import criteria, outcome
        from ...urbanmap_qgis.acceptance.error_figures import point_figures

        models = self.read_vector(parameters, "BUILDINGS", context, progress)
        if parameters.get("POINTS"):
            return self.compare_with_points(parameters, context, models, progress)
        drawn = self.drawn_edges(models)
        if not parameters.get("INPUT"):
            return self.only_drawn(parameters, context, drawn, models)
        results, table = self.check_table(parameters, context, progress.part(0.0, 0.2))
        if results and not any(parameters.get(name) for name in ("OUTPUT_REPORT", "OUTPUT_PDF", "OUTPUT_CSV")):
            return results
        points = self._points(parameters, context, table)
        limits, level = self._limits(parameters, context)
        found = criteria(points, limits, *self._needed(parameters, context))
        job = self._job(parameters, context, table)
        patches = self._patches(parameters, context)
        results |= {"OUTCOME": outcome(found), **self.write_edges(parameters, context, drawn)}
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_acceptance_report, points, found,
                                   limits, job, level, patches)
        results |= self.write_file(parameters, "OUTPUT_CSV", context, write_points_csv, points)
        results.update(self.write_pdf(parameters, context, pdf_content(points, found, limits, level, patches), job))
        figures = point_figures(points.errors)
        numbers = {"POINTS": len(points), "RMSE_PLAN": figures.plan.rmse, "RMSE_HEIGHT": figures.height.rmse,
                   "MEAN_PLAN": figures.plan.mean, "MAX_PLAN": figures.plan.maximum,
                   "MAX_HEIGHT": figures.height.maximum}
        return {**results, **{name: value for name, value in numbers.items() if value == value}}

    def write_pdf(self, parameters, context, content, job) -> dict[str, str]:
        """The PDF, where it is wanted."""
        path = self.output_path(parameters, "OUTPUT_PDF", context)
        if path is None:
            return {}
        from .acceptance_pages import write_acceptance_pdf

        write_acceptance_pdf(path, content, job, self.input_path(parameters, "TEMPLATE", context))
        return {"OUTPUT_PDF": str(path)}

    def _points(self, parameters, context, table):
        from ...urbanmap_qgis.acceptance.check_points import check_points_from_columns, point_places

        return check_points_from_columns(table.columns, point_places(table.geometries),
                                         self.parameterAsString(parameters, "UNIT", context), table.label)

    def _limits(self, parameters, context):
        """Limits, and the map level they are of; None where they were given."""
        from ...urbanmap_qgis.acceptance.map_levels import MAP_LEVELS, Limits

        word = self.parameterAsString(parameters, "MAP_LEVEL", context)
        plan, height = (self._number(parameters, name, context) for name in ("LIMIT_PLAN", "LIMIT_HEIGHT"))
        if word == "given":
            return Limits(plan, height), None
        level = MAP_LEVELS[int(word)]
        if plan is None and height is None:
            return level, int(word)
        return Limits(level.plan if plan is None else plan, level.height if height is None else height), None

    def _needed(self, parameters, context) -> tuple[int, int]:
        """Fewest points and edges of a unit."""
        from ...urbanmap_qgis.acceptance.edge_sampling import EDGES_OF_UNIT, POINTS_OF_EDGE

        buildings = self.parameterAsString(parameters, "PRODUCT", context) == "buildings"
        given = self._number(parameters, "MINIMUM_POINTS", context)
        if given is not None:
            return int(given), int(given) // POINTS_OF_EDGE if buildings else 0
        return (EDGES_OF_UNIT * POINTS_OF_EDGE, EDGES_OF_UNIT) if buildings else (1, 0)

    def _number(self, parameters, name: str, context) -> float | None:
        return None if parameters.get(name) in (None, "") else self.parameterAsDouble(parameters, name, context)

    def _job(self, parameters, context, table):
        from ...urbanmap_qgis.acceptance.job import Job
        from ...urbanmap_qgis.io.reference.system_names import local_name

        texts = {name: self.parameterAsString(parameters, name.upper(), context) for name in JOB}
        known = table is not None and table.crs.isValid()
        reference = f"{table.crs.authid()} {local_name(table.crs.description())}".strip() if known else ""
        return Job(**texts, reference=reference)

    def _patches(self, parameters, context) -> dict:
        """Figures of registered patches by their words."""
        import numpy as np

        from ...urbanmap_qgis.errors import InputError

        table = self.read_vector(parameters, "PATCHES", context)
        if table is None:
            return {}
        figures = {"correction": tr("Correction in plan (m)"), "sigma": tr("Standard deviation in plan (m)"),
                   "residual": tr("Residual of the windows (m)")}
        missing = [name for name in figures if name not in table.columns]
        if missing:
            raise InputError(tr("{0} has no field {1}: give the patches of “Register mobile survey”.").format(
                table.label, ", ".join(missing)))
        return {words: np.array([np.nan if value is None else float(value) for value in table.columns[name]])
                for name, words in figures.items()}
