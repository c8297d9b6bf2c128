"""Open a tileset in CesiumJS in a headless Chromium, and hand back what it shows.

CesiumJS is taken from the folder that the variable CESIUM names (the npm package, unpacked), or packed by npm into the
temporary folder; nothing of it is part of the project.
"""

from __future__ import annotations

import base64
import json
import os
import queue
import shutil
import subprocess
import sys
import tarfile
import tempfile
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

PAGE = Path(__file__).with_name("cesium_page.html")
WAIT = 150.0  # s


def chromium() -> str | None:
    """The browser's program, None where there is none."""
    return next((found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))),
                None)


def cesium_folder() -> Path | None:
    """The folder Build/Cesium of the package, from CESIUM or by npm; None where neither has it."""
    given = os.environ.get("CESIUM")
    place = Path(given) if given else Path(tempfile.gettempdir()) / f"urbanmap-cesium-{os.getuid()}"
    if not (place / "package" / "Build").is_dir() and not given and shutil.which("npm"):
        place.mkdir(exist_ok=True)
        try:
            packed = subprocess.run(["npm", "pack", "cesium", "--silent"], cwd=place, capture_output=True, text=True,
                                    timeout=120)
        except subprocess.TimeoutExpired:
            return None
        if packed.returncode == 0 and packed.stdout.strip():
            with tarfile.open(place / packed.stdout.split()[-1]) as archive:
                members = [item for item in archive.getmembers() if item.name.startswith("package/Build/Cesium/")
                           and ".." not in item.name]
                archive.extractall(place, members)
    built = place / "package" / "Build" / "Cesium"
    return built if built.is_dir() else None


def shown(tileset: Path, cesium: Path, view: float = 2.0) -> dict:
    """What CesiumJS says of a tileset's folder: failed, features (attributes by file and number), picture (PNG)."""
    results: queue.Queue = queue.Queue()

    class Handler(SimpleHTTPRequestHandler):
        def translate_path(self, path: str) -> str:
            name = path.split("?")[0].lstrip("/")
            for start, folder in (("cesium/", cesium), ("tileset/", tileset)):
                if name.startswith(start):
                    return str(folder / name.removeprefix(start))
            return str(PAGE) if name == "" else str(PAGE.parent / "none")

        def do_POST(self):
            results.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
            self.send_response(204)
            self.end_headers()

        def log_message(self, *_words):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory() as profile:
        browser = subprocess.Popen(
            [chromium(), "--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-gl=angle",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
             "--window-size=1000,700", "--no-first-run", "--disable-dev-shm-usage", f"--user-data-dir={profile}",
             f"http://127.0.0.1:{server.server_port}/?range={view}"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            result = results.get(timeout=WAIT)
        except queue.Empty:
            raise TimeoutError(f"CesiumJS said nothing within {WAIT:g} s") from None
        finally:
            browser.terminate()
            browser.wait(timeout=30)
            server.shutdown()
            server.server_close()
    if "picture" in result:
        result["picture"] = base64.b64decode(result["picture"].partition(",")[2])
    return result


if __name__ == "__main__":  # python tests/gui/cesium.py TILESET_FOLDER PICTURE.png [RANGE]
    seen = shown(Path(sys.argv[1]), cesium_folder(), float(sys.argv[3]) if len(sys.argv) > 3 else 2.0)
    picture = seen.pop("picture", None)
    if picture:
        Path(sys.argv[2]).write_bytes(picture)
    print(json.dumps({**seen, "features": dict(list(seen.get("features", {}).items())[:2]),
                      "count": len(seen.get("features", {}))}, ensure_ascii=False))
