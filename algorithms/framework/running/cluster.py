"""The heavy stages' pieces on a Dask cluster: the core sent along, versions and storage compared before the start.

`distributed` is an optional package and is imported here alone.
"""

from __future__ import annotations

import os
import tempfile
import uuid
import zipfile
from collections.abc import Iterator, Sequence
from concurrent.futures import CancelledError, Executor
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from ....urbanmap_qgis.errors import InputError, UrbanMapError
from ....urbanmap_qgis.sources import MARK_FILE, package_versions, packed_sources, sources_mark
from ..declaring.parameters import tr

COMPARED = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs")
"""Packages whose versions must be the same everywhere: results must not depend on where pieces ran."""

PLUGIN = __package__.rsplit(".", 3)[0]
PATIENCE = 20
"""Seconds in which a scheduler must answer."""

_CLUSTER: ContextVar[_Cluster | None] = ContextVar("cluster", default=None)


class _Cluster:
    """A cluster at an address, connected to when the first piece is to be sent; all stages of a run share it."""

    def __init__(self, address: str, folders: Sequence[str]):
        self.address = address
        self.folders = list(dict.fromkeys([*folders, tempfile.gettempdir()]))
        self._client = None

    def client(self):
        """The connection: core sent, versions and storage compared. A lost one is made again."""
        if self._client is not None and self._client.status == "running":
            return self._client
        self.close()
        client = _client(self.address)
        try:
            _send_core(client)
            _compare_sources(client)
            _compare_versions(client)
            _compare_storage(client, self.folders)
        except BaseException:
            client.close(timeout=PATIENCE)
            raise
        self._client = client
        return client

    def close(self) -> None:
        if self._client is not None:
            self._client.close(timeout=PATIENCE)
            self._client = None


@contextmanager
def scheduler(address: str, folders: Sequence[str]) -> Iterator[None]:
    """In the block, pieces go to the cluster at this address; `folders` are those that its workers must see."""
    cluster = _Cluster(address, folders)
    token = _CLUSTER.set(cluster)
    try:
        yield
    finally:
        _CLUSTER.reset(token)
        cluster.close()


def scheduler_address() -> str:
    """Address of the cluster that pieces go to; empty where they stay on this machine."""
    cluster = _CLUSTER.get()
    return cluster.address if cluster else ""


def cluster_of_process(address: str, folders: Sequence[str]) -> None:
    """Let all pieces of this process go to a cluster, until it ends. Called in a process that was started for tiles."""
    if address:
        _CLUSTER.set(_Cluster(address, folders))


def check_cluster() -> list[str]:
    """See before any work that the cluster of `scheduler` can be worked on; the folders that its workers see.

    Raises
    ------
    InputError : as `cluster_executor`.
    """
    cluster = _CLUSTER.get()
    if cluster is None:
        return []
    cluster.client()
    return cluster.folders


def require_cluster() -> None:
    """See in the middle of the work that the cluster of `scheduler` is still there; a lost one is connected to anew.

    Raises
    ------
    UrbanMapError : it is not, so that nothing more can be done.
    """
    cluster = _CLUSTER.get()
    if cluster is None:
        return
    try:
        cluster.client()
    except (UrbanMapError, OSError, CancelledError) as error:
        raise UrbanMapError(tr("The cluster was lost during the work: {0} Start it and run again; tiles that are whole "
                               "are kept.").format(str(error).strip() or type(error).__name__)) from error


@contextmanager
def cluster_executor() -> Iterator[Executor]:
    """An executor on the cluster of `scheduler`.

    Raises
    ------
    InputError : nobody answers there, it has no workers, their packages differ, or they do not see the folders.
    UrbanMapError : a worker was lost again and again, or the cluster itself.
    """
    client = _CLUSTER.get().client()
    from distributed import KilledWorker

    try:
        yield client.get_executor(pure=False)
    except KilledWorker as error:
        raise UrbanMapError(tr("The cluster's workers were ended at one piece again and again ({0}); give them more "
                               "memory.").format(error)) from None
    except CancelledError:
        if client.status == "running":
            raise
        _CLUSTER.get().close()  # a scheduler that is started anew has not been sent the core
        raise UrbanMapError(tr("The Dask scheduler was lost during the work; start it and run again.")) from None


def _client(address: str):
    try:
        from distributed import Client
    except ImportError:
        raise InputError(tr("The package distributed is not there; install it (pip install distributed) to send work "
                            "to {0}.").format(address)) from None
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except TypeError:
        if not address.startswith("tls://"):
            raise
        raise InputError(tr("Dask has no certificates here for {0}; name them in its configuration, "
                            "distributed.comm.tls (ca-file, client.cert, client.key).").format(address)) from None
    except (OSError, ValueError) as error:
        raise InputError(tr("No Dask scheduler answers at {0} ({1}); check the address, such as tcp://host:8786.")
                         .format(address, str(error).strip() or type(error).__name__)) from None
    if not client.scheduler_info(n_workers=-1)["workers"]:
        client.close()
        raise InputError(tr("The Dask scheduler at {0} has no workers; start some.").format(address))
    return client


def _send_core(client) -> None:
    """Send the core as a zip, under the names by which it is imported here.

    Runs that come to a cluster at the same time wait for each other, and only the first sends: a zip that is written
    again while a worker imports from it cannot be read.
    """
    from distributed import Lock

    mark = sources_mark()
    name = f"urbanmap_core_{mark}.zip"
    with client.as_current(), Lock(name):
        if not _is_sent(client, name):
            with tempfile.TemporaryDirectory(prefix="urbanmap-") as folder:
                archive = Path(folder) / name
                _pack_core(archive, mark)
                client.upload_file(str(archive))


def _compare_sources(client) -> None:
    for worker, found in client.run(sources_mark).items():
        if found != sources_mark():
            raise InputError(tr("The worker {0} has another version of UrbanMap loaded; restart the workers.").format(
                worker))


def _is_sent(client, name: str) -> bool:
    """Whether every worker has the file of this name."""
    folders = {worker: known["local_directory"]
               for worker, known in client.scheduler_info(n_workers=-1)["workers"].items()}
    return all(client.run(os.path.exists, os.path.join(folder, name), workers=[worker])[worker]
               for worker, folder in folders.items())


def _pack_core(archive: Path, mark: str) -> None:
    """Write the zip of the core's sources with their mark."""
    parts = PLUGIN.split(".")
    core = "/".join([*parts, "urbanmap_qgis"])
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as target:
        for number in range(len(parts)):
            target.writestr("/".join([*parts[:number + 1], "__init__.py"]), "")
        for name, path in packed_sources().items():
            target.write(path, f"{core}/{name}")
        target.writestr(f"{core}/{MARK_FILE}", mark)


def _compare_versions(client) -> None:
    expected = package_versions(COMPARED)
    for worker, installed in client.run(package_versions, COMPARED).items():
        other = [f"{name} {installed[name] or '–'} ({expected[name]})" for name in COMPARED
                 if installed[name] != expected[name]]
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
        for worker, visible in seen.items():
            if not visible:
                raise InputError(tr("The worker {0} does not see the folder {1}; put inputs, outputs and temporary "
                                    "files (TMPDIR) on storage that all machines share.").format(worker, folder))
