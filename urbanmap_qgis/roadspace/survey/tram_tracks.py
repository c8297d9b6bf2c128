"""Low edges amid a carriageway that are those of a tram's tracks: vehicles drive over them, and they are no islands.

Source: Project PLATEAU, standard working procedure of 3D city models, annex D: a tram's track is a part of the
carriageway (code 1050 of level 3.4, which divides it off; coarser levels do not).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...wording import say
from ..road_records import RoadFinding
from .area_records import EdgeLine

LOW = (0.005, 0.10)  # m, step of an edge that vehicles drive over; most of its places
RAILS = (0.9, 1.6)  # m between the rails of a track: gauges of 1.067 to 1.435, and their heads
BED = (2.0, 3.9)  # m, the bed of one track
BEDS = (3.9, 7.5)  # m, of two, where both edges are known to rise towards each other
LENGTH = 20.0  # m from end to end, shortest; islands so low are shorter
BESIDE = 0.3  # m along, within which places lie across from each other
PAIRED = 0.7  # share of an edge's places with another low edge across from them
EVEN = 0.25  # m, spread of their distance
RISE = 0.003  # m by which top and foot differ in plan where the side to which an edge rises is known
AMID = 1.0  # m to the border of the carriageway, from which an edge lies in it


@dataclass(frozen=True, eq=False)
class _Places:
    """Places (n, 2) of low edges, m, unit vectors along them and to their higher side (0 where not known), and the
    number of their edges' chain."""

    place: np.ndarray
    along: np.ndarray
    rise: np.ndarray
    chain: np.ndarray


def without_tracks(edges: Sequence[EdgeLine], findings: list[RoadFinding],
                   surface_between: Callable[[Sequence[EdgeLine]], Sequence[shapely.Polygon]]) -> list[EdgeLine]:
    """Edges without those of tracks, which are told.

    Parameters
    ----------
    surface_between : makes the carriageways, m, between edges.
    """
    paired = _paired_chains(_low_places(edges))
    if not paired:
        return list(edges)
    carriageway = shapely.union_all(list(surface_between([edge for edge in edges if edge.chain not in paired])))
    inside = shapely.buffer(carriageway, -AMID)
    tracks = set()
    for chain in sorted(paired):
        lines = shapely.union_all([shapely.linestrings(edge.plan) for edge in edges if edge.chain == chain])
        if shapely.length(shapely.intersection(lines, inside)) > PAIRED * lines.length:
            tracks.add(chain)
            findings.append(RoadFinding("tram track", say(
                "A low edge, at most {height:.2f} m high, runs with another like a tram's track amid the carriageway: "
                "it bounds no island. Draw it as one by hand where it does.", height=LOW[1]),
                *shapely.get_coordinates(shapely.line_interpolate_point(lines, 0.5, normalized=True)
                                         if lines.geom_type == "LineString" else
                                         shapely.point_on_surface(lines))[0].tolist()))
    return [edge for edge in edges if edge.chain not in tracks]


def _low_places(edges: Sequence[EdgeLine]) -> _Places:
    """Places of the chains of edges that are low all along and long enough."""
    chains: dict[int, list[EdgeLine]] = defaultdict(list)
    for edge in edges:
        chains[edge.chain].append(edge)
    parts = []
    for number, lines in chains.items():
        step = np.concatenate([line.top[:, 2] - line.foot[:, 2] for line in lines])
        low, high = np.nanpercentile(step, [10, 90]) if np.isfinite(step).any() else (np.nan, np.nan)
        length = float(np.hypot(*np.ptp(np.concatenate([line.plan for line in lines]), axis=0)))
        if not (low > LOW[0] and high <= LOW[1] and length >= LENGTH):
            continue
        for line in lines:
            along, across = np.gradient(line.plan, axis=0), (line.top - line.foot)[:, :2]
            known = np.hypot(*across.T)[:, None] > RISE
            parts.append((line.plan, _unit(along), np.where(known, _unit(across), 0.0),
                          np.full(len(line.plan), number)))
    if not parts:
        return _Places(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0, int))
    return _Places(*(np.concatenate(column) for column in zip(*parts)))


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.hypot(*vectors.T), 1e-12)[:, None]


def _paired_chains(low: _Places) -> set[int]:
    """Chains most places of which have a low edge across from them at the distance of rails, or of a track's bed."""
    if len(low.place) < 2:
        return set()
    one, other = cKDTree(low.place).query_pairs(BEDS[1], output_type="ndarray").T
    one, other = np.concatenate([one, other]), np.concatenate([other, one])
    offset = low.place[other] - low.place[one]
    ahead = np.einsum("ij,ij->i", offset, low.along[one])
    away = np.abs(offset[:, 0] * low.along[one, 1] - offset[:, 1] * low.along[one, 0])
    towards = np.einsum("ij,ij->i", offset, low.rise[one]), -np.einsum("ij,ij->i", offset, low.rise[other])
    facing, opposed = (towards[0] > 0) & (towards[1] > 0), (towards[0] < 0) & (towards[1] < 0)
    like_track = (_within(away, RAILS) | (_within(away, BED) & ~opposed)
                  | (_within(away, BEDS) & facing)) & (np.abs(ahead) < BESIDE)
    nearest = np.full(len(low.place), np.inf)
    np.minimum.at(nearest, one[like_track], away[like_track])
    found = set()
    for chain in np.unique(low.chain).tolist():
        distance = nearest[low.chain == chain]
        met = distance[np.isfinite(distance)]
        if len(met) >= PAIRED * len(distance) and np.std(met) < EVEN:
            found.add(chain)
    return found


def _within(value: np.ndarray, limits: tuple[float, float]) -> np.ndarray:
    return (value >= limits[0]) & (value < limits[1])
