"""The heavy stages' pieces on a Dask cluster: the core sent along, versions and storage compared before the start.

`distributed` is an optional package and is imported here alone.
"""

from __future__ import annotations

import os
import tempfile
import uuid
import zipfile
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from ...urbanmap_qgis.errors import InputError, UrbanMapError
from ...urbanmap_qgis.sources import MARK_FILE, package_versions, source_files, sources_mark
from .parameters import tr

COMPARED = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs")
"""Packages whose versions must be the same everywhere: results must not depend on where pieces ran."""

PLUGIN = __package__.rsplit(".", 2)[0]
CORE = Path(__file__).resolve().parents[2] / "urbanmap_qgis"
PATIENCE = 20
"""Seconds in which a scheduler must answer."""

_ADDRESS: ContextVar[str] = ContextVar("scheduler", default="")
_FOLDERS: ContextVar[tuple[str, ...]] = ContextVar("folders", default=())


@contextmanager
def scheduler(address: str, folders: Sequence[str]) -> Iterator[None]:
    """In the block, pieces go to the cluster at this address; `folders` are those that its workers must see."""
    tokens = _ADDRESS.set(address), _FOLDERS.set(tuple(dict.fromkeys([*folders, tempfile.gettempdir()])))
    try:
        yield
    finally:
        _ADDRESS.reset(tokens[0])
        _FOLDERS.reset(tokens[1])


def scheduler_address() -> str:
    """Address of the cluster that pieces go to; empty where they stay on this machine."""
    return _ADDRESS.get()


@contextmanager
def cluster_executor() -> Iterator[Executor]:
    """An executor on the cluster of `scheduler`.

    Raises
    ------
    InputError : nobody answers there, it has no workers, their packages differ, or they do not see the folders.
    UrbanMapError : a worker was lost again and again.
    """
    client = _client(_ADDRESS.get())
    from distributed import KilledWorker

    try:
        _send_core(client)
        _compare_versions(client)
        _compare_storage(client, _FOLDERS.get())
        yield client.get_executor(pure=False)
    except KilledWorker as error:
        raise UrbanMapError(tr("The cluster's workers were ended at one piece again and again ({0}); give them more "
                               "memory.").format(error)) from None
    finally:
        client.close(timeout=PATIENCE)


def _client(address: str):
    try:
        from distributed import Client
    except ImportError:
        raise InputError(tr("The package distributed is not there; install it (pip install distributed) to send work "
                            "to {0}.").format(address)) from None
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise InputError(tr("No Dask scheduler answers at {0} ({1}); check the address, such as tcp://host:8786.")
                         .format(address, str(error).strip() or type(error).__name__)) from None
    if not client.scheduler_info(n_workers=-1)["workers"]:
        client.close()
        raise InputError(tr("The Dask scheduler at {0} has no workers; start some.").format(address))
    return client


def _send_core(client) -> None:
    """Send the core as a zip, under the names by which it is imported here, and see that it is what workers import."""
    mark, parts = sources_mark(), PLUGIN.split(".")
    with tempfile.TemporaryDirectory(prefix="urbanmap-") as folder:
        archive = Path(folder) / f"urbanmap_core_{mark}.zip"
        core = "/".join([*parts, "urbanmap_qgis"])
        with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as target:
            for number in range(len(parts)):
                target.writestr("/".join([*parts[:number + 1], "__init__.py"]), "")
            for path in source_files():
                target.write(path, f"{core}/{path.relative_to(CORE).as_posix()}")
            target.writestr(f"{core}/{MARK_FILE}", mark)
        client.upload_file(str(archive))
    for worker, found in client.run(sources_mark).items():
        if found != mark:
            raise InputError(tr("The worker {0} has another version of UrbanMap loaded; restart the workers.").format(
                worker))


def _compare_versions(client) -> None:
    here = package_versions(COMPARED)
    for worker, there in client.run(package_versions, COMPARED).items():
        other = [f"{name} {there[name] or '–'} ({here[name]})" for name in COMPARED if there[name] != here[name]]
        if other:
            raise InputError(tr("The worker {0} has other packages than this machine: {1}; install the same there.")
                             .format(worker, ", ".join(other)))


def _compare_storage(client, folders: Sequence[str]) -> None:
    for folder in filter(os.path.isdir, folders):
        probe = Path(folder) / f".urbanmap-{uuid.uuid4().hex}"
        try:
            probe.touch()
            name = str(probe)
        except OSError:  # read only: the folder itself must do
            name = folder
        try:
            seen = client.run(os.path.exists, name)
        finally:
            probe.unlink(missing_ok=True)
        for worker, there in seen.items():
            if not there:
                raise InputError(tr("The worker {0} does not see the folder {1}; put inputs, outputs and temporary "
                                    "files (TMPDIR) on storage that all machines share.").format(worker, folder))
