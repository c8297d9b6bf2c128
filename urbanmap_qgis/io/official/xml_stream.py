"""XML read as a stream: text in its own encoding, one object after another, no document types."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator
from typing import IO, cast

# Fed by `decoded`, which refuses document types.
from xml.etree.ElementTree import Element, ParseError, XMLPullParser  # nosec B405

from ...errors import InputError
from ...progress import SILENT, Progress
from ...wording import say
from .gsi_sources import XmlSource, opened

_CHUNK = 2**18
_LONGEST_PROLOG = 2**22
_NOT_MARKUP = re.compile(r"<!--.*?(?:-->|\Z)|<\?.*?(?:\?>|\Z)", re.DOTALL)
_DECLARED = re.compile(rb"""^\s*<\?xml[^>]*?encoding\s*=\s*["']([A-Za-z0-9._:-]+)["']""")
# Windows programs write "Shift_JIS" and mean its superset, with characters such as U+2460 or U+9AD9.
_SUPERSETS = {"shift_jis": "cp932", "shift-jis": "cp932", "sjis": "cp932", "x-sjis": "cp932",
              "windows-31j": "cp932"}


def root_children(source: XmlSource, maker: str, largest: int, progress: Progress = SILENT,
                  ) -> Iterator[tuple[Element, Element]]:
    """Children of an XML file's root, each when it is whole, with the root (its attributes with the first).

    A child is dropped when the next one is asked for, so that memory does not grow with the file.

    Parameters
    ----------
    maker : who writes such files, for messages.
    largest : bytes that one child may have.

    Raises
    ------
    InputError : the XML is damaged or cut off, in an unreadable encoding, has a document type or too large an object.
    """
    with opened(source) as stream:
        parser = XMLPullParser(events=("start", "end"))
        root, depth = None, 0
        read = since = 0
        try:
            for text, size in decoded(stream, source.name, maker):
                read += size
                since += size
                parser.feed(text)
                for event, element in finished(parser):
                    depth += 1 if event == "start" else -1
                    if root is None:
                        root = element
                    elif event == "end" and depth == 1:
                        yield root, element
                        root.clear()
                        since = 0
                if since > largest:
                    raise InputError(say("{source} has an object of more than {largest} MB: get the file again from "
                                         "where it comes from.", source=source.name, largest=largest >> 20))
                progress.step(read / max(source.size, read, 1))
            parser.close()
        except ParseError as error:
            line, column = error.position
            raise InputError(say("{source} is not whole, valid XML (line {line}, column {column}): get the file "
                                 "again from where it comes from.", source=source.name, line=line,
                                 column=column)) from error


def decoded(stream: IO[bytes], name: str, maker: str) -> Iterator[tuple[str, int]]:
    """Pieces of text and their sizes in bytes, in the encoding that the XML declares.

    The XML parser itself knows no Shift_JIS; given text it passes over the declared encoding. A document type is
    refused: entities in it could be a bomb, or name other files. `maker` names who writes such files, for messages.

    Raises
    ------
    InputError : the encoding is unknown, bytes are not in it, or there is a document type.
    """
    decoder, prolog = None, True
    start = ""
    while True:
        data = stream.read(_CHUNK)
        if decoder is None:
            decoder = _decoder(data, name)
        try:
            text = decoder.decode(data, final=not data)
        except UnicodeError as error:
            encoding = getattr(error, "encoding", "text in the encoding that it declares")
            raise InputError(say("{name} holds bytes that are not valid {encoding}: download it again or correct its "
                                 "declared encoding.", name=name, encoding=encoding)) from error
        if prolog:
            start += text
            if len(start) > _LONGEST_PROLOG:
                raise InputError(say("{name} has no object in its first {longest_prolog} MB: get the file again from "
                                     "where it comes from.", name=name, longest_prolog=_LONGEST_PROLOG >> 20))
            plain = _NOT_MARKUP.sub("", start)
            if "<!DOCTYPE" in plain:
                raise InputError(say("{name} has a document type declaration, which {maker} never has and which may "
                                     "be harmful: get the file again from where it comes from.", name=name,
                                     maker=maker))
            prolog = re.search(r"<[^!?\s]", plain) is None
        if text:
            yield text, len(data)
        if not data:
            return


def _decoder(start: bytes, name: str) -> codecs.IncrementalDecoder:
    declared = _DECLARED.match(start)
    if start.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encoding = "utf-16"
    elif start.startswith(codecs.BOM_UTF8) or declared is None:
        encoding = "utf-8-sig"
    else:
        encoding = declared.group(1).decode("ascii").lower()
    try:
        known = codecs.lookup(_SUPERSETS.get(encoding, encoding))
        if not known._is_text_encoding or known.incrementaldecoder is None:
            raise LookupError(encoding)
        return known.incrementaldecoder()
    except LookupError as error:
        raise InputError(say("{name} declares the unknown encoding {encoding}: save it as UTF-8.", name=name,
                             encoding=encoding)) from error


def finished(parser: XMLPullParser) -> Iterator[tuple[str, Element]]:
    """Elements that a parser has met since it was last asked, each with its event: "start" or "end"."""
    return cast("Iterator[tuple[str, Element]]", parser.read_events())
