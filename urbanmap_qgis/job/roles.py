"""Which file plays which part in a job: airborne points, outlines, frames, each survey with what belongs to it."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from ..io.reference.system_parts import is_geographic
from ..wording import known, mark, say
from .agreement import clouds_met, common_system, times_overlap
from .file_facts import (
    AREAS,
    BUILDING_MODELS,
    CALIBRATION,
    CAMERA,
    CLOUD_CONTROL,
    CONTROL,
    ELEVATION,
    EXTERIOR,
    FRAME,
    FRAME_CONTROL,
    GSI_DEM,
    GSI_OUTLINES,
    IMAGE_POSES,
    LINES,
    MARKING_MASK,
    MARKINGS,
    NAVIGATION,
    OBSERVATIONS,
    ORTHOPHOTO,
    OUTLINES,
    POINTS,
    RASTER,
    ROADS,
    ROOFS,
    TABLE,
    TEXT_POINTS,
    TRAJECTORY,
    FileFacts,
    kind_name,
)

ALS, FOOTPRINTS, GSI_FOOTPRINTS, FRAMES = "als", "footprints", "gsi_footprints", "frames"
CAMERA_ROLE, EXTERIOR_ROLE, ORTHOPHOTO_ROLE = "camera", "exterior", "orthophoto"
MASK, MARKING_POLYGONS, GROUND, GSI_GROUND = "marking_mask", "markings", "ground", "gsi_ground"
NAVIGATION_ROLE, OBSERVATIONS_ROLE, SURVEY, ROADS_ROLE = "navigation", "observations", "survey", "roads"
CLOUD_CONTROL_ROLE, FRAME_CONTROL_ROLE = "als_control", "frame_control"

_SINGLE = ((FOOTPRINTS, OUTLINES), (GSI_FOOTPRINTS, GSI_OUTLINES), (CAMERA_ROLE, CAMERA), (EXTERIOR_ROLE, EXTERIOR),
           (ORTHOPHOTO_ROLE, ORTHOPHOTO), (MASK, MARKING_MASK), (MARKING_POLYGONS, MARKINGS), (GROUND, ELEVATION),
           (GSI_GROUND, GSI_DEM), (ROADS_ROLE, ROADS), (CLOUD_CONTROL_ROLE, CLOUD_CONTROL),
           (FRAME_CONTROL_ROLE, FRAME_CONTROL))
_SEVERAL = ((FRAMES, FRAME), (NAVIGATION_ROLE, NAVIGATION), (OBSERVATIONS_ROLE, OBSERVATIONS))

USES = {
    ALS: mark("Airborne laser points"), SURVEY: mark("Mobile survey"), FOOTPRINTS: mark("Building outlines"),
    GSI_FOOTPRINTS: mark("Building outlines (GSI)"), FRAMES: mark("Aerial frames"), CAMERA_ROLE: mark("Camera"),
    EXTERIOR_ROLE: mark("Exterior orientation"), ORTHOPHOTO_ROLE: mark("Orthophoto"), MASK: mark("Marking mask"),
    MARKING_POLYGONS: mark("Road markings"), GROUND: mark("Ground elevation"),
    GSI_GROUND: mark("Elevation model (GSI)"), NAVIGATION_ROLE: mark("GNSS navigation"),
    OBSERVATIONS_ROLE: mark("GNSS observations"), "trajectory": mark("Trajectory"), "poses": mark("Image poses"),
    "calibration": mark("Calibration"), "control": mark("Control points"),
    ROADS_ROLE: mark("Road edges or surfaces"), CLOUD_CONTROL_ROLE: mark("Control points of the airborne points"),
    FRAME_CONTROL_ROLE: mark("Control points of the frames")}
"""What a file can be used as, with its English name; of a survey's files without its number."""

_KIND_OF_USE = {ALS: POINTS, SURVEY: POINTS, "trajectory": TRAJECTORY, "poses": IMAGE_POSES,
                "calibration": CALIBRATION, "control": CONTROL,
                **dict((*_SINGLE, *_SEVERAL))}
_PLANES = (FOOTPRINTS, MARKING_POLYGONS, ROADS_ROLE)
_IMAGES = (ORTHOPHOTO_ROLE, FRAMES, MASK, GROUND)
_FITTING = {POINTS: (ALS, SURVEY), **dict.fromkeys((OUTLINES, MARKINGS, AREAS, ROOFS, BUILDING_MODELS), _PLANES),
            **dict.fromkeys((ORTHOPHOTO, FRAME, MARKING_MASK, ELEVATION, RASTER), _IMAGES),
            **dict.fromkeys((LINES, ROADS), (ROADS_ROLE,)),
            **dict.fromkeys((TABLE, TEXT_POINTS), (CLOUD_CONTROL_ROLE,)),
            TRAJECTORY: ("trajectory", "poses"), IMAGE_POSES: ("poses", "trajectory")}
"""Uses that a file of a kind can be put to; of other kinds only their own."""

_RIVALS = ((GSI_FOOTPRINTS, FOOTPRINTS), (ORTHOPHOTO_ROLE, FRAMES), (GSI_GROUND, GROUND))
"""Parts of which the second is taken where both are there, unless the user names the first."""

_TRUTH = {"truth", "ground_truth", "groundtruth"}
"""Folders of what results are checked against: only control points are taken from them."""


@dataclass(frozen=True)
class Parts:
    """The parts of a job.

    Attributes
    ----------
    inputs : sources (paths, with the layer where there are several) by role. A survey's roles end in its number:
        survey_1, trajectory_1, calibration_1, poses_1, control_1.
    surveys : numbers of the surveys.
    notes : sentences on what was taken of several point clouds and trajectories.
    choices : a sentence by role where the first of several other files was taken.
    unplaced : roles of point clouds of which one states no reference system.
    in_degrees : roles of outlines and markings that count in degrees, which chains do not take.
    """

    inputs: Mapping[str, tuple[str, ...]]
    surveys: tuple[int, ...] = ()
    notes: tuple[str, ...] = field(default_factory=tuple)
    unplaced: frozenset[str] = frozenset()
    in_degrees: frozenset[str] = frozenset()
    choices: Mapping[str, str] = field(default_factory=dict)


def uses_of(item: FileFacts) -> tuple[str, ...]:
    """What a file can be used as, keys of `USES`; () where it is of no use, or damaged."""
    if item.problem:
        return ()
    uses = tuple(use for use, kind in _KIND_OF_USE.items() if kind == item.kind)
    return _FITTING.get(item.kind, uses)


def use_name(role: str) -> str:
    """Name of a part in the user's language, with the number of its survey where it has one."""
    word, _, number = role.rpartition("_")
    if role in USES or not number.isdigit():
        return known(USES[role]) if role in USES else role
    return f"{known(USES.get(word, word))} {number}"


def put_to_use(facts: Sequence[FileFacts], used_as: Mapping[str, str]) -> list[FileFacts]:
    """The files as the user says that they are used; what does not fit a file (any more) is left as recognised.

    Parameters
    ----------
    used_as : keys of `USES` by source.
    """
    used = []
    for item in facts:
        use = used_as.get(item.source, "")
        if use in uses_of(item):
            item = replace(item, kind=_KIND_OF_USE[use], use=use, doubt="")
        used.append(item)
    return used


def parts_of(facts: Sequence[FileFacts]) -> Parts:
    """The parts that recognised files play; what the user says that a file is used as goes before all else."""
    sound = [item for item in facts if item.usable and (item.use or item.kind == CONTROL or not _is_truth(item))]
    sound.sort(key=lambda item: not item.use)
    inputs: dict[str, tuple[str, ...]] = {}
    notes, choices = [], {}
    clouds, twins = _without_twins([item for item in sound if item.kind == POINTS])
    notes += twins
    surveys = _surveys(clouds, sound, inputs, notes)
    driven = {source for role, sources in inputs.items() if role.startswith("survey_") for source in sources}
    flown = tuple(item.source for item in clouds if item.source not in driven and item.use != SURVEY)
    if flown:
        inputs[ALS] = flown
    frames, assumed = [item for item in sound if item.kind == FRAME], common_system(sound)
    some = clouds[::len(clouds) // 100 + 1]  # a thousand tiles would hold the window up for a second
    for role, kind in _SINGLE:
        beside = frames[0] if frames and role in (CAMERA_ROLE, EXTERIOR_ROLE) else None
        alike = [item for item in sound if item.kind == kind]
        found = sorted(alike, key=lambda item: (
            not item.use, is_geographic(item.crs_wkt), len(alike) > 1 and -clouds_met(item, some, assumed),
            bool(item.doubt), beside and _folders_between(beside, item)))
        if found:
            inputs[role] = (found[0].source,)
        if len(found) > 1 and not found[0].use:
            choices[role] = say(
                "{kind}: {count} files could be taken ({names}); the first is. Say of another one that it is used as "
                "that, or untick the first.", kind=kind_name(kind), count=len(found), names=_names(found))
    for role, kind in _SEVERAL:
        found = [item for item in sound if item.kind == kind]
        if found:
            inputs[role] = tuple(item.source for item in found)
    for use, other in _RIVALS:
        if any(item.use == use for item in sound) and not any(item.use == other for item in sound):
            inputs.pop(other, None)
    without = {item.source for item in clouds if not item.crs_wkt}
    polar = {item.source for item in sound if item.kind in (OUTLINES, MARKINGS) and is_geographic(item.crs_wkt)}
    unplaced, in_degrees = (frozenset(role for role, sources in inputs.items() if named.intersection(sources))
                            for named in (without, polar))
    return Parts(inputs, surveys, tuple(notes), unplaced, in_degrees, choices)


def _is_truth(item: FileFacts) -> bool:
    return item.path.parent.name.lower() in _TRUTH


def _names(found: Sequence[FileFacts]) -> str:
    return ", ".join(item.label for item in found[:4]) + (", …" if len(found) > 4 else "")


def _without_twins(clouds: Sequence[FileFacts]) -> tuple[list[FileFacts], list[str]]:
    """Clouds, of those with the same number of points in the same box and times only one, and notes on it."""
    first: dict[tuple, FileFacts] = {}
    notes = []
    for item in clouds:
        key = (item.count, item.extent, item.times)
        if key in first:
            notes.append(say("{one} and {other} hold the same points: only the first is taken.", one=first[key].label,
                             other=item.label))
        first.setdefault(key, item)
    return list(first.values()), notes


def _surveys(clouds: Sequence[FileFacts], facts: Sequence[FileFacts], inputs: dict[str, tuple[str, ...]],
             notes: list[str]) -> tuple[int, ...]:
    """Clouds that a trajectory covers in time, those of one trajectory together, with their calibration and tables."""
    drives = [item for item in facts if item.kind == TRAJECTORY and item.times]
    of_drive: dict[str, list[FileFacts]] = {}
    for cloud in clouds:
        fitting = _drives_of(cloud, drives, notes)
        if fitting:
            drive = nearest(cloud, fitting)
            of_drive.setdefault(drive.source, []).append(cloud)
            if len(fitting) > 1:
                notes.append(say("{count} trajectories cover the times of {name}: {drive}, which lies nearest to it, "
                                 "is taken.", count=len(fitting), name=cloud.label, drive=drive.label))
    by_source = {drive.source: drive for drive in drives}
    for number, (source, items) in enumerate(sorted(of_drive.items()), 1):
        drive = by_source[source]
        inputs[f"survey_{number}"] = tuple(item.source for item in items)
        inputs[f"trajectory_{number}"] = (source,)
        for role, kind, timed in (("calibration", CALIBRATION, False), ("poses", IMAGE_POSES, True),
                                  ("control", CONTROL, True)):
            fitting = [item for item in facts if item.kind == kind
                       and (not timed or (item.times and times_overlap(item.times, drive.times)))]
            if fitting:
                inputs[f"{role}_{number}"] = (nearest(drive, _chosen(fitting)).source,)
    return tuple(range(1, len(of_drive) + 1))


def _chosen(items: Sequence[FileFacts]) -> Sequence[FileFacts]:
    """Those that the user has put to use; all where he has none."""
    return [item for item in items if item.use] or items


def _drives_of(cloud: FileFacts, drives: Sequence[FileFacts], notes: list[str]) -> Sequence[FileFacts]:
    """Trajectories that may be those of a cloud: none of one that the user says is airborne."""
    if cloud.use == ALS:
        return []
    fitting = [drive for drive in drives if cloud.times and times_overlap(cloud.times, drive.times)
               and _near(cloud, drive)]
    if fitting or cloud.use != SURVEY:
        return _chosen(fitting)
    notes.append(say("{name} is used as a mobile survey, but no trajectory covers its times: add that of the same "
                     "drive.", name=cloud.label))
    return []


def _near(cloud: FileFacts, drive: FileFacts) -> bool:
    """Whether a trajectory's box meets a cloud's; said of those in the same count of coordinates only."""
    if cloud.extent is None or drive.extent is None or (drive.crs_wkt and drive.crs_wkt != cloud.crs_wkt):
        return True
    one, other = cloud.extent, drive.extent
    return one[0] <= other[2] and other[0] <= one[2] and one[1] <= other[3] and other[1] <= one[3]


def nearest(item: FileFacts, others: Sequence[FileFacts]) -> FileFacts:
    """The file that lies nearest to another one among folders, then by the beginning of its name, then by name."""
    def rank(other: FileFacts) -> tuple[int, int, str]:
        alike = next((place for place, (one, two) in enumerate(zip(item.path.name, other.path.name)) if one != two),
                     min(len(item.path.name), len(other.path.name)))
        return _folders_between(item, other), -alike, str(other.path)

    return min(others, key=rank)


def _folders_between(one: FileFacts, other: FileFacts) -> int:
    """Steps up and down from one file's folder to the other's."""
    folder = os.path.relpath(other.path.parent.absolute(), one.path.parent.absolute())
    return 0 if folder == "." else len(folder.split(os.sep))
