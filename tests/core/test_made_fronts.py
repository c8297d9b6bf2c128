"""Fronts scanned from a made vehicle with occlusion: the model's wall lies on the facade, whatever stands before it."""

import numpy as np
import pytest

from scripts.evaluate_fronts import trial
from scripts.front_scenes.scan import local

# Panes stand back in their frames by 8 cm: they are of the wall, but do not hold its line.
FRONTS = [("plain", 2, set()), ("glass", 2, set()), ("sign band", 1, {"sign band"}), ("canopy", 2, {"canopy"}),
          ("hoarding", 2, {"hoarding"}), ("balconies", 2, {"balcony"}),
          ("pilotis", 2, {"recess"}), ("pilasters", 1, {"post"}), ("upper setback", 2, {"setback"}),
          ("windows in ribbons", 3, {"recess"}),
          ("garden wall, balconies", 104, {"garden wall", "balcony"})]


@pytest.mark.parametrize("kind, seed, before", FRONTS)
def test_the_models_wall_lies_on_the_facade(tmp_path, kind, seed, before):
    one = trial(kind, seed, tmp_path)
    assert one.verdict == "good"
    found = {wall.kind for wall in one.walls}
    assert before <= found
    standing = [wall for wall in one.walls if wall.kind not in ("wall", "setback", "recess")]
    assert all(wall.status == "before the facade" and 0 < wall.plane.sigma < 0.01 for wall in standing)


def test_a_step_deeper_than_the_limit_is_left_and_not_taken_along(tmp_path):
    """Half of the front stands 3 m back: it is a wall, but too far to move the model; its piece of the edge stays."""
    one = trial("step 3 m", 2, tmp_path)
    assert one.verdict == "marked"
    assert [edge.match.status for edge in one.model.edges].count("moved") >= 1
    across = [local(wall.plane.point[None] + np.array([[0, 0, 0], wall.plane.normal]), one.seed)[:, 1]
              for wall in one.walls if wall.status == "ok"]
    depths = [y for y, towards in across if towards - y < -0.9]
    assert min(depths) == pytest.approx(0.0, abs=0.05) and max(depths) == pytest.approx(3.0, abs=0.05)


def test_the_fronts_of_balconies_are_taken_where_they_are_wanted(tmp_path):
    assert trial("balconies", 2, tmp_path, "outermost").verdict == "good"
