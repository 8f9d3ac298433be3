# shellcheck shell=bash disable=SC1091
# sunder sum: keys and their order, canonical rings, exact numbers, degenerate holes, layers.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

ell='POLYGON ((0 0, 3 0, 3 1, 1 1, 1 3, 0 3, 0 0))'
frame='POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (3 3, 7 3, 7 7, 3 7, 3 3))'

keys='["command","algorithm","decomposition","order","p","q","result","operations","seconds","peak_rss_bytes"'
expect 0 sum "$ell" square:2
[ ! -s err ] || fail "stderr is not empty"
same "$(json 'keys_unsorted' out | tr -d ' \n')" "$keys,\"polygons\",\"degenerate_segments\",\"degenerate_points\"]"
same "$(jq -c '.p,.q,.result' out | tr '\n' ' ')" '{"polygons":1,"vertices":6} {"polygons":1,"vertices":4} {"polygons":1,"holes":0,"vertices":6,"degenerate_segments":0,"degenerate_points":0,"area":"21","max_deviation":null} '
same "$(jq -c '.operations|keys_unsorted' out)" '["comparisons","orientation_tests","segment_intersections","exact_fallbacks","phases"]'
same "$(jq -c '.seconds|keys_unsorted' out)" '["read","decompose","subsums","union","write","compute","total"]'
same "$(jq -c '[.command,.algorithm,.decomposition,.order]' out)" '["sum","convolution",null,null]'
same "$(jq -c '.polygons' out)" '[{"outer":[[-1,-1],[4,-1],[4,2],[2,2],[2,4],[-1,4]],"holes":[]}]'

# The time from doubles in memory to the finished sum: it includes the construction of the shapes, also for a layer and
# for -Q.
printf 'WKT,n\n"%s",1\n' "$ell" | layer ell.gpkg ell POLYGON
for call in "sum @ell.wkt square:2" "sum @ell.wkt @ell.wkt --reflect" "sum ell.gpkg disc:2"; do
    echo "$ell" >ell.wkt
    # shellcheck disable=SC2086 # words
    expect 0 $call --stats -
    jq -e '.seconds | .decompose > 0 and .compute >= .decompose and .total >= .compute and .read >= 0' out >/dev/null ||
        fail "$call: $(jq -c .seconds out)"
done

expect 0 sum "$ell" square:2 --stats -
same "$(json 'keys_unsorted' out | tr -d ' \n')" "$keys]" "--stats -"
expect 0 sum "$ell" square:2 --stats s.json --algorithm auto --seed 7
same "$(json 'keys_unsorted' s.json | tr -d ' \n')" "$keys]" "--stats FILE"
same "$(jq -c '.polygons|length' out)" 1

# A peg that fits its hole exactly, and a passage exactly as wide as the robot.
expect 0 sum "$frame" square:4
same "$(jq -c '.degenerate_points' out)" '[[5,5]]'
expect 0 sum --reflect --exact 'POLYGON ((0 0, 9 0, 9 9, 5 9, 5 3, 4 3, 4 9, 0 9, 0 0))' 'POLYGON ((0 0, 1 0, 1 1, 0 1))'
same "$(jq -c '.degenerate_segments' out)" '[[["4","3"],["4","9"]]]' "the slide"
expect 0 sum 'POLYGON ((0 0, 2 0, 0 1))' 'POLYGON ((0 0, 2 0, 0 1))' --reflect
same "$(jq -c '.result.area' out)" '"6"'

# Rationals in lowest terms, as strings; decimals that read back exactly.
expect 0 sum --exact 'POLYGON ((0 0, 0.1 0, 0 0.5))' 'POLYGON ((0 0, 1 0, 0 1))'
same "$(jq -c '.polygons[0].outer[1]' out)" '["39631676720860365/36028797018963968","0"]'
expect 0 sum 'POLYGON ((0 0, 0.1 0, 0 0.5))' 'POLYGON ((0 0, 1 0, 0 1))'
same "$(sed -n 's/.*"outer": \[\[0, 0\], \[\([^]]*\)\].*/\1/p' out)" '1.1, 0'

# Beyond the range of doubles: an error for decimals and layers, fine with --exact.
huge='POLYGON ((0 0, 1.7e308 0, 1.7e308 1.7e308, 0 1.7e308))'
refused 1 'range of doubles' sum "$huge" "$huge"
refused 1 'range of doubles' sum "$huge" "$huge" o.gpkg
expect 0 sum --exact "$huge" "$huge"
same "$(jq -r '.polygons[0].outer[2][0]|length' out)" 309 "digits of 3.4e308"
expect 0 sum "$huge" "$huge" --stats -

# Output as layers, with their deviation: all layers are written, empty ones too.
expect 0 sum "$frame" square:4 o.gpkg --stats o.json
[ ! -s out ] || fail "something on stdout besides the layers"
same "$(count o.gpkg sum) $(count o.gpkg sum_degenerate_segments) $(count o.gpkg sum_degenerate_points)" '1 0 1'
same "$(geometry o.gpkg sum_degenerate_points 1)" '  POINT (5 5)'
same "$(jq -c '.result.max_deviation' o.json)" 0
expect 0 sum "$frame" "POLYGON ((0.1 0.1, 1.3 0.2, 0.7 1.1))" o.gpkg -overwrite -nln obstacle --stats o.json
same "$(count o.gpkg obstacle) $(count o.gpkg obstacle_degenerate_points) $(count o.gpkg sum)" '1 0 1'
jq -e '.result.max_deviation > 0 and .result.max_deviation < 4e-15' o.json >/dev/null || fail "max_deviation: $(jq -c .result o.json)"
refused 1 'o.gpkg' sum "$frame" square:4 o.gpkg
expect 0 sum "$frame" square:4 /vsistdout/ --of GeoJSON
same "$(jq -r '.features[0].geometry.type' out)" Polygon
expect 0 sum "$frame" square:4 o.shp
for f in o.shp o_degenerate_segments.shp o_degenerate_points.shp; do [ -s $f ] || fail "no $f"; done

# Sums that rounding would make invalid (vertices in the middle of an edge, slivers thinner than an ulp): the written
# layer is valid. GEOS checks this, through the SQL of GDAL; without GEOS only the program's own check is used.
p1='MULTIPOLYGON (((0.9 0.9,2.9 1.4,1.1 0.7)),((2.7 2.6,1.8 2.9,1.2 1.7)),((0.5 2.6,2.7 3,0.8 1.8)),((2.9 2.2,0.4 1.1,2.2 1.8)),'
p1+='((0.8 0.6,1.3 1.9,0.6 1.2)),((0.2 2.1,2.4 0.6,0.2 0.1)),((2.6 2.7,0.4 3,1.8 1.6)),((1 2.7,2 2.4,2.4 2.7)))'
q1='MULTIPOLYGON (((0.6 0.4,0 0.3,0.3 0.3)),((0.3 0.7,0.5 0,0.1 0.7)),((0.3 0.7,0.4 0.1,0.7 0.2)),((0.3 0.4,0.7 0.3,0.7 0.1)))'
p2='MULTIPOLYGON (((0.2 0.5,0.4 2.8,2.7 0.4)),((2.6 1.7,0.9 1.7,1.8 1.1)),((0.3 0.1,0.4 1.9,2.3 0.7)),((0.9 1.6,2.1 0.5,1.4 1.3)),'
p2+='((0.4 0.2,2.4 1,2.5 1.8)),((2.3 2.2,1.7 0.3,1.5 2.1)),((2.4 0.7,0.9 1.7,1.4 0.9)),((1.7 1.4,0.6 2,2.5 2.7)),'
p2+='((2.4 0.2,2.5 1.5,0 1)),((2.4 2.4,2.7 1.5,1.9 0.7)),((2.9 0.6,1.6 0.6,2.6 1)),((2.3 2.5,2.1 1.2,1.1 0.9)))'
q2='MULTIPOLYGON (((0.1 0.6,0.6 0.7,0.1 0.7)),((0.8 0.5,0.5 0.2,0.4 0.6)))'
valid() { ogrinfo -q v.gpkg -dialect sqlite -sql 'SELECT min(ST_IsValid(geom)) AS valid FROM sum' 2>/dev/null | sed -n 's/.*valid.* = //p'; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { d = a - b; exit !(d * d < 1e-20 * b * b) }'; }
for case in "$p1|$q1" "$p2|$q2"; do
    expect 0 sum "${case%|*}" "${case#*|}" v.gpkg --overwrite --stats v.json
    jq -e '.result.max_deviation < 1e-14' v.json >/dev/null || fail "max_deviation $(jq .result.max_deviation v.json)"
    case $(valid) in 0) fail "GEOS finds the layer invalid" ;; 1) ;; *) echo "not tested with GEOS, since this GDAL is without it" ;; esac
    # The layer is also accepted as a source without repair, and has the area of the exact sum.
    expect 0 sum v.gpkg 'POLYGON EMPTY' --invalid fail
    area=$(ogrinfo -q v.gpkg -dialect sqlite -sql 'SELECT sum(ST_Area(geom)) AS area FROM sum' 2>/dev/null | sed -n 's/.*area.* = //p')
    # The exact area has hundreds of digits: numerator and denominator are cut by the same number of digits, so that the
    # denominator keeps thirty.
    exact=$(jq -r .result.area v.json | tr / ' ' | awk '{ k = length($2) - 30; if (k < 0) k = 0
        printf "%.17g", substr($1, 1, length($1) - k) / substr($2, 1, length($2) - k) }')
    [ -z "$area" ] || near "$area" "$exact" || fail "the layer has the area $area, the sum $exact"
done
finish
