"""Train the model that tells road markings from what is as bright and narrow, from made-up scenes alone.

    python scripts/train_marking_pieces.py [--scenes 64] [--first 3000] [--cells FILE] [--output FILE]

Needs the package catboost besides those of the program. No photograph is used. Trees of the first round judge each cell
by itself; those of the second also know what the first, trained on other scenes, says of the company. A fifth of the
scenes is held out: the model is calibrated on them. With --cells the figures of the scenes are kept in a file, or read
from it. Takes about ten minutes.
"""

from __future__ import annotations

import argparse
import json
import pickle
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.marking_scenes.scene import MadeScene, make_marking_scene  # noqa: E402
from urbanmap_qgis.aerial.markings.marking_filter import likely_grid, of_pieces, paint_image  # noqa: E402
from urbanmap_qgis.aerial.markings.marking_pieces import MarkingPieces  # noqa: E402
from urbanmap_qgis.aerial.markings.paint_figures import (  # noqa: E402
    PaintImage,
    StrokeCells,
    company_figures,
    stroke_figures,
)
from urbanmap_qgis.aerial.markings.paint_model import FILE, PaintModel, PaintTrees  # noqa: E402
from urbanmap_qgis.aerial.markings.road_markings import MarkingSettings, candidates_of  # noqa: E402
from urbanmap_qgis.aerial.markings.sampled_levels import sampled_levels  # noqa: E402
from urbanmap_qgis.progress import SILENT  # noqa: E402

ROUNDS = (120, 5), (150, 5)
"""Trees and questions of a tree, for both rounds."""

PAINT, BARE = 0.6, 0.2
"""Shares of a cell's bright pixels on paint from which it is paint, and up to which it is none."""

MOST = 6000
"""Cells of a scene that are taken, chosen by chance."""

LEAST = 0.03
"""What the first round says of a cell that the second is asked for."""

HELD = 5
"""One scene of so many is held out."""


class ImagePieces:
    """An image in memory, read as `sampled_levels` does."""

    def __init__(self, image: np.ndarray, pixel: float):
        self._bands, self.pixel = np.moveaxis(image, -1, 0), pixel
        self.rows, self.columns = image.shape[:2]

    def read(self, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray, None]:
        """Bands and where ground is seen."""
        bands = np.ascontiguousarray(self._bands[:, rows, columns])
        return bands, np.ones(bands.shape[1:], bool), None


@dataclass
class SceneCells:
    """What is known of a scene: its image, pieces and cells, `near` figures by name, which of the pieces' pixels are
    paint (n,), and the same as shares of cells (k,); `likely` (k,) as a model that does not know the scene says."""

    seen: PaintImage
    pieces: MarkingPieces
    cells: StrokeCells
    near: dict[str, np.ndarray]
    right: np.ndarray
    share: np.ndarray
    likely: np.ndarray | None = None

    @classmethod
    def of(cls, scene: MadeScene) -> SceneCells:
        """Of a scene."""
        settings, image = MarkingSettings(), ImagePieces(scene.image, scene.pixel)
        bands, seen, _ = image.read(slice(None), slice(None))
        found = candidates_of(bands, seen, None, scene.pixel, sampled_levels(image, settings, SILENT), settings)
        drawn, pieces = paint_image(found, scene.pixel, settings.cleaning)
        cells = StrokeCells.of(drawn, pieces.inside)
        near = stroke_figures(drawn, cells, pieces.inside, found.threshold.take(pieces.inside), pieces)
        right = (cv2.dilate(scene.paint, np.ones((3, 3), np.uint8)) > 0.4).take(pieces.inside)
        return cls(drawn, pieces, cells, {name: values.astype(np.float32) for name, values in near.items()}, right,
                   cells.mean(right))

    def chosen(self) -> np.ndarray:
        """Cells that the second round is asked for, bool (k,)."""
        return self.likely >= LEAST

    def all_figures(self) -> dict[str, np.ndarray]:
        """Figures of the chosen cells for the second round."""
        some = self.chosen()
        far = company_figures(self.cells.chosen(some), likely_grid(self.cells, self.likely))
        return {**{name: values[some] for name, values in self.near.items()},
                **{name: values.astype(np.float32) for name, values in far.items()}}


def trees_of(figures: list[dict[str, np.ndarray]], share: list[np.ndarray], size: tuple[int, int]) -> PaintTrees:
    """Trees that part paint from bare cells, of scenes that weigh the same."""
    from catboost import CatBoostClassifier, Pool

    names = sorted(set().union(*figures))
    rows, paint, weight = [], [], []
    for number, (values, parts) in enumerate(zip(figures, share)):
        known = (parts > PAINT) | (parts < BARE)
        known &= np.random.default_rng(number).random(len(parts)) < MOST / max(np.count_nonzero(known), 1)
        rows.append(np.column_stack([values.get(name, np.zeros(len(parts), np.float32)) for name in names])[known])
        paint.append(parts[known] > PAINT)
        weight.append(np.full(np.count_nonzero(known), 1 / max(np.count_nonzero(known), 2000)))
    trees, depth = size
    model = CatBoostClassifier(iterations=trees, depth=depth, learning_rate=0.12, l2_leaf_reg=6, border_count=64,
                               rsm=0.5, random_seed=1, thread_count=2, verbose=False,
                               allow_writing_files=False)
    model.fit(Pool(np.concatenate(rows), np.concatenate(paint).astype(int), weight=np.concatenate(weight),
                   feature_names=names))
    with tempfile.TemporaryDirectory() as work:
        model.save_model(f"{work}/model.json", format="json")
        told = json.loads(Path(work, "model.json").read_text())
    return read_trees(told, names, depth)


def read_trees(told: dict, names: list[str], depth: int) -> PaintTrees:
    """Trees as catboost writes them: the first question is the last digit there, and a tree may have fewer."""
    scale, base = told["scale_and_bias"]
    count = len(told["oblivious_trees"])
    figure, limit = np.zeros((count, depth), np.intp), np.full((count, depth), np.inf, np.float32)
    value = np.zeros((count, 2 ** depth), np.float32)
    for number, tree in enumerate(told["oblivious_trees"]):
        for place, split in enumerate(tree["splits"]):
            figure[number, depth - 1 - place] = split["float_feature_index"]
            limit[number, depth - 1 - place] = split["border"]
        value[number, :len(tree["leaf_values"])] = np.array(tree["leaf_values"]) * scale
    used = np.unique(figure)
    return PaintTrees(tuple(names[number] for number in used), float(base[0]), np.searchsorted(used, figure), limit,
                      value)


def first_round(scenes: list[SceneCells], known: list[SceneCells]) -> PaintTrees:
    """Trees of the first round, trained on all that are known; scenes get what trees of other scenes say."""
    for part in (0, 1):
        trees = trees_of([one.near for one in known[1 - part::2]], [one.share for one in known[1 - part::2]], ROUNDS[0])
        for one in known[part::2]:
            one.likely = trees.likely(one.near, len(one.share))
    trees = trees_of([one.near for one in known], [one.share for one in known], ROUNDS[0])
    for one in scenes:
        if one.likely is None:
            one.likely = trees.likely(one.near, len(one.share))
    return trees


def calibrated(score: np.ndarray, paint: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Evidence and the share of paint at it, rising: classes with equally much weight, and neighbours that fall joined
    (isotonic regression)."""
    order = np.argsort(score, kind="stable")
    score, paint, weight = score[order], paint[order], weight[order]
    ends = np.unique(np.searchsorted(np.cumsum(weight * (0.05 + paint)), np.linspace(
        0, (weight * (0.05 + paint)).sum(), 40)[1:-1]))
    joined: list[list[float]] = []
    for s, p, w in zip(*(np.split(values, ends) for values in (score, paint, weight))):
        if not len(s):
            continue
        joined.append([np.average(s, weights=w), np.average(p, weights=w), w.sum()])
        while len(joined) > 1 and joined[-1][1] <= joined[-2][1]:
            last, before = joined.pop(), joined.pop()
            total = last[2] + before[2]
            joined.append([(last[k] * last[2] + before[k] * before[2]) / total for k in (0, 1)] + [total])
    return np.array([g[0] for g in joined], np.float32), np.array([g[1] for g in joined], np.float32)


def trained(scenes: list[SceneCells]) -> tuple[PaintModel, str]:
    """The model, and words on how it parts the scenes held out."""
    held, known = scenes[::HELD], [one for number, one in enumerate(scenes) if number % HELD]
    first = first_round(scenes, known)
    second = trees_of([one.all_figures() for one in known], [one.share[one.chosen()] for one in known], ROUNDS[1])
    score, right, weight = [], [], []
    for one in held:
        likely = np.zeros(len(one.share), np.float32)
        likely[one.chosen()] = second.likely(one.all_figures(), np.count_nonzero(one.chosen()))
        score.append(of_pieces(likely[one.cells.cell], one.pieces, one.seen.image.shape, one.seen.pixel))
        right.append(one.right)
        weight.append(np.full(len(one.right), one.seen.pixel ** 2))
    score, right, weight = (np.concatenate(values) for values in (score, right, weight))
    model = PaintModel(first, second, LEAST, *calibrated(score, right.astype(float), weight))
    found = model.probability(score) >= 0.5
    return model, (f"held out, at one half: precision {np.average(right[found], weights=weight[found]):.3f}, recall "
                   f"{(weight * found * right).sum() / (weight * right).sum():.3f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=64)
    parser.add_argument("--first", type=int, default=3000)
    parser.add_argument("--cells", type=Path)
    parser.add_argument("--output", type=Path, default=FILE)
    given = parser.parse_args()
    if given.cells and given.cells.is_file():
        scenes = pickle.loads(given.cells.read_bytes())
    else:
        scenes = []
        for seed in range(given.first, given.first + given.scenes):
            scenes.append(SceneCells.of(make_marking_scene(seed)))
            print(f"scene {seed}: {len(scenes[-1].share)} cells", flush=True)
        if given.cells:
            given.cells.write_bytes(pickle.dumps(scenes))
    model, words = trained(scenes)
    model.write(given.output)
    print(f"{sum(len(one.share) for one in scenes)} cells; {words}; {given.output.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
