"""Makes the GNSS part of the sample city: observations of several drives, satellites, delivered models and the truth.

Folder `gnss/`: `pass_NN.obs`, `pass_NN_trajectory.csv` (of the antenna), `satellites.nav`, `gnss.json` (what a reader
must know). Folder `models/`: building models with displaced walls as GeoJSON and CityJSON. Folder `truth/`:
`wall_offsets.csv`, `gnss_signals.csv.gz`, `gnss_pass_NN_trajectory.csv`.
"""

from __future__ import annotations

import gzip
import json
from pathlib import Path

import numpy as np

from ...progress import SILENT, Progress
from ..scene.model import GROUND
from ..scene.world import CRS, Scene
from .displaced_walls import DisplacedWall, deliver
from .earth_fixed import GEOID_SEPARATION, CityFrame
from .models_write import write_block_cityjson, write_block_geojson
from .orbits import Orbits, light_path, make_constellation
from .passes import ANTENNA_HEIGHT, DAY_START, TRAJECTORY_ERROR, WEEK, Pass, make_passes
from .rays import Mirrors, OpaqueFaces
from .rinex_write import LEAP_SECONDS, write_navigation, write_observations
from .signals import SignalKind, SimulatedSignals, Site, Sky, receive

RECORD_EVERY = 7200.0
"""Seconds between the records of a satellite in the navigation file."""

ORBIT_ERROR = 0.3
"""Of the broadcast orbits and clocks along the signal, standard deviation, m."""

SIGNAL_FIELDS = ("pass,time,satellite,elevation,azimuth,class,tracked,wall,reflections,excess_path,multipath,late,"
                 "noise,clock,cn0,code")


def write_gnss(scene: Scene, folder: Path, seed: np.random.SeedSequence, progress: Progress = SILENT,
               day: Sky | None = None) -> dict:
    """Write the GNSS part of the city into `folder` (gnss/, models/, truth/), of a day with a given ionosphere.

    Returns a summary: passes, epochs, satellites, signals above the mask, shares of line of sight, reflected,
    diffracted and blocked ones, walls that are exposed and that reflected something.
    """
    folders = {name: folder / name for name in ("gnss", "models", "truth")}
    for path in folders.values():
        path.mkdir(parents=True, exist_ok=True)
    models_seed, sky_seed, drives_seed, signals_seed = seed.spawn(4)
    faces = scene.static_faces(GROUND)
    blocks, walls, wall_of_face = deliver(scene.buildings, faces, np.random.default_rng(models_seed))
    write_block_geojson(folders["models"] / "buildings.geojson", CRS, blocks)
    write_block_cityjson(folders["models"] / "buildings.city.json", CRS, blocks)
    _write_walls(folders["truth"] / "wall_offsets.csv", walls)
    drives = make_passes(scene, np.random.default_rng(drives_seed))
    site = _site(scene)
    sky = np.random.default_rng(sky_seed)
    base = make_constellation(DAY_START, sky)
    orbits = [base.moved_to(_record_time(drive)) for drive in drives]
    errors = sky.normal(0.0, ORBIT_ERROR, (len(drives), len(base)))
    signals = []
    for number, (drive, pass_seed) in enumerate(zip(drives, signals_seed.spawn(len(drives)))):
        progress.step(number / len(drives))
        signals.append(receive(site, drive, orbits[number], errors[number], np.random.default_rng(pass_seed), day))
        _write_pass(folders, site, drive, signals[-1])
    write_navigation(folders["gnss"] / "satellites.nav", WEEK, _records(base, drives, site))
    _write_signals(folders["truth"] / "gnss_signals.csv.gz", drives, signals, wall_of_face)
    _write_facts(folders["gnss"] / "gnss.json", drives)
    progress.step(1.0)
    return _summary(drives, signals, walls, wall_of_face)


def _site(scene: Scene) -> Site:
    faces = scene.static_faces(GROUND)
    x, y = scene.ground.origin
    height = float(scene.ground_height(np.array([x]), np.array([y]))[0])
    return Site(CityFrame.of(CRS, x, y, height), OpaqueFaces.of(faces), Mirrors.of(faces), scene.crowns, height)


def _record_time(drive: Pass) -> float:
    """Reference time of the navigation records that a drive uses, the nearest one."""
    return RECORD_EVERY * np.round(drive.epochs.mean() / RECORD_EVERY)


def _records(base: Orbits, drives: list[Pass], site: Site) -> Orbits:
    """Records at all times that the drives use or may take for nearest, of the satellites that are up."""
    times = np.unique([_record_time(drive) for drive in drives])
    times = np.arange(times[0] - RECORD_EVERY, times[-1] + 1.5 * RECORD_EVERY, RECORD_EVERY)
    place = site.frame.earth_fixed(np.array([[*_middle(drives), site.height]]))
    parts = []
    for time in times:
        records = base.moved_to(float(time))
        around = time + np.linspace(-RECORD_EVERY, RECORD_EVERY, 9)
        satellite, _, _ = light_path(records, around, np.repeat(place, len(around), axis=0))
        up = site.frame.directions(satellite - place)[..., 2].max(axis=0) > 0
        parts.append(records.select(np.flatnonzero(up)))
    return Orbits(*(np.concatenate([getattr(part, name) for part in parts]) for name in Orbits.__dataclass_fields__))


def _middle(drives: list[Pass]) -> np.ndarray:
    return np.mean([drive.truth.place[:, :2].mean(axis=0) for drive in drives], axis=0)


def _write_pass(folders: dict[str, Path], site: Site, drive: Pass, signals: SimulatedSignals) -> None:
    approximate = site.frame.earth_fixed(drive.reported.place[:1])[0]
    write_observations(folders["gnss"] / f"{drive.name}.obs", WEEK, drive.epochs, signals.satellite, signals.tracked,
                       signals.code, signals.strength, approximate, drive.name, signals.second_code)
    drive.reported.write(folders["gnss"] / f"{drive.name}_trajectory.csv")
    drive.truth.write(folders["truth"] / f"gnss_{drive.name}_trajectory.csv")


def _write_walls(path: Path, walls: list[DisplacedWall]) -> None:
    rows = ["wall,building,part,x0,y0,x1,y1,nx,ny,offset,z_low,z_top,true_x0,true_y0,true_x1,true_y1"]
    for wall in walls:
        ends = ",".join(f"{value:.3f}" for value in wall.delivered.ravel())
        true = ",".join(f"{value:.3f}" for value in wall.true.ravel())
        heights = ",".join("" if np.isnan(z) else f"{z:.3f}" for z in (wall.z_low, wall.z_top))
        rows.append(f"{wall.number},{wall.building},{wall.part},{ends},{wall.normal[0]:.6f},{wall.normal[1]:.6f},"
                    f"{wall.offset:.3f},{heights},{true}")
    path.write_bytes(("\n".join(rows) + "\n").encode("ascii"))


def _write_signals(path: Path, drives: list[Pass], signals: list[SimulatedSignals], wall_of_face: np.ndarray) -> None:
    rows = [SIGNAL_FIELDS]
    names = {int(kind): kind.name.lower() for kind in SignalKind}
    for drive, one in zip(drives, signals):
        wall = np.where(one.face >= 0, wall_of_face[one.face], 0)
        for e, s in zip(*np.nonzero(one.above)):
            seen = one.tracked[e, s]
            measured = f"{one.strength[e, s]:.3f},{one.code[e, s]:.4f}" if seen else ","
            rows.append(
                f"{drive.number},{drive.epochs[e]:.0f},{one.satellite[s]},{np.degrees(one.elevation[e, s]):.4f},"
                f"{np.degrees(one.azimuth[e, s]):.4f},{names[int(one.kind[e, s])]},{int(seen)},{wall[e, s] or ''},"
                f"{one.reflections[e, s]},{one.excess[e, s]:.4f},{one.multipath[e, s]:.4f},{one.nlos_delay[e, s]:.4f},"
                f"{one.noise[e, s]:.4f},{one.clock[e, s]:.4f},{measured}")
    with open(path, "wb") as raw, gzip.GzipFile("", "wb", 6, raw, mtime=0) as packed:
        packed.write(("\n".join(rows) + "\n").encode("ascii"))


def _write_facts(path: Path, drives: list[Pass]) -> None:
    facts = {
        "crs": CRS, "heights": "orthometric, m", "geoid_separation_m": GEOID_SEPARATION, "gps_week": WEEK,
        "leap_seconds": LEAP_SECONDS, "antenna_above_road_m": ANTENNA_HEIGHT,
        "trajectory": "place of the antenna, in GPS seconds of week",
        "trajectory_sigma_m": {"plan": TRAJECTORY_ERROR[0], "height": TRAJECTORY_ERROR[1]},
        "models": "../models/buildings.geojson",
        "passes": [{"observations": f"{drive.name}.obs", "trajectory": f"{drive.name}_trajectory.csv",
                    "navigation": "satellites.nav"} for drive in drives]}
    path.write_text(json.dumps(facts, indent=2) + "\n", encoding="utf-8")


def _summary(drives: list[Pass], signals: list[SimulatedSignals], walls: list[DisplacedWall],
             wall_of_face: np.ndarray) -> dict:
    above = np.concatenate([one.kind[one.above] for one in signals])
    face = np.concatenate([one.face[one.face >= 0] for one in signals])
    summary = {"passes": len(drives), "epochs": sum(len(drive.epochs) for drive in drives),
               "satellites": len(signals[0].satellite), "signals": len(above),
               "exposed_walls": sum(not np.isnan(wall.z_top) for wall in walls),
               "reflecting_walls": len(np.unique(wall_of_face[face]))}
    return summary | {kind.name.lower(): float(np.mean(above == kind)) for kind in SignalKind}
