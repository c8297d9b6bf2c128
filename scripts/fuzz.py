"""Damaged files for every reader of the core: what becomes of them, as a table.

    .venv/bin/python scripts/fuzz.py --city FOLDER [--count 100] [--seed 1] [--format las] [--keep FOLDER]

`--city` is the folder of a sample city (scripts/urbanmap samplecity SIZE=60 OUTPUT=city). Each format's sound file is
damaged by a seeded generator (bytes flipped, cut out, doubled, cut off; numbers made huge, empty or not finite; deep
nesting) and read in a process of its own with 2 GB of memory to take and 10 s a file. Columns: read as if sound;
refused in a sentence; and what must not be: sentences that name no row or element where there is one, tracebacks,
hangs, ends of the process, more memory than 2 GB, values that are not finite. `--keep` keeps the files of the latter.
The exit code is 1 where there is any. Formats are in `fuzz_formats.py`, their sound files in `fuzz_sound.py`; layers
of QGIS for algorithms that take no files (EDGES, LINES, ...) in `fuzz_layers.py`: 90 s each, only where they are named.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import random
import resource
import selectors
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.fuzz_damage import damaged  # noqa: E402
from scripts.fuzz_formats import FORMATS  # noqa: E402
from scripts.fuzz_layers import LAYERS, SOUND, layer_reader  # noqa: E402
from scripts.fuzz_layers import SECONDS as LAYER_SECONDS  # noqa: E402

SECONDS, MEMORY = 10.0, 2 << 30
OUTCOMES = ("read", "sentence", "unnamed", "traceback", "hang", "ended", "memory", "not finite")
GOOD = OUTCOMES[:2]
WITHOUT_ROWS = ("LAS", "LAZ", "SBET", "RMS", "GeoTIFF", "orthophoto", "frame", "strip", "raster", "times of a cloud")
"""How the names of formats begin that have neither rows nor elements to name."""


# A process that reads

def _not_finite(value: object, depth: int = 0) -> bool:
    """Whether NaN or infinity is in what a reader gave back; a limit may be infinite (max_range)."""
    import numpy as np

    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return any(_not_finite(getattr(value, item.name), depth + 1) for item in dataclasses.fields(value)
                   if item.name not in ("max_range", "place_mms", "true", "surveyed"))
    if isinstance(value, np.ndarray):
        return bool(value.dtype.kind == "f" and not np.isfinite(value).all())
    if isinstance(value, dict):
        return any(_not_finite(item, depth + 1) for item in value.values())
    if isinstance(value, (list, tuple)) and depth < 8:
        return any(_not_finite(item, depth + 1) for item in value)
    return isinstance(value, float) and not np.isfinite(value)


def _is_unnamed(error: Exception, name: str) -> bool:
    """Whether a sentence is that of `guard.reads` on a cause that had a row or an element, or Python's own words."""
    cause = error.__cause__
    if "could not convert" in str(error) and " line " not in str(error):
        return True
    rows = isinstance(cause, (ArithmeticError, AttributeError, LookupError, TypeError, ValueError))
    return (rows and not isinstance(cause, (UnicodeError, json.JSONDecodeError)) and not name.startswith(WITHOUT_ROWS)
            and "it is damaged or of another kind" in str(error))


def serve(name: str, seed: int) -> None:
    """Read the files whose paths (of layers: numbers of damages) come by standard input; tell the outcome of each."""
    import warnings

    from urbanmap_qgis.errors import UrbanMapError

    warnings.simplefilter("ignore")
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what libraries print is no answer
    reader = layer_reader(name, seed) if name in LAYERS else FORMATS[name][2]
    print("ready", file=answers, flush=True)
    reader_ready = False
    for line in sys.stdin:
        path = Path(line.rstrip("\n"))
        try:
            outcome, told = ("not finite" if _not_finite(reader(path)) else "read"), ""
        except UrbanMapError as error:
            outcome, told = "sentence", str(error)
            outcome = ("memory" if isinstance(error.__cause__, MemoryError)
                       else "unnamed" if _is_unnamed(error, name) else outcome)
        except MemoryError:
            outcome, told = "memory", ""
        except BaseException as error:  # what a panic is, too
            outcome, told = "traceback", f"{type(error).__name__}: {error}"[:200]
        print(json.dumps([outcome, told]), file=answers, flush=True)
        if not reader_ready:  # the first file is the sound one: by now everything is loaded
            limit = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize() + MEMORY
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
            reader_ready = True


class Server:
    """The reading process of a format, started again when it ends."""

    def __init__(self, name: str, sound: Path, seed: int):
        self.name, self.sound, self.seed = name, sound, seed
        self.seconds = LAYER_SECONDS if name in LAYERS else SECONDS
        self._start()

    def _start(self) -> None:
        self.process = subprocess.Popen([sys.executable, __file__, "--serve", self.name,
                                         "--seed", str(self.seed)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                        env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1",
                                             "TMPDIR": str(self.sound.parent)})
        self.process.stdout.readline()
        outcome, told = self.read(self.sound, 90.0)
        if outcome != "read":
            sys.exit(f"{self.name}: the sound file gives {outcome}: {told}")

    def read(self, path: Path, seconds: float = 0.0) -> tuple[str, str]:
        """Outcome and words for one file or number."""
        self.process.stdin.write(f"{path}\n")
        self.process.stdin.flush()
        with selectors.DefaultSelector() as selector:
            selector.register(self.process.stdout, selectors.EVENT_READ)
            there = selector.select(seconds or self.seconds)
        line = self.process.stdout.readline() if there else ""
        if line:
            return tuple(json.loads(line))
        outcome = "ended" if there else "hang"
        self.close()
        told = f"exit code {self.process.returncode}"
        self._start()
        return outcome, told

    def close(self) -> None:
        self.process.kill()
        self.process.wait()


def trial(name: str, city: Path | None, count: int, seed: int, folder: Path, keep: Path | None
          ) -> tuple[Counter, list[str]]:
    """Outcomes of one format or layer, and a line on each that must not be."""
    found, lines, target, data = Counter(), [], Path(), b""
    if name in LAYERS:
        sound = folder / SOUND
    else:
        file, make, _ = FORMATS[name]
        sound = make(folder / file, city)
        data = sound.read_bytes()
        (folder / "damaged").mkdir(exist_ok=True)
        target = folder / "damaged" / file
    server = Server(name, sound, seed)
    for number in range(count):
        if data:
            target.write_bytes(damaged(data, random.Random(f"{name}-{seed}-{number}")))
        outcome, told = server.read(target if data else Path(str(number)))
        found[outcome] += 1
        if outcome not in GOOD:
            lines.append(f"{name}, seed {seed}, file {number}: {outcome} {told}")
            if keep is not None and data:
                keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(target, keep / f"{name.replace(' ', '_')}-{seed}-{number}-{target.name}")
    server.close()
    return found, lines


def main() -> None:
    """Try all formats, or those that are named."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--city", type=Path)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--format", action="append", choices=[*FORMATS, *LAYERS])
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--serve", choices=[*FORMATS, *LAYERS])
    given = parser.parse_args()
    if given.serve:
        serve(given.serve, given.seed)
        return
    if given.city is None and not set(given.format or FORMATS) <= set(LAYERS):
        parser.error("--city is needed")
    print(f"{'format':<22}" + "".join(f"{outcome:>12}" for outcome in OUTCOMES))
    bad = []
    for name in given.format or FORMATS:
        with tempfile.TemporaryDirectory(prefix="urbanmap-fuzz-") as folder:
            found, lines = trial(name, given.city, given.count, given.seed, Path(folder), given.keep)
        print(f"{name:<22}" + "".join(f"{found[outcome]:>12}" for outcome in OUTCOMES), flush=True)
        bad += lines
    print("\n".join(bad))
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
