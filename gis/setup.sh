# shellcheck shell=bash
# Sourced by gis/demo.sh and tests/run.sh: what a build needs is looked for, and what is missing is installed where
# apt-get is, else named. Nothing is installed when all is present.
#
#   setup_need WHAT PACKAGES PROBE...     without it there is nothing to do
#   setup_want WHAT PACKAGES PROBE...     without it some tests are skipped
#   setup_install                         installs what the probes did not find
#   setup_build SOURCE BUILD TARGET...    configures (Release) and builds

setup_needed=() setup_wanted=()                   # in words
setup_needed_packages=() setup_wanted_packages=() # an empty array is spelt ${a[@]+...}: old bashes call it unset

setup_need() { # the probe is a command that succeeds where the thing is there
    local what=$1 packages=$2
    shift 2
    "$@" >/dev/null 2>&1 && return
    setup_needed+=("$what ($packages)")
    # shellcheck disable=SC2206 # words
    setup_needed_packages+=($packages)
}

setup_want() {
    local what=$1 packages=$2
    shift 2
    "$@" >/dev/null 2>&1 && return
    setup_wanted+=("$what ($packages)")
    # shellcheck disable=SC2206
    setup_wanted_packages+=($packages)
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

setup_has_python_headers() {
    test -e "$(/usr/bin/python3 -c "import sysconfig; print(sysconfig.get_path('include'))")/Python.h"
}

setup_has_fuzzer() { # the compiler alone does not do: Debian has the runtime of the sanitizers in a package of its own
    local program status=0
    program=$(mktemp)
    echo 'int LLVMFuzzerTestOneInput(const unsigned char *d, unsigned long n) { (void)d; return !n; }' |
        clang -x c -fsanitize=fuzzer,address,undefined - -o "$program" || status=$?
    rm -f "$program"
    return $status
}

setup_toolchain() {
    setup_need "a C compiler" "gcc libc6-dev" setup_has_header stdlib.h
    setup_need "CMake 3.20" cmake cmake --version
    setup_need make make make --version
    setup_need "GMP" libgmp-dev setup_has_header gmp.h
    setup_need "GDAL" libgdal-dev setup_has_gdal
    setup_need "GDAL's tools" gdal-bin ogr2ogr --version
}

setup_as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    else
        sudo "$@"
    fi
}

setup_apt() { # packages...
    local apt=(setup_as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300)
    for _ in 1 2 3; do # another apt-get may hold the lock of the archives, for which there is no timeout
        "${apt[@]}" install --no-install-recommends "$@" && return
        apt-get -q -s install --no-install-recommends "$@" >/dev/null 2>&1 || return # there is no such package
        sleep 20
    done
    return 1
}

# Some systems lack one or the other of these, or have it in another package: that must not keep the rest away.
setup_apt_each() {
    local package
    setup_apt "$@" && return
    for package in "$@"; do
        setup_apt "$package" || echo "$package could not be installed: some tests will be skipped."
    done
}

setup_refuse() {
    echo "$1" >&2
    exit 1
}

setup_install() {
    local needed=(${setup_needed[@]+"${setup_needed[@]}"}) wanted=(${setup_wanted[@]+"${setup_wanted[@]}"}) each
    if [ $((${#needed[@]} + ${#wanted[@]})) -eq 0 ]; then
        return
    fi
    for each in ${needed[@]+"${needed[@]}"} ${wanted[@]+"${wanted[@]}"}; do
        echo "missing: $each"
    done
    local packages=(${setup_needed_packages[@]+"${setup_needed_packages[@]}"}
                    ${setup_wanted_packages[@]+"${setup_wanted_packages[@]}"})
    local way=""
    command -v apt-get >/dev/null ||
        way="There is no apt-get here. Install what is missing (in brackets: Debian's package), then run this again."
    if [ -z "$way" ] && [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
        way="Neither root nor sudo: run  apt-get install ${packages[*]}  as root, then run this again."
    fi
    if [ -n "$way" ]; then
        [ "${#needed[@]}" -eq 0 ] || setup_refuse "$way"
        echo "Some tests will be skipped."
        return
    fi
    echo "installing: ${packages[*]}"
    setup_as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 update ||
        echo "the package lists could not be renewed; trying with those at hand" >&2
    if [ "${#needed[@]}" -gt 0 ]; then
        setup_apt "${setup_needed_packages[@]}" || setup_refuse "the packages could not be installed"
    fi
    if [ "${#wanted[@]}" -gt 0 ]; then
        setup_apt_each "${setup_wanted_packages[@]}"
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
    cmake --build "$build" -j "$(nproc 2>/dev/null || echo 2)" ${targets[@]+"${targets[@]}"}
}
