"""CityGML with some members cut out, replaced or added; every other byte stays as it was."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.parsers import expat

from ..errors import InputError
from ..io.files.atomic import written_beside
from ..wording import say

GML = "http://www.opengis.net/gml"
MEMBERS = ("cityObjectMember", "featureMember")


Members = Sequence[tuple[str, int, int]]
"""Members of a file in order: id of the object, first and last byte (excluded)."""


class _MemberParser:
    """Notes where members start and end while a file is parsed."""

    def __init__(self) -> None:
        self.members: list[tuple[str, int, int]] = []
        self.end = 0
        self._depth, self._start, self._id, self._closing = 0, 0, "", False
        self.parser = expat.ParserCreate(namespace_separator=" ")
        self.parser.StartElementHandler, self.parser.EndElementHandler = self._opened, self._closed
        self.parser.StartDoctypeDeclHandler = self._refused
        self.parser.DefaultHandler = self.parser.CharacterDataHandler = self.parser.CommentHandler = self._finish

    def _refused(self, *_declaration: object) -> None:
        """Entities of a document type can grow without bound."""
        raise expat.ExpatError("<!DOCTYPE")

    def _opened(self, name: str, attributes: Mapping[str, str]) -> None:
        self._finish()
        self._depth += 1
        if self._depth == 2 and name.rpartition(" ")[2] in MEMBERS:
            self._start, self._id = self.parser.CurrentByteIndex, ""
        elif self._depth == 3 and not self._id:
            self._id = attributes.get(f"{GML} id", "")

    def _closed(self, name: str) -> None:
        self._finish()
        self._closing = self._depth == 2 and name.rpartition(" ")[2] in MEMBERS
        if self._depth == 1:
            self.end = self.parser.CurrentByteIndex
        self._depth -= 1

    def _finish(self, _text: str = "") -> None:
        """Whatever follows a member's closing tag tells where that ends."""
        if self._closing:
            self.members.append((self._id, self._start, self.parser.CurrentByteIndex))
            self._closing = False


def members_of(path: Path) -> tuple[Members, int]:
    """Where the members of a CityGML file stand, and where the closing tag of the model begins.

    Raises
    ------
    InputError : it is no XML.
    """
    found = _MemberParser()
    try:
        with open(path, "rb") as file:
            found.parser.ParseFile(file)
    except expat.ExpatError as error:
        raise InputError(say("{path} is no sound XML ({error}): copy or download it again.", path=path.name,
                             error=str(error))) from error
    return found.members, found.end


def write_spliced(target: Path, source: Path, gone: frozenset[str],
                  replaced: Mapping[str, bytes], added: Sequence[bytes] = ()) -> None:
    """Write a CityGML file without the members of ids that are gone, others replaced and some added at the end.

    Parameters
    ----------
    replaced : by id the whole member, tags and its namespaces included; `added` likewise.
    """
    data, (members, last) = source.read_bytes(), members_of(source)
    with written_beside(target) as temporary, open(temporary, "wb") as file:
        done = 0
        for name, start, end in members:
            if name in gone or name in replaced:
                file.write(data[done:start] + (b"" if name in gone else replaced[name]))
                done = end
        file.write(data[done:last])
        file.writelines(added)
        file.write(data[last:])


def member_bytes(source: Path) -> dict[str, bytes]:
    """Bytes of each member by its id, with the namespaces of its file declared on its object."""
    data = source.read_bytes()
    spaces = namespaces_of(data)
    result = {}
    for name, start, end in members_of(source)[0]:
        cut = data.index(b">", start)
        result[name] = data[start:cut] + spaces + data[cut:end]
    return result


def namespaces_of(data: bytes) -> bytes:
    """Declarations of namespaces of a file's first element, each with a blank before it."""
    first = re.search(rb"<[A-Za-z_][^>]*>", data)
    return b"".join(b" " + each for each in re.findall(rb'xmlns(?::[\w.-]+)?="[^"]*"', first.group() if first else b""))
