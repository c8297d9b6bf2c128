"""The page that tells each step of the papers: made from the table and the tests, and true of the core."""

import pytest

from scripts.make_paper_page import PAGE, STATES, marked_tests, missing_functions, page, read_steps
from urbanmap_qgis.aerial.frames.occlusion import PAPER_OCCLUSION
from urbanmap_qgis.aerial.markings.road_markings import PAPER_MARKINGS
from urbanmap_qgis.mobile.markings.plain_threshold import PlainThreshold
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.terrain.cloth import JAVANMARDI

pytestmark = pytest.mark.once


def test_the_page_is_that_of_the_table_and_the_tests():
    assert PAGE.read_text(encoding="utf-8") == page(), "run scripts/make_paper_page.py"


def test_steps_name_functions_that_there_are_and_states_that_are_known():
    steps = read_steps()
    assert not missing_functions(steps)
    assert len({step.place for step in steps}) == len(steps) > 50
    assert {step.state for step in steps} <= set(STATES)
    assert all(step.says for step in steps if step.state in ("differs", "missing"))


def test_what_is_said_to_be_to_the_letter_is_held_by_a_test():
    marked, steps = marked_tests(), read_steps()
    assert set(marked) <= {step.place for step in steps}
    assert not [step.place for step in steps if step.state == "letter" and not marked.get(step.place)]


@pytest.mark.paper("J 3.3.3, Table 3-2")
def test_parameters_of_the_papers_table():
    assert PAPER_OCCLUSION.threshold == 5.0
    assert (JAVANMARDI.resolution, JAVANMARDI.iterations, JAVANMARDI.threshold) == (2.0, 1000, 0.2)
    assert (PlainThreshold().block_size, PlainThreshold().block_pixels, PlainThreshold().c) == (2.5, 21, 17.0)
    assert (PAPER_MARKINGS.block_size, PAPER_MARKINGS.contrast) == (2.5, 17.0)
    letter = RegistrationSettings.paper()
    assert (letter.patch_length, letter.window_patches, letter.ndt_levels) == (0.5, 60, (1.0,))
    assert (letter.feature_grid, letter.feature_count, letter.feature_points) == (1.0, 400, 5)
    assert (letter.ndt_grid, letter.iterations) == (1.0, 30)
