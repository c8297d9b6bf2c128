"""What a reader of city models met besides plain buildings, in sentences."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from ..wording import say


@dataclass
class ReadingNotes:
    """What was met besides plain buildings, filled while they are walked through.

    Attributes
    ----------
    unread : elements that the record has no place for, by name.
    others : other kinds of city objects, by name.
    missing_lists, missing_images : names of code lists and images that are not there.
    repeated : ids met before.
    files : files read.
    """

    unread: Counter = field(default_factory=Counter)
    others: Counter = field(default_factory=Counter)
    missing_lists: set[str] = field(default_factory=set)
    missing_images: set[str] = field(default_factory=set)
    repeated: list[str] = field(default_factory=list)
    files: list[str] = field(default_factory=list)

    def sentences(self) -> list[str]:
        """One sentence for each."""
        texts = []
        if self.others:
            texts.append(say("City objects that are no buildings were passed over ({counts}).",
                             counts=_counts(self.others)))
        if self.unread:
            texts.append(say("Parts of buildings that have no place in the result were left out ({counts}).",
                             counts=_counts(self.unread)))
        if self.missing_lists:
            texts.append(say("{missing_lists_count} lists of codes are not there or damaged, so that codes stay as "
                             "they are ({missing_lists}).", missing_lists_count=len(self.missing_lists),
                             missing_lists=", ".join(sorted(self.missing_lists)[:3])))
        if self.missing_images:
            texts.append(say("{missing_images_count} images of textures are not there, not in the model's folder, or "
                             "no PNG, JPEG or TIFF ({missing_images}); their faces have none.",
                             missing_images_count=len(self.missing_images),
                             missing_images=", ".join(sorted(self.missing_images)[:3])))
        if self.repeated:
            texts.append(say("{repeated_count} ids are there more than once and got a number behind ({repeated}).",
                             repeated_count=len(self.repeated), repeated=", ".join(self.repeated[:3])))
        return texts


def _counts(counts: Counter) -> str:
    return ", ".join(f"{number} {name}" for name, number in counts.most_common())
