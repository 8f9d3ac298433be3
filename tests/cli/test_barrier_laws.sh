# shellcheck shell=bash disable=SC1091
# An additional barrier does not lower the cost, a narrower barrier does not raise it (barrier_laws.py), for generated
# towns with their roads. SUNDER_LAWS=all tests maps, too.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
/usr/bin/python3 -c 'import osgeo.ogr' 2>/dev/null || { echo "skipped: GDAL's Python module is not installed"; exit 77; }

layers=()
town() { # BUILDINGS SEED
    "$SUNDER_BUILD/sunder-town" --buildings "$1" --seed "$2" --trouble 0.5 "town$2.gpkg" || fail "sunder-town"
    layers+=("town $2|town$2.gpkg|buildings|town$2.gpkg|roads")
}
for seed in 1 2 3 4 5 6; do town 12 "$seed"; done
town 80 7
if [ "${SUNDER_LAWS:-}" = all ]; then
    for seed in {8..60}; do town 20 "$seed"; done
    town 1000 61
    data=$SUNDER_SOURCE/../shared/data
    [ -d "$data" ] || echo "without $data: towns alone"
    for name in krems_2013 neuss_2026 saint_jean_la_poterie liechtenstein_2015; do
        [ ! -d "$data" ] || layers+=("$name|$data/$name.gpkg|buildings|$data/$name.gpkg|roads")
    done
fi
/usr/bin/python3 "$SUNDER_SOURCE/tests/cli/barrier_laws.py" "$SUNDER" "${layers[@]}" || trouble=1
finish
