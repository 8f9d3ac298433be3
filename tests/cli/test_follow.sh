# shellcheck shell=bash disable=SC1091
# sunder follow: points, lines and polygons that go along with what was moved; what they belong to by place, by distance,
# by a field; what it refuses.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

layer houses.gpkg houses Polygon <<'E2'
name,grp,WKT
a,1,"POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))"
b,,"POLYGON ((8 0, 18 0, 18 10, 8 10, 8 0))"
c,,"POLYGON ((100 0, 110 0, 110 10, 100 10, 100 0))"
d,1,"POLYGON ((-6 0, 0 0, 0 10, -6 10, -6 0))"
E2
expect 0 separate houses.gpkg moved.gpkg --gap 4 --touch-tolerance 0.5

# What FILE's layer holds, a line for each feature: its geometry, then the columns.
rows() { ogrinfo -q -dialect SQLite -sql "SELECT n, ST_AsText($2) AS g, sunder_dx AS x, sunder_st AS s, sunder_to AS t FROM $3 ORDER BY n" "$1" |
    awk '/ n \(/ { n = $NF } / g \(/ { sub(/.* = /, ""); g = $0 } / x \(/ { x = $NF } / s \(/ { s = $NF } / t \(/ { print n "|" g "|" x "|" s "|" $NF }'; }

move() { ogrinfo -q -sql "SELECT sunder_dx FROM houses WHERE name = '$1'" moved.gpkg | awk '/sunder_dx/ { print $NF }'; }
a=$(move a) b=$(move b)
same "$(move c)" 0
awk -v a="$a" -v b="$b" 'BEGIN { exit !(a < 0 && b > 0) }' || fail "moves of a and b: $a, $b"

layer along.gpkg points Point <<'E2'
n,key,house,WKT
1,1,a,"POINT (2 5)"
2,2,b,"POINT (15 5)"
3,3,c,"POINT (105 5)"
4,4,d,"POINT (-1 5)"
5,,z,"POINT (50 5)"
6,9,a,"POINT (20 5)"
7,x,b,"POINT (18 10)"
E2
layer along.gpkg lines LineString <<'E2'
n,WKT
1,"LINESTRING (-5 1, 5 1, 5 9)"
2,"LINESTRING (5 9, 2 9)"
3,"LINESTRING (5 5, 105 5)"
4,"LINESTRING (15 5, 40 5)"
5,"LINESTRING EMPTY"
E2
expect 0 follow moved.gpkg along.gpkg f.gpkg --input-layer points --stats s.json
sum() { awk -v p="$1" -v d="$2" 'BEGIN { printf "%.15g", p + d }'; }
rows f.gpkg geom points >got
cat >wanted <<E2
1|POINT($(sum 2 "$a") 5)|$a|moved|1
2|POINT($(sum 15 "$b") 5)|$b|moved|2
3|POINT(105 5)|0|unmoved|3
4|POINT($(sum -1 "$a") 5)|$a|moved|4
5|POINT(50 5)|0|free|(null)
6|POINT(20 5)|0|free|(null)
7|POINT($(sum 18 "$b") 10)|$b|moved|2
E2
cmp -s got wanted || fail "points inside: $(diff got wanted)"
same "$(jq -c . s.json)" '{"command":"follow","features":7,"moved":4,"unmoved":1,"free":2,"several":0,"hidden":0,"outside":0,"empty":0,"torn":0}'
says out 'points: 7 features: moved 4, unmoved 1, free 2'
# A line whose vertices lie in two houses of one block goes with the block; one that reaches from block to block, or out
# of a house, stays. A vertex that two lines share stays one.
expect 0 follow moved.gpkg along.gpkg f.gpkg --input-layer lines --overwrite
rows f.gpkg geom lines >got
cat >wanted <<E2
1|LINESTRING($(sum -5 "$a") 1, $(sum 5 "$a") 1, $(sum 5 "$a") 9)|$a|moved|4
2|LINESTRING($(sum 5 "$a") 9, $(sum 2 "$a") 9)|$a|moved|1
3|LINESTRING(5 5, 105 5)|0|several|(null)
4|LINESTRING(15 5, 40 5)|0|free|(null)
E2
grep -v '^5' got | cmp -s - wanted || fail "lines inside: $(diff got wanted)"
grep -q '^5|.*|empty|' got || fail "an empty line: $(cat got)"
# The nearest, up to a distance, which counts.
expect 0 follow moved.gpkg along.gpkg f.gpkg --input-layer points --overwrite --by nearest:2
rows f.gpkg geom points | cut -d'|' -f1,4,5 | tr '\n' ' ' >got
same "$(cat got)" '1|moved|1 2|moved|2 3|unmoved|3 4|moved|4 5|free|(null) 6|moved|2 7|moved|2 '
expect 0 follow moved.gpkg along.gpkg f.gpkg --input-layer points --overwrite --by nearest:1.9999999999999998
rows f.gpkg geom points | grep -q '^6.*free' || fail "beyond the distance"
expect 0 follow moved.gpkg along.gpkg f.gpkg --input-layer lines --overwrite --by nearest:5
rows f.gpkg geom lines | cut -d'|' -f1,5 | tr '\n' ' ' >got
same "$(cat got)" '1|1 2|1 3|1 4|2 5|(null) '

# By a field, of FIDs or of a key.
expect 0 follow moved.gpkg along.gpkg f.gpkg --input-layer points --overwrite --by field:key
rows f.gpkg geom points | cut -d'|' -f1,5 | tr '\n' ' ' >got
same "$(cat got)" '1|1 2|2 3|3 4|4 5|(null) 6|(null) 7|(null) '
expect 0 follow moved.gpkg along.gpkg f.gpkg --input-layer points --overwrite --by field:house --id-field name
rows f.gpkg geom points | cut -d'|' -f1,5 | tr '\n' ' ' >got
same "$(cat got)" '1|1 2|2 3|3 4|4 5|(null) 6|1 7|2 '

# Attributes, Z and M stay.
layer solid.gpkg solid PointZM <<'E2'
n,note,WKT
1,ä,"POINT ZM (15 5 7 8)"
E2
expect 0 follow moved.gpkg solid.gpkg f.gpkg --overwrite
same "$(ogrinfo -q -al f.gpkg | grep -c "POINT ZM ($(sum 15 "$b") 5 7 8)")" 1
same "$(ogrinfo -q -al f.gpkg | awk '/note/ { print $NF }')" 'ä'

# What is hidden takes nothing along.
ogr2ogr hidden.gpkg moved.gpkg houses -sql "SELECT *, CASE name WHEN 'b' THEN 1 ELSE 0 END AS sunder_inv FROM houses" -dialect SQLite -nln houses
expect 0 follow hidden.gpkg along.gpkg f.gpkg --input-layer points --overwrite
rows f.gpkg geom points | cut -d'|' -f1,4 | tr '\n' ' ' >got
same "$(cat got)" '1|moved 2|hidden 3|unmoved 4|moved 5|free 6|free 7|hidden '

# Many points, many of them on walls, in the town: asked of in rationals.
if /usr/bin/python3 -c 'import osgeo' 2>/dev/null; then
    worlds=$SUNDER_SOURCE/tests/cli/follow_worlds.py town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
    run separate "$town" town.gpkg --input-layer buildings --gap 3 --barrier "$town,layer=roads,width=5" --max-shift 7 --quiet
    /usr/bin/python3 "$worlds" make "$town" buildings p.gpkg "${SUNDER_SEED:-1}" $((3000 * ${SUNDER_TEST_SCALE:-1}))
    expect 0 follow town.gpkg p.gpkg q.gpkg
    /usr/bin/python3 "$worlds" ask town.gpkg buildings p.gpkg q.gpkg >asked || fail "$(cat asked)"
    says asked ' 0 wrong, 0 lost'
    # The corners of houses whose moves are not exact, at coordinates of all digits on both sides of 0.
    python3 - >rounded.csv <<'X'
import random
random.seed(3)
print("id,WKT")
for k in range(150):
    x, y = -30 + random.random() / 20 + k % 15 * 4, -20 + random.random() / 20 + k // 15 * 4
    w, h = 3.8 + random.random() / 20, 3.8 + random.random() / 20
    print('%d,"POLYGON((%r %r,%r %r,%r %r,%r %r,%r %r))"' % (k, x, y, x + w, y + 0.01, x + w, y + h, x, y + h, x, y))
X
    layer rounded.gpkg town Polygon <rounded.csv
    expect 0 separate rounded.gpkg away.gpkg --gap 0.5 --no-blocks --rows no --effort 0 --allow-conflicts -q
    /usr/bin/python3 "$worlds" corners rounded.gpkg town corners.gpkg
    expect 0 follow away.gpkg corners.gpkg corners_moved.gpkg
    same "$(/usr/bin/python3 "$worlds" ask_corners away.gpkg town corners.gpkg corners_moved.gpkg)" '600 corners, 0 wrong'
else
    echo "skipped in part: GDAL's Python module is not installed"
fi

refused 2 'no layer has the fields sunder_dx and sunder_dy' follow houses.gpkg along.gpkg n.gpkg --input-layer points
refused 1 'no such file' follow none.gpkg along.gpkg n.gpkg --input-layer points
refused 2 'expected inside, nearest:LENGTH or field:NAME' follow moved.gpkg along.gpkg n.gpkg --input-layer points --by near
refused 2 '--by nearest:' follow moved.gpkg along.gpkg n.gpkg --input-layer points --by nearest:far
refused 1 'has no field none' follow moved.gpkg along.gpkg n.gpkg --input-layer points --by field:none
refused 2 '--id-field' follow moved.gpkg along.gpkg n.gpkg --input-layer points --id-field name
refused 1 'two features have the key 1' follow moved.gpkg along.gpkg n.gpkg --input-layer points --by field:key --id-field grp
layer elsewhere.gpkg points Point EPSG:25833 <<'E2'
n,WKT
1,"POINT (2 5)"
E2
refused 1 'different CRSs' follow moved.gpkg elsewhere.gpkg n.gpkg
refused 1 'is an input' follow moved.gpkg along.gpkg moved.gpkg --input-layer points --overwrite
finish
