# shellcheck shell=bash disable=SC1091
# Checks every rule of a separated layer by code that shares nothing with the program (rules.py): first that this code
# finds violations, then for a town, and for maps if they are beside the repository. SUNDER_LAWS=all tests all maps.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
/usr/bin/python3 -c 'import osgeo.ogr' 2>/dev/null || { echo "skipped: GDAL's Python module is not installed"; exit 77; }
anchors=$SUNDER_BUILD/tests/anchors
[ -x "$anchors" ] || { echo "skipped: no anchors"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1

/usr/bin/python3 "$SUNDER_SOURCE/tests/cli/rules_cases.py" >broken 2>&1 || { cat broken; fail "rules.py does not see what it should"; }

# asked NAME SOURCE LAYER GAP LIMIT [BARRIER]
asked() {
    local -a barrier=() told=()
    [ -z "${6:-}" ] || { barrier=(--barrier "$6") && told=("barrier=$6"); }
    "$SUNDER" separate "$2" o.gpkg --overwrite -q --input-layer "$3" --gap "$4" --max-shift "$5" --output-layer l \
        "${barrier[@]}" 2>err
    case $? in 0 | 3) ;; *) fail "$1: status $?" ;; esac
    /usr/bin/python3 "$SUNDER_SOURCE/tests/cli/rules.py" "$2|$3" "o.gpkg|l" "$4" "max-shift=$5" "anchors=$anchors" \
        "${told[@]}" >broken 2>counts || { head -5 broken counts; fail "$1, gap $4, limit $5, barrier ${6:-none}"; }
    echo "$1, gap $4, limit $5${6:+, roads}: $(cat counts)"
}

town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
asked town "$town" buildings 3 10 "$town,layer=roads,width=5"
asked town "$town" buildings 3 3 "$town,layer=roads,width-field=width,gap=0"
asked town "$town" buildings 3 10 "$town,layer=roads,width-field=width,gap=0,side=no"
for limit in 0.5 2 10; do asked town "$town" buildings 3 $limit; done
if [ "${SUNDER_LAWS:-}" = all ]; then
    for seed in 1 2 3 4; do
        "$SUNDER_BUILD/sunder-town" --buildings 250 --seed $seed --trouble 0.6 "town$seed.gpkg" >/dev/null || fail "sunder-town"
        for gap in 2 5; do for limit in 1 4 1000; do asked "town $seed" "town$seed.gpkg" buildings $gap $limit; done; done
    done
fi
data=$SUNDER_SOURCE/../shared/data
if [ ! -d "$data" ]; then
    echo "without $data: the town alone"
else
    for limit in 1 10; do
        asked krems "$data/krems_2013.gpkg" buildings 3 $limit
        asked saint-jean "$data/saint_jean_la_poterie.gpkg" buildings 3 $limit
    done
    if [ "${SUNDER_LAWS:-}" = all ]; then
        for name in krems_2013 saint_jean_la_poterie; do
            asked $name "$data/$name.gpkg" buildings 3 10 "$data/$name.gpkg,layer=roads,width=5"
        done
        for limit in 1 10; do
            asked neuss "$data/neuss_2026.gpkg" buildings 3 $limit
            asked liechtenstein "$data/liechtenstein_2015.gpkg" buildings 3 $limit
            asked baltimore "/vsizip/$data/baltimore_2015_shp.zip" buildings 3 $limit
            asked jakarta "/vsizip/$data/jakarta_2012_shp.zip" structures 3 $limit
            asked paris "$data/paris_cite_2014.gpkg" buildings 3 $limit
        done
    fi
fi
finish
