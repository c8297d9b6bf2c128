"""Whether a change of the correction is the drive's: then its trajectory slipped aside of where it headed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.mobile.registration.correction.disagreements import NodeStep, either_side
from urbanmap_qgis.mobile.registration.correction.side_slip import SideSlip
from urbanmap_qgis.mobile.trajectory import Trajectory

SPEED = 8.0


def driven(jump=0.0, length=20.0, at=200.0, misaligned=0.3, bend=60.0, seed=3):
    """A drive northwards with a bend to the right whose place is fixed anew by `jump` m to the right over `length` m.

    Its heading is misaligned by some degrees, and wanders by 0.02.
    """
    rng, way = np.random.default_rng(seed), np.arange(0.0, 500.0, 0.4)
    heading = np.radians(bend) * np.clip((way - 300.0) / 30.0, 0.0, 1.0)
    place = np.column_stack([np.cumsum(0.4 * np.sin(heading)), np.cumsum(0.4 * np.cos(heading)), 0.0 * way])
    place[:, 0] += jump * np.clip((way - at) / length + 0.5, 0.0, 1.0)
    wander = np.radians(0.02) * np.cumsum(rng.normal(size=len(way))) / 20.0
    angles = np.column_stack([0.0 * way, 0.0 * way, np.degrees(heading + wander) + misaligned])
    return SideSlip.of(Trajectory(way / SPEED, place, angles), way)


def step(east, north, sigma=0.02):
    change = np.array([east, north])
    return NodeStep(0, change, sigma**2 * np.eye(2), float(change @ change) / sigma**2)


@pytest.mark.parametrize("misaligned", [0.0, 0.5, -1.0])
def test_a_slip_is_found_whatever_the_heading_is_off(misaligned):
    right, slip, sigma = driven(0.4, misaligned=misaligned).between(185.0, 215.0)
    assert right == pytest.approx([1.0, 0.0], abs=0.03)
    assert slip == pytest.approx(0.4, abs=0.03) and sigma < 0.04


def test_a_slight_bend_is_no_slip_and_in_a_sharp_one_nothing_is_told():
    _, slip, sigma = driven(bend=15.0).between(300.0, 330.0)
    assert abs(slip) < 3.0 * sigma
    assert driven().between(300.0, 330.0) is None
    assert not driven().denies(300.0, 330.0, step(-0.4, 0.1))


def test_a_change_that_the_drive_slipped_by_is_its_own():
    assert not driven(0.4).denies(185.0, 215.0, step(-0.4, 0.1))


def test_a_change_aside_without_a_slip_is_not_the_drives():
    assert driven().denies(185.0, 215.0, step(-0.4, 0.1))
    assert driven(-0.4).denies(185.0, 215.0, step(-0.4, 0.1))  # it slipped the other way


def test_along_the_way_nothing_is_told_nor_of_a_change_that_is_not_sure():
    assert not driven().denies(185.0, 215.0, step(0.02, 0.6))
    assert not driven().denies(185.0, 215.0, step(-0.4, 0.1, sigma=0.2))


def test_a_place_is_off_by_all_steps_up_to_the_right_stretch():
    """With one step half of its square, of two any of the three stretches may be the right one."""
    nodes, known = np.arange(0.0, 110.0, 10.0), 1e-12 * np.eye(2)
    steps = [NodeStep(2, np.array([1.0, 0.0]), known, 9.0), NodeStep(7, np.array([0.0, 2.0]), known, 9.0)]
    at = np.array([5.0, 50.0, 95.0])
    first, second, both = (np.outer(change, change) for change in (steps[0].change, steps[1].change, [1.0, 2.0]))
    beside, variance = either_side(steps, nodes, at)
    assert beside.all()
    assert variance == pytest.approx(np.array([first + both, first + second, second + both]) / 3, abs=1e-9)
    assert either_side(steps[:1], nodes, at)[1] == pytest.approx(np.array([first] * 3) / 2, abs=1e-9)
    assert not either_side([], nodes, at)[0].any()
    unsure = either_side([replace(steps[0], covariance=4.0 * np.eye(2))], nodes, at)[1]
    assert unsure[0] == pytest.approx(first / 2 + 0.4 * np.eye(2))  # no more unsure than it is large
