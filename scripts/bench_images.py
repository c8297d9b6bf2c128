"""Road markings in every kind of image: a part of `make bench`.

The orthophoto of a sample city is changed to each kind of `image_kinds`, and its markings are found and scored by the
city's truth. Paint that buildings hide counts as missed, in all kinds alike.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

from scripts.bench_table import print_table
from scripts.image_kinds import KINDS
from scripts.score_image_kinds import GRADES, painted, searched
from urbanmap_qgis.aerial.markings.marking_verdict import marking_verdict
from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity import write
from urbanmap_qgis.samplecity.truth.stage import write_truth

HEADER = ("kind of image", "recall", "stray (m2/ha)", "verdict", "CPU s")


def image_kinds_table(size: float = 120.0, seed: int = 31) -> None:
    """Print the table."""
    world = (size, "canyon", seed, ())
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        city = Path(folder)
        write_truth(write._scene(*world), city)
        write._run("aerial", city, world, SILENT)
        photograph = painted(city)
        for name, kind in KINDS.items():
            start = time.process_time()
            found, mask = searched(photograph, kind, city)
            spent = time.process_time() - start
            recall, stray = photograph.score(mask)
            grade = GRADES[marking_verdict(found).grade]
            rows.append((name, recall, round(stray), grade, spent))
    print_table(f"Road markings by kind of image, sample city of {size:g} m, seed {seed}", HEADER, rows)
