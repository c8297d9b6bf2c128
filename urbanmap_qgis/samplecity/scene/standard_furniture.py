"""Posts, lamps, signs and signals along the main streets in the sizes of three countries' published standards.

Japan: signals 警交仕規 245 and 247 (lamps of 250 and 300 mm in a row, walkers' of 250 mm), signs 道路標識設置基準,
lighting 道路照明施設設置基準. Germany: signals RiLSA 2015 with DIN EN 12368 (lamps of 200 and 300 mm over each other),
signs VzKat and HAV, lighting DIN EN 40. United States: signals MUTCD 2009, 4D and 4E (12 inch lamps), signs MUTCD 2A
and SHSM, lighting AASHTO GL-7.
"""

from __future__ import annotations

import numpy as np
import shapely

from .furniture import is_clear, world_place
from .ground import Ground
from .model import Furniture, Tree

SPACING, BEHIND, CLEAR, BESIDE, BRACKET = 8.0, 0.5, 2.6, 2.0, 0.05
"""m between things of one side; from the kerb line to an axis; of a tree; of a crossing street; side of a bracket."""

Range = tuple[float, float]
Design = tuple[str, Range, Range, Range, Range, tuple[float, float, float]]

DESIGNS: dict[str, tuple[Design, ...]] = {
    # Kind; ranges of the post's side, of its height over the lower edge of what hangs there, of that one's distance
    # from the axis, of the lower edge's height; sides of it along the street, across it and up, m.
    "japan": (
        ("pole", (0.2, 0.32), (0.0, 0.0), (0.0, 0.0), (7.0, 12.0), (0.0, 0.0, 0.0)),
        ("lamp post", (0.16, 0.16), (0.12, 0.12), (1.2, 2.6), (8.0, 10.0), (0.35, 0.75, 0.14)),
        ("sign", (0.076, 0.076), (0.6, 0.6), (0.0, 0.0), (1.8, 2.5), (0.02, 0.6, 0.6)),
        ("sign", (0.076, 0.076), (0.7, 0.7), (0.0, 0.0), (1.8, 2.5), (0.02, 0.8, 0.7)),
        ("sign", (0.076, 0.076), (1.0, 1.0), (0.0, 0.0), (1.8, 2.5), (0.02, 0.6, 1.0)),
        ("signal", (0.114, 0.114), (1.1, 1.1), (0.45, 0.45), (2.6, 3.0), (0.2, 0.38, 0.82)),
        ("signal", (0.216, 0.216), (1.0, 1.6), (2.5, 4.8), (5.1, 5.6), (0.24, 1.2, 0.45)),
        ("signal", (0.216, 0.216), (1.0, 1.6), (2.5, 4.8), (5.1, 5.6), (0.2, 1.05, 0.36))),
    "germany": (
        ("pole", (0.08, 0.16), (0.0, 0.0), (0.0, 0.0), (3.0, 6.0), (0.0, 0.0, 0.0)),
        ("lamp post", (0.12, 0.12), (0.07, 0.07), (0.0, 0.0), (4.9, 5.0), (0.45, 0.45, 0.3)),
        ("lamp post", (0.14, 0.14), (0.1, 0.1), (0.9, 1.8), (7.0, 9.0), (0.25, 0.6, 0.1)),
        ("sign", (0.06, 0.06), (0.42, 0.42), (0.0, 0.0), (2.0, 2.3), (0.02, 0.42, 0.42)),
        ("sign", (0.06, 0.06), (0.78, 0.78), (0.0, 0.0), (2.0, 2.3), (0.02, 0.9, 0.78)),
        ("sign", (0.06, 0.06), (0.9, 0.9), (0.0, 0.0), (2.0, 2.3), (0.02, 0.6, 0.9)),
        ("signal", (0.108, 0.108), (0.86, 0.86), (0.25, 0.25), (2.1, 2.4), (0.25, 0.28, 0.56)),
        ("signal", (0.108, 0.108), (1.15, 1.15), (0.25, 0.25), (2.1, 2.6), (0.25, 0.28, 0.85)),
        ("signal", (0.18, 0.18), (1.4, 1.9), (2.5, 4.5), (4.6, 5.0), (0.3, 0.36, 1.06))),
    "us": (
        ("pole", (0.1, 0.36), (0.0, 0.0), (0.0, 0.0), (3.0, 11.0), (0.0, 0.0, 0.0)),
        ("lamp post", (0.2, 0.2), (0.14, 0.14), (2.2, 3.9), (9.0, 11.0), (0.36, 0.7, 0.18)),
        ("sign", (0.06, 0.06), (0.76, 0.76), (0.0, 0.0), (2.1, 2.3), (0.02, 0.76, 0.76)),
        ("sign", (0.06, 0.06), (0.91, 0.91), (0.0, 0.0), (2.1, 2.3), (0.02, 0.91, 0.91)),
        ("sign", (0.06, 0.06), (0.61, 0.61), (0.0, 0.0), (2.1, 2.3), (0.02, 0.46, 0.61)),
        ("signal", (0.114, 0.114), (0.72, 0.72), (0.3, 0.3), (2.2, 3.0), (0.22, 0.46, 0.42)),
        ("signal", (0.114, 0.114), (1.37, 1.37), (0.3, 0.3), (2.5, 3.4), (0.25, 0.36, 1.07)),
        ("signal", (0.3, 0.3), (1.4, 2.0), (3.0, 4.6), (5.1, 5.7), (0.25, 0.62, 1.33))),
}


def standard_furniture(ground: Ground, size: float, country: str, trees: tuple[Tree, ...],
                       rng: np.random.Generator) -> tuple[Furniture, ...]:
    """Things of one country's standards along both sides of the main streets; `standing` tells what each post is."""
    things: list[Furniture] = []
    trunks = np.array([[tree.x, tree.y] for tree in trees]).reshape(-1, 2)
    for street in (street for street in ground.streets if street.name in ("A", "B")):
        for side in (1, -1):
            for start in np.arange(-size / 2 + SPACING / 2, size / 2 - SPACING / 2, SPACING):
                along = float(start + rng.uniform(-1.0, 1.0))
                sense = side if street.along == "u" else -side
                made = _made(DESIGNS[country][int(rng.integers(len(DESIGNS[country])))], sense, rng)
                across = street.at + side * (street.half_width + BEHIND)
                foot = world_place(ground, street, along, across)
                if (np.hypot(*(trunks - foot).T).min(initial=np.inf) > CLEAR
                        and is_clear(ground, street, along, BESIDE)):
                    z = float(ground.height(*foot))
                    for (a0, a1), (b0, b1), (low, high), kind in made:
                        corners = [world_place(ground, street, along + a, across - side * b)
                                   for a, b in ((a0, b0), (a1, b0), (a1, b1), (a0, b1))]
                        things.append(Furniture(shapely.Polygon(corners), z + low, z + high, standing=kind))
    return tuple(things)


def _made(design: Design, sense: int, rng: np.random.Generator) -> list[tuple[Range, Range, Range, str]]:
    """Boxes of a post, the brackets or the arm, and what hangs there: ranges along the street and over the road from
    the axis, and of height, m; the post's kind. `sense` along the street of those who see them."""
    kind, *ranges, (deep, wide, tall) = design
    post, over, reach, foot = (rng.uniform(*each) for each in ranges)
    boxes = [(_about(0.0, post), _about(0.0, post), (-0.2, foot + over), kind)]
    if not wide:
        return boxes
    # Thin boards hang before their posts, heads and lamps at the axis of theirs.
    before = -sense * (post + deep) / 2.0 if deep < BRACKET else 0.0
    middle = foot + tall / 2.0
    arms = [middle] if reach > 2.0 * wide or tall < wide / 2.0 else [middle - tall / 4.0, middle + tall / 4.0]
    boxes += [(_about(0.0, BRACKET), (0.0, reach), _about(up, BRACKET), "") for up in arms if reach]
    return [*boxes, (_about(before, deep), _about(reach, wide), (foot, foot + tall), "")]


def _about(middle: float, side: float) -> Range:
    return middle - side / 2.0, middle + side / 2.0
