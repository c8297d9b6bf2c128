"""urbanmap:adjustsurveys."""

from __future__ import annotations

from pathlib import Path

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.mobile import ControlSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.trajectories import TABLE_SUFFIXES, write_trajectory_file
from .control_points import add_control, read_control
from .marking_reference import add_markings, read_reference
from .wall_inputs import add_buildings, asked_features, read_edges, read_laser, refuse_two_kinds


class AdjustSurveys(UrbanMapAlgorithm):
    ID = "adjustsurveys"
    NAME = "Adjust several drives"
    SOURCE = "network adjustment on the registration of Javanmardi, 3.2.4 and 4"
    KEYWORDS = ("MMS", "mobile", "adjustment", "network", "tie", "control", "trajectory", "strip")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    HELP = (
        "Corrects several drives of a mobile survey at once. Road markings that two drives saw, or one drive twice, "
        "tie them to each other, and so do facades and road as planes; control points and reference markings place "
        "them. All go into one least-squares adjustment, in which each trajectory drifts as GNSS and inertial units "
        "do.\n"
        "With outlines or models of buildings the facades that the drives saw are laid on their walls; how far they "
        "stand inside is found. Without control points, reference markings and buildings the drives agree with each "
        "other, but their place is only relative: the result says so.\n"
        "The corrected trajectories keep the names, formats and epochs of those given; apply them with “Apply "
        "corrected trajectory”."
    )

    def declare(self):
        self.add_points(help="The drives: LAS, LAZ or COPC files with intensities and GPS times, or their markings as "
                        "“Road markings of a mobile survey” writes them. Each file belongs to the trajectory along "
                        "which it was measured.")
        self.add_trajectories()
        self.add_calibration(optional=True)
        add_control(self, optional=True)
        add_markings(self, optional=True)
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres, for the reference markings.",
                        optional=True)
        add_buildings(self)
        self.add_settings(ControlSettings, "control_sigma", "control_sigma_z")
        self.add_distance("SEARCH", "Maximum error", "How far drives may lie apart in plan.", 4.0, 0.5, 20.0,
                          advanced=True)
        self.add_settings(ControlSettings)
        self.add_folder_output("OUTPUT", "Corrected trajectories", "Folder in which each trajectory is written under "
                               "its own name.")
        self.add_points_crs()
        self.add_layer_output("OUTPUT_TIES", "Ties", "One point an observation: its residual (m), its standard "
                              "deviation and the weight that it kept.", optional=True, by_default=True, kind="point")
        self.add_layer_output("OUTPUT_NODES", "Corrections", "Points along the corrected paths, with correction, "
                              "standard deviations and status.", optional=True, by_default=True, kind="point")
        self.add_report("Residuals by kind, the share of each witness, corrections and their uncertainty, what to "
                        "distrust.", by_default=True)
        self.add_number_output("TIES", "Ties", "Number of ties between drives.")
        self.add_number_output("PLANE_TIES", "Ties by planes", "Number of ties by facades and road.")
        self.add_number_output("WALLS", "Walls", "Number of observations on walls of buildings.")
        self.add_number_output("TIE_RMS", "RMS of ties in plan", "Of their residuals.", "m")
        self.add_number_output("MEDIAN_SIGMA", "Median standard deviation", "In plan, over all drives.", "m")
        self.add_number_output("RELATIVE", "Relative only", "1 where nothing fixes the place of the drives, otherwise "
                               "0.")

    def check(self, parameters, context):
        sources, targets = self.trajectory_files(parameters, context), self._targets(parameters, context)
        for target in targets:
            if targets.count(target) > 1 or (target.exists() and any(path.exists() and target.samefile(path)
                                                                     for path in sources)):
                raise InputError(tr("{0}: {1} would be written over another trajectory; choose another folder.").format(
                    self.label_of("OUTPUT"), target.name))

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.mobile.adjustment.drive_clouds import assign_clouds
        from ...urbanmap_qgis.mobile.adjustment.report import write_network_report
        from ...urbanmap_qgis.mobile.adjustment.stage import adjust_surveys

        paths = self.point_files(parameters, "POINTS", context)
        crs = self.projected_cloud(parameters, context).crs_wkt
        files = self.read_trajectories(parameters, context, crs, progress)
        targets = self._targets(parameters, context)
        names = [path.stem for path in targets]
        clouds = assign_clouds(paths, [item.trajectory for item in files], names)
        result = adjust_surveys(clouds, [item.trajectory for item in files], names,
                                self._control(parameters, context, crs, progress),
                                self._reference(parameters, context, crs, progress), self._run(parameters, context),
                                self.read_calibration(parameters, context), progress.part(0.0, 0.95),
                                self._walls(parameters, context, crs, progress))
        results = self._write_layers(parameters, context, result, crs, progress)
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_network_report, result)
        targets[0].parent.mkdir(parents=True, exist_ok=True)
        for drive, like, target in zip(result.drives, files, targets):
            write_trajectory_file(target, like, drive.corrected, crs, context)
        return {**results, **self._figures(result), "OUTPUT": str(targets[0].parent)}

    def _targets(self, parameters, context) -> list[Path]:
        """Where each trajectory is written: under its own name, what comes as a layer as a GeoPackage."""
        folder = Path(self.parameterAsFileOutput(parameters, "OUTPUT", context))
        return [folder / (path.name if path.suffix.lower() in TABLE_SUFFIXES else f"{path.stem}.gpkg")
                for path in self.trajectory_files(parameters, context)]

    def _control(self, parameters, context, crs, progress):
        if parameters.get("CONTROL") is None:
            return None
        control, control_crs = read_control(self, parameters, context, progress)
        if control_crs:
            self.same_crs("POINTS", crs, "CONTROL", control_crs)
        return control

    def _reference(self, parameters, context, crs, progress):
        if parameters.get("MARKINGS") is None:
            return None
        ground = self.raster_path(parameters, "GROUND", context)
        reference, reference_crs = read_reference(self, parameters, context, ground, progress)
        self.same_crs("POINTS", crs, "MARKINGS", reference_crs)
        return reference

    def _walls(self, parameters, context, crs, progress):
        """The core's `BuildingWalls`; None where paint alone is asked for, or there are neither buildings nor ALS."""
        from ...urbanmap_qgis.mobile.adjustment.wall_observations import BuildingWalls

        features = asked_features(self, parameters, context)
        if features == "paint":
            return None
        refuse_two_kinds(self, parameters)
        edges = read_edges(self, parameters, context, crs, progress)
        laser = read_laser(self, parameters, context, crs)
        return None if edges is None and laser is None else BuildingWalls(edges, features == "walls", laser)

    def _run(self, parameters, context):
        """The core's settings."""
        from ...urbanmap_qgis.mobile.adjustment.records import AdjustmentRun
        from ...urbanmap_qgis.mobile.registration.records import RegistrationSettings
        from ...urbanmap_qgis.mobile.registration.run import RegistrationRun

        windows = RegistrationSettings(search=self.parameterAsDouble(parameters, "SEARCH", context))
        return self.settings(AdjustmentRun, parameters, context, registration=RegistrationRun(windows=windows))

    def _figures(self, adjusted) -> dict:
        rows = {row[0]: row for row in adjusted.residual_rows()}
        tied = rows.get("tie")
        figures = {"TIES": tied[1] if tied else 0, "PLANE_TIES": rows["plane"][1] if "plane" in rows else 0,
                   "WALLS": rows["wall"][1] if "wall" in rows else 0,
                   "MEDIAN_SIGMA": adjusted.median_sigma(), "RELATIVE": int(adjusted.relative)}
        return {**figures, "TIE_RMS": tied[3]} if tied else figures

    def _write_layers(self, parameters, context, adjusted, crs, progress) -> dict:
        import shapely

        from ...urbanmap_qgis.mobile.adjustment.tables import node_columns, tie_columns

        results = {}
        for name, (columns, places), style in (("OUTPUT_TIES", tie_columns(adjusted), "adjustment_ties"),
                                               ("OUTPUT_NODES", node_columns(adjusted), "adjustment_nodes")):
            results |= self.write_layer(parameters, name, context, None, columns, crs, shapely.points(places), "PointZ",
                                        style=style, progress=progress)
        return results
