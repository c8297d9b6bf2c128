"""The editable model on the command line, by its id and by its file, beside the chain it is a model of."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

MODEL = "urbanmap:buildingsfromals_model"
EARLIER = "urbanmap:Buildings from ALS (model)"
"""Its id up to version 0.2.0."""
FILE = Path(__file__).resolve().parents[2] / "resources" / "models" / "buildings_from_als.model3"
GROUND = 4.0
ROOFS = {1: ((0.0, 0.0, 14.0, 10.0), 12.0), 2: ((24.0, 0.0, 36.0, 18.0), 21.5)}


@pytest.fixture(scope="module")
def block(tmp_path_factory, make_cloud):
    """Two boxes with exact heights on level ground, one in each of two files, and their outlines."""
    from osgeo import ogr, osr

    folder = tmp_path_factory.mktemp("区画")
    # Half-way between the edges, so that no point lies on one.
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(-9.8, 46.0, 0.4), np.arange(-9.8, 28.0, 0.4)))
    z = np.full(len(x), GROUND)
    for (x0, y0, x1, y1), height in ROOFS.values():
        z[(x > x0) & (x < x1) & (y > y0) & (y < y1)] = height
    classes = np.where(z == GROUND, 2, 6).astype(np.uint8)
    clouds = [make_cloud(folder / f"{name}.laz", x[part], y[part], z[part], classification=classes[part])
              for name, part in (("west", x < 20), ("east", x >= 20))]
    reference = osr.SpatialReference()
    reference.ImportFromEPSG(6677)
    source = ogr.GetDriverByName("GPKG").CreateDataSource(str(folder / "外周.gpkg"))
    layer = source.CreateLayer("外周", reference, ogr.wkbPolygon)
    layer.CreateField(ogr.FieldDefn("building_id", ogr.OFTInteger))
    for number, ((x0, y0, x1, y1), _) in ROOFS.items():
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetField("building_id", number)
        feature.SetGeometry(ogr.CreateGeometryFromWkt(
            f"POLYGON (({x0} {y0}, {x1} {y0}, {x1} {y1}, {x0} {y1}, {x0} {y0}))"))
        layer.CreateFeature(feature)
    source.Destroy()
    return {"POINTS": clouds, "FOOTPRINTS": folder / "外周.gpkg"}


def outputs(folder: Path, prefix: str = "") -> dict[str, Path]:
    """Output parameters into a folder."""
    return {f"{prefix}OUTPUT": folder / "models.gpkg", f"{prefix}OUTPUT_SURFACES": folder / "surfaces.gpkg",
            f"{prefix}OUTPUT_CITYJSON": folder / "models.city.json", f"{prefix}OUTPUT_REPORT": folder / "report.html"}


def features(path: Path) -> list[tuple]:
    """Attributes and geometry of all features of a layer's file."""
    from osgeo import ogr

    source = ogr.Open(str(path))
    return [(feature.items(), bytes(feature.GetGeometryRef().ExportToWkb())) for feature in source.GetLayer(0)]


@pytest.fixture(scope="module")
def chain(block, run_algorithm, tmp_path_factory):
    """Folder with the results of the chain."""
    folder = tmp_path_factory.mktemp("chain")
    done = run_algorithm("urbanmap:buildingsfromals", **block, **outputs(folder))
    assert done.code == 0, done.err
    assert "Step: Segment roofs" in done.out
    inner = (".urbanmap-", "processing_", "Results: {")
    assert not [mark for mark in inner if mark in done.out + done.err]
    return folder


@pytest.mark.parametrize("algorithm", [EARLIER, str(FILE)], ids=["by its earlier id", "by its file"])
def test_the_model_gives_what_the_chain_gives(algorithm, block, chain, run_algorithm, tmp_path):
    done = run_algorithm(algorithm, **block, **outputs(tmp_path, "buildingmodels:"))
    assert done.code == 0, done.err
    assert (tmp_path / "models.city.json").read_bytes() == (chain / "models.city.json").read_bytes()
    for name in ("models.gpkg", "surfaces.gpkg"):
        assert features(tmp_path / name) == features(chain / name)
    assert (tmp_path / "report.html").stat().st_size > 0


def test_settings_reach_the_steps(block, run_algorithm, tmp_path):
    done = run_algorithm(MODEL, **block, **outputs(tmp_path, "buildingmodels:"), EXPANSION=1.75, HEIGHT="maximum")
    assert done.code == 0, done.err
    report = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "<th>Expansion (m)</th><td>1.75</td>" in report and "<th>Roof height</th><td>maximum</td>" in report
