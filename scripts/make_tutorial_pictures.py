#!/usr/bin/env python3
"""Make the pictures of the tutorials, docs/images/tutorials/*.jpg: windows of QGIS, reports and models.

    .venv/bin/python scripts/make_tutorial_pictures.py [NAME.jpg ...] [--folder build/tutorials] [--to FOLDER]

First the commands of the tutorials run as they stand there (those whose results are in the folder already are left
out; for pictures in Japanese once more in that language, in the folder's `ja`), then QGIS's desktop is started on a
virtual screen, where the dialogs are filled in with the same commands. Needs QGIS, `xvfb` with Mesa's software
renderer, and Chromium for the reports (Debian: apt install xvfb libgl1-mesa-dri chromium); the pictures in Japanese
also QGIS's translations and a Japanese font (fonts-ipaexfont or fonts-noto-cjk).
Inside QGIS this same script runs again.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

INSIDE = os.environ.get("URBANMAP_TUTORIAL")
"""Names of the windows to draw; set only for the run inside QGIS, where the script has no file of its own."""
ROOT = Path(os.environ["URBANMAP_ROOT"]) if INSIDE else Path(__file__).resolve().parent.parent
LARGEST = 118_000
"""Bytes of a picture."""
ALGORITHM_ID = 258
"""Role under which QGIS's toolbox holds an algorithm's id (QgsProcessingToolboxModel.RoleAlgorithmId)."""
WINDOW, DIALOG, REPORT, TABLE = (1280, 800), (900, 640), (1000, 760), (1100, 420)
"""Width and height in pixels."""
SMALLER = {"ja": 0.8}
"""Pictures in other languages are smaller by this factor, as the zip for QGIS holds them all."""
LOCALES = {"en": "C.UTF-8", "ja": "ja_JP.UTF-8"}
"""Language of the commands, as the environment says it."""


@dataclass(frozen=True)
class Toolbox:
    """QGIS's window with the toolbox open at the plugin."""

    language: str = "en"


@dataclass(frozen=True)
class Dialog:
    """An algorithm's dialog, filled in with the command of a tutorial."""

    page: str
    algorithm: str
    language: str = "en"


@dataclass(frozen=True)
class Map:
    """QGIS's window with layers (the topmost first, each with the name it has in the list), and its scale 1 : scale."""

    layers: tuple[tuple[str, str], ...]
    scale: float
    table: bool = False
    """The attribute table of the topmost layer instead of the window."""
    language: str = "en"


@dataclass(frozen=True)
class Page:
    """The beginning of a report, as a browser shows it."""

    file: str
    language: str = "en"


@dataclass(frozen=True)
class Models:
    """Building models in QGIS's 3D engine."""

    file: str


GROUND = (("orthophoto.tif", "Orthophoto"),)
PICTURES = {
    "toolbox.jpg": Toolbox(),
    "buildings_load.jpg": Dialog("tutorial_buildings", "loadgsi"),
    "buildings_dialog.jpg": Dialog("tutorial_buildings", "buildingsfromals"),
    "buildings_map.jpg": Map((("models.gpkg", "Building models"), ("buildings.gpkg", "Footprints"), *GROUND), 800),
    "buildings_table.jpg": Map((("models.gpkg", "Building models"),), 800, table=True),
    "buildings_models.jpg": Models("surfaces.gpkg"),
    "buildings_report.jpg": Page("models.html"),
    "reference_dialog.jpg": Dialog("tutorial_reference", "aerialmarkings"),
    "reference_map.jpg": Map((("road_markings.gpkg", "Road markings"), *GROUND), 400),
    "reference_report.jpg": Page("markings.html"),
    "survey_dialog.jpg": Dialog("tutorial_survey", "georeferencemms"),
    "survey_map.jpg": Map((("patches.gpkg", "Patches"), ("road_markings.gpkg", "Road markings"), *GROUND), 500),
    "survey_report.jpg": Page("survey.html"),
    "survey_accuracy.jpg": Page("accuracy.html"),
    "lanemap_dialog.jpg": Dialog("../README", "lanemap"),
    "lanemap_map.jpg": Map((("bounds.gpkg", "Bounds of lanes"), ("lanes.gpkg", "Lanes"), *GROUND), 450),
}
PICTURES |= {name.replace(".", "_ja."): replace(kind, language="ja") for name, kind in PICTURES.items()
             if not isinstance(kind, Models)}


def size_of(size: tuple[int, int], language: str) -> tuple[int, int]:
    """Width and height of a picture in a language, pixels."""
    factor = SMALLER.get(language, 1.0)
    return round(size[0] * factor), round(size[1] * factor)


def commands_of(page: str) -> list[str]:
    """The commands of a tutorial, lines that go on joined."""
    text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```\n(.*?)^```", text, re.M | re.S)
    lines = "\n".join(blocks).replace("\\\n", " ").splitlines()
    return [line for line in lines if line.startswith("scripts/urbanmap ")]


def parameters_of(command: str) -> dict[str, str | list[str]]:
    """Values by name; a name that stands there several times has a list."""
    found: dict[str, list[str]] = {}
    for name, value in (word.split("=", 1) for word in shlex.split(command)[2:]):
        found.setdefault(name, []).append(value)
    return {name: values if len(values) > 1 else values[0] for name, values in found.items()}


def dialog_command(dialog: Dialog) -> str:
    """The tutorial's command with the dialog's algorithm."""
    return next(line for line in commands_of(dialog.page) if shlex.split(line)[1] == dialog.algorithm)


# --- inside QGIS -----------------------------------------------------------------------------------------------------


def settle(seconds: float = 1.0) -> None:
    """Let the window draw."""
    from qgis.PyQt.QtCore import QEventLoop, QTimer

    loop = QEventLoop()
    QTimer.singleShot(int(1000 * seconds), loop.quit)
    loop.exec_() if hasattr(loop, "exec_") else loop.exec()


def prepared_window(language: str, *docks: str):
    """QGIS's main window with these panels and an empty project."""
    from qgis.PyQt.QtWidgets import QDockWidget
    from qgis.utils import iface

    window = iface.mainWindow()
    window.showNormal()
    window.resize(*size_of(WINDOW, language))
    for dock in window.findChildren(QDockWidget):
        dock.setVisible(dock.objectName() in docks)
    iface.newProject()
    return window


def draw_toolbox(kind: Toolbox, target: Path) -> None:
    """The toolbox opened at the plugin's groups."""
    from qgis.PyQt.QtCore import Qt
    from qgis.PyQt.QtWidgets import QDockWidget, QTreeView

    window = prepared_window(kind.language, "Layers", "ProcessingToolbox")
    dock = window.findChild(QDockWidget, "ProcessingToolbox")
    window.resizeDocks([dock], [420], Qt.Orientation.Horizontal)
    tree = max(dock.findChildren(QTreeView), key=lambda view: view.model().rowCount() if view.model() else 0)
    settle()
    model = tree.model()
    rows = [model.index(row, 0) for row in range(model.rowCount())]
    own = next(index for index in rows if index.data() == "UrbanMap")
    tree.expand(own)
    groups = [model.index(row, 0, own) for row in range(model.rowCount(own))]
    for group in groups:
        held = {model.data(model.index(row, 0, group), ALGORITHM_ID) for row in range(model.rowCount(group))}
        if held & {"urbanmap:samplecity", "urbanmap:lanemap", "urbanmap:occlusionmap"}:
            tree.expand(group)
    tree.scrollTo(own, QTreeView.ScrollHint.PositionAtTop)
    settle()
    window.grab().save(str(target))


def draw_dialog(dialog: Dialog, target: Path) -> None:
    """The dialog of an algorithm with the tutorial's values."""
    import processing
    from qgis.utils import iface

    iface.newProject()
    command = dialog_command(dialog)
    window = processing.createAlgorithmDialog(f"urbanmap:{dialog.algorithm}", parameters_of(command))
    window.resize(*size_of(DIALOG, dialog.language))
    window.show()
    settle()
    window.grab().save(str(target))
    window.close()


def draw_map(kind: Map, target: Path) -> None:
    """The main window, or the topmost layer's table."""
    from qgis.core import QgsProject, QgsRasterLayer, QgsVectorLayer
    from qgis.PyQt.QtCore import QCoreApplication
    from qgis.utils import iface

    window = prepared_window(kind.language, "Layers")
    project = QgsProject.instance()
    for file, words in reversed(kind.layers):
        title = QCoreApplication.translate("UrbanMap", words)
        layer = QgsRasterLayer(file, title) if file.endswith(".tif") else QgsVectorLayer(file, title, "ogr")
        if not layer.isValid():
            raise SystemExit(f"{file} cannot be opened.")
        project.addMapLayer(layer)
    canvas = iface.mapCanvas()
    project.setCrs(layer.crs())
    settle(2.0)
    canvas.setCenter(layer.extent().center())
    canvas.zoomScale(kind.scale / SMALLER.get(kind.language, 1.0))
    canvas.refresh()
    settle()
    canvas.waitWhileRendering()
    if kind.table:
        window = iface.showAttributeTable(layer)
        window.resize(*size_of(TABLE, kind.language))
        window.show()
    settle(2.0)
    window.grab().save(str(target))
    if kind.table:
        window.close()


def draw_inside() -> None:
    """Draw the windows that are asked for, then end QGIS."""
    import traceback

    code = 0
    try:
        settle(3.0)
        for name in INSIDE.split():
            kind, target = PICTURES[name], Path(f"pictures/{name}").with_suffix(".png").resolve()
            if isinstance(kind, Toolbox):
                draw_toolbox(kind, target)
            elif isinstance(kind, Dialog):
                draw_dialog(kind, target)
            else:
                draw_map(kind, target)
    except BaseException:
        traceback.print_exc()
        code = 1
    sys.stderr.flush()
    os._exit(code)  # QGIS would ask about the unsaved project


# --- outside ---------------------------------------------------------------------------------------------------------


def run_commands(folder: Path, language: str) -> None:
    """Run the tutorials' commands whose results are not there yet."""
    environment = {key: value for key, value in os.environ.items() if key not in ("LC_ALL", "LANGUAGE", "LC_MESSAGES")}
    environment["LANG"] = LOCALES[language]
    (folder / "pictures").mkdir(parents=True, exist_ok=True)
    if not (folder / "scripts").exists():
        (folder / "scripts").symlink_to(ROOT / "scripts")
    done: set[str] = set()
    for page in sorted({kind.page for kind in PICTURES.values() if isinstance(kind, Dialog)}):
        for command in commands_of(page):
            outputs = [value for name, value in parameters_of(command).items() if name.startswith("OUTPUT")]
            if command in done or all((folder / output).exists() for output in outputs):
                continue
            print(command, flush=True)
            subprocess.run(["sh", "-c", command], cwd=folder, env=environment, check=True, stdin=subprocess.DEVNULL,
                           stdout=subprocess.DEVNULL)
            done.add(command)


def profile_of(folder: Path, language: str) -> Path:
    """A QGIS profile in a language that knows the plugin and asks nothing at the start."""
    profile = folder / "profile"
    settings = profile / "config/profiles/default/QGIS/QGIS3.ini"
    settings.parent.mkdir(parents=True, exist_ok=True)
    for name in ("home", "plugins", "runtime"):
        (profile / name).mkdir(mode=0o700, exist_ok=True)
    link = profile / "plugins" / "urbanmap_qgis"
    if not link.is_symlink():
        link.symlink_to(ROOT, target_is_directory=True)
    settings.write_text("[PythonPlugins]\nurbanmap_qgis=true\nprocessing=true\nMetaSearch=false\ndb_manager=false\n"
                        f"grassprovider=false\nsagaprovider=false\n\n[locale]\nuserLocale={language}\noverrideFlag=true\n\n"
                        "[qgis]\ncheckVersion=false\nshowTips=false\nattributeTableLastView=0\n", encoding="utf-8")
    return profile


def draw_windows(names: list[str], folder: Path, language: str) -> None:
    """Let QGIS's desktop draw its windows on a virtual screen."""
    profile = profile_of(folder, language)
    if language == "ja" and not _output("fc-list", ":lang=ja", HOME=str(profile / "home")):
        sys.exit("There is no Japanese font, without which the windows show boxes: apt install fonts-ipaexfont")
    packages = sorted((ROOT / ".venv" / "lib").glob("python3.*/site-packages"))
    open_desktop(ROOT / "scripts" / Path(__file__).name, folder, profile,
                 PYTHONPATH=os.pathsep.join(map(str, packages)), URBANMAP_TUTORIAL=" ".join(names),
                 URBANMAP_ROOT=str(ROOT))


def open_desktop(script: Path, folder: Path, profile: Path, longest: float = 600.0, **variables: str) -> None:
    """Start QGIS's desktop on a virtual screen, in an environment with these variables, and let it run a script.

    It may take `longest` seconds.
    """
    kept = {key: value for key, value in os.environ.items()
            if not key.startswith(("QGIS_", "PYTHON", "QT_", "DISPLAY"))}
    environment = {
        **kept, "HOME": str(profile / "home"), "LC_ALL": "C.UTF-8", "LIBGL_ALWAYS_SOFTWARE": "1",
        "PATH": os.pathsep.join(["/usr/bin", "/bin", os.environ.get("PATH", "")]),
        "QGIS_CUSTOM_CONFIG_PATH": str(profile / "config"), "QGIS_PLUGINPATH": str(profile / "plugins"),
        "XDG_RUNTIME_DIR": str(profile / "runtime"), **variables,
    }
    program = shutil.which("qgis.bin") or shutil.which("qgis")
    if program is None or shutil.which("xvfb-run") is None:
        sys.exit("QGIS's desktop and xvfb are needed: apt install qgis xvfb libgl1-mesa-dri")
    subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1400x900x24", program, "--nologo", "--noversioncheck",
                    "--profiles-path", str(profile / "config"), "--code", str(script)],
                   cwd=folder, env=environment, check=True, timeout=longest)


def _output(*command: str, **changes: str) -> str:
    """What a program says, in an environment with changes."""
    return subprocess.run(command, env={**os.environ, **changes}, capture_output=True, text=True, check=False).stdout


def draw_report(kind: Page, folder: Path, target: Path) -> None:
    """The first screen of a report, by Chromium."""
    program = shutil.which("chromium") or shutil.which("google-chrome")
    if program is None:
        sys.exit("Chromium is needed for the pictures of reports: apt install chromium")
    subprocess.run([program, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                    "--window-size={},{}".format(*size_of(REPORT, kind.language)), f"--screenshot={target}",
                    (folder / kind.file).as_uri()],
                   check=True, capture_output=True, timeout=120)


def draw_models(kind: Models, folder: Path, target: Path) -> None:
    """Building models in 3D, by the script that does only that."""
    environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "VIRTUAL_ENV")}
    script = str(ROOT / "scripts" / "render_models.py")
    subprocess.run(["/usr/bin/python3", script, str(folder / kind.file), str(target), "--size", "1200x750",
                    "--pitch", "50"], check=True, env=environment)


def save_small(source: Path, target: Path) -> None:
    """Write a picture as JPEG, as good as its largest size allows."""
    import cv2

    picture = cv2.imread(str(source))
    if picture is None:
        sys.exit(f"{source.name} was not drawn.")
    for quality in range(88, 30, -4):
        data = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])[1].tobytes()
        if len(data) <= LARGEST:
            break
    target.write_bytes(data)
    print(f"{target.name}: {len(data) // 1000} kB, quality {quality}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", help="pictures to make (default: all)")
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "tutorials", help="where the commands run")
    parser.add_argument("--to", type=Path, default=ROOT / "docs" / "images" / "tutorials", help="where pictures go")
    options = parser.parse_args()
    names, folder = options.names or list(PICTURES), options.folder.resolve()
    if unknown := [name for name in names if name not in PICTURES]:
        sys.exit(f"There is no picture {unknown[0]}; there are: {', '.join(PICTURES)}")
    options.to.mkdir(parents=True, exist_ok=True)
    for language in LOCALES:
        chosen = {name: PICTURES[name] for name in names if getattr(PICTURES[name], "language", "en") == language}
        if chosen:
            make_pictures(chosen, folder if language == "en" else folder / language, options.to, language)


def make_pictures(chosen: dict[str, Toolbox | Dialog | Map | Page | Models], folder: Path, to: Path,
                  language: str) -> None:
    """Make the pictures of one language."""
    if not all(isinstance(kind, (Toolbox, Dialog)) for kind in chosen.values()):
        run_commands(folder, language)
    (folder / "pictures").mkdir(parents=True, exist_ok=True)
    windows = [name for name, kind in chosen.items() if isinstance(kind, (Toolbox, Dialog, Map))]
    if windows:
        draw_windows(windows, folder, language)
    for name, kind in chosen.items():
        drawn = (folder / "pictures" / name).with_suffix(".png")
        if isinstance(kind, Page):
            draw_report(kind, folder, drawn)
        elif isinstance(kind, Models):
            draw_models(kind, folder, drawn)
        save_small(drawn, to / name)


if INSIDE:
    from qgis.PyQt.QtCore import QTimer

    QTimer.singleShot(1000, draw_inside)
elif __name__ == "__main__":
    main()
