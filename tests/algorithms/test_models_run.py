"""The shipped models, given their mandatory inputs alone, make what the chains make that they are models of."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

_SCRIPT = Path(__file__).with_name("every_algorithm.py")
_SPEC = importlib.util.spec_from_file_location("urbanmap_every_algorithm", _SCRIPT)
every = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(every)

ASKED = {"aerialmarkings": ("OUTPUT", "OUTPUT_POLYGONS"), "buildingsfromals": ("OUTPUT", "OUTPUT_CITYJSON"),
         "georeferencemms": ("OUTPUT", "OUTPUT_TRAJECTORY", "OUTPUT_PATCHES"),
         "lanemap": ("OUTPUT_LANES", "OUTPUT_BOUNDS", "OUTPUT_LANELET2"), "roadspace": ("OUTPUT", "OUTPUT_AREAS")}
"""Outputs that are compared; all others are left out, also those that a step of the model cannot do without."""


@pytest.mark.once
@pytest.mark.slow
@pytest.mark.parametrize("name", ASKED)
def test_a_model_makes_what_its_chain_makes(run, small_city, tmp_path, name):
    every.write_street(tmp_path)
    registry = every.algorithms()
    chain = registry[name]
    needed = {item.name() for item in chain.parameterDefinitions() if not item.flags() & item.Flag.FlagOptional}
    inputs = {key: value for key, value in every.given(name, small_city, tmp_path, {
        "surfacefromals:OUTPUT_GROUND": None}).items() if key in needed}
    model = chain.provider().algorithm(f"{name}_model")
    made = {}
    for algorithm in (chain, model):
        places = every.places(name, algorithm, tmp_path / algorithm.name())
        asked = {key: place.replace(key, key.rpartition(":")[2]) for key, place in places.items()
                 if key.rpartition(":")[2] in ASKED[name]}
        (tmp_path / algorithm.name()).mkdir()
        run(algorithm, {**inputs, **asked})
        made[algorithm] = {key.rpartition(":")[2]: Path(place) for key, place in asked.items()}
    assert made[chain].keys() == made[model].keys() == set(ASKED[name])
    for key, path in made[chain].items():
        assert contents(path) == contents(made[model][key]), key


def contents(path):
    """The bytes of a file; of a GeoPackage, which says when it was written, its attributes and geometries."""
    if path.suffix != ".gpkg":
        return path.read_bytes()
    from osgeo import ogr

    source = ogr.Open(str(path))
    return [(feature.items(), bytes(feature.GetGeometryRef().ExportToWkb())) for feature in source.GetLayer(0)]
