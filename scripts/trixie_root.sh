#!/bin/bash
# A Debian 13 (trixie) system in a folder, to test on a current QGIS from an older machine. With URBANMAP_SUITE=sid
# it is Debian unstable, in a folder of its own: the newest QGIS and Python, by hand before a release.
#
#   scripts/trixie_root.sh build            make the root if it is not there yet; print its folder
#   scripts/trixie_root.sh run COMMAND...   run COMMAND in the root, in a copy of this checkout (with
#                                           ../shared beside it, if there; the copy is thrown away)
#   scripts/trixie_root.sh remove           delete the cached root
#
# Needs Debian or Ubuntu, root rights, and the network while building (2 to 4 minutes, 2 GB).
# The root lies under $XDG_CACHE_HOME (default /var/cache), outside the checkout.
set -euo pipefail

suite=${URBANMAP_SUITE:-trixie}
# QGIS as a user of that release has it, what the tests need to run, and a software renderer with a
# virtual screen for the 3D view. Changing the list makes a new root.
packages=(
    qgis python3-qgis qgis-providers python3-venv python3-pip make git ca-certificates
    xvfb xauth libgl1-mesa-dri
)

checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cache=${XDG_CACHE_HOME:-/var/cache}/urbanmap-$suite
root=$cache/root
stamp=$root/.urbanmap-stamp
wanted="$suite ${packages[*]}"

fail() {
    echo "trixie_root: $*" >&2
    exit 1
}

require_host() {
    [ "$(id -u)" = 0 ] || fail "needs root rights (debootstrap and chroot): run it with sudo."
    unshare --mount true 2>/dev/null ||
        fail "this machine does not allow mounts (start a container privileged)."
    command -v debootstrap >/dev/null && return
    apt-get update -qq >&2
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends debootstrap >&2
}

# True when the root is complete: built from this list, and no later installation broke off half-way.
is_whole() {
    [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$wanted" ] && [ -z "$(chroot "$root" dpkg --audit 2>&1)" ]
}

# Run a command in a root with /proc and /dev. The mounts live in a namespace of their own, so they end with
# the command, however it ends, and no deletion outside can ever reach through them.
# Usage: enter ROOT [SOURCE:TARGET[:ro]]... -- COMMAND...
enter() {
    # shellcheck disable=SC2016
    unshare --mount --propagation private bash -euc '
        root=$1; shift
        mount -t proc proc "$root/proc"
        mount --rbind /dev "$root/dev"
        while [ "$1" != -- ]; do
            IFS=: read -r from to mode <<<"$1"; shift
            [ -d "$from" ] && mkdir -p "$root$to" || : >>"$root$to"
            mount --bind "$from" "$root$to"
            [ -z "$mode" ] || mount -o "remount,bind,$mode" "$root$to"
        done
        shift
        exec chroot "$root" "$@"' enter "$@"
}

# The root reaches the network as the machine does: same resolver, proxy settings and certificates.
copy_network_settings() {
    local file
    cp -L /etc/resolv.conf "$1/etc/resolv.conf"
    for file in /etc/apt/apt.conf /etc/apt/apt.conf.d/*; do
        if [ -f "$file" ] && grep -q '^ *Acquire::' "$file"; then
            cp "$file" "$1/etc/apt/apt.conf.d/80host-$(basename "$file")"
        fi
    done
    if [ -f /etc/pip.conf ]; then cp /etc/pip.conf "$1/etc/pip.conf"; fi
}

write_apt_settings() {
    # The root can be made again at any time, so no sync after every file, no manuals, no services.
    echo force-unsafe-io >"$1/etc/dpkg/dpkg.cfg.d/fast"
    printf 'path-exclude=/usr/share/%s/*\n' doc man locale info >"$1/etc/dpkg/dpkg.cfg.d/slim"
    printf '#!/bin/sh\nexit 101\n' >"$1/usr/sbin/policy-rc.d"
    chmod +x "$1/usr/sbin/policy-rc.d"
}

build() {
    require_host
    mkdir -p "$cache"
    exec 9>"$cache/lock"
    flock 9
    if is_whole; then
        flock -u 9 # runs in a whole root do not wait for each other
        return
    fi
    rm -rf "$cache"/root "$cache"/building.*
    local new
    new=$(mktemp -d "$cache/building.XXXXXX")
    chmod 755 "$new"
    debootstrap --variant=minbase "$suite" "$new" >&2
    copy_network_settings "$new"
    write_apt_settings "$new"
    enter "$new" -- env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 sh -euc '
        apt-get update -qq
        apt-get install -y -qq --no-install-recommends "$@"
        apt-get clean' install "${packages[@]}" >&2
    echo "$wanted" >"$new/.urbanmap-stamp"
    mv "$new" "$root"
    flock -u 9
}

# The files of the checkout as they are now, without what git ignores (the other system's .venv, caches).
copy_checkout() {
    git -c safe.directory='*' -C "$checkout" ls-files -z --cached --others --exclude-standard |
        tar -C "$checkout" --null --files-from=- --ignore-failed-read --create |
        tar -C "$1" --no-same-owner --extract
    if [ -d "$checkout/.git" ]; then cp -r "$checkout/.git" "$1/.git"; fi
}

# Home and temporary folder are new for every run. Downloads (pip's cache) stay in the root for the next one; beside it
# the installed packages of .venv, one folder for each list of them; and beside the checkout the cities that tests read:
# each system makes its own (tests/stored.py).
run() {
    build
    copy_network_settings "$root"
    local work status=0
    work=$(mktemp -d)
    # shellcheck disable=SC2064
    trap "rm -rf --one-file-system '$work'" EXIT
    mkdir "$work/checkout" "$work/home" "$work/tmp"
    chmod 1777 "$work/tmp"
    copy_checkout "$work/checkout"
    local mounts=("$work:/ci" "$work/tmp:/tmp")
    local shared=$checkout/../shared
    mkdir -p "$checkout/build/test_cities"
    mounts+=("$checkout/build/test_cities:/ci/checkout/build/test_cities")
    local venv
    venv=$cache/venv-$(cat "$checkout"/requirements*.txt "$stamp" | cksum | cut -d' ' -f1)
    mkdir -p "$venv"
    mounts+=("$venv:/ci/checkout/.venv")
    if [ -d "$shared" ]; then mounts+=("$(cd "$shared" && pwd):/ci/shared:ro"); fi
    local bundle=/etc/ssl/certs/ca-certificates.crt
    if [ -f "$bundle" ]; then mounts+=("$bundle:$bundle:ro"); fi
    local settings=(
        -u XDG_RUNTIME_DIR -u XDG_CACHE_HOME -u PYTHONPATH -u VIRTUAL_ENV
        HOME=/ci/home TMPDIR=/tmp PIP_CACHE_DIR=/root/.cache/pip
        LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin
    )
    # shellcheck disable=SC2016
    enter "$root" "${mounts[@]}" -- env "${settings[@]}" \
        sh -c 'cd /ci/checkout && exec "$@"' sh "$@" || status=$?
    return "$status"
}

case ${1:-} in
    build) build && echo "$root" ;;
    run) shift && [ $# -gt 0 ] || fail "run what?"
         run "$@" ;;
    remove) rm -rf --one-file-system "$cache" ;;
    *) sed -n '2,11s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
esac
