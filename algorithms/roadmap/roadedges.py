"""urbanmap:roadedges."""

from __future__ import annotations

from collections import Counter

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.roadmap import EdgeSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..mobile.survey_inputs import read_survey
from .feature_package import PackageLayer, geometry_type_of, write_package

FIELDS = ("edge_id", "kind", "height", "sigma", "sigma_z", "length", "points", "passes", "completeness", "chain", "gap",
          "status", "reason")
GEOPACKAGE_FILTER = "GeoPackage (*.gpkg)"


class RoadEdges(UrbanMapAlgorithm):
    ID = "roadedges"
    NAME = "Road edges"
    SOURCE = "Javanmardi, 6.2"
    KEYWORDS = ("road", "kerb", "curb", "edge", "border", "guard rail", "wall", "MMS", "breakline", "lane map")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "rasterio")
    HELP = (
        "Finds kerbs, lowered kerbs, road borders without kerb, guard rails and walls along the drive of a corrected "
        "mobile survey, as lines with heights, standard deviations and the share of their length that was measured.\n"
        "Kerbs are steps between two smooth sides. Each half metre a profile across the edge gives its foot, top and "
        "face; passes through the same place are fitted apart and combined by their sigma. Where neither side is seen, "
        "as behind parked cars, a line ends: “gap” tells how far the next part of its chain is away, nothing is drawn "
        "in between.\n"
        "A kerb whose face is not seen, and rails that may be the sides of vehicles, are doubtful, with the reason. "
        "Points and trajectory must be corrected ones: lines are as wrong as the survey is.\n"
        "Objects of “Objects from images” and walls of “Walls from a mobile survey” can be put into one GeoPackage "
        "with the edges."
    )

    def declare(self):
        self.add_points(help="The survey, placed by the trajectory: LAS, LAZ or COPC files with GPS times, in one "
                        "projected coordinate system.")
        self.add_trajectory()
        self.add_trajectory_reading()
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres, from which those of the "
                        "points are counted. Without it the ground is found among the points; where the raster has no "
                        "value no edge is found.", optional=True)
        self.add_settings(EdgeSettings)
        self.add_vector("OBJECTS", "Objects", "Objects of “Objects from images” for the GeoPackage.", optional=True,
                        kind="geometry")
        self.add_vector("WALLS", "Walls", "Walls of “Walls from a mobile survey” for the GeoPackage.", optional=True,
                        kind="polygon")
        self.add_points_crs()
        self.add_layer_output("OUTPUT", "Road edges", "LineStringZ along the foot: edge_id, kind (kerb, lowered kerb, "
                              "road border, guard rail, wall), height, sigma (across), sigma_z, length (m), points, "
                              "passes, completeness (share of the line that was measured), chain (parts of one edge), "
                              "gap (m to the next part), status (measured, doubtful), reason.", kind="line")
        self.add_layer_output("OUTPUT_TOPS", "Upper edges", "The same along the top: edge_id, kind, height, sigma, "
                              "sigma_z, status.", optional=True, by_default=True, kind="line")
        self.add_file_output("OUTPUT_PACKAGE", "All features", "One GeoPackage with the layers edges, upper_edges and, "
                             "where given, objects and walls.", GEOPACKAGE_FILTER, optional=True)
        self.add_number_output("EDGES", "Edges", "Number of lines.")
        self.add_number_output("KERB_LENGTH", "Length of kerbs", "Kerbs and lowered kerbs.", "m")
        self.add_number_output("BORDER_LENGTH", "Length of road borders", "Without a kerb.", "m")
        self.add_number_output("RAIL_LENGTH", "Length of guard rails", "Measured and doubtful ones.", "m")
        self.add_number_output("WALL_LENGTH", "Length of walls", "Walls at the road.", "m")
        self.add_number_output("MEDIAN_SIGMA", "Median sigma", "Median standard deviation of measured kerbs across; "
                               "no value without kerbs.", "m")

    def check(self, parameters, context):
        wanted = parameters.get("OUTPUT_PACKAGE") not in (None, "")
        given = [name for name in ("OBJECTS", "WALLS") if parameters.get(name) not in (None, "")]
        if given and not wanted:
            raise InputError(tr("{0} is given but {1} is not: name the GeoPackage that it is to go into.").format(
                self.label_of(given[0]), self.label_of("OUTPUT_PACKAGE")))

    def work(self, parameters, context, progress):
        import numpy as np

        from ...urbanmap_qgis.roadmap.edges.edge_records import KERB, MEASURED

        paths, crs, read = read_survey(self, parameters, context, progress)
        carried = self._carried(parameters, context, crs)
        settings = self.settings(EdgeSettings, parameters, context)
        found = self._find(parameters, context, paths, crs, read.trajectory, settings, progress.part(0.0, 0.9))
        self._tell(found, settings, progress)
        results = self._write(parameters, context, found, crs, carried, progress.part(0.9, 1.0))
        sigmas = [edge.sigma for edge in found.edges if edge.kind == KERB and edge.status == MEASURED]
        return {**results, "EDGES": len(found.edges), "KERB_LENGTH": found.length("kerb", "lowered kerb"),
                "BORDER_LENGTH": found.length("road border"), "RAIL_LENGTH": found.length("guard rail"),
                "WALL_LENGTH": found.length("wall"), "MEDIAN_SIGMA": float(np.median(sigmas)) if sigmas else None}

    def _find(self, parameters, context, paths, crs, trajectory, settings, progress):
        from ...urbanmap_qgis.roadmap.edges.road_edges import road_edges

        with self.sampled_raster(parameters, "GROUND", context, "POINTS", crs) as ground:
            return road_edges(paths, trajectory, settings, ground and ground.sample, progress)

    def _carried(self, parameters, context, crs):
        """Layers of OBJECTS and WALLS for the GeoPackage, in the CRS of the points."""
        layers = []
        for name, title in (("OBJECTS", "objects"), ("WALLS", "walls")):
            table = self.read_vector(parameters, name, context)
            if table is None:
                continue
            self.same_crs("POINTS", crs, name, table.crs)
            layers.append(PackageLayer(title, table.fields, table.columns, table.geometries,
                                       geometry_type_of(table.geometries)))
        return layers

    def _write(self, parameters, context, found, crs, carried, progress):
        import shapely

        edges = found.edges
        columns = {"edge_id": list(range(len(edges))),
                   **{name: [getattr(edge, name) for edge in edges] for name in FIELDS[1:]}}
        columns["reason"] = [tr(edge.reason) if edge.reason else None for edge in edges]
        fields, top_fields = make_fields(*FIELDS), make_fields(*FIELDS[:5], FIELDS[-2])
        feet = [shapely.linestrings(edge.foot) for edge in edges]
        tops = [shapely.linestrings(edge.top) for edge in edges]
        top_columns = {item.name(): columns[item.name()] for item in top_fields}
        results = {
            **self.write_layer(parameters, "OUTPUT", context, fields, columns, crs, feet, "LineStringZ",
                                       style="road_edges", progress=progress),
            **self.write_layer(parameters, "OUTPUT_TOPS", context, top_fields, top_columns, crs, tops,
                                            "LineStringZ", style="road_edges")}
        package = self.output_path(parameters, "OUTPUT_PACKAGE", context)
        if package is not None:
            measured = [PackageLayer("edges", fields, columns, feet, "LineStringZ"),
                   PackageLayer("upper_edges", top_fields, top_columns, tops, "LineStringZ")]
            write_package(package, measured + carried, crs)
            results["OUTPUT_PACKAGE"] = str(package)
        return results

    def _tell(self, found, settings, progress):
        import numpy as np

        for (kind, status), count in sorted(Counter((edge.kind, edge.status) for edge in found.edges).items()):
            progress.message(tr("{0}, {1}: {2}").format(tr(kind), tr(status), count))
        if not found.length("kerb", "lowered kerb"):
            progress.warn(tr("No kerb was found along {0:.0f} m of path: the road has none, or the points are too "
                             "sparse or too noisy to show steps of a few centimetres.").format(found.path_length))
        left, right = found.bare_sides
        if max(left, right) >= 1.0:
            progress.message(tr("No kerb was found beside {0:.0f} m of the path on the left and {1:.0f} m on the "
                                "right.").format(left, right))
            if np.isfinite(found.least_step):
                progress.message(tr("Steps lower than {0:.1f} cm do not show surely in this survey, by the number and "
                                    "the scatter of its points on the ground and the lowest kerb asked for, {1:.1f} "
                                    "cm: there may be lower kerbs.").format(
                    100 * found.least_step, 100 * settings.min_height))
