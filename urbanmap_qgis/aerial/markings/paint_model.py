"""The trained model that tells paint on a road from what is as bright and narrow.

Boosted trees (Friedman 2001) that ask the same question in all nodes of a level, so that a tree is a table: the answers
are the digits of a row's number. Trained by `scripts/train_marking_pieces.py` on made-up scenes alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

FILE = Path(__file__).with_name("paint_model.npz")


@dataclass(frozen=True)
class PaintTrees:
    """Boosted trees.

    Attributes
    ----------
    names : (m,) of the figures.
    base : sum before the first tree.
    figure : (trees, depth) intp, number of the figure that each level asks for.
    limit : (trees, depth) float32, above which the answer is yes.
    value : (trees, 2 ** depth) float32, by the answers as digits of a binary number.
    """

    names: tuple[str, ...]
    base: float
    figure: np.ndarray
    limit: np.ndarray
    value: np.ndarray

    def score(self, figures: Mapping[str, np.ndarray], count: int) -> np.ndarray:
        """Sum of the trees (count,) of figures by name; those left out (of grey images, colours) are 0."""
        columns = [np.asarray(figures[name], np.float32) if name in figures else np.zeros(count, np.float32)
                   for name in self.names]
        total = np.full(count, self.base, np.float32)
        for figure, limit, value in zip(self.figure, self.limit, self.value):
            row = np.zeros(count, np.uint8)
            for one, least in zip(figure, limit):
                row <<= 1
                row |= (columns[one] > least).view(np.uint8)
            total += value.take(row)
        return total

    def likely(self, figures: Mapping[str, np.ndarray], count: int) -> np.ndarray:
        """How likely (count,) it is paint, 0 to 1, float32."""
        return 1 / (1 + np.exp(-self.score(figures, count)))


@dataclass(frozen=True)
class PaintModel:
    """Trees for two rounds and what turns the mean of a piece into a probability.

    Attributes
    ----------
    first, second : of the strokes alone, and with what the first says of their company.
    least : what the first says of a cell that the second is asked for.
    evidence, shares : (k,) rising, share of paint by the mean; between them in proportion.
    """

    first: PaintTrees
    second: PaintTrees
    least: float
    evidence: np.ndarray
    shares: np.ndarray

    def probability(self, evidence: np.ndarray) -> np.ndarray:
        """Probability (n,) float32 of means of pieces."""
        return np.interp(evidence, self.evidence, self.shares).astype(np.float32)

    def write(self, path: Path) -> None:
        """Store the model."""
        trees = {f"{name}{number}": values for number, one in enumerate((self.first, self.second)) for name, values in (
            ("names", np.array(one.names)), ("base", one.base), ("figure", one.figure.astype(np.uint8)),
            ("limit", one.limit), ("value", one.value))}
        np.savez_compressed(path, least=self.least, evidence=self.evidence, shares=self.shares, **trees)

    @classmethod
    def read(cls, path: Path = FILE) -> PaintModel:
        """A stored model."""
        with np.load(path, allow_pickle=False) as archive:
            first, second = (PaintTrees(tuple(archive[f"names{k}"].tolist()), float(archive[f"base{k}"]),
                                        archive[f"figure{k}"].astype(np.intp), archive[f"limit{k}"],
                                        archive[f"value{k}"]) for k in range(2))
            return cls(first, second, float(archive["least"]), archive["evidence"], archive["shares"])


@lru_cache(maxsize=1)
def paint_model() -> PaintModel:
    """The model of this release."""
    return PaintModel.read()
