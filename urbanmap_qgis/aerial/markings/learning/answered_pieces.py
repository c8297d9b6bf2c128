"""What a user's answers to doubtful pieces teach: a correction of the confidence in images of that kind.

Few answers are given, and many figures are at hand: a logistic regression on the confidence and all figures, with a
prior that the confidence is right and no figure matters (ridge; the maximum of the posterior, by Newton's steps).
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from ....errors import InputError
from ....io.files.atomic import written_beside
from ....io.files.guard import read_json, reads
from ....wording import say


@dataclass(frozen=True)
class AnswersLimits:
    """Limits of what is learned from answers, each with its unit."""

    fewest: int = 2  # answers of each kind, with fewer nothing is learned
    surest: float = 0.98  # a confidence counts as this at most, and as no less than the rest to 1
    farthest: float = 3.0  # spreads from the centre, that figures are cut at
    # How surely no figure matters: inverse variance of a figure's weight. On two photographs 10 is a little better for
    # the rest of the photograph that was answered, 40 for others.
    figures_prior: float = 36.0
    slope_prior: float = 40.0  # likewise that the confidence counts as it is
    offset_prior: float = 0.1  # likewise that it is neither too high nor too low
    least_spread: float = 1e-2
    steps: int = 50
    settled: float = 1e-9


LIMITS = AnswersLimits()

KIND = "answers to road markings"


@dataclass(frozen=True)
class AnsweredCells:
    """Cells of pieces that were answered.

    Attributes
    ----------
    names : (m,) of the figures.
    figures : (n, m).
    confidence : (n,) before any answer, 0 to 1.
    answer : (n,) which answer each belongs to, from 0.
    paint : (k,) bool, the answers.
    pixels : (n,) bright pixels of each cell.
    spread_of : (2, m) centre and spread of the figures in the image.
    """

    names: tuple[str, ...]
    figures: np.ndarray
    confidence: np.ndarray
    answer: np.ndarray
    paint: np.ndarray
    pixels: np.ndarray
    spread_of: np.ndarray

    @property
    def weight(self) -> np.ndarray:
        """(n,) by which every answer counts as one, however many cells it covers."""
        total = np.bincount(self.answer, self.pixels, minlength=len(self.paint))
        return self.pixels / total[self.answer]


@dataclass(frozen=True)
class LearnedAnswers:
    """What was learned.

    Attributes
    ----------
    method : of the confidence that is corrected, "profile" or "trained".
    names : of the figures.
    centre, spread : of them in the image that was answered.
    weights : of the figures, in units of their spread.
    slope, offset : of the confidence's log odds.
    yes, no : answers that it was learned from.
    """

    method: str
    names: tuple[str, ...]
    centre: tuple[float, ...]
    spread: tuple[float, ...]
    weights: tuple[float, ...]
    slope: float
    offset: float
    yes: int
    no: int

    def corrected(self, confidence: np.ndarray, figures: Mapping[str, np.ndarray]) -> np.ndarray:
        """Confidence (n,) float32 of cells by that before and by their figures; those left out are as usual."""
        total = self.slope * log_odds(confidence) + self.offset
        for name, centre, spread, weight in zip(self.names, self.centre, self.spread, self.weights):
            if name in figures:
                total += weight * _cut((figures[name] - centre) / spread)
        return (1 / (1 + np.exp(-np.clip(total, -30, 30)))).astype(np.float32)

    def write(self, path: str | os.PathLike) -> None:
        """Store as JSON."""
        with written_beside(path) as temporary:
            Path(temporary).write_text(json.dumps({"kind": KIND, **asdict(self)}, indent=1), encoding="utf-8")


@reads("weights of answers")
def read_learned(path: str | os.PathLike) -> LearnedAnswers:
    """What `LearnedAnswers.write` stored.

    Raises
    ------
    InputError : it is something else.
    """
    stored = read_json(path, "weights of answers")
    try:
        if stored["kind"] != KIND or stored["method"] not in ("profile", "trained"):
            raise ValueError("kind")
        columns = [tuple(float(value) for value in stored[key]) for key in ("centre", "spread", "weights")]
        names = tuple(str(name) for name in stored["names"])
        if {len(column) for column in columns} != {len(names)} or min(columns[1], default=1.0) <= 0:
            raise ValueError("figures")
        return LearnedAnswers(stored["method"], names, *columns, float(stored["slope"]), float(stored["offset"]),
                              int(stored["yes"]), int(stored["no"]))
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(say("{path} holds no weights that were learned from answers: give the file that a run with "
                             "answers wrote.", path=Path(path).name)) from error


def log_odds(confidence: np.ndarray) -> np.ndarray:
    """Of a confidence, which is never quite sure."""
    sure = np.clip(confidence, 1 - LIMITS.surest, LIMITS.surest)
    return np.log(sure / (1 - sure))


def _cut(figures: np.ndarray) -> np.ndarray:
    return np.clip(figures, -LIMITS.farthest, LIMITS.farthest)


def spread_of(figures: Sequence[np.ndarray]) -> np.ndarray:
    """Centre and spread (2, m) of figures (n,) each: median, and that of 80 % in units of a normal distribution's."""
    low, middle, high = np.percentile(np.asarray(figures), [10, 50, 90], axis=1)
    return np.array([middle, np.maximum((high - low) / 2.5, LIMITS.least_spread)])


def learned_from(cells: AnsweredCells, method: str) -> LearnedAnswers:
    """Correction of a method's confidence by answers.

    Raises
    ------
    InputError : there are too few of either kind with anything bright and narrow inside.
    """
    answered = np.unique(cells.answer)
    yes, no = int(cells.paint[answered].sum()), int((~cells.paint[answered]).sum())
    if min(yes, no) < LIMITS.fewest:
        raise InputError(say("Of the answers, {yes} yes and {no} no lie on what may be paint in this image: {fewest} "
                             "of each are needed at least.", yes=yes, no=no, fewest=LIMITS.fewest))
    centre, spread = cells.spread_of
    rows = np.column_stack([_cut((cells.figures - centre) / spread), log_odds(cells.confidence),
                            np.ones(len(cells.answer))])
    before = np.zeros(rows.shape[1])
    before[-2] = 1.0
    stiff = np.full(rows.shape[1], LIMITS.figures_prior)
    stiff[-2:] = LIMITS.slope_prior, LIMITS.offset_prior
    *weights, slope, offset = _most_likely(rows, cells.paint[cells.answer], cells.weight, before, stiff).tolist()
    return LearnedAnswers(method, cells.names, tuple(centre.tolist()), tuple(spread.tolist()), tuple(weights), slope,
                          offset, yes, no)


def _most_likely(rows: np.ndarray, paint: np.ndarray, weight: np.ndarray, before: np.ndarray, stiff: np.ndarray
                 ) -> np.ndarray:
    """Coefficients (m,) of a logistic regression of answers (n,) on rows (n, m), with those expected `before` and
    their inverse variances `stiff`: the loss is convex, Newton's steps are halved where they would raise it."""

    def loss(coefficients: np.ndarray) -> float:
        total = rows @ coefficients
        return float(weight @ (np.logaddexp(0, total) - paint * total)
                     + 0.5 * stiff @ (coefficients - before) ** 2)

    found = before.copy()
    for _ in range(LIMITS.steps):
        likely = 1 / (1 + np.exp(-np.clip(rows @ found, -30, 30)))
        slope = rows.T @ (weight * (paint - likely)) - stiff * (found - before)
        bend = (rows * (weight * likely * (1 - likely))[:, None]).T @ rows + np.diag(stiff)
        step = np.linalg.solve(bend, slope)
        while loss(found + step) > loss(found) and np.abs(step).max() > LIMITS.settled:
            step /= 2
        found = found + step
        if np.abs(step).max() <= LIMITS.settled:
            break
    return found
