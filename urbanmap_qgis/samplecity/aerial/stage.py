"""Makes the aerial part of the sample city: frames, camera, exterior orientation, orthophoto, masks."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...progress import Progress
from ...wording import say
from ..scene.crowns import Leaves
from ..scene.world import Scene
from ..truth.geotiff import write_image, write_mask
from .camera import Camera, Exposure, exterior_csv
from .face_shading import make_stains
from .flight import footprint, plan_flight
from .ground_image import make_ground_image
from .orthophoto import CELL, Orthophoto
from .render import Stage, render_frame, still_faces
from .sunlight import ShadowMap, Sun

ORTHO_BORDER = 3.0
"""The orthophoto reaches so far beyond the city, m."""


def write_aerial(scene: Scene, folder: Path, seed: np.random.SeedSequence, progress: Progress) -> dict:
    """Write `aerial/` (frames, camera.json, exterior.csv, ortho.tif) and `truth/occlusion/` under the folder.

    The masks have the frames' rows and columns: 255 building or elevated road, 128 tree, 64 vehicle, 0 ground;
    `ortho.tif` the same for the orthophoto.

    Returns
    -------
    What was made: `frames`, `width`, `height`, `sun` [azimuth, elevation], `times` of the exposures (GPS s).

    Raises
    ------
    OutputError : a file cannot be written.
    """
    aerial, truth = folder / "aerial", folder / "truth" / "occlusion"
    for place in (aerial, truth):
        place.mkdir(parents=True, exist_ok=True)
    plan_seed, stage_seed, noise_seed = _children(seed, 3)
    rng = np.random.default_rng(plan_seed)
    camera, exposures = plan_flight(scene, rng)
    sun = Sun(float(rng.uniform(150.0, 215.0)), float(rng.uniform(52.0, 64.0)))
    gains = 1.0 + np.clip(rng.normal(0.0, 0.03, len(exposures)), -0.06, 0.06)
    (aerial / "camera.json").write_text(camera.to_json(), encoding="utf-8")
    (aerial / "exterior.csv").write_text(exterior_csv(exposures), encoding="utf-8")

    stage = make_stage(scene, camera, exposures, sun, stage_seed, progress.part(0.0, 0.2))
    orthophoto = _orthophoto(scene, camera, exposures)
    for number, exposure in enumerate(exposures):
        part = progress.part(0.2 + 0.78 * number / len(exposures), 0.2 + 0.78 * (number + 1) / len(exposures))
        part.message(say("Frame {number} of {exposures_count}", number=number + 1, exposures_count=len(exposures)))
        noise = np.random.default_rng(_children(noise_seed, len(exposures))[number])
        frame = render_frame(stage, camera, exposure, gains[number], noise, part)
        part.step(0.94)
        write_image(aerial / exposure.image, frame.image)
        part.step(0.96)
        write_mask(truth / exposure.image, frame.mask)
        part.step(0.98)
        orthophoto.add(number, frame)
    progress.step(0.98)
    write_image(aerial / "ortho.tif", orthophoto.image, (*orthophoto.corner, CELL))
    write_mask(truth / "ortho.tif", orthophoto.mask, (*orthophoto.corner, CELL))
    progress.step(1.0)
    return {"frames": len(exposures), "width": camera.width, "height": camera.height,
            "sun": [round(sun.azimuth, 2), round(sun.elevation, 2)], "times": [e.time for e in exposures]}


def make_stage(scene: Scene, camera: Camera, exposures: list[Exposure], sun: Sun, seed: np.random.SeedSequence,
               progress: Progress) -> Stage:
    """All that the frames share: ground, still things, light."""
    rng = np.random.default_rng(seed)
    origin = np.array(scene.ground.origin)
    faces, crowns = still_faces(scene), scene.crowns
    leaves = Leaves(crowns, origin)
    level = float(scene.ground_height(*origin))
    shadows = ShadowMap(sun, faces, crowns, leaves, origin, level)
    corners = np.concatenate([footprint(camera, exposure, level) for exposure in exposures]) - origin
    bounds = np.concatenate([corners.min(axis=0) - 3.0, corners.max(axis=0) + 3.0])
    ground = make_ground_image(scene, bounds, shadows, rng, progress)
    return Stage(scene, ground, shadows, leaves, faces, make_stains(rng))


def _orthophoto(scene: Scene, camera: Camera, exposures: list[Exposure]) -> Orthophoto:
    """An empty orthophoto of the city, its corner on whole metres."""
    x_min, y_min, x_max, y_max = scene.extent.buffer(ORTHO_BORDER).bounds
    corner = float(np.floor(x_min)), float(np.ceil(y_max))
    shape = tuple(int(np.ceil(side / CELL)) for side in (corner[1] - y_min, x_max - corner[0]))
    return Orthophoto(scene, camera, exposures, corner, shape)


def _children(seed: np.random.SeedSequence, count: int) -> list[np.random.SeedSequence]:
    """Seeds that depend on the seed alone, however often one asks (`spawn` would count on)."""
    return [np.random.SeedSequence(seed.entropy, spawn_key=(*seed.spawn_key, k)) for k in range(count)]
