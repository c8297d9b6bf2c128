"""What layers look like: their symbols, legends and tables, in the user's language."""

from __future__ import annotations

import re
import sqlite3
from collections.abc import Mapping, Sequence
from contextlib import closing
from html import escape, unescape
from pathlib import Path
from threading import Lock

from qgis.core import (
    QgsDataProvider,
    QgsMapLayer,
    QgsProcessingContext,
    QgsProcessingLayerPostProcessorInterface,
    QgsVectorLayer,
)
from qgis.PyQt import sip
from qgis.PyQt.QtXml import QDomDocument

from ....urbanmap_qgis.io.files.staging import final_text
from ....urbanmap_qgis.progress import Progress
from ..declaring.parameters import tr
from .field_words import FieldWords, words_of

STYLES = Path(__file__).resolve().parents[3] / "resources" / "styles"
TIME = "2000-01-01T00:00:00.000Z"

TABLE_ONLY = '<qgis styleCategories="Fields|Forms|AttributeTable" version="3.22.0">\n</qgis>\n'
"""The style of a layer that has none: only how its table looks."""

TABLE_STYLE = "table"
"""Its name in a GeoPackage."""

NOTHING = "{2839923C-8B7D-419E-B84B-CA2FE9B80EC7}"
"""The empty value among those that a field's value is chosen from (QgsValueMapFieldFormatter::NULL_VALUE)."""

_LEGEND = re.compile(r'(<(?:category|range|rule|item|paletteEntry)\b[^>]*\blabel=")([^"]*)(")')

_STYLES_TABLE = """
CREATE TABLE layer_styles (id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, f_table_catalog TEXT(256),
  f_table_schema TEXT(256), f_table_name TEXT(256), f_geometry_column TEXT(256), styleName TEXT(30), styleQML TEXT,
  styleSLD TEXT, useAsDefault BOOLEAN, description TEXT, owner TEXT(30), ui TEXT(30), update_time DATETIME)
"""
"""The table in which QGIS looks for styles of layers of a GeoPackage."""


def style_path(style: str) -> Path:
    """File of a style that the plugin brings."""
    return STYLES / f"{style}.qml"


Earlier = tuple[tuple[str, FieldWords], ...]
"""Fields of an earlier step with the words that its result has of them."""


def style_text(style: str, fields: Sequence[str] = (), own: Sequence[str] = (), earlier: Earlier = ()) -> str:
    """A style as QML, its legend in the user's language; with how the table of a layer with `fields` looks.

    `own` : those fields that are results; behind them come those of `earlier` steps, with their words; the others are
    the user's and stay as they are, behind these.

    Raises
    ------
    OSError : the style's file cannot be read.
    """
    text = style_path(style).read_text(encoding="utf-8") if style else TABLE_ONLY
    text = _LEGEND.sub(lambda found: found[1] + escape(tr(unescape(found[2]))) + found[3] if found[2] else found[0],
                       text)
    earlier_words = {name: words for name, words in earlier if name in fields and name not in own}
    table = _table_elements(fields, own, style, earlier_words)
    return text.replace("</qgis>", f"{table}</qgis>") if table else text


def _table_elements(fields: Sequence[str], own: Sequence[str], style: str,
                    earlier_words: Mapping[str, FieldWords]) -> str:
    """Aliases, decimals and order of a table's columns as elements of QML."""
    titled = {name: words for name in own
              if name in fields and (words := words_of(name, style)) is not None} | earlier_words
    if not titled:
        return ""
    lines = ["  <aliases>", *(f'    <alias index="{fields.index(name)}" field="{escape(name)}" '
                              f'name="{escape(tr(words.words))}"/>' for name, words in titled.items()),
              "  </aliases>"]
    lines += ["  <fieldConfiguration>", *(_rounded(name, words) for name, words in titled.items()
                                          if words.decimals is not None),
              *(_chosen(name, words) for name, words in titled.items() if words.choices), "  </fieldConfiguration>"]
    order = sorted(fields, key=lambda name: 0 if name in own else 1 if name in earlier_words else 2)
    lines += ["  <attributetableconfig>", "    <columns>",
              *(f'      <column type="field" name="{escape(name)}" hidden="{int(name == "fid")}" width="-1"/>'
                for name in order), "    </columns>", "  </attributetableconfig>"]
    return "\n".join([*lines, ""])


def _rounded(name: str, words: FieldWords) -> str:
    """How many decimals the table shows of a field; the value itself stays as it is."""
    return (f'    <field name="{escape(name)}"><editWidget type="Range"><config><Option type="Map">'
            f'<Option name="Precision" type="int" value="{words.decimals}"/>'
            '<Option name="AllowNull" type="bool" value="true"/></Option></config></editWidget></field>')


def _chosen(name: str, words: FieldWords) -> str:
    """The words among which a field's value is chosen; nothing chosen is the first, as QGIS writes an empty value.

    Not for truth values: QGIS 3.22 would write the word “true” into them as 0.
    """
    entries = [(tr("not answered"), NOTHING), *((tr(word), value) for value, word in words.choices)]
    options = "".join(f'<Option type="Map"><Option name="{escape(word)}" type="QString" value="{value}"/></Option>'
                      for word, value in entries)
    return (f'    <field name="{escape(name)}"><editWidget type="ValueMap"><config><Option type="Map">'
            f'<Option name="map" type="List">{options}</Option></Option></config></editWidget></field>')


def give_style(context: QgsProcessingContext, place: str, style: str, own: tuple[str, ...] = (),
               earlier: Earlier = ()) -> None:
    """Let QGIS give resources/styles/`style`.qml to the layer at `place` when it loads it after the run.

    `own`, `earlier` : fields that are results, see `style_text`.
    """
    place = final_text(place)
    if context.willLoadLayerOnCompletion(place) and (not style or style_path(style).is_file()):
        context.layerToLoadOnCompletionDetails(place).setPostProcessor(_post_processor(style, own, earlier))


def give_saved_style(context: QgsProcessingContext, path: Path) -> None:
    """Let QGIS draw the layer of a GeoPackage that it loads after the run as the file itself says."""
    saved = saved_style(path)
    if saved is not None:
        name, text = saved
        context.layerToLoadOnCompletionDetails(str(path)).setPostProcessor(_post_processor(name, text=text))


def read_anew(context: QgsProcessingContext, place: str) -> None:
    """Let a layer of the project whose file at `place` a run has replaced show the new one, where nothing else does."""
    details = context.layerToLoadOnCompletionDetails(place)
    if details.postProcessor() is None:
        details.setPostProcessor(_kept(FilePostProcessor()))


class FilePostProcessor(QgsProcessingLayerPostProcessorInterface):
    """Lets a layer read its file again: QGIS goes on with one of the project, which shows the file of before."""

    def postProcessLayer(self, layer: QgsMapLayer, context, feedback):
        if layer.providerType() in ("ogr", "gdal"):
            beside = Path(f"{layer.source()}.aux.xml")
            known = beside.is_file() and beside.stat().st_mtime_ns
            layer.dataProvider().reloadData()
            if beside.is_file() and beside.stat().st_mtime_ns != known:
                beside.unlink()  # what closing the file of before has told of its cells
            layer.setDataSource(layer.source(), layer.name(), layer.providerType(), QgsDataProvider.ProviderOptions())


class StylePostProcessor(FilePostProcessor):
    """Gives a style to a layer that QGIS loads after a run; `text` is its QML where that is no style of the plugin."""

    def __init__(self, style: str, own: tuple[str, ...] = (), earlier: Earlier = (), text: str = ""):
        super().__init__()
        self.style = style
        self.own = own
        self.earlier = earlier
        self.text = text

    def postProcessLayer(self, layer, context, feedback):
        super().postProcessLayer(layer, context, feedback)
        fields = [field.name() for field in layer.fields()] if isinstance(layer, QgsVectorLayer) else []
        document = QDomDocument()
        try:
            document.setContent(self.text or style_text(self.style, fields, self.own, self.earlier))
        except OSError as error:
            feedback.pushWarning(tr("The style {0} could not be given to {1}: {2}").format(
                self.style, layer.name(), error.strerror))
            return
        succeeded, message = layer.importNamedStyle(document)
        if not succeeded:
            feedback.pushWarning(tr("The style {0} could not be given to {1}: {2}").format(
                self.style, layer.name(), message))
        layer.triggerRepaint()


_KEPT: list[FilePostProcessor] = []
"""Those that QGIS has not deleted yet: one that Python collects before is dropped by QGIS without a word."""
_LOCK = Lock()


def _post_processor(style: str, own: tuple[str, ...] = (), earlier: Earlier = (), text: str = "") -> FilePostProcessor:
    return _kept(StylePostProcessor(style, own, earlier, text))


def _kept(processor: FilePostProcessor) -> FilePostProcessor:
    """It, for one layer of one run: QGIS deletes it with the run's context."""
    with _LOCK:
        _KEPT[:] = [alive for alive in _KEPT if not sip.isdeleted(alive)]
        _KEPT.append(processor)
    return processor


def save_style(path: Path, style: str, own: Sequence[str], progress: Progress, earlier: Earlier = ()) -> None:
    """Save a style into a GeoPackage as the default of its only layer; a result without a style is still a result.

    QGIS would write the style's own words in an order that differs from run to run, and leave 3D renderers out where
    it has not been told of them, as in `qgis_process`; so the style's file is stored as it is.
    """
    try:
        text = style_text(style, field_names(path), own, earlier)
    except OSError as error:
        progress.warn(tr("The style {0} is not saved in {1}: {2}").format(style, path.name, error.strerror))
        return
    if text != TABLE_ONLY:
        save_style_text(path, style or TABLE_STYLE, text)


def _only_layer(database: sqlite3.Connection) -> str:
    """Name of the only layer of a GeoPackage.

    Raises
    ------
    sqlite3.DatabaseError : none is entered in it, as where a full disk let QGIS make the file and no more.
    """
    layers = database.execute("SELECT table_name FROM gpkg_contents").fetchall()
    if len(layers) != 1:
        raise sqlite3.DatabaseError("its layer is not entered in it")
    return layers[0][0]


def field_names(path: Path) -> list[str]:
    """Fields of the only layer of a GeoPackage, without its geometry."""
    with closing(sqlite3.connect(path)) as database:
        table = _only_layer(database)
        column = database.execute("SELECT column_name FROM gpkg_geometry_columns").fetchone()
        names = [row[1] for row in database.execute(f'PRAGMA table_info("{table}")')]
    return [name for name in names if column is None or name != column[0]]


def save_style_text(path: Path, name: str, text: str) -> None:
    """Save QML into a GeoPackage as the default style of its only layer."""
    with closing(sqlite3.connect(path)) as database, database:
        table = _only_layer(database)
        column = database.execute("SELECT column_name FROM gpkg_geometry_columns").fetchone()
        database.execute(_STYLES_TABLE)
        database.execute("INSERT INTO gpkg_contents (table_name, data_type, identifier, last_change, srs_id) "
                         "VALUES ('layer_styles', 'attributes', 'layer_styles', ?, 0)", (TIME,))
        database.execute(
            "INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, styleName, "
            "styleQML, styleSLD, useAsDefault, description, owner, update_time) VALUES ('', '', ?, ?, ?, ?, '', 1, ?, "
            "'', ?)", (table, column[0] if column else "", name, text, tr("UrbanMap"), TIME))


def saved_style(path: Path) -> tuple[str, str] | None:
    """Name and QML of the style in a GeoPackage; None where it has none."""
    with closing(sqlite3.connect(path)) as database:
        if not database.execute("SELECT 1 FROM sqlite_master WHERE name = 'layer_styles'").fetchone():
            return None
        return database.execute("SELECT styleName, styleQML FROM layer_styles").fetchone()
