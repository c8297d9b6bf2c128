"""Tables of text: each of the project's readers is tried on a sample of rows, until one takes it.

So a table counts as what it is read as later, with all the spellings of columns, delimiters and encodings that its
reader knows.
"""

from __future__ import annotations

import csv
import itertools
import re
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from ...aerial.frames.exterior_files import read_exterior
from ...aerial.orientation.cloud_points import read_cloud_points
from ...aerial.orientation.image_points import read_image_points
from ...errors import InputError, PreviewNeeded, UrbanMapError
from ...io.files.guard import read_text
from ...io.files.named_table import WRITTEN_NUMBER, plain_name
from ...mobile.control import read_control
from ...mobile.image_poses import read_image_poses
from ...mobile.lines.range_scans import read_scans
from ...mobile.lines.tie_points import read_tie_points
from ...mobile.trajectory_files import read_trajectory
from ...wording import say
from ..file_facts import (
    CLOUD_CONTROL,
    CONTROL,
    EXTERIOR,
    FRAME_CONTROL,
    IMAGE_POSES,
    IMAGE_TIMES,
    OTHER,
    SCANS,
    TABLE,
    TEXT_POINTS,
    TIE_POINTS,
    TRAJECTORY,
    FileFacts,
)
from ..table_guess import guessed_target, missing_columns

WHOLE_BYTES = 4_000_000
"""Tables up to this size are read whole; of longer ones rows from all over them."""

_BLOCKS, _BLOCK_BYTES = 64, 4096
_MOST_HEAD = 60
_SIGNATURES = {
    TRAJECTORY: {"time", "x", "y", "z", "roll", "pitch", "heading"},
    IMAGE_POSES: {"id", "time", "x", "y", "z", "roll", "pitch", "heading"},
    CONTROL: {"id", "x", "y", "time", "xmms", "ymms"}, TIE_POINTS: {"set", "time", "xmms", "ymms", "xref", "yref"},
    FRAME_CONTROL: {"point", "image", "column", "row"}, CLOUD_CONTROL: {"id", "x", "y", "z", "role"},
    EXTERIOR: {"image", "x", "y", "z", "omega", "phi", "kappa"}, SCANS: {"time", "angle", "range"}}
"""Columns by which a table that its reader refuses is told all the same."""

_DEGREES = re.compile(b"(?i)latitude|" + b"|".join(re.escape(word.encode(code)) for word in ("緯度", "北緯")
                                                   for code in ("utf-8", "cp932")))
_KIND_OF_TARGET = {"trajectory": TRAJECTORY, "exterior": EXTERIOR, "poses": IMAGE_POSES, "control": CONTROL,
                   "als_control": CLOUD_CONTROL, "frame_control": FRAME_CONTROL, "ties": TIE_POINTS}


def _pose_facts(path: Path, sample: Path) -> FileFacts:
    poses = read_image_poses(sample)
    return FileFacts(path, IMAGE_POSES, extent=_box(poses.place), times=_span(poses.time), count=len(poses.id))


def _trajectory_facts(path: Path, sample: Path) -> FileFacts:
    file = read_trajectory(sample)
    found = file.trajectory
    notes = file.notes if sample == path else ()  # gaps of a sample are no gaps of the trajectory
    return FileFacts(path, TRAJECTORY, extent=_box(found.place), times=_span(found.time), notes=notes,
                     detail=file.applied, count=len(found) if sample == path else None)


def _control_facts(path: Path, sample: Path) -> FileFacts:
    points = read_control(sample)
    return FileFacts(path, CONTROL, extent=_box(points.true), times=_span(points.time), count=len(points))


def _tie_facts(path: Path, sample: Path) -> FileFacts:
    ties = read_tie_points(sample)
    return FileFacts(path, TIE_POINTS, extent=_box(ties.reference), times=_span(ties.time), count=len(ties))


def _exterior_facts(path: Path, sample: Path) -> FileFacts:
    poses = read_exterior(sample)
    return FileFacts(path, EXTERIOR, extent=_box(np.array([pose.centre for pose in poses])), count=len(poses))


def _frame_control_facts(path: Path, sample: Path) -> FileFacts:
    points = read_image_points(sample)
    known = points.place[points.known]
    return FileFacts(path, FRAME_CONTROL, extent=_box(known) if len(known) else None, count=len(points.points))


def _cloud_control_facts(path: Path, sample: Path) -> FileFacts:
    """Such a table says that it is one by places in the cloud or by roles: a list of places alone may be anything."""
    points = read_cloud_points(sample)
    if not (np.isfinite(points.found).any() or _names_in(sample.read_bytes()) & {"role", "use", "役割", "区分"}):
        raise InputError(say("{name} says of no point where it lies in a cloud or what its role is.", name=path.name))
    return FileFacts(path, CLOUD_CONTROL, extent=_box(points.true), count=len(points))


def _scan_facts(path: Path, sample: Path) -> FileFacts:
    chunks = [chunk.time for chunk in itertools.islice(read_scans([sample]), 1)]
    times = np.concatenate(chunks)
    return FileFacts(path, SCANS, times=_span(times) if sample == path else None)


_TRIED: tuple[tuple[str, Callable[[Path, Path], FileFacts]], ...] = (
    (IMAGE_POSES, _pose_facts), (TRAJECTORY, _trajectory_facts), (CONTROL, _control_facts), (TIE_POINTS, _tie_facts),
    (EXTERIOR, _exterior_facts), (SCANS, _scan_facts), (FRAME_CONTROL, _frame_control_facts),
    (CLOUD_CONTROL, _cloud_control_facts))


def table_facts(path: Path, head: bytes) -> list[FileFacts]:
    """What a text file is; `head`: its first bytes.

    Raises
    ------
    InputError : a table of a known kind that its reader refuses.
    """
    if b"\0" in head and not head.startswith((b"\xff\xfe", b"\xfe\xff")):
        return [FileFacts(path, OTHER)]
    with tempfile.TemporaryDirectory() as folder:
        sample = _sample(path, head, Path(folder))
        refusals, previewed = {}, ""
        for kind, facts in _TRIED:
            try:
                return [facts(path, sample)]
            except UrbanMapError as error:
                refusals[kind] = str(error)
                previewed = previewed or (str(error) if isinstance(error, PreviewNeeded) else "")
        if previewed:
            return [_to_preview(path, sample, previewed)]
        names = _names_in(head)
        near = [kind for kind, signature in _SIGNATURES.items() if signature <= names]
        if near:
            best = max(near, key=lambda kind: len(_SIGNATURES[kind]))
            return [FileFacts(path, best, problem=refusals[best])]
        if _DEGREES.search(head):
            return [_in_degrees(path, sample, names)]
        return [_other_table(path, sample, names)]


def _in_degrees(path: Path, sample: Path, names: set[str]) -> FileFacts:
    """A table below a head that may have its places in latitude and longitude, as navigation programs write it."""
    how = guessed_target(sample)
    if not how.polar or missing_columns(how):
        return _other_table(path, sample, names)
    return _to_preview(path, sample, say("{name} has its places in latitude and longitude: read it by “Import table…” "
                                         "in the menu UrbanMap, which lays them into the plane reference system of "
                                         "the survey.", name=path.name))


def _to_preview(path: Path, sample: Path, sentence: str) -> FileFacts:
    """A table that only its user can tell how to read, with the sentence that says so."""
    how = guessed_target(sample)
    if missing_columns(how):
        return FileFacts(path, TABLE)
    if how.target == "als_control" and not {"role", "x_als"} & set(how.columns):  # a list of places may be anything
        return FileFacts(path, TABLE, notes=(sentence,))
    return FileFacts(path, _KIND_OF_TARGET[how.target], problem=sentence)


def _sample(path: Path, head: bytes, folder: Path) -> Path:
    """The file itself where it is short, else a file with rows from all over it."""
    size = path.stat().st_size
    if size <= WHOLE_BYTES:
        return path
    place = folder / path.name
    with path.open("rb") as stream, place.open("wb") as sample:
        sample.write(head[:head.rfind(b"\n") + 1])
        for share in np.linspace(0.0, 1.0, _BLOCKS)[1:]:
            stream.seek(max(int(share * (size - _BLOCK_BYTES)), len(head)))
            block = stream.read(_BLOCK_BYTES)
            sample.write(block[block.find(b"\n") + 1:block.rfind(b"\n") + 1])
    return place


def _names_in(head: bytes) -> set[str]:
    """Plain names in the line with the most words among the first ones."""
    text = head.decode("utf-8-sig", "replace")
    lines = [re.split(r"[,;\t ]+", line.strip()) for line in text.splitlines()[:_MOST_HEAD]]
    named = [{plain_name(word).replace("_", "") for word in line} for line in lines
             if line and not any(WRITTEN_NUMBER.match(word) for word in line)]
    return max(named, key=len, default=set())


def _other_table(path: Path, sample: Path, names: set[str]) -> FileFacts:
    """Points as text, a table of times of a line image, or another table."""
    lines = [line for line in read_text(sample, "a text").splitlines() if line.strip() and not line.startswith("#")]
    if {"column", "time"} <= names and len(names) == 2:
        rows = np.array(list(csv.reader(lines[1:])), float)
        return FileFacts(path, IMAGE_TIMES, times=_span(rows[:, 1]), count=len(rows))
    delimiter = next((mark for mark in ",;\t" if all(mark in line for line in lines[1:6])), None)
    cells = [[cell.strip() for cell in line.split(delimiter)] for line in lines]
    numbers = [row for row in cells[1:] if len(row) >= 3 and all(WRITTEN_NUMBER.match(cell) for cell in row[:3])]
    named = not names or {"x", "y", "z"} <= names
    places = np.array([row[:3] for row in numbers], float).reshape(-1, 3)
    # A column that always rises counts something, such as time.
    in_time = len(places) > 2 and bool((np.diff(places, axis=0) > 0).all(axis=0).any())
    if len(cells) > 10 and named and not in_time and len(numbers) >= 0.99 * (len(cells) - 1):
        return FileFacts(path, TEXT_POINTS, extent=_box(places), count=len(numbers) if sample == path else None,
                         doubt=say("told by its rows of three numbers or more"),
                         notes=(say("{name} holds points as text: convert them to LAS or LAZ to use them.",
                                    name=path.name),))
    widths = [len(row) for row in cells[:_MOST_HEAD]]
    alike = widths.count(max(set(widths), key=widths.count)) >= 0.9 * len(widths) if widths else False
    with_numbers = [row for row in cells[1:_MOST_HEAD] if any(WRITTEN_NUMBER.match(cell) for cell in row)]
    counted = len(with_numbers) > 0.5 * len(widths) - 1
    return FileFacts(path, TABLE if delimiter and alike and counted and len(cells) > 1 else OTHER)


def parquet_facts(path: Path, _head: bytes) -> list[FileFacts]:
    """A Parquet file: line scans where the package that reads it is there and says so, else a table."""
    try:
        first = next(iter(read_scans([path])))
    except InputError:
        return [FileFacts(path, TABLE, detail="Parquet")]
    return [FileFacts(path, SCANS, times=_span(first.time))]


def _box(places: np.ndarray) -> tuple[float, float, float, float]:
    (x_min, y_min), (x_max, y_max) = places[:, :2].min(axis=0), places[:, :2].max(axis=0)
    return float(x_min), float(y_min), float(x_max), float(y_max)


def _span(times: np.ndarray) -> tuple[float, float]:
    return float(np.min(times)), float(np.max(times))
