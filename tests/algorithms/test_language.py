"""The program in another language: nothing is left untranslated, and words come from the translation everywhere."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TRANSLATIONS = ROOT / "resources" / "translations"


@pytest.fixture
def japanese(qgis_app, plugin):
    """The program speaks Japanese in the test."""
    language = plugin("algorithms.framework.language.language")
    translator = language.speak_language("ja")
    assert translator is not None
    yield
    language.stop_speaking(translator)


def test_every_text_is_translated():
    done = subprocess.run([sys.executable, str(ROOT / "scripts" / "make_translations.py"), "--check"],
                          capture_output=True, text=True, env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
    assert done.returncode == 0, f"{done.stdout[-3000:]}\n{done.stderr[-2000:]}\nrun scripts/make_translations.py"


@pytest.mark.skipif(not Path("/proc/self/maps").is_file(), reason="no list of mapped files")
def test_an_update_can_write_over_the_catalogue_in_use(japanese):
    """QGIS unpacks a new version over the old one before it unloads that: a catalogue mapped into memory ended QGIS."""
    from qgis.PyQt.QtCore import QCoreApplication

    assert QCoreApplication.translate("UrbanMap", "Trajectory") != "Trajectory"
    assert "ja.qm" not in Path("/proc/self/maps").read_text(encoding="utf-8")


@pytest.mark.parametrize("source", sorted(TRANSLATIONS.glob("*.ts")), ids=lambda path: path.stem)
def test_the_compiled_file_says_what_its_source_says(qgis_app, source):
    from qgis.PyQt.QtCore import QCoreApplication, QTranslator

    from urbanmap_qgis.wording import read_catalogue

    translator = QTranslator()
    assert translator.load(str(source.with_name("ja.qm"))) and QCoreApplication.installTranslator(translator)
    texts = read_catalogue(source)
    wrong = {text: told for text, told in texts.items() if QCoreApplication.translate("UrbanMap", text) != told}
    QCoreApplication.removeTranslator(translator)
    assert len(texts) > 2000 and not wrong


def test_toolbox_and_dialogs_speak_it(japanese, plugin):
    from qgis.core import QgsApplication

    provider = QgsApplication.processingRegistry().providerById("urbanmap")
    chosen = next(item for item in provider.algorithms() if item.name() == "buildingmodels").create()
    assert chosen.displayName() == "建物モデル" and chosen.group() == "建物"
    assert chosen.parameterDefinition("POINTS").description() == "屋根の点"
    assert "<h3>入力</h3>" in chosen.shortHelpString()
    page = plugin("algorithms.framework.language.help_page").page_html(chosen)
    assert 'lang="ja"' in page and "建物モデル" in page


def test_a_mistake_is_told_in_it(japanese, run, tmp_path):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="ください"):
        run("urbanmap:surfacefromals", {"POINTS": [str(tmp_path / "無い.laz")], "OUTPUT": str(tmp_path / "a.tif")})


def test_messages_of_the_core_and_reports_speak_it(japanese, plugin, tmp_path):
    with pytest.raises(plugin("urbanmap_qgis.errors").InputError, match="ください"):
        plugin("urbanmap_qgis.io.points.pointcloud").open_cloud([])
    report = plugin("urbanmap_qgis.io.pages.report").Report("Building models")
    report.table(["building", "status"], [[1, "not modelled"]])
    report.write(tmp_path / "r.html")
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert '<html lang="ja">' in text and "建物モデル" in text and "<th>状態</th>" in text


def test_legends_and_columns_speak_it(japanese, plugin):
    styles = plugin("algorithms.framework.layers.styles")
    text = styles.style_text("marking_lines", ["fid", "width", "own"], ["width"])
    assert 'label="dashed"' not in text and 'name="幅' in text


def test_english_comes_back(qgis_app, plugin):
    assert plugin("urbanmap_qgis.wording").language() == "en"
    assert plugin("algorithms.framework.declaring.parameters").tr("Building models") == "Building models"
