# shellcheck shell=bash disable=SC1091
# All algorithms for sums, on polygons of maps: buildings of the town in the repository, and buildings and countries in
# ../shared, if they are there. P is a feature and Q is another one near it in the layer's order, reflected, so that
# coordinates of the sum are like those of maps.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: jq is not installed"; exit 77; }

roads=(arrangement incremental divide)
decompositions=(angle-bisector vertical triangulation hertel-mehlhorn optimal mixed)
orders=(random fat given)
exact() { jq -c '[.result, .polygons, .degenerate_segments, .degenerate_points]' out; }
compared=0

# pairs DATASET SQL: prints each polygon of the SQL's result together with the next one.
pairs() {
    local before='' wkt want i
    ogr2ogr -f CSV polygons.csv "$1" -dialect sqlite -sql "$2" -lco GEOMETRY=AS_WKT 2>err || { fail "cannot read $1"; return; }
    sed -n '2,$p' polygons.csv | grep -o '"[A-Z]*POLYGON[^"]*"' | tr -d '"' >polygons.txt
    rm polygons.csv
    while read -r wkt; do
        if [ -n "$before" ]; then
            echo "$before" >p.wkt
            echo "$wkt" >q.wkt
            expect 0 sum @p.wkt @q.wkt --reflect --exact
            want=$(exact)
            for i in 0 1 2; do
                compared=$((compared + 1))
                expect 0 sum @p.wkt @q.wkt --reflect --exact --algorithm "${roads[i]}" --seed $compared \
                    --decomposition "${decompositions[compared % 6]}" --order "${orders[compared / 6 % 3]}"
                [ "$(exact)" = "$want" ] || fail "$1: ${roads[i]} differs on $(cat p.wkt q.wkt)"
            done
        fi
        before=$wkt
    done <polygons.txt
}

pairs "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" 'SELECT geom FROM buildings ORDER BY fid LIMIT 20'
data=$SUNDER_SOURCE/../shared/data
if [ -d "$data" ]; then
    layer=$(ogrinfo -ro -q "$data/krems_2013.gpkg" | sed -n 's/^[0-9]*: \(.*\) (.*[Pp]olygon.*)$/\1/p' | head -1)
    pairs "$data/krems_2013.gpkg" "SELECT geom FROM \"$layer\" WHERE ST_NPoints(geom) BETWEEN 8 AND 40 ORDER BY ST_NPoints(geom) DESC LIMIT 20"
else
    echo "no ../shared/data: maps beside the repository are left out"
fi
[ $compared -ge 50 ] || fail "only $compared sums were compared"
echo "$compared sums compared"
finish
