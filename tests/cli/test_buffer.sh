# shellcheck shell=bash disable=SC1091
# sunder buffer: the four operations on layers, the attributes that are kept, dissolving, degenerate parts, statistics,
# refusals.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg

layer halls.gpkg halls POLYGON <<'CSV'
WKT,name,rooms,height
"POLYGON ((0 0, 4 0, 4 10, 0 10, 0 0))",hall,2,4.5
"POLYGON ((20 0, 22 0, 22 2, 20 2, 20 0))",hut,1,
"POLYGON ((40 0, 50 0, 50 3, 60 3, 60 7, 50 7, 50 10, 40 10, 40 0))",ballroom,3,7.25
,ruin,0,
CSV
keys='["command","features","empty","vertices","area","max_deviation","invalid","rounded_again"]'

expect 0 buffer halls.gpkg eroded.gpkg --operation erode --shape square:4 --degenerate --id-field name --stats -
[ ! -s err ] || fail "stderr is not empty"
same "$(json 'keys_unsorted' out | tr -d ' \n')" "$keys"
same "$(jq -c '[.[]]' out)" '["buffer",4,2,4,36,0,0,0]'
same "$(geometry eroded.gpkg halls 3)" '  POLYGON ((42 2,48 2,48 8,42 8,42 2))'
ogrinfo -ro -q eroded.gpkg halls -fid 2 | grep -q '^  POLYGON EMPTY' || fail "eroded: what vanishes is not empty"
same "$(geometry eroded.gpkg halls 4)" '' "a null geometry"
same "$(count eroded.gpkg halls_degenerate_segments) $(count eroded.gpkg halls_degenerate_points)" '2 0'
ogrinfo -ro -q eroded.gpkg halls_degenerate_segments >parts
says parts 'LINESTRING (2 2,2 8)'
says parts 'LINESTRING (48 5,58 5)'
says parts 'id (String) = ballroom'
says parts 'fid (Integer64) = 3'

# Attributes, types, FIDs and the CRS are those of the input.
ogrinfo -ro -al -geom=NO halls.gpkg | grep -v -e '^INFO' -e using -e Extent >before.txt
for operation in dilate open close; do
    expect 0 buffer halls.gpkg $operation.gpkg --operation $operation --shape square:4
    ogrinfo -ro -al -geom=NO $operation.gpkg halls | grep -v -e '^INFO' -e using -e Extent >after.txt
    cmp -s before.txt after.txt || fail "$operation: $(diff before.txt after.txt | head -5)"
    says out 'halls: 4 features ('
done
same "$(geometry open.gpkg halls 1)" '  POLYGON ((0 0,4 0,4 10,0 10,0 0))' "a hall opened by a square that just fits"
ogrinfo -ro -q open.gpkg halls -fid 2 | grep -q '^  POLYGON EMPTY' || fail "open: what vanishes is not empty"
same "$(geometry dilate.gpkg halls 2)" '  POLYGON ((18 -2,24 -2,24 4,18 4,18 -2))'
same "$(geometry close.gpkg halls 3)" "$(geometry halls.gpkg halls 3)" "nothing to close"

# A slot exactly as wide as the shape becomes a degenerate hole of the dilation and is filled by closing; a wider slot
# remains.
layer slots.gpkg slots POLYGON <<'CSV'
WKT,a
"POLYGON ((0 0, 10 0, 10 4, 2 4, 2 6, 10 6, 10 10, 0 10, 0 0))",1
"POLYGON ((0 0, 10 0, 10 4, 2 4, 2 6.0000000000000009, 10 6.0000000000000009, 10 10, 0 10, 0 0))",2
CSV
expect 0 buffer slots.gpkg c.gpkg --operation close --shape square:2
same "$(geometry c.gpkg slots 1)" '  POLYGON ((0 0,10 0,10 10,0 10,0 0))'
same "$(geometry c.gpkg slots 2)" "$(geometry slots.gpkg slots 2)"
expect 0 buffer slots.gpkg d.gpkg --shape square:2 --degenerate
ogrinfo -ro -q d.gpkg slots_degenerate_segments | grep -q 'LINESTRING (3 5,11 5)' || fail "the slide is missing"
same "$(count d.gpkg slots_degenerate_segments)" 1

# --dissolve: one set of all features; with a field one set for each value, in order of their first occurrence, null is
# a value of its own.
layer rows.gpkg rows POLYGON <<'CSV'
WKT,street,number
"POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0))",b,1
"POLYGON ((8 0, 12 0, 12 4, 8 4, 8 0))",a,2
"POLYGON ((3 1, 6 1, 6 3, 3 3, 3 1))",b,3
"POLYGON ((100 0, 104 0, 104 4, 100 4, 100 0))",,4
"POLYGON ((110 0, 114 0, 114 4, 110 4, 110 0))",,5
CSV
expect 0 buffer rows.gpkg all.gpkg --operation close --shape square:2 --dissolve --stats -
same "$(count all.gpkg rows)" 1
ogrinfo -ro -q all.gpkg rows | grep -q 'features (Integer64) = 5' || fail "the number of features is not there"
ogrinfo -q rows.gpkg -sql "UPDATE rows SET street = NULL WHERE street = ''" >/dev/null
expect 0 buffer rows.gpkg by.gpkg --shape square:2 --dissolve-field street
ogrinfo -ro -q -geom=NO by.gpkg rows | grep -e features -e street | sed 's/.*= //' | tr '\n' ' ' >sets
same "$(cat sets)" '2 b 1 a 1 (null) 1 (null) '
expect 0 buffer rows.gpkg by.shp --operation open --shape square:3 --dissolve-field number
same "$(count by.shp by)" 5

# --explode: each polygon of the result is a feature; together they are the result without --explode.
polygons() { ogrinfo -ro -q "$1" rows -dialect SQLite -sql "SELECT ST_AsText(geom) AS t FROM rows" | grep -oE '\(\([-0-9][^()]*(\),\([^()]*)*\)\)' | tr -d ' ' | sort; }
expect 0 buffer rows.gpkg blocks.gpkg --operation close --shape square:2 --dissolve --explode --stats -
[ "$(count blocks.gpkg rows)" -ge 2 ] || fail "$(count blocks.gpkg rows) blocks"
polygons all.gpkg >whole
polygons blocks.gpkg >pieces
[ -s whole ] && cmp -s whole pieces || fail "--explode: the polygons differ"
same "$(count blocks.gpkg rows)" "$(wc -l <whole)" 'features for polygons:'
ogrinfo -ro -so blocks.gpkg rows | grep -q '^Geometry: Polygon$' || fail '--explode: not a layer of polygons'
if ogrinfo -ro -so blocks.gpkg rows | grep -q '^features: '; then fail '--explode: the number of features of all blocks'; fi
expect 0 buffer rows.gpkg by_street.gpkg --shape square:2 --dissolve-field street --explode
same "$(ogrinfo -ro -q -geom=NO by_street.gpkg rows | sed -n 's/.*street.*= //p' | sort -u | tr '\n' ' ')" '(null) a b ' streets
layer waist.gpkg rows POLYGON <<'CSV'
id,WKT
7,"POLYGON ((0 0, 4 0, 4 4, 3 4, 3 1, 1 1, 1 4, 0 4, 0 0))"
8,"POLYGON ((10 0, 11 0, 11 1, 10 1, 10 0))"
9,"POLYGON ((20 0, 30 0, 30 10, 20 10, 20 0))"
CSV
ogr2ogr -f GPKG unique.gpkg waist.gpkg -sql 'SELECT id AS key, geom FROM rows' -nln rows -lco FID=fid -nlt POLYGON
/usr/bin/python3 - <<'X' || true
import sqlite3
db = sqlite3.connect("unique.gpkg")
db.execute("CREATE UNIQUE INDEX keys ON rows(key)")
db.commit()
X
expect 0 buffer unique.gpkg halves.gpkg --operation erode --shape 'POLYGON ((0 0, 0.5 0, 0.5 2, 0 2, 0 0))' --explode
same "$(ogrinfo -ro -q -geom=NO halves.gpkg rows | sed -n 's/^  \(key\|sunder_fid\) .*= //p' | tr '\n' ' ')" '7 1 7 1 9 3 ' 'attributes of pieces:'

# The field keeps its type. Values that print alike but differ are different sets, equal values are one. The field may
# have the name of a result column.
cat >kinds.json <<'JSON'
{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"features": 0.3, "day": "2020-01-02", "yes": true, "geom": "a", "l": [1]}, "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}},
{"type": "Feature", "properties": {"features": 0.30000000000000004, "day": "2020-01-02", "yes": true, "geom": "b", "l": [2]}, "geometry": {"type": "Polygon", "coordinates": [[[5, 0], [6, 0], [6, 1], [5, 0]]]}},
{"type": "Feature", "properties": {"features": -0.0, "day": "2020-01-03", "yes": false, "geom": "a", "l": [1]}, "geometry": {"type": "Polygon", "coordinates": [[[9, 0], [10, 0], [10, 1], [9, 0]]]}},
{"type": "Feature", "properties": {"features": 0.0, "day": "2020-01-03", "yes": false, "geom": "c", "l": [1]}, "geometry": null}]}
JSON
by_field() {
    expect 0 buffer kinds.json kinds.gpkg --input-crs EPSG:25832 --overwrite --shape square:2 --dissolve-field "$1"
    ogrinfo -ro -q -geom=NO kinds.gpkg kinds | sed -n 's/^  [a-z_]* (\(.*\)) = \(.*\)/\1 \2/p' | tr '\n' ';'
}
same "$(by_field features)" 'Integer64 1;Real 0.3;Integer64 1;Real 0.3;Integer64 2;Real 0;'
same "$(by_field day)" 'Integer64 2;Date 2020/01/02;Integer64 2;Date 2020/01/03;'
same "$(by_field yes)" 'Integer64 2;Integer(Boolean) 1;Integer64 2;Integer(Boolean) 0;'
same "$(by_field geom)" 'Integer64 2;String a;Integer64 1;String b;Integer64 1;String c;'
refused 1 'type IntegerList' buffer kinds.json n.gpkg --input-crs EPSG:25832 --shape square:2 --dissolve-field l

# Attributes that a format cannot hold are reported, and --strict makes them an error. Empty and null values stay as
# they are.
expect 0 buffer kinds.json kinds.shp --input-crs EPSG:25832 --shape square:2
says err 'field l: String instead of IntegerList'
refused 1 'losses (--strict)' buffer kinds.json n.shp --input-crs EPSG:25832 --shape square:2 --strict
layer odd.gpkg odd GEOMETRY <<'CSV'
WKT,a
"POLYGON ((0 0, 1 0, 1 1, 0 0))",1
"LINESTRING (0 0, 5 5)",2
CSV
expect 0 buffer odd.gpkg odd.shp --shape square:2 --stats -
says err '1 features are not polygons'
ogr2ogr -lco GEOMETRY_NULLABLE=NO full.gpkg odd.gpkg
expect 0 buffer full.gpkg null.gpkg -l odd --shape square:2 --stats -
jq -e '.max_deviation == 0' out >/dev/null || fail "a feature without geometry reads back differently: $(cat out)"
expect 0 buffer eroded.gpkg still.gpkg -l halls --shape square:4 --stats -
same "$(jq -c '[.features,.empty]' out)" '[4,2]'
same "$(ogrinfo -ro -q still.gpkg halls | grep -c EMPTY)" 2 "what was empty"

# The result is the same for every number of threads, and valid.
text() { ogr2ogr -f CSV /vsistdout/ "$1" "$2" -lco GEOMETRY=AS_WKT; }
valid() { ogrinfo -ro -q -dialect sqlite -sql "SELECT min(ST_IsValid(geom)) AS v FROM $2 WHERE NOT ST_IsEmpty(geom)" "$1" 2>/dev/null | sed -n 's/.*v (.*) = //p'; }
for operation in dilate erode open close; do
    expect 0 buffer "$town" one.gpkg --overwrite -l buildings --operation $operation --shape disc:2:12 --threads 1
    expect 0 buffer "$town" many.gpkg --overwrite -l buildings --operation $operation --shape disc:2:12 --threads 5 --degenerate
    text one.gpkg buildings >one.csv
    text many.gpkg buildings >many.csv
    [ "$(wc -l <one.csv)" -gt 100 ] && cmp -s one.csv many.csv || fail "$operation differs between threads"
    expect 0 buffer "$town" set.gpkg --overwrite -l buildings --operation $operation --shape 'POLYGON ((0 0, 5 1, 1 2, 0 6))' --dissolve
    for file in one set; do
        case $(valid $file.gpkg buildings) in 0) fail "$operation: GEOS finds $file invalid" ;; 1) ;; *) echo "not tested with GEOS" ;; esac
    done
done

# --align: the shape is turned to the walls of each feature, so that a rectangle stays one. With --dissolve it is turned
# for each block: parts that are not connected have different directions.
layer turned.gpkg turned POLYGON <<'CSV'
WKT,a
"POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))",1
"POLYGON ((100 0, 108 6, 102 14, 94 8, 100 0))",2
"POLYGON ((112 9, 120 15, 114 23, 106 17, 112 9))",3
"POLYGON ((200 0, 216 12, 213 16, 201 7, 195 15, 191 12, 200 0))",4
"POLYGON ((300 0, 310 0, 305 9, 300 0))",5
CSV
for operation in dilate erode open close; do
    expect 0 buffer turned.gpkg $operation.json --lco COORDINATE_PRECISION=9 --operation $operation --shape square:2 --align -q
done
# Newer versions of jq print 1.0 as it was written, unless it is used in an arithmetic expression.
ring() { jq -c ".features[$2].geometry.coordinates[0] | map(map(. + 0))" "$1"; }
same "$(ring dilate.json 0)" '[[-1,-1],[11,-1],[11,11],[-1,11],[-1,-1]]'
same "$(ring dilate.json 1)" '[[92.6,8.2],[99.8,-1.4],[109.4,5.8],[102.2,15.4],[92.6,8.2]]'
same "$(ring erode.json 1)" '[[95.4,7.8],[100.2,1.4],[106.6,6.2],[101.8,12.6],[95.4,7.8]]'
same "$(ring open.json 1)" '[[94,8],[100,0],[108,6],[102,14],[94,8]]'
same "$(ring open.json 3)" '[[191,12],[200,0],[216,12],[213,16],[201,7],[195,15],[191,12]]'
for feature in 0 1 2 3 4; do
    same "$(ring close.json $feature)" "$(ogr2ogr -f GeoJSON /vsistdout/ turned.gpkg -lco COORDINATE_PRECISION=9 | jq -c "[.features[$feature].geometry.coordinates[0] | map(map(. + 0)) | (min as \$m | index([\$m])) as \$i | (.[\$i:-1] + .[:\$i])[] ] | . + [.[0]]")"
done
# Two parallel houses, 5 apart, are merged by a square of 5.1 that is turned to them, and not by one of 4.9.
expect 0 buffer turned.gpkg merged.json --lco COORDINATE_PRECISION=9 --operation close --shape square:5.1 --align --dissolve -q
same "$(jq -c '.features[0].geometry.coordinates | map(.[0] | length - 1)' merged.json)" '[4,4,6,3]'
expect 0 buffer turned.gpkg apart.json --lco COORDINATE_PRECISION=9 --operation close --shape square:4.9 --align --dissolve -q
same "$(jq -c '.features[0].geometry.coordinates | map(.[0] | length - 1)' apart.json)" '[4,4,4,6,3]'

# Rounding makes polygons of one feature overlap if they shared a corner, or were nearer than a unit in the last place.
layer near.gpkg near MULTIPOLYGON <<'CSV'
WKT,a
"MULTIPOLYGON (((0.2 0.5, 0.4 0.5, 0.4 1, 0.2 1, 0.2 0.5)), ((0 0, 0.2 0, 0.2 0.1, 0.1 0.1, 0.1 0.30000000000000004, 0 0.30000000000000004, 0 0)), ((0.7000000000000001 0, 0.9 0, 0.7000000000000001 0.2, 0.7000000000000001 0)), ((0.4 0, 0.6000000000000001 0, 0.6000000000000001 0.4, 0.4 0.4, 0.4 0)))",1
CSV
layer far.gpkg far MULTIPOLYGON <<'CSV'
WKT,a
"MULTIPOLYGON (((10000000.4 10000000.5, 10000000.5 10000000.5, 10000000.4 10000000.9, 10000000.4 10000000.5)), ((10000000.8 10000000.6, 10000000.9 10000000.6, 10000000.9 10000000.7, 10000000.9 10000000.7, 10000000.9 10000000.8, 10000000.8 10000000.8, 10000000.8 10000000.6)), ((10000000.8 10000000.7, 10000001.1 10000000.7, 10000001.1 10000001.2, 10000000.8 10000001.2, 10000000.8 10000000.7)), ((10000000.1 10000000.6, 10000000.2 10000000.6, 10000000.2 10000001.1, 10000000.1 10000001.1, 10000000.1 10000000.6)))",1
CSV
expect 0 buffer near.gpkg near_out.gpkg --stats near.json \
    --shape 'MULTIPOLYGON (((0 0, 0.1 0, 0 0.1)), ((0.30000000000000004 0, 0.4 0, 0.4 0.1)))'
expect 0 buffer far.gpkg far_out.gpkg --shape square:0.30000000000000004 --stats far.json
for each in near far; do
    jq -e '.rounded_again > 0 and .max_deviation > 0' $each.json >/dev/null || fail "$each: nothing is rounded again: $(cat $each.json)"
    case $(valid ${each}_out.gpkg $each) in 0) fail "GEOS finds $each invalid" ;; 1) ;; *) echo "not tested with GEOS" ;; esac
done

# Areas of round buffers lie between those for a polygon inside the disc and for one around it; the union of squares
# computed by GEOS has the same area as ours.
# shellcheck disable=SC2016
area() { ogrinfo -ro -q -dialect sqlite -sql "$2" "$1" 2>/dev/null | sed -n 's/.*a (Real) = //p'; }
expect 0 buffer "$town" in.gpkg -l buildings --shape inside-disc:3 --stats in.json
expect 0 buffer "$town" out.gpkg -l buildings --shape disc:3 --stats out.json
inside=$(jq .area in.json) outside=$(jq .area out.json)
round=$(area "$town" 'SELECT sum(ST_Area(ST_Buffer(geom, 3, 200))) AS a FROM buildings')
if [ -n "$round" ]; then
    awk -v i="$inside" -v r="$round" -v o="$outside" 'BEGIN { exit !(i < r && r < o && o - i < 0.01 * r) }' ||
        fail "the round buffers' area $round is not between $inside and $outside"
    expect 0 buffer "$town" each.gpkg -l buildings --shape square:6
    expect 0 buffer "$town" united.gpkg -l buildings --shape square:6 --dissolve --stats united.json
    theirs=$(area each.gpkg 'SELECT ST_Area(ST_Union(geom)) AS a FROM buildings')
    awk -v a="$theirs" -v b="$(jq .area united.json)" 'BEGIN { d = a - b; exit !(d * d < 1e-18 * a * a) }' ||
        fail "dissolved: GEOS has $theirs, not $(jq .area united.json)"
else
    echo "not tested: GEOS areas, since this GDAL is without SpatiaLite"
fi

# A shape from a data source: the union of all polygons of its layer. --where and --bbox select features of the input,
# not of the shape.
layer stamp.gpkg stamp POLYGON <<'CSV'
WKT,part
"POLYGON ((-2 -2, 2 -2, 2 0, -2 0, -2 -2))",1
"POLYGON ((-2 -1, 2 -1, 2 2, -2 2, -2 -1))",2
CSV
expect 0 buffer halls.gpkg stamped.gpkg --shape stamp.gpkg --where 'rooms > 1' --bbox 0,0,70,10 --operation erode --stats -
same "$(jq -c '[.features,.area]' out)" '[2,36]'
expect 0 buffer halls.gpkg squared.gpkg --shape square:4 --where 'rooms > 1'
expect 0 buffer halls.gpkg stamped.gpkg --overwrite --shape stamp.gpkg --where 'rooms > 1'
same "$(geometry stamped.gpkg halls 3)" "$(geometry squared.gpkg halls 3)"
ogr2ogr -a_srs EPSG:25833 zone33.gpkg stamp.gpkg
ogr2ogr -where 'part > 2' none.gpkg stamp.gpkg
refused 1 'another CRS' buffer halls.gpkg n.gpkg --shape zone33.gpkg
refused 2 'has no area' buffer halls.gpkg n.gpkg --shape none.gpkg
refused 1 'stamp.gpkg is an input' buffer halls.gpkg stamp.gpkg --shape stamp.gpkg --overwrite

# Lengths in other units, on a layer in metres; refusals.
expect 0 buffer halls.gpkg feet.gpkg --shape square:1000ft --stats -
jq -e '.area > 3 * 304 * 304' out >/dev/null || fail "feet: $(cat out)"
refused 2 '--shape is missing' buffer halls.gpkg n.gpkg
refused 2 'did you mean square:?' buffer halls.gpkg n.gpkg --shape sqare:4
refused 1 'round: no such file' buffer halls.gpkg n.gpkg --shape round
refused 2 'has no area' buffer halls.gpkg n.gpkg --shape 'POLYGON EMPTY'
refused 2 'greater than 0' buffer halls.gpkg n.gpkg --shape square:0
refused 2 'must be one of dilate|erode|open|close' buffer halls.gpkg n.gpkg --shape square:1 --operation grow
refused 2 'give one of them' buffer halls.gpkg n.gpkg --shape square:1 --dissolve --dissolve-field name
refused 1 'no field nam' buffer halls.gpkg n.gpkg --shape square:1 --dissolve-field nam
refused 1 'exists' buffer halls.gpkg open.gpkg --shape square:1
refused 1 'input' buffer halls.gpkg halls.gpkg --shape square:1 --overwrite
# A set that cannot be computed ends the run, even if others can be; the message names the feature.
cat >far.csv <<'CSV'
WKT,name
"POLYGON((0 0,2 0,2 2,0 0))",near
"POLYGON((1.7e308 0,1.79e308 0,1.79e308 1e307,1.7e308 0))",far
"POLYGON((0 0,2 0,2 2,0 0))",near
CSV
for threads in 1 3; do
    refused 1 'layer far, FID 2: the sum leaves the range of doubles' buffer far.csv n.gpkg --shape square:1e308 --threads $threads
done
refused 1 'the sum leaves the range of doubles' buffer far.csv n.gpkg --shape square:1e308 --dissolve
refused 1 'degrees' buffer "$town" n.gpkg -l buildings --input-crs EPSG:4326 --shape square:1
finish
