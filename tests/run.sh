#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test.
#
#   bash tests/run.sh               all of them
#   bash tests/run.sh -L unit       further words go to ctest: -L LABEL, -R NAME, --output-on-failure is there already
#
# SUNDER_SEED replays the random tests, SUNDER_TEST_SCALE=N makes N times as many; see tests/README.md.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build=$source/build/release
# shellcheck source=../gis/setup.sh
. "$source/gis/setup.sh"

setup_toolchain
setup_need cmocka libcmocka-dev setup_has_header cmocka.h -include stdarg.h -include setjmp.h -include stddef.h -include stdint.h
setup_want "GEOS" libgeos-dev setup_has_header geos_c.h
setup_want "pkg-config" pkg-config pkg-config --version
setup_want "clang with sanitizers, for the fuzz tests" "clang libclang-rt-dev" setup_has_fuzzer
setup_want "the shell of SQLite" sqlite3 sqlite3 -version
setup_want "valgrind" valgrind valgrind --version
setup_want "jq" jq jq --version
setup_want "GDAL's Python module" python3-gdal /usr/bin/python3 -c "import osgeo.ogr"
setup_want "QGIS's Python module" "qgis python3-qgis" /usr/bin/python3 -c "import qgis.core"
setup_want "Chromium" chromium chromium --version
setup_install

setup_build "$source" "$build"
cd "$build"
ctest --output-on-failure -j "$(nproc 2>/dev/null || echo 2)" "$@"
