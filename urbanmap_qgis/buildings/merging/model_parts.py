"""Solids with level roofs and upright walls taken apart into roofs over one ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ..solids.plan_partition import Cell

_LEVEL = 0.005
"""A face whose heights differ by less than this (m) is level."""

_UPRIGHT_AREA = 1e-4
_SLOPED_AREA = 0.05


@dataclass(frozen=True, eq=False)
class ModelParts:
    """What a model is made of.

    Attributes
    ----------
    base : height of the ground, m. cells : roofs with their heights, beside each other.
    problem : why the model cannot be taken apart, "" if it can.
    """

    base: float
    cells: tuple[Cell, ...]
    problem: str = ""


def face_polygons(vertices: np.ndarray, faces: Sequence[Sequence[Sequence[int]]]) -> list[shapely.Polygon]:
    """Faces of a solid (rings of vertex numbers) as polygons with z."""
    return [shapely.Polygon(vertices[list(face[0])], [vertices[list(ring)] for ring in face[1:]]) for face in faces]


def model_parts(faces: Sequence[shapely.Polygon]) -> ModelParts:
    """Take a building's solids apart.

    Parameters
    ----------
    faces : all faces with z, m, in any order: upright walls, level roofs and a level ground under each solid.
    """
    roofs, heights, grounds = [], [], []
    z_faces = [shapely.get_coordinates(face, include_z=True)[:, 2] for face in faces]
    if not z_faces or not all(np.isfinite(z).all() for z in z_faces):
        return ModelParts(float("nan"), (), "it has no heights")
    base = min(float(z.min()) for z in z_faces)
    for face, z in zip(faces, z_faces):
        plan = shapely.force_2d(face)
        if plan.area < _UPRIGHT_AREA:
            continue
        if np.ptp(z) > _LEVEL:
            if plan.area > _SLOPED_AREA:
                return ModelParts(base, (), "it has sloped faces")
            continue
        if z.mean() - base < _LEVEL:
            grounds.append(plan)
        else:
            roofs.append(plan)
            heights.append(float(z.mean()))
    if not roofs or not grounds:
        return ModelParts(base, (), "it has no roof or no ground on one level")
    covered, ground = float(shapely.area(roofs).sum()), float(shapely.area(grounds).sum())
    if abs(covered - ground) > 0.01 * ground + 0.1:
        return ModelParts(base, (), "its roofs do not lie over its ground: overhangs or a second ground")
    return ModelParts(base, tuple(Cell(roof, number, height)
                                  for number, (roof, height) in enumerate(zip(roofs, heights))))
