"""Hong Kong: real signals among real building models; and signals simulated on the same geometry with known walls.

The observations are of one drive and one parked receiver: too few for any wall. What they can show is that signals in
line of sight and reflected ones are told apart, and that no wall moves. Whether walls are found where they are is
tried with signals simulated along the same drive, from satellites where they were (turned about the zenith for further
passes), among the same buildings grown or shrunk by a metre. The simulation shares no code with what it judges.
"""

from __future__ import annotations

import sqlite3
from dataclasses import dataclass, replace

import numpy as np
import pyproj
import pytest
import shapely

from urbanmap_qgis.gnss.rays.ray_lines import ray_statistics
from urbanmap_qgis.gnss.rays.reflections import LOS, NLOS, REFLECTED
from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.gnss.signals.observations import load_observations
from urbanmap_qgis.gnss.signals.tables import join_signals
from urbanmap_qgis.gnss.walls.adjustment import ADJUSTED, adjust_walls
from urbanmap_qgis.gnss.walls.residuals import trace_residuals
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

PASSES = 14


@pytest.fixture(scope="module")
def buildings(real_data):
    """Rings and ellipsoidal roof heights of the buildings."""
    path = real_data / "gnss" / "buildings_tst" / "buildings.gpkg"
    with sqlite3.connect(path) as file:
        table, column = file.execute("select table_name, column_name from gpkg_geometry_columns").fetchone()
        rows = file.execute(f'select "{column}", roof_height_ellipsoidal from "{table}"').fetchall()
    envelope = (0, 32, 48, 48, 64)
    shapes = [shapely.from_wkb(blob[8 + envelope[(blob[3] >> 1) & 7]:]) for blob, _ in rows]
    return np.array([shapely.force_2d(shape) for shape in shapes], dtype=object), np.array([top for _, top in rows])


@pytest.fixture(scope="module")
def observed(real_data):
    """Signals of both receivers, by year."""
    signals = {}
    for year in (2019, 2020):
        folder = real_data / "gnss" / f"tst_{year}"
        signals[year] = load_observations(
            sorted(folder.glob("*.obs")), sorted(folder.glob("hksc*")),
            read_trajectory(folder / "trajectory.csv").trajectory, pyproj.CRS("EPSG:32650").to_wkt(), 0.0)
    return signals


@pytest.mark.parametrize("year, spread", [(2019, 4.5), (2020, 2.0)])
def test_signals_in_line_of_sight_centre_on_zero(buildings, observed, year, spread):
    shapes, top = buildings
    paths, corrected = trace_residuals(building_walls(shapes, top=top), observed[year])
    sure = paths.sure & np.isfinite(corrected) & (paths.kind == LOS)
    low, middle, high = np.quantile(corrected[sure], [0.25, 0.5, 0.75])
    assert sure.sum() > 4000
    assert abs(middle) < 0.8 and high - low < spread


def test_blocked_signals_are_late_and_weak_and_reflected_ones_near_prediction(buildings, observed):
    shapes, top = buildings
    for year, within in ((2019, 0.5), (2020, 0.25)):
        signals = observed[year]
        paths, corrected = trace_residuals(building_walls(shapes, top=top), signals)
        sight, blocked = ((paths.kind == LOS) & paths.sure, (paths.kind != LOS) & paths.sure)
        assert np.median(signals.cn0[sight]) > np.median(signals.cn0[blocked]) + 6.0
        assert np.nanquantile(corrected[blocked], 0.1) > 0.0 and np.nanmedian(corrected[blocked]) > 15.0
        figures = ray_statistics(signals, paths, corrected)
        assert figures.count[REFLECTED] > 500 and figures.count[NLOS] > 500
        assert figures.within_5 < figures.within_10 and figures.within_10 > within


def test_no_wall_moves_on_two_passes(buildings, observed):
    shapes, top = buildings
    made = adjust_walls(shapes, np.arange(len(shapes)), join_signals(list(observed.values())), top)
    assert not (made.walls.status == ADJUSTED).any()
    assert (made.walls.reason != "").all()
    assert all(after.equals(before) for after, before in zip(made.shapes, shapes))


@dataclass(frozen=True)
class Edges:
    """Walls of the simulation: ends in plan (k, 2), tops (k,), outward normals (k, 2)."""

    a: np.ndarray
    b: np.ndarray
    top: np.ndarray
    normal: np.ndarray

    @classmethod
    def of(cls, shapes, tops):
        ends, top = [], []
        for shape, height in zip(shapes, tops):
            ring = shapely.get_coordinates(shapely.geometry.polygon.orient(shape).exterior)
            ends.append(np.stack([ring[:-1], ring[1:]], axis=1))
            top.append(np.full(len(ring) - 1, height))
        ends = np.concatenate(ends)
        way = ends[:, 1] - ends[:, 0]
        normal = np.column_stack([way[:, 1], -way[:, 0]]) / np.linalg.norm(way, axis=1, keepdims=True)
        return cls(ends[:, 0], ends[:, 1], np.concatenate(top), normal)

    def met(self, k, start, way):
        """Along rays: where they cross the plane of wall k, and whether within the wall."""
        edge = self.b[k] - self.a[k]
        turn = way[:, 0] * edge[1] - way[:, 1] * edge[0]
        off = self.a[k] - start[:, :2]
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (off[:, 0] * edge[1] - off[:, 1] * edge[0]) / turn
            s = (off[:, 0] * way[:, 1] - off[:, 1] * way[:, 0]) / turn
            within = (t > 1e-6) & (s >= 0) & (s <= 1) & (start[:, 2] + t * way[:, 2] <= self.top[k])
        return t, within

    def free(self, start, way, reach=np.inf):
        """Whether rays meet no wall, by trying all."""
        free = np.ones(len(start), bool)
        for k in range(len(self.top)):
            t, within = self.met(k, start, way)
            free &= ~(within & (t < reach))
        return free

    def least_excess(self, place, way, max_range=120.0):
        """Least excess path by one reflection with both legs free, m; NaN where there is none."""
        tried = []
        for k in range(len(self.top)):
            normal = np.array([*self.normal[k], 0.0])
            front = (place[:, :2] - self.a[k]) @ self.normal[k]
            towards = way @ normal
            rows = np.flatnonzero((front > 0.05) & (front < max_range) & (towards > 0.02))
            arriving = way[rows] - 2 * towards[rows, None] * normal
            t, within = self.met(k, place[rows], arriving)
            rows, arriving, t = rows[within], arriving[within], t[within]
            off = place[rows] + t[:, None] * arriving + 1e-3 * normal
            tried.append(np.column_stack([rows, t, 2 * front[rows] * towards[rows], arriving, off]))
        tried = np.concatenate(tried)
        rows = tried[:, 0].astype(int)
        good = self.free(place[rows], tried[:, 3:6], tried[:, 1] - 1e-3) & self.free(tried[:, 6:9], way[rows])
        best = np.full(len(place), np.inf)
        np.minimum.at(best, rows[good], tried[good, 2])
        return np.where(np.isfinite(best), best, np.nan)


def simulated_pass(edges, signals, number, rng):
    """What a receiver on the same drive would have measured with the sky turned by a part of a full turn."""
    keep = np.flatnonzero(signals.epoch % 4 == 0)
    turn = 2 * np.pi * number / PASSES
    east, north, up = signals.direction[keep].T
    way = np.column_stack([east * np.cos(turn) + north * np.sin(turn), north * np.cos(turn) - east * np.sin(turn), up])
    place = signals.place[keep]
    sight = edges.free(place, way)
    excess = np.where(sight, 0.0, np.nan)
    hidden = np.flatnonzero(~sight)
    excess[hidden] = edges.least_excess(place[hidden], way[hidden])
    heard = np.isfinite(excess)
    keep, way, excess, sight = keep[heard], way[heard], excess[heard], sight[heard]
    columns = ("epoch", "time", "satellite", "system", "code", "cn0", "place", "direction", "elevation", "azimuth",
               "residual", "sigma", "troposphere", "ionosphere", "age")
    some = replace(signals, **{name: getattr(signals, name)[keep] for name in columns})
    names, satellite = np.unique(some.satellite, return_inverse=True)
    block = np.unique(np.column_stack([satellite, some.epoch // 20]), axis=0, return_inverse=True)[1].ravel()
    late = (rng.random(block.max() + 1) < 0.2) * rng.exponential(5.0, block.max() + 1)
    error = (rng.normal(0, np.where(sight, 0.6, 1.2)) + rng.normal(0, 0.6, len(names))[satellite]
             + ~sight * (late + rng.normal(0, 0.5, block.max() + 1))[block])
    clock = np.cumsum(rng.normal(0, 3.0, len(signals.epochs)))[some.epoch] + 12.0 * (some.system == "C")
    return replace(
        some, residual=clock + excess + error, direction=way, cn0=np.where(sight, 43.0, 30.0),
        azimuth=np.degrees(np.arctan2(way[:, 0], way[:, 1])) % 360, sigma=np.where(sight, 0.9, 1.5),
        left_out={}, notes=())


def test_known_walls_are_found_in_signals_simulated_on_the_real_geometry(buildings, observed):
    shapes, top = buildings
    grown = np.array([-1.0, 0.0, 1.0])[np.arange(len(shapes)) % 3]
    true = [shapely.buffer(shape, by, join_style="mitre") for shape, by in zip(shapes, grown)]
    rng = np.random.default_rng(2019)
    edges = Edges.of(true, top)
    passes = [simulated_pass(edges, observed[2019], number, rng) for number in range(PASSES)]
    made = adjust_walls(shapes, np.arange(len(shapes)), join_signals(passes), top)
    walls = made.walls
    moved = walls.status == ADJUSTED
    error = (walls.offset - grown[walls.table.building])[moved]
    ratio = np.abs(error) / walls.sigma[moved]
    assert moved.sum() >= 4
    assert np.sqrt(np.mean(error**2)) < 0.45
    assert np.mean(ratio < 2) > 0.85 and ratio.max() < 3.0
    # A metre in or out is told from none.
    known = grown[walls.table.building[moved]]
    assert {0.0, -1.0} <= set(known.tolist())
    assert np.mean(np.clip(np.round(walls.offset[moved]), -1, 1) == known) > 0.8
