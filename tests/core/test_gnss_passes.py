"""Observation files and trajectories of several drives find each other."""

import numpy as np
import pytest
from pyproj import CRS

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.signals.passes import load_passes
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

WKT = CRS.from_epsg(6677).to_wkt()
WEEK = 604800.0


@pytest.fixture(scope="module")
def drives(small_city):
    folder = small_city / "gnss"
    return ([folder / f"pass_{n:02d}.obs" for n in (1, 2)], [folder / "satellites.nav"],
            [read_trajectory(folder / f"pass_{n:02d}_trajectory.csv").trajectory for n in (1, 2)])


def load(drives, trajectories):
    return load_passes(*drives[:2], trajectories, ["one", "two"], WKT, 36.6)


def test_trajectories_in_any_order_and_in_different_times_give_the_same_signals(drives):
    whole = load(drives, drives[2])
    assert len(np.unique(whole.epochs.source)) == 2
    swapped = load(drives, drives[2][::-1])
    assert np.array_equal(whole.residual, swapped.residual)
    # One of them in full GPS seconds: the two have no time in common, and each file goes with its own.
    one, two = drives[2]
    full = Trajectory(two.time + 2310 * WEEK, two.place, two.angles)
    apart = load(drives, [one, full])
    assert np.allclose(apart.residual, whole.residual, atol=1e-3)
    assert np.array_equal(apart.epochs.source, whole.epochs.source)


def test_files_without_or_with_two_trajectories_are_refused(drives):
    one, two = drives[2]
    other = Trajectory(one.time - 5000.0, one.place, one.angles)
    with pytest.raises(InputError, match=r"pass_02\.obs is of the time of none"):
        load(drives, [one, other])
    with pytest.raises(InputError, match="may belong to one and two"):
        load(drives, [Trajectory(np.r_[one.time, two.time], np.r_[one.place, two.place], np.r_[one.angles, two.angles]),
                      two])
