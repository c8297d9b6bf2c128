"""Settings of ground and surface."""

from __future__ import annotations

from dataclasses import field

from .declaration import Settings, record, setting


@record(frozen=True)
class ClothSettings(Settings):
    """Parameters of the filter, with J's values."""

    resolution: float = setting(
        2.0, "Cloth resolution", "Distance in metres between the nodes of the cloth. Smaller follows the ground "
        "closer; larger spans more.", "m", 0.1, 50.0, alias="CLOTH_RESOLUTION", advanced=True)
    threshold: float = setting(
        0.2, "Cloth threshold", "Points within this height, in metres, above or below the cloth are ground.", "m", 0.01,
        5.0, alias="CLOTH_THRESHOLD", advanced=True)
    iterations: int = setting(
        1000, "Cloth iterations", "Maximum number of sweeps on each level of detail; the cloth stops earlier when it "
        "has converged.", "", 1, 100000, advanced=True)
    rigidness: int = setting(
        3, "Cloth rigidness", "3 for towns and large buildings, 2 for hills, 1 for steep mountains.", "", 1, 3,
        advanced=True)


def ground_source_setting(advanced: bool = False):
    """The field of records that say where ground points come from."""
    return setting("automatic", "Ground points", "How ground points are told. Automatic: by class where at least 1 % "
                   "of the points have a ground class, otherwise by the cloth filter.",
                   choices=("automatic", "classes", "cloth"), alias="GROUND_SOURCE", advanced=advanced)


@record(frozen=True)
class SurfaceSettings(Settings):
    """How surfaces are made.

    Parameters
    ----------
    cloth : parameters of the cloth filter.
    """

    resolution: float = setting(
        0.5, "Resolution", "Side of a raster cell in metres. Finer than the distance between points shows nothing "
        "more.", "m", 0.01, 100.0)
    ground: str = ground_source_setting()
    max_edge: float = setting(
        0.0, "Maximum edge length", "Triangles of the surface with a longer side in plan, in metres, are left out, so "
        "that water and gaps stay empty; 0 keeps all.", "m", 0.0, advanced=True)
    ground_in_gaps: bool = setting(
        False, "Ground in gaps", "Where triangles were left out, the surface takes the height of the ground instead of "
        "staying empty.", advanced=True)
    cloth: ClothSettings = field(default_factory=ClothSettings)
