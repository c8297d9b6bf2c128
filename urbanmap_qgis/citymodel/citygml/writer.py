"""A city model as CityGML 2.0: in Japan a folder as PLATEAU lays it out, elsewhere one file.

Source: OGC 12-019 (CityGML 2.0); the standard product specification of 3D city models (Project PLATEAU): a folder
for each module (udx/bldg, udx/tran, udx/frn, udx/veg), a file a third mesh, latitude, longitude and height, textures in
a folder beside.
"""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

import numpy as np

from ...errors import OutputError
from ...geometry.mesh_code import third_mesh_code
from ...io.files.atomic import final_text, written_beside
from ...progress import SILENT, Progress
from ...wording import say
from ..images import copy_images
from ..model import BUILDING_ROOM, INNER_INSTALLATION, INSTALLATION, CityModel, CityObject, CityReference
from ..objects import rings_of, unique_objects
from ..reference import GEOGRAPHIC, GEOGRAPHIC_2011, GEOGRAPHIC_2024, JGD2024, PLANE_ZONES, compound_epsg
from .attribute_writer import generic_attribute, split_attributes, xml_text
from .codelists import UsedCodes, lists_of, write_codelists
from .iur import VERSIONS, IurTable, iur_table
from .schema import (
    EXTENSIONS_FIRST,
    FITTING_ELEMENTS,
    FITTING_PROPERTIES,
    GML,
    PART_PROPERTY,
    ROAD_AREA_PROPERTIES,
    THEMES,
    XAL,
    XLINK,
    namespace_of,
)
from .shape_writer import object_geometry
from .whole_block import with_whole_block

WRITTEN_BY = "<!-- Written by UrbanMap -->"
THEME = "rgbTexture"
_NAMESPACES = {
    **{prefix: namespace_of(prefix) for prefix in ("core", "bldg", "gen", "app")}, "gml": GML, "xlink": XLINK,
    "xAL": XAL,
    "xsi": "http://www.w3.org/2001/XMLSchema-instance"}
_SCHEMAS = " ".join(f"{uri} http://schemas.opengis.net/{place}" for uri, place in (
    (_NAMESPACES["core"], "citygml/2.0/cityGMLBase.xsd"),
    (_NAMESPACES["bldg"], "citygml/building/2.0/building.xsd"),
    (_NAMESPACES["gen"], "citygml/generics/2.0/generics.xsd"),
    (_NAMESPACES["app"], "citygml/appearance/2.0/appearance.xsd"), (_NAMESPACES["gml"], "gml/3.1.1/base/gml.xsd")))
"""Where schemas are, as files of the specification's data say it (7.2.4.1: those of i-UR go along)."""
_MORE_SCHEMAS = {"tran": "transportation/2.0/transportation.xsd", "frn": "cityfurniture/2.0/cityFurniture.xsd",
                 "veg": "vegetation/2.0/vegetation.xsd"}
"""Schemas of modules that only their own files name."""

_ELEMENTS = {kind: name for name, kind in FITTING_ELEMENTS.items()}

_PLAIN_NAMES = {"bldg": "buildings", "tran": "roads", "frn": "furniture", "veg": "trees"}
"""Names of files outside of Japan by module."""

_NAME = re.compile(r"[^\W\d][\w.\-]*\Z")
_OTHER = re.compile(r"[^\w.\-]")


@dataclass(frozen=True)
class _Frame:
    """How coordinates are written: function from corners (n, 3) to places (n, 3) in the order of the axes, code of
    the reference system, whether the places are latitudes and longitudes, digits (None for all)."""

    places: Callable[[np.ndarray], np.ndarray]
    epsg: int | None
    geographic: bool
    digits: tuple[int, int] | None


@dataclass
class _GmlFile:
    """One file of a module that grows object by object: its members and textures wait in scratch files."""

    name: str
    folder: Path
    module: str = "bldg"
    count: int = 0
    low: np.ndarray = field(default_factory=lambda: np.full(3, np.inf))
    high: np.ndarray = field(default_factory=lambda: np.full(3, -np.inf))
    images: dict[str, str] = field(default_factory=dict)

    def add(self, member: str, textures: str, low: np.ndarray, high: np.ndarray) -> None:
        self.count += 1
        self.low, self.high = np.minimum(self.low, low), np.maximum(self.high, high)
        for text, ending in ((member, "members"), (textures, "textures")):
            if text:
                with open(self.folder / f"{self.name}.{ending}", "a", encoding="utf-8", newline="\n") as file:
                    file.write(text)


def write_citygml(folder: str | os.PathLike, model: CityModel, progress: Progress = SILENT,
                  version: str = VERSIONS[0], lists: Mapping[str, Mapping[str, str]] | None = None,
                  ) -> dict[str, int]:
    """Write a city model into a folder as CityGML 2.0, building by building; return the files with their buildings.

    Coordinates in a JGD2011 or JGD2024 system are written as PLATEAU has them: latitude, longitude and height
    (EPSG:6697, or 11318 where heights are JGD2024), a file a third mesh. Others keep their system, in one file.

    Attributes of i-UR are written as the version has them; those that it has no place for become generic ones, which
    is warned of.

    Parameters
    ----------
    version : of i-UR, one of `VERSIONS`.
    lists : lists of codes that go along in Japan besides those of the version: codes and their meaning by list.

    Raises
    ------
    InputError : two objects have the same id, or a place in Japan's systems lies outside of its meshes.
    OutputError : a file cannot be written, or a texture's image cannot be copied.
    """
    target, frame = Path(folder), _frame(model.reference)
    plateau = frame.epsg in (GEOGRAPHIC_2011, GEOGRAPHIC_2024)
    files: dict[str, _GmlFile] = {}
    names = _Names(iur_table(version))
    left_out, used = 0, UsedCodes()
    with tempfile.TemporaryDirectory(prefix="urbanmap-") as scratch:
        for building in unique_objects(model.buildings):
            progress.check()
            if plateau:
                building, lost = with_whole_block(building)
                left_out += lost
            bounds = _bounds(building)
            module = THEMES[building.type]
            name = _PLAIN_NAMES[module] if not plateau else "" if bounds is None else _mesh_file(bounds, frame, module)
            if not name:
                continue
            file = files.setdefault(name, _GmlFile(name, Path(scratch), module))
            used.add(building, _add_building(file, building, frame, names, bounds))
        if not files:
            _made_folder(target, "bldg", plateau)
        for file in files.values():
            place = _made_folder(target, file.module, plateau)
            _write_file(place / f"{file.name}.gml", file, frame, model, names.table.namespace)
            copy_images(place, file.images, model.images)
    if plateau:
        _write_lists(target, used, {**lists_of(version), **(lists or {})}, progress)
    _tell_of_earlier_runs(Path(final_text(str(target))), files, progress)
    if left_out:
        progress.warn(say("{count} buildings have parts that lie apart and no LOD1: it is one solid for the whole "
                          "building, and parts have none.", count=left_out))
    if names.homeless:
        progress.warn(say("{count} attributes have no place in i-UR {version} and are written as generic ones "
                          "({names}).", count=sum(names.homeless.values()), version=version,
                          names=", ".join(sorted(names.homeless)[:3])))
    return {f"{name}.gml": file.count for name, file in files.items()}


def _made_folder(target: Path, module: str, plateau: bool) -> Path:
    """The folder of a module's files, which is there then."""
    place = target / "udx" / module if plateau else target
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(say("The folder {target} cannot be made ({strerror}): choose another output.", target=target,
                              strerror=error.strerror)) from error
    return place


def _tell_of_earlier_runs(folder: Path, files: Mapping[str, _GmlFile], progress: Progress) -> None:
    """Warn of files in a folder that hold things of the modules written now, but were not written now."""
    modules = {file.module for file in files.values()}
    plain = {_PLAIN_NAMES[module] for module in modules}
    older = sorted(path.name for path in folder.rglob("*.gml")
                   if path.stem not in files and (path.parent.name in modules or path.stem in plain))
    if older:
        progress.warn(say("The folder {folder} holds CityGML of an earlier run, which stays ({count} files: {names}): "
                          "delete it, if it does not belong to this delivery.", folder=folder, count=len(older),
                          names=", ".join(older[:3])))


def gml_folder_trouble(folder: str | os.PathLike) -> str:
    """Why CityGML cannot be put into a folder: it holds CityGML of another program. Empty if it can."""
    for path in sorted(Path(folder).rglob("*.gml")) if Path(folder).is_dir() else ():
        with open(path, "rb") as file:
            if WRITTEN_BY.encode() not in file.read(4096):
                return say("The folder {folder} holds CityGML of another program ({path}): choose another folder.",
                           folder=folder, path=path.name)
    return ""


def _frame(reference: CityReference) -> _Frame:
    """How coordinates of a reference are written."""
    code = GEOGRAPHIC_2024 if reference.heights == JGD2024 else GEOGRAPHIC_2011
    if reference.geographic:
        known = reference.epsg in (None, GEOGRAPHIC, GEOGRAPHIC_2011, GEOGRAPHIC_2024)
        return _Frame(lambda corners: corners[:, [1, 0, 2]], code if known else reference.epsg, True, None)
    if reference.epsg in PLANE_ZONES:
        from pyproj import Transformer

        transformer = Transformer.from_crs(reference.epsg, GEOGRAPHIC, always_xy=True)

        def to_degrees(corners: np.ndarray) -> np.ndarray:
            longitude, latitude = transformer.transform(corners[:, 0], corners[:, 1])
            return np.column_stack([latitude, longitude, corners[:, 2]])

        return _Frame(to_degrees, code, True, (10, 4))
    return _Frame(lambda corners: corners, compound_epsg(reference), False, (4, 4))


def _bounds(building: CityObject) -> np.ndarray | None:
    """Lowest and highest corner (2, 3) of a building; None without geometry."""
    rings = rings_of(building)
    if not rings:
        return None
    corners = np.vstack(rings)
    return np.array([corners.min(axis=0), corners.max(axis=0)])


def _mesh_file(bounds: np.ndarray, frame: _Frame, module: str) -> str:
    """Name of the file of the mesh in which an object's middle lies."""
    latitude, longitude, _ = frame.places(bounds.mean(axis=0)[None])[0]
    return f"{third_mesh_code(float(longitude), float(latitude))}_{module}_{frame.epsg}_op"


class _Names:
    """Ids of features as XML takes them, each once; attributes of i-UR that its version has no place for, by name."""

    def __init__(self, table: IurTable) -> None:
        self.table = table
        self.taken: set[str] = set()
        self.homeless: Counter = Counter()

    def of(self, identifier: str, module: str) -> str:
        name = identifier if _NAME.match(identifier) else f"{module}_" + _OTHER.sub("_", identifier)
        plain, number = name, 1
        while name in self.taken:
            number += 1
            name = f"{plain}-{number}"
        self.taken.add(name)
        return name


def _add_building(file: _GmlFile, building: CityObject, frame: _Frame, names: _Names,
                  bounds: np.ndarray | None) -> str:
    """Append a building with its parts and textures; give it as XML."""
    def places(corners: np.ndarray) -> list[str]:
        found = frame.places(corners)
        if frame.digits is None:
            return [" ".join(map(repr, row)) for row in found.tolist()]
        plan, height = frame.digits
        return [f"{a:.{plan}f} {b:.{plan}f} {h:.{height}f}" for a, b, h in found.tolist()]

    textures: dict[str, list] = {}
    body = _object(building, names, places, textures)
    rows = []
    for image, targets in textures.items():
        name = file.images.setdefault(image, _image_name(file, image))
        rows.append(_texture(name, targets))
    if bounds is None:
        file.add(f"<core:cityObjectMember>{body}</core:cityObjectMember>\n", "", file.low, file.high)
        return body
    corners = np.array([[x, y, z] for x in bounds[:, 0] for y in bounds[:, 1] for z in bounds[:, 2]])
    found = frame.places(corners)
    file.add(f"<core:cityObjectMember>{body}</core:cityObjectMember>\n", "".join(rows), found.min(axis=0),
             found.max(axis=0))
    return body


def _write_lists(target: Path, used: UsedCodes, lists: Mapping[str, Mapping[str, str]], progress: Progress) -> None:
    """Write lists and those of the model whose meanings are known; warn of the others that it refers to."""
    written = used.with_lists(lists)
    write_codelists(target / "codelists", written)
    missing = sorted(used.named.difference(written))
    if missing:
        progress.warn(say("{count} lists of codes that the models refer to were not beside them ({names}): copy them "
                          "into the folder codelists, where PLATEAU wants all lists that are referred to.",
                          count=len(missing), names=", ".join(missing[:3])))


def _object(item: CityObject, names: _Names, places, textures: dict[str, list]) -> str:
    """An object as XML; what its textures cover is added to `textures`."""
    module = THEMES[item.type]
    identifier = names.of(item.id, module)
    areas = "".join(f"<tran:{name}>{_object(area, names, places, textures)}</tran:{name}>"
                    for kind, name in ROAD_AREA_PROPERTIES.items() for area in item.fittings if area.type == kind)
    early, late = ("", "") if areas else _fittings(item, names, places, textures)
    geometry = object_geometry(item, identifier, places, early)
    for image, targets in geometry.textured.items():
        textures.setdefault(image, []).extend(targets)
    before, inside, after = split_attributes(item.attributes, names.table, names.homeless, item.type)
    if item.type in EXTENSIONS_FIRST:
        inside, after = after + inside, ""
    if identifier != item.id:
        before += generic_attribute("source_id", item.id)
    if item.problems:
        before += generic_attribute("problems", "; ".join(item.problems))
    parts = "".join(f"<bldg:{PART_PROPERTY}>{_object(part, names, places, textures)}</bldg:{PART_PROPERTY}>"
                    for part in item.parts)
    tag = f"{module}:{_ELEMENTS.get(item.type, item.type)}"
    return f'<{tag} gml:id="{identifier}">{before}{inside}{areas}{geometry.xml}{late}{parts}{after}</{tag}>'


def _fittings(item: CityObject, names: _Names, places, textures: dict[str, list]) -> tuple[str, str]:
    """What belongs to an object: a building's installations, which stand amid its geometry, and what stands behind."""
    room = item.type == BUILDING_ROOM
    texts = dict.fromkeys(FITTING_PROPERTIES.values(), "")
    for fitting in sorted(item.fittings, key=lambda fitting: list(FITTING_ELEMENTS.values()).index(fitting.type)):
        name = FITTING_PROPERTIES[room, fitting.type]
        texts[name] += f"<bldg:{name}>{_object(fitting, names, places, textures)}</bldg:{name}>"
    early = "".join(texts.pop(FITTING_PROPERTIES[False, kind]) for kind in (INSTALLATION, INNER_INSTALLATION))
    return early, "".join(texts.values())


def _image_name(file: _GmlFile, image: str) -> str:
    """Name of an image beside the file, each its own."""
    path = PurePosixPath(image.replace("\\", "/"))
    name, number = path.name, 1
    while any(taken.endswith(f"/{name}") for taken in file.images.values()):
        number += 1
        name = f"{path.stem}-{number}{path.suffix}"
    return f"{file.name.removesuffix('_op')}_appearance/{name}"


def _texture(name: str, targets: list) -> str:
    """An image with the polygons that it covers."""
    kind = {".png": "png", ".tif": "tiff", ".tiff": "tiff"}.get(PurePosixPath(name).suffix.lower(), "jpg")
    rows = []
    for polygon, rings in targets:
        lists = "".join(
            f'<app:textureCoordinates ring="#{ring}">'
            + " ".join(f"{u:.6f} {v:.6f}" for u, v in [*uv.tolist(), uv[0].tolist()]) + "</app:textureCoordinates>"
            for ring, uv in rings)
        rows.append(f'<app:target uri="#{polygon}"><app:TexCoordList>{lists}</app:TexCoordList></app:target>')
    return (f"<app:surfaceDataMember><app:ParameterizedTexture><app:imageURI>{xml_text(name)}</app:imageURI>"
            f"<app:mimeType>image/{kind}</app:mimeType>{''.join(rows)}</app:ParameterizedTexture>"
            "</app:surfaceDataMember>\n")


def _write_file(path: Path, file: _GmlFile, frame: _Frame, model: CityModel, extension: str) -> None:
    """Put head, members and textures together."""
    more = {file.module: namespace_of(file.module)} if file.module in _MORE_SCHEMAS else {}
    schema = "".join(f" {uri} http://schemas.opengis.net/citygml/{_MORE_SCHEMAS[name]}" for name, uri in more.items())
    spaces = " ".join(f'xmlns:{prefix}="{uri}"' for prefix, uri in {**_NAMESPACES, **more, "uro": extension}.items())
    if frame.epsg in (GEOGRAPHIC_2011, GEOGRAPHIC_2024):
        extension_schema = f"{extension} ../../schemas/iur/uro/{extension.rpartition('/')[2]}/urbanObject.xsd"
        spaces += f' xsi:schemaLocation="{extension_schema} {_SCHEMAS}{schema}"'
    title = f"<gml:name>{xml_text(model.title)}</gml:name>" if model.title else ""
    envelope = ""
    if np.isfinite(file.low).all():
        system = f' srsName="http://www.opengis.net/def/crs/EPSG/0/{frame.epsg}"' if frame.epsg else ""
        low, high = (" ".join(map(repr, corner.tolist())) for corner in (file.low, file.high))
        envelope = (f'<gml:boundedBy><gml:Envelope{system} srsDimension="3"><gml:lowerCorner>{low}</gml:lowerCorner>'
                    f"<gml:upperCorner>{high}</gml:upperCorner></gml:Envelope></gml:boundedBy>")
    with written_beside(path) as temporary, open(temporary, "wb") as target:
        target.write(f'<?xml version="1.0" encoding="UTF-8"?>\n{WRITTEN_BY}\n<core:CityModel {spaces}>\n{title}'
                     f"{envelope}\n".encode())
        _append(file.folder / f"{file.name}.members", target)
        textures = file.folder / f"{file.name}.textures"
        if textures.exists():
            target.write(f"<app:appearanceMember><app:Appearance><app:theme>{THEME}</app:theme>\n".encode())
            _append(textures, target)
            target.write(b"</app:Appearance></app:appearanceMember>\n")
        target.write(b"</core:CityModel>\n")


def _append(path: Path, target) -> None:
    with open(path, "rb") as source:
        shutil.copyfileobj(source, target)
