"""urbanmap:applytrajectory."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr

OUTSIDE = ("move", "keep", "refuse")
POSES_FILTER = "Image poses (*.csv *.txt)"


class ApplyTrajectory(UrbanMapAlgorithm):
    ID = "applytrajectory"
    NAME = "Apply corrected trajectory"
    SOURCE = "Javanmardi, 3.2.4.3"
    KEYWORDS = ("trajectory", "correction", "georeferencing", "mobile", "survey", "LAZ", "images")
    REQUIRES = ("numpy", "pyproj", "laspy", "lazrs")
    HELP = (
        "Moves the points of a survey, and the poses of its images, from the trajectory with which they were placed to "
        "the corrected one.\n"
        "Only coordinates change: attributes, extra dimensions, header records and the order of the points are kept. "
        "Several files are written as one, one after the other. The files may be larger than memory. The GPS times of "
        "the points may be seconds of the week or adjusted standard time."
    )

    def declare(self):
        self.add_points(help="The survey: one or several LAS, LAZ or COPC files with GPS times, as the reported "
                        "trajectory places it.")
        self.add_trajectory("TRAJECTORY", "Reported trajectory", "The trajectory with which the survey was placed: CSV "
                            "time,x,y,z,roll,pitch,heading, SBET, or a point layer with these fields.")
        self.add_trajectory("CORRECTED", "Corrected trajectory", "The same after the correction.")
        self.add_trajectory_reading()
        self.add_file("IMAGES", "Image poses", "CSV id,time,x,y,z,roll,pitch,heading of the survey's images, "
                      "angles counted as those of the trajectory.",
                      POSES_FILTER, optional=True)
        self.add_choice("OUTSIDE", "Points outside the trajectory", "What is done with points that were measured "
                        "before the trajectory begins or after it ends: move them with its nearest pose, keep them "
                        "where they are, or refuse to run. Their number is told.", OUTSIDE, "move", advanced=True)
        self.add_points_crs()
        self.add_points_output("OUTPUT", "Corrected survey", "All points in their order, with all attributes.")
        self.add_file_output("OUTPUT_IMAGES", "Corrected image poses", "The same rows with corrected poses.",
                             POSES_FILTER, optional=True)
        self.add_number_output("POINT_COUNT", "Points", "Points written.")
        self.add_number_output("POINTS_OUTSIDE", "Points outside", "Points measured outside the trajectory's time.")
        self.add_number_output("POINTS_IN_GAPS", "Points in gaps", "Points measured in gaps of a trajectory of more "
                               "than a second.")
        self.add_number_output("MEAN_MOVEMENT", "Mean movement", "Mean length of the movements.", unit="m")
        self.add_number_output("MAX_MOVEMENT", "Maximum movement", "Maximum length of a movement.", unit="m")

    def check(self, parameters, context):
        check_poses(self, parameters, context)

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.io.points.pointcloud import open_cloud
        from ...urbanmap_qgis.mobile.apply_correction import apply_correction, apply_to_images

        paths = self.point_files(parameters, "POINTS", context)
        crs = open_cloud(paths).crs_wkt
        reported = self.read_trajectory(parameters, "TRAJECTORY", context, crs, progress)
        corrected = self.read_trajectory(parameters, "CORRECTED", context, crs,
                                         None if reported.notes else progress)
        images = self.input_path(parameters, "IMAGES", context)
        poses = self.output_path(parameters, "OUTPUT_IMAGES", context)
        output = self.output_path(parameters, "OUTPUT", context)
        moved = apply_correction(paths, reported.trajectory, corrected.trajectory, output,
                                 self.parameterAsString(parameters, "OUTSIDE", context), progress)
        results = {"OUTPUT": str(output), "POINT_COUNT": moved.points, "POINTS_OUTSIDE": moved.outside,
                   "POINTS_IN_GAPS": moved.in_gaps, "MEAN_MOVEMENT": moved.mean, "MAX_MOVEMENT": moved.largest}
        if images and poses:
            apply_to_images(images, reported.trajectory, corrected.trajectory, poses, moved, progress,
                            self.parameterAsString(parameters, "ANGLES", context))
            results["OUTPUT_IMAGES"] = str(poses)
        return results


def check_poses(algorithm, parameters, context) -> None:
    """Refuse image poses that are wanted but not given."""
    if algorithm.output_path(parameters, "OUTPUT_IMAGES", context) and not algorithm.input_path(parameters, "IMAGES",
                                                                                               context):
        raise InputError(tr("Corrected image poses are wanted, but no image poses are given."))
