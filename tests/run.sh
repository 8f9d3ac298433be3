#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests.
#
#   bash tests/run.sh               those that need no server, no scheduler, no browser, no second build, and less than half a minute
#   bash tests/run.sh --all         these, too: the labels browser, cluster, fuzz, invariants, package, qgis, server and thorough
#   bash tests/run.sh -L unit       further arguments go to ctest: -L LABEL, -R NAME; --output-on-failure is already given
#   bash tests/run.sh --all -L qgis one of those labels, with what it needs installed
#
# SUNDER_SEED replays the random tests, SUNDER_TEST_SCALE=N makes N times as many; see tests/README.md.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build=$source/build/release
all=
if [ "${1:-}" = --all ]; then
    all=yes
    shift
fi
# A test that is selected by a label or by its name runs, whatever its labels.
[ "$all" ] || [ $# -gt 0 ] || set -- -LE '^(browser|cluster|fuzz|invariants|package|qgis|server|thorough)$'
# The system's own tools come before those of version managers, whose python3 takes a third of a second to start.
export PATH=/usr/bin:$PATH
# shellcheck source=../gis/setup.sh
. "$source/gis/setup.sh"

setup_toolchain
setup_need cmocka libcmocka-dev setup_has_header cmocka.h -include stdarg.h -include setjmp.h -include stddef.h -include stdint.h
setup_want "GEOS" libgeos-dev setup_has_header geos_c.h
setup_want "pkg-config" pkg-config pkg-config --version
setup_want "the shell of SQLite" sqlite3 sqlite3 -version
setup_want "valgrind" valgrind valgrind --version
setup_want "jq" jq jq --version
setup_want "Python's headers" python3-dev setup_has_python_headers
setup_want "NumPy" python3-numpy /usr/bin/python3 -c "import numpy"
setup_want "Shapely" python3-shapely /usr/bin/python3 -c "import shapely"
setup_want "GeoPandas" python3-geopandas /usr/bin/python3 -c "import geopandas"
setup_want "GDAL's Python module" python3-gdal /usr/bin/python3 -c "import osgeo.ogr"
if [ "$all" ]; then
    setup_want "clang with sanitizers, for the fuzz tests" "clang libclang-rt-dev" setup_has_fuzzer
    setup_want "a compiler for s390x and its emulator" "gcc-s390x-linux-gnu libc6-dev-s390x-cross qemu-user" qemu-s390x --version
    setup_want "Python's debug build" python3-dbg test -x /usr/bin/python3-dbg
    setup_want "pandoc" pandoc pandoc --version
    setup_want "Doxygen" doxygen doxygen --version
    setup_want "QGIS's Python module" "qgis python3-qgis" /usr/bin/python3 -c "import qgis.core"
    setup_want "PyQt6" python3-pyqt6 /usr/bin/python3 -c "import PyQt6.QtGui, PyQt6.QtXml"
    setup_want "Xvfb, for QGIS's window" "xvfb xauth" xvfb-run --help
    setup_want "PostGIS" postgresql-postgis bash -c 'compgen -G "/usr/share/postgresql/*/extension/postgis.control"'
    setup_want "PostGIS" postgresql-postgis compgen -G '/usr/lib/postgresql/*/lib/postgis-3.so'
    setup_want "Slurm" "slurm-wlm munge" test -x /usr/sbin/slurmctld -a -x /usr/sbin/slurmd -a -x /usr/sbin/munged
    setup_want "GNU parallel" parallel parallel --version
    setup_want "ShellCheck" shellcheck shellcheck --version
    setup_want "Chromium" chromium chromium --version
fi
setup_install

setup_build "$source" "$build"
cd "$build"
# One more than there are processors: a quarter of the time of tests is waiting, for files, servers and browsers.
ctest --output-on-failure -j "$(($(nproc 2>/dev/null || echo 2) + 1))" "$@"
