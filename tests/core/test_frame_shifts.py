"""Disagreement of overlapping frames, from markings."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.aerial.orthophotos.frame_shifts import (
    frame_shifts,
    lie_apart,
    shift_columns,
    status_of,
    unlike_images,
    warn_of_shifts,
)
from urbanmap_qgis.aerial.orthophotos.mosaic import GroundView
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.progress import Progress

GRID = Grid(0.0, 100.0, 0.1, 400, 500)


class Painted:
    """A source that shows squares of paint, displaced by (east, north) m."""

    def __init__(self, name, east=0.0, north=0.0, light=150.0):
        self.name, self.bounds, self._shift, self._light = name, GRID.bounds, (east, north), light

    def lean(self, _x, _y):
        return None

    def view(self, grid):
        x, y = grid.centres()
        x, y = np.meshgrid(x - self._shift[0], y - self._shift[1])
        rng = np.random.default_rng(1)
        image = np.full(grid.shape, 60.0)
        for spot_x, spot_y in rng.uniform((0, 60), (50, 100), (150, 2)):
            covered = [np.clip((0.35 - np.abs(offset)) / grid.cell + 0.5, 0, 1) for offset in (x - spot_x, y - spot_y)]
            image = np.maximum(image, 60.0 + self._light * covered[0] * covered[1])
        values = np.clip(image, 0, 255).astype(np.float32)[..., None]
        seen = np.ones(grid.shape, bool)
        return GroundView(values, seen, seen, lambda: np.zeros(grid.shape, np.float32))


def test_a_displaced_frame_is_found():
    shifts = frame_shifts([Painted("a"), Painted("b", 0.23, -0.11), Painted("c", light=110.0)], GRID)
    assert [(shift.first, shift.second) for shift in shifts] == [("a", "b"), ("a", "c"), ("b", "c")]
    assert (shifts[0].east, shifts[0].north) == pytest.approx((0.23, -0.11), abs=0.02)
    assert shifts[1].length < 0.01 and shifts[0].patches > 10
    assert shifts[0].sigma < shifts[0].spread < 0.02
    assert [lie_apart(shift, 0.1) for shift in shifts] == [True, False, True]


def test_every_patch_tells_its_place_and_shift():
    shifts = frame_shifts([Painted("a"), Painted("b", 0.23, -0.11), Painted("c", light=110.0)], GRID)
    columns = shift_columns(shifts, 0.1)
    assert len(columns["x"]) == sum(shift.patches for shift in shifts)
    x_min, y_min, x_max, y_max = GRID.bounds
    assert (columns["x"] > x_min).all() and (columns["x"] < x_max).all() and columns["y"].max() < y_max
    assert columns["y"].min() > y_min
    first = columns["second"] == "b"
    assert np.abs(columns["east"][first] - 0.23).max() < 0.1 and np.abs(columns["north"][first] + 0.11).max() < 0.1
    assert set(columns["status"][first]) == {"apart"} and (columns["pair_sigma"] < 0.02).all()


def test_nothing_compared_gives_an_empty_table():
    assert all(len(column) == 0 for column in shift_columns([], 0.1).values())


def test_shifts_are_in_metres_whatever_the_unit_of_the_grid():
    [shift] = frame_shifts([Painted("a"), Painted("b", 0.23, -0.11)], GRID, metres=0.3048)
    assert shift.east == pytest.approx(0.23 * 0.3048, abs=0.006)


def test_frames_without_markings_say_nothing():
    assert frame_shifts([Painted("a", light=0.0), Painted("b", light=0.0)], GRID) == []


class Standing(Painted):
    """As `Painted`, but in the west of `edge` (m) each spot stands 4 to 6 m high and leans `lean` m a metre to the
    north; the surface tells so, or there is none."""

    def __init__(self, name, lean, error=(0.0, 0.0), edge=25.0, surface=True):
        super().__init__(name, *error)
        self._lean, self._edge, self._surface = lean, edge, surface

    def lean(self, x, _y):
        return np.tile((0.0, self._lean), (len(x), 1))

    def view(self, grid):
        x, y = grid.centres()
        level = np.broadcast_to(x >= self._edge, grid.shape) if self._surface else None
        x, y = np.meshgrid(x - self._shift[0], y - self._shift[1])
        rng = np.random.default_rng(2)
        image = np.full(grid.shape, 60.0)
        for spot_x, spot_y in rng.uniform((0, 60), (50, 100), (150, 2)):
            height = rng.uniform(4.0, 6.0) if spot_x < self._edge else 0.0
            covered = [np.clip((0.35 - np.abs(offset)) / grid.cell + 0.5, 0, 1)
                       for offset in (x - spot_x, y - spot_y - self._lean * height)]
            image = np.maximum(image, 60.0 + 150.0 * covered[0] * covered[1])
        seen = np.ones(grid.shape, bool)
        return GroundView(image.astype(np.float32)[..., None], seen, seen, lambda: np.zeros(grid.shape, np.float32),
                          level)


@pytest.mark.parametrize("error", [(0.0, 0.0), (0.1, 0.0), (0.0, 0.1)])
def test_only_bare_ground_tells_of_the_orientation(error):
    """Most spots stand 5 m high and are displaced by 0.3 m; the paint on the ground tells the error of 0.1 m."""
    [shift] = frame_shifts([Standing("a", 0.0, edge=32.0), Standing("b", 0.06, error, edge=32.0)], GRID)
    assert (shift.east, shift.north) == pytest.approx(error, abs=0.02) and shift.on_ground
    assert shift.places[:, 0].min() > 32.0
    assert status_of(shift, 0.1) == ("apart" if any(error) else "agree")


@pytest.mark.parametrize(("error", "status"), [((0.0, 0.0), "height"), ((0.1, 0.0), "apart"), ((0.0, 0.1), "height"),
                                               ((0.0, -0.6), "apart")])
def test_without_a_surface_only_what_heights_do_not_explain_is_told(error, status):
    """All spots stand: the shift along the base is their height; no thing stands 5 m below the ground."""
    [shift] = frame_shifts([Standing("a", 0.0, edge=99.0, surface=False),
                            Standing("b", 0.06, error, edge=99.0, surface=False)], GRID)
    assert shift.north == pytest.approx(0.3 + error[1], abs=0.05) and not shift.on_ground
    assert status_of(shift, 0.1) == status
    if shift.explained:
        assert shift.unexplained[0] == pytest.approx(abs(error[0]), abs=0.02)


def test_one_place_is_no_evidence():
    """Ten patches that overlap all see the same thing, which moved."""
    class Spot(Standing):
        def view(self, grid):
            view = super().view(grid)
            x, y = np.meshgrid(*grid.centres())
            view.values[(np.abs(x - 20) > 1.5) | (np.abs(y - 80) > 2.5)] = 60.0
            return view

    assert frame_shifts([Spot("a", 0.0), Spot("b", 0.0, (0.3, 0.0))], GRID) == []


class Turned(Painted):
    """The same squares of paint, where a frame turned by half a turn shows them."""

    def view(self, grid):
        view = super().view(grid)
        return GroundView(view.values[::-1, ::-1].copy(), view.seen, view.reached, view.tangent)


def test_a_turned_frame_is_not_alike_and_is_named():
    """Its shifts are any: a difference over three sigma says nothing where sigma is metres."""
    shifts = frame_shifts([Painted("a"), Turned("b"), Painted("c")], GRID)
    assert [status_of(shift, 0.1) for shift in shifts] == ["not alike", "agree", "not alike"]
    assert unlike_images(shifts) == ["b"]
    columns = shift_columns(shifts, 0.1)
    assert np.isnan(columns["pair_east"][columns["status"] == "not alike"]).all() and len(columns["x"])
    warnings = []
    warn_of_shifts(shifts, 0.1, Progress(warn=warnings.append))
    assert "b. Check" in warnings[0] and len(warnings) == 1


def test_of_two_images_that_differ_both_are_named():
    assert unlike_images(frame_shifts([Painted("a"), Turned("b")], GRID)) == ["a", "b"]
