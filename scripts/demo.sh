#!/bin/sh
# The main job on an example: laser points and rough outlines of a made-up block to 3D building models, in demo/.
set -eu
cd "$(dirname "$0")/.."

root=$PWD
folder=$root/demo
python=$root/.venv/bin/python
# QGIS takes the home of its Python from the first python3 on the path, which may be another one.
PATH="/usr/bin:/bin:$PATH"
export PATH LC_ALL=C.UTF-8

# Debian 12's wrapper qgis_process hands the program an option that it does not know.
process=$(command -v qgis_process.bin || command -v qgis_process || true)
if [ -z "$process" ] || [ ! -x "$python" ]; then
    echo "demo: QGIS or .venv is missing; run: make setup"
    exit 1
fi

# A QGIS profile of its own, which sees this checkout as a plugin and leaves the user's alone.
profile=$(mktemp -d)
trap 'rm -rf "$profile"' EXIT
trap 'exit 130' INT TERM
mkdir -m 700 "$profile/runtime"
mkdir "$profile/plugins"
ln -s "$root" "$profile/plugins/urbanmap_qgis"
packages=$("$python" -c 'import sysconfig; print(sysconfig.get_paths()["purelib"])')
qgis() {
    HOME="$profile" QGIS_CUSTOM_CONFIG_PATH="$profile/config" QGIS_PLUGINPATH="$profile/plugins" \
        XDG_RUNTIME_DIR="$profile/runtime" QT_QPA_PLATFORM=offscreen PYTHONPATH="$packages" "$@"
}
# Run a command; show what it said only if it fails.
quietly() {
    "$@" >"$profile/said" 2>&1 || { cat "$profile/said"; echo "demo: failed: $*"; exit 1; }
}

rm -rf "$folder"
mkdir "$folder"
"$python" scripts/demo_data.py demo/input
quietly qgis "$process" plugins enable urbanmap_qgis
echo "demo: qgis_process run urbanmap:buildingsfromals (laser points and rough outlines to models)"
start=$(date +%s)
quietly qgis "$process" run urbanmap:buildingsfromals -- \
    POINTS="$folder/input/points.laz" FOOTPRINTS="$folder/input/建物外周線.gpkg" \
    OUTPUT="$folder/building_models.gpkg" OUTPUT_SURFACES="$folder/building_surfaces.gpkg" \
    OUTPUT_CITYJSON="$folder/buildings.city.json" OUTPUT_REPORT="$folder/report.html"
seconds=$(($(date +%s) - start))
"$python" scripts/demo_check.py demo/input demo/building_models.gpkg demo/building_surfaces.gpkg "$seconds"
quietly qgis "$python" scripts/demo_project.py demo
if "$python" scripts/render_models.py demo/building_surfaces.gpkg demo/models.png --size 1400x800 --pitch 52 \
    >"$profile/said" 2>&1; then picture="  models.png               picture of the models
"; else
    picture=""
    echo "demo: no picture ($(tail -n 1 "$profile/said"))"
fi
cat <<END

Look at the result in demo/:
$picture  buildings.qgz            QGIS project with a 3D view
  building_models.gpkg     one feature a building, with its figures of quality
  building_surfaces.gpkg   one feature a surface: roof, outer wall, inner wall, ground
  buildings.city.json      CityJSON 2.0
  report.html              report
END
