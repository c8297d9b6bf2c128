"""Digital elevation models of the Geospatial Information Authority of Japan (GSI): one mesh a file, as JPGIS GML.

Source: GSI, product specification of the Fundamental Geospatial Data, digital elevation model (DEM1A, 5A, 5B, 5C, 10A,
10B). A file holds the cells of one mesh from the north-west, row by row, as pairs of kind and height; it may begin
after the first cell (startPoint) and end before the last.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from xml.etree.ElementTree import Element  # nosec B405 # elements alone, no parser

import numpy as np

from ...errors import InputError
from ...progress import SILENT, Progress
from ...wording import say
from ..files.guard import reads
from .gsi_gml import FGD, GML
from .gsi_sources import PathLike, Wanted, XmlSource, list_sources, some_of
from .xml_stream import root_children

PRODUCTS = {"1A": 1.0, "5A": 5.0, "5B": 5.0, "5C": 5.0, "10A": 10.0, "10B": 10.0}
"""Products from the finest and best on, with the side of a cell, m (nominal: 0.04, 0.2 and 0.4 seconds)."""

_NAME = re.compile(r"FG-GML-([\d-]+?)-DEM(1A|5A|5B|5C|10A|10B)(?:-(\d{8}))?", re.IGNORECASE)
_ANY_NAME = re.compile(r"FG-GML-", re.IGNORECASE)
_SECONDS = {1.0: 0.04, 5.0: 0.2, 10.0: 0.4}
_SYSTEMS = {"fguuid:jgd2000.bl": "JGD2000", "fguuid:jgd2011.bl": "JGD2011", "fguuid:jgd2024.bl": "JGD2024"}

LARGEST_MESH = 2**28
MOST_CELLS = 2**24
# GSI writes -9999. where there is no height, under whichever kind; no place in Japan lies below -200 m.
LOWEST = -1000.0
HIGHEST = 9000.0

_EMPTY_KINDS = {"データなし", "データ無し", "nodata"}

DEMS = Wanted("elevation models (FG-GML-...-DEM1A, 5A, 5B, 5C, 10A, 10B)",
              "download the item 'digital elevation model' from the GSI",
              lambda name: bool(_ANY_NAME.match(name)) and not _NAME.match(name))


@dataclass(frozen=True, eq=False)
class DemMesh:
    """One mesh as read.

    Attributes
    ----------
    code : of the mesh.
    product : a key of `PRODUCTS`.
    date : as text that sorts, "" where not known.
    system : "JGD2000", "JGD2011" or "JGD2024".
    source : name of the file.
    west, north : outer corner of the first cell, degrees.
    cell : side of a cell, degrees.
    heights : (rows, columns) float32, m, from the north-west; NaN where there is none.
    kinds : number of cells of each kind with a height.
    """

    code: str
    product: str
    date: str
    system: str
    source: str
    west: float
    north: float
    cell: float
    heights: np.ndarray
    kinds: Counter = field(default_factory=Counter)


@dataclass(frozen=True)
class DemMeshes:
    """Meshes, the newest file of each, with notes on what was not taken as it stands in the files."""

    meshes: tuple[DemMesh, ...]
    notes: tuple[str, ...] = ()

    @property
    def system(self) -> str:
        """The reference of places and heights: "JGD2000", "JGD2011" or "JGD2024"."""
        return self.meshes[0].system


@reads("a GSI elevation model")
def read_gsi_dem(path: PathLike | Sequence[PathLike], progress: Progress = SILENT) -> DemMeshes:
    """Read elevation models of the GSI: .xml, .zip (also zips in it) or folders of them.

    Of several files of one mesh and product the newest is taken, by the date in its name, else by the one in it.

    Raises
    ------
    InputError : a file is damaged, of another kind, or files of different reference systems are mixed.
    """
    with ExitStack() as stack:
        listing = list_sources(path, stack, DEMS)
        sources, older = _newest(listing.sources)
        meshes, strange = [], []
        for number, source in enumerate(sources):
            part = progress.part(number / len(sources), (number + 1) / len(sources))
            mesh = _read_mesh(source, part)
            (meshes if mesh is not None else strange).append(mesh if mesh is not None else source.name)
    if not meshes:
        raise InputError(say("{strange} is no elevation model of the GSI: give {what} as they were downloaded.",
                             strange=strange[0], what=DEMS.what))
    meshes, more = _newest_of_each(meshes)
    notes = _notes(listing.others, strange, older + more, meshes)
    systems = sorted({mesh.system for mesh in meshes})
    if len(systems) > 1:
        raise InputError(say("Some meshes are in {systems} and others in {systems_2}, whose heights differ by up to "
                             "decimetres: load them in separate runs and convert one with “Convert heights”.",
                             systems=systems[0], systems_2=systems[1]))
    for note in notes:
        progress.warn(note)
    return DemMeshes(tuple(meshes), tuple(notes))


def _newest(sources: list[XmlSource]) -> tuple[list[XmlSource], list[str]]:
    """Of files that say mesh, product and date in their names, the newest of each; the names of the others.

    So that old editions are not even opened.
    """
    best: dict[tuple, XmlSource] = {}
    older = []
    for source in sources:
        named = _NAME.match(source.short_name)
        if named is None or not named.group(3):
            best[source.name, ""] = source
            continue
        key = (named.group(1), named.group(2).upper())
        known = best.get(key)
        if known is not None:
            newer = max(known, source, key=lambda item: (_NAME.match(item.short_name).group(3), item.name))
            older.append((known if newer is source else source).name)
            source = newer
        best[key] = source
    return list(best.values()), older


def _newest_of_each(meshes: list[DemMesh]) -> tuple[list[DemMesh], list[str]]:
    """The newest of each mesh and product by what the files themselves say."""
    best: dict[tuple[str, str], DemMesh] = {}
    older = []
    for mesh in meshes:
        known = best.get((mesh.code, mesh.product))
        if known is not None:
            newer = max(known, mesh, key=lambda item: item.date)
            older.append((known if newer is mesh else mesh).source)
            mesh = newer
        best[mesh.code, mesh.product] = mesh
    return list(best.values()), older


def _read_mesh(source: XmlSource, progress: Progress) -> DemMesh | None:
    """The mesh of a file; None where it is another kind of file."""
    found = None
    for root, element in root_children(source, "GSI data", LARGEST_MESH, progress):
        if root.tag != FGD + "Dataset":
            return None
        if element.tag == FGD + "DEM":
            found = _mesh(element, source)
    return found


def _mesh(element: Element, source: XmlSource) -> DemMesh:
    coverage = element.find(FGD + "coverage")
    if coverage is None:
        raise InputError(say("{source} is damaged: its elevation model has no coverage; download it again.",
                             source=source.name))
    system = _system(coverage, source)
    south, west = _pair(coverage, "lowerCorner", source)
    north, east = _pair(coverage, "upperCorner", source)
    columns, rows = (int(high - low) + 1 for low, high in zip(
        _pair(coverage, "low", source), _pair(coverage, "high", source)))
    if not (0 < rows * columns <= MOST_CELLS and rows > 0 and north > south and east > west):
        raise InputError(say("{source} is damaged: its grid of {columns} x {rows} cells cannot be; download it again.",
                             source=source.name, columns=columns, rows=rows))
    cell = (east - west) / columns
    if abs((north - south) / rows - cell) > 1e-3 * cell:
        raise InputError(say("{source} is damaged: its cells are not as high as wide; download it again.",
                             source=source.name))
    heights, kinds = _heights(coverage, rows, columns, source)
    named = _NAME.match(source.short_name)
    date = named.group(3) if named and named.group(3) else _date(element)
    product = named.group(2).upper() if named else _product(element, cell, source)
    return DemMesh((element.findtext(FGD + "mesh") or "").strip() or source.short_name, product, date, system,
                   source.name, west, north, cell, heights, kinds)


def _system(coverage: Element, source: XmlSource) -> str:
    envelope = coverage.find(f".//{GML}Envelope")
    name = (envelope.get("srsName") or "" if envelope is not None else "").lower()
    if name not in _SYSTEMS:
        raise InputError(say("{source}: the reference system {value} is not known: give data in JGD2000, JGD2011 or "
                             "JGD2024.", source=source.name, value=name or "that it does not name"))
    return _SYSTEMS[name]


def _pair(coverage: Element, name: str, source: XmlSource) -> tuple[float, float]:
    """Two numbers of an element anywhere in the coverage."""
    text = coverage.findtext(f".//{GML}{name}")
    try:
        first, second = (float(value) for value in (text or "").split())
    except ValueError as error:
        raise InputError(say("{source} is damaged: {name} does not hold two numbers; download it again.",
                             source=source.name, name=name)) from error
    if not (np.isfinite(first) and np.isfinite(second)):
        raise InputError(say("{source} is damaged: {name} does not hold two numbers; download it again.",
                             source=source.name, name=name))
    return first, second


def _heights(coverage: Element, rows: int, columns: int, source: XmlSource) -> tuple[np.ndarray, Counter]:
    """Heights in rows from the north, whichever way the file runs, and the kinds of the cells that have one."""
    start = coverage.find(f".//{GML}startPoint")
    column, row = _pair(coverage, "startPoint", source) if start is not None else (0.0, 0.0)
    rule = coverage.find(f".//{GML}sequenceRule")
    order = (rule.get("order") or "+x-y" if rule is not None else "+x-y").replace(" ", "")
    if sorted(order.replace("+", "").replace("-", "")) != ["x", "y"] or len(order) != 4 or (
            rule is not None and (rule.text or "Linear").strip() != "Linear"):
        raise InputError(say("{source}: its cells are in an order ({order}) that is not known; download it again.",
                             source=source.name, order=order))
    values, kinds = _tuples(coverage.findtext(f".//{GML}tupleList") or "", source)
    first, second = (columns, rows) if order[1] == "x" else (rows, columns)
    inner, outer = (column, row) if order[1] == "x" else (row, column)
    begin = int(outer) * first + int(inner)
    if min(column, row) < 0 or inner >= first or begin + len(values) > rows * columns:
        raise InputError(say("{source} is damaged: it has more heights than its {columns} x {rows} cells from its "
                             "start point on; download it again.", source=source.name, columns=columns, rows=rows))
    flat = np.full(rows * columns, np.nan, np.float32)
    flat[begin:begin + len(values)] = values
    grid = flat.reshape(second, first)
    grid = grid if order[1] == "x" else grid.T
    # As written, +x runs east and -y south: the other signs run against them.
    if "-x" in order:
        grid = grid[:, ::-1]
    if "+y" in order:
        grid = grid[::-1]
    return np.ascontiguousarray(grid), kinds


def _tuples(text: str, source: XmlSource) -> tuple[np.ndarray, Counter]:
    """Heights of the pairs "kind,height", NaN where there is none, and how many of each kind have one."""
    lines = [line for line in map(str.strip, text.split("\n")) if line]
    kinds, heights = [], []
    for line in lines:
        kind, comma, height = line.rpartition(",")
        if not comma:
            raise InputError(say("{source} is damaged: {line!r} is no kind with a height; download it again.",
                                 source=source.name, line=line[:40]))
        kinds.append(kind.strip())
        heights.append(height.strip() or "nan")
    try:
        values = np.array(heights, dtype=np.float64)
    except ValueError as error:
        raise InputError(say("{source} is damaged: a height is no number; download it again.",
                             source=source.name)) from error
    empty = ~((values > LOWEST) & (values < HIGHEST))
    empty |= np.array([kind in _EMPTY_KINDS for kind in kinds], bool)
    values[empty] = np.nan
    return values.astype(np.float32), Counter(kind for kind, gone in zip(kinds, empty.tolist()) if not gone)


def _date(element: Element) -> str:
    """Newest of the dates that an object carries, digits only."""
    dates = [re.sub(r"\D", "", found.text or "") for found in element.iter(GML + "timePosition")]
    return max(dates, default="")


def _product(element: Element, cell: float, source: XmlSource) -> str:
    """The product by the side of the cell, where the file has another name: the best of that size."""
    for product, metres in PRODUCTS.items():
        if abs(cell * 3600 / _SECONDS[metres] - 1) < 0.02:
            return product
    raise InputError(say("{source}: cells of {cell:.3f} seconds are of no elevation model of the GSI; give {what} as "
                         "they were downloaded.", source=source.name, cell=cell * 3600, what=DEMS.what))


def _notes(others: list[str], strange: list[str], older: list[str], meshes: list[DemMesh]) -> list[str]:
    notes = []
    if others:
        notes.append(say("{others_count} files with other data than elevation models were not opened ({some}).",
                         others_count=len(others), some=some_of(others)))
    if strange:
        notes.append(say("{strange_count} XML files that are no elevation models were passed over ({some}).",
                         strange_count=len(strange), some=some_of(strange)))
    if older:
        notes.append(say("{older_count} older files of meshes that have a newer one were left out ({some}).",
                         older_count=len(older), some=some_of(older)))
    kinds = sum((mesh.kinds for mesh in meshes), Counter())
    surface = kinds.get("表層面", 0)
    if surface:
        notes.append(say("{surface} cells of {values} are heights of the surface (表層面), with trees and buildings, "
                         "not of the ground.", surface=surface, values=sum(kinds.values())))
    return notes
