"""Damage to files, as transfers, full disks and hands do it, from a seeded generator: a part of `fuzz.py`."""

from __future__ import annotations

import random
import re

TEXTS = (b"nan", b"inf", b"-inf", b"1e308", b"-1e999", b"9" * 400, b"", b"\x00", b"\xff\xfe", b"[" * 3000, b"\xe9",
         b'"', b"a" * 200_000, b"0", b"-1", b"4294967296", b"2147483648")


def damaged(data: bytes, chance: random.Random) -> bytes:
    """The same content with one to four injuries."""
    made = bytearray(data)
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        _INJURIES[chance.randrange(len(_INJURIES))](made, chance)
    return bytes(made)


def _place(made: bytearray, chance: random.Random) -> int:
    """Anywhere, but half of the times near the beginning, where formats keep their counts."""
    return chance.randrange(min(len(made), 600) if chance.random() < 0.5 else len(made)) if made else 0


def _flip(made: bytearray, chance: random.Random) -> None:
    for _ in range(chance.choice((1, 3, 20))):
        if made:
            made[_place(made, chance)] = chance.randrange(256)


def _extreme(made: bytearray, chance: random.Random) -> None:
    place = _place(made, chance)
    made[place:place + 8] = chance.choice((b"\xff" * 8, b"\x00" * 8, b"\x00\x00\x00\x00\x00\x00\xf8\x7f",
                                           b"\x00\x00\x00\x00\x00\x00\xf0\x7f", b"\xff\xff\xff\x7f" * 2))


def _cut(made: bytearray, chance: random.Random) -> None:
    del made[_place(made, chance):]


def _gap(made: bytearray, chance: random.Random) -> None:
    place = _place(made, chance)
    del made[place:place + chance.choice((1, 5, 100, 5000))]


def _double(made: bytearray, chance: random.Random) -> None:
    place = _place(made, chance)
    made[place:place] = made[place:place + chance.choice((1, 20, 3000))]


def _number(made: bytearray, chance: random.Random) -> None:
    """A number in a text becomes another text."""
    found = list(re.finditer(rb"-?\d+\.?\d*", bytes(made[:200_000])))
    if found:
        one = chance.choice(found)
        made[one.start():one.end()] = chance.choice(TEXTS)


def _insert(made: bytearray, chance: random.Random) -> None:
    place = _place(made, chance)
    made[place:place] = chance.choice(TEXTS)


_INJURIES = (_flip, _extreme, _cut, _gap, _double, _number, _number, _insert)
