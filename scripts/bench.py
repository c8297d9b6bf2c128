"""Tables of speed, memory and accuracy: `make bench`; `python scripts/bench.py faults warnings` prints some.

Times are CPU seconds of this process. Each is also given as a ratio to a reference measured in the same run, the
Delaunay triangulation of 200,000 random points by scipy, so that figures of different machines compare.
With the real data beside the checkout (../shared/data) the models are scored against the laser points and the true
outlines, next to the published figures of roofer 1.1; without them the made block is used alone.
"""

from __future__ import annotations

import csv
import resource
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import Delaunay

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.bench_goals import goals_table  # noqa: E402
from scripts.bench_images import image_kinds_table  # noqa: E402
from scripts.bench_large import large_roofs_table  # noqa: E402
from scripts.bench_sloped import sloped_table  # noqa: E402
from scripts.bench_stages import stage_tables  # noqa: E402
from scripts.bench_table import print_table  # noqa: E402
from scripts.bench_warnings import warnings_table  # noqa: E402
from scripts.judges import city_faults  # noqa: E402
from scripts.layers import read_layer  # noqa: E402
from scripts.scoring import Score, points_inside, score_building, summary  # noqa: E402
from urbanmap_qgis.buildings.building_model import BuildingModel, RoofInput  # noqa: E402
from urbanmap_qgis.buildings.model_stage import build_models  # noqa: E402
from urbanmap_qgis.buildings.model_surfaces import roof_cells, wall_rectangles  # noqa: E402
from urbanmap_qgis.buildings.outlines.footprint import Footprints, clean_footprints  # noqa: E402
from urbanmap_qgis.buildings.polygon_stage import cloud_roof_polygons  # noqa: E402
from urbanmap_qgis.buildings.roof_stage import segment_cloud_roofs  # noqa: E402
from urbanmap_qgis.buildings.seen.cloud_cover import CloudCover  # noqa: E402
from urbanmap_qgis.buildings.segmentation import segment_buildings  # noqa: E402
from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all  # noqa: E402
from urbanmap_qgis.settings.buildings import (  # noqa: E402
    LEVELS,
    PLANES,
    PlaneParameters,
    PolygonParameters,
    RoofParameters,
    SegmentationParameters,
)

DATA = ROOT.parent / "shared" / "data" / "als"
DELFT = DATA / "delft_west"
CELLS = ("82500_446000", "83000_446000", "83000_446500")
CITY, CITY_CLOUDS = DATA.parent / "city", ("als", "als_classified")
FLAT_RMSE_3D = 0.2
"""A building is flat-roofed where roofer's one-height model has at most this RMSE 3D (m)."""


@dataclass(frozen=True)
class Run:
    """Models of one input and the CPU seconds of each stage."""

    models: list[BuildingModel]
    seconds: dict[str, float]


def chain(points: Path, outlines: np.ndarray, base: np.ndarray | None = None,
          placing: SegmentationParameters | None = None, levels: RoofParameters | None = None,
          drawing: PolygonParameters | None = None, sloped: bool = False) -> Run:
    """The chain of the building stages as the algorithms run it, with its defaults where nothing else is given."""
    shape = PLANES if sloped else LEVELS
    seconds = {}
    footprints = clean_footprints(outlines)

    def timed(name, work):
        start = time.process_time()
        result = work()
        seconds[name] = time.process_time() - start
        return result

    with tempfile.TemporaryDirectory() as folder:
        buildings, roofs = Path(folder, "buildings.laz"), Path(folder, "roofs.laz")
        found = timed("segment buildings", lambda: segment_buildings(open_cloud([points]), footprints, buildings,
                                                                     placing))
        placed = Footprints(footprints.ids, found.outlines, footprints.notes)
        density = float(np.median(found.density[found.density > 0]))
        timed("segment roofs", lambda: segment_cloud_roofs(open_cloud([buildings]), placed, roofs, levels,
                                                           found.ground, density,
                                                           planes=PlaneParameters() if sloped else None))
        drawn = timed("roof polygons", lambda: cloud_roof_polygons(open_cloud([roofs]), placed,
                                                                   drawing or PolygonParameters(roofs=shape)))
        table = RoofInput(np.array(drawn.polygon, object), np.array(drawn.building_id), np.array(drawn.roof_id),
                          np.array(drawn.height), np.array(drawn.status, object))
        models = timed("building models", lambda: build_models(
            placed, table, found.ground if base is None else base, open_cloud([roofs]), roof_shape=shape,
            cover=CloudCover(found.cloud_density, found.beyond)))
    return Run(models, seconds)


def score(run: Run, truth: np.ndarray, points: np.ndarray) -> list[Score]:
    """Scores of all buildings against true outlines and class 6 points (n, 3)."""
    return [score_building(model.building_id, outline, inside, roof_cells(model.solids), wall_rectangles(model.solids))
            for model, outline, inside in zip(run.models, truth, points_inside(points, truth))]


def reference_seconds() -> float:
    """CPU seconds of the reference."""
    points = np.random.default_rng(0).uniform(0, 1000, (200_000, 2))
    start = time.process_time()
    Delaunay(points)
    return time.process_time() - start


@dataclass(frozen=True)
class Delft:
    """What models of Delft are scored against: true outlines, class 6 points (n, 3), which buildings are flat."""

    truth: np.ndarray
    points: np.ndarray
    flat: list[bool]

    @classmethod
    def read(cls) -> Delft:
        """Read the part of Delft that is beside the checkout."""
        truth, (ids,) = read_layer(DELFT / "outlines.gpkg", "lokaalid")
        cloud = read_all(open_cloud([DELFT / "points.laz"]), ("x", "y", "z", "classification"))
        points = np.column_stack([cloud[name] for name in "xyz"])[cloud["classification"] == 6]
        with (DELFT / "peers.csv").open() as stream:
            peers = {row["lokaalid"]: row for row in csv.DictReader(stream)}
        flat = [float(peers[name]["lod12_rmse_3d"] or "inf") <= FLAT_RMSE_3D for name in ids]
        return cls(truth, points, flat)

    def figures(self, run: Run) -> tuple:
        """Modelled, status ok, roofs, RMSE z 95 %, RMSE 3D, RMSE z of flat roofs, plan IoU."""
        scores = score(run, self.truth, self.points)
        means = summary(scores)
        flat = [one.rmse_z for one, is_flat in zip(scores, self.flat) if is_flat and np.isfinite(one.rmse_z)]
        return (f"{means['modelled']}/{means['buildings']}", sum(model.status == "ok" for model in run.models),
                means["roofs"], means["rmse_z95"], means["rmse_3d"], float(np.mean(flat)), means["plan_iou"])


FIGURES = ("modelled", "status ok", "roofs", "RMSE z 95 % (m)", "RMSE 3D (m)", "flat roofs: RMSE z (m)", "plan IoU")


def delft_table(delft: Delft) -> None:
    """Accuracy on the part of Delft that is here, with damaged inputs, one set of defaults."""
    rows = []
    for cloud_name, outline_name in (
            ("points", "outlines"), ("points_unclassified", "outlines"), ("points_2_per_m2", "outlines"),
            ("points_1_per_m2", "outlines"), ("points", "outlines_shifted_1m"), ("points", "outlines_shifted_2m"),
            ("points_unclassified", "outlines_shifted_1m"), ("points_unclassified", "outlines_shifted_2m")):
        outlines, _ = read_layer(DELFT / f"{outline_name}.gpkg", "lokaalid")
        run = chain(DELFT / f"{cloud_name}.laz", outlines)
        rows.append((cloud_name, outline_name, *delft.figures(run),
                     1000 * sum(run.seconds.values()) / len(outlines)))
    print_table("Delft (AHN3); roofer 1.1 LoD1.3, step 0.5 m: RMSE z 95 % 0.623 m, RMSE 3D 0.393 m, 256 roofs",
                ("points", "outlines", *FIGURES, "CPU ms/building"), rows)


def steps_table(delft: Delft) -> None:
    """`METHOD=paper`, and what each step brings that leads from its polygons to the defaults."""
    still, whole = SegmentationParameters(maximum_displacement=0.0), RoofParameters(height_rmse=0.0)
    steps = (
        ("METHOD=paper", {"placing": SegmentationParameters(method="paper"), "levels": RoofParameters(method="paper"),
                          "drawing": PolygonParameters("paper", height="maximum")}),
        ("our segments, the paper's polygons and heights, roofs from 50 m2",
         {"placing": still, "levels": RoofParameters(height_rmse=0.0, min_roof_share=1.0),
          "drawing": PolygonParameters("paper", height="maximum")}),
        ("the same, roofs from a fifth of a small outline",
         {"placing": still, "levels": whole, "drawing": PolygonParameters("paper", height="maximum")}),
        ("robust roof height", {"placing": still, "levels": whole, "drawing": PolygonParameters("paper")}),
        ("outline divided among its roofs", {"placing": still, "levels": whole}),
        ("sloped roofs cut into level ones", {"placing": still}),
        ("outlines moved to the points: the defaults", {}),
        ("the same, outlines drawn from the points", {"drawing": PolygonParameters("points", "levels")}),
    )
    for outline_name in ("outlines", "outlines_shifted_2m"):
        outlines, _ = read_layer(DELFT / f"{outline_name}.gpkg", "lokaalid")
        rows = [(name, *delft.figures(chain(DELFT / "points.laz", outlines, **options))) for name, options in steps]
        print_table(f"Step by step, Delft, {outline_name}", ("steps", *FIGURES), rows)


def cells_table(reference: float) -> None:
    """Speed of each stage on whole 500 m cells, and on the independent city: 300 m of blocks and towers."""
    rows = []
    for name in (*CELLS, *CITY_CLOUDS):
        if name in CELLS:
            points = DATA / "delft_cells" / f"points_{name}.laz"
            outlines, (base,) = read_layer(DATA / "delft_cells" / f"outlines_{name}.gpkg", "z_base")
        else:
            points, base = CITY / "als" / f"{name}.laz", None
            outlines, _ = read_layer(CITY / "footprints" / "gsi_buildings.gpkg", "fid")
        run = chain(points, outlines, None if base is None else np.array(base, float))
        count = len(outlines)
        rows.append((name, count, *(1000 * value / count for value in run.seconds.values()),
                     1000 * sum(run.seconds.values()) / count, sum(run.seconds.values()) / reference,
                     sum(bool(model.solids) for model in run.models)))
    print_table("Delft cells and the independent city: CPU ms a building",
                ("cell", "buildings", "segment buildings", "segment roofs", "roof polygons", "building models", "all",
                 "all / reference", "modelled"), rows)


def delft_tables(reference: float) -> None:
    """All tables of Delft and the independent city, where they are beside the checkout."""
    if not DELFT.is_dir():
        print("\nThe real data are not beside the checkout: models are not scored.")
        return
    delft = Delft.read()
    delft_table(delft)
    sloped_table(delft, chain, score, DELFT)
    steps_table(delft)
    cells_table(reference)


def main() -> int:
    """Print the tables that are named on the command line; all where none is."""
    reference = reference_seconds()
    print(f"Reference: Delaunay triangulation of 200,000 points by scipy, {reference:.2f} s of CPU")
    tables = {"stages": stage_tables, "goals": goals_table, "large": large_roofs_table,
              "delft": lambda: delft_tables(reference), "faults": city_faults.judge, "images": image_kinds_table,
              "warnings": warnings_table}
    for name in sys.argv[1:] or tables:
        tables[name]()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"\nPeak memory of this process: {peak:.0f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
