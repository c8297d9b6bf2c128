"""Relative motions adjusted between ground truths: matrices of the paper, and what they keep."""

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.lines.relative_motion import adjust_relative_motion
from urbanmap_qgis.mobile.trajectory import Trajectory


def course(count=60):
    time = np.arange(count) * 0.5
    heading = 20 + 60 * np.sin(np.arange(count) / 15)
    step = 3.0 * np.column_stack([np.sin(np.radians(heading)), np.cos(np.radians(heading)), 0 * heading])
    return Trajectory(time, np.array([5000.0, -3000.0, 7.0]) + np.cumsum(step, axis=0),
                      np.column_stack([0 * time, 0 * time + 1.0, heading]))


def matrices(trajectory):
    kappa = np.radians(90 - trajectory.angles[:, 2])
    made = np.zeros((len(kappa), 3, 3))
    x, y = trajectory.place[:, :2].T
    made[:, 0] = np.column_stack([np.cos(kappa), -np.sin(kappa), x])
    made[:, 1] = np.column_stack([np.sin(kappa), np.cos(kappa), y])
    made[:, 2, 2] = 1
    return made


def pose(x, y, kappa):
    return np.array([[np.cos(kappa), -np.sin(kappa), x], [np.sin(kappa), np.cos(kappa), y], [0, 0, 1.0]])


def paper(t, s, e, true_e, rounds=30):
    """Eq. 8 to 10 with matrices: each step takes 1 / (e - s) of the numbers of the loop closed through the steps."""
    steps = [np.linalg.inv(t[i]) @ t[i + 1] for i in range(s, e)]
    for _ in range(rounds):
        chain = [t[s]]
        for step in steps:
            chain.append(chain[-1] @ step)
        new = []
        for i, step in enumerate(steps):
            # t_(i+1,i+2) ... t_(e-1,e) T_e'^-1 T_s t_(s,s+1) ... t_(i-1,i), inverted, and t_(i,i+1)^-1.
            after = np.eye(3)
            for later in steps[i + 1:]:
                after = after @ later
            loop = np.linalg.inv(after @ np.linalg.inv(true_e) @ chain[i]) @ np.linalg.inv(step)
            part = np.array([loop[0, 2], loop[1, 2], np.arctan2(loop[1, 0], loop[0, 0])]) / (e - s)
            new.append(pose(*part) @ step)
        steps = new
    chain = [t[s]]
    for step in steps:
        chain.append(chain[-1] @ step)
    return np.array(chain)


@pytest.mark.paper("Z 3.1, eq. 8, 9")
def test_iteration_is_the_paper_s():
    trajectory = course(25)
    end = trajectory.place[24, :2] + [1.2, -0.8]
    kappa = np.radians(90 - trajectory.angles[24, 2] + 2.0)
    drift = np.array([[0, 0, 0], [1.2, -0.8, np.radians(2.0)]])
    iterated = matrices(adjust_relative_motion(trajectory, [0, 24], drift))
    np.testing.assert_allclose(iterated, paper(matrices(trajectory), 0, 24, pose(*end, kappa)), atol=2e-5)


def test_ground_truths_are_met_and_the_ends_are_rigid():
    trajectory, epochs = course(), np.array([10, 30, 45])
    drift = np.array([[1.0, 2.0, 0.01], [-0.5, 1.0, -0.02], [0.3, 0.1, 0.015]])
    made = adjust_relative_motion(trajectory, epochs, drift)
    np.testing.assert_allclose(made.place[epochs, :2], trajectory.place[epochs, :2] + drift[:, :2], atol=2e-5)
    heading = trajectory.angles[epochs, 2] - np.degrees(drift[:, 2])
    np.testing.assert_allclose(made.angles[epochs, 2], heading, atol=1e-5)
    old, new = matrices(trajectory), matrices(made)
    for part in (slice(0, 11), slice(45, 60)):
        a, b = ([np.linalg.inv(t[k]) @ t[k + 1] for k in range(len(t) - 1)] for t in (old[part], new[part]))
        np.testing.assert_allclose(a, b, atol=1e-6)
    np.testing.assert_array_equal(made.place[:, 2], trajectory.place[:, 2])
    np.testing.assert_array_equal(made.angles[:, :2], trajectory.angles[:, :2])
    np.testing.assert_array_equal(made.time, trajectory.time)


def test_pure_shift_is_shared_by_epoch():
    trajectory = course()
    made = adjust_relative_motion(trajectory, [0, 59], np.array([[0, 0, 0], [2.0, 1.0, 0.0]]))
    share = np.linspace(0.0, 1.0, len(trajectory))
    np.testing.assert_allclose((made.place - trajectory.place)[:, :2], np.outer(share, [2.0, 1.0]), atol=1e-9)


def test_epochs_must_increase():
    with pytest.raises(InputError, match="different epochs"):
        adjust_relative_motion(course(), [5, 5], np.zeros((2, 3)))
    one = adjust_relative_motion(course(), [5], np.array([[1.0, 0, 0]]))
    np.testing.assert_allclose(one.place - course().place, np.tile([1.0, 0, 0], (60, 1)), atol=1e-9)
