"""What does not fit together among recognised files: systems, heights, places, times, and frames with their tables."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

import numpy as np
from pyproj import Transformer
from pyproj.exceptions import ProjError

from ..aerial.frames.camera import read_camera
from ..aerial.frames.exterior_files import read_exterior
from ..errors import InputError, UrbanMapError
from ..geometry.earth import METRES_A_DEGREE
from ..io.reference.height_systems import refuse_other_heights
from ..io.reference.system_names import local_name
from ..io.reference.system_parts import is_geographic, parsed_crs, plan_part, same_horizontal
from ..mobile.gps_time import shift_between
from ..wording import say
from .file_facts import (
    CAMERA,
    EXTERIOR,
    FRAME,
    NAVIGATION,
    OBSERVATIONS,
    ORBITS,
    POINTS,
    TRAJECTORY,
    FileFacts,
    kind_name,
)

_AROUND = 500.0 / METRES_A_DEGREE
"""Degrees of latitude (about 500 m) by which places may lie apart and still count as one."""
_EPHEMERIS_LASTS = 4 * 3600.0
"""s: a broadcast ephemeris is used so long before and after its time."""
_NAMED = 3
Extent = tuple[float, float, float, float]


def disagreements(facts: Sequence[FileFacts]) -> list[str]:
    """A sentence for each thing that does not fit together; an empty list where all fits, as far as it is known."""
    sound = [item for item in facts if item.usable]
    return [*_systems(sound), *_heights(sound), *_places(sound), *_times(sound), *_frames(sound)]


def _systems(facts: Sequence[FileFacts]) -> Iterator[str]:
    """Projected systems that differ."""
    groups: list[list[FileFacts]] = []
    for item in facts:
        if not item.crs_wkt or is_geographic(item.crs_wkt):
            continue
        home = next((group for group in groups if same_horizontal(group[0].crs_wkt, item.crs_wkt)), None)
        groups.append([item]) if home is None else home.append(item)
    groups.sort(key=len, reverse=True)
    for other in groups[1:]:
        yield say("{names} is in {crs}, but {others} in {crs_2}: results are in the system of the points; check that "
                  "both are right.", names=_some(other), crs=system_name(other[0].crs_wkt), others=_some(groups[0]),
                  crs_2=system_name(groups[0][0].crs_wkt))


def system_name(wkt: str) -> str:
    """A system's code and name in short, "" for none."""
    if not wkt:
        return ""
    plan = plan_part(parsed_crs(wkt))
    code, name = plan.to_epsg(min_confidence=70), local_name(plan.name)
    return f"EPSG:{code} {name}" if code else name


def _some(facts: Sequence[FileFacts]) -> str:
    names = ", ".join(item.label for item in facts[:_NAMED])
    return names if len(facts) <= _NAMED else say("{names} and {count} more", names=names, count=len(facts) - _NAMED)


def _heights(facts: Sequence[FileFacts]) -> Iterator[str]:
    """Height systems that are stated and differ; GNSS files aside, which are ellipsoidal always."""
    stated: dict[str, FileFacts] = {}
    for item in facts:
        if item.heights != "unknown" and item.kind not in (OBSERVATIONS, NAVIGATION, ORBITS):
            stated.setdefault(item.heights, item)
    for one, other in itertools.combinations(stated.values(), 2):
        try:
            refuse_other_heights(one.label, one.crs_wkt, other.label, other.crs_wkt)
        except InputError as error:
            yield str(error)
            continue
        yield say("{one} has heights in {first}, but {other} in {second}: convert one of them with “Convert heights”, "
                  "or give a geoid model.", one=one.label, first=one.heights, other=other.label, second=other.heights)


def extent_in_degrees(item: FileFacts, assumed: str = "") -> Extent | None:
    """West, south, east, north of a file; `assumed` (WKT) is the system of those that state none."""
    wkt = item.crs_wkt or assumed
    if item.extent is None or not wkt:
        return None
    x_min, y_min, x_max, y_max = item.extent
    try:
        plan = plan_part(parsed_crs(wkt))
        if plan.is_geographic:
            return item.extent if abs(y_max) <= 90.0 and abs(x_max) <= 360.0 else None
        x = np.array([x_min, x_min, x_max, x_max])
        y = np.array([y_min, y_max, y_min, y_max])
        east, north = Transformer.from_crs(plan, plan.geodetic_crs, always_xy=True).transform(x, y)
    except ProjError:
        return None
    if not np.isfinite([east, north]).all():
        return None
    return float(east.min()), float(north.min()), float(east.max()), float(north.max())


def clouds_met(item: FileFacts, clouds: Sequence[FileFacts], assumed: str = "") -> int:
    """Number of point clouds that share half of the smaller box, theirs or the item's; -1 for none, 0 if not known."""
    mine = extent_in_degrees(item, assumed)
    theirs = [extent for cloud in clouds if (extent := extent_in_degrees(cloud, assumed)) is not None]
    if mine is None or not theirs:
        return 0
    boxes = np.array([mine, *theirs])
    sides = np.maximum(boxes[:, 2:] - boxes[:, :2], 1e-9)
    common = np.minimum(boxes[1:, 2:], boxes[0, 2:]) - np.maximum(boxes[1:, :2], boxes[0, :2])
    shares = np.maximum(common, 0.0).prod(axis=1) / np.minimum(sides[1:].prod(axis=1), sides[0].prod())
    return int((shares >= 0.5).sum()) or -1


def common_system(facts: Sequence[FileFacts]) -> str:
    """The projected system (WKT) that most files state, taken for those that state none; "" where none does."""
    stated = [item.crs_wkt for item in facts if item.usable and item.crs_wkt and not is_geographic(item.crs_wkt)]
    clouds = [item.crs_wkt for item in facts if item.usable and item.kind == POINTS and item.crs_wkt]
    return max(clouds or stated, key=(clouds or stated).count, default="")


def _places(facts: Sequence[FileFacts]) -> Iterator[str]:
    """Files that lie apart from the place where most are."""
    assumed = common_system(facts)
    placed = [(item, extent) for item in facts if (extent := extent_in_degrees(item, assumed)) is not None]
    groups: list[list[tuple[FileFacts, Extent]]] = []
    for entry in placed:
        near = [group for group in groups if any(_meet(entry[1], other[1]) for other in group)]
        merged = [entry, *itertools.chain.from_iterable(near)]
        groups = [merged, *(group for group in groups if group not in near)]
    groups.sort(key=len, reverse=True)
    for group in groups[1:]:
        yield say("{names}: not where the other files are ({distance} away): check coordinates and reference system.",
                  names=_some([item for item, _ in group][::-1]), distance=_distance(group, groups[0]))


def _meet(one: Extent, other: Extent) -> bool:
    wide = _AROUND / max(np.cos(np.radians(one[1])), 0.1)
    return (one[0] - wide <= other[2] and other[0] - wide <= one[2] and one[1] - _AROUND <= other[3]
            and other[1] - _AROUND <= one[3])


def _distance(group: Sequence[tuple[FileFacts, Extent]], home: Sequence[tuple[FileFacts, Extent]]) -> str:
    """Distance between the nearest boxes of two groups, in words."""
    def gap(one: Extent, other: Extent) -> float:
        east = max(one[0] - other[2], other[0] - one[2], 0.0) * np.cos(np.radians(one[1]))
        return float(np.hypot(east, max(one[1] - other[3], other[1] - one[3], 0.0))) * METRES_A_DEGREE

    metres = min(gap(one, other) for _, one in group for _, other in home)
    return f"{metres:.0f} m" if metres < 2000 else f"{metres / 1000:.0f} km"


def times_overlap(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """Whether half of the first span lies in the second, however weeks and standard time are counted."""
    try:
        shift_between(one, other, "")
    except InputError:
        return False
    return True


def _times(facts: Sequence[FileFacts]) -> Iterator[str]:
    drives = [item for item in facts if item.kind == TRAJECTORY and item.times]
    for item in facts:
        if item.kind == OBSERVATIONS and item.times:
            yield from _observed(item, facts)
    clouds = [item for item in facts if item.kind == POINTS and item.times]
    if drives and clouds and not any(times_overlap(cloud.times, drive.times) for cloud in clouds for drive in drives):
        yield say("No point cloud was measured in the times of the trajectories ({trajectories}): give those of one "
                  "survey.", trajectories=_some(drives))
    elif clouds:
        measured = [item for item in facts if item.times and item.kind not in (TRAJECTORY, NAVIGATION, ORBITS)]
        idle = [drive for drive in drives if not any(times_overlap(item.times, drive.times) for item in measured)]
        if idle:
            yield say("{names}: nothing else was measured in these times; not used. Check whether it is of "
                      "another day.",
                      names=_some(idle))


def _observed(item: FileFacts, facts: Sequence[FileFacts]) -> Iterator[str]:
    spans = [other.times for other in facts if other.kind in (NAVIGATION, ORBITS) and other.times]
    first, last = item.times
    if spans and not any(start - _EPHEMERIS_LASTS <= first and last <= end + _EPHEMERIS_LASTS for start, end in spans):
        yield say("{name} was observed at other times than the navigation files hold: fetch the navigation file of its "
                  "day.", name=item.label)


def _frames(facts: Sequence[FileFacts]) -> Iterator[str]:
    """Frames without a pose, poses without a frame, frames of another size than the camera."""
    frames = {item.path.name: item for item in facts if item.kind == FRAME}
    if not frames:
        return
    named: set[str] = set()
    for table in (item for item in facts if item.kind == EXTERIOR):
        try:
            named |= {pose.image for pose in read_exterior(table.path)}
        except UrbanMapError:  # its own problem says so
            continue
    stems = {name.rpartition(".")[0] or name for name in named}
    without = [item for name, item in frames.items() if named and name not in named and item.path.stem not in stems]
    if without and len(without) < len(frames):
        yield say("{names}: not named in the exterior orientation; left out.", names=_some(without))
    elif without:
        yield say("The exterior orientation names none of the {kind} ({names}): give the one of this flight.",
                  kind=kind_name(FRAME), names=_some(without))
    sizes = {f"{camera.width} x {camera.height}" for camera in
             (read_camera(item.path) for item in facts if item.kind == CAMERA)}
    other = [item for item in frames.values() if sizes and not item.detail.startswith(tuple(sizes))]
    if other and len(other) == len(frames):
        yield say("{names} has {size}, the camera {sizes}: give the camera of these frames.", names=_some(other),
                  size=other[0].detail, sizes=", ".join(sorted(sizes)))
