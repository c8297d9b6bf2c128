"""urbanmap:aerialmarkings."""

from __future__ import annotations

from ..aerial.orthorectifyframes import METHODS, OrthorectifyFrames
from ..aerial.roadmarkingsfromorthophoto import RoadMarkingsFromOrthophoto
from ..aerial.surfacefromals import SurfaceFromAls
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.running.chain import GivenParameters


class AerialMarkings(UrbanMapAlgorithm):
    ID = "aerialmarkings"
    NAME = "Road markings from aerial frames"
    SOURCE = "Javanmardi, 3.2.1, 3.2.2 and 4.1"
    KEYWORDS = ("road", "marking", "aerial", "frames", "orthophoto", "ALS", "reference", "workflow")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    HELP = (
        "Goes from aerial frames and airborne laser points to the reference that mobile surveys are tied to, in one "
        "run: surface and ground from ALS, orthophoto of the ground that the frames see, without moving vehicles, and "
        "road markings with their heights.\n"
        "Frames, points and outlines must be in one projected coordinate system in metres."
    )

    def declare(self):
        self.add_from(OrthorectifyFrames, "FRAMES", "CAMERA", "EXTERIOR")
        self.add_from(SurfaceFromAls, ALS="POINTS", label="Airborne laser points")
        self.add_from(OrthorectifyFrames, "FOOTPRINTS")
        self.add_from(RoadMarkingsFromOrthophoto, "ROADS")
        self.add_from(OrthorectifyFrames, "RESOLUTION", "FILTER_VEHICLES")
        self.add_choice("METHOD", "Method", "Vote and darkest: our way, with that vehicle filter. Paper: as in the "
                        "paper, frames masked by their occlusion maps, the darkest of them, and the plain adaptive "
                        "threshold (in the model set the method of the markings too).", METHODS, "vote", advanced=True)
        self.add_from(OrthorectifyFrames, "EVEN_EXPOSURE", "OCCLUSION", "MASKS", advanced=True)
        self.add_from(RoadMarkingsFromOrthophoto, MARKING_METHOD="METHOD", label="Method of the markings",
                      advanced=True)
        self.add_from(SurfaceFromAls, SURFACE_RESOLUTION="RESOLUTION", label="Resolution of the surface", advanced=True)
        self.add_from(SurfaceFromAls, "POINTS_CRS")
        self.add_from(OrthorectifyFrames, "ANGLE_ORDER", "ANGLE_UNIT")
        self.add_from(RoadMarkingsFromOrthophoto, "BLOCK_SIZE", "CONTRAST", "MIN_CONFIDENCE", advanced=True)
        self.add_from(RoadMarkingsFromOrthophoto, "WORKERS", "SCHEDULER", "OUTPUT")
        self.add_from(RoadMarkingsFromOrthophoto, "OUTPUT_POLYGONS", optional=True, by_default=True)
        self.add_from(OrthorectifyFrames, OUTPUT_ORTHOPHOTO="OUTPUT", optional=True, by_default=True)
        self.add_from(SurfaceFromAls, "OUTPUT_GROUND", optional=True, by_default=True)
        self.add_from(OrthorectifyFrames, "OUTPUT_SHIFTS", optional=True)
        self.add_from(RoadMarkingsFromOrthophoto, "OUTPUT_REPORT", "COUNT", optional=True)
        self.add_from(OrthorectifyFrames, "HOLE_AREA")

    def compute(self, parameters, context, feedback):
        given = GivenParameters(parameters)

        def destination(name, file):
            return given.get(name) or self.temporary_file(context, file)

        report = bool(given.get("OUTPUT_REPORT"))
        run = self.child_runner(context, feedback, 3)
        als = run("surfacefromals", POINTS=self.parameterAsFileList(parameters, "ALS", context),
                  RESOLUTION=self.parameterAsDouble(parameters, "SURFACE_RESOLUTION", context),
                  OUTPUT=self.temporary_file(context, "surface.tif"),
                  OUTPUT_GROUND=destination("OUTPUT_GROUND", "ground.tif"))
        wanted = {"OUTPUT_SHIFTS": given.get("OUTPUT_SHIFTS") or "TEMPORARY_OUTPUT",
                  "OUTPUT_COUNT": self.temporary_file(context, "frames.tif")} if report else given.pick("OUTPUT_SHIFTS")
        ortho = run("orthorectifyframes", **given.pick("FRAMES", "CAMERA", "EXTERIOR", "FOOTPRINTS", "RESOLUTION",
                                                       "FILTER_VEHICLES", "METHOD", "EVEN_EXPOSURE", "OCCLUSION",
                                                       "MASKS", "ANGLE_ORDER", "ANGLE_UNIT", "WORKERS"),
                    **wanted, GROUND=als["OUTPUT_GROUND"], DSM=als["OUTPUT"],
                    OUTPUT=destination("OUTPUT_ORTHOPHOTO", "orthophoto.tif"))
        facts = {"SHIFTS": ortho["OUTPUT_SHIFTS"], "FRAME_COUNT": ortho["OUTPUT_COUNT"],
                "NOTE": self._note(ortho)} if report else {}
        paper = self.parameterAsString(parameters, "METHOD", context) == "paper"
        method = "paper" if paper else self.parameterAsString(parameters, "MARKING_METHOD", context)
        found = run("roadmarkingsfromorthophoto", METHOD=method,
                    **given.pick("ROADS", "BLOCK_SIZE", "CONTRAST", "MIN_CONFIDENCE", "WORKERS", "OUTPUT",
                                 "OUTPUT_POLYGONS", "OUTPUT_REPORT"),
                    **facts, INPUT=ortho["OUTPUT"], GROUND=als["OUTPUT_GROUND"])
        results = {"OUTPUT": found["OUTPUT"], "COUNT": found["COUNT"], "HOLE_AREA": ortho["HOLE_AREA"],
                   "OUTPUT_ORTHOPHOTO": ortho["OUTPUT"], "OUTPUT_GROUND": als["OUTPUT_GROUND"]}
        results.update((name, result[name]) for result, name in (
            (ortho, "LARGEST_SHIFT"), (ortho, "OUTPUT_SHIFTS"), (found, "OUTPUT_POLYGONS"), (found, "OUTPUT_REPORT"))
            if name in result)
        return {name: value for name, value in results.items()
                if name not in ("OUTPUT_ORTHOPHOTO", "OUTPUT_GROUND", "OUTPUT_SHIFTS") or name in given}

    def _note(self, ortho) -> str:
        """What the chain did, for the report."""
        return tr("Frames used: {0}; holes that no frame sees outside buildings: {1:.0f} m².").format(
            ortho["FRAMES_USED"], ortho["HOLE_AREA"])
