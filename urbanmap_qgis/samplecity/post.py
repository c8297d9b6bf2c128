"""Progress and cancel between threads or processes, by files: works with any executor on one file system."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..progress import Progress


@dataclass(frozen=True)
class Post:
    """A worker's end: tells its progress into a file of its own, and stops when the file `STOP` is there."""

    folder: Path
    name: str
    STOP = "stop"

    @property
    def path(self) -> Path:
        """The file of the letters."""
        return self.folder / f"{self.name}.txt"

    def progress(self) -> Progress:
        """The progress object for the worker."""
        return Progress(report=lambda fraction: self._tell("f", f"{fraction:.4f}"),
                        message=lambda text: self._tell("m", text), warn=lambda text: self._tell("w", text),
                        cancelled=(self.folder / self.STOP).exists)

    def _tell(self, kind: str, text: str) -> None:
        with self.path.open("a", encoding="utf-8") as file:
            file.write(f"{kind}{' '.join(text.split())}\n")


class Letters:
    """The other end: passes on a worker's messages and knows its latest fraction, 0 to 1."""

    def __init__(self, post: Post):
        self.post, self.fraction, self._read = post, 0.0, 0

    def read(self, progress: Progress) -> None:
        """Read what has come since the last time."""
        if not self.post.path.exists():
            return
        with self.post.path.open("rb") as file:
            file.seek(self._read)
            new = file.read()
        # A line that is still being written is left for the next time.
        whole = new[:new.rfind(b"\n") + 1]
        self._read += len(whole)
        for line in whole.decode("utf-8").splitlines():
            if line[0] == "f":
                self.fraction = float(line[1:])
            else:
                (progress.message if line[0] == "m" else progress.warn)(line[1:])
