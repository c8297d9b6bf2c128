#!/usr/bin/env python3
"""Building models of the part of Delft in ../shared/data against its points and outlines: level and sloped roofs.

    python3 scripts/evaluate_delft.py FOLDER

FOLDER is ../shared/data/als/delft_west. The number of vertices of each model and their sum are printed too,
so that any model that changes is seen. Needs a Python that sees QGIS's GDAL.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.bench import FIGURES, Delft, chain  # noqa: E402
from scripts.layers import read_layer  # noqa: E402
from urbanmap_qgis.buildings.building_model import BuildingModel  # noqa: E402


def main() -> None:
    """Print the figures."""
    folder, delft = Path(sys.argv[1]), Delft.read()
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


if __name__ == "__main__":
    main()
