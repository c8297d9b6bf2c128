"""Recall, stray finds and verdict of road markings in photographs of many kinds and with many faults.

    python scripts/score_image_kinds.py FOLDER [--photo NAME ...] [--kind KIND ...]

FOLDER is the aerial data. Photographs of `DEVELOPED` were looked at while limits were chosen, the others held back.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rasterio
import shapely
from rasterio.features import rasterize

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.image_kinds import KINDS, ImageKind  # noqa: E402
from scripts.score_markings import LABELS, burnt, near, read_image, read_labels, write_image  # noqa: E402
from urbanmap_qgis.aerial.markings.marking_files import MarkingResult, markings_from_orthophoto  # noqa: E402
from urbanmap_qgis.aerial.markings.marking_verdict import marking_verdict  # noqa: E402
from urbanmap_qgis.io.pages.report import BAD, GOOD, LOOK  # noqa: E402

DEVELOPED = ("drift B", "drift D", "us 0", "us 12", "uav 1", "city")
SITES = {"B": 0.087, "C": 0.103, "D": 0.100, "F": 0.090}
"""Pixel in m of the drone photographs of junctions."""

GRADES = {GOOD: "good", LOOK: "look", BAD: "lost"}
MOST = 1280
"""Rows and columns of the middle of a photograph that are looked at, unless more is asked for."""


@dataclass(frozen=True)
class Photograph:
    """An image of which the truth is known.

    Attributes
    ----------
    image : red, green, blue (rows, columns, 3).
    pixel : side, m.
    outside : bool, where what is found is stray.
    reach : m; what is wanted is found where a find lies so near.
    wanted : bool, pixels; None where `lines` are given.
    lines : of pixels, (n, 2) columns and rows a metre apart, found where a find lies near along 15 m of them.
    """

    image: np.ndarray
    pixel: float
    outside: np.ndarray
    reach: float
    wanted: np.ndarray | None = None
    lines: tuple = ()

    def score(self, mask: np.ndarray) -> tuple[float, float]:
        """Recall (share) and stray finds (m2/ha, NaN where nothing tells) of a mask."""
        close = near(mask, self.reach, self.pixel)
        stray = float((mask & self.outside).sum() / self.outside.sum() * 1e4) if self.outside.any() else np.nan
        if self.wanted is not None:
            return float(close[self.wanted].mean()), stray
        hits = [np.convolve(close[line[:, 1], line[:, 0]], np.ones(15), "same")[:len(line)] > 0 for line in self.lines]
        return float(np.concatenate(hits).mean()), stray

    def middle(self, most: int) -> Photograph:
        """Its middle, at most so many rows and columns."""
        starts = [max((side - most) // 2, 0) for side in self.image.shape[:2]]
        place = tuple(slice(start, start + most) for start in starts)
        image = np.ascontiguousarray(self.image[place])
        moved = [line - starts[::-1] for line in self.lines]
        inside = [line[((line >= 0) & (line < image.shape[1::-1])).all(axis=1)] for line in moved]
        return Photograph(image, self.pixel, self.outside[place], self.reach,
                          None if self.wanted is None else self.wanted[place],
                          tuple(line for line in inside if len(line) > 15))


def junction(folder: Path, site: str) -> Photograph:
    """A drone photograph with lane polygons drawn on the paint: sides shared by two lanes, and what lies more than 3 m
    off the lanes."""
    pixel = SITES[site]
    image = read_image(folder / "drift" / f"Site{site}.jpg")
    held = json.loads((folder / "drift" / "roi.json").read_text(encoding="utf-8"))[f"Site {site}"]
    lanes, roads = [], []
    for arm, group in held.items():
        for points in group.values():
            if len(points) > 2:
                (roads if arm == "crossroads" else lanes).append(shapely.Polygon(points).buffer(0))
    edges = [line for k, one in enumerate(lanes) for other in lanes[k + 1:] for line in shapely.get_parts(
        one.boundary.intersection(other.buffer(12))) if line.geom_type == "LineString" and line.length > 20 / pixel]
    places = [np.rint(shapely.get_coordinates(shapely.line_interpolate_point(
        line, np.arange(0, line.length, 1 / pixel)))).astype(int) for line in edges]
    places = [np.clip(points, 0, np.array(image.shape[1::-1]) - 1) for points in places]
    outside = ~burnt([shapely.union_all(lanes + roads).buffer(3 / pixel)], image.shape[:2])
    return Photograph(image, pixel, outside, 0.3, lines=tuple(places))


def labelled(folder: Path, name: str) -> Photograph:
    """A photograph with labelled markings: labelled pixels; what lies in the carriageway 0.3 m and more off them."""
    labels = read_labels(LABELS / f"{name}.geojson")
    image = read_image(folder / labels.image)
    inside = burnt([labels.area], image.shape[:2])
    truth = burnt(labels.markings, image.shape[:2]) & inside
    return Photograph(image, labels.pixel, inside & ~near(truth, 0.3, labels.pixel), 2.2 * labels.pixel, truth)


def marked(folder: Path, name: str) -> Photograph:
    """A drone photograph of which some markings are labelled: recall alone."""
    image = read_image(folder / "uav_markings" / f"{name}.JPG")
    held = json.loads((folder / "uav_markings" / f"{name}.json").read_text(encoding="utf-8"))["shapes"]
    truth = burnt([shapely.Polygon(item["points"]).buffer(0) for item in held], image.shape[:2])
    return Photograph(image, 0.03, np.zeros_like(truth), 0.066, truth)


def sunlit(folder: Path, tile: int) -> Photograph:
    """The largest labelled crop of a sunlit tile and 25 m round it; what lies in the crop and 0.3 m off all paint."""
    labels = read_labels(LABELS / f"us_{tile}.geojson")
    image = read_image(folder / labels.image)
    crop = max(shapely.get_parts(labels.area), key=shapely.area)
    inside, truth = burnt([crop], image.shape[:2]), burnt(labels.markings, image.shape[:2])
    left, top, right, bottom = (int(end) for end in crop.bounds)
    place = np.s_[max(top - 200, 0):bottom + 200, max(left - 200, 0):right + 200]
    outside = (inside & ~near(truth, 0.3, labels.pixel))[place]
    return Photograph(np.ascontiguousarray(image[place]), labels.pixel, outside, 0.3, (truth & inside)[place])


def crossing(folder: Path) -> Photograph:
    """A French orthophoto of 50 m with one zebra crossing, of which three bars were labelled by hand; what lies more
    than 3 m off the road."""
    with rasterio.open(folder.parent / "als" / "ign" / "test_data_rgb.tif") as source:
        image, pixel = np.moveaxis(source.read([1, 2, 3]), 0, -1), source.transform.a
    bars = [((23, 220.5), (38, 232)), ((19.5, 224), (34.5, 236.5)), ((16, 228.5), (31, 240.5))]
    road = shapely.Polygon([(0, 187), (22, 204), (25, 218), (42, 236), (60, 252), (37, 252), (15, 230), (0, 220)])
    truth = burnt([shapely.LineString(bar).buffer(1) for bar in bars], image.shape[:2])
    outside = ~burnt([road.buffer(3 / pixel)], image.shape[:2])
    return Photograph(np.ascontiguousarray(image), pixel, outside, 1.2 * pixel, truth)


def painted(city: Path) -> Photograph:
    """The orthophoto of a simulated city: true paint in the carriageways, less what is known to be hidden; what lies in
    or 3 m round them farther than 0.3 m from all paint."""
    from scripts.layers import read_layer

    with rasterio.open(city / "aerial" / "ortho.tif") as source:
        image, place = np.moveaxis(source.read([1, 2, 3]), 0, -1), source.transform

    def drawn(found: np.ndarray) -> np.ndarray:
        return rasterize([(shape, 1) for shape in found], image.shape[:2], transform=place) > 0

    areas, (kinds,) = read_layer(city / "truth" / "areas.gpkg", "kind")
    roads = drawn(areas[np.array(kinds) == "carriageway"])
    paint = drawn(read_layer(city / "truth" / "markings.gpkg", layer="aerial")[0])
    outside, wanted = near(roads, 3, place.a) & ~near(paint, 0.3, place.a), paint & roads
    hidden = city / "truth" / "occlusion" / "ortho.tif"
    if hidden.is_file():
        with rasterio.open(hidden) as source:
            wanted &= source.read(1) == 0
    return Photograph(np.ascontiguousarray(image), place.a, outside, 1.2 * place.a, wanted)


def photographs(folder: Path) -> dict[str, Callable[[], Photograph]]:
    """What reads each photograph."""
    made = {f"drift {site}": lambda site=site: junction(folder, site) for site in SITES}
    made |= {f"us {tile}": lambda tile=tile: sunlit(folder, tile) for tile in (0, 7, 12, 20)}
    return {**made, "uav 1": lambda: labelled(folder, "uav_markings_1"), "uav 2": lambda: marked(folder, "test_2"),
            "sind": lambda: labelled(folder, "sind"), "ign": lambda: crossing(folder),
            "city": lambda: painted(folder.parent / "city")}


def searched(photograph: Photograph, kind: ImageKind, work: Path) -> tuple[MarkingResult, np.ndarray]:
    """What is found in a kind of a photograph, and the mask on its pixels."""
    image = kind.change(photograph.image, photograph.pixel)
    pixel = photograph.pixel * kind.pixel_factor
    write_image(work / "image.tif", image, pixel)
    found = markings_from_orthophoto(work / "image.tif", work / "mask.tif")
    with rasterio.open(work / "mask.tif") as source:
        return found, source.read(1) > 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--photo", nargs="*")
    parser.add_argument("--kind", nargs="*")
    parser.add_argument("--most", type=int, default=MOST, help="rows and columns of the middle that are looked at")
    given = parser.parse_args()
    for name, read in photographs(given.folder).items():
        if given.photo and name not in given.photo:
            continue
        photograph = read().middle(given.most)
        for kind in given.kind or KINDS:
            with tempfile.TemporaryDirectory() as work:
                found, mask = searched(photograph, KINDS[kind], Path(work))
            recall, stray = photograph.score(mask)
            grade = GRADES[marking_verdict(found).grade]
            print(f"{name:9s} {kind:21s} recall {recall:.3f} stray {stray:5.0f} m2/ha {grade}", flush=True)


if __name__ == "__main__":
    main()
