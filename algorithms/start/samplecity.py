"""urbanmap:samplecity."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessingOutputFile, QgsProcessingOutputFolder

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.shown_results import show_layer, shown_after

SCENES = ("canyon", "few markings", "repainted", "elevated road")

# Output, label, place in the folder.
FILES = (
    ("ALS", "ALS points, unclassified", "als/als.laz"),
    ("ALS_CLASSIFIED", "ALS points, classified", "als/als_classified.laz"),
    ("FOOTPRINTS", "Official outlines", "footprints/gsi_buildings.gpkg"),
    ("CAMERA", "Camera", "aerial/camera.json"),
    ("EXTERIOR", "Exterior orientation", "aerial/exterior.csv"),
    ("ORTHOPHOTO", "Conventional orthophoto", "aerial/ortho.tif"),
    ("SURVEY_1", "Mobile survey 1", "mms/survey_01.laz"),
    ("TRAJECTORY_1", "Trajectory of survey 1, as reported", "mms/survey_01_trajectory.csv"),
    ("SURVEY_2", "Mobile survey 2", "mms/survey_02.laz"),
    ("TRAJECTORY_2", "Trajectory of survey 2, as reported", "mms/survey_02_trajectory.csv"),
    ("CALIBRATION", "Calibration of the mobile survey", "mms/calibration.json"),
)
FOLDERS = (("FRAMES", "Aerial frames", "aerial"), ("GNSS", "GNSS observations", "gnss"),
           ("LINES", "Line scans and line images", "lines"), ("TRUTH", "Truth", "truth"))

SHOWN = (("Conventional orthophoto", "aerial/ortho.tif", ""),
         ("Official outlines", "footprints/gsi_buildings.gpkg", "gsi_buildings"))
"""Label, place and style of what a window shows afterwards."""


class SampleCity(UrbanMapAlgorithm):
    ID = "samplecity"
    NAME = "Sample city"
    KEYWORDS = ("sample", "example", "demo", "test data", "simulation", "synthetic", "tutorial")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    HELP = (
        "Makes a city block that does not exist, with all the data that UrbanMap works on and the truth to check the "
        "results against: aerial frames, airborne laser points, official outlines, two mobile surveys that are about a "
        "metre off, line scans, GNSS observations.\n"
        "Begin here without data of your own: every algorithm can be tried on the files in the folder, which are in "
        "UrbanMap's own formats. A README.txt in the folder says what is where. The default city takes about a minute "
        "and 60 MB.\n"
        "The same seed, size and scene give the same files."
    )

    LASTING_FOLDERS = ("OUTPUT",)

    def declare(self):
        self.add_number("SEED", "Seed", "A whole number; every one gives another city.", 1, 0, integer=True)
        # No limits here: the core's own sentence says more than QGIS's about a value out of range.
        self.add_distance("SIZE", "Size", "Side of the square city in metres, 60 to 600. Time and disk space grow with "
                          "its square.", 200.0, None)
        self.add_choice("SCENE", "Scene", "A high-rise street canyon; one with few road markings; one whose markings "
                        "were repainted between the flights and the drives; one under an elevated road.", SCENES,
                        "canyon")
        self.add_text("FAULTS", "Faults", "Faults of real surveys to put in, with commas between them: steps (in the "
                      "trajectories), stops (a long wait), ghosts (points below the road), rings (lasers that differ), "
                      "ground (heights of the airborne points that are off), rails (and decks), "
                      "driveways (lowered kerbs), signs (boards and bollards), gantries (with boards over the "
                      "streets), japan, germany, us (street furniture in the sizes of their standards), islands (in "
                      "the avenue), paint (worn and patched), surface (wet and concrete stretches), "
                      "fronts (canopies, signs, garden walls, hoardings, balconies, awnings and storeys on columns "
                      "before buildings). Without any the city is as ever.", "", optional=True,
                      advanced=True)
        self.add_number("WORKERS", "Workers", "Number of sensors that measure at the same time. The result does not "
                        "depend on it.", 2, 1, 16, integer=True, advanced=True)
        self.add_folder_output("OUTPUT", "Sample city", "A new or empty folder.")
        for name, label, place in FILES:
            self.addOutput(QgsProcessingOutputFile(name, tr(label)))
            self.output_helps()[name] = place
        for name, label, place in FOLDERS:
            self.addOutput(QgsProcessingOutputFolder(name, tr(label)))
            self.output_helps()[name] = f"{place}/"
        self.add_number_output("BUILDINGS", "Buildings", "Number of buildings.")
        self.add_number_output("ALS_POINTS", "ALS points", "Number of airborne laser points.")
        self.add_number_output("MMS_POINTS", "MMS points", "Number of points of both mobile surveys.")

    def check(self, parameters, context):
        from ...urbanmap_qgis.samplecity.place import check_place
        from ...urbanmap_qgis.samplecity.scene.world import check_size

        self._faults(parameters, context)
        check_size(self.parameterAsDouble(parameters, "SIZE", context))
        check_place(self._folder(parameters, context))

    def compute(self, parameters, context, feedback):
        from ...urbanmap_qgis.samplecity.write import make_city

        folder = self._folder(parameters, context)
        with self.workers(parameters, context) as executor:
            result = make_city(folder, self.parameterAsDouble(parameters, "SIZE", context),
                               self.parameterAsString(parameters, "SCENE", context),
                               self.parameterAsInt(parameters, "SEED", context), self.progress(feedback), executor,
                               self._faults(parameters, context))
        if shown_after(feedback):
            for label, place, style in SHOWN:
                show_layer(context, folder / place, tr(label), style)
        places = {name: str(folder / place) for name, _, place in FILES + FOLDERS}
        return {"OUTPUT": str(folder), **places, "BUILDINGS": result["city"]["buildings"],
                "ALS_POINTS": result["als"]["points"],
                "MMS_POINTS": sum(survey["points"] for survey in result["mms"].values())}

    def _faults(self, parameters, context) -> tuple[str, ...]:
        from ...urbanmap_qgis.samplecity.faults import checked_faults

        words = self.parameterAsString(parameters, "FAULTS", context).replace(";", ",").split(",")
        return checked_faults(word.strip().lower() for word in words if word.strip())

    def _folder(self, parameters, context) -> Path:
        text = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        if not text:
            raise InputError(tr("No folder was given: give the name of a new one."))
        return Path(text)
