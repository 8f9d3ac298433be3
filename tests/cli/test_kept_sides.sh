# shellcheck shell=bash disable=SC1091
# The side of a point feature is that of the point itself, for any symbol. The anchor of a feature in an area with
# as=boundary stays in it. A feature that a road cuts in half belongs to the side with more room.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export PYTHONDONTWRITEBYTECODE=1 SOURCE_DATE_EPOCH=1700000000
kept() { /usr/bin/python3 "$SUNDER_SOURCE/tests/cli/kept_sides.py" "$@" || fail "kept_sides.py $*"; }

# A point near the junction of a horizontal line and a vertical one that starts at it: the larger part of the symbol is
# below the horizontal line, the point is above it.
layer lines.gpkg lines LINESTRING <<'X'
id,WKT
1,"LINESTRING(-100 0,100 0)"
2,"LINESTRING(0 0,0 100)"
X
layer town.gpkg town POINT <<'X'
id,WKT
1,POINT(1 1)
X
expect 0 separate town.gpkg out.gpkg --symbol disc:10 --barrier lines.gpkg
ogrinfo -q -al -geom=NO out.gpkg town | awk '/sunder_d[xy]/ && $NF < 9 { exit 1 }' || fail "the town is not above the bar"
# A symbol that does not contain its point: the side is still that of the point, and barriers near the point and near
# the symbol are both read.
expect 0 separate town.gpkg out.gpkg --symbol 'POLYGON((30 -6,40 -6,40 6,30 6,30 -6))' --barrier lines.gpkg \
    --max-shift 9 --overwrite
ogrinfo -q -al -geom=NO out.gpkg town | awk '/sunder_dy/ && $NF < 5 { exit 1 }' || fail "the symbol moved below the bar"

kept write "${SUNDER_SEED:-1}"
for kind in points houses; do
    options=(--barrier parcels.geojson,as=boundary --contained ignore)
    [ $kind = houses ] || options+=(--symbol disc:8)
    [ $kind = points ] || options+=(--gap 2)
    run separate $kind.geojson $kind.gpkg -q --effort 0 "${options[@]}"
    [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || fail "$kind: status $status"
    said=$(kept look $kind.geojson $kind.gpkg $kind)
    case $said in
        *' 0 moved'* | *' features, 1 moved'*) fail "$kind: $said" ;;
        *', 0 left') ;;
        *) fail "$kind: $said" ;;
    esac
    run check $kind.gpkg -l $kind --before $kind.geojson "${options[@]}"
    says out 'side 0'
    # The same in parts.
    expect 0 plan $kind.geojson $kind.plan --shards 3 --effort 0 --output-layer $kind "${options[@]}"
    for shard in 1 2 3; do expect 0 separate --shard $shard $kind.plan -q; done
    run merge $kind.plan $kind-parts.gpkg -q
    [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || fail "$kind: merge: status $status"
    ogrinfo -q -al -ro $kind.gpkg $kind >whole.txt
    ogrinfo -q -al -ro $kind-parts.gpkg $kind >parts.txt
    cmp -s whole.txt parts.txt || fail "$kind: moves differ in parts"
done
# Houses that the centre line of a road cuts in half, or nearly so, with another road on one side. They move away from
# the other road, although the part on that side is a little larger. Vertical and horizontal roads, with the other road
# on either side.
layer roads.gpkg roads LINESTRING <<'X'
id,WKT
1,"LINESTRING(0 0,300 0)"
2,"LINESTRING(0 20,300 20)"
3,"LINESTRING(-20 0,-20 300)"
4,"LINESTRING(-40 0,-40 300)"
X
layer halves.gpkg halves POLYGON <<'X'
id,WKT
1,"POLYGON((140 16,150 16,150 24,140 24,140 16))"
2,"POLYGON((240 15.9375,250 15.9375,250 23.9375,240 23.9375,240 15.9375))"
3,"POLYGON((80 -4,90 -4,90 4,80 4,80 -4))"
4,"POLYGON((-24 140,-16 140,-16 150,-24 150,-24 140))"
5,"POLYGON((-44 240,-36 240,-36 250,-44 250,-44 240))"
6,"POLYGON((40 15,50 15,50 24,40 24,40 15))"
X
for limit in '' '--max-shift 15'; do
    # shellcheck disable=SC2086
    run separate halves.gpkg o.gpkg -q --overwrite --gap 2 --barrier roads.gpkg,width=12 $limit
    ogr2ogr -f CSV moved.csv o.gpkg -sql "SELECT CAST(id AS INTEGER) AS id, round(sunder_dx, 6) AS dx, round(sunder_dy, 6) AS dy FROM halves WHERE CAST(id AS INTEGER) < 6"
    same "$(tail -n +2 moved.csv | tr -d '"' | tr '\n' ';')" '1,0,12;2,0,12.0625;3,0,-12;4,12,0;5,-12,0;' "halves $limit:"
    rm moved.csv
    # shellcheck disable=SC2086
    run check o.gpkg -l halves --before halves.gpkg --gap 2 --barrier roads.gpkg,width=12 $limit
    says out 'worse 0, limit 0, side 0, jump 0'
done
finish
