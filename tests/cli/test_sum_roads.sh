# shellcheck shell=bash disable=SC1091
# Tests sunder sum: algorithms, decompositions and orders by name; their statistics; the planar map as layers.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: jq is not installed"; exit 77; }

# Two rooms and a corridor exactly as wide as the robot: the sum has a hole and degenerate segments.
rooms='POLYGON((0 0,12 0,12 8,0 8,0 0),(1 1,1 7,5 7,5 5,8 5,8 7,11 7,11 1,8 1,8 4,5 4,5 1,1 1))'
robot=square:1
exact() { jq -c '[.result, .polygons, .degenerate_segments, .degenerate_points]' out; }

expect 0 sum "$rooms" $robot --exact
want=$(exact)
[ "$(jq '.result.degenerate_segments' out)" -gt 0 ] || fail "the corridor left no degenerate segment: $want"
for algorithm in arrangement incremental divide; do
    for decomposition in angle-bisector vertical triangulation hertel-mehlhorn optimal mixed; do
        for order in random fat given; do
            expect 0 sum "$rooms" $robot --exact --algorithm $algorithm --decomposition $decomposition --order $order --seed 5
            same "$(exact)" "$want" "$algorithm $decomposition $order:"
            used=$decomposition # an optimal decomposition needs a polygon without holes
            case $decomposition in optimal | mixed) used=hertel-mehlhorn ;; esac
            same "$(jq -c '[.algorithm,.decomposition,.order]' out)" "[\"$algorithm\",\"$used\",\"$order\"]"
            same "$(jq -c '.operations | [.comparisons,.orientation_tests,.segment_intersections,.exact_fallbacks]' out)" \
                "$(jq -c '[.operations.phases | .decompose, .subsums, .union |
                           [.comparisons,.orientation_tests,.segment_intersections,.exact_fallbacks]] | transpose | map(add)' out)" \
                "phases of $algorithm $decomposition $order add up to"
        done
    done
done

# An L has an optimal decomposition; defaults are reported by name.
expect 0 sum 'POLYGON((0 0,4 0,4 1,1 1,1 4,0 4,0 0))' $robot --algorithm divide --decomposition optimal
same "$(jq -c '[.algorithm,.decomposition,.order]' out)" '["divide","optimal","random"]'
expect 0 sum "$rooms" $robot --algorithm incremental
same "$(jq -c '[.algorithm,.decomposition,.order]' out)" '["incremental","angle-bisector","random"]'
# The convolution ignores these options.
expect 0 sum "$rooms" $robot --algorithm convolution --decomposition vertical --order fat --exact
same "$(jq -c '[.algorithm,.decomposition,.order,.operations.phases]' out)" '["convolution",null,null,{}]'
same "$(exact)" "$want"

# ---- The planar map ----

count() { ogrinfo -ro -q -dialect sqlite -sql "SELECT count(*) AS n FROM $2 ${3:+WHERE $3}" "$1" | sed -n 's/.* = //p'; }

expect 0 sum "$rooms" $robot map.gpkg --planar-map --stats stats.json
same "$(jq -r .algorithm stats.json)" arrangement "auto with a map is"
for layer in sum sum_degenerate_segments sum_degenerate_points sum_faces sum_edges sum_vertices; do
    ogrinfo -ro -q map.gpkg $layer >/dev/null 2>&1 || fail "no layer $layer"
done
# Euler's formula: vertices - edges + faces = 1 + components; the outer face is not written.
vertices=$(count map.gpkg sum_vertices) edges=$(count map.gpkg sum_edges) faces=$(count map.gpkg sum_faces)
[ $((vertices - edges + faces)) -ge 1 ] || fail "$vertices vertices, $edges edges, $faces faces"
[ "$(count map.gpkg sum_faces 'covered_by > 1')" -gt 0 ] || fail "no face lies in two subsums"
[ "$(count map.gpkg sum_edges 'covered_by = 0')" -lt "$edges" ] || fail "no edge is covered"
# Faces neither overlap nor leave gaps: the covered ones have together the area of the sum.
area() { ogrinfo -ro -q -dialect sqlite -sql "SELECT sum(ST_Area(geom)) AS a FROM $1 ${2:+WHERE $2}" map.gpkg | sed -n 's/.* = //p'; }
if [ -n "$(area sum)" ]; then same "$(area sum_faces 'covered_by > 0')" "$(area sum)" "area of covered faces"; fi

# With the other algorithms the map has one covered region, the union of all subsums.
for algorithm in incremental divide; do
    expect 0 sum "$rooms" $robot $algorithm.gpkg --planar-map --algorithm $algorithm
    same "$(count $algorithm.gpkg sum_faces 'covered_by > 1')" 0
    same "$(count $algorithm.gpkg sum_edges 'covered_by > 0')" 0
done

# A face with an island, and a face that touches itself in a vertex, are written as valid polygons. A format with one
# layer per file gets several files.
expect 0 sum 'MULTIPOLYGON(((0 0,9 0,9 9,0 9,0 0),(1 1,1 8,8 8,8 1,1 1)),((3 3,5 3,5 5,3 5,3 3)),((6 6,7 6,7 7,6 7,6 6)))' \
    $robot island.shp --planar-map
for part in faces edges vertices; do [ -f island_$part.shp ] || fail "no island_$part.shp"; done
valid=$(ogrinfo -ro -q -dialect sqlite -sql 'SELECT count(*) AS n FROM island_faces WHERE ST_IsValid(geometry) = 0' island_faces.shp |
    sed -n 's/.* = //p')
if [ -n "$valid" ]; then same "$valid" 0 "faces that are not valid:"; fi

# Refused at once, with nothing written.
refused 2 'needs OUTPUT' sum "$rooms" $robot --planar-map
refused 2 'several layers' sum "$rooms" $robot /vsistdout/ --of GeoJSON --planar-map
refused 2 'makes no planar map' sum "$rooms" $robot none.gpkg --planar-map --algorithm convolution
refused 2 'must be one of' sum "$rooms" $robot --decomposition best
refused 2 'must be one of' sum "$rooms" $robot --order sorted
ogr2ogr -f GPKG taken.gpkg map.gpkg sum_faces
refused 1 'layer sum_faces already' sum "$rooms" $robot taken.gpkg --update --planar-map
finish
