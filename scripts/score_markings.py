"""Judge of road markings: precision and recall of painted area in photographs with labels, see tests/real/labels.

    python scripts/score_markings.py FOLDER [NAME ...] [--roads]

FOLDER is the aerial data. A found pixel is right where labelled paint lies within `TOLERANCE`, labelled paint is found
where a find lies so near. Without --roads photographs are searched as they are. Of sunlit tiles the share of the lanes'
centre lines with a find near is printed too, less what as many finds at random would have.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import rasterio
import shapely
from rasterio.features import rasterize
from rasterio.transform import Affine

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto  # noqa: E402
from urbanmap_qgis.aerial.markings.orthophoto_reader import SearchArea  # noqa: E402

LABELS = ROOT / "tests" / "real" / "labels"
TOLERANCE = 0.3
"""m."""

NEAR_LANE = 2.6
"""m from a lane's centre line that its own paint lies at most."""

PHOTOGRAPHS = ("drift_c", "sind", "uav_markings_1")
"""Names of the labelled drone photographs."""

SUNLIT = ("us_0", "us_2", "us_7", "us_10", "us_12", "us_20")
"""Names of the sunlit tiles with labelled crops."""

HELD_BACK = ("us_15", "us_24")
"""Sunlit tiles on which nothing was chosen."""

CLASSES = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0001)
"""Borders of the classes of confidence."""


@dataclass(frozen=True)
class Labels:
    """Labelled markings of a photograph in pixels (whole numbers at centres).

    Attributes
    ----------
    image : path under the aerial data.
    pixel : side, m.
    area : where every marking is labelled, less what the eye cannot tell.
    markings : polygons.
    """

    image: str
    pixel: float
    area: shapely.Geometry
    markings: list


@dataclass(frozen=True)
class MarkingScore:
    """Found and labelled area, m2, and what of each is right.

    Attributes
    ----------
    found, right, painted, reached : m2: found; of it on paint; labelled; of it found.
    classes : (found, right) for each class of confidence.
    lanes : share of the lanes' centre lines with a find near, 0 as at random; NaN where no lanes are known.
    """

    found: float
    right: float
    painted: float
    reached: float
    classes: np.ndarray
    lanes: float = float("nan")

    @property
    def precision(self) -> float:
        """Share of the found area that is paint."""
        return self.right / self.found if self.found else float("nan")

    @property
    def recall(self) -> float:
        """Share of the labelled area that is found."""
        return self.reached / self.painted if self.painted else float("nan")

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall."""
        return 2 * self.precision * self.recall / max(self.precision + self.recall, 1e-9)

    def __str__(self) -> str:
        classes = ", ".join(f"{low:.1f}: {right / found:.2f} ({found:.0f} m2)" for low, (found, right) in zip(
            CLASSES, self.classes) if found)
        lanes = "" if np.isnan(self.lanes) else f" lanes above chance {self.lanes:.2f}"
        return (f"precision {self.precision:.3f} recall {self.recall:.3f} of {self.painted:.0f} m2{lanes}; "
                f"by confidence {classes}")


def total(scores: list[MarkingScore]) -> MarkingScore:
    """All areas together."""
    return MarkingScore(*(sum(getattr(one, name) for one in scores) for name in ("found", "right", "painted", "reached")
                          ), sum(one.classes for one in scores))


def read_labels(path: Path) -> Labels:
    """Labels of a file."""
    held = json.loads(path.read_text(encoding="utf-8"))
    shapes = [(item["properties"]["kind"], shapely.geometry.shape(item["geometry"])) for item in held["features"]]

    def of(*kinds: str) -> list:
        return [shapely.make_valid(shape) for kind, shape in shapes if kind in kinds]

    area = shapely.difference(shapely.union_all(of("carriageway", "crop")), shapely.union_all(of("unsure")))
    return Labels(held["image"], held["pixel_m"], area, of("marking"))


def burnt(shapes: list, shape: tuple[int, int]) -> np.ndarray:
    """Pixels whose centres lie in polygons, bool."""
    return rasterize([(one, 1) for one in shapes], shape, transform=Affine.translation(-0.5, -0.5)) > 0


def near(mask: np.ndarray, metres: float, pixel: float) -> np.ndarray:
    """What lies within so many metres of a mask, bool."""
    return cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 5) * pixel <= metres if mask.any() else mask


def read_image(path: Path) -> np.ndarray:
    """Red, green, blue (rows, columns, 3) of a file."""
    return cv2.imdecode(np.fromfile(path, np.uint8), cv2.IMREAD_COLOR)[..., ::-1]


def write_image(path: Path, image: np.ndarray, pixel: float) -> Affine:
    """Write an image with pixels of a side in m to a place of its own; where that is."""
    place = Affine(pixel, 0, 0, 0, -pixel, image.shape[0] * pixel)
    with rasterio.open(path, "w", driver="GTiff", width=image.shape[1], height=image.shape[0], count=3, dtype="uint8",
                       transform=place, crs="EPSG:6677", photometric="RGB") as target:
        target.write(np.moveaxis(image, -1, 0))
    return place


def score_of(mask: np.ndarray, confidence: np.ndarray, labels: Labels) -> MarkingScore:
    """Score of a mask (bool) and the confidence of its pixels, both of the whole photograph."""
    inside = burnt([labels.area], mask.shape)
    truth = burnt(labels.markings, mask.shape) if labels.markings else np.zeros_like(mask)
    right, reached = mask & inside & near(truth, TOLERANCE, labels.pixel), near(mask, TOLERANCE, labels.pixel)
    truth &= inside
    classes = np.array([[np.count_nonzero(part & (confidence >= low) & (confidence < high))
                         for part in (mask & inside, right)] for low, high in zip(CLASSES, CLASSES[1:])], float)
    square = labels.pixel ** 2
    return MarkingScore(*(square * np.count_nonzero(part) for part in (
        mask & inside, right, truth, truth & reached)), square * classes)


def lanes_above_chance(mask: np.ndarray, lanes: np.ndarray, pixel: float) -> float:
    """Share of lane pixels (bool) with a find within `NEAR_LANE`, so that as many at any place are 0 and all are 1."""
    close = near(mask, NEAR_LANE, pixel)
    chance = float(close.mean())
    return (float(close[lanes].mean()) - chance) / max(1 - chance, 1e-9)


def score(labels: Labels, folder: Path, roads: bool, work: Path) -> MarkingScore:
    """Find the markings of a photograph and score them where they are labelled."""
    image = read_image(folder / labels.image)
    place = write_image(work / "image.tif", image, labels.pixel)

    def to_ground(points: np.ndarray) -> np.ndarray:
        return np.column_stack([(points[:, 0] + 0.5) * place.a, place.f + (points[:, 1] + 0.5) * place.e])

    found = markings_from_orthophoto(work / "image.tif", work / "mask.tif", SearchArea(
        roads=[shapely.transform(labels.area, to_ground)]) if roads else None).polygons
    with rasterio.open(work / "mask.tif") as source:
        mask = source.read(1) > 0
    confidence = rasterize(((found.polygons[k], found.confidence[k]) for k in np.argsort(found.confidence)), mask.shape,
                           transform=place, dtype="float32") if len(found) else np.zeros(mask.shape, np.float32)
    made = score_of(mask, confidence, labels)
    lanes = folder / labels.image.replace("tile_", "lanes_").replace(".jpg", ".geojson")
    if lanes.suffix != ".geojson" or not lanes.is_file():
        return made
    with rasterio.open(folder / labels.image) as source:
        own = source.transform
    held = json.loads(lanes.read_text(encoding="utf-8"))
    line = rasterize([(shapely.geometry.shape(item["geometry"]), 1) for item in held["features"]], mask.shape,
                     transform=own) > 0
    return MarkingScore(made.found, made.right, made.painted, made.reached, made.classes,
                        lanes_above_chance(mask, line, labels.pixel))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*", default=[*PHOTOGRAPHS, *SUNLIT])
    parser.add_argument("--roads", action="store_true")
    given = parser.parse_args()
    sunlit = []
    for name in given.names:
        with tempfile.TemporaryDirectory() as work:
            made = score(read_labels(LABELS / f"{name}.geojson"), given.folder, given.roads, Path(work))
        print(f"{name}: {made}", flush=True)
        sunlit += [made] if name.startswith("us_") else []
    if len(sunlit) > 1:
        print(f"sunlit tiles together: {total(sunlit)}")


if __name__ == "__main__":
    main()
