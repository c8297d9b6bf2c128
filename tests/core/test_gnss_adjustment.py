"""From signals to moved walls: classes of signals, clocks, observations, offsets, buildings."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.geometry.solid_faces import solids_of
from urbanmap_qgis.gnss.rays.reflections import LOS, NLOS, REFLECTED, trace
from urbanmap_qgis.gnss.rays.wall_faces import building_walls, wall_table
from urbanmap_qgis.gnss.signals.tables import Epochs, Signals
from urbanmap_qgis.gnss.walls.adjustment import ADJUSTED, LIKELY, NOT_OBSERVABLE, adjust_walls
from urbanmap_qgis.gnss.walls.moved_buildings import PlanNet, applied_offsets, move_buildings, moved_walls
from urbanmap_qgis.gnss.walls.offset_observations import OffsetObservations
from urbanmap_qgis.gnss.walls.offset_posterior import ANTENNA, ErrorModel, estimate_offsets
from urbanmap_qgis.gnss.walls.receiver_clock import pass_clocks
from urbanmap_qgis.gnss.walls.residuals import trace_residuals
from urbanmap_qgis.gnss.walls.signal_strength import expected_cn0
from urbanmap_qgis.mobile.trajectory import Trajectory, joined_trajectory
from urbanmap_qgis.settings.gnss import AdjustmentSettings, TraceSettings

# Two rows of blocks, 24 m high, along a street that runs north and is 20 m wide; open ground in the south.
STREET = [shapely.box(x, y, x + 15, y + 30) for x in (-25, 10) for y in (0, 32, 64, 96)]
TOP, LOW = np.full(8, 24.0), np.zeros(8)


def unit(azimuth, elevation):
    azimuth, elevation = np.radians(azimuth), np.radians(elevation)
    return np.column_stack([np.cos(elevation) * np.sin(azimuth), np.cos(elevation) * np.cos(azimuth),
                            np.sin(elevation)])


def signals_of(place, time, azimuth, elevation, residual=0.0, cn0=None, source=0, satellite=None):
    """Signals of all satellites (azimuth, elevation (s,)) at all epochs (place (e, 3), time (e,))."""
    e, s = len(time), len(azimuth)
    epoch = np.repeat(np.arange(e), s)
    names = np.array([f"{'GEC'[k % 3]}{k + 1:02d}" for k in range(s)]) if satellite is None else satellite
    names = np.tile(names, e)
    az, el = np.tile(azimuth, e) % 360.0, np.tile(elevation, e)
    full = np.zeros(e * s)
    cn0 = full + 40.0 if cn0 is None else cn0
    return Signals(Epochs(time, time, place, np.full(e, source)), epoch, time[epoch], names, names.astype("U1"), full,
                   cn0, place[epoch], unit(az, el), el, az, full + residual, full + 0.6, full, full, full,
                   np.zeros(1), 0.0)


def joined_signals(parts):
    from urbanmap_qgis.gnss.signals.tables import join_signals

    return join_signals(parts)


def test_classes_of_signals_in_a_street():
    walls = building_walls(STREET, None, TOP, LOW)
    place = np.array([[0.0, 45.0, 2.0]])
    # The wall on the right (x = 10) hides what is east below atan(22 / 10) = 65.6 degrees. The left wall, as high,
    # reflects it at 64 degrees: the point is 22.5 m up, and the way on leaves the street over the right wall. At 30
    # degrees the point is 7.8 m up and the way on meets the right wall.
    signals = signals_of(place, np.zeros(1), np.array([0.0, 90.0, 90.0, 270.0, 90.0]),
                         np.array([60.0, 75.0, 64.0, 62.0, 30.0]))
    paths = trace(walls, signals, TraceSettings())
    assert paths.kind.tolist() == [LOS, LOS, REFLECTED, REFLECTED, NLOS]
    assert paths.obstacle_distance[4] == pytest.approx(10.0 / np.cos(np.radians(30.0)))
    # With the left wall at 20 m, lower than the point, nothing reflects; and 62 degrees in the west are free.
    paths = trace(building_walls(STREET, None, np.where(np.arange(8) < 4, 20.0, 24.0), LOW), signals, TraceSettings())
    assert paths.kind.tolist() == [LOS, LOS, NLOS, LOS, NLOS]


def test_one_reflection_gives_its_excess_and_two_give_none():
    walls = building_walls([shapely.box(-12, -50, -10, 50), shapely.box(20, -50, 30, 50)], None,
                           np.array([20.0, 60.0]), np.zeros(2))
    signals = signals_of(np.array([[0.0, 0.0, 2.0]]), np.zeros(1), np.array([270.0]), np.array([50.0]))
    paths = trace(walls, signals, TraceSettings())
    assert paths.kind.tolist() == [REFLECTED]
    assert paths.excess()[0] == pytest.approx(2 * 20.0 * np.cos(np.radians(50.0)))
    corner = building_walls([shapely.box(-12, -50, -10, 50), shapely.box(20, -50, 30, 50),
                             shapely.box(-200, 30, 200, 40)], None, np.array([20.0, 60.0, 80.0]), np.zeros(3))
    oblique = signals_of(np.array([[0.0, 0.0, 2.0]]), np.zeros(1), np.array([240.0]), np.array([50.0]))
    assert trace(corner, oblique, TraceSettings()).kind.tolist() in ([NLOS], [REFLECTED])
    assert trace(corner, oblique, TraceSettings()).reflecting_walls[0] >= 1


def test_signals_near_an_edge_are_not_sure():
    walls = building_walls([shapely.box(10, -50, 20, 50)], top=np.array([22.0]), low=np.zeros(1))
    edge = np.degrees(np.arctan2(20.0, 10.0))
    signals = signals_of(np.array([[0.0, 0.0, 2.0]]), np.zeros(1), np.full(4, 90.0),
                         np.array([edge + 1, edge + 8, edge - 2, edge - 15]))
    paths = trace(walls, signals, TraceSettings())
    assert [kind == LOS for kind in paths.kind] == [True, True, False, False]
    assert paths.sure.tolist() == [False, True, False, True]


def test_antenna_in_a_building_is_told_and_all_indoors_is_refused():
    walls = building_walls(STREET, None, TOP, LOW)
    place = np.array([[0.0, 45.0, 2.0], [17.0, 45.0, 2.0]])
    paths = trace(walls, signals_of(place, np.arange(2.0), np.array([0.0]), np.array([80.0])), TraceSettings())
    assert paths.indoors.tolist() == [False, True] and paths.kind.tolist() == [LOS, NLOS]
    with pytest.raises(InsufficientDataError, match="within buildings"):
        trace(walls, signals_of(place[1:], np.zeros(1), np.array([0.0]), np.array([80.0])), TraceSettings())
    with pytest.raises(InsufficientDataError, match="no observation"):
        trace(walls, signals_of(place, np.arange(2.0), np.zeros(0), np.zeros(0)), TraceSettings())


def sky(rng, count=10):
    return rng.uniform(0, 360, count), rng.uniform(35, 85, count)


def simulated_clock(rng, epochs=60, count=10, lasting=0.4, noise=0.5):
    """Signals in line of sight with a clock, offsets of systems, lasting satellite errors and noise; and the clock."""
    azimuth, elevation = sky(rng, count)
    signals = signals_of(np.zeros((epochs, 3)), np.arange(epochs) * 1.0, azimuth, elevation)
    clock = 30.0 * rng.normal() + np.cumsum(rng.normal(0, 3.0, epochs))
    offset = np.array([{"G": 0.0, "E": 4.0, "C": -7.0}[name] for name in signals.system])
    error = np.tile(rng.normal(0, lasting, count), epochs)
    true = clock[signals.epoch] + offset
    return replace(signals, residual=true + error + rng.normal(0, noise, len(signals)),
                   sigma=np.full(len(signals), noise)), true, error


@pytest.mark.parametrize(("noise", "stated"), [(0.5, 0.5), (5.0, 2.5)])
def test_clock_and_offsets_of_systems_are_recovered(noise, stated):
    """Where the signals scatter by twice what is stated of them, that is found."""
    rng = np.random.default_rng(5)
    signals, true, _ = simulated_clock(rng, lasting=0.05, noise=noise)
    signals = replace(signals, sigma=np.full(len(signals), stated))
    (clock,) = pass_clocks(signals, np.ones(len(signals), bool))
    left = signals.residual - true
    assert np.std(clock.clock_corrected - left) < 0.6 * noise
    assert clock.unit_weight == pytest.approx(noise / stated, rel=0.15)


def test_error_of_the_clock_is_as_large_as_its_covariance_says():
    # Two satellites out of sight meet the clock of the others: what is left of them, less their own noise, is the
    # error of clock and offsets and their own lasting error.
    rng = np.random.default_rng(6)
    ratio = []
    for _ in range(60):
        signals, true, error = simulated_clock(rng, epochs=30)
        hidden = np.isin(signals.satellite, ["G01", "E02"])
        (clock,) = pass_clocks(signals, ~hidden)
        for name in ("G01", "E02"):
            rows = signals.satellite == name
            wrong = np.mean(clock.corrected[rows] - (signals.residual - true - error)[rows])
            share = clock.share[rows].mean(axis=0)
            ratio.append(wrong / np.sqrt(share @ clock.covariance @ share + clock.white[rows].mean() / 30))
    assert 0.8 < np.sqrt(np.mean(np.square(ratio))) < 1.25


def test_a_signal_that_is_not_in_sight_after_all_does_not_move_the_clock():
    rng = np.random.default_rng(7)
    signals, true, _ = simulated_clock(rng, lasting=0.2)
    bent = signals.satellite == "C03"
    signals = replace(signals, residual=signals.residual + 25.0 * bent)
    (clock,) = pass_clocks(signals, np.ones(len(signals), bool))
    others = ~bent & np.isin(signals.system, ["G", "E"])
    assert abs(np.median((clock.clock_corrected - (signals.residual - true))[others])) < 0.4
    assert not clock.fit[bent].any()
    assert np.median(clock.clock_corrected[bent]) > 15.0


def test_epochs_with_few_signals_and_systems_out_of_sight_have_no_clock():
    rng = np.random.default_rng(8)
    signals, _, _ = simulated_clock(rng)
    is_los = (signals.system != "C") & ((signals.epoch != 4) | (signals.satellite == "G01"))
    (clock,) = pass_clocks(signals, is_los)
    known = np.isfinite(clock.corrected)
    assert not known[signals.system == "C"].any()
    assert not known[signals.epoch == 4].any()
    assert known[(signals.system != "C") & (signals.epoch != 4)].all()


def simulated_observations(rng, walls=12, passes=10, per=2, late=0.2, stray=0.0, shared=0.3, sigma=0.6,
                           slopes=(0.3, 0.9)):
    """Observations on walls with known offsets: noise, late ones, strays, and an error shared by all observations of a
    pass."""
    offset = rng.normal(0, 1.0, walls)
    rows = [(wall, source, satellite) for source in range(passes) for wall in range(walls) for satellite in range(per)]
    wall, source, satellite = np.array(rows).T
    slope = rng.uniform(*slopes, len(wall))
    variance = rng.uniform(0.02, 0.2, len(wall))
    error = rng.normal(0, np.sqrt(sigma**2 + variance)) + (rng.random(len(wall)) < late) * rng.exponential(
        4.0, len(wall))
    error = np.where(rng.random(len(wall)) < stray, rng.uniform(-20, 40, len(wall)), error)
    common = rng.normal(0, shared, passes)
    value = -2 * slope * offset[wall] + common[source] + error
    counts = [np.count_nonzero(source == number) for number in range(passes)]
    return OffsetObservations(wall, source, satellite.astype(str), np.zeros(len(wall), int), value, slope,
                              np.full(len(wall), 10.0),
                              variance, np.full(len(wall), 10), tuple(np.ones((count, 1)) for count in counts),
                              tuple(np.full((1, 1), shared**2) for _ in counts)), offset


def test_late_votes_do_not_bias_offsets_and_sigma_holds():
    rng = np.random.default_rng(11)
    error, sigma, plain = [], [], []
    for _ in range(8):
        observations, offset = simulated_observations(rng, stray=0.05)
        found = estimate_offsets(observations, 1.0)
        error.append(found.offset - offset)
        sigma.append(found.sigma)
        for wall in range(12):
            own = observations.wall == wall
            plain.append(np.median(-observations.value[own] / (2 * observations.cosine[own])) - offset[wall])
    error, sigma = np.concatenate(error), np.concatenate(sigma)
    assert np.mean(plain) < -0.15  # a symmetric estimate is drawn inwards by the late ones
    assert abs(error.mean()) < 0.08
    assert np.sqrt(np.mean(error**2)) < 0.25
    assert np.mean(np.abs(error) < 2 * sigma) > 0.93
    assert 0.75 < np.sqrt(np.mean((error / sigma) ** 2)) < 1.1


def test_an_error_shared_within_a_pass_is_not_averaged_away():
    rng = np.random.default_rng(12)
    observations, _ = simulated_observations(rng, walls=3, passes=2, per=60, late=0.0, shared=0.8, slopes=(0.6, 0.6))
    unshared = replace(observations, covariance=tuple(1e-12 * c for c in observations.covariance))
    # Without what the antenna may be off by in each of the two passes.
    told, ignored = (np.sqrt(estimate_offsets(some, 1.0).sigma ** 2 - ANTENNA**2 / 2)
                     for some in (observations, unshared))
    assert (told > 2 * ignored).all()
    # In the limit of many observations each wall tells -1.2 offset + c, c the mean of two errors of 0.8 m: Gaussian
    # algebra.
    spread = 1.2**2 * np.eye(3) + 0.8**2 / 2
    expected = np.sqrt(1.0 - (1.2**2 * np.linalg.inv(spread))[0, 0])
    assert told == pytest.approx(expected, abs=0.04)


def test_share_and_size_of_late_votes_are_learnt():
    observations, _ = simulated_observations(np.random.default_rng(13), walls=30, passes=12, late=0.3, sigma=0.5)
    model = estimate_offsets(observations, 1.0).model
    assert model.nlos_share == pytest.approx(0.3, abs=0.07)
    assert model.nlos_mean_delay == pytest.approx(4.0, abs=1.0)
    assert model.sigma == pytest.approx(0.5, abs=0.15)


def test_parts_of_the_error_model_add_up_to_one():
    model = ErrorModel(sigma=0.7, nlos_share=0.25, nlos_mean_delay=3.0, outlier_share=0.1)
    error = np.linspace(-39.9, 40.0, 400001)
    density = np.exp(model.log_parts(error, np.full(len(error), 0.1)))
    share = density.sum(axis=1) * (error[1] - error[0])
    assert share == pytest.approx([0.65, 0.25, 0.1], abs=0.002)


def block(x0, y0, x1, y1, low=0.0, top=20.0):
    a, b, c, d = (x0, y0), (x1, y0), (x1, y1), (x0, y1)
    faces = [[(*p, top) for p in (a, b, c, d)], [(*p, low) for p in (d, c, b, a)]]
    faces += [[(*p, low), (*q, low), (*q, top), (*p, top)] for p, q in ((a, b), (b, c), (c, d), (d, a))]
    return shapely.MultiPolygon([shapely.Polygon(face) for face in faces])


def towards(walls, azimuth):
    """Number of the wall that faces an azimuth, degrees."""
    normal = wall_table(walls).normal
    return int(np.argmax(normal @ [np.sin(np.radians(azimuth)), np.cos(np.radians(azimuth))]))


def move(shapes, row, offsets):
    """Shapes with the walls moved that `offsets` names by azimuth; walls, net, displacement, held as well."""
    walls = building_walls(shapes, row, np.full(len(shapes), 20.0), np.zeros(len(shapes)))
    net = PlanNet.of(walls)
    outwards = np.zeros(walls.count)
    for azimuth, value in offsets.items():
        outwards[towards(walls, azimuth)] = value
    made, displacement, held = move_buildings(shapes, row, walls, net, outwards, (outwards != 0).astype(float))
    return made, walls, net, displacement, held


def test_a_moved_solid_stays_closed_and_its_neighbouring_edges_follow():
    made, walls, net, displacement, held = move([block(0, 0, 20, 10)], np.zeros(1, int), {180: 1.0, 90: -0.7})
    assert not held.any() and made[0].geom_type == "MultiPolygon" and made[0].has_z
    assert not any(map(check_solid, solids_of(made[0])))
    assert shapely.force_2d(made[0]).bounds == pytest.approx((0, -1, 19.3, 10))
    assert applied_offsets(walls, net, displacement)[towards(walls, 180)] == pytest.approx(1.0)
    after = moved_walls(walls, net, displacement)
    assert np.allclose(after.normal, walls.normal)
    assert after.offset[walls.wall == towards(walls, 90)] == pytest.approx(19.3)


def test_walls_of_touching_parts_move_together():
    parts = [shapely.box(0, 0, 10, 10), shapely.box(10, 0, 20, 6)]
    made, *_ = move(parts, np.zeros(2, int), {180: 0.8})
    assert made[0].bounds == pytest.approx((0, -0.8, 10, 10)) and made[1].bounds == pytest.approx((10, -0.8, 20, 6))
    # The line between the parts is one line, whichever of them the wall on it belongs to.
    walls = building_walls(parts, np.zeros(2, int), np.array([20.0, 8.0]), np.zeros(2))
    net = PlanNet.of(walls)
    table = wall_table(walls)
    east = np.flatnonzero((table.normal[:, 0] > 0.9) & (table.start[:, 0] < 15))
    outwards = np.zeros(walls.count)
    outwards[east] = 1.0
    made, _, held = move_buildings(parts, np.zeros(2, int), walls, net, outwards, (outwards != 0).astype(float))
    assert made[0].bounds[2] == pytest.approx(11.0) and made[1].bounds[0] == pytest.approx(11.0)
    assert not held.any()


def test_slanting_corners_go_to_where_the_lines_meet():
    shape = shapely.Polygon([(0, 0), (20, 0), (14, 10), (0, 10)])
    made, *_ = move([shape], np.zeros(1, int), {180: 1.0})
    assert shapely.get_coordinates(made[0]).min(axis=0)[1] == pytest.approx(-1.0)
    lower_right = max(shapely.get_coordinates(made[0]).tolist())
    assert lower_right == pytest.approx([20.6, -1.0])


def test_a_building_does_not_run_into_its_neighbour():
    shapes = [shapely.box(0, 0, 10, 10), shapely.box(10.4, 0, 20, 10)]
    made, walls, _, _, held = move(shapes, np.arange(2), {180: 0.5})
    assert not held.any()
    walls = building_walls(shapes, np.arange(2), np.full(2, 20.0), np.zeros(2))
    net, table = PlanNet.of(walls), wall_table(walls)
    east = [w for w in range(len(table)) if table.building[w] == 0 and table.normal[w, 0] > 0.9]
    south = [w for w in range(len(table)) if table.building[w] == 0 and table.normal[w, 1] < -0.9]
    outwards = np.zeros(len(table))
    outwards[east], outwards[south] = 1.0, 0.6
    made, _, held = move_buildings(shapes, np.arange(2), walls, net, outwards, (outwards != 0).astype(float))
    assert held[east].all() and not held[south].any()
    assert made[0].bounds == pytest.approx((0, -0.6, 10, 10))
    assert shapely.intersection(made[0], made[1]).area == 0


def test_a_thin_wing_is_not_turned_over():
    shape = shapely.Polygon([(0, 0), (20, 0), (20, 10), (12, 10), (12, 30), (11.2, 30), (11.2, 10), (0, 10)])
    walls = building_walls([shape], None, np.array([20.0]), np.zeros(1))
    net, table = PlanNet.of(walls), wall_table(walls)
    wing = [w for w in range(len(table)) if table.normal[w, 0] > 0.9 and table.start[w, 1] > 9]
    outwards = np.zeros(len(table))
    outwards[wing] = -1.0
    made, _, held = move_buildings([shape], np.zeros(1, int), walls, net, outwards, (outwards != 0).astype(float))
    assert held[wing].all() and made[0].equals(shape)


def test_trajectories_of_passes_are_joined_in_time_and_must_not_overlap():
    def drive(start):
        time = start + np.arange(5.0)
        return Trajectory(time, np.column_stack([time, time, time]), np.zeros((5, 3)))

    whole = joined_trajectory([drive(100.0), drive(0.0)])
    assert np.array_equal(whole.time, [*range(5), *range(100, 105)])
    with pytest.raises(InputError, match="a.csv and b.csv overlap"):
        joined_trajectory([drive(0.0), drive(3.0)], ["a.csv", "b.csv"])


# A whole adjustment: a street whose left side hides satellites in the west from the antenna but not from the walls on
# the right, which reflect them. The truth is told by formulas, not by the tracer.

LEFT_TOP, RIGHT_TOP, WIDTH = 24.0, 30.0, 24.0


def street(shift):
    """Left and right rows of buildings as the model has them: the right walls are `shift` (4,) m too far left."""
    left = [shapely.box(-30, y, 0, y + 60) for y in (0, 60, 120, 180)]
    right = [shapely.box(WIDTH - s, y, WIDTH + 20, y + 58) for s, y in zip(shift, (0, 60, 120, 180))]
    return np.array(left + right, dtype=object), np.r_[np.full(4, LEFT_TOP), np.full(4, RIGHT_TOP)]


def drive_through(rng, number, late=0.15, noise=0.6):
    """Signals of one pass along x = 8: those from the west are reflected by the walls at x = WIDTH."""
    time = 1000.0 * number + np.arange(90.0)
    place = np.column_stack([np.full(90, 8.0), np.linspace(5, 230, 90), np.full(90, 2.0)])
    azimuth = np.r_[rng.uniform(-12, 12, 4), rng.uniform(168, 192, 4), rng.uniform(80, 100, 1), rng.uniform(
        255, 285, 5)]
    elevation = np.r_[rng.uniform(55, 80, 8), 84.0, rng.uniform(36, 50, 5)]
    names = np.array([f"{'GEC'[k % 3]}{(k + 5 * number) % 30 + 1:02d}" for k in range(14)])
    signals = signals_of(place, time, azimuth, elevation, source=0, satellite=names)
    count = len(signals)
    clock = np.cumsum(rng.normal(0, 2.0, 90))[signals.epoch] + np.select(
        [signals.system == "E", signals.system == "C"], [3.0, -5.0], 0.0)
    lasting = np.tile(rng.normal(0, 0.3, 14), 90)
    west = np.tile(np.arange(14) >= 9, 90)
    cosine = -np.cos(np.radians(signals.elevation)) * np.sin(np.radians(signals.azimuth))
    excess = np.where(west, 2 * (WIDTH - 8.0) * cosine, 0.0)
    block = signals.epoch // 20 * 14 + np.tile(np.arange(14), 90)
    delay = (rng.random(block.max() + 1) < late) * rng.exponential(4.0, block.max() + 1)
    persistent = rng.normal(0, 0.4, block.max() + 1)
    error = rng.normal(0, noise, count) + lasting + west * (delay + persistent)[block]
    return replace(signals, residual=clock + excess + error, cn0=np.where(west, 30.0, 44.0))


@pytest.fixture(scope="module")
def passes():
    rng = np.random.default_rng(21)
    return [drive_through(rng, number) for number in range(12)]


@pytest.mark.slow
def test_shifts_of_minus_one_zero_and_one_metre_are_told_apart(passes):
    shift = np.array([-1.0, 0.0, 1.0, 0.0])
    shapes, top = street(shift)
    made = adjust_walls(shapes, np.arange(8), joined_signals(passes), top, np.zeros(8))
    walls = made.walls
    facing = [int(np.flatnonzero((walls.table.building == 4 + k) & (walls.table.normal[:, 0] < -0.9))[0])
              for k in range(4)]
    assert (walls.status[facing] == ADJUSTED).all(), walls.reason[facing]
    # A model too far left has its wall too far outwards: it must move inwards.
    assert np.allclose(walls.offset[facing], -shift, atol=0.5)
    assert (np.abs(walls.offset[facing] + shift) < 2.5 * walls.sigma[facing]).all()
    assert (walls.sigma[facing] < 0.35).all()
    for k in range(4):
        assert made.shapes[4 + k].bounds[0] == pytest.approx(WIDTH - shift[k] - walls.offset[facing[k]], abs=1e-6)
    others = np.setdiff1d(np.arange(len(walls.table)), facing)
    assert (walls.status[others] == NOT_OBSERVABLE).all() and (walls.reason[others] != "").all()
    assert np.abs(walls.applied[others]).max() < 1e-9


@pytest.mark.slow
def test_walls_of_which_enough_is_told_without_a_decision_are_likely(passes):
    """More observations asked for than there are: what decided before is likely; without likely walls all stay."""
    shift = np.array([-1.0, 0.0, 1.0, 0.0])
    shapes, top = street(shift)
    many = AdjustmentSettings(min_observations=10_000)
    made = adjust_walls(shapes, np.arange(8), joined_signals(passes), top, np.zeros(8), many)
    facing = [int(np.flatnonzero((made.walls.table.building == 4 + k) & (made.walls.table.normal[:, 0] < -0.9))[0])
              for k in range(4)]
    assert (made.walls.status[facing] == LIKELY).all() and all("too few" in text for text in made.walls.reason[facing])
    assert np.allclose(made.walls.applied[facing], -shift, atol=0.5)
    strict = replace(many, likely_sigma=0.0)
    stays = adjust_walls(shapes, np.arange(8), joined_signals(passes), top, np.zeros(8), strict).walls
    assert (stays.status == NOT_OBSERVABLE).all() and not stays.applied.any()
    with pytest.raises(InputError, match="likely walls"):
        AdjustmentSettings(likely_sigma=-0.1)


def test_one_pass_moves_nothing_and_says_why(passes):
    shapes, top = street(np.ones(4))
    made = adjust_walls(shapes, np.arange(8), passes[0], top, np.zeros(8))
    assert (made.walls.status == NOT_OBSERVABLE).all()
    assert all(a.equals(b) for a, b in zip(made.shapes, shapes))
    assert any(reason.startswith("too few") for reason in made.walls.reason)


def test_open_sky_and_far_walls_are_named_as_such():
    rng = np.random.default_rng(3)
    shapes = np.array([shapely.box(30, 0, 60, 60), shapely.box(-400, 0, -390, 60)], dtype=object)
    place = np.column_stack([np.zeros(60), np.linspace(0, 60, 60), np.full(60, 2.0)])
    signals = signals_of(place, np.arange(60.0), rng.uniform(190, 350, 9), rng.uniform(20, 80, 9))
    made = adjust_walls(shapes, np.arange(2), signals, np.array([8.0, 8.0]), np.zeros(2))
    walls = made.walls
    west = np.flatnonzero((walls.table.building == 0) & (walls.table.normal[:, 0] < -0.9))[0]
    far = np.flatnonzero((walls.table.building == 1) & (walls.table.normal[:, 0] > 0.9))[0]
    hidden = np.flatnonzero((walls.table.building == 0) & (walls.table.normal[:, 0] > 0.9))[0]
    assert "open sky" in walls.reason[west] or "no received signal" in walls.reason[west]
    assert walls.reason[far].startswith("too far") and "no antenna in front" in walls.reason[hidden]


@pytest.mark.slow
def test_strays_in_large_numbers_are_not_believed(passes):
    rng = np.random.default_rng(9)
    whole = joined_signals(passes)
    wild = whole.cn0 < 35
    whole = replace(whole, residual=whole.residual + wild * rng.uniform(-30, 30, len(whole)))
    shapes, top = street(np.zeros(4))
    made = adjust_walls(shapes, np.arange(8), whole, top, np.zeros(8))
    moved = made.walls.status == ADJUSTED
    assert (np.abs(made.walls.offset[moved]) < 2 * made.walls.sigma[moved] + 0.1).all()
    assert np.count_nonzero(moved) <= 1


def test_settings_that_make_no_sense_are_refused():
    with pytest.raises(InputError):
        AdjustmentSettings(prior_sigma=0.0)
    with pytest.raises(InputError):
        AdjustmentSettings(min_observations=0)
    with pytest.raises(InputError):
        TraceSettings(max_range=0.0)


def test_no_clock_without_signals_in_sight():
    walls = building_walls([shapely.box(-30, -30, 30, -2), shapely.box(-30, 2, 30, 30)], None, np.full(2, 80.0),
                           np.zeros(2))
    signals = signals_of(np.array([[0.0, 0.0, 1.0]]), np.zeros(1), np.array([0.0, 170.0, 10.0]), np.full(3, 40.0))
    with pytest.raises(InsufficientDataError, match="clock"):
        trace_residuals(walls, signals)


@dataclass
class StrengthTable:
    """What of the table of signals tells their strength."""

    system: np.ndarray
    cn0: np.ndarray
    elevation: np.ndarray

    def __len__(self):
        return len(self.system)


def test_usual_strength_is_that_of_free_signals_of_the_same_system():
    """GPS: 40 free ones at 45 dB-Hz, as many blocked at 20; Galileo: 40 free ones at 35, few of GLONASS."""
    system = np.repeat(["G", "E", "R"], [80, 50, 9])
    strength = np.repeat([45.0, 20.0, 35.0, 50.0, 40.0], [40, 40, 40, 10, 9])
    free = np.repeat([True, False, True, False, True], [40, 40, 40, 10, 9])
    usual = expected_cn0(StrengthTable(system, strength, np.full(139, 55.0)), free)
    assert (usual[:130] == np.where(system[:130] == "G", 45.0, 35.0)).all() and np.isnan(usual[130:]).all()
