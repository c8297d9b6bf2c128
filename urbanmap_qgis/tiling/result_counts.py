"""What a run over tiles made, counted by the statuses of its features: buildings or walls, not tiles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..wording import say

BUILDINGS, WALLS = "buildings", "walls"


@dataclass(frozen=True)
class ResultCounts:
    """Features of the merged result.

    Attributes
    ----------
    things : what they are, `BUILDINGS` or `WALLS`.
    statuses : how many have each status.
    good, doubtful, missing : how many are as they should be, have a flaw, could not be made.
    """

    things: str
    statuses: Mapping[str, int]
    good: int
    doubtful: int
    missing: int

    @classmethod
    def of(cls, things: str, statuses: Mapping[str, int], good: Sequence[str], missing: Sequence[str]) -> ResultCounts:
        """Counts by which statuses are good and which say that nothing could be made."""
        sound, none = (sum(statuses.get(word, 0) for word in words) for words in (good, missing))
        return cls(things, dict(statuses), sound, sum(statuses.values()) - sound - none, none)

    @property
    def total(self) -> int:
        """How many there are."""
        return self.good + self.doubtful + self.missing

    def sentence(self) -> str:
        """The counts in words, for the verdict and the log alike."""
        counts = {"total": self.total, "good": self.good, "doubtful": self.doubtful, "missing": self.missing}
        text = (say("{total} walls: {good} ok, {doubtful} doubtful.", **counts) if self.things == WALLS else
                say("{total} buildings: {good} ok, {doubtful} doubtful, {missing} failed.", **counts))
        if self.doubtful or self.missing:
            text += " " + say("The field “status” of the merged layer tells which and why.")
        return text
