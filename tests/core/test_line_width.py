"""Widths of lines: from marking points, from lines alike, from sharp outlines, else unknown."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.roadmap.lines.line_width import line_widths

LENGTH = 30.0


def course(north: float) -> np.ndarray:
    """A bent line of about 30 m."""
    x = np.linspace(0.0, LENGTH, 61)
    return np.column_stack([x, north + 0.004 * (x - LENGTH / 2.0) ** 2])


def points(north: float, width: float, rng: np.random.Generator, beside: float = 0.0, count: int = 1500) -> np.ndarray:
    """Marking points evenly over the paint of such a line, as a drive measures them: `beside` it and scattered."""
    x = rng.uniform(0.0, LENGTH, count)
    slope = 0.008 * (x - LENGTH / 2.0)
    across = rng.uniform(-width / 2.0, width / 2.0, count) + rng.normal(0.0, 0.004, count) + beside
    normal = np.column_stack([-slope, np.ones(count)]) / np.hypot(1.0, slope)[:, None]
    return np.column_stack([x, north + 0.004 * (x - LENGTH / 2.0) ** 2]) + across[:, None] * normal


@pytest.mark.parametrize("width", [0.10, 0.15, 0.20, 0.45])
def test_points_of_two_drives_tell_the_width_that_outlines_do_not(width):
    rng = np.random.default_rng(1)
    drives = [points(0.0, width, rng, 0.03), points(0.0, width, rng, -0.03, 3000)]
    ((found, sigma),) = line_widths([course(0.0)], np.array([width + 0.05]), np.array([0.03]), drives)
    assert found == pytest.approx(width, abs=0.01) and abs(found - width) <= 2.0 * sigma <= 0.06


def test_ragged_outlines_alone_tell_no_width_and_sharp_ones_do():
    found = line_widths([course(0.0), course(4.0)], np.array([0.19, 0.15]), np.array([0.03, 0.002]), [])
    assert np.isnan(found[0]).all() and found[1] == pytest.approx([0.15, 0.002])


def test_a_line_without_points_is_as_wide_as_its_outlines_less_what_those_of_others_are_off_by():
    rng = np.random.default_rng(2)
    widths = [0.15, 0.15, 0.14, 0.15, 0.16, 0.15]
    outlined = np.array(widths) + 0.04
    drive = np.concatenate([points(4.0 * k, width, rng) for k, width in enumerate(widths[:5])])
    lines = [course(4.0 * k) for k in range(6)]
    found = line_widths(lines, outlined, np.full(6, 0.03), [drive])
    assert found[5, 0] == pytest.approx(0.15, abs=0.01) and found[5, 1] < 0.03
    # Too few lines alike say nothing of another: nor do lines of another width.
    assert np.isnan(line_widths(lines[2:], outlined[2:], np.full(4, 0.03), [drive])[3, 0])
    outlined[5] = 0.30
    assert np.isnan(line_widths(lines, outlined, np.full(6, 0.03), [drive])[5, 0])


@pytest.mark.parametrize("drive", [points(0.0, 0.15, np.random.default_rng(3), count=60),
                                   points(0.0, 1.5, np.random.default_rng(4), count=8000), np.zeros((0, 2))],
                         ids=["few", "surface", "none"])
def test_points_that_show_no_edges_tell_no_width(drive):
    assert np.isnan(line_widths([course(0.0)], np.array([0.19]), np.array([0.03]), [drive])).all()


def test_drives_that_disagree_are_no_sure_width():
    rng = np.random.default_rng(5)
    drives = [points(0.0, 0.12, rng), points(0.0, 0.24, rng)]
    ((found, sigma),) = line_widths([course(0.0)], np.array([0.2]), np.array([0.03]), drives)
    assert np.isnan(found) or 2.0 * sigma > 0.05
