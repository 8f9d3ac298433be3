# shellcheck shell=bash disable=SC2016,SC1091
# Geometry operands: WKT, files, standard input, standard shapes, data sources.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

area() { json .result.area out; }
square='POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0))'

expect 0 sum "$square" square:1
same "$(area)" 25
expect 0 sum 'polygon((0 0,4 0,4 4,0 4))' square:1 # lower case, no closing vertex
same "$(area)" 25
expect 0 sum 'MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), EMPTY, ((9 0, 10 0, 10 1, 9 1, 9 0)))' square:1
same "$(area)" 8
expect 0 sum 'POLYGON Z ((0 0 7, 4 0 7, 4 4 7, 0 4 7, 0 0 7))' square:1
same "$(area)" 25
expect 0 sum 'POLYGONZM ((0 0 7 1, 4 0 7 1, 4 4 7 1, 0 4 7 1, 0 0 7 1))' square:1
same "$(area)" 25
expect 0 sum 'POLYGON ((0 0 7, 4 0 7, 4 4 7, 0 4 7))' square:1
same "$(area)" 25
# EWKT of PostGIS: an SRID before the WKT.
for srid in 'SRID=25832;' ' srid=0; ' 'SRID=4326;'; do
    expect 0 sum "$srid$square" square:1
    same "$(area)" 25 "$srid"
    expect 0 sum square:1 "$srid$square"
    expect 0 pair "$srid$square" "${srid}MULTIPOLYGON (((1 1, 2 1, 2 2, 1 2)))"
    same "$(json .overlap out)" true "$srid"
    expect 0 route "${srid}LINESTRING (0 0, 4 0)" --robot "${srid}POLYGON ((0 0, 1 0, 1 1, 0 1))" --from -9,-9 --to 9,9
done
echo "SRID=25832;$square" >e.wkt
expect 0 sum @e.wkt square:1
same "$(area)" 25 "EWKT in a file:"
layer srid.gpkg a POLYGON EPSG:25832 <<<'WKT,n
"POLYGON ((0 0,4 0,4 4,0 4,0 0))",1'
expect 0 buffer srid.gpkg grown.gpkg --shape "SRID=25832;$square"
expect 0 sum srid.gpkg "SRID=25832;$square"
refused 1 'P has the SRID 25832 and Q the SRID 4326' sum srid.gpkg "SRID=4326;$square"
refused 1 'P has the SRID 1 and Q the SRID 2; transform one of them first' pair "SRID=1;$square" "SRID=2;$square"
refused 1 'no such file' sum "SRID=x;$square" square:1
# A decimal of any length is read as the nearest double.
expect 0 sum --exact 'POLYGON ((0 0, 0.1 0, 0.1 0.1000000000000000055511151231257827021181583404541015625, 0 0.1))' square:1
same "$(json '.result.area' out)" "$("$SUNDER" sum --exact square:1 'POLYGON((0 0,0.1 0,0.1 0.1,0 0.1))' | json .result.area -)"
echo "$square" >p.wkt
expect 0 sum @p.wkt square:1
same "$(area)" 25
status=0
"$SUNDER" sum @- square:1 <p.wkt >out 2>err || status=$?
same "$status" 0 "@-: status"
same "$(area)" 25
refused 2 'cannot both be read' sum @- @-
refused 1 'cannot read nothing.wkt' sum @nothing.wkt square:1
refused 1 'cannot read' sum @. square:1
printf 'POLYGON ((0 0, 1 0' >half.wkt
refused 1 'the WKT ends' sum @half.wkt square:1
printf '\000POLYGON' >binary.wkt
refused 1 'not a text' sum @binary.wkt square:1

for wkt in EMPTY 'Z EMPTY'; do
    expect 0 sum "POLYGON $wkt" square:1
    same "$(json '.polygons | length' out)" 0 "empty sum"
    expect 0 pair "MULTIPOLYGON $wkt" square:1
    same "$(json .overlap out)" false
done
refused 2 'a ring of 2 points' sum 'POLYGON ((0 0, 1 1))' square:1
refused 2 'a ring of 2 points' sum 'POLYGON ((0 0, 1 1, 0 0))' square:1
refused 2 'POLYGO is not' sum 'POLYGO ((0 0, 1 0, 1 1))' square:1
refused 2 'POINT is not' sum 'POINT (1 1)' square:1
refused 2 'GEOMETRYCOLLECTION is not' sum 'GEOMETRYCOLLECTION (POLYGON ((0 0, 1 0, 1 1)))' square:1
refused 2 'expected a number' sum 'POLYGON ((0 0, 1 zero, 1 1))' square:1
refused 2 "expected ',' or ')'" sum 'POLYGON ((0 0, 1 0, 1 1) 2)' square:1
refused 2 'differ in dimension' sum 'POLYGON ((0 0, 1 0 5, 1 1))' square:1
refused 2 'expected the end' sum 'POLYGON ((0 0, 1 0, 1 1)) POLYGON EMPTY' square:1
refused 2 'expected a number' sum 'POLYGON ((0 0, nan 0, 1 1))' square:1
refused 2 'a double can hold' sum 'POLYGON ((0 0, 1e999 0, 1 1))' square:1
refused 2 'expected a number' sum 'POLYGON ((0 0, 0x1 0, 1 1))' square:1

# Rings that cross themselves are repaired, with a warning, unless the user forbids it.
bow='POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))'
expect 0 sum "$bow" square:1
same "$(grep -c '^sunder: warning: P (POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))): ' err)" 1 "warnings about a bow"
refused 2 'crosses' sum "$bow" square:1 --invalid fail

# Standard discs contain, or lie in, the true disc: pi r^2 is between their areas.
for radius in 1 3.7 1000; do
    expect 0 sum "disc:$radius" 'POLYGON ((0 0, 1e-9 0, 1e-9 1e-9))' --exact
    same "$(json .p.vertices out)" 32 "disc's vertices"
    for shape in disc inside-disc; do
        for n in 3 7 32 500; do
            # S + S + S + S has 16 times the area of S, S + S has 4 times.
            expect 0 sum "$shape:$radius:$n" "$shape:$radius:$n"
            json .result.area out | tr / ' ' | awk -v r="$radius" -v s=$shape -v n=$n 'function big(t) { return t + 0 }
                { a = big($1) / (NF > 1 ? big($2) : 1) / 4; d = a - atan2(0, -1) * r * r
                  if (s == "disc" ? d <= 0 : d >= 0) exit 1
                  if (n == 500 && (d > r * r / 1000 || d < -r * r / 1000)) exit 1 }' || fail "$shape:$radius:$n has a wrong area"
        done
    done
done
expect 0 pair 'rectangle:4x2.5' square:1
same "$(json .dy out)" '-7/4'
for shape in disc:0 disc:-1 disc:1:2 disc:1:0 disc:1:x disc:nan disc:inf disc: inside-disc:0 square:0 square:-2 square:x \
             rectangle:2 rectangle:2x0 rectangle:2x rectangle:x2 disc:1:99999999999; do
    refused 2 "P ($shape): " sum "$shape" square:1
done
# A message names the operand and its fault.
refused 2 'P (disc:): the radius is missing' sum disc: square:1
refused 2 'P (square:): the side is missing' sum square: square:1
refused 2 'Q (rectangle:2x): the height is missing' pair square:1 rectangle:2x
refused 2 'Q (disc:-1): the radius, -1: negative' sum square:1 disc:-1
refused 2 'P (disc:1:): the number of segments is missing' sum disc:1: square:1
refused 2 'the name of the file is missing' sum @ square:1
refused 1 'disk:4): neither a file nor a shape; did you mean disc:?' sum disk:4 square:1
refused 2 'P (POLYGON ((0 0, 1 1))): WKT, character 19: a ring of 2 points' sum 'POLYGON ((0 0, 1 1))' square:1
refused 2 "P (POLYGON ((0 0, 1 0, 1 1), (0.11 0, 0.22 0, 0.33 ...): WKT, character" \
    sum 'POLYGON ((0 0, 1 0, 1 1), (0.11 0, 0.22 0, 0.33 a, 0.44 0))' square:1

layer two.gpkg a POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((6 0,8 0,8 4,6 4,6 0))"
X
layer two.gpkg b POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,1 0,1 1,0 1,0 0))"
X
layer two.gpkg roads LINESTRING <<'X'
id,WKT
1,"LINESTRING(0 0,1 0)"
X
expect 0 sum two.gpkg square:1 --input-layer a
same "$(json .p.polygons out) $(area)" '2 40'
expect 0 sum two.gpkg square:1 -l a --where 'id = 1'
same "$(area)" 25
expect 0 sum two.gpkg square:1m -l a # the layer's CRS is in metres
same "$(area)" 40
refused 1 'the layer has no CRS' sum square:1 square:1m
refused 1 'two.gpkg' sum two.gpkg square:1
says err a
says err b
refused 1 'roads' sum two.gpkg square:1 -l roads
refused 1 'nowhere' sum two.gpkg square:1 -l nowhere
refused 1 'no such file' sum nothing.gpkg square:1
layer other.gpkg c POLYGON EPSG:2056 <<'X'
id,WKT
1,"POLYGON((0 0,1 0,1 1,0 1,0 0))"
X
layer metres.gpkg c POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,1 0,1 1,0 1,0 0))"
X
refused 1 'different CRS' sum metres.gpkg other.gpkg
refused 1 'different CRS' pair other.gpkg metres.gpkg
refused 1 'metres.gpkg' sum square:1 metres.gpkg metres.gpkg --overwrite
cp metres.gpkg m2.gpkg
refused 1 'm2.gpkg' sum metres.gpkg m2.gpkg m2.gpkg --overwrite
expect 0 sum metres.gpkg m2.gpkg m2.gpkg --update
same "$(count m2.gpkg sum) $(count m2.gpkg c)" '1 1'
# Warnings of the driver while it reads are passed on to stderr; stdout still has only JSON.
printf 'WKT,n\n"POLYGON ((0 0,1 0,1 1,0 0))",1\n"POLYGON ((5 0,6 0,6 1,5 0))",abc\n' >odd.csv
printf 'WKT,Integer\n' >odd.csvt
for call in 'sum odd.csv square:1' 'pair odd.csv square:1' 'check odd.csv' 'separate odd.csv odd.gpkg --overwrite'; do
    # shellcheck disable=SC2086 # words
    expect 0 $call
    same "$(grep -c '^sunder: warning: .*record 2' err)" 1 "warnings about an invalid number, $call:"
done

finish
