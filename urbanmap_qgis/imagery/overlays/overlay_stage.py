"""Overlays of a survey, models or lines on images: files, and one page that switches between them (Z 4.1)."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...errors import InsufficientDataError, OutputError
from ...io.pages.report import LOOK, Report
from ...io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ...progress import SILENT, Progress
from ...wording import mark, say
from ..views.views import Source
from .edge_lines import EdgeSamples, edge_samples, edge_segments
from .overlay_layers import DrawnEdges, DrawnPoints, nearest_points, visible_edges
from .overlay_pictures import Overlay, PointColours, beside, best_windows, draw, jpeg
from .roof_heights import RoofHeights, roof_heights

NO_POINTS = DrawnPoints(np.empty(0, int), np.empty(0, int), np.empty(0))
DIMENSIONS = {"height": "z", "intensity": "intensity", "class": "classification", "one": "z"}
_TILE = 12_000  # most columns and rows of one file


@dataclass(frozen=True, eq=False)
class OverlayState:
    """The data in one state: images as placed in it, laser points, edges, and what hides."""

    name: str
    sources: Sequence[Source]
    cloud: PointCloud | None
    samples: EdgeSamples
    roofs: RoofHeights


@dataclass(frozen=True)
class OverlayRecord:
    """What became of one image: its name, points and metres of edges (pixels long) drawn in each state."""

    image: str
    points: tuple[int, ...]
    edges: tuple[float, ...]

    @property
    def empty(self) -> bool:
        """Whether nothing was drawn in any state."""
        return not any(self.points) and not any(self.edges)


def overlays(state: OverlayState, kind: str, max_range: float, progress: Progress = SILENT) -> list[Overlay]:
    """What is drawn over each image of a state; points are read once."""
    points = [NO_POINTS] * len(state.sources)
    if state.cloud is not None:
        chunks = _chunks(state.cloud, DIMENSIONS[kind], progress)
        points = nearest_points(state.sources, chunks, max_range, state.roofs)
    return [Overlay(drawn, visible_edges(source, state.samples, max_range, state.roofs))
            for source, drawn in zip(state.sources, points)]


def _chunks(cloud: PointCloud, dimension: str, progress: Progress) -> Iterable[tuple[np.ndarray, np.ndarray]]:
    """Points (n, 3) and the values (n,) that colour them."""
    for chunk in iter_chunks(cloud, progress):
        keep = valid_points(chunk)
        place = np.column_stack([np.asarray(chunk[axis])[keep] for axis in "xyz"])
        yield place, place[:, 2] if dimension == "z" else np.asarray(chunk[dimension])[keep].astype(np.float32)


def point_colours(kind: str, drawn: Iterable[Overlay]) -> PointColours:
    """Colours of a kind over the values drawn, from the 2nd to the 98th percentile, the same for all images."""
    values = np.concatenate([overlay.points.value for overlay in drawn] or [np.empty(0)])
    if kind in ("class", "one") or not len(values):
        return PointColours(kind)
    return PointColours(kind, *np.percentile(values, (2.0, 98.0)).tolist())


def edge_state(name: str, sources: Sequence[Source], geometries: Sequence,
               cloud: PointCloud | None = None) -> OverlayState:
    """A state whose edges are those of models or lines (shapely geometries with heights).

    Raises
    ------
    InputError : none of the geometries has heights.
    """
    return OverlayState(name, sources, cloud, edge_samples(edge_segments(geometries)), roof_heights(geometries))


def write_overlays(states: Sequence[OverlayState], folder: str | os.PathLike, page: str | os.PathLike | None, kind: str,
                   max_range: float, pictures: int, progress: Progress = SILENT) -> list[OverlayRecord]:
    """Draw all states over all images; write images into `folder` and the page.

    Parameters
    ----------
    states : one, or before and after.
    kind : "height", "intensity", "class" or "one".
    pictures : windows on the page.

    Raises
    ------
    InsufficientDataError : no point and no edge lies in any image.
    OutputError : the folder cannot be written.
    """
    share = 0.6 / len(states)
    drawn = [overlays(state, kind, max_range, progress.part(number * share, (number + 1) * share))
             for number, state in enumerate(states)]
    colours = point_colours(kind, [overlay for one in drawn for overlay in one])
    images = states[-1].sources
    records = [_record(source, [one[number] for one in drawn]) for number, source in enumerate(images)]
    if all(record.empty for record in records):
        raise InsufficientDataError(say("Nothing lies in any of the images: check that images, trajectory, points "
                                        "and lines are of one place, in one coordinate system, and heights in metres."))
    target = Path(folder)
    try:
        target.mkdir(parents=True, exist_ok=True)
        for number, source in enumerate(images):
            progress.step(0.6 + 0.3 * number / len(records))
            for state, one in zip(states, drawn):
                _write_whole(source, one[number], colours, target, state.name, progress.check)
    except OSError as error:
        raise OutputError(say("{target} cannot be written ({strerror}): choose another folder.", target=target,
                              strerror=error.strerror)) from error
    if page is not None:
        _write_page(page, states, drawn, records, colours, pictures, target)
    return records


def _record(source: Source, drawn: Sequence[Overlay]) -> OverlayRecord:
    return OverlayRecord(source.name, tuple(len(item.points) for item in drawn),
                         tuple(float(_length(item.edges)) for item in drawn))


def _length(edges: DrawnEdges) -> float:
    """Pixels of edges drawn."""
    return np.linalg.norm(edges.end - edges.start, axis=1).sum()


def _write_whole(source: Source, overlay: Overlay, colours: PointColours, folder: Path, state: str,
                 check: Callable[[], None]) -> None:
    """The whole image with its overlay, as one file or, where it is very large, as several."""
    columns, rows = source.size()
    places = [(left, top) for top in range(0, rows, _TILE) for left in range(0, columns, _TILE)]
    for number, (left, top) in enumerate(places, 1):
        check()
        right, bottom = min(left + _TILE, columns), min(top + _TILE, rows)
        part = f"_{number}" if len(places) > 1 else ""
        pixels = draw(source.window(left, top, right, bottom), overlay, colours, left, top)
        (folder / f"{Path(source.name).stem}_{state}{part}.jpg").write_bytes(jpeg(pixels))


def add_overlays(report: Report, states: Sequence[OverlayState], max_range: float, pictures: int,
                 progress: Progress = SILENT) -> None:
    """Add windows of images that switch between the states of edges to another stage's report."""
    drawn = [overlays(state, "one", max_range, progress) for state in states]
    records = [_record(source, [one[number] for one in drawn]) for number, source in enumerate(states[-1].sources)]
    report.section("Edges over images, before and after")
    if all(record.empty for record in records):
        report.warning("No edge lies in any of the images: they are of another place.")
    _add_pictures(report, states, drawn, records, PointColours("one"), pictures, None)


def _write_page(page: str | os.PathLike, states: Sequence[OverlayState], drawn: Sequence[Sequence[Overlay]],
                records: Sequence[OverlayRecord], colours: PointColours, pictures: int, folder: Path) -> None:
    """The page: a switch between the states, the fullest windows, and what was drawn where."""
    report = Report("Overlay on images")
    nothing = [record.image for record in records if record.empty]
    text = (say("Edges should run along what the images show, and points lie on what they were measured from; where "
                "they do not, survey, orientation or models are off."))
    if nothing:
        text += say(" Nothing lies in {nothing_count} of {records_count} images.", nothing_count=len(nothing),
                    records_count=len(records))
    report.verdict(LOOK, text)  # nothing is measured here: the reader judges
    _add_pictures(report, states, drawn, records, colours, pictures, folder)
    report.section("Images")
    names = [state.name for state in states]
    report.table((mark("image"), *(say("points, {state}", state=name) for name in names),
                  *(say("edges, {state} (pixels)", state=name) for name in names)),
                 [(record.image, *record.points, *(round(length) for length in record.edges)) for record in records])
    report.write(page)


def _add_pictures(report: Report, states: Sequence[OverlayState], drawn: Sequence[Sequence[Overlay]],
                  records: Sequence[OverlayRecord], colours: PointColours, pictures: int, folder: Path | None) -> None:
    """Add the windows in which most is drawn, at most so many pictures."""
    names = [state.name for state in states]
    each = max(pictures // max(sum(not record.empty for record in records), 1), 1)
    for number, source in enumerate(states[-1].sources):
        for window in best_windows(source, drawn[-1][number], each):
            _add_window(report, source, window, names, [one[number] for one in drawn], colours, folder)


def _add_window(report: Report, source: Source, window: tuple[int, int, int, int], names: Sequence[str],
                drawn: Sequence[Overlay], colours: PointColours, folder: Path | None) -> None:
    """Add a window of an image that switches between the plain image and each state; two also as one file."""
    left, top, right, bottom = window
    plain = source.window(*window)
    panels = [draw(plain, overlay, colours, left, top) for overlay in drawn]
    if len(panels) == 2 and folder is not None:
        name = f"{Path(source.name).stem}_{left}_{top}_{'_'.join(names)}.jpg"
        (folder / name).write_bytes(jpeg(beside(*panels)))
    report.switcher([(say("image"), jpeg(plain)), *((name, jpeg(panel)) for name, panel in zip(names, panels))],
                    say("{source}, columns {left} to {right}, rows {top} to {bottom}", source=source.name, left=left,
                        right=right, top=top, bottom=bottom))
