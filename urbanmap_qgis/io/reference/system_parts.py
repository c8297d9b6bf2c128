"""Coordinate reference systems by their parts: the plane, the heights, the datum, and what makes two planes the same.

PROJ reads their text (WKT 1 and 2, ESRI's too); what two systems are is told by what they state, as today's databases
know JGD2024 under different names, or not at all. Source: OGC 18-010r7 (WKT 2), OGC 01-009 (WKT 1).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from functools import lru_cache

from pyproj import CRS
from pyproj.exceptions import CRSError

from ...errors import InputError
from ...wording import say
from .renamed_crs import known_wkt

# One datum under several names: since 2026 EPSG calls JGD2011 JGD2024 under the same codes (6666 to 6692, datum 1128),
# as the revision of 2025 changed heights only.
_SAME_DATUM = {"japanesegeodeticdatum2024": "jgd2011", "japanesegeodeticdatum2011": "jgd2011", "jgd2024": "jgd2011",
               "japanesegeodeticdatum2000": "jgd2000", "worldgeodeticsystem1984": "wgs1984",
               "worldgeodeticsystem1984ensemble": "wgs1984", "wgs84": "wgs1984"}


@lru_cache(maxsize=256)
def parsed_crs(wkt: str) -> CRS:
    """The system that a text (WKT, or a code) states.

    Raises
    ------
    InputError : it names none.
    """
    try:
        return CRS.from_user_input(known_wkt(wkt))
    except CRSError as error:
        raise InputError(say("The coordinate reference system cannot be understood: set another one.")) from error


def _parts(crs: CRS) -> Iterator[CRS]:
    """The systems of a compound one, or of one that is bound to another."""
    inner = crs.sub_crs_list if crs.is_compound else [crs.source_crs] if crs.is_bound else []
    yield from (part for one in inner for part in _parts(one))
    if not inner:
        yield crs


def plan_part(crs: CRS) -> CRS:
    """The projected or geographic system of one that may be compound or bound; any other as it is."""
    return next((part for part in _parts(crs) if not part.is_vertical), crs)


def horizontal_part(wkt: str) -> CRS | None:
    """The part of a system (WKT) that says where in plan something is; None where there is none.

    Raises
    ------
    InputError : it is no WKT.
    """
    part = plan_part(parsed_crs(wkt)) if wkt and wkt.strip() else None
    return None if part is None or part.is_vertical or part.is_engineering else part


def metric_plane(name: str, wkt: str | None) -> CRS:
    """The part of a system (WKT) that says where in plan something is, its lengths in metres.

    Parameters
    ----------
    name : of the data, for messages.

    Raises
    ------
    InputError : no system is stated, it is not understood, not projected, or not in metres.
    """
    plan = horizontal_part(wkt or "")
    if plan is None:
        raise InputError(say("{name} states no coordinate reference system: assign one to the file first.", name=name))
    if not plan.is_projected or any(abs(axis.unit_conversion_factor - 1.0) > 1e-9 for axis in plan.axis_info):
        raise InputError(say("{name} is in {crs}, which is no system of plane coordinates in metres: reproject it to "
                             "one first.", name=name, crs=plan.name))
    return plan


def vertical_part(wkt: str) -> CRS | None:
    """The vertical system of a compound one (or of one that is vertical only); None where it states none."""
    return next((part for part in _parts(parsed_crs(wkt)) if part.is_vertical), None) if wkt and wkt.strip() else None


def is_geographic(wkt: str) -> bool:
    """Whether a system (WKT) counts in degrees; none does not."""
    part = horizontal_part(wkt)
    return part is not None and part.is_geographic


def own_code(crs: CRS) -> int | None:
    """EPSG code that a system states of itself; None where it states none."""
    stated = crs.to_json_dict().get("id") or {}
    return int(stated["code"]) if stated.get("authority") == "EPSG" and str(stated["code"]).isdigit() else None


def same_horizontal(first: str, second: str) -> bool:
    """Whether two systems (WKT) give the same place the same two coordinates, the order of axes aside.

    Equal codes of EPSG are equal whatever the names; different ones are not. Without codes on both sides the datum (its
    old and new names are one), the ellipsoid, the projection's method and each of its parameters decide.
    """
    one, other = horizontal_part(first), horizontal_part(second)
    if one is None or other is None:
        return False
    codes = own_code(one), own_code(other)
    if all(codes) and (codes[0] == codes[1] or one.is_projected):
        return codes[0] == codes[1]
    if one.is_projected != other.is_projected or datum_key(one) != datum_key(other):
        return False
    (method, numbers), (method_2, numbers_2) = _projection(one), _projection(other)
    return method == method_2 and numbers.keys() == numbers_2.keys() and all(
        math.isclose(value, numbers_2[name], rel_tol=1e-9, abs_tol=1e-9) for name, value in numbers.items())


def datum_key(crs: CRS) -> str:
    """One word for the datum of a system, the same for its old and new names."""
    datum = crs.geodetic_crs.datum if crs.geodetic_crs is not None else None
    plain = re.sub(r"[^a-z0-9]", "", re.sub(r"^D_", "", datum.name if datum else "").lower())
    return _SAME_DATUM.get(plain, plain)


def _projection(crs: CRS) -> tuple[str, dict[str, float]]:
    """Method, and numbers of ellipsoid, unit and projection by their names; zeros, which some programs do not write,
    are left out."""
    numbers = {"a": crs.ellipsoid.semi_major_metre, "1/f": crs.ellipsoid.inverse_flattening}
    if not crs.is_projected:
        return "", numbers
    operation = crs.coordinate_operation
    numbers.update({one.name: one.value * one.unit_conversion_factor for one in operation.params if one.value})
    return operation.method_name, {**numbers, "unit": crs.axis_info[0].unit_conversion_factor}
