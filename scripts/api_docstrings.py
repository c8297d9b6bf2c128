"""Docstrings of the core as numpydoc has them, for the website's pages of the core: an extension of griffe.

The sources say `name : what it is` on one line, which numpydoc takes for a type, since types are in the signatures.
Here the text goes to the line below the name, and a section of what is returned becomes a paragraph. The sources stay.
"""

from __future__ import annotations

import re

import griffe

_NAMED = ("Parameters", "Attributes", "Raises")
_ITEM = re.compile(r"(?P<names>`?\*{0,2}[\w.]+`?(?:, `?[\w.]+`?)*) : (?P<text>.+)")


class FieldText(griffe.Extension):
    """Rewrites every docstring that is read, before it is taken apart."""

    def on_object(self, *, obj: griffe.Object, **kwargs) -> None:
        """A module, class, function or attribute was read."""
        if obj.docstring is not None:
            obj.docstring.value = as_numpydoc(obj.docstring.value)


def as_numpydoc(text: str) -> str:
    """A docstring with each item's text below its name."""
    lines, section = [], ""
    rows = text.splitlines()
    for number, line in enumerate(rows):
        following = rows[number + 1].strip() if number + 1 < len(rows) else ""
        if following and not following.strip("-"):
            section = line.strip()
            if section in ("Returns", "Yields"):
                line = f"**{section}**"
        elif not line.strip():
            section = ""
        elif section in ("Returns", "Yields") and not line.strip().strip("-"):
            line = ""
        elif section in _NAMED and (item := _ITEM.match(line)):
            lines.append(item["names"].replace("`", ""))
            line = f"    {item['text']}"
        lines.append(line)
    return "\n".join(lines)
