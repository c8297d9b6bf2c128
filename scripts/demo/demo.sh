#!/bin/sh
# A sample city with known truth, every stage on it, and how well each did; all in demo/. See scripts/demo/run.py.
set -eu
cd "$(dirname "$0")/../.."

root=$PWD
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

rm -rf "$root/demo"
HOME="$profile" QGIS_CUSTOM_CONFIG_PATH="$profile/config" QGIS_PLUGINPATH="$profile/plugins" \
    XDG_RUNTIME_DIR="$profile/runtime" QT_QPA_PLATFORM=offscreen PYTHONPATH="$packages" \
    "$python" scripts/demo/run.py "$process" "$root/demo" "$@"
