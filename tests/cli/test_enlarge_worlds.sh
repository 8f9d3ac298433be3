# shellcheck shell=bash disable=SC1091
# --enlarge with --trim, --inset and --hide: random terraces, one of 500 houses, beside an oracle.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
/usr/bin/python3 -c 'from osgeo import ogr; import shapely' 2>/dev/null || { echo "skipped: GDAL's Python module or shapely is not installed"; exit 77; }
worlds=$((40 * ${SUNDER_TEST_SCALE:-1}))
/usr/bin/python3 "$SUNDER_SOURCE/tests/cli/enlarge_worlds.py" "$SUNDER" "${SUNDER_SEED:-5}" "$worlds" || fail "the terraces"
finish
