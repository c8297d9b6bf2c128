"""Train the model that tells road markings from what is as bright and narrow, from made-up scenes alone.

    python scripts/train_marking_pieces.py [--scenes 108] [--first 3000] [--trees 120] [--figures FILE] [--output FILE]

No photograph is used. A fifth of the scenes is held out: the model is calibrated on them with as much paint as they
have. With --figures what was told of the scenes is kept in a file, or read from it. Takes about five minutes.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.marking_scenes.scene import MadeScene, make_marking_scene  # noqa: E402
from urbanmap_qgis.aerial.markings.marking_filter import figures_of_pieces, judged_pieces  # noqa: E402
from urbanmap_qgis.aerial.markings.paint_model import FILE, PaintModel  # noqa: E402
from urbanmap_qgis.aerial.markings.road_markings import MarkingSettings, candidates_of  # noqa: E402
from urbanmap_qgis.aerial.markings.sampled_levels import sampled_levels  # noqa: E402
from urbanmap_qgis.progress import SILENT  # noqa: E402

DEPTH, BINS, RATE, CALM, SHARE = 5, 48, 0.1, 20.0, 0.3
"""Questions of a tree; steps of a figure; how much of a tree counts; what its leaves' sums are damped by; share of the
cells that each tree sees."""

PAINT, BARE = 0.6, 0.2
"""Shares of a cell's bright pixels on paint from which it is paint, and up to which it is none."""

MOST = 3000, 5000
"""Cells of a scene that are taken, of paint and of none."""

HELD = 5
"""One scene of so many is held out."""


class ImagePieces:
    """An image in memory, read as `sampled_levels` does."""

    def __init__(self, image: np.ndarray, pixel: float):
        self._bands, self.pixel = np.moveaxis(image, -1, 0), pixel
        self.rows, self.columns = image.shape[:2]

    def read(self, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray, None]:
        """Bands and where ground is seen."""
        bands = self._bands[:, rows, columns]
        return bands, np.ones(bands.shape[1:], bool), None


@dataclass(frozen=True)
class Cells:
    """Figures (n, m) of cells by names (m,), the share of their bright pixels on paint, and how many cells of their
    scene each stands for."""

    names: list[str]
    figures: np.ndarray
    share: np.ndarray
    weight: np.ndarray


def cells_of_image(image: np.ndarray, pixel: float, paint: np.ndarray) -> Cells:
    """All cells of an image (rows, columns, 3) in which paint is known (bool)."""
    settings, pieces = MarkingSettings(), ImagePieces(image, pixel)
    levels = sampled_levels(pieces, settings, SILENT)
    whole = slice(0, pieces.rows), slice(0, pieces.columns)
    bands, seen, _ = pieces.read(*whole)
    found = candidates_of(bands, seen, None, pixel, levels, settings)
    judged = judged_pieces(found, pixel, settings.cleaning, whole)
    counts = judged.accepted[judged.pieces.labels]
    told = figures_of_pieces(judged, found, pixel, counts)
    on_paint = paint.take(judged.pieces.inside[counts])
    share = np.bincount(told.cell, on_paint, minlength=len(told.pixels)) / told.pixels
    table = np.column_stack([told.values[name] for name in told.values]).astype(np.float32)
    return Cells(list(told.values), table, share, np.ones(len(share)))


def cells_of_scene(scene: MadeScene, rng: np.random.Generator) -> Cells:
    """Some cells of a scene."""
    paint = cv2.dilate(scene.paint, np.ones((3, 3), np.uint8)) > 0.4
    cells = cells_of_image(scene.image, scene.pixel, paint)
    chosen, weight = [], []
    for here, most in zip((cells.share > PAINT, cells.share < BARE), MOST):
        found = np.flatnonzero(here)
        some = rng.permutation(found)[:most]
        chosen.append(some)
        weight.append(np.full(len(some), len(found) / max(len(some), 1)))
    taken = np.concatenate(chosen)
    return Cells(cells.names, cells.figures[taken], cells.share[taken], np.concatenate(weight))


def told_of_scenes(first: int, count: int) -> dict[str, np.ndarray]:
    """Figures, answers, weights and scenes of many scenes."""
    parts = []
    for seed in range(first, first + count):
        parts.append(cells_of_scene(make_marking_scene(seed), np.random.default_rng(seed)))
        if seed % 20 == 0:
            print(f"scene {seed}: {len(parts[-1].share)} cells", flush=True)
    scene = np.repeat(np.arange(count), [len(part.share) for part in parts])
    return {"names": np.array(parts[0].names), "figures": np.concatenate([part.figures for part in parts]),
            "paint": np.concatenate([part.share > 0.5 for part in parts]),
            "weight": np.concatenate([part.weight for part in parts]), "scene": scene}


class Booster:
    """Trees that ask one question a level, grown one after the other on the gradient of the logistic loss."""

    def __init__(self, figures: np.ndarray, paint: np.ndarray, rng: np.random.Generator):
        self._rng, self._paint = rng, paint.astype(float)
        steps = np.linspace(0, 1, BINS + 1)[1:-1]
        self.limits = [np.unique(np.quantile(column, steps)).astype(np.float32) for column in figures.T]
        self._bins = np.stack([np.searchsorted(limits, column) for limits, column in zip(self.limits, figures.T)]
                              ).astype(np.uint8)
        share = self._paint.mean()
        self.base = float(np.log(share / (1 - share)))
        self._sum = np.full(len(paint), self.base)

    def tree(self) -> tuple[list[int], list[float], np.ndarray]:
        """Figures and limits of the questions of the next tree, and its values."""
        some = np.flatnonzero(self._rng.random(len(self._sum)) < SHARE)
        likely = 1 / (1 + np.exp(-self._sum))
        gradient, bend = self._paint - likely, likely * (1 - likely)
        bins, node = self._bins[:, some], np.zeros(len(some), np.intp)
        asked = self._rng.choice(len(bins), int(0.4 * len(bins)), replace=False)
        figures, levels = [], []
        for _ in range(DEPTH):
            figure, level = self._question(bins, node, gradient[some], bend[some], asked, len(figures))
            figures.append(figure)
            levels.append(level)
            node = 2 * node + (bins[figure] > level)
        total, bends = (np.bincount(node, values[some], minlength=2 ** DEPTH) for values in (gradient, bend))
        value = (RATE * total / (bends + CALM)).astype(np.float32)
        place = np.zeros(len(self._sum), np.intp)
        for figure, level in zip(figures, levels):
            place = 2 * place + (self._bins[figure] > level)
        self._sum += value[place]
        return figures, [float(self.limits[figure][level]) for figure, level in zip(figures, levels)], value

    def _question(self, bins: np.ndarray, node: np.ndarray, gradient: np.ndarray, bend: np.ndarray,
                  asked: np.ndarray, depth: int) -> tuple[int, int]:
        """Figure and step that part the cells best in all nodes together."""
        best = (-1.0, 0, 0)
        for figure in asked:
            levels = min(len(self.limits[figure]), BINS - 1)
            if not levels:
                continue
            key = node * BINS + bins[figure]
            sums, bends = (np.bincount(key, values, minlength=BINS << depth).reshape(-1, BINS).cumsum(axis=1)
                           for values in (gradient, bend))
            left, left_bend = sums[:, :levels], bends[:, :levels]
            right, right_bend = sums[:, -1:] - left, bends[:, -1:] - left_bend
            gain = (left ** 2 / (left_bend + CALM) + right ** 2 / (right_bend + CALM)).sum(axis=0)
            if gain.max() > best[0]:
                best = (float(gain.max()), int(figure), int(gain.argmax()))
        return best[1:]


def calibrated(score: np.ndarray, paint: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Evidence and the share of paint at it, rising: classes with equally much paint, and neighbours that
    fall joined (isotonic regression)."""
    order = np.argsort(score)
    score, paint, weight = score[order], paint[order], weight[order]
    ends = np.searchsorted(np.cumsum(paint), np.linspace(0, paint.sum(), 25)[1:-1])
    groups = [[np.average(s, weights=w), np.average(p, weights=w), w.sum()] for s, p, w in zip(
        *(np.split(values, np.unique(ends)) for values in (score, paint, weight))) if len(s)]
    joined: list[list[float]] = []
    for group in groups:
        joined.append(group)
        while len(joined) > 1 and joined[-1][1] <= joined[-2][1]:
            last, before = joined.pop(), joined.pop()
            total = last[2] + before[2]
            joined.append([(last[k] * last[2] + before[k] * before[2]) / total for k in (0, 1)] + [total])
    return np.array([g[0] for g in joined], np.float32), np.array([g[1] for g in joined], np.float32)


def trained(told: dict[str, np.ndarray], trees: int, seed: int = 1) -> tuple[PaintModel, float]:
    """The model, and its area under the curve in the scenes held out."""
    held = told["scene"] % HELD == 0
    booster = Booster(told["figures"][~held], told["paint"][~held], np.random.default_rng(seed))
    grown = [booster.tree() for _ in range(trees)]
    figure, limit, value = (np.array([tree[k] for tree in grown]) for k in range(3))
    names = tuple(told["names"].tolist())
    raw = PaintModel(names, booster.base, figure, limit.astype(np.float32), value, np.zeros(1), np.zeros(1))
    evidence = raw.evidence_of(dict(zip(names, told["figures"][held].T)), int(held.sum()))
    steps, shares = calibrated(evidence, told["paint"][held].astype(float), told["weight"][held])
    area = area_under_curve(evidence, told["paint"][held], told["weight"][held])
    return replace(raw, evidence=steps, shares=shares), area


def area_under_curve(score: np.ndarray, paint: np.ndarray, weight: np.ndarray) -> float:
    """How likely a cell of paint has the higher score than one of none."""
    order = np.argsort(score)
    paint, weight = paint[order], weight[order]
    below = np.cumsum(weight * ~paint)
    return float((below * weight * paint).sum() / ((weight * paint).sum() * below[-1]))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=108)
    parser.add_argument("--first", type=int, default=3000)
    parser.add_argument("--trees", type=int, default=120)
    parser.add_argument("--figures", type=Path)
    parser.add_argument("--output", type=Path, default=FILE)
    given = parser.parse_args()
    if given.figures and given.figures.is_file():
        with np.load(given.figures) as stored:
            told = dict(stored)
    else:
        told = told_of_scenes(given.first, given.scenes)
        if given.figures:
            np.savez(given.figures, **told)
    model, area = trained(told, given.trees)
    model.write(given.output)
    print(f"{len(told['paint'])} cells, {told['paint'].mean():.2f} of them paint; area under the curve {area:.4f} in "
          f"scenes held out; {given.output.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
