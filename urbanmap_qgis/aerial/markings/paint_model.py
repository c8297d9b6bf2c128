"""The trained model that tells paint on a road from what is as bright and narrow, and its agreement with rules.

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

RULES = "rules"
"""Figure that holds the confidence by rules for the ground beside."""

LEAST = 0.02
"""Confidence by rules that counts where they give less: what they reject can be paint, but not easily."""


@dataclass(frozen=True)
class KindOfLight:
    """How the model is read in a kind of light.

    Attributes
    ----------
    trust_in_rules : exponent of the rules' confidence, against that of the trees.
    odds : of paint, times those of the made-up scenes.
    least_rules : confidence by rules from which the trees are asked at all.
    """

    trust_in_rules: float
    odds: float
    least_rules: float = 0.0


SOFT_LIGHT = KindOfLight(1.0, 1.0)

HARD_LIGHT = KindOfLight(0.5, 0.65, 0.002)
"""The rules for the ground beside are told less by rough, sharpened ground, and more of what looks like paint is none.
Four tenths of what is bright and narrow is nothing by the rules; 1 to 2 % of what the trees took lay in it, and no
place where paint is to be seen.
Chosen on the tiles us 0 and us 12 of `scripts/score_image_kinds.py`."""


@dataclass(frozen=True)
class PaintModel:
    """Boosted trees and what turns their sum into a probability.

    Attributes
    ----------
    names : (m,) of the figures.
    base : sum before the first tree.
    figure : (trees, depth) intp, number of the figure that each level asks for.
    limit : (trees, depth) float32, above which the answer is yes.
    value : (trees, 2 ** depth) float32, by the answers as digits of a binary number.
    evidence, shares : (k,) rising, share of paint by the evidence; between them in proportion.
    """

    names: tuple[str, ...]
    base: float
    figure: np.ndarray
    limit: np.ndarray
    value: np.ndarray
    evidence: np.ndarray
    shares: np.ndarray

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

    def evidence_of(self, figures: Mapping[str, np.ndarray], count: int, light: KindOfLight = SOFT_LIGHT) -> np.ndarray:
        """Evidence (count,) float32, 0 to 1, that it is paint on a road: the geometric mean of what the trees and what
        the rules say, because either alone is misled by other things."""
        likely = 1 / (1 + np.exp(-self.score(figures, count)))
        return np.sqrt(likely * np.maximum(figures[RULES], LEAST) ** light.trust_in_rules).astype(np.float32)

    def probability(self, evidence: np.ndarray, light: KindOfLight = SOFT_LIGHT) -> np.ndarray:
        """Probability (n,) float32 of evidence."""
        share = np.interp(evidence, self.evidence, self.shares)
        return (share * light.odds / (share * light.odds + 1 - share)).astype(np.float32)

    def write(self, path: Path) -> None:
        """Store the model."""
        np.savez_compressed(path, names=np.array(self.names), base=self.base, figure=self.figure.astype(np.uint8),
                            limit=self.limit, value=self.value, evidence=self.evidence, shares=self.shares)

    @classmethod
    def read(cls, path: Path = FILE) -> PaintModel:
        """A stored model."""
        with np.load(path, allow_pickle=False) as archive:
            return cls(tuple(archive["names"].tolist()), float(archive["base"]), archive["figure"].astype(np.intp),
                       archive["limit"], archive["value"], archive["evidence"], archive["shares"])


@lru_cache(maxsize=1)
def paint_model() -> PaintModel:
    """The model of this release."""
    return PaintModel.read()
