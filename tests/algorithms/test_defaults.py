"""What a dialog offers is what the core does by itself, so that figures measured on the core hold for both."""

from __future__ import annotations

import pytest

from urbanmap_qgis.buildings.roof_polygons.polygon_rows import PolygonParameters
from urbanmap_qgis.buildings.roofs.roof_levels import RoofParameters
from urbanmap_qgis.buildings.segmentation import SegmentationParameters

CORE = {
    "segmentbuildings": (SegmentationParameters(), {"EXPANSION": "expansion", "MIN_HEIGHT": "minimum_height",
                                                    "MAX_DISPLACEMENT": "maximum_displacement"}),
    "segmentroofs": (RoofParameters(), {"BIN_WIDTH": "bin_width", "BIN_SHIFT": "bin_shift",
                                        "MIN_ROOF_AREA": "min_roof_area", "PARAPET_THRESHOLD": "parapet_threshold",
                                        "MIN_ROOF_SHARE": "min_roof_share",
                                        "SMALL_ROOF_AREA": "small_roof_area", "HEIGHT_RMSE": "height_rmse",
                                        "MIN_HEIGHT": "min_height"}),
    "roofpolygons": (PolygonParameters(), {"METHOD": "method", "HEIGHT": "height"}),
}


def definition(algorithm, name):
    from qgis.core import QgsApplication

    return QgsApplication.processingRegistry().algorithmById(f"urbanmap:{algorithm}").parameterDefinition(name)


@pytest.mark.parametrize("algorithm", CORE)
def test_steps_have_the_cores_defaults(algorithm, qgis_app):
    parameters, names = CORE[algorithm]
    offered = {name: definition(algorithm, name).defaultValue() for name in names}
    assert offered == {name: getattr(parameters, attribute) for name, attribute in names.items()}


def test_the_chain_has_its_steps_defaults(qgis_app):
    for step, names in {"segmentbuildings": ("EXPANSION", "MAX_DISPLACEMENT"), "roofpolygons": ("METHOD", "HEIGHT"),
                        "segmentroofs": ("MIN_ROOF_AREA", "HEIGHT_RMSE")}.items():
        for name in names:
            assert definition("buildingsfromals", name).defaultValue() == definition(step, name).defaultValue(), name
