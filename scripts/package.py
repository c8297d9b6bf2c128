"""Build the zip that QGIS installs and the plugin repository accepts, from the files that git tracks."""

from __future__ import annotations

import argparse
import configparser
import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDER = "urbanmap_qgis"
FILES = ("metadata.txt", "__init__.py", "LICENSE", "README.md", "CHANGELOG.md")
FOLDERS = ("algorithms", "urbanmap_qgis", "resources")
REQUIRED = ("name", "qgisMinimumVersion", "description", "about", "version", "author", "email", "repository",
            "tracker")


def tracked_files(root: Path) -> list[Path]:
    """Files of the plugin among those that git tracks, relative to `root`."""
    done = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, check=True)
    paths = [Path(name) for name in done.stdout.decode("utf-8").split("\0") if name]
    return sorted(path for path in paths if str(path) in FILES or path.parts[0] in FOLDERS)


def check_metadata(root: Path) -> None:
    """Stop where the plugin repository would refuse the zip."""
    metadata = configparser.ConfigParser(interpolation=None)
    metadata.read(root / "metadata.txt", encoding="utf-8")
    missing = [key for key in REQUIRED if not metadata.get("general", key, fallback="")]
    if missing:
        sys.exit(f"metadata.txt lacks {', '.join(missing)}.")
    if not (root / "LICENSE").is_file():
        sys.exit("LICENSE is missing.")


def build(root: Path, target: Path) -> int:
    """Write the zip and return the number of files in it; the same files give the same bytes."""
    check_metadata(root)
    files = [path for path in tracked_files(root) if (root / path).is_file()]
    target.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in files:
            entry = zipfile.ZipInfo(f"{FOLDER}/{path.as_posix()}", (2000, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, (root / path).read_bytes())
    return len(files)


def main() -> None:
    """Build the zip where the command line says."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=ROOT / "build" / f"{FOLDER}.zip")
    target = parser.parse_args().output
    count = build(ROOT, target)
    print(f"{target}: {count} files, {target.stat().st_size / 1024:.0f} kB")


if __name__ == "__main__":
    main()
