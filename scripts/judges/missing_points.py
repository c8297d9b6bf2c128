"""What models say of themselves where half of each building's points are missing, against their true error.

Half of each building's points are deleted in each of five ways, the chain runs on what is left with its defaults, and
every model is compared with all points of the complete cloud. Data: Delft beside the checkout (CLOUD one of its files),
or the first outlines of a CELL such as 83000_446500 from its south-west; cells hold points of buildings alone. The
figures of `seen_roofs` were set on Delft west, seeds 1 and 2.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np
import shapely
from scipy.stats import spearmanr

from scripts.bench import DATA, DELFT, chain, score
from scripts.bench_table import print_table
from scripts.layers import read_layer
from urbanmap_qgis.buildings.building_model import BuildingModel
from urbanmap_qgis.buildings.point_assignment import PlanIndex

STRIP, REACH = 3.0, 1.0
"""Width (m) of the deleted strips; distance (m) beyond an outline within which points are the building's."""

WRONG = 0.5
"""RMSE of height (m, best 95 %) over which a model must not be called ok."""

OPEN_CLASSES = (2, 9)
"""Classes of ground and water, which stay where a building alone is cut."""

EDGES, CUT_SHARE = 5, (0.2, 0.8)
"""Edges of the cloud tried in each direction; share of an outline beyond one from and to which it is cut."""

HEADER = ("way", "buildings", "modelled", "ok", f"ok over {WRONG} m", "rank correlation", "mean error (m)",
          "mean unseen")


@dataclass(frozen=True)
class Scene:
    """A complete cloud, its outlines, and the points that models are scored against.

    Attributes
    ----------
    path : of the cloud.
    xyz, classes : (n, 3) m, (n,).
    outlines : (k,) polygons.
    truth : (m, 3) points of roofs.
    roof : (n,) whether a point is one of those.
    owner : (n,) row of the outline that a point is in or `REACH` near to, -1 for none.
    base : (k,) height of the ground, m, where the cloud has none.
    """

    path: Path
    xyz: np.ndarray
    classes: np.ndarray
    outlines: np.ndarray
    truth: np.ndarray
    roof: np.ndarray
    owner: np.ndarray
    base: np.ndarray | None = None

    @classmethod
    def read(cls, path: Path, outlines: np.ndarray, classified: Path | None = None,
             base: np.ndarray | None = None) -> Scene:
        """A cloud, and one of the same points with classes, where it has none."""
        cloud, classes = laspy.read(path), laspy.read(classified or path)
        xyz = np.column_stack([cloud.x, cloud.y, cloud.z])
        code = np.asarray(classes.classification)
        roof = code == 6 if (code == 6).any() else code >= 0
        true = np.column_stack([classes.x, classes.y, classes.z])[roof]
        index, owner = PlanIndex(xyz[:, 0], xyz[:, 1]), np.full(len(xyz), -1)
        for reach in (REACH, 0.0):
            for row, outline in enumerate(shapely.buffer(outlines, reach)):
                owner[index.inside(outline)] = row
        return cls(path, xyz, np.asarray(cloud.classification), outlines, true, roof, owner, base)


@dataclass(frozen=True)
class Case:
    """A cloud with parts missing: which points stay (n,), and rows of the outlines that are cut."""

    kept: np.ndarray
    cut: np.ndarray


def half_plane(xy: np.ndarray, _row: int, _scene: Scene, rng: np.random.Generator) -> np.ndarray:
    """One side of a straight line, in a random direction."""
    angle = rng.uniform(0, 2 * np.pi)
    along = xy @ [np.cos(angle), np.sin(angle)]
    return along > np.median(along)


def strips(xy: np.ndarray, _row: int, _scene: Scene, rng: np.random.Generator) -> np.ndarray:
    """Every second strip, in a random direction."""
    angle = rng.uniform(0, 2 * np.pi)
    return ((xy @ [np.cos(angle), np.sin(angle)] + rng.uniform(0, 2 * STRIP)) // STRIP) % 2 == 0


def disc(xy: np.ndarray, _row: int, _scene: Scene, rng: np.random.Generator) -> np.ndarray:
    """A disc about a random point."""
    distance = np.linalg.norm(xy - xy[rng.integers(len(xy))], axis=1)
    return distance < np.median(distance)


def shadow(xy: np.ndarray, row: int, scene: Scene, _rng: np.random.Generator) -> np.ndarray:
    """What lies behind the nearest other outline as a scanner at its other side sees it."""
    others = np.delete(scene.outlines, row)
    near = others[np.argmin(shapely.distance(others, scene.outlines[row]))]
    away = np.subtract(*(shapely.get_coordinates(shapely.centroid(one))[0] for one in (scene.outlines[row], near)))
    away = away / max(np.linalg.norm(away), 1e-9)
    across = shapely.get_coordinates(near) @ [-away[1], away[0]]
    side, depth = xy @ [-away[1], away[0]], xy @ away
    behind = (side >= across.min()) & (side <= across.max())
    wanted = min(len(xy) // 2, np.count_nonzero(behind))
    limit = np.sort(depth[behind])[wanted - 1] if wanted else -np.inf
    return behind & (depth <= limit)


CUTS: dict[str, Callable[[np.ndarray, int, Scene, np.random.Generator], np.ndarray]] = {
    "half-plane": half_plane, "strips": strips, "disc": disc, "shadow": shadow}
EDGE = "cloud's edge"


def cases(scene: Scene, way: str, seed: int) -> Iterator[Case]:
    """Clouds with parts missing in a way; the cloud's edge takes several, as one edge crosses few buildings."""
    if way == EDGE:
        yield from _edge_cases(scene)
        return
    rng = np.random.default_rng(seed)
    kept = np.ones(len(scene.xyz), bool)
    cut = []
    for row in range(len(scene.outlines)):
        own = np.flatnonzero(scene.owner == row)
        if way != "shadow":
            own = own[~np.isin(scene.classes[own], OPEN_CLASSES)]
        if len(own):
            kept[own[CUTS[way](scene.xyz[own, :2], row, scene, rng)]] = False
            cut.append(row)
    yield Case(kept, np.array(cut))


def _edge_cases(scene: Scene) -> Iterator[Case]:
    """The cloud ends at a straight line, which goes through buildings."""
    low, high = np.array(shapely.total_bounds(scene.outlines)).reshape(2, 2)
    for axis in (0, 1):
        for place in np.linspace(low[axis], high[axis], EDGES + 2)[1:-1]:
            for side in (-1, 1):
                kept = side * (scene.xyz[:, axis] - place) > 0
                far = np.array([place, low[1] - 1e3]) if axis == 0 else np.array([low[0] - 1e3, place])
                box = shapely.box(*far, *(far + 1e4)) if side > 0 else shapely.box(*(far - 1e4 * np.eye(2)[axis]),
                                                                                  *(far + 1e4 * np.eye(2)[1 - axis]))
                share = 1.0 - shapely.area(shapely.intersection(scene.outlines, box)) / shapely.area(scene.outlines)
                yield Case(kept, np.flatnonzero((share >= CUT_SHARE[0]) & (share <= CUT_SHARE[1])))


@dataclass(frozen=True)
class Outcome:
    """A model of a cut building and its true error (RMSE of height of the best 95 % of all points, m)."""

    way: str
    row: int
    model: BuildingModel
    error: float


def outcomes(scene: Scene, way: str, seed: int) -> list[Outcome]:
    """Models of the cut buildings."""
    found = []
    for case in cases(scene, way, seed):
        run = chain_of(scene, case.kept)
        scores = score(run, scene.outlines, scene.truth)
        for row in case.cut.tolist():
            found.append(Outcome(way, row, run.models[row], scores[row].rmse_z95))
    return found


def chain_of(scene: Scene, kept: np.ndarray):
    """The chain with its defaults on the points that stay."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "cut.laz")
        cloud = laspy.read(scene.path)
        cloud.points = cloud.points[kept]
        cloud.write(path)
        return chain(path, scene.outlines, scene.base, sloped=True)


def figures(found: list[Outcome]) -> tuple:
    """Figures of `HEADER` from the second on."""
    made = [one for one in found if one.model.solids and np.isfinite(one.error)]
    ok = [one for one in made if one.model.status == "ok"]
    quality, error = (np.nan_to_num([one.model.quality for one in made]), [one.error for one in made])
    return (len(found), len(made), len(ok), sum(one.error > WRONG for one in ok),
            -float(spearmanr(quality, error).statistic), float(np.mean(error)),
            float(np.mean([one.model.unseen for one in made])))


def whole(scene: Scene) -> list[Outcome]:
    """Models of the complete cloud."""
    run = chain(scene.path, scene.outlines, scene.base, sloped=True)
    scores = score(run, scene.outlines, scene.truth)
    return [Outcome("complete", row, model, one.rmse_z95) for row, (model, one) in enumerate(zip(run.models, scores))]


def _delft(cloud: str) -> Scene:
    """The part of Delft that models are tuned on."""
    outlines, _ = read_layer(DELFT / "outlines.gpkg", "lokaalid")
    return Scene.read(DELFT / cloud, outlines, DELFT / "points.laz" if cloud == "points_unclassified.laz" else None)


def _cell(name: str, first: int) -> Scene:
    """The outlines of a cell that are nearest to its south-west corner; their points are those of buildings alone."""
    outlines, (base,) = read_layer(DATA / "delft_cells" / f"outlines_{name}.gpkg", "z_base")
    rows = np.argsort(shapely.bounds(outlines)[:, :2].sum(axis=1), kind="stable")[:first]
    return Scene.read(DATA / "delft_cells" / f"points_{name}.laz", outlines[rows], base=np.array(base, float)[rows])


def judge(cloud: str = "points.laz", ways: tuple[str, ...] = (*CUTS, EDGE), seed: int = 1, cell: str = "",
          first: int = 150) -> None:
    """Print the table."""
    scene = _cell(cell, first) if cell else _delft(cloud)
    found = {"complete": whole(scene)}
    found.update({way: outcomes(scene, way, seed) for way in ways})
    rows = [(way, *figures(each)) for way, each in found.items()]
    rows.append(("all with parts missing", *figures([one for way, each in found.items() if way != "complete"
                                                     for one in each])))
    rows.append(("all", *figures([one for each in found.values() for one in each])))
    print_table(f"Half of each building's points missing, Delft, {cell or cloud}", HEADER, rows)
