"""Our cloth filter against the CSF package's simulation of Zhang et al. (2016), where that is installed."""

from pathlib import Path

import laspy
import numpy as np
import pytest

from urbanmap_qgis.terrain.cloth import JAVANMARDI, classify_ground

csf = pytest.importorskip("CSF")
CLOUD = Path(__file__).resolve().parents[3] / "shared" / "data" / "city" / "als" / "als.laz"


@pytest.mark.skipif(not CLOUD.is_file(), reason="no real data here")
def test_our_cloth_finds_the_simulations_ground():
    las = laspy.read(CLOUD)
    points = np.column_stack([las.x, las.y, las.z])
    near = (np.abs(points[:, :2] - np.median(points[:, :2], axis=0)) < 150).all(axis=1)
    points = points[near] - points[near].min(axis=0)
    simulation = csf.CSF()
    simulation.params.cloth_resolution, simulation.params.class_threshold = 2.0, 0.2
    simulation.params.interations, simulation.params.rigidness = 1000, JAVANMARDI.rigidness
    simulation.params.bSloopSmooth = False
    simulation.setPointCloud(points)
    ground, others = csf.VecInt(), csf.VecInt()
    simulation.do_filtering(ground, others, False)
    theirs = np.zeros(len(points), bool)
    theirs[np.array(ground)] = True
    ours = classify_ground(*np.ascontiguousarray(points.T), JAVANMARDI)
    assert (ours == theirs).mean() > 0.995
    cell = np.floor(points[:, :2]).astype(int) @ [1, 1000]
    both = np.intersect1d(cell[ours], cell[theirs])
    lowest = [np.array([points[mask & (cell == k), 2].min() for k in both[::40]]) for mask in (ours, theirs)]
    assert np.abs(lowest[0] - lowest[1]).mean() < 0.01
