# shellcheck shell=bash disable=SC1091
# How the results for related inputs are related (layer_laws.py): for generated towns, and for maps. SUNDER_LAWS=all
# tests all maps, each with two gaps.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
/usr/bin/python3 -c 'import osgeo.ogr' 2>/dev/null || { echo "skipped: GDAL's Python module is not installed"; exit 77; }

"$SUNDER_BUILD/sunder-town" --buildings 300 --seed 3 --trouble 0.6 other.gpkg || fail "sunder-town"
layers=("other town|other.gpkg|buildings|GAP=3")
data=$SUNDER_SOURCE/../shared/data
if [ "${SUNDER_LAWS:-}" = all ]; then
    "$SUNDER_BUILD/sunder-town" --buildings 3000 --seed 4 large.gpkg || fail "sunder-town"
    layers+=("large town|large.gpkg|buildings")
fi
if [ ! -d "$data" ]; then
    echo "without $data: towns alone"
elif [ "${SUNDER_LAWS:-}" = all ]; then
    layers+=("krems|$data/krems_2013.gpkg|buildings" "neuss|$data/neuss_2026.gpkg|buildings"
        "saint-jean|$data/saint_jean_la_poterie.gpkg|buildings" "liechtenstein|$data/liechtenstein_2015.gpkg|buildings"
        "baltimore|/vsizip/$data/baltimore_2015_shp.zip|buildings"
        "jakarta|/vsizip/$data/jakarta_2012_shp.zip|structures" "paris|$data/paris_cite_2014.gpkg|buildings|GAP=3")
else
    layers+=("krems|$data/krems_2013.gpkg|buildings|GAP=3")
fi
/usr/bin/python3 "$SUNDER_SOURCE/tests/cli/layer_laws.py" "$SUNDER" "${layers[@]}" || trouble=1
finish
