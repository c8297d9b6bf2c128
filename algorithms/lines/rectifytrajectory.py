"""urbanmap:rectifytrajectory."""

from __future__ import annotations

from types import MappingProxyType

from ...urbanmap_qgis.settings.lines import RectifySettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from .report_images import add_report_images, check_report_images, report_pictures

SET_FIELDS = ("set", "time", "pairs", "before", "after", "east", "north", "heading", "misfit", "predicted", "status")
EPOCH_FIELDS = ("time", "east", "north", "up", "heading", "sigma", "sigma_up", "sigma_heading", "status")


class RectifyTrajectory(UrbanMapAlgorithm):
    ID = "rectifytrajectory"
    NAME = "Rectify trajectory"
    SOURCE = "Zhao and Shibasaki, 3, eq. 8 to 17"
    KEYWORDS = ("tie points", "drift", "GPS", "INS", "adjustment", "registration", "mobile", "VLMS", "correction")
    REQUIRES = ("numpy", "scipy", "pyproj", "rasterio")
    RETIRED_WORDS = MappingProxyType({"METHOD": {"relative": "drift", "iterative": "drift"}})
    HELP = (
        "Corrects position and heading of a survey's trajectory by tie points: places, such as corners of buildings, "
        "that the survey and a reference both show. Two or more pairs measured within some seconds are a set.\n"
        "By default the drift is estimated from all tie points together, each at its own time, with its sigma at every "
        "epoch; contradicting pairs and sets are found and told. “paper” follows "
        "the paper to the letter: the first two pairs of each set give a true pose by its equations 13 to 17, the "
        "relative motions between two of them take their parts of the error by the iteration of its equations 8 and 9, "
        "heights are sampled equally, and nothing is left out as wrong. Before the first and after the last set the "
        "correction is carried on, and its sigma grows.\n"
        "With a ground raster the heights then follow the ground along the course, at the given height of the "
        "trajectory's origin above it. Roll and pitch stay as they are."
    )

    def declare(self):
        self.add_trajectory(help="The reported trajectory: CSV time,x,y,z,roll,pitch,heading (GPS seconds, metres, "
                            "degrees), Applanix SBET, or a point layer with these fields.")
        self.add_table("TIE_POINTS", "Tie points", "CSV or layer with set,time,x_mms,y_mms,x_ref,y_ref: name of the "
                        "set, when the survey measured the place (s), where it lies in the survey and in the reference "
                        "(m). In a line layer with set and time each line may run from survey to reference instead.")
        self.add_raster("GROUND", "Ground", "Heights of the ground, or a surface, along the course: then heights are "
                        "corrected too.", optional=True)
        self.add_settings(RectifySettings)
        self.add_crs("CRS", "Coordinate reference system", "Of trajectory and tie points, where no layer says it; "
                     "needed for SBET trajectories.", optional=True, advanced=True)
        self.add_trajectory_reading()
        add_report_images(self)
        self.add_trajectory_output("Rectified trajectory")
        self.add_layer_output("OUTPUT_SETS", "Sets", "One point a set: distance from the reference before and after, "
                              "correction, misfit within the set, how far off it would lie without itself (predicted), "
                              "and its status.", optional=True)
        self.add_layer_output("OUTPUT_EPOCHS", "Epochs", "One point an epoch: correction, sigma and status (between "
                              "sets, or carried on (extrapolated) before the first or after the last).", optional=True)
        self.add_report("Before and after, set by set, as HTML.", by_default=True)
        self.add_number_output("SETS", "Sets", "Sets of tie points within the trajectory's time.")
        self.add_number_output("SETS_USED", "Sets used", "Sets that were not left out.")
        self.add_number_output("BEFORE", "Distance before", "Mean distance of the tie points from the reference as "
                               "reported.", unit="m")
        self.add_number_output("AFTER", "Distance after", "The same after the rectification.", unit="m")
        self.add_number_output("PREDICTED", "Off without itself", "Mean over the sets of how far a set would lie off "
                               "if it were not used.", unit="m")
        self.add_number_output("MEAN_SIGMA", "Mean sigma", "Mean standard deviation of a plan coordinate between the "
                               "sets.", unit="m")
        self.add_number_output("MAX_SIGMA", "Maximum sigma", "Largest of all epochs.", unit="m")
        self.add_number_output("HELD_SHARE", "Share extrapolated", "Share of the epochs before the first or after the "
                               "last set, 0 to 1.")
        self.add_number_output("HEIGHT_BEFORE", "Height before", "Root mean square distance from the ground as "
                               "reported; no value without a ground.", unit="m")
        self.add_number_output("HEIGHT_AFTER", "Height after", "The same after the rectification.", unit="m")

    def check(self, parameters, context):
        check_report_images(self, parameters, context)

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.mobile.lines.rectification import rectify

        notes: list[str] = []
        warned = noting(progress, notes)
        table, ties = self._tie_points(parameters, context, progress)
        file, crs = self._trajectory(parameters, context, table, warned)
        settings = self.settings(RectifySettings, parameters, context)
        ground = self.raster_path(parameters, "GROUND", context)
        result = self._rectified(rectify, file.trajectory, ties, ground, settings, crs, warned)
        if result.heights is not None and result.heights.found:
            warned.warn(tr("The height of the origin above the ground was not given: the mean height stays as reported "
                           "({0:.2f} m above the ground).").format(result.heights.sensor_height))
        results = {"OUTPUT": self.write_trajectory(parameters, "OUTPUT", context, file, result.trajectory, crs)}
        results.update(self._write_layers(parameters, context, file.trajectory, result, crs, progress))
        if parameters.get("OUTPUT_REPORT"):
            from ...urbanmap_qgis.mobile.lines.rectification_report import write_report

            pictures = report_pictures(self, parameters, context, (file.trajectory, result.trajectory), crs, progress)
            results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_report, file.trajectory, result,
                                       notes, pictures)
        return {**results, **numbers_of(result)}

    def _tie_points(self, parameters, context, progress):
        """The layer's table and the core's tie points."""
        from ...urbanmap_qgis.mobile.lines.tie_points import tie_point_columns, tie_points_from_columns

        table = self.read_table(parameters, "TIE_POINTS", context, tie_point_columns, progress)
        columns = dict(table.columns)
        drawn = any(line is not None for line in table.geometries)
        if drawn and not {"x_mms", "x_ref"} & {name.lower() for name in columns}:
            columns.update(line_ends(table.geometries))
        return table, tie_points_from_columns(columns, table.label)

    def _trajectory(self, parameters, context, table, progress):
        """The trajectory's file and the WKT of what CRS is known."""
        from ..framework.layers.crs import wkt_of

        given = self.parameterAsCrs(parameters, "CRS", context)
        crs = wkt_of(given) or table.crs_wkt or None
        if table.crs.isValid():
            self.require_projected("TIE_POINTS", table.crs)
            if given.isValid():
                self.same_crs("TIE_POINTS", table.crs, "CRS", given)
        file = self.read_trajectory(parameters, "TRAJECTORY", context, crs, progress)
        if crs and file.crs_wkt:
            self.same_crs("TRAJECTORY", file.crs_wkt, "TIE_POINTS", crs)
        return file, crs or file.crs_wkt

    def _rectified(self, rectify, trajectory, ties, ground, settings, crs, progress):
        if ground is None:
            return rectify(trajectory, ties, None, settings, progress)
        from ...urbanmap_qgis.io.raster import RasterSampler

        with RasterSampler(ground) as raster:
            if crs:
                self.same_crs("GROUND", raster.crs_wkt, "TRAJECTORY", crs)
            return rectify(trajectory, ties, raster.sample, settings, progress)

    def _write_layers(self, parameters, context, before, rectified, crs, progress):
        """Places of the optional layers, by output."""
        import shapely

        results = {}
        if parameters.get("OUTPUT_SETS"):
            columns = list(zip(*((item.name, item.time, item.pairs, item.before, item.after, *item.shift, item.heading,
                                  item.misfit, item.predicted, item.status) for item in rectified.sets)))
            results |= self.write_layer(
                parameters, "OUTPUT_SETS", context, make_fields(*SET_FIELDS),
                dict(zip(SET_FIELDS, columns)), crs,
                shapely.points([item.place for item in rectified.sets]), "PointZ", "rectification_sets", progress)
        if parameters.get("OUTPUT_EPOCHS"):
            results |= self.write_layer(
                parameters, "OUTPUT_EPOCHS", context, make_fields(*EPOCH_FIELDS), epoch_columns(before, rectified), crs,
                shapely.points(rectified.trajectory.place), "PointZ", "rectification_epochs", progress)
        return results


def noting(progress, notes):
    """The progress object whose warnings are kept in `notes` too."""
    from dataclasses import replace

    def warn(sentence):
        notes.append(sentence)
        progress.warn(sentence)

    return replace(progress, warn=warn)


def line_ends(lines) -> dict:
    """Columns of tie points from lines that run from the survey to the reference."""
    from ...urbanmap_qgis.errors import InputError
    from ...urbanmap_qgis.mobile.lines.tie_points import ends_of

    if all(line is None for line in lines):
        raise InputError(tr("The tie points have neither columns x_mms,y_mms,x_ref,y_ref nor lines from survey to "
                            "reference."))
    return ends_of(lines)


def epoch_columns(before, rectified) -> dict:
    """Columns of `EPOCH_FIELDS`."""
    import numpy as np

    change = rectified.trajectory.place - before.place
    unknown = np.full(len(before), np.nan)
    status = np.where(rectified.status == 1, "between sets", "carried on")
    columns = (before.time, *change.T, rectified.trajectory.angles[:, 2] - before.angles[:, 2], rectified.plan_sigma,
               unknown if rectified.heights is None else rectified.heights.sigma, rectified.heading_sigma, status)
    return dict(zip(EPOCH_FIELDS, columns))


def numbers_of(rectified) -> dict:
    """The numbers among the results."""
    return {"SETS": len(rectified.sets), "SETS_USED": len(rectified.used), **rectified.figures()}
