"""Where lines of a text end, in Japanese too, which has no blanks between words."""

from __future__ import annotations

import re
from collections.abc import Callable

_TOKEN = re.compile(r"[!-~]+|.", re.DOTALL)
"""What a line is not broken in: words of Latin letters; of Japanese every letter is one."""
_NEVER_FIRST = "、。，．）」』】〕］｝〉》・：；？！ーぁぃぅぇぉっゃゅょァィゥェォッャュョ々〜～％"


def broken_lines(text: str, fits: Callable[[str], bool]) -> list[str]:
    """A text in lines that fit, broken between words and between Japanese letters, where no line begins with the end of
    a bracket or a sentence."""
    lines, line = [], ""
    for token in _TOKEN.findall(text):
        for piece in ([token] if fits(token) else token):
            if not line or fits(line + piece):
                line += piece
            elif piece in _NEVER_FIRST and len(line) > 1:
                lines.append(line[:-1])
                line = line[-1] + piece
            else:
                lines.append(line.rstrip())
                line = piece.lstrip()
    return [*lines, line]
