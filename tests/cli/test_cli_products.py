"""The same bytes with one worker, which is QGIS's own process, and with two, which are plain Python."""

from __future__ import annotations

import json

import numpy as np
import pytest
import shapely
import shapely.affinity


@pytest.fixture(scope="module")
def town(synthetic, make_cloud, tmp_path_factory):
    """Eight houses with gabled roofs: planes are fitted by products of matrices."""
    folder = tmp_path_factory.mktemp("屋根")
    plans = [shapely.affinity.rotate(synthetic.rectangle(30 * (number % 4), 30 * (number // 4), 14, 9), 7 * number)
             for number in range(8)]
    points, _ = synthetic.Scene([synthetic.flat(plan, 7.0) for plan in plans], noise=0.02).points()
    for plan in plans:  # lift the roofs to a ridge along each plan's long side
        inside = shapely.contains_xy(plan, *points[:, :2].T) & (points[:, 2] > 5)
        away = points[inside, :2] - [plan.centroid.x, plan.centroid.y]
        corners = np.array(plan.exterior.coords)
        sides = np.diff(corners, axis=0)
        along = sides[np.argmax(np.hypot(*sides.T))]
        points[inside, 2] += 3.0 - 0.5 * np.abs(away @ [-along[1], along[0]]) / np.hypot(*along)
    cloud = make_cloud(folder / "点群.laz", *points.T, return_number=1, number_of_returns=1)
    outlines = folder / "外周.geojson"
    outlines.write_text(json.dumps({
        "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::6677"}},
        "features": [{"type": "Feature", "properties": {"n": number}, "geometry": shapely.geometry.mapping(plan)}
                     for number, plan in enumerate(plans)]}), encoding="utf-8")
    return {"POINTS": cloud, "FOOTPRINTS": outlines}


@pytest.mark.once
def test_one_worker_and_two_give_the_same_bytes(run_algorithm, town, tmp_path):
    for workers in (1, 2):
        (tmp_path / str(workers)).mkdir()
        done = run_algorithm("urbanmap:buildingsfromals", **town, WORKERS=workers, MIN_ROOF_AREA=10,
                             OUTPUT=tmp_path / str(workers) / "models.gpkg",
                             OUTPUT_CITYJSON=tmp_path / str(workers) / "models.city.json")
        assert done.code == 0, done.err
    one, two = (json.loads((tmp_path / str(number) / "models.city.json").read_text(encoding="utf-8"))
                for number in (1, 2))
    assert [one["CityObjects"][item] for item in one["CityObjects"]] == list(two["CityObjects"].values())
    for name in ("models.gpkg", "models.city.json"):
        assert (tmp_path / "1" / name).read_bytes() == (tmp_path / "2" / name).read_bytes()
