"""Makes the whole sample city in a folder: plans the world, lets every sensor measure it, writes the truth."""

from __future__ import annotations

import json
import os
import shutil
import uuid
from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_EXCEPTION, Executor, wait
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ..errors import OutputError
from ..progress import SILENT, Progress
from ..wording import known, mark, say
from .aerial.stage import write_aerial
from .drive.lines import write_lines
from .drive.mms import write_mms
from .faults import FAULTS, checked_faults
from .gnss.stage import write_gnss
from .laser.als import write_als
from .place import check_place
from .post import Letters, Post
from .scene.world import CRS, Scene, make_scene
from .truth.outlines import write_outlines
from .truth.stage import write_truth

Write = Callable[[Scene, Path, np.random.SeedSequence, Progress], dict]


@dataclass(frozen=True)
class Sensor:
    """A part of the city that is made on its own.

    `number` starts its random numbers, so that no sensor disturbs another; `share` is its part of all the work.
    """

    write: Write
    number: int
    share: float
    text: str


# The longest first, so that two workers end at about the same time.
SENSORS = {
    "aerial": Sensor(write_aerial, 101, 0.45, mark("Aerial frames and orthophoto")),
    "mms": Sensor(write_mms, 102, 0.30, mark("Mobile surveys")),
    "lines": Sensor(write_lines, 103, 0.13, mark("Line scanners and line cameras")),
    "gnss": Sensor(write_gnss, 104, 0.07, mark("GNSS observations")),
    "als": Sensor(write_als, 105, 0.04, mark("Airborne laser scanning")),
    "footprints": Sensor(write_outlines, 106, 0.01, mark("Official outlines")),
}

CONTENTS = """A made-up city block with known truth, scene "{scene}", seed {seed}, side {size:g} m. {crs}, heights in
metres above sea level, times in GPS seconds. It holds no real data and is free for any use.

aerial/      perspective frames, camera.json, exterior.csv, ortho.tif (a conventional orthophoto: buildings lean)
als/         airborne laser points of two strips: unclassified (als.laz) and classified
footprints/  rough official building outlines: gsi_buildings.gpkg and the same as GSI GML
mms/         two mobile surveys, placed with their REPORTED trajectories, which are about 1 m wrong
lines/       range scans and line images of a vehicle-borne line scanner and line camera
gnss/        RINEX observations and navigation of several passes
models/      building models as delivered, with walls displaced by about 1 m
truth/       what is true: trajectories, markings, ground, roofs, walls, masks, labels
"""


def make_city(folder: Path, size: float = 200.0, scene: str = "canyon", seed: int = 1, progress: Progress = SILENT,
              executor: Executor | None = None, faults: Iterable[str] = ()) -> dict:
    """Make a sample city in a new folder.

    The folder is written beside its place and moved there when it is whole.

    Parameters
    ----------
    folder : does not exist yet, or is empty.
    size, scene, seed : see `scene.make_scene`.
    faults : of real surveys, see `faults.FAULTS`.
    executor : threads or processes that make the sensors' data at the same time. The files do not depend on it.

    Returns
    -------
    A summary by sensor: see the sensors' functions; "city" holds the counts of what stands in it.

    Raises
    ------
    InputError : the size, the scene or a fault is not one of those.
    OutputError : the folder is not empty or cannot be written.
    """
    folder = Path(folder)
    check_place(folder)
    city = (size, scene, seed, checked_faults(faults))
    world = _scene(*city)
    work = folder.parent / f".{folder.name}-{uuid.uuid4().hex[:8]}"
    try:
        work.mkdir()
        summary = {"city": write_truth(world, work)}
        progress.step(0.03)
        summary |= _measure(work, city, progress.part(0.03, 0.99), executor)
        _write_summary(work, summary, *city)
        _move(work, folder)
    except OSError as error:
        raise OutputError(say("The folder {folder} cannot be written ({strerror}): choose another.", folder=folder,
                              strerror=error.strerror)) from error
    finally:
        shutil.rmtree(work, ignore_errors=True)
    progress.step(1.0)
    return summary


@lru_cache(maxsize=2)
def _scene(size: float, scene: str, seed: int, faults: tuple[str, ...] = ()) -> Scene:
    """The world; each process makes it once."""
    return make_scene(size, scene, seed, faults)


def _measure(work: Path, world: tuple, progress: Progress, executor: Executor | None) -> dict:
    """Let all sensors measure, one after another or on the executor; their summaries by name."""
    if executor is not None:
        return _measure_together(work, world, progress, executor)
    summary, done, total = {}, 0.0, sum(sensor.share for sensor in SENSORS.values())
    for name, sensor in SENSORS.items():
        progress.message(known(sensor.text))
        part = progress.part(done / total, (done + sensor.share) / total)
        summary[name] = _run(name, work, world, part)
        done += sensor.share
    return summary


def _run(name: str, work: Path, world: tuple, progress: Progress) -> dict:
    sensor = SENSORS[name]
    seed = np.random.SeedSequence(world[2], spawn_key=(sensor.number,))
    return sensor.write(_scene(*world), work, seed, progress)


def _run_apart(name: str, work: Path, world: tuple, post: Post) -> dict:
    """As `_run`, in another thread or process, with progress and cancel by post."""
    return _run(name, work, world, post.progress())


def _measure_together(work: Path, world: tuple, progress: Progress, executor: Executor) -> dict:
    letters = {name: Letters(Post(work / ".post", name)) for name in SENSORS}
    (work / ".post").mkdir()
    total = sum(sensor.share for sensor in SENSORS.values())
    futures = {name: executor.submit(_run_apart, name, work, world, letters[name].post) for name in SENSORS}
    waiting = set(futures.values())
    try:
        while waiting:
            done, waiting = wait(waiting, timeout=0.2, return_when=FIRST_EXCEPTION)
            for future in done:
                future.result()
            for box in letters.values():
                box.read(progress)
            progress.step(sum(SENSORS[name].share * (1.0 if futures[name].done() else letters[name].fraction)
                              for name in SENSORS) / total)
    except BaseException:
        (work / ".post" / Post.STOP).touch()
        for future in futures.values():
            future.cancel()
        # Threads end at their next step, processes are ended by who started them: nobody waits for a whole frame.
        wait(futures.values(), timeout=0.3)
        raise
    shutil.rmtree(work / ".post")
    return {name: future.result() for name, future in futures.items()}


def _write_summary(work: Path, summary: dict, size: float, scene: str, seed: int, faults: tuple[str, ...]) -> None:
    text = CONTENTS.format(scene=scene, seed=seed, size=size, crs=CRS)
    if faults:
        text += "\nFaults put in:\n" + "".join(f"{name}: {FAULTS[name]}\n" for name in faults)
        summary = {"faults": list(faults), **summary}
    (work / "README.txt").write_bytes(text.encode("utf-8"))
    facts = {"size": float(size), "scene": scene, "seed": seed, "crs": CRS, **summary}
    (work / "truth" / "summary.json").write_bytes(json.dumps(facts, indent=1, ensure_ascii=False).encode("utf-8"))
    of = summary["footprints"]["building_of"]
    (work / "truth" / "gsi_to_building.json").write_bytes(json.dumps(of, indent=1).encode("utf-8"))


def _move(work: Path, folder: Path) -> None:
    if folder.is_dir():
        folder.rmdir()
    os.replace(work, folder)
