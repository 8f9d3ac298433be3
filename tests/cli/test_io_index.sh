# shellcheck shell=bash
# The packed spatial index of a GeoPackage: SQLite finds it sound, searches find the same features as a full scan, and
# it goes on living when GDAL inserts and deletes. The numbers of features are those at which nodes fill up (51 cells).
set -eu
. "$(dirname "${BASH_SOURCE[0]}")/io_layers.sh"
"$SUNDER_BUILD/sunder-town" --buildings 3000 --seed 1 town.gpkg >/dev/null
ask() { ogrinfo -q -ro "$1" -sql "$2" | sed -n 's/^  .* = //p'; }
sound() { ask "$1" "SELECT rtreecheck('rtree_$2_geom') AS a"; }
[ "$(sound town.gpkg buildings)" = ok ] || { echo "skipped: GDAL's SQLite cannot check an R-tree"; exit 77; }

for n in 0 1 50 51 52 2601 2602 3000; do
    "$SUNDER" separate --quiet --input-layer buildings --where "fid <= $n" --overwrite --allow-conflicts town.gpkg out.gpkg
    [ "$(sound out.gpkg buildings)" = ok ] || fail "$n features: $(sound out.gpkg buildings)"
    [ "$(ask out.gpkg 'SELECT count(*) AS n FROM rtree_buildings_geom')" = "$n" ] || fail "$n features: others in the index"
    [ "$(ask out.gpkg "SELECT HasSpatialIndex('buildings', 'geom') AS n")" = 1 ] || fail "GDAL does not see the index"
done
[ "$(sound out.gpkg buildings_displacement)" = ok ] || fail "the index of the moves is not sound"

# A window that cuts the town: by the index, and by GDAL's own comparison without one.
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
[ "$(ask without.gpkg "SELECT HasSpatialIndex('buildings', 'geom') AS n")" = 0 ] || fail "--lco SPATIAL_INDEX=NO was not heeded"
