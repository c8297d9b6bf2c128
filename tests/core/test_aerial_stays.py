"""What the aerial part makes of the sample city stays as it is (see tests/figures.py)."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.figures import stays
from tests.stored import stored
from urbanmap_qgis.aerial.frames.camera import read_camera
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.aerial.frames.frame_images import find_frames
from urbanmap_qgis.aerial.frames.occlusion import PAPER_OCCLUSION, occlusion_map
from urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto
from urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
from urbanmap_qgis.aerial.markings.marking_report import OrthophotoQuality, frame_count_shares, write_marking_report
from urbanmap_qgis.aerial.markings.orthophoto_reader import SearchArea
from urbanmap_qgis.aerial.markings.road_markings import MarkingSettings
from urbanmap_qgis.aerial.orthophotos.mosaic import MosaicFiles, PixelSelection
from urbanmap_qgis.aerial.orthophotos.orthorectification import ElevationInputs, OrthoSettings, orthorectify
from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity import write
from urbanmap_qgis.samplecity.truth import geotiff
from urbanmap_qgis.settings.aerial import OcclusionSettings
from urbanmap_qgis.settings.terrain import ClothSettings, SurfaceSettings
from urbanmap_qgis.terrain.surface_files import surfaces_from_files

ROUNDED = 2e-3  # grey values are rounded to whole numbers


@pytest.fixture(scope="module")
def city():
    """Aerial frames, not JPEG as elsewhere (GDAL's releases round it differently), and laser points of a city."""
    write_tiff = geotiff._write

    def make(folder):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(geotiff, "_write", lambda path, bands, place, _: write_tiff(path, bands, place,
                                                                                      {"compress": "deflate"}))
            for sensor in ("aerial", "als"):
                write._run(sensor, folder, (60.0, "canyon", 1), SILENT)

    return stored("frames", [Path(__file__), *Path(write.__file__).parent.rglob("*.py")], make)


@pytest.fixture(scope="module")
def flight(city):
    """Camera and frames."""
    folder = city / "aerial"
    poses = read_exterior(folder / "exterior.csv")
    return read_camera(folder / "camera.json"), find_frames(sorted(folder.glob("frame_*.tif")), poses)


@pytest.fixture(scope="module")
def heights(city, tmp_path_factory):
    """Surface and ground."""
    folder = tmp_path_factory.mktemp("heights")
    surfaces_from_files([city / "als" / "als.laz"], folder / "dsm.tif", folder / "ground.tif")
    return folder / "dsm.tif", folder / "ground.tif"


@pytest.fixture(scope="module")
def mosaic(flight, heights, tmp_path_factory):
    """Orthophoto, count of frames, what was made, and the shifts between frames."""
    folder = tmp_path_factory.mktemp("mosaic")
    files, shifts = MosaicFiles(folder / "ortho.tif", folder / "count.tif"), []
    made = orthorectify(flight[1], flight[0], ElevationInputs(heights[1], heights[0]), files, shifts=shifts)
    return folder, made, shifts


@pytest.mark.parametrize("source", ["automatic", "classes"])
def test_surface_and_ground_stay(city, tmp_path, source):
    file = city / "als" / ("als_classified.laz" if source == "classes" else "als.laz")
    settings = SurfaceSettings(1.0, source, cloth=ClothSettings(), ground_in_gaps=source == "classes")
    made = surfaces_from_files([file], tmp_path / "dsm.tif", tmp_path / "ground.tif", tmp_path / "mesh.ply", settings)
    (tmp_path / "mesh.ply").unlink()
    stays(f"surface_{source}", {"made": made, "files": tmp_path})


@pytest.mark.parametrize("settings", [OcclusionSettings(), PAPER_OCCLUSION], ids=["default", "paper"])
def test_occlusion_stays(flight, heights, tmp_path, settings, request):
    camera, frames = flight
    made = occlusion_map(camera, frames[0].pose, *heights, tmp_path / "hidden.tif", settings)
    stays(f"occlusion_{request.node.callspec.id}", {"made": made, "files": tmp_path})


FEW = 0.02
"""A rounded grey value moves a patch by less than a millimetre, and with few patches their median by a part of it."""


def test_orthophoto_stays(mosaic):
    folder, made, shifts = mosaic
    stays("orthophoto", {"made": made, "files": folder}, ROUNDED)
    stays("orthophoto_shifts", {"shifts": shifts}, FEW)


def test_orthophoto_of_the_paper_stays(flight, heights, tmp_path):
    settings = OrthoSettings(0.25, PixelSelection.of("paper", False), 5.0, PAPER_OCCLUSION)
    made = orthorectify(flight[1], flight[0], ElevationInputs(heights[1], heights[0]),
                        MosaicFiles(tmp_path / "ortho.tif", tmp_path / "count.tif"), settings)
    stays("orthophoto_paper", {"made": made, "files": tmp_path}, ROUNDED)


@pytest.mark.parametrize("clean", [CleanSettings(), None], ids=["clean", "paper"])
def test_markings_stay(mosaic, tmp_path, clean, request):
    settings = MarkingSettings(2.5, 17.0, clean is None, clean)
    found = markings_from_orthophoto(mosaic[0] / "ortho.tif", tmp_path / "mask.tif", SearchArea(None, None, None),
                                     settings)
    quality = OrthophotoQuality(None, frame_count_shares(mosaic[0] / "count.tif"), False, 17.0)
    write_marking_report(tmp_path / "report.html", mosaic[0] / "ortho.tif", found, quality)
    report = (tmp_path / "report.html").read_text(encoding="utf-8").partition("base64")[0]
    (tmp_path / "report.html").unlink()
    stays(f"markings_{request.node.callspec.id}", {"found": found, "report": report, "files": tmp_path}, ROUNDED)
