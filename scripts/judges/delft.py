"""Building models of the part of Delft in ../shared/data/als/delft_west: level and sloped roofs.

The number of vertices of each model and their sum are printed too, so that any model that changes is seen.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from scripts.bench import FIGURES, Delft, chain
from scripts.layers import read_layer
from urbanmap_qgis.buildings.building_model import BuildingModel


def judge(folder: Path) -> None:
    """Print the figures."""
    delft = Delft.read()
    outlines, (names,) = read_layer(folder / "outlines.gpkg", "lokaalid")
    for sloped in (False, True):
        run, kind = chain(folder / "points.laz", outlines, sloped=sloped), "sloped" if sloped else "level"
        for name, value in zip(FIGURES, delft.figures(run)):
            print(f"{kind} roofs, {name}:", round(value, 4) if isinstance(value, float) else value)
        for name, model in zip(names, run.models):
            print(f"{kind} {name} vertices and their sum:", *_prints(model))


def _prints(model: BuildingModel) -> tuple[int, float]:
    vertices = np.concatenate([np.zeros((0, 3)), *(solid.vertices for solid in model.solids)])
    return len(vertices), round(float(vertices.sum()), 3)
