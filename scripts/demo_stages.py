"""The stages of the demo: what is run on the sample city, in which order, and how each result is checked.

A new stage is one more row. Paths are relative to the demo's folder; `check` gets that folder.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from scripts import demo_checks as checks
from scripts.demo_checks import Figure

CITY = Path("city")
ALS = CITY / "als/als.laz"
ALS_CLASSIFIED = CITY / "als/als_classified.laz"
OUTLINES = Path("outlines.gpkg")


@dataclass(frozen=True)
class Stage:
    """A run of an algorithm and the measure of its result.

    `parameters` hold paths as `Path`, and values as QGIS reads them.
    """

    title: str
    algorithm: str
    parameters: Mapping[str, object]
    check: Callable[[Path], list[Figure]]

    def parameters_in(self, folder: Path) -> dict[str, object]:
        """The parameters with paths in the demo's folder."""
        return {name: folder / value if isinstance(value, Path) else value
                for name, value in self.parameters.items()}


def _buildings(title: str, points: Path, name: str) -> Stage:
    """Building models from points and the loaded outlines, in files that begin with `name`."""
    return Stage(title, "urbanmap:buildingsfromals",
                 {"POINTS": points, "FOOTPRINTS": OUTLINES, "OUTPUT": Path(f"{name}.gpkg"),
                  "OUTPUT_SURFACES": Path(f"{name}_surfaces.gpkg"), "OUTPUT_CITYJSON": Path(f"{name}.city.json"),
                  "OUTPUT_REPORT": Path(f"{name}.html")},
                 partial(checks.models, models=name))


def stages(size: float, seed: int) -> list[Stage]:
    """All stages on a city of `size` metres, in the order in which they need each other."""
    return [
        Stage("Sample city", "urbanmap:samplecity", {"SIZE": size, "SEED": seed, "OUTPUT": CITY},
              checks.city_as_delivered),
        Stage("Load GSI buildings", "urbanmap:loadgsibuildings",
              {"INPUT_FOLDER": CITY / "footprints", "OUTPUT": OUTLINES}, checks.loaded_outlines),
        Stage("Surface and ground from ALS", "urbanmap:surfacefromals",
              {"POINTS": ALS, "OUTPUT": Path("dsm.tif"), "OUTPUT_GROUND": Path("ground.tif")}, checks.surfaces),
        _buildings("Buildings from unclassified ALS", ALS, "models"),
        _buildings("Buildings from classified ALS", ALS_CLASSIFIED, "models_classified"),
        Stage("Road markings from frames", "urbanmap:aerialmarkings",
              {"FRAMES": CITY / "aerial", "CAMERA": CITY / "aerial/camera.json",
               "EXTERIOR": CITY / "aerial/exterior.csv", "ALS": ALS, "FOOTPRINTS": OUTLINES,
               "OUTPUT": Path("markings.tif"), "OUTPUT_POLYGONS": Path("markings.gpkg"),
               "OUTPUT_ORTHOPHOTO": Path("orthophoto.tif")}, checks.markings),
    ]
