"""Solids with upright walls taken apart into roofs, level or sloped, over one ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_FACE
from ...wording import say
from ..solids.plan_partition import Cell

LEVEL = 0.005  # A face whose heights differ by less than this (m) is level.
SLOPED_AREA = 0.05
OFF_PLANE = 0.02  # A sloped face bends by no more than this (m).


@dataclass(frozen=True, eq=False)
class ModelParts:
    """What a model is made of.

    Attributes
    ----------
    base : height of the ground, m.
    cells : roofs with their (greatest) heights, beside each other.
    planes : of each roof: z = p[0] x + p[1] y + p[2], m, x and y from `origin`.
    sloped : whether a roof is not level.
    problem : why the model cannot be taken apart, "" if it can.
    """

    base: float
    cells: tuple[Cell, ...]
    problem: str = ""
    planes: tuple[tuple[float, float, float], ...] = ()
    origin: tuple[float, float] = (0.0, 0.0)
    sloped: bool = False


def model_parts(faces: Sequence[shapely.Polygon]) -> ModelParts:
    """Take a building's solids apart.

    Parameters
    ----------
    faces : all faces with z, m, in any order: upright walls, roofs and a level ground under each solid.
    """
    roofs, heights, planes, grounds, sloped = [], [], [], [], False
    z_faces = [shapely.get_coordinates(face, include_z=True)[:, 2] for face in faces]
    if not z_faces or not all(np.isfinite(z).all() for z in z_faces):
        return ModelParts(float("nan"), (), say("it has no heights"))
    base = min(float(z.min()) for z in z_faces)
    origin = shapely.get_coordinates(faces[0])[0]
    for face, z in zip(faces, z_faces):
        plan = shapely.force_2d(face)
        if plan.area < LEAST_FACE:
            continue
        level = np.ptp(z) <= LEVEL
        if level and z.mean() - base < LEVEL:
            grounds.append(plan)
            continue
        plane, off = (np.array([0.0, 0.0, z.mean()]), 0.0) if level else _plane(face, origin)
        if off > OFF_PLANE and plan.area > SLOPED_AREA:
            return ModelParts(base, (), say("a sloped face of it is not plane"))
        sloped = sloped or (not level and plan.area > SLOPED_AREA)
        roofs.append(plan)
        heights.append(float(z.max() if not level else z.mean()))
        planes.append(tuple(plane.tolist()))
    if not roofs or not grounds:
        return ModelParts(base, (), say("it has no roof or no ground on one level"))
    covered, ground = float(shapely.area(roofs).sum()), float(shapely.area(grounds).sum())
    if abs(covered - ground) > 0.01 * ground + 0.1:
        return ModelParts(base, (), say("its roofs do not lie over its ground: overhangs or a second ground"))
    cells = tuple(Cell(roof, number, height) for number, (roof, height) in enumerate(zip(roofs, heights)))
    return ModelParts(base, cells, "", tuple(planes), tuple(origin.tolist()), sloped)


def _plane(face: shapely.Polygon, origin: np.ndarray) -> tuple[np.ndarray, float]:
    """Plane through a face's corners by least squares, and how far the farthest corner lies from it, m."""
    corners = shapely.get_coordinates(face, include_z=True)
    rows = np.column_stack([corners[:, :2] - origin, np.ones(len(corners))])
    plane = np.linalg.lstsq(rows, corners[:, 2], rcond=None)[0]
    return plane, float(np.abs(rows @ plane - corners[:, 2]).max())
