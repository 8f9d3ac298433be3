# shellcheck shell=bash
# The wheel and the Debian package of the package for Python: unpacked, they work from an empty home directory, without
# the build tree. (tests/debian/test_python.sh installs the Debian package on a clean system.)
set -eu
[ -x /usr/bin/python3 ] || { echo "skipped: there is no /usr/bin/python3"; exit 77; }
[ -d "$SUNDER_BUILD/python/sunder" ] || { echo "skipped: the Python package was not built"; exit 77; }
if grep -q '^SUNDER_SANITIZE:STRING=.' "$SUNDER_BUILD/CMakeCache.txt"; then
    echo "skipped: the build carries a sanitizer"
    exit 77
fi
work=$SUNDER_BUILD/python-test
rm -rf "$work"
mkdir -p "$work/home" "$work/wheel"

try() { # what, folder of the package: the same as in the build tree
    local got
    got=$(cd "$work/home" && env -i HOME="$work/home" PYTHONPATH="$2" PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c "
import sunder
assert sunder.__file__.startswith('$2'), sunder.__file__
print(sunder.__version__, sunder.separate([[(0, 0), (4, 0), (4, 4), (0, 4)], [(3, 0), (7, 0), (7, 4), (3, 4)]], gap=1).cost)")
    [ "$got" = "$version 2.0" ] || { echo "$1: '$got'"; exit 1; }
    [ -z "$(ls -A "$work/home")" ] || { echo "$1: something was written to the home directory"; exit 1; }
    echo "$1: ok"
}

version=$(sed -n 's/^#define SUNDER_VERSION "\(.*\)"/\1/p' "$SUNDER_SOURCE/src/sunder.h")
cmake --build "$SUNDER_BUILD" --target python-wheel >"$work/wheel.log"
wheel=$(echo "$SUNDER_BUILD"/sunder-"$version"-cp311-abi3-linux_*.whl)
/usr/bin/python3 -m zipfile -e "$wheel" "$work/wheel"
try "wheel" "$work/wheel"
# pip takes it, and finds what it lists.
if /usr/bin/python3 -m pip --version >/dev/null 2>&1; then
    HOME=$work/pip-home /usr/bin/python3 -m pip -q --no-cache-dir --disable-pip-version-check install --no-index --no-deps \
        --no-compile --target "$work/pip" "$wheel" 2>"$work/pip.log" || { cat "$work/pip.log"; exit 1; }
    try "pip" "$work/pip"
else
    echo "pip is not installed: left out"
fi
if command -v cpack >/dev/null && command -v dpkg-deb >/dev/null && command -v dpkg-shlibdeps >/dev/null; then
    (cd "$work" && cpack --config "$SUNDER_BUILD/CPackConfig.cmake" -D CPACK_COMPONENTS_ALL=python -B "$work" >cpack.log)
    dpkg-deb -x "$work"/python3-sunder_*.deb "$work/root"
    try "Debian package" "$work/root/usr/lib/python3/dist-packages"
    dpkg-deb -f "$work"/python3-sunder_*.deb Depends | grep -q libgmp10
    if dpkg-deb -f "$work"/python3-sunder_*.deb Depends | grep -i gdal; then echo "the package needs GDAL"; exit 1; fi
else
    echo "cpack and dpkg-dev are not installed: no Debian package"
fi
