"""Build the zip that QGIS installs, from the files that git tracks.

For the plugin repository, which asks where a plugin is at home, give that here, the only place where it is set:

    python scripts/package.py --repository https://... --email ADDRESS

repository, tracker and homepage in the zip's metadata follow from it, and the changelog from CHANGELOG.md.
"""

from __future__ import annotations

import argparse
import configparser
import io
import re
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[1]
FOLDER = "urbanmap_qgis"
READMES = ("README.md", "README.ja.md")
FILES = ("metadata.txt", "__init__.py", "LICENSE", *READMES, "CHANGELOG.md")
FOLDERS = ("algorithms", "urbanmap_qgis", "resources")
PICTURES = (".jpg", ".png")
NOT_FOUND = "404.html"  # a page for servers
# Least quality of WebP at which the text of windows is read, and largest width, pixels; of pictures without text, which
# need not be wider than the help's column.
WINDOWS, PHOTOGRAPHS = (16, 880), (18, 720)
ICON_STYLES_FILES = ("brands.min.css", "fontawesome.min.css", "solid.min.css", "v4-font-face.min.css")
ICON_STYLES = re.compile(r'<link href="[^"]*css/(?:brands|fontawesome|solid|v4-font-face)\.min\.css" rel="stylesheet">')
FOR_PROGRAMMERS = ("architecture", "developer", "testing", "mobile_figures", "roadmap_figures")
# pages about the code, and those of figures alone
TO_PROGRAMMERS = (r'<a [^>]*href="(?:\.\./)*(?:api/[^"]*|(?:' + "|".join(FOR_PROGRAMMERS)
                  + r')\.html[^"]*)"[^>]*>(.*?)</a>')
LINK = re.compile(TO_PROGRAMMERS, re.DOTALL)
MENU = re.compile(r'<li class="nav-item dropdown">\s*<a href="#"[^>]*>[^<]*</a>\s*<ul class="dropdown-menu">'
                  rf'(?:\s*<li>\s*{TO_PROGRAMMERS}\s*</li>)+\s*</ul>\s*</li>')
# Menus that open: pages of algorithms, of which there are many, lead to them by the start page.
MENUS = re.compile(r'<li class="nav-item dropdown">.*?</ul>\s*</li>\s*', re.DOTALL)
REQUIRED = ("name", "qgisMinimumVersion", "description", "about", "version", "author")
PUBLISHED = ("email", "repository", "tracker", "homepage", "changelog")


def tracked_files(root: Path) -> list[Path]:
    """Files of the plugin among those that git tracks, relative to `root`."""
    done = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, check=True)
    paths = [Path(name) for name in done.stdout.decode("utf-8").split("\0") if name]
    # Sources of translations are compiled beside them.
    return sorted(path for path in paths if (str(path) in FILES or path.parts[0] in FOLDERS) and path.suffix != ".ts")


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
    sections = re.split(r"^## .*$", text, flags=re.MULTILINE)[1:]
    latest = next(section for section in sections if section.strip())  # what is not released may be nothing yet
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


def website(site: Path) -> dict[str, bytes]:
    """The documentation as a website by name in the zip, where `make docs` has built it: the help that is in it.

    Left out are what holds times, what is for programmers (source maps, the reference of the core and the pages about
    the code), fonts and styles of symbols that `site.css` hides, and pictures that no page shows.
    """
    pages = "".join(path.read_text(encoding="utf-8") for path in site.rglob("*.html")
                    if path.stem not in FOR_PROGRAMMERS)
    paths = [path for path in sorted(site.rglob("*")) if path.is_file() and not path.name.startswith("sitemap")
             and path.suffix not in (".map", ".inv") and path.parent.name != "webfonts"
             and "api" not in path.relative_to(site).parts
             and path.name not in (*ICON_STYLES_FILES, NOT_FOUND)
             and not (path.suffix == ".html" and path.stem in FOR_PROGRAMMERS)
             and (path.suffix not in (*PICTURES, ".svg") or path.name in pages)]
    packed = {f"site/{packed_name(path.relative_to(site).as_posix())}": smaller(path) for path in paths}
    words = set(re.findall(r"[\w-]+", "".join(data.decode("utf-8") for name, data in packed.items()
                                             if name.endswith((".html", ".js")))))
    return {name: used_styles(data.decode("utf-8"), words).encode("utf-8") if name.endswith(".css") else data
            for name, data in packed.items()}


def used_styles(styles: str, words: set[str]) -> str:
    """The rules of a style sheet that can apply where only `words` are names of classes (in pages and scripts)."""
    used = []
    for head, body in top_rules(styles):
        if head.lstrip().startswith(("@media", "@supports")):
            body = used_styles(body, words)
        elif not head.lstrip().startswith("@"):
            head = ",".join(selector for selector in head.split(",") if classes(selector) <= words)
        if head and body:
            used.append(f"{head}{{{body}}}")
    return "".join(used)


def classes(selector: str) -> set[str]:
    """The names of classes that an element must have, or lie in, for a selector of a style sheet."""
    return set(re.findall(r"\.([a-zA-Z_][\w-]*)", re.sub(r":not\([^)]*\)|\[[^\]]*\]", "", selector)))


def top_rules(styles: str) -> Iterator[tuple[str, str]]:
    """Head and body of each rule of a style sheet that lies in no other, without comments."""
    styles = re.sub(r"/\*.*?\*/", "", styles, flags=re.DOTALL)
    depth = start = 0
    for brace in re.finditer("[{}]", styles):
        depth += 1 if brace.group() == "{" else -1
        if depth == 0:
            head, _, body = styles[start:brace.start()].partition("{")
            yield head, body
            start = brace.end()


def packed_name(name: str) -> str:
    """The name of a file of the website in the zip: pictures are WebP there, a quarter smaller than JPEG."""
    return re.sub(r"\.jpg$", ".webp", name)


def smaller(path: Path) -> bytes:
    """A file as it goes into the zip: pictures with the least quality and width that they need, pages without links to
    what is left out, those of algorithms without menus that open."""
    data = path.read_bytes()
    if path.suffix == ".html":
        page = LINK.sub(r"\1", MENU.sub("", ICON_STYLES.sub("", data.decode("utf-8"))))
        if path.parent.name == "algorithms":
            page = MENUS.sub("", page)
        page = without_indents(page)
        return re.sub(r'((?:src|href)="[^":]+)\.jpg"', r'\1.webp"', page).encode("utf-8")
    if path.suffix != ".jpg":
        return data
    import cv2
    import numpy as np
    from PIL import Image

    picture = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    quality, widest = WINDOWS if path.parent.name == "tutorials" else PHOTOGRAPHS
    if picture.shape[1] > widest:
        height = round(picture.shape[0] * widest / picture.shape[1])
        picture = cv2.resize(picture, (widest, height), interpolation=cv2.INTER_AREA)
    packed = io.BytesIO()
    # The slowest way of WebP is a twentieth smaller at the same quality; OpenCV does not offer it.
    Image.fromarray(picture[:, :, ::-1]).save(packed, "WEBP", quality=quality, method=6)
    return packed.getvalue()


def without_indents(page: str) -> str:
    """A page without the blanks at the begin of its lines, but for blocks of code; packed a twenty-fifth smaller."""
    return "".join(part if part.startswith("<pre") else re.sub(r"\n\s+", "\n", part)
                   for part in re.split(r"(<pre.*?</pre>)", page, flags=re.DOTALL))


def readme(text: str, names: set[str]) -> bytes:
    """A README whose links lead to what the zip holds (`names`); a link that would lead nowhere is plain text."""

    def link(found: re.Match) -> str:
        mark, words, target = found.groups()
        place, anchor = re.match(r"([^#]*)(#.*)?$", target).groups()
        if "://" in target or place in names or not place:
            return found.group()
        path = PurePosixPath(place)
        if path.parts[0] == "docs":
            there = PurePosixPath("site", *path.parts[1:])
            there = PurePosixPath(packed_name(str(there.with_suffix(".html") if there.suffix == ".md" else there)))
            if str(there) in names:
                return f"{mark}[{words}]({there}{anchor or ''})"
        return "" if mark else words

    return re.sub(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)", link, text).encode("utf-8")


def build(root: Path, target: Path, repository: str = "", email: str = "", site: Path | None = None) -> int:
    """Write the zip and return the number of files in it; the same files give the same bytes."""
    check_metadata(root)
    told = metadata(root, repository, email)
    files = [path for path in tracked_files(root) if (root / path).is_file()]
    contents = {path.as_posix(): (root / path).read_bytes() for path in files}
    contents |= website(site or root / "build" / "site")
    contents["metadata.txt"] = told
    contents |= {name: readme(contents[name].decode("utf-8"), set(contents)) for name in READMES}
    target.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in contents.items():
            entry = zipfile.ZipInfo(f"{FOLDER}/{name}", (2000, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data, compresslevel=9)
    return len(contents)


def main() -> None:
    """Build the zip where the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--output", type=Path, default=ROOT / "build" / f"{FOLDER}.zip")
    parser.add_argument("--repository", default="", help="https address of the source code")
    parser.add_argument("--email", default="", help="address for the plugin's users")
    parser.add_argument("--site", type=Path, help="the documentation as built by mkdocs, by default build/site")
    given = parser.parse_args()
    target = given.output
    count = build(ROOT, target, given.repository, given.email, given.site)
    print(f"{target}: {count} files, {target.stat().st_size / 1024:.0f} kB"
          + ("" if given.repository else "; to install from (the plugin repository needs --repository and --email)"))


if __name__ == "__main__":
    main()
