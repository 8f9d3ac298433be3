# shellcheck shell=bash disable=SC1091
# Tests a page of --report in headless Chromium: what it draws, how it reacts to a reader's actions, and that it makes
# no requests and has no errors. The test does not depend on fonts. One picture, of the map alone, is compared with the
# recorded one (town_before.png), within the differences that smoothing of edges may cause.
set -u
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    { echo "skipped: chromium is not installed"; exit 77; }
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=1700000000
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg

layer two.gpkg squares POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((2 0,6 0,6 4,2 4,2 0))"
X
expect 0 separate two.gpkg two_out.gpkg --report two.html -q
expect 3 separate "$town" town_out.gpkg -l buildings --gap 3 --max-shift 5 --fixed-where "kind = 'monument'" --id-field id \
    --report town.html --stats town.json -q
# A town with many blocked features beside its roads, with lengths on paper.
"$SUNDER_BUILD/sunder-town" --buildings 1500 --seed 5 quarter_in.gpkg >/dev/null || fail "the layer quarter cannot be made"
expect 3 separate quarter_in.gpkg quarter.gpkg -l buildings --scale 25000 --gap 0.2mm --max-shift 1 --effort 0 \
    --barrier quarter_in.gpkg,layer=roads,width=0.3mm,gap=0.1mm --report quarter.html --stats quarter.json -q
ogr2ogr -f GeoJSON -lco COORDINATE_PRECISION=6 -lco RFC7946=NO town.geojson town_out.gpkg buildings || fail "no GeoJSON"

python3 - <<'P' || fail "cannot make the hostile layer"
import json
name = "</script><script>window.hit = 1</script>\"'><img src=x onerror=\"window.hit = 1\"><!--"
open("evil.txt", "w", encoding="utf-8").write(name)
square = lambda x: {"type": "Polygon", "coordinates": [[[x, 0], [x + 4, 0], [x + 4, 4], [x, 4], [x, 0]]]}
ids = ["<img src=x onerror='window.hit = 1'>", "\" onmouseover=\"window.hit = 1", "</td></table><script>window.hit = 1</script>"]
json.dump({"type": "FeatureCollection", "name": name,
           "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
           "features": [{"type": "Feature", "id": k + 1, "properties": {"id": id}, "geometry": square(x)}
                        for k, (x, id) in enumerate(zip([0, 3, 7.5], ids))]}, open("evil.geojson", "w"))
P
expect 3 separate evil.geojson evil.gpkg --gap 3 --max-shift 0.1 --id-field id --report evil.html --output-layer fine -q

expect 0 separate "$town" lone.gpkg -l buildings --where 'fid = 1' --gap 3 --report lone.html -q
expect 0 separate "$town" none.gpkg -l buildings --where 'fid < 0' --gap 3 --report none.html -q
expect 3 separate "$town" roads.gpkg -l buildings --where 'fid <= 60' --max-shift 1 --barrier "$town,layer=roads,width=13" \
    --report roads.html -q
# Two houses. One of them is on a road that it cannot leave.
layer under.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
2,"POLYGON((30 0,40 0,40 10,30 10,30 0))"
X
layer way.gpkg way LINESTRING <<'X'
id,WKT
1,"LINESTRING(-20 5,20 5)"
X
expect 3 separate under.gpkg under_out.gpkg --max-shift 1 --barrier way.gpkg,width=3 --report under.html -q
# Of two houses with a common wall and two others, one is hidden, and one becomes smaller.
layer near.gpkg houses POLYGON <<'X'
WKT,name,class
"POLYGON((0 0,10 0,10 10,0 10,0 0))",left,1
"POLYGON((10 0,20 0,20 10,10 10,10 0))",right,1
"POLYGON((0 -12,8 -12,8 -2,0 -2,0 -12))",rigid1,0
"POLYGON((17 5,24 5,24 9,17 9,17 5))",rigid2,0
X
expect 0 separate near.gpkg smaller_out.gpkg --gap 3 --max-shift 0 --rows no --touch-tolerance 0 --inset 1,2 \
    --rigid-where "name LIKE 'rigid%'" --hierarchy-field class --hide --id-field name --report smaller.html -q
layer far.gpkg far POLYGON <<'X'
id,WKT
1,"POLYGON((-1e300 -1e300,1e300 -1e300,1e300 1e300,-1e300 -1e300))"
2,"POLYGON((1e-300 0,2e-300 0,2e-300 1e-300,1e-300 0))"
X
expect 0 separate far.gpkg far_out.gpkg --report degenerate.html -q
layer points.gpkg shops POINT <<'X'
id,WKT
1,"POINT(0 0)"
2,"POINT(1 0)"
X
expect 0 separate points.gpkg shifted.gpkg --symbol disc:2 --gap 1 --no-blocks --report points.html -q
"$SUNDER_BUILD/sunder-town" --buildings 20000 --seed 3 many.gpkg >/dev/null || fail "no large town"
run separate many.gpkg many_out.gpkg -l buildings --gap 2 --max-shift 4 --report many.html -q --layers main
[ "$(wc -c <many.html)" -lt 4000000 ] || fail "the page of 20,000 buildings has $(wc -c <many.html) bytes"

timeout 240 python3 "$here/page.py" "$chromium" "$work/profile" "$work" || fail "a test in the browser failed"
[ -z "${SUNDER_BUILD:-}" ] || cp town_before.png "$SUNDER_BUILD/browser_town_before.png" 2>/dev/null
finish
