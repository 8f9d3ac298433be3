# shellcheck shell=bash
# The packed spatial index of a GeoPackage: SQLite finds no fault in it, searches find the same features as a full scan,
# and it stays valid when GDAL inserts and deletes. The numbers of features are those at which nodes become full (51
# cells).
set -eu
. "$(dirname "${BASH_SOURCE[0]}")/io_layers.sh"
"$SUNDER_BUILD/sunder-town" --buildings 3000 --seed 1 town.gpkg >/dev/null
ask() { ogrinfo -q -ro "$1" -sql "$2" | sed -n 's/^  .* = //p'; }
sound() { ask "$1" "SELECT rtreecheck('rtree_$2_geom') AS a"; }
[ "$(sound town.gpkg buildings)" = ok ] || { echo "skipped: GDAL's SQLite cannot check an R-tree"; exit 77; }

for n in 0 1 50 51 52 2601 2602 3000; do
    "$SUNDER" separate --quiet --input-layer buildings --where "fid <= $n" --overwrite --allow-conflicts town.gpkg out.gpkg
    [ "$(sound out.gpkg buildings)" = ok ] || fail "$n features: $(sound out.gpkg buildings)"
    [ "$(ask out.gpkg 'SELECT count(*) AS n FROM rtree_buildings_geom')" = "$n" ] || fail "$n features: the index does not contain all of them"
    [ "$(ask out.gpkg "SELECT HasSpatialIndex('buildings', 'geom') AS n")" = 1 ] || fail "GDAL does not see the index"
done
[ "$(sound out.gpkg buildings_displacement)" = ok ] || fail "the index of the moves is not sound"

# Windows that cover parts of the town, searched with the index, and by GDAL's own comparison without one.
ogr2ogr -f GPKG plain.gpkg out.gpkg buildings -lco SPATIAL_INDEX=NO
read -r x0 y0 x1 y1 <<<"$(ogrinfo -ro -so out.gpkg buildings | sed -n 's/^Extent: (\(.*\), \(.*\)) - (\(.*\), \(.*\))/\1 \2 \3 \4/p')"
for part in '0 0 .5 .5' '.3 .3 .4 .4' '.9 .1 1 .2' '0 0 1 1' '.5 .5 .5 .5'; do
    window=$(echo "$x0 $y0 $x1 $y1 $part" |
        awk '{ printf "%.3f %.3f %.3f %.3f", $1+$5*($3-$1), $2+$6*($4-$2), $1+$7*($3-$1), $2+$8*($4-$2) }')
    # shellcheck disable=SC2086 # four words
    for each in out plain; do
        ogrinfo -q -ro "$each.gpkg" buildings -spat $window -geom=NO | grep OGRFeature >"$each.found" || true
    done
    cmp -s <(sort out.found) <(sort plain.found) || fail "window $window: the index finds other features"
done
[ -s out.found ] || [ -s plain.found ] || ogrinfo -q -ro out.gpkg buildings -geom=NO | grep -q OGRFeature || fail "no features"

ogrinfo -q out.gpkg -sql 'DELETE FROM buildings WHERE fid % 3 = 0' >/dev/null
ogrinfo -q out.gpkg -sql 'INSERT INTO buildings (id, kind, geom) SELECT id, kind, geom FROM buildings WHERE fid < 100' >/dev/null
[ "$(sound out.gpkg buildings)" = ok ] || fail "after inserting and deleting: $(sound out.gpkg buildings)"
[ "$(ask out.gpkg 'SELECT count(*) AS n FROM rtree_buildings_geom')" = "$(ask out.gpkg 'SELECT count(*) AS n FROM buildings')" ] ||
    fail "the index did not follow insertions and deletions"

"$SUNDER" separate --quiet --input-layer buildings --lco SPATIAL_INDEX=NO town.gpkg without.gpkg --allow-conflicts
[ "$(ask without.gpkg "SELECT HasSpatialIndex('buildings', 'geom') AS n")" = 0 ] || fail "--lco SPATIAL_INDEX=NO was ignored"

# Plain features are written by SQLite directly, without GDAL, unless an option is given: both ways give the same file.
# The layers have moved features, null and empty values, texts that a width could cut, integers and reals, members and
# holes, corners at zero.
export SOURCE_DATE_EPOCH=1700000000
cat >odd.json <<'E2'
{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"n": 1, "x": 0.5, "t": "a", "w": "abcd"}, "geometry": {"type": "Polygon", "coordinates": [[[1, 1], [9, 1], [9, 9], [1, 9], [1, 1]], [[3, 3], [3, 5], [5, 5], [5, 3], [3, 3]]]}},
{"type": "Feature", "properties": {"n": null, "x": 2, "t": "", "w": "éééé"}, "geometry": {"type": "Polygon", "coordinates": [[[4, 8], [8, 8], [8, 8.9], [4, 8.9], [4, 8]]]}},
{"type": "Feature", "properties": {"n": 5000000000, "x": null, "t": null, "w": "éé"}, "geometry": {"type": "Polygon", "coordinates": [[[2, 2], [3, 2], [3, 8], [2, 8], [2, 2]]]}},
{"type": "Feature", "properties": {"n": -3, "x": -1e300, "t": "it's", "w": null}, "geometry": {"type": "Polygon", "coordinates": [[[-3, 0], [2, 0], [2, 3], [-3, 3], [-3, 0]]]}},
{"type": "Feature", "properties": {"n": 0, "x": 1e-300, "t": "b", "w": ""}, "geometry": {"type": "MultiPolygon", "coordinates": [[[[5, 5], [6, 5], [6, 6], [5, 5]]], [[[7, 7], [8, 7], [8, 8], [7, 7]]]]}},
{"type": "Feature", "properties": {"n": 7}, "geometry": null},
{"type": "Feature", "properties": {"n": 8, "w": "abcd"}, "geometry": {"type": "Polygon", "coordinates": [[[6, 2], [7, 2], [7, 3], [6, 2]]]}}
]}
E2
for type in GEOMETRY POLYGON MULTIPOLYGON; do
    ogr2ogr -f GPKG -overwrite -nln buildings -nlt $type -a_srs EPSG:25832 odd_$type.gpkg odd.json -lco GEOMETRY_NAME='g"m' 2>/dev/null
done
for each in town odd_GEOMETRY odd_POLYGON odd_MULTIPOLYGON; do
    "$SUNDER" separate -q --input-layer buildings --overwrite --gap 1 "$each.gpkg" one.gpkg 2>one.said || [ $? = 3 ]
    "$SUNDER" separate -q --input-layer buildings --overwrite --gap 1 --lco SPATIAL_INDEX=YES "$each.gpkg" two.gpkg 2>two.said || [ $? = 3 ]
    cmp one.gpkg two.gpkg || fail "$each: rows written without GDAL differ"
    cmp one.said two.said || fail "$each: messages differ if rows are written without GDAL"
done

# With two threads, rows are encoded on one thread and inserted on another; the file is the same.
for threads in 1 2; do
    "$SUNDER" separate -q --input-layer buildings --gap 1 --threads $threads town.gpkg threads_$threads.gpkg || [ $? = 3 ]
done
cmp threads_1.gpkg threads_2.gpkg || fail "a file written with two threads differs"
