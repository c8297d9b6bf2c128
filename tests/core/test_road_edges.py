"""Kerbs, rails and walls of a made-up street of known geometry."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import cKDTree

from tests.core.road_scene import KERB_AT, RAIL_AT, WALL_AT, Street, to_local, write_drive
from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.roadmap.edges.assembly import kerb_lines
from urbanmap_qgis.roadmap.edges.bare_sides import bare_sides
from urbanmap_qgis.roadmap.edges.doubts import with_doubts, with_low_doubts
from urbanmap_qgis.roadmap.edges.edge_points import EdgeTile
from urbanmap_qgis.roadmap.edges.edge_records import BORDER, KERB, LOWERED, MEASURED, RoadEdge
from urbanmap_qgis.roadmap.edges.profile import fit_edge_profile, most_likely_change
from urbanmap_qgis.roadmap.edges.road_edges import road_edges
from urbanmap_qgis.roadmap.edges.stations import Stations
from urbanmap_qgis.roadmap.edges.uprights import upright_candidates
from urbanmap_qgis.settings.roadmap import EdgeSettings

SETTINGS = EdgeSettings(survey_sigma=0.0)


def edges_of(tmp_path, street, angle=0.0, passes=1, settings=SETTINGS):
    trajectory = write_drive(tmp_path / "drive.las", street, angle, passes)
    return road_edges([tmp_path / "drive.las"], trajectory, settings)


def across(edge, angle):
    return to_local(edge.foot, angle)[:, 1]


@pytest.mark.parametrize("angle", [0.0, 25.0, 77.0, 200.0])
def test_a_kerb_lies_where_it_is_whatever_its_direction(tmp_path, angle):
    found = edges_of(tmp_path, Street(), angle)
    kerb, = found.edges
    assert found.path_length > 57.0
    assert (kerb.kind, kerb.status) == ("kerb", "measured") and kerb.length > 57.0
    assert np.abs(across(kerb, angle) - KERB_AT).max() < 0.02
    assert kerb.height == pytest.approx(0.12, abs=0.005)
    assert np.abs(to_local(kerb.foot, angle)[:, 2] + 0.04).max() < 0.015
    assert 0.0003 < kerb.sigma < 0.01 and kerb.completeness > 0.95


@pytest.mark.slow
def test_a_kerb_low_all_along_is_measured_where_steps_of_its_height_show(tmp_path):
    found = edges_of(tmp_path, Street(kerb=0.05))
    kerb, = found.edges
    assert (kerb.kind, kerb.status) == ("kerb", "measured") and kerb.length > 55.0
    assert 0.03 < found.least_step < 0.05 and kerb.height == pytest.approx(0.05, abs=0.003)
    off = across(kerb, 0.0) - KERB_AT
    assert np.abs(off).max() < 0.02 and (np.abs(off) < 2 * kerb.sigma).all()


def test_a_kerb_of_two_centimetres_is_not_found_and_is_lower_than_the_least_step(tmp_path):
    found = edges_of(tmp_path, Street(kerb=0.02, length=30.0))
    assert not found.edges and found.least_step > 0.03


def test_the_least_step_grows_with_the_noise_and_with_fewer_points(tmp_path, monkeypatch):
    street = Street(kerb=0.0, length=30.0)
    usual, sparse = (edges_of(tmp_path, one).least_step for one in (street, replace(street, spacing=0.15)))
    monkeypatch.setattr("tests.core.road_scene.NOISE", 0.015)
    assert min(sparse, edges_of(tmp_path, street).least_step) > usual + 0.01


def test_two_passes_are_surer_than_one(tmp_path):
    once, = edges_of(tmp_path, Street(length=30.0)).edges
    twice, = edges_of(tmp_path, Street(length=30.0), passes=2).edges
    assert (once.passes, twice.passes) == (1, 2) and twice.points > 1.8 * once.points
    assert twice.sigma < 0.9 * once.sigma
    assert np.abs(across(twice, 0.0) - KERB_AT).max() < 0.012


def test_no_kerb_no_edge(tmp_path):
    assert not edges_of(tmp_path, Street(kerb=0.0)).edges


@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 33.0])
def test_grass_beside_the_road_is_its_border(tmp_path, angle):
    border, = edges_of(tmp_path, Street(kerb=0.0, rough=0.04), angle).edges
    assert (border.kind, border.status) == ("road border", "measured") and border.length > 55.0
    off = across(border, angle) + Street().verge
    assert np.sqrt(np.mean(off**2)) < 0.04 and np.mean(np.abs(off) < 2 * border.sigma) > 0.93


@pytest.mark.slow
def test_a_lowered_place_is_a_section_of_its_own(tmp_path):
    # The ground behind is lowered too: its own borders, which run away from the road, are steps as well.
    edges = [edge for edge in edges_of(tmp_path, Street(lowered=(25.0, 30.0))).edges if across(edge, 0.0).max() < 4.3]
    assert [edge.kind for edge in sorted(edges, key=lambda edge: to_local(edge.foot, 0.0)[:, 0].min())] == [
        "kerb", "lowered kerb", "kerb"]
    low = next(edge for edge in edges if edge.kind == "lowered kerb")
    assert 3.5 < low.length < 6.5 and low.height < 0.05
    assert np.abs(across(low, 0.0) - KERB_AT).max() < 0.05
    assert len({edge.chain for edge in edges}) == 1


@pytest.mark.slow
def test_nothing_is_drawn_where_nothing_is_seen(tmp_path):
    first, second = sorted(edges_of(tmp_path, Street(hidden=(25.0, 31.0))).edges,
                           key=lambda edge: to_local(edge.foot, 0.0)[:, 0].min())
    along = [to_local(edge.foot, 0.0)[:, 0] for edge in (first, second)]
    assert along[0].max() < 25.6 and along[1].min() > 30.4
    assert first.chain == second.chain and max(first.gap, second.gap) == pytest.approx(
        along[1].min() - along[0].max(), abs=0.1)


@pytest.mark.slow
def test_rail_and_wall_stand_where_they_are(tmp_path):
    rail = [edge for edge in edges_of(tmp_path, Street(rail=0.8)).edges if edge.kind == "guard rail"]
    wall = [edge for edge in edges_of(tmp_path, Street(wall=2.5)).edges if edge.kind == "wall"]
    for (edge,), at, height in ((rail, RAIL_AT, 0.92), (wall, WALL_AT, 2.62)):
        assert edge.status == "measured" and edge.length > 55.0
        assert np.abs(across(edge, 0.0) - at).max() < 0.02
        assert edge.height == pytest.approx(height, abs=0.14)


def straight(kind, at, height, start=0.0, end=40.0):
    foot = np.column_stack([np.arange(start, end, 0.5), *np.full((2, int(2 * (end - start))), at)])
    foot[:, 2] = 0.0
    top = foot + np.array([0.0, 0.0, height])
    return RoadEdge(kind, foot, top, height, 0.01, 0.01, 100, 1, 1.0, 0, 0.0, "measured", "")


def test_what_stands_before_the_kerb_may_be_a_vehicle():
    path = np.column_stack([np.arange(0.0, 40.0, 0.5), np.zeros(80)])
    edges = [straight("kerb", 4.0, 0.12), straight("guard rail", 4.2, 0.8), straight("wall", 2.5, 2.7),
             straight("wall", 7.0, 2.7), straight("wall", 6.0, 1.5, 10.0, 14.0), straight("wall", 2.5, 9.0)]
    told = with_doubts(edges, path, 40.0)
    assert [edge.status for edge in told] == ["measured", "measured", "doubtful", "measured", "doubtful", "measured"]
    assert "no kerb lies before it" in told[2].reason
    assert with_doubts(edges[1:], path, 40.0) == edges[1:], "a road without kerbs tells nothing"


def test_a_short_kerb_lower_than_the_survey_shows_is_doubtful():
    """Not one of a chain that shows elsewhere, nor one that goes on as no scatter does."""
    chains = [[("kerb", 0.04, 4.0)], [("kerb", 0.04, 4.0), ("lowered kerb", 0.02, 3.0), ("kerb", 0.12, 4.0)],
              [("kerb", 0.04, 16.0)], [("wall", 0.04, 4.0)]]
    edges = [replace(straight(kind, 4.0, height, 0.0, length), chain=number)
             for number, chain in enumerate(chains) for kind, height, length in chain]
    told = with_low_doubts(edges, 0.05)
    assert [edge.status for edge in told] == ["doubtful", *["measured"] * 5]
    assert "lower than the steps" in told[0].reason and told[0].height == 0.04
    assert with_low_doubts(edges, 0.03) == edges and with_low_doubts(edges, float("nan")) == edges


@pytest.mark.slow
def test_a_kerb_before_a_rail_is_found(tmp_path):
    kerb = [edge for edge in edges_of(tmp_path, Street(rail=0.8)).edges if edge.kind == "kerb"]
    assert sum(edge.length for edge in kerb) > 50.0
    assert max(np.abs(across(edge, 0.0) - KERB_AT).max() for edge in kerb) < 0.02


@pytest.mark.slow
def test_steps_of_a_stair_are_no_kerb_higher_than_asked(tmp_path):
    found = edges_of(tmp_path, Street(kerb=0.28), settings=EdgeSettings(max_height=0.2, survey_sigma=0.0))
    assert not [edge for edge in found.edges if edge.kind == "kerb"]


def test_thinned_points_are_refused(tmp_path):
    trajectory = write_drive(tmp_path / "drive.las", Street(spacing=0.6))
    with pytest.raises(InsufficientDataError, match="ground points a square metre"):
        road_edges([tmp_path / "drive.las"], trajectory)


def test_points_of_another_height_are_refused(tmp_path):
    trajectory = write_drive(tmp_path / "drive.las", Street(length=20.0))
    with pytest.raises(InsufficientDataError, match="beside the path"):
        road_edges([tmp_path / "drive.las"],
                   replace(trajectory, place=trajectory.place + np.array([0.0, 0.0, 60.0])))


@pytest.mark.parametrize("lean", [0.0, 0.06])
def test_a_leaning_face_parts_foot_and_top(lean):
    rng = np.random.default_rng(3)
    a = rng.uniform(-1.2, 1.2, 400)
    z = np.clip((a - 0.05) / max(lean, 1e-9) * 0.12, 0.0, 0.12) if lean else np.where(a > 0.05, 0.12, 0.0)
    face_z = rng.uniform(0.0, 0.12, 40)
    a, z = np.append(a, 0.05 + lean * face_z / 0.12), np.append(z, face_z)
    fit = fit_edge_profile(a + 0.004 * rng.standard_normal(len(a)), z + 0.004 * rng.standard_normal(len(a)))
    assert fit.foot == pytest.approx(0.05, abs=0.012) and fit.top == pytest.approx(0.05 + lean, abs=0.012)
    assert fit.height == pytest.approx(0.12, abs=0.004) and fit.sigma < 0.005


@pytest.mark.parametrize("slope", [-0.2, -0.1, 0.1, 0.2])
def test_a_kerb_beside_a_sloping_gutter_stays_where_it_is(slope):
    """A kerb of 15 cm at 0, the road falls or rises towards it; the face's foot and top lie there."""
    rng = np.random.default_rng(1)
    a = np.concatenate([np.arange(-1.2, -0.005, 0.01), np.arange(0.005, 1.2, 0.01)])
    face = np.linspace(0.01, 0.14, 8)
    z = np.append(np.where(a < 0, slope * a, 0.15 + 0.02 * a), face)
    a = np.append(a, np.zeros(8))
    fit = fit_edge_profile(a + rng.normal(0, 0.002, len(a)), z + rng.normal(0, 0.002, len(z)))
    assert (fit.foot, fit.top) == pytest.approx((0.0, 0.0), abs=0.004) and fit.sigma < 0.004
    assert (fit.z_foot, fit.z_top) == pytest.approx((0.0, 0.15), abs=0.005)


def test_a_profile_needs_both_sides():
    a = np.linspace(-1.0, -0.05, 100)
    assert fit_edge_profile(a, np.zeros(100)) is None


def test_an_edge_counts_the_points_of_both_its_sides():
    rng = np.random.default_rng(3)
    a = np.concatenate([np.linspace(-0.5, -0.02, 60), np.linspace(0.02, 0.5, 40)])
    profile = fit_edge_profile(a, np.where(a > 0, 0.15, 0.0) + rng.normal(0, 0.002, len(a)))
    assert profile.height == pytest.approx(0.15, abs=0.005)
    assert 60 <= profile.points <= 100


def test_lowered_and_full_kerb_share_the_station_where_they_meet():
    count = 40
    height = np.where(np.arange(count) < 20, 0.15, 0.02)
    zeros, ones = np.zeros(count), np.ones(count)
    stations = Stations(
        course=np.zeros(count, int), place=np.column_stack([0.5 * np.arange(count), zeros]),
        normal=np.column_stack([zeros, ones]), seen=np.ones(count, bool), foot=zeros.copy(), top=zeros.copy(),
        z_foot=zeros.copy(), z_top=height, sigma=0.01 * ones, sigma_z=0.01 * ones, points=np.full(count, 20),
        passes=np.ones(count, int))
    full, low = kerb_lines(stations, EdgeSettings(), np.zeros(3))
    assert full.foot[-1] == pytest.approx(low.foot[0]) and full.gap == pytest.approx(0.0)
    assert low.foot[-1, 0] == pytest.approx(0.5 * (count - 1))


def test_deviation_of_a_change_grows_with_the_gap_that_it_lies_in():
    """Two descriptions that part sharply between -0.1 and 0.1 m: any place in the gap is as likely."""
    places = np.array([-0.4, -0.3, -0.2, -0.1, 0.1, 0.2, 0.3, 0.4])
    before, after = np.where(places < 0, 0.0, 100.0), np.where(places < 0, 100.0, 0.0)
    edge, sigma = most_likely_change(places, before, after, 0.5)
    assert edge == pytest.approx(0.0, abs=1e-6) and sigma == pytest.approx(0.2 / 12**0.5, rel=1e-3)


# How much of a drive has no kerb beside it


PATH = np.column_stack([np.linspace(0.0, 100.0, 201), np.zeros(201), np.zeros(201)])


def edge(kind: str, start: float, end: float, north: float) -> RoadEdge:
    foot = np.array([[start, north, 0.0], [end, north, 0.0]])
    return RoadEdge(kind, foot, foot + np.array([0.0, 0.0, 0.15]), 0.15, 0.01, 0.01, 100, 1, 1.0, 0, 0.0, MEASURED, "")


def test_kerbs_on_either_side_are_counted_on_it():
    edges = [edge(KERB, 0.0, 60.0, 4.0), edge(LOWERED, 60.0, 70.0, 4.0), edge(KERB, 0.0, 20.0, -5.0)]
    assert bare_sides(edges, PATH, 10.0) == pytest.approx((30.0, 80.0), abs=1.0)
    assert bare_sides(edges, PATH[::-1], 10.0) == pytest.approx((80.0, 30.0), abs=1.0)


def test_borders_and_kerbs_out_of_reach_are_none():
    edges = [edge(BORDER, 0.0, 100.0, 4.0), edge(KERB, 0.0, 100.0, -15.0)]
    assert bare_sides(edges, PATH, 10.0) == pytest.approx((100.0, 100.0))
    assert bare_sides([], PATH, 10.0) == pytest.approx((100.0, 100.0))
    assert bare_sides([], PATH[:1].repeat(2, axis=0), 10.0) == (0.0, 0.0)


@pytest.mark.parametrize(("points", "cells"), [(3, 14), (2, 0)])
def test_a_cell_with_few_points_is_no_upright(points, cells):
    """A rail along y at x = 5.05, so many points in each cell from 0.3 to 0.9 m; its ends tell no direction."""
    along, up = np.meshgrid(2.05 + 0.1 * np.arange(16), np.linspace(0.3, 0.9, points), indexing="ij")
    record = np.zeros(along.size, [("x", "<f8"), ("y", "<f8"), ("z", "<f8")])
    record["x"], record["y"] = 5.05, along.ravel()
    found = upright_candidates(EdgeTile(np.zeros(2), record), up.ravel(), cKDTree([[0.0, 3.0]]))
    assert len(found.place) == cells and (found.normal[:, 0] > 0.99).all()
