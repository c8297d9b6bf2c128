"""A run over tiles in real processes: killed in the middle, gone on with, the same in the end."""

from __future__ import annotations

import json
import os
import signal
import time

import numpy as np
import pytest
import shapely

from .conftest import arguments_of

TILE = 40


@pytest.fixture(scope="module")
def town(synthetic, make_cloud, tmp_path_factory):
    """Sixteen buildings, one a tile, in two files of half the area each."""
    folder = tmp_path_factory.mktemp("町")
    plans = [synthetic.rectangle(TILE * column + 12, TILE * row + 12, 16, 14)
             for column in range(4) for row in range(4)]
    blocks = [synthetic.flat(plan, 8.0 + number) for number, plan in enumerate(plans)]
    points, _ = synthetic.Scene(blocks, noise=0.02).points()
    clouds = [make_cloud(folder / f"{number}.laz", *part.T, return_number=1, number_of_returns=1)
              for number, part in enumerate(np.array_split(points[np.argsort(points[:, 0])], 2))]
    outlines = folder / "外周.geojson"
    outlines.write_text(json.dumps({
        "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::6677"}},
        "features": [{"type": "Feature", "properties": {"名": f"家{number}"},
                      "geometry": json.loads(shapely.to_geojson(plan))} for number, plan in enumerate(plans)]},
        ensure_ascii=False), encoding="utf-8")
    return {"POINTS": clouds, "FOOTPRINTS": outlines}


def settings(town, folder, workers):
    return {"ALGORITHM": "buildingsfromals", **town, "TILE": TILE, "BUFFER": 20, "WORKERS": workers,
            "MIN_ROOF_AREA": 20, "OUTPUT": folder / "tiles.gpkg", "OUTPUT_FOLDER": folder / "run"}


@pytest.mark.skipif(os.name == "nt", reason="Windows kills by other means")
def test_a_killed_run_goes_on_and_ends_as_one_that_was_not(linked_profile, town, tmp_path):
    profile = linked_profile()
    whole, cut = tmp_path / "whole", tmp_path / "cut"
    whole.mkdir()
    cut.mkdir()
    done = profile.run_algorithm("urbanmap:tiledrun", **settings(town, whole, 1))
    assert done.code == 0, done.err
    assert done.results["DONE"] == 16
    process = profile.start("run", "urbanmap:tiledrun", "--", *arguments_of(settings(town, cut, 2)),
                            start_new_session=True)
    until = time.monotonic() + 300
    while len(list(cut.glob("run/tiles/*/tile.json"))) < 3:
        assert process.poll() is None and time.monotonic() < until
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    kept = len([path for path in cut.glob("run/tiles/*/tile.json") if not path.parent.name.endswith(".part")])
    assert not (cut / "tiles.gpkg").exists()
    again = profile.run_algorithm("urbanmap:tiledrun", **settings(town, cut, 2))
    assert again.code == 0, again.err
    assert kept <= again.results["KEPT"] < 16 and again.results["DONE"] == 16
    assert (cut / "run/merged/output.gpkg").read_bytes() == (whole / "run/merged/output.gpkg").read_bytes()
    assert not list(cut.glob("run/tiles/*.part"))


def test_a_stage_without_the_setting_is_told(run_algorithm, town, tmp_path):
    done = run_algorithm("urbanmap:tiledrun", **{**settings(town, tmp_path, 1), "MIN_ROFF_AREA": 3, "ESTIMATE": 1})
    assert done.code == 0
    assert "MIN_ROFF_AREA" in done.out + done.err
    assert "Unknown parameter MIN_ROOF_AREA" not in done.out + done.err
