# shellcheck shell=bash
# Sourced by gis/demo.sh and tests/run.sh: what a build needs is looked for, and what is missing is installed where
# apt-get is, else named. Nothing is installed when all is present.
#
#   setup_need WHAT PACKAGES PROBE...     without it there is nothing to do
#   setup_want WHAT PACKAGES PROBE...     without it some tests are skipped
#   setup_install                         installs what the probes did not find
#   setup_build SOURCE BUILD TARGET...    configures (Release) and builds

setup_needed=() setup_wanted=() setup_packages=()

setup_need() { # the probe is a command that succeeds where the thing is there
    local what=$1 packages=$2
    shift 2
    "$@" >/dev/null 2>&1 && return
    setup_needed+=("$what ($packages)")
    # shellcheck disable=SC2206 # words
    setup_packages+=($packages)
}

setup_want() {
    local what=$1 packages=$2
    shift 2
    "$@" >/dev/null 2>&1 && return
    setup_wanted+=("$what ($packages)")
    # shellcheck disable=SC2206
    setup_packages+=($packages)
}

setup_has_header() { # header, compiler flags...
    local header=$1
    shift
    echo "#include <$header>" | "${CC:-cc}" "$@" -x c -E - -o /dev/null
}

setup_has_gdal() {
    # shellcheck disable=SC2046 # the flags are words
    command -v gdal-config && setup_has_header gdal.h $(gdal-config --cflags)
}

setup_toolchain() {
    setup_need "a C compiler" "gcc libc6-dev" setup_has_header stdlib.h
    setup_need "CMake 3.20" cmake cmake --version
    setup_need make make make --version
    setup_need "GMP" libgmp-dev setup_has_header gmp.h
    setup_need "GDAL" libgdal-dev setup_has_gdal
    setup_need "GDAL's tools" gdal-bin ogr2ogr --version
}

setup_apt() {
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "neither root nor sudo: run  apt-get install ${setup_packages[*]}  as root" >&2
            return 1
        fi
        as_root=(sudo)
    fi
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300)
    "${apt[@]}" update || echo "the package lists could not be renewed; trying with those at hand" >&2
    for _ in 1 2 3; do # another apt-get may hold the lock of the archives, for which there is no timeout
        "${apt[@]}" install --no-install-recommends "$@" && return
        sleep 20
    done
    return 1
}

setup_install() {
    if [ "${#setup_packages[@]}" -eq 0 ]; then
        return
    fi
    printf 'missing: %s\n' "${setup_needed[@]}" "${setup_wanted[@]}" | grep -v '^missing: $' || true
    if ! command -v apt-get >/dev/null; then
        if [ "${#setup_needed[@]}" -gt 0 ]; then
            echo "There is no apt-get here. Install what is missing (in brackets: Debian's package), then run this again." >&2
            exit 1
        fi
        echo "Some tests will be skipped."
        return
    fi
    echo "installing: ${setup_packages[*]}"
    if ! setup_apt "${setup_packages[@]}"; then
        if [ "${#setup_needed[@]}" -gt 0 ]; then
            echo "the packages could not be installed" >&2
            exit 1
        fi
        echo "The packages could not be installed: some tests will be skipped."
    fi
}

setup_build() { # source, build, targets...
    local source=$1 build=$2 targets=() target
    shift 2
    # A clone that was moved or copied has a cache that points elsewhere: begin anew.
    if [ -f "$build/CMakeCache.txt" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$source" "$build/CMakeCache.txt"; then
        rm -rf "$build"
    fi
    for target in "$@"; do
        targets+=(--target "$target")
    done
    cmake -S "$source" -B "$build" -DCMAKE_BUILD_TYPE=Release -DSUNDER_WERROR="${SUNDER_WERROR:-OFF}"
    cmake --build "$build" -j "$(nproc 2>/dev/null || echo 2)" "${targets[@]}"
}
