"""urbanmap:groundfrommms."""

from __future__ import annotations

from ...urbanmap_qgis.settings.terrain import ClothSettings
from ..framework.base import UrbanMapAlgorithm


class GroundFromMms(UrbanMapAlgorithm):
    ID = "groundfrommms"
    NAME = "Ground of a mobile survey"
    SOURCE = "Javanmardi, 3.2.3.1; cloth filter: Zhang et al. 2016"
    KEYWORDS = ("MMS", "ground", "road", "pavement", "cloth", "CSF", "lidar", "classification")
    REQUIRES = ("numpy", "scipy", "pyproj", "laspy", "lazrs", "cv2", "rasterio")
    HELP = (
        "Tells the ground of a mobile laser survey, roads and pavements alike, from all that stands on it.\n"
        "A cloth is drawn up against the points from below; points within a threshold of it become class 2. Points of "
        "other classes than 0, 1 and 2 keep theirs. All attributes and the order of the points stay.\n"
        "A street that is driven several times is filtered pass by pass where the points have GPS time, because the "
        "passes may lie decimetres apart in height. Small clusters of points below a much denser road (multipath "
        "ghosts) are left out. The lowest decimetres of walls and posts count as ground: the threshold cannot tell "
        "them. The files may be larger than memory."
    )

    def declare(self):
        self.add_points()
        self.add_settings(ClothSettings, "resolution", "iterations", "threshold", advanced=False, threshold="THRESHOLD")
        self.add_settings(ClothSettings)
        self.add_number("MIN_GROUND_SHARE", "Minimum ground share", "A smaller share of ground among the points, 0 to "
                        "1, is refused: it shows that the filter has failed. 0 accepts every share.", 0.01, 0.0, 1.0,
                        advanced=True)
        self.add_points_crs()
        self.add_workers()
        self.add_points_output("OUTPUT", "Classified points", "All points; ground has class 2, what was undecided and "
                               "is no ground class 1.")
        self.add_number_output("POINTS_READ", "Points read", "All points in the files.")
        self.add_number_output("POINTS_USED", "Points used", "Points that are not noise or withheld.")
        self.add_number_output("GROUND_POINTS", "Ground points", "Points of class 2 in the result.")
        self.add_number_output("GROUND_SHARE", "Ground share", "Ground points as a share of the points used, 0 to 1.")
        self.add_number_output("PASSES", "Passes", "Passes through the same place that were filtered apart.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.mobile.ground import classify_ground_files

        paths = self.point_files(parameters, "POINTS", context)
        self.projected_cloud(parameters, context)
        settings = self.settings(ClothSettings, parameters, context)
        output = self.output_path(parameters, "OUTPUT", context)
        with self.workers(parameters, context) as executor:
            result = classify_ground_files(paths, output, settings, progress, executor,
                                           min_ground_share=self.parameterAsDouble(parameters, "MIN_GROUND_SHARE",
                                                                                   context))
        return {"OUTPUT": str(output), "POINTS_READ": result.points, "POINTS_USED": result.usable,
                "GROUND_POINTS": result.ground, "GROUND_SHARE": result.ground / result.usable, "PASSES": result.passes}
