"""Rounded coordinates of a cloud are found and told."""

import numpy as np
import pytest

from urbanmap_qgis.io.points.coordinate_steps import coordinate_step, told_steps
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.progress import notices_to


@pytest.mark.parametrize("step", [0.0, 0.05, 0.25, 0.3048])
def test_the_step_of_one_axis_is_told_once(make_cloud, tmp_path, step):
    x, y, z = np.random.default_rng(3).uniform(0.0, 60.0, (3, 3000))
    y = np.round(y / step) * step if step else y
    cloud, told = open_cloud([make_cloud(tmp_path / "a.laz", x, y, z)]), []
    with notices_to(told.append):
        steps = [told_steps(cloud) for _ in range(2)]
    assert np.allclose(steps, [[0.0, step, 0.0]] * 2, atol=1e-5)
    assert len(told) == (step > 0) and all(f"y in steps of {step:.3g} m" in sentence for sentence in told)


def test_sparse_and_few_values_have_no_step():
    sparse = np.round(np.random.default_rng(4).uniform(0.0, 1e6, 60))
    assert coordinate_step(sparse) == 0.0 and coordinate_step(np.array([0.0, 5.0, 10.0])) == 0.0
