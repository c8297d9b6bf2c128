"""The generator of damaged layers damages, each time alike, and never stops at what it damaged before."""

from __future__ import annotations

import random

import numpy as np
import pytest
import shapely

from scripts.fuzz_layers import damaged as damaged_layer
from scripts.fuzz_layers import map_layers, road_layers


def told(table):
    """What a table is known by."""
    rows = [(None if shape is None else shapely.to_wkb(shape), sorted(values.items())) for shape, values in table.rows]
    return repr((rows, table.fields))


@pytest.mark.filterwarnings("ignore:invalid value encountered", "ignore:overflow encountered")
@pytest.mark.parametrize("name", ["EDGES", "LANES", "OBJECTS", "RAILS"])
def test_layers_are_damaged_each_time_alike_and_the_sound_one_stays(tmp_path, name):
    sound = {**road_layers(tmp_path), **map_layers(tmp_path)}[name]
    before = told(sound)
    with np.errstate(all="ignore"):
        first, again = ([told(damaged_layer(sound, random.Random(f"{name}-{number}"))) for number in range(300)]
                        for _ in range(2))
    assert first == again and told(sound) == before
    assert len({one for one in first if one != before}) > 200
