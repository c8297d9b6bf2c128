"""The example of the page for developers is imported and run as it stands there."""

from __future__ import annotations

import re
import sys
import types

import pytest

from .conftest import PLUGIN, ROOT


@pytest.fixture
def example(plugin):
    """Its class, defined as a module of the group of buildings."""
    page = (ROOT / "docs" / "developer.md").read_text(encoding="utf-8")
    block, = [text for text in re.findall(r"```python\n(.*?)```", page, re.S) if "(UrbanMapAlgorithm)" in text]
    plugin("algorithms.buildings.segmentbuildings")
    module = types.ModuleType(f"{PLUGIN}.algorithms.buildings.outlinedensity")
    module.__package__ = f"{PLUGIN}.algorithms.buildings"
    sys.modules[module.__name__] = module
    exec(compile(block, "developer.md", "exec"), module.__dict__)
    yield module.OutlineDensity
    del sys.modules[module.__name__]


def test_the_example_runs(example, run, synthetic, make_cloud, save_outlines, tmp_path):
    outline = synthetic.rectangle(-7000.0, -35000.0, 20.0, 15.0)
    points, _ = synthetic.Scene([synthetic.flat(outline, 12.0)], noise=0.02).points()
    cloud = make_cloud(tmp_path / "points.laz", *points.T, number_of_returns=1, return_number=1)
    results = run(example(), {"POINTS": [str(cloud)], "OUTPUT": str(tmp_path / "density.gpkg"),
                              "FOOTPRINTS": str(save_outlines(tmp_path / "outlines.gpkg", [outline]))})
    assert 0 < results["COUNT"] < len(points) and (tmp_path / "density.gpkg").is_file()
