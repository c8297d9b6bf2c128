"""The part of a reference system that says where in plan something is, for PROJ."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pyproj import CRS


def plan_part(crs: CRS) -> CRS:
    """The horizontal system of a compound one; any other as it is.

    (pyproj's own `to_2d` is of 3.6 only, and QGIS's Python may bring an older one.)
    """
    return crs.sub_crs_list[0] if crs.is_compound else crs
