"""Which Python packages UrbanMap needs, which are missing, and how they are installed.

QGIS brings its own numpy (and often more). Packages are installed into a folder of their own that is searched after
everything QGIS has, so that nothing QGIS came with is ever replaced.
"""

from __future__ import annotations

import functools
import importlib.machinery
import importlib.util
import os
import platform
import re
import shutil
import subprocess  # nosec B404 # runs Python and pip, by lists of arguments, without a shell
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .errors import Cancelled, UrbanMapError
from .wording import say

if TYPE_CHECKING:
    import importlib.metadata


class InstallError(UrbanMapError):
    """The packages could not be installed."""


@dataclass(frozen=True)
class Package:
    """A package as Python imports it and as pip names it.

    `below` is the first version that does not work; `tested_below` the first that nobody has tried, which is not
    installed but taken where it is there.
    """

    import_name: str
    distribution: str
    minimum: tuple[int, ...] = ()
    below: tuple[int, ...] = ()
    tested_below: tuple[int, ...] = ()

    @property
    def requirement(self) -> str:
        """What pip is asked for, such as ``shapely~=2.0`` (2.0 or newer, below 3).

        Said without "less than" where that can be: windows take it for the start of a tag, shells for a file.
        """
        limits = []
        first = self.below or self.tested_below
        if len(self.minimum) == 2 and first == (self.minimum[0] + 1,):
            return f"{self.distribution}~={self.minimum[0]}.{self.minimum[1]}"
        if self.minimum:
            limits.append(">=" + ".".join(map(str, self.minimum)))
        if first:
            limits.append("<" + ".".join(map(str, first)))
        return self.distribution + ",".join(limits)


@dataclass(frozen=True)
class Missing:
    """A package that is not there, or not in a version that works."""

    package: Package
    found_version: str = ""
    in_the_way: str = ""

    def __str__(self) -> str:
        if self.in_the_way:
            return (say("{requirement} (installed, but {found_version} was loaded before from {in_the_way}: restart "
                        "QGIS, without the plugin that loads it)", requirement=self.package.requirement,
                        found_version=self.found_version, in_the_way=self.in_the_way))
        if self.found_version:
            return say("{requirement} (found {found_version})", requirement=self.package.requirement,
                       found_version=self.found_version)
        return self.package.distribution


# OpenCV 5 is built for numpy 2 and does not load beside the numpy 1 of many QGIS builds.
PACKAGES = {
    package.import_name: package
    for package in (
        Package("numpy", "numpy", (1, 22), (), (3,)),
        Package("scipy", "scipy", (1, 9), (), (2,)),
        Package("shapely", "shapely", (2, 0), (), (3,)),
        Package("pyproj", "pyproj", (3, 2), (), (4,)),
        Package("rasterio", "rasterio", (1, 3), (), (2,)),
        Package("laspy", "laspy", (2, 4), (), (3,)),
        Package("lazrs", "lazrs", (0, 5), (), (1,)),
        Package("cv2", "opencv-python-headless", (4, 5), (5,)),
    )
}


def version_numbers(version: str) -> tuple[int, ...]:
    """Leading numbers of a version: ``"2.1.0rc1"`` gives (2, 1, 0)."""
    match = re.match(r"\d+(?:\.\d+)*", version)
    return tuple(int(part) for part in match.group().split(".")) if match else ()


def installed_version(package: Package) -> str:
    """Version of an installed package, or an empty text where its installer left no record of it.

    OpenCV comes under several names (opencv-python, a distribution's own build): any of them will do.
    """
    path = [str(_OURS.folder)] if package.import_name in _OURS.names else None
    state = _folder_state(package.import_name), path, tuple(sys.path)
    if _VERSIONS.get(package.import_name, (None, ""))[0] != state or state[0] is None:
        _VERSIONS[package.import_name] = state, _version_in(package, path)
    return _VERSIONS[package.import_name][1]


_VERSIONS: dict[str, tuple[object, str]] = {}
"""Versions by module, and where they were read: chains ask before each of their steps, and records are slow to read."""


def _folder_state(name: str) -> tuple[str, int] | None:
    """The folder in which a module lies, and when a package last came into it or left it; None where it has none."""
    spec = importlib.util.find_spec(name)
    places = list(spec.submodule_search_locations or ()) if spec is not None else []
    if not places:
        return None
    folder = os.path.dirname(places[0])
    try:
        return folder, os.stat(folder).st_mtime_ns
    except OSError:
        return None


def _version_in(package: Package, path: list[str] | None) -> str:
    """Version of a package in the folders of `path`, by default of all that Python searches."""
    names = [package.distribution]
    if package.import_name == "cv2":
        names += ["opencv-python", "opencv-contrib-python-headless", "opencv-contrib-python", "opencv"]
    for name in names:
        for distribution in _installed(name=name, **({} if path is None else {"path": path})):
            if distribution.version:
                return distribution.version
    return ""


def _installed(**wanted: Any) -> Iterable[importlib.metadata.Distribution]:
    """What `importlib.metadata.distributions` finds; that module reads e-mail and zips, for no start of QGIS."""
    from importlib import metadata

    return metadata.distributions(**wanted)


def _fits(package: Package, version: str) -> bool:
    """Whether a version works; one that left no record is taken to."""
    numbers = version_numbers(version)
    return not numbers or not ((package.minimum and numbers < package.minimum)
                               or (package.below and numbers >= package.below))


class _Ours:
    """Finds those packages in our folder of which another copy that does not work would be found first."""

    folder = Path()
    names: frozenset[str] = frozenset()

    def find_spec(self, name, path=None, target=None):
        """As `importlib.abc.MetaPathFinder` asks."""
        if path is None and name in self.names:
            return importlib.machinery.PathFinder.find_spec(name, [str(self.folder)], target)
        return None

    def prefer(self, folder: Path) -> None:
        """Find out which packages are to be taken from `folder`. numpy never is: QGIS's own is built in."""
        names = [name for name, package in PACKAGES.items()
                 if name != "numpy" and not _fits(package, _version_in(package, None))
                 and importlib.machinery.PathFinder.find_spec(name, [str(folder)])
                 and _fits(package, _version_in(package, [str(folder)]))]
        self.folder, self.names = folder, frozenset(names)
        if self.names and self not in sys.meta_path:
            sys.meta_path.insert(0, self)


_OURS = _Ours()


_LOADED_AND_RIGHT: dict[str, object] = {}
"""Modules by name that were loaded when they were looked at and are of a version that works: that does not change."""


def find_missing(import_names: Iterable[str] = tuple(PACKAGES)) -> list[Missing]:
    """Packages among `import_names` that are not there or too old or too new; nothing is imported."""
    missing = []
    for name in import_names:
        package = PACKAGES[name]
        if name in _LOADED_AND_RIGHT and sys.modules.get(name) is _LOADED_AND_RIGHT[name]:
            continue
        if importlib.util.find_spec(name) is None:
            missing.append(Missing(package))
            continue
        version = installed_version(package)
        loaded = _loaded_elsewhere(name)
        if loaded:
            missing.append(Missing(package, *loaded))
        elif not _fits(package, version):
            missing.append(Missing(package, version))
        elif name in sys.modules:
            _LOADED_AND_RIGHT[name] = sys.modules[name]
    return missing


def _loaded_elsewhere(name: str) -> tuple[str, str] | None:
    """Version and folder of a copy that was loaded although ours is to be taken; None where that is not so."""
    module = sys.modules.get(name)
    file = getattr(module, "__file__", None)
    if name not in _OURS.names or not file or _OURS.folder in Path(file).parents:
        return None
    return str(getattr(module, "__version__", "another version")), str(Path(file).parent.parent)


def packages_folder(profile: str | os.PathLike) -> Path:
    """Folder of a QGIS profile that holds UrbanMap's packages for the running Python version."""
    version = f"py{sys.version_info.major}.{sys.version_info.minor}"
    return Path(profile) / "python" / "urbanmap_packages" / version


def activate(folder: str | os.PathLike) -> None:
    """Let Python search `folder`, after everything it searches already.

    A package of ours that is found before in a version that does not work is taken from `folder` all the same.
    """
    entry = str(folder)
    if not os.path.isdir(entry):
        return
    if entry in sys.path:  # packages may have come since: of newer Pythons this reads e-mail, for no start of QGIS
        importlib.invalidate_caches()
    else:
        sys.path.append(entry)
        sys.path_importer_cache.pop(entry, None)
    _OURS.prefer(Path(folder))


def python_executable() -> str:
    """The Python interpreter of the running program.

    Inside QGIS on Windows and macOS `sys.executable` is QGIS itself; starting that would open a second window.
    """
    name = f"python{sys.version_info.major}.{sys.version_info.minor}"
    running = Path(sys.executable or "python3")
    prefix = Path(sys.exec_prefix)
    base = [Path(path) for path in (getattr(sys, "_base_executable", None),) if path]
    if platform.system() == "Windows":
        candidates = [running, prefix / "python.exe", prefix / "python3.exe", prefix / "Scripts" / "python.exe",
                      running.parent / "python3.exe", running.parent / "python.exe", *base]
    else:
        candidates = [running, prefix / "bin" / name, prefix / "bin" / "python3", running.parent / name,
                      running.parent / "python3", running.parent / "bin" / name, running.parent / "bin" / "python3",
                      *base]
    existing = [str(item) for item in candidates if item.name.lower().startswith("python") and item.is_file()]
    if existing and _version_of(existing[0]) not in ("", sys.version):
        more = [str(item) for item in (Path("/usr/bin") / name, Path("/usr/local/bin") / name) if item.is_file()]
        existing = [item for item in (*existing, *more) if _version_of(item) == sys.version] or existing
    return existing[0] if existing else "python3"


@functools.lru_cache
def _version_of(python: str) -> str:
    """What an interpreter says of its build; empty where it does not start.

    QGIS may take the home of its Python from another installation, whose interpreter does not fit its libraries.
    """
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    try:
        # An interpreter that was found beside the running one, with fixed arguments.
        done = subprocess.run([python, "-S", "-c", "import sys; print(sys.version)"],  # nosec B603
                              capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=20, check=False, env=environment, **_hidden_window())
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.strip()


def numpy_pin() -> list[str]:
    """Requirement that keeps pip to the numpy that is there, or nothing when there is none."""
    version = installed_version(PACKAGES["numpy"])
    return [f"numpy=={version}"] if version else []


def install_command(missing: Sequence[Missing], folder: str | os.PathLike) -> list[str]:
    """Arguments of the command that installs `missing` into `folder`.

    numpy is pinned to the version that is there, so that the packages are chosen to fit it. pip may lay a copy
    of it into the folder; `install` removes it, and a copy is never imported because the folder is searched last.
    """
    pin = [] if any(item.package.import_name == "numpy" for item in missing) else numpy_pin()
    # rasterio's affine 3 does not work beside the attrs of older systems, which is found first.
    pin += ["affine~=2.0"] if any(item.package.import_name == "rasterio" for item in missing) else []
    return [python_executable(), "-m", "pip", "install", "--upgrade", "--target", str(folder),
            *pin, *(item.package.requirement for item in missing)]


def shown_command(arguments: Sequence[str]) -> str:
    """A command as one types it into this platform's shell: no part is taken apart, or for a file to write to."""
    plain = r"[^\w./=:+~\\-]" if platform.system() == "Windows" else r"[^\w./=:+-]"
    return " ".join(f'"{part}"' if re.search(plain, part) else part for part in arguments)


def missing_message(missing: Sequence[Missing], folder: str | os.PathLike) -> str:
    """One text that names the missing packages and says how they are installed here."""
    names = ", ".join(str(item) for item in missing)
    missing = [item for item in missing if not item.in_the_way]
    if not missing:
        return say("Python packages in the way: {names}.", names=names)
    command = shown_command(install_command(missing, folder))
    return say("Python packages missing: {names}. Install them with the menu Plugins > UrbanMap > Install Python "
               "packages, or in a terminal with: {command}", names=names, command=command)


def install(
    missing: Sequence[Missing],
    folder: str | os.PathLike,
    report: Callable[[str], None] = lambda line: None,
    cancelled: Callable[[], bool] = lambda: False,
    pip_options: Sequence[str] = (),
) -> None:
    """Install `missing` into `folder` by pip, leaving out every package that is already there elsewhere.

    pip works in a temporary folder first: a failed or cancelled installation changes nothing.

    Parameters
    ----------
    report : called with each line that pip prints.
    cancelled : asked several times a second, in another thread, whether to stop.
    pip_options : further options of ``pip install``, such as ``--no-index``.

    Raises
    ------
    InstallError : pip is not there or failed.
    Cancelled : the user stopped it.
    """
    if not missing:
        return
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="urbanmap-install-", dir=target.parent) as scratch:
        staging = Path(scratch) / "packages"
        command = [*install_command(missing, staging), "--no-input", "--disable-pip-version-check", *pip_options]
        constraints = Path(scratch) / "constraints.txt"
        wanted = {item.package.import_name for item in missing}
        pinned = {package.distribution: installed_version(package)
                  for name, package in PACKAGES.items() if name not in wanted and installed_version(package)}
        constraints.write_text("".join(f"{name}=={version}\n" for name, version in pinned.items()), encoding="utf-8")
        report(shown_command(command))
        _run([*command, "--constraint", str(constraints)], report, cancelled)
        for name in pinned:
            remove_distribution(staging, name)
        _move_into(staging, target)
    activate(target)


def remove_distribution(folder: Path, name: str) -> None:
    """Remove the files of one distribution from a folder that pip filled with ``--target``."""
    for distribution in _installed(path=[str(folder)]):
        if _plain(distribution.metadata["Name"]) != _plain(name):
            continue
        for file in distribution.files or ():
            path = (folder / str(file)).resolve()
            if folder.resolve() in path.parents:
                path.unlink(missing_ok=True)
        for path in sorted(folder.rglob("*"), key=lambda item: len(item.parts), reverse=True):
            if path.is_dir() and (path.name == "__pycache__" or not any(path.iterdir())):
                shutil.rmtree(path)


def _plain(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _no_pip(python: str) -> InstallError:
    advice = (say("install it with: sudo apt install python3-pip") if platform.system() == "Linux"
              else say("install it with: {shown_command}",
                       shown_command=shown_command([python, "-m", "ensurepip", "--user"])))
    return InstallError(say("{python} has no pip, which installs Python packages: {advice}", python=python,
                            advice=advice))


def _run(command: Sequence[str], report: Callable[[str], None], cancelled: Callable[[], bool]) -> None:
    try:
        # pip of this interpreter, with names and versions from PACKAGES.
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,  # nosec B603
                                   stdin=subprocess.DEVNULL, text=True, encoding="utf-8", errors="replace",
                                   env=_environment(), **_hidden_window())
    except OSError as error:
        raise InstallError(say("Python cannot be started as {command} ({strerror}).", command=command[0],
                               strerror=error.strerror)) from error
    last = ""
    with process:
        # pip is silent for minutes while it downloads, so a thread of its own looks for the cancel.
        threading.Thread(target=_stop_on_cancel, args=(process, cancelled), daemon=True).start()
        for line in process.stdout:
            if line.strip():
                last = line.rstrip()
                report(last)
    if cancelled():
        raise Cancelled()
    if last.endswith("No module named pip"):
        raise _no_pip(command[0])
    if process.returncode != 0:
        raise InstallError(say("pip could not install the packages: {value}", value=last or say("it gave no reason")))


def _stop_on_cancel(process: subprocess.Popen, cancelled: Callable[[], bool]) -> None:
    while process.poll() is None:
        if cancelled():
            process.terminate()
        time.sleep(0.2)


def _environment() -> dict[str, str]:
    environment = dict(os.environ, PYTHONIOENCODING="utf-8")
    if platform.system() == "Darwin" and ".app/" in sys.exec_prefix:
        environment["PYTHONHOME"] = sys.exec_prefix
    return environment


def _hidden_window() -> dict[str, Any]:
    return {"creationflags": getattr(subprocess, "CREATE_NO_WINDOW", 0)} if platform.system() == "Windows" else {}


def _move_into(staging: Path, target: Path) -> None:
    for item in sorted(staging.iterdir()):
        place = target / item.name
        if place.is_dir():
            shutil.rmtree(place)
        elif place.exists():
            place.unlink()
        shutil.move(str(item), str(place))
