"""Missing packages: found, named, and installed without touching the numpy that is there."""

from __future__ import annotations

import base64
import hashlib
import importlib
import importlib.metadata
import sys
import time
import zipfile
from pathlib import Path

import pytest

from urbanmap_qgis import dependencies
from urbanmap_qgis.dependencies import (
    PACKAGES,
    InstallError,
    Missing,
    Package,
    find_missing,
    install,
    install_command,
    missing_message,
    packages_folder,
    shown_command,
    version_numbers,
)
from urbanmap_qgis.errors import Cancelled

ROOT = Path(__file__).resolve().parents[2]
TOY = Package("urbanmap_toy", "urbanmap-toy", (1, 0))


def make_wheel(folder: Path, name: str, version: str, requires: tuple[str, ...] = ()) -> Path:
    """A wheel with one module that holds its version."""
    module = name.replace("-", "_")
    info = f"{module}-{version}.dist-info"
    metadata = f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n"
    metadata += "".join(f"Requires-Dist: {item}\n" for item in requires)
    files = {
        f"{module}/__init__.py": f"__version__ = {version!r}\n",
        f"{info}/METADATA": metadata,
        f"{info}/WHEEL": "Wheel-Version: 1.0\nGenerator: test\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    record = []
    for path, text in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(text.encode()).digest()).rstrip(b"=").decode()
        record.append(f"{path},sha256={digest},{len(text.encode())}")
    files[f"{info}/RECORD"] = "\n".join([*record, f"{info}/RECORD,,"]) + "\n"
    wheel = folder / f"{module}-{version}-py3-none-any.whl"
    with zipfile.ZipFile(wheel, "w") as archive:
        for path, text in files.items():
            archive.writestr(path, text)
    return wheel


@pytest.fixture
def offline(tmp_path, monkeypatch):
    """pip options for a folder of wheels: a package that needs numpy, and two versions of numpy."""
    wheels = tmp_path / "wheels"
    wheels.mkdir()
    make_wheel(wheels, "urbanmap-toy", "1.4", ("numpy>=1.20", "urbanmap-toy-helper"))
    make_wheel(wheels, "urbanmap-toy-helper", "0.1")
    make_wheel(wheels, "numpy", importlib.metadata.version("numpy"))
    make_wheel(wheels, "numpy", "99.0")
    monkeypatch.setitem(PACKAGES, TOY.import_name, TOY)
    monkeypatch.setattr(sys, "path", list(sys.path))
    return ["--no-index", "--find-links", str(wheels)]


@pytest.fixture(autouse=True)
def looked_at_anew(monkeypatch):
    """Packages that other tests have loaded are looked at again."""
    monkeypatch.setattr(dependencies, "_LOADED_AND_RIGHT", {})


def test_packages_that_are_there_are_not_missing():
    assert find_missing(["numpy", "shapely"]) == []


def test_a_package_that_is_loaded_and_right_is_looked_at_once(monkeypatch):
    import numpy

    assert find_missing(["numpy"]) == []
    monkeypatch.setattr(dependencies, "installed_version", lambda package: "0.1")
    assert find_missing(["numpy"]) == []
    monkeypatch.setitem(dependencies._LOADED_AND_RIGHT, "numpy", pytest)  # another copy took its place
    assert len(find_missing(["numpy"])) == 1
    assert numpy is sys.modules["numpy"]


def test_absent_package_is_missing(monkeypatch):
    monkeypatch.setitem(PACKAGES, TOY.import_name, TOY)
    (item,) = find_missing(["numpy", TOY.import_name])
    assert (str(item), item.package.requirement) == ("urbanmap-toy", "urbanmap-toy>=1.0")


@pytest.mark.parametrize(("version", "found"), [("1.8.5", True), ("2.0.0", False), ("2.1rc1", False)])
def test_too_old_package_is_missing_and_says_so(monkeypatch, version, found):
    monkeypatch.setattr(dependencies, "installed_version", lambda package: version)
    items = find_missing(["shapely"])
    assert bool(items) is found
    if found:
        assert str(items[0]) == "shapely~=2.0 (found 1.8.5)"


def test_opencv_5_is_refused(monkeypatch):
    monkeypatch.setattr(dependencies, "installed_version", lambda package: "5.0.0.1")
    (item,) = find_missing(["cv2"])
    assert item.package.requirement == "opencv-python-headless~=4.5"


@pytest.mark.parametrize(("text", "numbers"), [("1.24.2", (1, 24, 2)), ("2.0.0rc1", (2, 0, 0)), ("dev", ())])
def test_version_numbers(text, numbers):
    assert version_numbers(text) == numbers


def test_message_names_package_and_command(tmp_path):
    message = missing_message([Missing(TOY)], tmp_path)
    assert message.startswith("Python packages missing: urbanmap-toy.")
    assert f"numpy=={importlib.metadata.version('numpy')}" in message
    assert str(tmp_path) in message


def test_command_never_asks_for_another_numpy(tmp_path):
    command = install_command([Missing(TOY)], tmp_path)
    assert [part for part in command if part.startswith("numpy")] == [
        f"numpy=={importlib.metadata.version('numpy')}"]
    assert Path(command[0]).name.startswith("python")


def test_shown_command_quotes_what_a_shell_would_take_apart(monkeypatch):
    monkeypatch.setattr(dependencies.platform, "system", lambda: "Linux")
    assert shown_command(["python3", "-m", "pip", "a b", "x>=1,<2"]) == 'python3 -m pip "a b" "x>=1,<2"'


def test_command_for_windows_writes_to_no_file(monkeypatch):
    monkeypatch.setattr(dependencies.platform, "system", lambda: "Windows")
    told = shown_command([r"C:\QGIS\python3.exe", r"C:\Users\a b", "numpy>=1.22,<3", "shapely~=2.0"])
    assert told == r'C:\QGIS\python3.exe "C:\Users\a b" "numpy>=1.22,<3" shapely~=2.0'


def test_message_on_all_packages_holds_nothing_that_a_window_takes_for_a_tag(tmp_path):
    message = missing_message([Missing(item) for name, item in PACKAGES.items() if name != "numpy"], tmp_path)
    assert "<" not in message and "affine~=2.0" in message
    assert all(item.requirement in message for name, item in PACKAGES.items() if name != "numpy")


@pytest.mark.parametrize(("name", "fits", "not_"), [
    ("shapely", ("2.0", "2.1.4"), ("1.8.5", "3.0")), ("laspy", ("2.4", "2.7.1"), ("2.3", "3.0")),
    ("rasterio", ("1.3.9", "1.4"), ("1.2", "2.0"))])
def test_requirement_asks_for_the_versions_that_work(name, fits, not_):
    specifiers = pytest.importorskip("packaging.requirements")
    (package,) = (item for item in PACKAGES.values() if item.distribution == name)
    asked = specifiers.Requirement(package.requirement).specifier
    assert all(version in asked for version in fits) and not any(version in asked for version in not_)


@pytest.mark.parametrize(("system", "executable", "expected"), [
    ("Windows", "bin/qgis-bin.exe", "apps/Python312/python.exe"),
    ("Darwin", "Contents/MacOS/QGIS", "Contents/MacOS/bin/python3"),
    ("Linux", "usr/bin/qgis", "usr/bin/python3"),
])
def test_python_is_found_where_qgis_hides_it(tmp_path, monkeypatch, system, executable, expected):
    """Starting `sys.executable` inside QGIS would open a second window."""
    for name in (executable, expected):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    prefix = {"Windows": "apps/Python312", "Darwin": "Contents/Frameworks", "Linux": "usr"}[system]
    monkeypatch.setattr(dependencies.platform, "system", lambda: system)
    monkeypatch.setattr(sys, "executable", str(tmp_path / executable))
    monkeypatch.setattr(sys, "exec_prefix", str(tmp_path / prefix))
    monkeypatch.setattr(sys, "_base_executable", None, raising=False)
    assert dependencies.python_executable() == str(tmp_path / expected)


@pytest.mark.slow
def test_installs_without_numpy_and_finds_it_last(tmp_path, offline):
    folder = packages_folder(tmp_path / "プロファイル 1")
    lines = []
    install([Missing(TOY)], folder, lines.append, pip_options=offline)
    assert {item.name for item in folder.iterdir() if "dist-info" not in item.name} == {
        "urbanmap_toy", "urbanmap_toy_helper"}
    assert not list(folder.glob("numpy*"))
    assert sys.path[-1] == str(folder)
    assert find_missing([TOY.import_name]) == []
    assert any("urbanmap" in line for line in lines)
    assert [item.name for item in folder.parent.iterdir()] == [folder.name]

    # A second time: the package is replaced.
    make_wheel(tmp_path / "wheels", "urbanmap-toy", "1.5")
    install([Missing(TOY)], folder, pip_options=offline)
    assert "1.5" in (folder / "urbanmap_toy" / "__init__.py").read_text(encoding="utf-8")


@pytest.mark.slow
def test_failed_installation_changes_nothing_and_says_why(tmp_path, offline):
    folder = packages_folder(tmp_path)
    absent = Missing(Package("urbanmap_nowhere", "urbanmap-nowhere"))
    with pytest.raises(InstallError, match="pip could not install the packages: .*urbanmap-nowhere"):
        install([absent], folder, pip_options=offline)
    assert list(folder.iterdir()) == []
    assert list(folder.parent.iterdir()) == [folder]


def test_cancelled_installation_changes_nothing(tmp_path, offline):
    folder = packages_folder(tmp_path)
    with pytest.raises(Cancelled):
        install([Missing(TOY)], folder, cancelled=lambda: True, pip_options=offline)
    assert list(folder.iterdir()) == []


def test_python_without_pip_is_told(tmp_path, monkeypatch):
    python = tmp_path / "python3"
    python.write_text("#!/bin/sh\necho $0: No module named pip\nexit 1\n", encoding="utf-8")
    python.chmod(0o755)
    monkeypatch.setattr(dependencies, "python_executable", lambda: str(python))
    with pytest.raises(InstallError, match="has no pip"):
        install([Missing(TOY)], tmp_path / "packages")


def test_requirements_file_says_the_same():
    lines = (ROOT / "requirements.txt").read_text(encoding="utf-8").splitlines()
    assert [line for line in lines if line and not line.startswith("#")] == [
        package.requirement for package in PACKAGES.values()]


OLD_FIRST = """
import sys
import time
sys.path.insert(0, {system!r})
from urbanmap_qgis import dependencies
{before}
dependencies.activate({ours!r})
missing = dependencies.find_missing(["shapely", "laspy"])
print([str(item) for item in missing])
import shapely
print(shapely.__version__)
"""


def fake_package(folder, name, version):
    (folder / name).mkdir(parents=True)
    (folder / name / "__init__.py").write_text(f"__version__ = '{version}'\n")
    (folder / f"{name}-{version}.dist-info").mkdir()
    (folder / f"{name}-{version}.dist-info" / "METADATA").write_text(f"Name: {name}\nVersion: {version}\n")


def run_with_old_shapely(tmp_path, before=""):
    import subprocess
    import sys
    from pathlib import Path

    system, ours = tmp_path / "system", tmp_path / "ours"
    for folder, version in ((system, "1.8.5"), (ours, "2.0.6")):
        fake_package(folder, "shapely", version)
    fake_package(system, "laspy", "2.5.0")
    code = OLD_FIRST.format(system=str(system), ours=str(ours), before=before)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True,
                          cwd=Path(__file__).resolve().parents[2])
    return done.stdout.splitlines()


def test_what_was_installed_wins_over_an_older_copy_before_it(tmp_path):
    assert run_with_old_shapely(tmp_path) == ["[]", "2.0.6"]


def test_an_older_copy_that_is_loaded_already_is_named(tmp_path):
    told, version = run_with_old_shapely(tmp_path, "import shapely")
    assert version == "1.8.5" and "1.8.5 was loaded before from" in told and str(tmp_path / "system") in told


def test_a_version_is_read_again_when_packages_come_or_go(tmp_path, monkeypatch):
    """Not before each step of a chain."""
    folder, asked = tmp_path / "packages", []
    (folder / "lazrs").mkdir(parents=True)
    (folder / "lazrs" / "__init__.py").write_text("")
    (folder / "lazrs-0.5.1.dist-info").mkdir()
    (folder / "lazrs-0.5.1.dist-info" / "METADATA").write_text("Metadata-Version: 2.1\nName: lazrs\nVersion: 0.5.1\n")
    monkeypatch.syspath_prepend(folder)
    monkeypatch.delitem(sys.modules, "lazrs", raising=False)
    read = dependencies._version_in
    monkeypatch.setattr(dependencies, "_version_in", lambda *given: asked.append(1) or read(*given))
    package = PACKAGES["lazrs"]
    assert [dependencies.installed_version(package) for _ in range(3)] == ["0.5.1"] * 3 and len(asked) == 1
    time.sleep(0.02)  # clocks of file systems have steps
    (folder / "lazrs-0.5.1.dist-info").rename(folder / "lazrs-0.6.0.dist-info")
    (folder / "lazrs-0.6.0.dist-info" / "METADATA").write_text("Metadata-Version: 2.1\nName: lazrs\nVersion: 0.6.0\n")
    importlib.invalidate_caches()
    assert dependencies.installed_version(package) == "0.6.0"


def test_the_page_says_that_checksums_are_not_compared(tmp_path):
    """As long as the installer does not: who needs it finds the command there."""
    command = install_command([Missing(PACKAGES["laspy"])], tmp_path)
    page = " ".join((Path(__file__).resolve().parents[2] / "docs" / "problems.md").read_text(encoding="utf-8").split())
    assert "--require-hashes" not in command and "--target" in command
    assert "does not compare checksums" in page and "pip install --require-hashes --target FOLDER" in page
