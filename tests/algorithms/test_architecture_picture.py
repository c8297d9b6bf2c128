"""The picture of the architecture is what its script draws from the code as it is."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest

from scripts.draw_architecture import BOX, PICTURE, TEXT_SIZE, depths, draw, wrapped
from scripts.draw_architecture import Stage as DrawnStage

pytestmark = pytest.mark.once


def drawn(qgis_app) -> str:
    from qgis.core import QgsApplication

    return draw(QgsApplication.processingRegistry().providerById("urbanmap").algorithms())


def test_the_picture_is_that_of_the_code(qgis_app):
    assert PICTURE.read_text(encoding="utf-8") == drawn(qgis_app), "run scripts/draw_architecture.py"


def test_every_stage_is_in_the_picture(qgis_app, plugin):
    from qgis.core import QgsApplication

    words = " ".join(element.text for element in ElementTree.fromstring(drawn(qgis_app)).iter() if element.text)
    base = plugin("algorithms.framework.base").UrbanMapAlgorithm
    for algorithm in QgsApplication.processingRegistry().providerById("urbanmap").algorithms():
        if isinstance(algorithm, base) and algorithm.groupId() not in {"start", "workflows"}:
            assert algorithm.displayName() in words, algorithm.name()


def test_a_flow_in_a_circle_is_refused():
    stages = [DrawnStage(name, name, "mobile", {}, {}, {}) for name in ("a", "b")]
    assert depths(stages, {("a", "b")}) == {"a": 0, "b": 1}
    with pytest.raises(ValueError, match="a -> b -> a"):
        depths(stages, {("a", "b"), ("b", "a")})


def test_lines_fit_their_boxes():
    lines = [line for line, _ in wrapped("Calibration, " * 20, "takes")]
    assert len(lines) > 3 and max(map(len, lines)) * TEXT_SIZE * 0.5 < BOX
