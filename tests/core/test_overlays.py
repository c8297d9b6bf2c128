"""Overlays on images: edges and points lie where a formula of its own puts them, and what is hidden is left out."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
import rasterio
import shapely
from rasterio.transform import from_origin

from urbanmap_qgis.aerial.frames.camera import ExteriorOrientation, FrameCamera
from urbanmap_qgis.aerial.frames.frame_images import AerialFrame
from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.imagery.overlays.edge_lines import edge_samples, edge_segments
from urbanmap_qgis.imagery.overlays.overlay_layers import BLOCK, nearest_points, visible_edges
from urbanmap_qgis.imagery.overlays.overlay_pictures import Overlay, PointColours, best_windows, draw
from urbanmap_qgis.imagery.overlays.overlay_stage import NO_POINTS, OverlayState, write_overlays
from urbanmap_qgis.imagery.overlays.roof_heights import NO_ROOFS, roof_heights
from urbanmap_qgis.imagery.views.orthophoto_source import orthophoto_source
from urbanmap_qgis.imagery.views.views import FrameSource

X, Y, Z = -7000.0, -34000.0, 10.0
WIDTH, DEPTH, HEIGHT = 16.0, 10.0, 9.0


def box(width=WIDTH, depth=DEPTH, height=HEIGHT, x=X, y=Y, z=Z):
    """Faces of a box, counterclockwise seen from outside."""
    steps = np.array([[i * width, j * depth, k * height] for k in (0, 1) for j in (0, 1) for i in (0, 1)])
    rings = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    return shapely.MultiPolygon([shapely.Polygon((np.array([x, y, z]) + steps)[list(ring)]) for ring in rings])


def frame(tmp_path, centre=(X + 40.0, Y - 30.0, Z + 120.0)):
    """A level frame of 0.1 m pixels at the ground, 1200 by 1000, seen from the south-east."""
    camera = FrameCamera(focal_length=120.0, pixel_pitch=0.1, width=1200, height=1000)
    path = tmp_path / "frame.png"
    cv2.imwrite(str(path), np.full((1000, 1200, 3), 90, np.uint8))
    pose = ExteriorOrientation("frame.png", *centre, 0.0, 0.0, 0.0)
    return FrameSource(0, path.name, AerialFrame(path, pose), camera)


@pytest.fixture
def source(tmp_path):
    return frame(tmp_path)


def by_hand(place, centre=(X + 40.0, Y - 30.0, Z + 120.0)):
    """Column and row of places in the level frame, by similar triangles."""
    scale = 1200.0 / (centre[2] - place[:, 2])  # pixels a metre
    return np.column_stack([599.5 + scale * (place[:, 0] - centre[0]), 499.5 - scale * (place[:, 1] - centre[1])])


def test_a_box_has_twelve_edges_and_no_diagonals():
    assert len(edge_segments([box()])) == 12
    halves = shapely.MultiPolygon([*box().geoms, *shapely.affinity.translate(box(), WIDTH).geoms])
    # The wall between them belongs to both, its upper and lower edges lie in flat roofs and floors.
    assert len(edge_segments([halves])) >= 20
    gable = shapely.MultiPolygon([shapely.Polygon([(0, 0, 5), (4, 0, 5), (4, 4, 5)]),
                                  shapely.Polygon([(0, 0, 5), (4, 4, 5), (0, 4, 5)])])
    assert len(edge_segments([gable])) == 4  # the diagonal of a flat roof is no edge
    line = shapely.LineString([(0, 0, 1), (3, 0, 1), (3, 4, 1)])
    samples = edge_samples(edge_segments([line]), 0.5)
    assert np.bincount(samples.edge).tolist() == [7, 9]
    assert np.abs(np.diff(samples.place[samples.edge == 1], axis=0)).max() == pytest.approx(0.5)


def test_lines_without_heights_are_refused():
    with pytest.raises(InputError, match="have no heights"):
        edge_segments([shapely.LineString([(0, 0), (1, 0)])])
    assert edge_segments([]).shape == (0, 2, 3)


@pytest.mark.paper("Z 4.1")
def test_edges_lie_where_the_formula_puts_them_and_hidden_ones_are_missing(source):
    model = box()
    drawn = visible_edges(source, edge_samples(edge_segments([model])), 60.0, roof_heights([model]))
    corners = np.array([(X + i * WIDTH, Y + j * DEPTH, Z + HEIGHT)
                        for i, j in ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))])
    roof = shapely.LineString(by_hand(corners))
    east_foot = shapely.LineString(by_hand(np.array([(X + WIDTH, Y, Z), (X + WIDTH, Y + DEPTH, Z)])))
    west_foot = shapely.LineString(by_hand(np.array([(X, Y + 1, Z), (X, Y + DEPTH - 1, Z)])))
    pieces = shapely.linestrings(np.stack([drawn.start, drawn.end], axis=1))
    whole = shapely.union_all(shapely.buffer(pieces, 0.5))
    for seen, truth in ((True, roof), (True, east_foot), (False, west_foot)):
        share = truth.intersection(whole).length / truth.length
        assert (share > 0.97) if seen else (share < 0.05)


def test_a_nearer_surface_hides_the_points_behind_it(source):
    roof = np.array([(X + 2 + 0.05 * i, Y + 2 + 0.05 * j, Z + 9.0) for i in range(100) for j in range(100)])
    below = roof - np.array([0.0, 0.0, 9.0])
    ((drawn),) = nearest_points([source], [(below, np.zeros(len(below))), (roof, np.ones(len(roof)))], 60.0, NO_ROOFS)
    patch = shapely.convex_hull(shapely.multipoints(by_hand(roof))).buffer(-3 * BLOCK)
    inside = shapely.contains_xy(patch, drawn.column, drawn.row)
    assert inside.sum() > 100 and (drawn.value[inside] == 1.0).all()
    doubled = [(np.vstack([roof, roof]), np.ones(2 * len(roof))), (below, np.zeros(len(below)))]
    again, = nearest_points([source], doubled, 60.0, NO_ROOFS)
    assert len(again) == len(drawn)  # neither doubling nor order changes anything


def test_models_hide_the_points_below_them(source):
    below = np.array([(X + 1 + i, Y + 1 + j, Z) for i in range(14) for j in range(8)], float)
    beside = below + np.array([0.0, -20.0, 0.0])
    ((drawn),) = nearest_points([source], [(np.vstack([below, beside]), np.zeros(224))], 60.0, roof_heights([box()]))
    truth = by_hand(beside)
    found = np.column_stack([drawn.column, drawn.row])
    assert len(drawn) == len(beside)
    assert np.abs(np.sort(found[:, 1]) - np.sort(truth[:, 1])).max() <= BLOCK


def test_sloped_roofs_hide_by_their_own_heights():
    roof = shapely.Polygon([(0, 0, 0), (10, 0, 10), (10, 10, 10), (0, 10, 0)])
    heights = roof_heights([shapely.MultiPolygon([roof])])
    place, camera = np.array([[2.0, 5.0, 4.0], [8.0, 5.0, 4.0]]), np.array([[2.0, -50.0, 4.0], [8.0, -50.0, 4.0]])
    assert heights.hidden(place, camera, 0.5).tolist() == [False, True]


def test_upright_edges_of_a_block_seen_obliquely_are_drawn_where_a_wall_beside_them_is_seen():
    """Blocks turned in every way, cameras all round: of a convex block an edge is seen if a wall beside it is."""
    rng = np.random.default_rng(5)
    shares = {True: [], False: []}
    for turn, azimuth, distance, fall in zip(rng.uniform(0, 90, 40), rng.uniform(0, 2 * np.pi, 40),
                                             rng.uniform(30, 600, 40), rng.uniform(2, 40, 40)):
        block = shapely.affinity.rotate(shapely.box(-7, -4.5, 7, 4.5), turn)
        roof = shapely.force_3d(block, 20.0)
        heights = roof_heights([shapely.MultiPolygon([roof])])
        camera = np.array([distance * np.cos(azimuth), distance * np.sin(azimuth),
                           1.5 + distance * np.tan(np.radians(fall))])
        ring = shapely.get_coordinates(shapely.geometry.polygon.orient(block).exterior)
        walls = np.stack([ring[:-1], ring[1:]], axis=1)
        along = walls[:, 1] - walls[:, 0]
        faces = (camera[0] - walls[:, 0, 0]) * along[:, 1] - (camera[1] - walls[:, 0, 1]) * along[:, 0] > 0
        for corner, wall, before in zip(ring[:-1], faces, np.roll(faces, 1)):
            place = np.column_stack([np.tile(corner, (76, 1)), np.linspace(0.5, 19.5, 76)])
            shares[bool(wall or before)].append(np.mean(~heights.hidden(place, np.tile(camera, (76, 1)), 0.5)))
    assert len(shares[False]) > 20 and min(shares[True]) == 1.0  # 0.92 in the mean with cells that reach out
    assert np.mean(shares[False]) < 0.05


@pytest.fixture
def orthophoto(tmp_path):
    path = tmp_path / "正射.tif"
    with rasterio.open(path, "w", driver="GTiff", width=400, height=300, count=3, dtype="uint8", crs="EPSG:6677",
                       transform=from_origin(X - 10, Y + 20, 0.1, 0.1)) as target:
        target.write(np.full((3, 300, 400), 60, np.uint8))
    return path


def test_an_orthophoto_shows_roofs_in_their_places(orthophoto):
    source, model = orthophoto_source(orthophoto), box()
    drawn = visible_edges(source, edge_samples(edge_segments([model])), 60.0, roof_heights([model]))
    low, high = drawn.start.min(axis=0), drawn.start.max(axis=0)
    assert low == pytest.approx([99.5, 99.5], abs=0.01) and high == pytest.approx([259.5, 199.5], abs=0.01)


def test_drawing_marks_the_pixels_and_leaves_the_rest(orthophoto):
    source, model = orthophoto_source(orthophoto), box()
    edges = visible_edges(source, edge_samples(edge_segments([model])), 60.0, roof_heights([model]))
    made = draw(source.window(0, 0, 400, 300), Overlay(NO_POINTS, edges), PointColours("one"))
    assert (made[100, 150] != 60).any() and (made[150, 150] == 60).all() and (made[20, 20] == 60).all()
    assert best_windows(source, Overlay(NO_POINTS, edges), 3) == [(0, 0, 400, 300)]


def test_states_are_drawn_beside_each_other(orthophoto, tmp_path):
    source = orthophoto_source(orthophoto)
    states = [OverlayState(name, [source], None, edge_samples(edge_segments([model])), roof_heights([model]))
              for name, model in (("before", box(x=X + 3.0)), ("after", box()))]
    (record,) = write_overlays(states, tmp_path / "絵", tmp_path / "page.html", "height", 60.0, 4)
    assert record.edges[0] == pytest.approx(record.edges[1], rel=0.02) and record.points == (0, 0)
    names = sorted(path.name for path in (tmp_path / "絵").iterdir())
    assert names == ["正射_0_0_before_after.jpg", "正射_after.jpg", "正射_before.jpg"]
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert page.count("data:image/jpeg") == 3 and page.count('type="radio"') == 3 and "before" in page


def test_data_of_another_place_are_refused(orthophoto, tmp_path):
    state = OverlayState("overlay", [orthophoto_source(orthophoto)], None, edge_samples(edge_segments([box(x=0.0)])),
                         NO_ROOFS)
    with pytest.raises(InsufficientDataError, match="Nothing lies in any"):
        write_overlays([state], tmp_path / "out", None, "height", 60.0, 4)
    assert not (tmp_path / "out").exists()


def test_colours_tell_values():
    low, high = PointColours("height", 0.0, 10.0).of(np.array([0.0, 10.0])).astype(int)
    assert low[2] > low[0] and high[0] > high[2]
    assert PointColours("class").of(np.array([6, 250])).tolist() == [[226, 88, 62], [200, 200, 255]]


def test_colours_of_points_run_from_low_to_high():
    values = np.array([0.0, 0.25, 0.5, 1.0])
    assert (PointColours("height", 10.0, 30.0).of(10.0 + 20.0 * values) == PointColours("height").of(values)).all()
    below, above = PointColours("height", 10.0, 30.0).of(np.array([-50.0, 90.0]))
    ends = PointColours("height").of(np.array([0.0, 1.0]))
    assert (below == ends[0]).all() and (above == ends[1]).all()
