"""Scores of road markings found in aerial tiles of which only the lanes' centre lines are known.

FOLDER holds tile_N.jpg with world files, and lanes_N.geojson. With --masks the masks are written there.
"""

from __future__ import annotations

import json
import tempfile
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import rasterio
import shapely
from rasterio.features import rasterize

from urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto

TILES = (0, 7, 12, 20)
"""Numbers of the tiles."""

NEAR = 2.6
"""m from a lane's centre line that its own paint lies at most."""

FAR = 6.0
"""m from every lane beyond which there is little paint."""

PLACES = Path(__file__).resolve().parents[2] / "tests" / "real" / "labels" / "lane_tiles.json"
"""Labels of places on the centre lines: at half of them no paint is to be seen."""


@dataclass(frozen=True)
class LaneTileScore:
    """Share of the centre lines' pixels with a find within `NEAR`; finds beyond `FAR` of all lanes, m2 a hectare of the
    ground there; share of the found area that lies within `FAR`."""

    recall: float
    stray: float
    within: float


def score_lanes(mask: np.ndarray, lanes: list, place: rasterio.Affine) -> LaneTileScore:
    """Score a mask (rows, columns) by centre lines in the CRS that `place` leads to."""
    pixel = place.a
    line = rasterize([(lane, 1) for lane in lanes], mask.shape, transform=place) > 0
    from_find = cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 5) * pixel
    from_lane = cv2.distanceTransform((~line).astype(np.uint8), cv2.DIST_L2, 5) * pixel
    far = from_lane > FAR
    stray = (mask & far).sum() / max(far.sum(), 1) * 1e4
    return LaneTileScore(float((from_find[line] <= NEAR).mean()) if mask.any() else 0.0, float(stray),
                         float((mask & ~far).sum() / max(mask.sum(), 1)))


def labelled_places(tile: int) -> np.ndarray:
    """Places (n, 3) on a tile's centre lines, chosen by chance: row, column, and whether paint is to be seen within
    `NEAR`, told by eye."""
    return np.array(json.loads(PLACES.read_text(encoding="utf-8"))[str(tile)])


def score_places(mask: np.ndarray, places: np.ndarray, pixel: float) -> tuple[int, int]:
    """At how many places with paint, and with none, something is found within `NEAR` in a mask of pixels of a side in
    m."""
    from_find = cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 5) * pixel
    found = from_find[places[:, 0], places[:, 1]] <= NEAR if mask.any() else np.zeros(len(places), bool)
    painted = places[:, 2] > 0
    return int(np.count_nonzero(found & painted)), int(np.count_nonzero(found & ~painted))


def score_tile(folder: Path, tile: int, work: Path) -> LaneTileScore:
    """Find the markings of a tile, write them to `work`, and score them."""
    held = json.loads((folder / f"lanes_{tile}.geojson").read_text(encoding="utf-8"))
    lanes = [shapely.geometry.shape(item["geometry"]) for item in held["features"]]
    path = work / f"mask_{tile}.tif"
    markings_from_orthophoto(folder / f"tile_{tile}.jpg", path)
    with rasterio.open(path) as source:
        return score_lanes(source.read(1) > 0, lanes, source.transform)


def judge(folder: Path, tiles: tuple[int, ...] = TILES, masks: Path | None = None) -> None:
    """Print a line a tile."""
    with tempfile.TemporaryDirectory() as work:
        for tile in tiles:
            target, places = masks or Path(work), labelled_places(tile)
            made = score_tile(folder, tile, target)
            with rasterio.open(target / f"mask_{tile}.tif") as source:
                painted, bare = score_places(source.read(1) > 0, places, source.transform.a)
            paint = np.count_nonzero(places[:, 2])
            print(f"tile {tile}: recall {made.recall:.3f} stray {made.stray:.0f} m2/ha, {made.within:.2f} near lanes; "
                  f"found at {painted} of {paint} places with paint, {bare} of {len(places) - paint} without",
                  flush=True)
