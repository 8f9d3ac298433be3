#!/usr/bin/env bash
# Installs the package for Python: what is missing is installed, python3-sunder is built and installed, with GeoPandas.
# GDAL and the program are not needed.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=$source/build/python
# shellcheck source=../setup.sh
. "$source/gis/setup.sh"

setup_need "a C compiler" "gcc libc6-dev" setup_has_header stdlib.h
setup_need "CMake 3.20" cmake cmake --version
setup_need make make make --version
setup_need "GMP" libgmp-dev setup_has_header gmp.h
setup_need "Python's headers" "python3 python3-dev" setup_has_python_headers
setup_need "tools for packages" "dpkg-dev file" sh -c "command -v dpkg-shlibdeps && file --version"
setup_install

cmake -S "$source" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DSUNDER_PROGRAM=OFF -DSUNDER_TESTS=OFF
cmake --build "$build" -j "$(nproc 2>/dev/null || echo 2)" --target sunder_python sunder_python_package
rm -f "$build"/python3-sunder_*.deb
(cd "$build" && cpack -D CPACK_COMPONENTS_ALL=python)
setup_as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 install --reinstall \
    --no-install-recommends "$build"/python3-sunder_*.deb python3-geopandas
/usr/bin/python3 -c "import sunder; print('sunder', sunder.__version__, 'is installed:', sunder.__file__)"
