"""A junction whose ways are inferred and a roundabout, in the hands of the programs that take lane maps."""

from __future__ import annotations

import subprocess

import numpy as np
import pyproj
import pytest

from tests.core import laid_out_roads as roads
from tests.core.lane_map_judges import here, judge, loaded_by, opendrive_issues
from tests.core.test_lane_movements import arms, drives, stops
from urbanmap_qgis.io.osm import write_osm
from urbanmap_qgis.roadmap.checks.map_check import check_map
from urbanmap_qgis.roadmap.formats.lanelet_map import META, lanelet_elements
from urbanmap_qgis.roadmap.formats.opendrive_map import opendrive_tree, write_opendrive
from urbanmap_qgis.roadmap.map_records import DrivenPath, MapLine
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings

WKT = pyproj.CRS.from_epsg(6677).to_wkt()


def junction():
    """Four arms with stop lines, crosswalks before two and ways that arrows and the rule of the road infer."""
    areas = [roads.zebra(63, 67, -7, 7), roads.zebra(83, 87, -7, 7), roads.arrow(50, 5.2), roads.arrow(50, 1.7),
             roads.arrow(100, -5.2, back=True), roads.arrow(100, -1.7, back=True)]
    return build_vector_map([*arms(), *stops()], areas, drives(), MapSettings(way_confidence=0.0))


def roundabout():
    """One lane that leads round, its outer line open at two entries."""
    def ring(radius, first, last):
        turn = np.linspace(first, last, 120)
        return MapLine(roads.place(np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])), "solid")

    turn = np.linspace(4 * np.pi, 0.0, 200)
    drive = DrivenPath(roads.place(np.column_stack([14 * np.cos(turn), 14 * np.sin(turn)])))
    lines = [ring(12.0, 0.05, 2 * np.pi - 0.05), ring(16.0, 0.2, np.pi - 0.2), ring(16.0, np.pi + 0.2, 2 * np.pi - 0.2)]
    return build_vector_map(lines, (), [drive], MapSettings(traffic="left"))


@pytest.fixture(scope="module", params=[junction, roundabout])
def built(request):
    made = request.param()
    assert len(made.lanes) > 2
    return made


@pytest.mark.parametrize("dialect", ["lanelet2", "autoware"])
def test_lanelet2_and_the_rules_of_autoware_find_nothing(built, dialect, tmp_path):
    elements, coordinates = lanelet_elements(built, WKT, speed_limit=40, dialect=dialect)
    path = tmp_path / "map.osm"
    write_osm(path, elements, META)
    assert [fault for fault in check_map(elements) if fault.severity == "error"] == []
    lanelets = sum(one.tags["type"] == "lanelet" for one in elements.relations.values())
    rules = sum(one.tags["type"] == "regulatory_element" for one in elements.relations.values())
    wanted = [lanelets, rules, [], []]
    assert loaded_by(here(), path, coordinates.origin, "autoware") == wanted
    if dialect == "lanelet2":
        assert loaded_by(judge("python"), path, coordinates.origin) == wanted


def test_asams_checker_and_sumo_find_nothing(built, tmp_path):
    path = tmp_path / "map.xodr"
    write_opendrive(path, opendrive_tree(built, WKT, 40.0)[0])
    assert opendrive_issues(path, tmp_path) == []
    done = subprocess.run([judge("netconvert"), "--opendrive-files", str(path), "-o", str(tmp_path / "net.xml")],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "Error" not in done.stderr
