# shellcheck shell=bash disable=SC1091
# Compares with fractions (barrier_depths.py): how deep features lie in barriers, their distances, and which pairs are
# worse than before.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
/usr/bin/python3 -c 'import osgeo.ogr' 2>/dev/null || { echo "skipped: GDAL's Python module is not installed"; exit 77; }

cases=500
[ "${SUNDER_LAWS:-}" != all ] || cases=10000
/usr/bin/python3 "$SUNDER_SOURCE/tests/cli/barrier_depths.py" "$SUNDER" "$((cases * ${SUNDER_TEST_SCALE:-1}))" "${SUNDER_SEED:-1}" ||
    trouble=1
finish
