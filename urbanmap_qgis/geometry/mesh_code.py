"""Standard regional meshes of Japan.

Source: JIS X 0410: the first mesh is 40' by 1 degree, the second an eighth of it, the third a tenth of that (30" by
45", about 1 km); the half and the quarter mesh halve the third once and twice.
"""

from __future__ import annotations

import math

from ..errors import InputError
from ..wording import say

ROWS, COLUMNS = 120, 80
"""Third meshes a degree of latitude and of longitude."""
WEST = 100.0
"""Longitude at which columns begin, degrees."""
_LATITUDES, _LONGITUDES = (0.0, 66.66), (100.0, 180.0)


def third_mesh_code(longitude: float, latitude: float) -> str:
    """Code of eight digits of the third mesh (30" by 45", about 1 km) that holds a place (degrees).

    Raises
    ------
    InputError : the place is outside of the meshes' range, 0 to 66 degrees north and 100 to 180 east.
    """
    if not (_LATITUDES[0] <= latitude < _LATITUDES[1] and _LONGITUDES[0] <= longitude < _LONGITUDES[1]):
        raise InputError(say("The place {latitude:.5f}, {longitude:.5f} has no mesh code: it is not in Japan.",
                             latitude=latitude, longitude=longitude))
    return regional_mesh_code(math.floor(latitude * ROWS), math.floor((longitude - WEST) * COLUMNS))


def regional_mesh_code(row: int, column: int, parts: int = 1) -> str:
    """Code of a mesh by its place among all meshes of its size.

    Parameters
    ----------
    row, column : counted from the equator and from 100 degrees east.
    parts : into how many the side of a third mesh is divided: 1, 2 (nine digits) or 4 (ten digits).
    """
    digits = ""
    while parts > 1:
        digits = f"{1 + column % 2 + 2 * (row % 2)}{digits}"  # 1 south-west, 2 south-east, 3 north-west, 4 north-east
        row, column, parts = row // 2, column // 2, parts // 2
    first, second = divmod(row, 80), divmod(column, 80)
    return (f"{first[0]:02d}{second[0]:02d}{first[1] // 10}{second[1] // 10}{first[1] % 10}{second[1] % 10}{digits}")


def mesh_bounds(code: str) -> tuple[float, float, float, float] | None:
    """Western, southern, eastern and northern border (degrees) of the mesh of a code of 4, 6, 8, 9 or 10 digits; None
    for what is no code of a mesh."""
    if len(code) not in (4, 6, 8, 9, 10) or not code.isdigit():
        return None
    south, west = int(code[:2]) / 1.5, float(WEST + int(code[2:4]))
    height, width = 2.0 / 3.0, 1.0
    for begin, parts in ((4, 8), (6, 10)):
        if len(code) > begin:
            row, column = int(code[begin]), int(code[begin + 1])
            if max(row, column) >= parts:
                return None
            height, width = height / parts, width / parts
            south, west = south + row * height, west + column * width
    for digit in code[8:]:
        if digit not in "1234":
            return None
        height, width = height / 2.0, width / 2.0
        south, west = south + (int(digit) - 1) // 2 * height, west + (int(digit) - 1) % 2 * width
    return west, south, west + width, south + height
