"""Arrows and diamonds on the road, told by their shape."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Set
from dataclasses import dataclass, replace

import numpy as np
import shapely
from scipy.spatial import cKDTree
from shapely import affinity

from .arrow_places import ArrowSurroundings, before_crosswalks, crosswalk_ahead, usual_values
from .crosswalks import Crosswalk
from .strokes import Stroke
from .symbol_patterns import CELL, COLUMNS, HALF, MORE, ROWS, PatternMatch, matches


@dataclass(frozen=True)
class SymbolsLimits:
    """Limits of symbols, each with its unit."""

    # Harmonic mean of the share of the pattern that is painted and of that of the paint about it in it; both, at
    # least.
    least_score: float = 0.72
    least_complete: float = 0.55
    least_precise: float = 0.82
    least_lead: float = 0.05  # By so much the best kind must be ahead of the next, and its heading of the opposite one.
    # Paint wider than the first (m) is no shaft; what is left of it when so much is taken off its edges is a head
    # where it has so much area (m2) and is no longer than the last (m).
    stroke: float = 0.3
    least_head: float = 0.015
    longest_head: float = 2.6
    # So much of each side of an arrow's heads must be painted, and so much of them in the mean.
    least_flank: float = 0.2
    least_flanks: float = 0.5
    # What must be painted of an arrow that stands in a row with another one, shares as above, and of its heads so much
    # of the better side; two of which neither is sure by itself need the higher score in one of them.
    row_score: float = 0.6
    row_seed: float = 0.7
    row_complete: float = 0.35
    row_precise: float = 0.7
    row_flank: float = 0.3
    # Arrows of a row lie side by side at a lane's width, their tails so near to one cross-section, m.
    lane_width: tuple[float, float] = (2.4, 4.2)
    row_along: float = 0.6
    # Arrows are repeated in their lane: steps (m) of so many pairs of sure ones that agree to the next (m); one is
    # looked for so near (m) beside the course of the one that it repeats, with its kind.
    repeat: tuple[float, float] = (7.0, 40.0)
    repeat_pairs: int = 2
    repeat_same: float = 0.4
    repeat_across: float = 0.35
    repeat_course: float = 0.995  # cosine of the angle between them
    # So many sure arrows at one distance before crosswalks, to so much (m), make it a usual one.
    place_arrows: int = 3
    place_same: float = 0.4
    # An arrow has one head only where no more of a second one is painted, and so much of the paint beside the
    # place of that is there: where the paint is worn or hidden, so may be the head. A head wears in so many places by
    # themselves, each as likely as the paint beside it: all of them together are gone with the chance told.
    most_branch: float = 0.05
    least_beside: float = 0.8
    head_places: int = 4
    head_gone: float = 0.03
    longest_bare: float = 0.5  # A longer bare piece of the paint beside, m, may have hidden the head too.
    # So much of its shaft must be painted where less of the paint beside is there: wedges of light between shadows have
    # heads alone.
    least_shaft: float = 0.6
    head_margin: float = 0.05  # m about its heads, that is none of the shaft
    # Long and short side of what may be a diamond, m.
    diamond: tuple[tuple[float, ...], ...] = ((3.0, 6.5), (0.9, 2.2))
    # Long and short side of the worn pieces of an arrow together, how far apart and how large (m2) they may be, m.
    along: tuple[float, float] = (1.5, 6.2)
    across: tuple[float, float] = (0.35, 1.7)
    joined: float = 0.5
    piece: float = 2.0
    same: float = 1.5  # A head so near the middle of the pieces is theirs, m.
    # A bar no longer than a shaft, with a head so far beyond its end and beside its course, m.
    longest_shaft: float = 4.2
    beyond: float = 1.8
    beside: float = 0.8
    road: float = 8.0  # Lines so near tell the direction of the road, m.
    member: float = 0.2  # Paint this near the pattern belongs to the symbol, m.


LIMITS = SymbolsLimits()

SPACING = 0.45
"""Pieces of one diamond lie no farther apart, m (worn paint falls into pieces)."""

UNKNOWN_ARROW = "arrow, kind unknown"


@dataclass(frozen=True)
class Symbol:
    """A symbol on the road.

    Attributes
    ----------
    kind : such as "arrow straight", "arrow left", "diamond", or `UNKNOWN_ARROW`.
    area : its paint.
    polygons : numbers of the polygons that it is made of.
    heading : direction (2,) in which it is read, NaN where unknown.
    score : 0 to 1, how well paint and pattern agree.
    tail : place (2,) where it begins as it is read best.
    course : direction (2,) in which it is read best, sure or not.
    sure : it shows enough by itself; else only in a row with another one, or where arrows usually stand.
    likely, gone : its kind but for a second head that wear may have taken, and the chance that it has; "" and 0 where
        that is not why the kind is open.
    """

    kind: str
    area: shapely.Geometry
    polygons: tuple[int, ...]
    heading: np.ndarray
    score: float
    tail: np.ndarray
    course: np.ndarray
    sure: bool = True
    likely: str = ""
    gone: float = 0.0


def find_symbols(polygons: Sequence[shapely.Polygon], strokes: Sequence[Stroke], taken: set[int],
                 bars: Set[int] = frozenset(), crosswalks: Sequence[Crosswalk] = ()) -> list[Symbol]:
    """Arrows and diamonds among marking polygons.

    Parameters
    ----------
    strokes : of the polygons; long ones tell the direction of the road.
    taken : numbers of polygons that are none.
    bars : numbers of straight bars: none either, but for the shaft that wear has cut off from its head.
    crosswalks : an arrow that does not show enough by itself is one where it stands as far before them as others do.

    Returns
    -------
    Symbols that share no paint. An arrow whose best kinds agree about as well, or where a second head may be worn or
    hidden, is `UNKNOWN_ARROW`; one that may be read both ways has no heading.
    """
    shapes = np.asarray(polygons, object)
    free = np.array([n for n in range(len(shapes)) if n not in taken and n not in bars], np.int64)
    if not len(free):
        return []
    heads = _heads(shapes[free])
    places = [*heads, *_pieces(shapes[free], heads), *_diamonds(shapes[free])]
    free = np.concatenate([free, _shafts(shapes, sorted(bars - taken), places)])
    about = ArrowSurroundings(strokes, shapes[sorted(taken)])
    search, direction_near = _Search(shapes, free, about), _direction_of(strokes, crosswalks)
    courses = [direction_near(place) for place, _ in places]
    found = [search.at(place, course, wanted) for (place, wanted), course in zip(places, courses) if course is not None]
    found = [symbol for symbol in found if symbol is not None]
    accepted = _disjoint([symbol for symbol in found if symbol.sure], [])
    shafts = [n for n in sorted(bars - taken - set(free.tolist())) if _sides(shapes[n])[0] <= LIMITS.longest_shaft]
    rows = _Search(shapes, np.concatenate([free, np.array(shafts, np.int64)]), about)
    return _with_usual_kinds(_with_rows(accepted, [symbol for symbol in found if not symbol.sure], rows, crosswalks))


def _disjoint(symbols: Sequence[Symbol], accepted: Sequence[Symbol]) -> list[Symbol]:
    """The accepted ones and, best first, those that share no paint with any before them."""
    used = {n for symbol in accepted for n in symbol.polygons}
    taken = list(accepted)
    for symbol in sorted(symbols, key=lambda one: -one.score):
        if used.isdisjoint(symbol.polygons):
            used |= set(symbol.polygons)
            taken.append(symbol)
    return taken


def _with_rows(accepted: Sequence[Symbol], unsure: Sequence[Symbol], search: _Search,
               crosswalks: Sequence[Crosswalk]) -> list[Symbol]:
    """The accepted symbols and the arrows that stand in a row with one of them or with each other, lane beside lane,
    or repeat a sure one in its lane, or stand as far before a crosswalk as sure ones do.

    A row or a crosswalk tells the heading too.
    """
    taken = list(accepted)
    steps = _steps_of_repeats(taken)
    waiting = [symbol for symbol in _disjoint(unsure, taken) if symbol.kind.startswith("arrow")]
    placed = {id(one) for one in _at_usual_places(waiting, taken, crosswalks)}
    while waiting:
        seed = waiting.pop(0)
        mates = [mate for side in (-1.0, 1.0) if (mate := search.beside(seed, side)) is not None]
        if seed.sure or id(seed) in placed:
            mates += [mate for step in steps for way in (-step, step)
                      if (mate := search.repeated(seed, way)) is not None]
        if not (seed.sure or mates or id(seed) in placed):
            continue
        settled = replace(seed, sure=True, heading=seed.course if mates or id(seed) in placed else seed.heading)
        known = len(taken)
        if seed.sure:
            taken = [settled if one is seed else one for one in taken]
        else:
            taken = _disjoint([settled], taken)
        taken = _disjoint(mates, taken)
        waiting += [one for one in taken[known:] if one is not settled]
    return _with_kinds_of_repeats(taken, steps)


def _with_kinds_of_repeats(symbols: Sequence[Symbol], steps: Sequence[float]) -> list[Symbol]:
    """The symbols; an arrow whose kind is open takes that of those repeated in its lane, where these agree."""
    one, other, ahead = _in_lanes(symbols)
    repeats = (np.abs(np.abs(ahead)[:, None] - np.asarray(steps)) < LIMITS.row_along).any(axis=1)
    kinds: dict[int, set[str]] = {}
    for symbol, mate in zip(one[repeats].tolist(), other[repeats].tolist()):
        kinds.setdefault(symbol, set()).add(symbols[mate].kind)
    settled = list(symbols)
    for number, found in kinds.items():
        found -= {UNKNOWN_ARROW, "diamond"}
        if symbols[number].kind == UNKNOWN_ARROW and len(found) == 1:
            settled[number] = replace(symbols[number], kind=found.pop(), heading=symbols[number].course)
    return settled


def _in_lanes(symbols: Sequence[Symbol]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Symbols of one lane, read alike: pairs of their numbers both ways, and how far (m) the other lies ahead."""
    if len(symbols) < 2:
        return np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0)
    tail, course = np.array([one.tail for one in symbols]), np.array([one.course for one in symbols])
    pairs = cKDTree(tail).query_pairs(LIMITS.repeat[1] + LIMITS.row_along, output_type="ndarray")
    one, other = np.vstack([pairs, pairs[:, ::-1]]).T
    way, along = tail[other] - tail[one], course[one]
    across = np.abs(way[:, 1] * along[:, 0] - way[:, 0] * along[:, 1])
    alike = np.einsum("ij,ij->i", along, course[other]) > LIMITS.repeat_course
    near = alike & (across < LIMITS.repeat_across)
    return one[near], other[near], np.einsum("ij,ij->i", way, along)[near]


def _steps_of_repeats(symbols: Sequence[Symbol]) -> list[float]:
    """Distances (m) at which arrows of one lane are repeated in this map, the usual one first."""
    arrows = [symbol for symbol in symbols if symbol.kind.startswith("arrow") and np.isfinite(symbol.heading).all()]
    ahead = _in_lanes(arrows)[2]
    return usual_values(ahead[(ahead > LIMITS.repeat[0]) & (ahead < LIMITS.repeat[1])], LIMITS.repeat_same,
                        LIMITS.repeat_pairs)


def _at_usual_places(arrows: Sequence[Symbol], sure: Sequence[Symbol],
                     crosswalks: Sequence[Crosswalk]) -> list[Symbol]:
    """Those of the arrows that stand as far before a crosswalk as several of the sure ones do."""
    told = [one for one in sure if one.kind.startswith("arrow") and np.isfinite(one.heading).all()]
    known, own = (before_crosswalks(np.array([one.tail for one in each]).reshape(-1, 2),
                                    np.array([one.course for one in each]).reshape(-1, 2), crosswalks)
                  for each in (told, arrows))
    usual = usual_values(known[np.isfinite(known)], LIMITS.place_same, LIMITS.place_arrows)
    return [one for one, at in zip(arrows, own) if any(abs(at - place) < LIMITS.row_along for place in usual)]


def _with_usual_kinds(symbols: Sequence[Symbol]) -> list[Symbol]:
    """The symbols; an arrow whose second head may be worn away has none where arrows with two are rare in this map."""
    told = [symbol.kind for symbol in symbols if symbol.kind.startswith("arrow") and symbol.kind != UNKNOWN_ARROW]
    share = (sum(kind.startswith(MORE) for kind in told) + 0.5) / (len(told) + 1.0)  # less certain the fewer there are
    settled = []
    for symbol in symbols:
        hidden = share * symbol.gone
        rare = hidden < LIMITS.head_gone * (hidden + 1.0 - share) and np.isfinite(symbol.heading).all()
        settled.append(replace(symbol, kind=symbol.likely) if symbol.likely and rare and symbol.kind == UNKNOWN_ARROW
                       else symbol)
    return settled


def _heads(shapes: np.ndarray) -> list[tuple[np.ndarray, str]]:
    """Middles (2,) of parts of paint too wide for a shaft and not too long: a plain stroke is no arrow."""
    cores = shapely.get_parts(shapely.buffer(shapes, -LIMITS.stroke / 2.0, quad_segs=2))
    box = shapely.bounds(cores)
    size = np.hypot(box[:, 2] - box[:, 0], box[:, 3] - box[:, 1])
    good = (shapely.area(cores) >= LIMITS.least_head) & (size < LIMITS.longest_head)
    return [(middle, "arrow") for middle in shapely.get_coordinates(shapely.centroid(cores[good]))]


def _pieces(shapes: np.ndarray, heads: Sequence[tuple[np.ndarray, str]]) -> list[tuple[np.ndarray, str]]:
    """Middles (2,) of polygons without a head that lie together and have an arrow's size, as wear leaves them."""
    small = shapes[shapely.area(shapes) < LIMITS.piece]
    blobs = shapely.get_parts(shapely.union_all(shapely.buffer(small, LIMITS.joined / 2, quad_segs=2)))
    frames = shapely.get_coordinates(shapely.minimum_rotated_rectangle(blobs)).reshape(-1, 5, 2)[:, :3]
    sides = np.sort(np.linalg.norm(np.diff(frames, axis=1), axis=2), axis=1) - LIMITS.joined
    (short, wide), (least, most) = LIMITS.across, LIMITS.along
    fits = (sides[:, 0] >= short) & (sides[:, 0] <= wide) & (sides[:, 1] >= least) & (sides[:, 1] <= most)
    middles = shapely.centroid(blobs[fits])
    if heads:
        known = shapely.multipoints([head for head, _ in heads])
        middles = middles[shapely.distance(middles, known) > LIMITS.same]
    return [(middle, "arrow") for middle in shapely.get_coordinates(middles)]


def _shafts(shapes: np.ndarray, bars: Sequence[int], places: Sequence[tuple[np.ndarray, str]]) -> np.ndarray:
    """Numbers of the bars no longer than a shaft that have what may be a head beyond one end."""
    if not len(bars) or not places:
        return np.zeros(0, np.int64)
    tree = shapely.STRtree(shapely.points([place for place, _ in places]))
    shafts = []
    for number in bars:
        length, along, middle = _sides(shapes[number])
        if length > LIMITS.longest_shaft:
            continue
        for near in tree.query(shapely.Point(middle), predicate="dwithin", distance=length / 2 + LIMITS.beyond):
            off = places[near][0] - middle
            if abs(off @ along) > length / 2 - LIMITS.joined and abs(off @ [-along[1], along[0]]) < LIMITS.beside:
                shafts.append(number)
                break
    return np.array(shafts, np.int64)


def _sides(shape: shapely.Geometry) -> tuple[float, np.ndarray, np.ndarray]:
    """Length of a bar, m, its direction (2,) and its middle (2,)."""
    box = shapely.get_coordinates(shapely.minimum_rotated_rectangle(shape))[:4]
    edge = box[1:3] - box[:2]
    length = np.linalg.norm(edge, axis=1)
    return float(length.max()), edge[length.argmax()] / length.max(), box.mean(axis=0)


def _diamonds(shapes: np.ndarray) -> list[tuple[np.ndarray, str]]:
    """Middles (2,) of polygons that lie together and have a diamond's size."""
    small = shapes[shapely.area(shapes) < 4.0]
    blobs = shapely.get_parts(shapely.union_all(shapely.buffer(small, SPACING / 2, quad_segs=2)))
    diamonds = []
    for frame in shapely.minimum_rotated_rectangle(blobs):
        corners = shapely.get_coordinates(frame)[:3]
        sides = np.sort(np.linalg.norm(np.diff(corners, axis=0), axis=1)) - SPACING
        if len(sides) == 2 and all(low <= side <= high for side, (low, high) in zip(sides[::-1], LIMITS.diamond)):
            diamonds.append((np.array(frame.centroid.coords[0]), "diamond"))
    return diamonds


def _direction_of(strokes: Sequence[Stroke],
                  crosswalks: Sequence[Crosswalk]) -> Callable[[np.ndarray], np.ndarray | None]:
    """Function of a place: direction of the nearest long, narrow and straight stroke, else of its road's crosswalk;
    None where neither is near."""
    long = [stroke for stroke in strokes if stroke.length >= 2.5 and stroke.width <= 0.3 and
            (len(stroke.axis) == 2 or stroke.length >= 5.0)]
    tree = shapely.STRtree([shapely.LineString(stroke.axis) for stroke in long])

    def direction(place: np.ndarray) -> np.ndarray | None:
        near = tree.query_nearest(shapely.Point(place), max_distance=LIMITS.road) if long else []
        return long[near[0]].direction if len(near) else crosswalk_ahead(place, crosswalks)

    return direction


class _Search:
    """Symbols in the polygons `free` (numbers) of all `shapes`."""

    def __init__(self, shapes: np.ndarray, free: np.ndarray, about: ArrowSurroundings):
        self.free, self.tree, self.about = free, shapely.STRtree(shapes[free]), about

    def at(self, place: np.ndarray, along: np.ndarray, wanted: str) -> Symbol | None:
        """The symbol at a place of a road along a direction, None where no pattern fits or the best is not wanted.

        An arrow that would not do by itself but may in a row is not `sure`.
        """
        near, paint = self._window(place, along)
        fits = [match for match in matches(paint, LIMITS.least_complete, LIMITS.least_score - LIMITS.least_lead)
                if match.precise >= min(LIMITS.least_precise, LIMITS.row_precise)]
        if not fits:
            return None
        painted = shapely.union_all(paint)
        sure = [match for match in fits if match.precise >= LIMITS.least_precise and _has_heads(match, painted)]
        if sure and sure[0].score >= LIMITS.least_score and sure[0].kind.startswith(wanted):
            symbol = self._symbol(sure, place, along, near, paint, painted)
            clear = symbol is not None and symbol.kind != UNKNOWN_ARROW and _beside_heads(
                sure[0], painted) >= LIMITS.least_beside
            if symbol is not None and (clear or _shaft_share(sure[0], painted) >= LIMITS.least_shaft):
                return symbol
        unsure = _in_row(fits, painted) if wanted == "arrow" else []
        if not unsure or unsure[0].score < LIMITS.row_seed:
            return None
        symbol = self._symbol(unsure, place, along, near, paint, painted)
        return None if symbol is None else replace(symbol, sure=False)

    def beside(self, seed: Symbol, side: float) -> Symbol | None:
        """The arrow in a row with one, a lane's width to its right (1) or left (-1), read as it is."""
        along = seed.course
        low, high = LIMITS.lane_width
        place = seed.tail + HALF * along + side * (low + high) / 2.0 * np.array([along[1], -along[0]])
        near, paint = self._window(place, along)
        spare = (high - low) / 2.0
        box = (-spare, spare, -HALF - LIMITS.row_along, -HALF + LIMITS.row_along)
        fits = [match for match in matches(paint, LIMITS.row_complete, LIMITS.row_score, box) if not match.backwards]
        if not fits:
            return None
        painted = shapely.union_all(paint)
        fits = _in_row(fits, painted)
        symbol = self._no_line(self._symbol(fits, place, along, near, paint, painted)) if fits else None
        return symbol if symbol is None or symbol.kind != UNKNOWN_ARROW else replace(symbol, heading=along)

    def repeated(self, seed: Symbol, step: float) -> Symbol | None:
        """The arrow of a seed's lane and kind, a step (m) ahead of it or behind."""
        along = seed.course
        place = seed.tail + (HALF + step) * along
        near, paint = self._window(place, along)
        box = (-LIMITS.repeat_across, LIMITS.repeat_across, -HALF - LIMITS.row_along, -HALF + LIMITS.row_along)
        fits = [match for match in matches(paint, LIMITS.row_complete, LIMITS.row_score, box)
                if not match.backwards and match.precise >= LIMITS.row_precise and match.flanks
                and seed.kind in (match.kind, UNKNOWN_ARROW)]
        if not fits:
            return None
        symbol = self._no_line(self._symbol(fits, place, along, near, paint, shapely.union_all(paint)))
        if symbol is None:
            return None
        return replace(symbol, heading=along, kind=symbol.kind if seed.kind == UNKNOWN_ARROW else seed.kind)

    def _no_line(self, symbol: Symbol | None) -> Symbol | None:
        """The symbol; None where a piece of it is longer than an arrow, as worn lines beside a row of arrows are."""
        if symbol is None:
            return None
        pieces = self.tree.geometries[np.isin(self.free, symbol.polygons)]
        return symbol if all(_sides(piece)[0] <= LIMITS.along[1] for piece in pieces) else None

    def _window(self, place: np.ndarray, along: np.ndarray) -> tuple[np.ndarray, list[shapely.Geometry]]:
        """Which polygons lie about a place, and they in its frame."""
        across = np.array([along[1], -along[0]])
        reach = np.hypot(ROWS, COLUMNS) * CELL / 2
        near = self.tree.query(shapely.Point(place).buffer(reach), predicate="intersects")
        matrix = [*across, *along, -across @ place, -along @ place]
        return near, [affinity.affine_transform(self.tree.geometries[k], matrix) for k in near]

    def _symbol(self, fits: Sequence[PatternMatch], place: np.ndarray, along: np.ndarray, near: np.ndarray,
                paint: Sequence[shapely.Geometry], painted: shapely.Geometry) -> Symbol | None:
        """The symbol that the best of the matches is, None where no polygon of the paint (`painted` as one) lies in
        it, or what lies about it denies it."""
        best, across = fits[0], np.array([along[1], -along[0]])
        reached = best.shape.buffer(LIMITS.member)
        inside = np.array([shape.intersection(reached).area >= 0.5 * shape.area for shape in paint])
        if not inside.any():
            return None
        kind, gone = _kind(fits, painted)
        heading = _heading(fits, along)
        if kind == UNKNOWN_ARROW and best.kind != "arrow straight":
            heading = np.full(2, np.nan)  # the heads of a turn lie beside its shaft: told with its kind or not at all
        back = [across[0], along[0], across[1], along[1], *place]
        area = shapely.union_all([shape.intersection(reached) for shape in np.array(paint, object)[inside]])
        area, polygons = affinity.affine_transform(area, back), tuple(int(self.free[k]) for k in near[inside])
        tail, course = place + best.tail[0] * across + best.tail[1] * along, -along if best.backwards else along
        if kind != "diamond" and self.about.deny(area, tail, course, polygons):
            return None
        return Symbol(kind, area, polygons, heading, best.score, tail, course, True, best.kind if gone else "", gone)


def _in_row(fits: Sequence[PatternMatch], painted: shapely.Geometry) -> list[PatternMatch]:
    """The matches of arrows that show enough of themselves where another one stands beside them."""
    return [match for match in fits if match.flanks and match.precise >= LIMITS.row_precise and max(
        flank.intersection(painted).area / flank.area for flank in match.flanks) >= LIMITS.row_flank]


def _has_heads(match: PatternMatch, painted: shapely.Geometry) -> bool:
    """Whether both sides of each of an arrow's heads are painted: lines and bars have none."""
    shares = [flank.intersection(painted).area / flank.area for flank in match.flanks]
    return not shares or (min(shares) >= LIMITS.least_flank and float(np.mean(shares)) >= LIMITS.least_flanks)


def _shaft_share(match: PatternMatch, painted: shapely.Geometry) -> float:
    """Share of an arrow's shaft that is painted; 1 of a symbol without heads."""
    sides = zip(match.flanks[::2], match.flanks[1::2])
    heads = [shapely.convex_hull(shapely.union(one, other)) for one, other in sides]
    shaft = shapely.difference(match.shape, shapely.buffer(shapely.union_all(heads), LIMITS.head_margin))
    if not heads or shaft.is_empty:
        return 1.0
    return float(shapely.intersection(shaft, painted).area / shaft.area)


def _beside_heads(match: PatternMatch, painted: shapely.Geometry) -> float:
    """The least share of the paint beside the places of second heads that is there; 1 where there are none."""
    return min((beside.intersection(painted).area / beside.area for _, beside in match.branches), default=1.0)


def _longest_bare(shape: shapely.Geometry, painted: shapely.Geometry) -> float:
    """The longest stretch along y on which nothing of a shape is painted, m."""
    _, low, _, high = shape.bounds
    parts = shapely.bounds(shapely.get_parts(shape.intersection(painted)))
    parts = parts[np.argsort(parts[:, 1])]
    reached = np.maximum.accumulate(np.concatenate([[low], parts[:, 3]]))
    return float((np.append(parts[:, 1], high) - reached).max())


def _kind(fits: Sequence[PatternMatch], painted: shapely.Geometry) -> tuple[str, float]:
    """Kind of the best match, `UNKNOWN_ARROW` where another kind fits about as well or may have another head; where
    only that keeps the kind open, also the chance that such a head is worn away or hidden, else 0."""
    best = fits[0]
    rivals = {match.kind for match in fits if match.score > best.score - LIMITS.least_lead} - {best.kind}
    if any(branch.intersection(painted).area > LIMITS.most_branch * branch.area for branch, _ in best.branches) or (
            rivals and best.kind.startswith("arrow")):
        return UNKNOWN_ARROW, 0.0
    there = _beside_heads(best, painted)
    if there >= LIMITS.least_beside:
        return best.kind, 0.0
    hidden = any(_longest_bare(beside, painted) > LIMITS.longest_bare for _, beside in best.branches)
    gone = 1.0 if hidden else (1.0 - there)**LIMITS.head_places
    return (UNKNOWN_ARROW, gone) if gone > LIMITS.head_gone else (best.kind, 0.0)


def _heading(fits: Sequence[PatternMatch], along: np.ndarray) -> np.ndarray:
    """Direction (2,) in which the best match is read, NaN where the opposite one fits about as well."""
    best = fits[0]
    against = any(match.backwards != best.backwards and match.score > best.score - LIMITS.least_lead for match in fits)
    return np.full(2, np.nan) if against or best.kind == "diamond" else -along if best.backwards else along
