"""Runs of “Acceptance report” on edges of building models: drawn for a survey, or looked for in laser points."""

from __future__ import annotations

from ..framework.declaring.parameters import tr


class EdgeRuns:
    """What “Acceptance report” does with building models."""

    def check_edge_inputs(self, parameters) -> None:
        """Refuse laser points without models, or beside check points, and results that the run would not have.

        Raises
        ------
        InputError : with what to leave out.
        """
        from ...urbanmap_qgis.errors import InputError

        if parameters.get("POINTS") and not parameters.get("BUILDINGS"):
            raise InputError(tr("Laser points are compared with edges of building models: give these too."))
        if parameters.get("POINTS") and parameters.get("INPUT"):
            raise InputError(tr("Give check points or laser points, not both: each is a report of its own."))
        if parameters.get("OUTPUT_EDGES") and not parameters.get("BUILDINGS"):
            raise InputError(tr("Edges to be surveyed are drawn from building models: give these too, or leave the "
                                "table of edges out."))
        if parameters.get("OUTPUT_CSV") and not parameters.get("INPUT") and not parameters.get("POINTS"):
            raise InputError(tr("Without check points there are no errors to list: leave “All points” out; the drawn "
                                "edges are written as “Edges to be surveyed”."))
        if parameters.get("PATCHES") and not parameters.get("INPUT"):
            raise InputError(tr("Patches of a registration stand in a report on check points: give these too, or "
                                "leave the patches out."))

    def drawn_edges(self, models, count: int | None = None):
        """Edges of the building models, `count` of each unit if not as many as a survey needs; None where no models
        are given."""
        if models is None:
            return None
        from ...urbanmap_qgis.acceptance.edge_sampling import EDGES_OF_UNIT, draw_edges, quarter_meshes

        self.require_projected("BUILDINGS", models.crs)
        names = models.columns.get("building_id", models.ids)
        return draw_edges(models.geometries, names, quarter_meshes(models.geometries, models.crs_wkt),
                          count=count or EDGES_OF_UNIT)

    def write_edges(self, parameters, context, drawn) -> dict[str, str]:
        """The table for the survey, where it is wanted."""
        from ...urbanmap_qgis.acceptance.edge_sampling import write_edges_csv

        path = self.output_path(parameters, "OUTPUT_EDGES", context) if drawn is not None else None
        if path is None:
            return {}
        write_edges_csv(path, drawn)
        return {"OUTPUT_EDGES": str(path)}

    def only_drawn(self, parameters, context, drawn, models) -> dict:
        """Results where there are no check points yet: nothing is judged."""
        from ...urbanmap_qgis.acceptance.acceptance_report import sampling_pdf_content, write_sampling_report
        from ...urbanmap_qgis.acceptance.criteria import NOT_CHECKED

        job = self._job(parameters, context, models)
        results = {"OUTCOME": NOT_CHECKED, **self.write_edges(parameters, context, drawn),
                   **self.write_pdf(parameters, context, sampling_pdf_content(drawn), job)}
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_sampling_report, drawn, job)
        return results

    def compare_with_points(self, parameters, context, models, progress) -> dict:
        """Results of the models' edges in laser points."""
        from ...urbanmap_qgis.acceptance.criteria import outcome
        from ...urbanmap_qgis.acceptance.edge_comparison import EDGES_DRAWN, compare_edges, edge_criteria
        from ...urbanmap_qgis.acceptance.edges_report import compared_numbers
        from ...urbanmap_qgis.io.points.pointcloud import open_cloud

        drawn = self.drawn_edges(models, EDGES_DRAWN)
        cloud = open_cloud(self.point_files(parameters, "POINTS", context))
        self.same_crs("POINTS", cloud.crs_wkt, "BUILDINGS", models.crs)
        limits, level = self._limits(parameters, context)
        edges = compare_edges(drawn, models.geometries, cloud, limits,
                              self.parameterAsString(parameters, "EDGES_SHOWN_BY", context), progress.part(0.1, 0.9))
        independent = self.parameterAsBool(parameters, "INDEPENDENT", context)
        found = edge_criteria(edges, limits, independent)
        results = {"OUTCOME": outcome(found), **self.write_edges(parameters, context, drawn),
                   **self._write_compared(parameters, context, edges, found, limits, level, independent, models)}
        return {**results, **{name: value for name, value in compared_numbers(edges).items() if value == value}}

    def _write_compared(self, parameters, context, edges, found, limits, level, independent, models) -> dict[str, str]:
        """Report and table of compared edges, where they are wanted."""
        from ...urbanmap_qgis.acceptance.edges_report import edges_pdf_content, write_compared_csv, write_edges_report

        job = self._job(parameters, context, models)
        results = self.write_pdf(parameters, context, edges_pdf_content(edges, found, limits, level, independent), job)
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_edges_report, edges, found, limits, job,
                                   level, independent)
        results |= self.write_file(parameters, "OUTPUT_CSV", context, write_compared_csv, edges)
        return results
