"""HTML report on road markings: what was found, how far the images agree, and what to distrust."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import rasterio
import shapely
from rasterio.enums import Resampling
from rasterio.transform import Affine

from ...geometry.tolerances import LEAST_DIVISOR
from ...io.pages.report import BAD, GOOD, LOOK, Report
from ...io.raster import own_gdal
from ...wording import mark, say
from ..orthophotos.frame_shifts import APART, NOT_ALIKE
from .marking_files import MarkingResult
from .marking_polygons import CACHE
from .marking_verdict import marking_verdict
from .orthophoto_reader import colour_bands
from .stored_polygons import batches


@dataclass(frozen=True)
class MarkingReportLimits:
    """Limits of marking report, each with its unit."""

    picture_side: int = 1400
    detail: int = 500  # pixels, side of the part shown at full size
    line_colour: tuple[float, ...] = (0, 200, 83)  # blue, green, red
    coarse: float = 0.15
    faint: float = 1.5  # times the contrast asked for
    one_view: float = 0.2


LIMITS = MarkingReportLimits()


@dataclass(frozen=True)
class PairShift:
    """Median shift between the images of a pair, m, over `patches` places, and its status: see
    `frame_shifts.status_of`."""

    first: str
    second: str
    east: float
    north: float
    sigma: float
    patches: int
    status: str


@dataclass(frozen=True)
class OrthophotoQuality:
    """What is known of the orthophoto beside its pixels.

    Attributes
    ----------
    pairs : of overlapping frames, None where they were not compared.
    views : share of the ground in the image that 0, 1, 2 and 3 or more frames see; None where unknown.
    roads : whether markings were looked for inside roads only.
    contrast : grey values, as asked for.
    """

    pairs: Sequence[PairShift] | None
    views: Sequence[float] | None
    roads: bool
    contrast: float


def frame_count_shares(path: str | os.PathLike) -> list[float]:
    """Share of a raster of counts that is 0, 1, 2, and 3 or more.

    Raises
    ------
    rasterio's error where it is no raster.
    """
    counts = np.zeros(4, np.int64)
    with own_gdal(CACHE), rasterio.open(path) as source:
        for _, window in source.block_windows(1):
            values = np.minimum(source.read(1, window=window), 3)
            counts += np.bincount(values.ravel().astype(np.int64), minlength=4)
    return (counts / counts.sum()).tolist()


def write_marking_report(path: str | os.PathLike, orthophoto: str | os.PathLike, found: MarkingResult,
                         evidence: OrthophotoQuality, remark: str = "") -> None:
    """Write the report.

    Parameters
    ----------
    remark : of whoever ran it, such as the settings of a chain.

    Raises
    ------
    OutputError : it cannot be written.
    """
    report = Report("Road markings from the air")
    judged = marking_verdict(found)
    doubts = [*judged.reasons, *quality_warnings(found, evidence)]
    count = say("{polygons_count} markings were found. ", polygons_count=len(found.polygons))
    if judged.grade == BAD:
        report.verdict(BAD, (count if len(found.polygons) else "") + doubts[0])
    elif doubts:
        report.verdict(LOOK, count + say("To be looked at first: {doubts_count}.", doubts_count=len(doubts)))
    else:
        report.verdict(GOOD, count + say("Nothing stands out; check some markings against the picture all the same."))
    notes = standing_notes(found, evidence)
    if doubts or notes:
        report.section("What to distrust")
    for doubt in doubts:
        report.warning(doubt)
    for note in notes:
        report.paragraph(note)
    _result(report, found)
    _road(report, found)
    _taken(report, found)
    _agreement(report, evidence)
    if len(found.polygons):
        report.section("Figures of the markings")
        report.histogram(found.polygons.width, "width (m)", "Markings by width", upper=1.0)
        report.histogram(found.polygons.contrast, "grey values above the road", "Markings by contrast")
        if np.isfinite(found.polygons.confidence).all():
            report.histogram(found.polygons.confidence, "confidence", "Markings by confidence", upper=1.0)
    _pictures(report, Path(orthophoto), found)
    report.note(remark)
    report.write(path)


def _result(report: Report, found: MarkingResult) -> None:
    markings = found.polygons
    white = markings.colour == "white"
    report.section("Result")
    report.facts({"Markings": len(markings), "of these white": int(white.sum()), "of these yellow": int((~white).sum()),
                  "Marked area (m²)": round(found.marked_area, 1), "Searched area (m²)": round(found.searched_area, 1),
                  "Marked share of it": found.marked_area / found.searched_area if found.searched_area else None,
                  "Pixel (m)": found.pixel,
                  "Median width (m)": float(np.median(markings.width)) if len(markings) else None,
                  "Total length of strokes (m)": round(float(markings.length.sum()), 1)})


def _road(report: Report, found: MarkingResult) -> None:
    """What the image's own road is like, to which all figures are relative."""
    if found.road is None:
        return
    report.section("The image's own road")
    report.paragraph("Smooth grey ground in the light. All brightness, colour and roughness is judged relative to it.")
    report.facts({"Texture (grey values)": round(found.road.texture, 2),
                  "Warmth (share of the brightness)": round(found.road.warmth, 3),
                  "Brightness (grey values)": round(found.road.brightness, 1)})


def _taken(report: Report, found: MarkingResult) -> None:
    """What was taken and rejected, by which the verdict is given."""
    evidence = found.evidence
    if evidence is None or not evidence.narrow:
        return
    report.section("What was taken and rejected")
    report.facts({"Bright and narrow (share of the image)": evidence.narrow / max(evidence.seen, 1),
                  "of these taken for paint": evidence.painted / evidence.narrow})
    if evidence.precision is not None:
        report.facts({"Share of the found area that is paint, by its confidence": evidence.precision,
                      "Share of the paint that was found, by its confidence": evidence.recall})


def quality_warnings(found: MarkingResult, evidence: OrthophotoQuality) -> list[str]:
    """Sentences on what a surveyor should not trust before looking."""
    doubts = []
    unlike = sorted({name for pair in evidence.pairs or () if pair.status == NOT_ALIKE
                     for name in (pair.first, pair.second)})
    if unlike:
        doubts.append(say("{unlike} show different things where they overlap: one of them is wrongly oriented, and "
                          "what it shows lies at wrong places.", unlike=", ".join(unlike)))
    for pair in evidence.pairs or ():
        if pair.status == APART:
            doubts.append(say("{first} and {second} lie {east:.2f} m apart on the road markings: markings in their "
                              "overlap are uncertain by as much. Check the orientation.", first=pair.first,
                              second=pair.second, east=np.hypot(pair.east, pair.north)))
    if evidence.pairs is not None and not evidence.pairs:
        doubts.append(say("No two frames share enough markings to be compared: a wrong orientation would not show."))
    if found.pixel > LIMITS.coarse:
        doubts.append(say("With pixels of {pixel:.2f} m lane lines are narrower than a pixel: many are missed.",
                          pixel=found.pixel))
    alone = evidence.views[1] / max(1 - evidence.views[0], LEAST_DIVISOR) if evidence.views is not None else 0.0
    if alone > LIMITS.one_view:
        doubts.append(say("{alone:.0%} of the ground in the image is seen by one frame only: vehicles stay there, "
                          "and hide markings.", alone=alone))
    return doubts


def standing_notes(found: MarkingResult, evidence: OrthophotoQuality) -> list[str]:
    """Sentences on what may be wrong in any image; they do not make a good result a doubtful one."""
    notes = []
    if not evidence.roads:
        notes.append(say("No roads were given: edges of flat roofs, kerbs, rims of vehicles, reeds at water and "
                         "lines of car parks may be among the markings; cut by their confidence, or give roads."))
    markings = found.polygons
    if len(markings) and (markings.contrast < LIMITS.faint * evidence.contrast).mean() > 0.1:
        notes.append(say("{mean:.0%} of the markings hardly stand out from the road: worn paint, shadow edges or "
                         "paving.", mean=(markings.contrast < LIMITS.faint * evidence.contrast).mean()))
    return notes


def _agreement(report: Report, evidence: OrthophotoQuality) -> None:
    if evidence.views is not None:
        report.section("Coverage")
        names = (mark("no data (buildings, hidden ground, beyond the frames)"), mark("by one frame"), mark("by two"),
                 mark("by three or more"))
        report.facts({name: f"{share:.1%}" for name, share in zip(names, evidence.views)})
    if evidence.pairs is None:
        return
    report.section("Shifts between overlapping frames")
    report.paragraph("The same markings in two frames, the second against the first, median over the places. A good "
                     "block agrees to half a pixel. “height”: without a surface, heights may explain the shift.")
    report.table(("first", "second", "east (m)", "north (m)", "sigma (m)", "places", "status"),
                 [(pair.first, pair.second, pair.east, pair.north, pair.sigma, pair.patches, pair.status)
                  for pair in evidence.pairs])


def _pictures(report: Report, orthophoto: Path, found: MarkingResult) -> None:
    """The whole image, shrunk, and the part with most markings at full size, with their outlines."""
    report.section("Pictures")
    with (own_gdal(CACHE), rasterio.open(orthophoto) as source,
          tempfile.TemporaryDirectory(prefix="urbanmap-") as folder):
        shrink = max(source.width, source.height) / LIMITS.picture_side
        parts = [((0, 0, source.width, source.height), max(shrink, 1.0),
                  say("Markings (green) over the orthophoto. Look for paint without an outline, and outlines on roofs, "
                      "kerbs and vehicles."))]
        if len(found.polygons):
            parts.append((_densest(source, found), 0.5, say("The part with most markings, enlarged")))
        for number, (box, factor, caption) in enumerate(parts):
            picture = Path(folder) / f"{number}.png"
            picture.write_bytes(_drawn(source, orthophoto, box, factor, found))
            report.picture(picture, caption)


def _densest(source: rasterio.DatasetReader, found: MarkingResult) -> tuple[int, int, int, int]:
    """Box of pixels (left, top, width, height) with the largest area of markings."""
    middle = np.concatenate([shapely.get_coordinates(shapely.centroid(batch))
                             for batch in batches(found.polygons.polygons)])
    back = ~source.transform
    column = back.a * middle[:, 0] + back.b * middle[:, 1] + back.c
    row = back.d * middle[:, 0] + back.e * middle[:, 1] + back.f
    across = -(-source.width // LIMITS.detail)
    cell = (row // LIMITS.detail).astype(int) * across + (column // LIMITS.detail).astype(int)
    best = int(np.bincount(np.maximum(cell, 0), weights=found.polygons.area).argmax())
    left, top = best % across * LIMITS.detail, best // across * LIMITS.detail
    return left, top, min(LIMITS.detail, source.width - left), min(LIMITS.detail, source.height - top)


def _drawn(source: rasterio.DatasetReader, path: Path, box: tuple[int, int, int, int], factor: float,
           found: MarkingResult) -> bytes:
    """PNG of a part of the image, `factor` pixels to one, with the outlines of markings."""
    left, top, width, height = box
    shape = max(round(height / factor), 1), max(round(width / factor), 1)
    bands = source.read(colour_bands(source, path), window=rasterio.windows.Window(left, top, width, height),
                        out_shape=(3 if source.count >= 3 else 1, *shape), resampling=Resampling.average)
    seen = bands.astype(np.float32)
    high = np.percentile(seen[seen > 0], 99.5) if (seen > 0).any() else 1.0
    image = np.clip(np.moveaxis(seen, 0, -1) * (255 / max(high, 1e-6)), 0, 255).astype(np.uint8)
    image = np.ascontiguousarray(np.repeat(image, 3, axis=-1) if image.shape[-1] == 1 else image[..., ::-1])
    for batch in batches(found.polygons.polygons):
        _draw(image, batch, ~source.transform, box, factor)
    return cv2.imencode(".png", image)[1].tobytes()


def _draw(image: np.ndarray, polygons: np.ndarray, back: Affine, box: tuple[int, int, int, int],
          factor: float) -> None:
    """Draw the outlines that lie in a part of the image; `back` leads from the CRS to its pixels."""
    left, top, width, height = box
    forward = ~back
    part = [(forward.a * x + forward.b * y + forward.c, forward.d * x + forward.e * y + forward.f)
            for x, y in ((left, top), (left + width, top), (left + width, top + height), (left, top + height))]
    near = shapely.STRtree(polygons).query(shapely.Polygon(part))
    for ring in shapely.get_rings(polygons[np.sort(near)]):
        points = shapely.get_coordinates(ring)[:, :2]
        column = (back.a * points[:, 0] + back.b * points[:, 1] + back.c - left) / factor - 0.5
        row = (back.d * points[:, 0] + back.e * points[:, 1] + back.f - top) / factor - 0.5
        places = np.round(16 * np.column_stack((column, row))).astype(np.int32)
        cv2.polylines(image, [places], True, LIMITS.line_colour, 1, cv2.LINE_AA, shift=4)
