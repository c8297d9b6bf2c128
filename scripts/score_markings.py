"""Scores of road markings found in real photographs, against the labels in tests/real/labels.

    python scripts/score_markings.py FOLDER [--roads]

FOLDER holds the photographs. Without --roads they are searched as they are and judged inside the labelled carriageways.
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
TOLERANCE = 2
"""Pixels that a found pixel may lie from a labelled one, and the other way round."""

PHOTOGRAPHS = ("drift_c", "sind", "uav_markings_1")
"""Names of the labelled photographs."""

CLASSES = (0.2, 0.4, 0.6, 0.8, 1.0001)
"""Borders of the classes of confidence."""


@dataclass(frozen=True)
class Labels:
    """Labelled markings of a photograph in pixels (whole numbers at centres), inside a carriageway polygon."""

    image: str
    pixel: float
    carriageway: shapely.Polygon
    markings: list


@dataclass(frozen=True)
class MarkingScore:
    """Shares of pixels: found ones near a label, labelled ones near a find; `classes` has precision and number of
    polygons for each class of confidence, NaN where there are none."""

    precision: float
    recall: float
    classes: list[tuple[float, int]]

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall."""
        return 2 * self.precision * self.recall / max(self.precision + self.recall, 1e-9)


def read_labels(path: Path) -> Labels:
    """Labels of a file."""
    held = json.loads(path.read_text(encoding="utf-8"))
    shapes = [(item["properties"]["kind"], shapely.geometry.shape(item["geometry"])) for item in held["features"]]
    return Labels(held["image"], held["pixel_m"], next(shape for kind, shape in shapes if kind == "carriageway"),
                  [shape for kind, shape in shapes if kind == "marking"])


def burnt(shapes: list, shape: tuple[int, int]) -> np.ndarray:
    """Pixels whose centres lie in polygons, bool."""
    return rasterize([(one, 1) for one in shapes], shape, transform=Affine.translation(-0.5, -0.5)) > 0


def _near(mask: np.ndarray) -> np.ndarray:
    side = 2 * TOLERANCE + 1
    return cv2.dilate(mask.astype(np.uint8), cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))) > 0


def score(labels: Labels, folder: Path, roads: bool, work: Path) -> MarkingScore:
    """Find the markings of a photograph and score them inside its carriageway polygon."""
    pixels = cv2.imdecode(np.fromfile(folder / labels.image, np.uint8), cv2.IMREAD_COLOR)[..., ::-1]
    height, width = pixels.shape[:2]
    place = Affine(labels.pixel, 0, 0, 0, -labels.pixel, height * labels.pixel)
    with rasterio.open(work / "image.tif", "w", driver="GTiff", width=width, height=height, count=3, dtype="uint8",
                       transform=place, crs="EPSG:6677", photometric="RGB") as target:
        target.write(np.moveaxis(pixels, -1, 0))

    def to_ground(points: np.ndarray) -> np.ndarray:
        return np.column_stack([(points[:, 0] + 0.5) * place.a, place.f + (points[:, 1] + 0.5) * place.e])

    carriageway = shapely.transform(labels.carriageway, to_ground)
    found = markings_from_orthophoto(work / "image.tif", work / "mask.tif",
                                     SearchArea(roads=[carriageway]) if roads else None)
    with rasterio.open(work / "mask.tif") as source:
        mask = source.read(1) > 0
    inside = burnt([labels.carriageway], mask.shape)
    truth, mask = burnt(labels.markings, mask.shape) & inside, mask & inside
    near_truth = _near(truth)
    precision = (mask & near_truth).sum() / max(mask.sum(), 1)
    recall = (truth & _near(mask)).sum() / truth.sum()
    return MarkingScore(float(precision), float(recall), _classes(found.polygons, near_truth, inside, place))


def _classes(found, near_truth: np.ndarray, inside: np.ndarray, place: Affine) -> list[tuple[float, int]]:
    """Precision by area, and number, of the polygons in the carriageway for each class of confidence."""
    numbers = rasterize([(shape, k) for k, shape in enumerate(found.polygons, 1)], inside.shape, transform=place,
                        dtype="int32") if len(found) else np.zeros(inside.shape, np.int32)
    right = np.bincount(numbers[inside & near_truth], minlength=len(found) + 1)[1:]
    total = np.bincount(numbers[inside], minlength=len(found) + 1)[1:]
    made = []
    for low, high in zip(CLASSES, CLASSES[1:]):
        here = (found.confidence >= low) & (found.confidence < high) & (total > 0)
        made.append((float(right[here].sum() / total[here].sum()) if here.any() else float("nan"), int(here.sum())))
    return made


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--roads", action="store_true")
    given = parser.parse_args()
    for name in PHOTOGRAPHS:
        with tempfile.TemporaryDirectory() as work:
            made = score(read_labels(LABELS / f"{name}.geojson"), given.folder, given.roads, Path(work))
        print(f"{name}: precision {made.precision:.3f} recall {made.recall:.3f} F1 {made.f1:.3f}; by confidence "
              + ", ".join(f"{low:.1f}: {share:.2f} ({count})" for low, (share, count) in zip(CLASSES, made.classes)))


if __name__ == "__main__":
    main()
