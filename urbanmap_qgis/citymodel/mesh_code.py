"""Standard regional meshes of Japan.

Source: JIS X 0410: the first mesh is 40' by 1 degree, the second an eighth of it, the third a tenth of that.
"""

from __future__ import annotations

import math

from ..errors import InputError


def third_mesh_code(longitude: float, latitude: float) -> str:
    """Code of eight digits of the third mesh (30" by 45", about 1 km) that holds a place (degrees).

    Raises
    ------
    InputError : the place is outside of the meshes' range, 0 to 66 degrees north and 100 to 180 east.
    """
    if not (0.0 <= latitude < 66.66 and 100.0 <= longitude < 180.0):
        raise InputError(f"The place {latitude:.5f}, {longitude:.5f} has no mesh code: it is not in Japan.")
    rows, columns = latitude * 120.0, (longitude - 100.0) * 80.0
    row, column = math.floor(rows), math.floor(columns)
    first, second = divmod(row, 80), divmod(column, 80)
    return (f"{first[0]:02d}{second[0]:02d}{first[1] // 10}{second[1] // 10}{first[1] % 10}{second[1] % 10}")
