"""Build the zip that QGIS installs, from the files that git tracks.

For the plugin repository, which asks where a plugin is at home, give that here, the only place where it is set:

    python scripts/package.py --repository https://... --email ADDRESS

repository, tracker and homepage in the zip's metadata follow from it, and the changelog from CHANGELOG.md.
"""

from __future__ import annotations

import argparse
import configparser
import re
import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDER = "urbanmap_qgis"
FILES = ("metadata.txt", "__init__.py", "LICENSE", "README.md", "CHANGELOG.md")
FOLDERS = ("algorithms", "urbanmap_qgis", "resources")
REQUIRED = ("name", "qgisMinimumVersion", "description", "about", "version", "author")
PUBLISHED = ("email", "repository", "tracker", "homepage", "changelog")


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


def changelog(root: Path) -> str:
    """The latest section of CHANGELOG.md as metadata takes it: lines that go on are indented."""
    text = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    latest = re.split(r"^## .*$", text, flags=re.MULTILINE)[1]
    lines = [line.strip() for line in latest.splitlines() if line.strip()]
    return "\n ".join(line.replace("### ", "") for line in lines)


def metadata(root: Path, repository: str = "", email: str = "") -> bytes:
    """metadata.txt as it goes into the zip, with what the plugin repository asks where it is known."""
    text = (root / "metadata.txt").read_text(encoding="utf-8")
    there = [key for key in PUBLISHED if re.search(rf"^{key}=", text, re.MULTILINE)]
    if there:
        sys.exit(f"metadata.txt states {', '.join(there)}: these are set by --repository and --email.")
    if not repository:
        return text.encode("utf-8")
    if not re.match(r"https://[^/\s]+/\S+$", repository) or not re.match(r"[^@\s]+@[^@\s]+\.[^@\s]+$", email):
        sys.exit("Give the repository as https://... and the address at which its users can write.")
    home = repository.rstrip("/")
    added = {"email": email, "repository": home, "tracker": f"{home}/issues", "homepage": home,
             "changelog": changelog(root)}
    return (text.rstrip("\n") + "\n" + "".join(f"{key}={value}\n" for key, value in added.items())).encode("utf-8")


def website(root: Path) -> dict[str, Path]:
    """The documentation as a website by name in the zip, where `make docs` has built it; without what holds times."""
    site = root / "build" / "site"
    return {f"site/{path.relative_to(site).as_posix()}": path for path in sorted(site.rglob("*"))
            if path.is_file() and not path.name.startswith("sitemap")}


def build(root: Path, target: Path, repository: str = "", email: str = "") -> int:
    """Write the zip and return the number of files in it; the same files give the same bytes."""
    check_metadata(root)
    told = metadata(root, repository, email)
    files = [path for path in tracked_files(root) if (root / path).is_file()]
    contents = {path.as_posix(): root / path for path in files} | website(root)
    target.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, path in contents.items():
            entry = zipfile.ZipInfo(f"{FOLDER}/{name}", (2000, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, told if name == "metadata.txt" else path.read_bytes())
    return len(contents)


def main() -> None:
    """Build the zip where the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--output", type=Path, default=ROOT / "build" / f"{FOLDER}.zip")
    parser.add_argument("--repository", default="", help="https address of the source code")
    parser.add_argument("--email", default="", help="address for the plugin's users")
    given = parser.parse_args()
    target = given.output
    count = build(ROOT, target, given.repository, given.email)
    print(f"{target}: {count} files, {target.stat().st_size / 1024:.0f} kB"
          + ("" if given.repository else "; to install from (the plugin repository needs --repository and --email)"))


if __name__ == "__main__":
    main()
