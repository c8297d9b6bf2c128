"""Predicted against simulated accuracy of localisation: on buildings and drives, and on streets that repeat.

BUILDINGS is a vector file of outlines with z_top and z_base or of solids, DRIVES are trajectories. Without --truth
every scan has a true city of its own, the map displaced by its sigmas; --mixed: sigmas of 5 to 60 cm, drawn by wall.
--markings FILE or FILE|LAYER: these are simulated instead of scans. --streets N: rows of houses at equal and at unequal
distances, on which the places that look alike are counted.
"""

from __future__ import annotations

import json
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import shapely

from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.localisation.accuracy_map import accuracy_map
from urbanmap_qgis.localisation.accuracy_records import LocalisationMap
from urbanmap_qgis.localisation.evidence.marking_map import MarkingMap, marking_map
from urbanmap_qgis.localisation.localisation_settings import LocalisationSettings, VehicleScanner
from urbanmap_qgis.localisation.places.road_places import joined_places, places_on_drive, places_on_roads
from urbanmap_qgis.localisation.simulation.marking_check import check_marking_prediction
from urbanmap_qgis.localisation.simulation.prediction_check import PredictionCheck, check_prediction
from urbanmap_qgis.localisation.walls.wall_map import WallMap, wall_sigmas, walls_with_heights
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

ALIASED = 0.1


def read_walls(path: str):
    """Walls of a vector file."""
    from osgeo import ogr

    name, _, layer = path.partition("|")
    source = ogr.Open(name)
    table = source.GetLayerByName(layer) if layer else source.GetLayer(0)
    shapes, top, base, key = [], [], [], []
    for number, feature in enumerate(table):
        shapes.append(shapely.from_wkb(bytes(feature.GetGeometryRef().ExportToWkb())))
        values = feature.items()
        top.append(next((values[name] for name in ("z_top", "z_max") if values.get(name) is not None), np.nan))
        base.append(next((values[name] for name in ("z_base", "z_ground") if values.get(name) is not None), np.nan))
        key.append(str(values.get("building_id", values.get("building", number))))
    building = np.unique(key, return_inverse=True)[1].ravel()
    return walls_with_heights(np.array(shapes, object), building, np.array(top, float), np.array(base, float))[0]


def read_markings(path: str, sigma: float) -> MarkingMap:
    """Markings of a vector file."""
    from osgeo import ogr

    name, _, layer = path.partition("|")
    source = ogr.Open(name)
    table = source.GetLayerByName(layer) if layer else source.GetLayer(0)
    shapes = [shapely.from_wkb(bytes(feature.GetGeometryRef().ExportToWkb())) for feature in table]
    return marking_map(np.array(shapes, object), np.full(len(shapes), sigma))


def on_markings(given) -> dict:
    """Figures of the markings of a city."""
    markings = read_markings(given.markings, given.marking_sigma)
    places = places_of(given)
    places = places.with_heights(np.full(len(places), np.nanmedian(markings.height)))
    settings = LocalisationSettings(start_sigma=given.start)
    made = accuracy_map(LocalisationMap(None, markings), places, settings)
    return figures_of(check_marking_prediction(markings, made, settings, given.every, given.draws, given.seed))


def places_of(given):
    """Places on the drives, without heights."""
    drives = [read_trajectory(path).trajectory for path in given.drives]
    places = joined_places([places_on_drive(drive.place, drive.time, given.spacing, number)
                            for number, drive in enumerate(drives)])
    return places.with_heights(np.full(len(places), np.nan))


def on_city(given) -> dict:
    """Figures of a city."""
    walls = read_walls(given.buildings)
    rng = np.random.default_rng(5)
    sigma = rng.choice([0.05, 0.15, 0.3, 0.6], walls.count) if given.mixed else wall_sigmas(walls, given.sigma)
    city = WallMap.of(walls, sigma)
    places = places_of(given)
    settings = LocalisationSettings(given.matcher, scanner=VehicleScanner(given.scanner), start_sigma=given.start)
    begin = time.process_time()
    made = accuracy_map(LocalisationMap(city), places, settings)
    speed = len(places) / (time.process_time() - begin)
    truth = read_walls(given.truth) if given.truth else None
    found = check_prediction(city, made, settings, given.every, given.draws, given.seed, truth)
    return {"places": len(places), "places a second": speed} | figures_of(found)


def figures_of(found: PredictionCheck) -> dict:
    """What a check says."""
    return {"simulated": len(found.rows), "scans": found.errors.shape[1],
            "rank": found.rank, "rank in street": found.rank_in_street, "inside": found.inside,
            "observed": float(np.median(found.observed)), "predicted": float(np.median(found.predicted)),
            "hidden": float(found.hidden.mean()), "beyond 1 m": float((np.hypot(
                *np.moveaxis(found.errors[:, :, :2], 2, 0)) > 1.0).mean()),
            "elsewhere": float(found.elsewhere.mean()), "converged": float(found.converged.mean()),
            "directions not determined": float((~found.determined).mean()), "rank of converged": found.rank_converged,
            "inside of converged": found.inside_converged, "failures ranked": found.failures_ranked}


def street(rng: np.random.Generator, unequal: float) -> tuple[WallMap, float]:
    """Two rows of houses with gaps, their distances and sizes unequal by up to a share; and their period, m."""
    period, width, depth = rng.uniform(8, 14), rng.uniform(0.5, 0.75), rng.uniform(6, 10)
    shapes = []
    for side in (1, -1):
        shift = rng.uniform(0, period)
        for number in range(-12, 13):
            a = number * period + shift + unequal * rng.uniform(-0.5, 0.5) * period
            b = a + period * width * (1 + unequal * rng.uniform(-0.5, 0.5))
            near = 8 + unequal * rng.uniform(0, 4)
            shapes.append(shapely.box(a, min(side * near, side * (near + depth)), b,
                                      max(side * near, side * (near + depth))))
    walls = building_walls(np.array(shapes, object), None, np.full(len(shapes), 12.0), np.zeros(len(shapes)))
    return WallMap.of(walls, wall_sigmas(walls, 0.2)), period


def on_streets(count: int, seed: int, draws: int) -> dict:
    """How many of the places that look alike are found, and how many others are."""
    rng = np.random.default_rng(seed)
    predicted, observed = [], []
    settings = LocalisationSettings()
    for _ in range(count):
        city, _ = street(rng, float(rng.choice([0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8])))
        places = places_on_roads([shapely.LineString([(-20, 1, 0), (20, 1, 0)])], 10.0)
        made = accuracy_map(LocalisationMap(city), places, settings)
        found = check_prediction(city, made, settings, 1, draws, seed)
        predicted.append(made.alias_share[found.rows] >= settings.alias_share)
        observed.append(found.elsewhere >= ALIASED)
    predicted, observed = np.concatenate(predicted), np.concatenate(observed)
    return {"places": len(predicted), "that look alike": int(observed.sum()),
            "found": float(predicted[observed].mean()), "false alarms": float(predicted[~observed].mean())}


def judge(buildings: str = "", drives: tuple[Path, ...] = (), truth: str = "", scanner: str = "2D", mixed: bool = False,
          streets: int = 0, matcher: str = "NDT", markings: str = "", sigma: float = 0.3, marking_sigma: float = 0.05,
          start: float = 1.0, spacing: float = 2.0, every: int = 5, draws: int = 20, seed: int = 1) -> None:
    """Print the figures of a city, of its markings, or of streets."""
    given = SimpleNamespace(**locals())
    if streets:
        made = on_streets(streets, seed, draws)
    else:
        made = on_markings(given) if markings else on_city(given)
    print(json.dumps(made, indent=1))
