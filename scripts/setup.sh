#!/bin/sh
# Set up everything that the demo and the tests need: QGIS from the system's packages, Python packages in .venv.
# Safe to run again: what is there already is left alone.
set -eu
cd "$(dirname "$0")/.."

python=/usr/bin/python3
# QGIS takes the home of its Python from the first python3 on the path, which may be another one.
PATH="/usr/bin:/bin:$PATH"
export PATH

say() { printf 'setup: %s\n' "$*"; }

has_qgis() {
    { command -v qgis_process.bin || command -v qgis_process; } >/dev/null 2>&1 &&
        QT_QPA_PLATFORM=offscreen "$python" -c 'import qgis.core' >/dev/null 2>&1
}
has_venv() { "$python" -c 'import ensurepip, venv' >/dev/null 2>&1; }
has_xvfb() { command -v xvfb-run >/dev/null 2>&1; }

packages=""
has_qgis || packages="$packages qgis python3-qgis qgis-providers"
has_venv || packages="$packages python3-venv"
has_xvfb || packages="$packages xvfb xauth"

if [ -n "$packages" ]; then
    if ! command -v apt-get >/dev/null 2>&1; then
        say "please install with this system's package manager, then run make setup again: QGIS 3.22 or newer with"
        say "its Python modules for $python, Python's venv module, and Xvfb (missing here:$packages)."
        exit 1
    fi
    root=""
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null 2>&1; then
            say "please install as root, then run make setup again: apt-get install$packages"
            exit 1
        fi
        root="sudo"
    fi
    say "installing$packages"
    $root apt-get update
    # shellcheck disable=SC2086  # a list of package names
    $root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $packages
fi

numpy=$("$python" -c 'import numpy; print(numpy.__version__)')
wanted=$({ cat requirements.txt requirements-dev.txt; echo "$numpy"; "$python" --version; } | cksum | tr ' ' '-')
stamp=".venv/setup-$wanted"
mkdir -p .venv
if command -v flock >/dev/null 2>&1; then # runs that share the folder wait for the one that installs
    exec 9>.venv/lock
    flock 9
fi
if [ -e "$stamp" ]; then
    exit 0
fi

if [ ! -x .venv/bin/python ]; then
    say "making .venv, which also sees QGIS's own Python packages"
    "$python" -m venv --system-site-packages .venv
fi

# QGIS's own modules are built for its numpy: every other package is chosen to fit that one.
say "installing Python packages for numpy $numpy"
echo "numpy==$numpy" > .venv/constraints.txt
.venv/bin/python -m pip install --quiet --disable-pip-version-check \
    --constraint .venv/constraints.txt --requirement requirements-dev.txt
# Debian's own pyproj looks for its data beside the running Python, and finds none beside the one in .venv.
if ! .venv/bin/python -W error -c 'import pyproj; pyproj.datadir.get_data_dir()' 2>/dev/null; then
    .venv/bin/python -m pip install --quiet --disable-pip-version-check --ignore-installed --no-deps 'pyproj>=3.2'
fi
rm -f .venv/setup-*
touch "$stamp"
say "done"
