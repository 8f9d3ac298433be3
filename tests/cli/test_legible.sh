# shellcheck shell=bash disable=SC1091
# check --spec with "legible": features that are too narrow or too small, have a neck, an inner gap or a short edge. The
# values are known by construction: the value itself passes, and the next double does not.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=0

cat >f.geojson <<'JSON'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}, "features": [
{"type": "Feature", "id": 1, "properties": {"name": "two rooms"}, "geometry": {"type": "Polygon", "coordinates": [[
  [0, 0], [10, 0], [10, 4.5], [16, 4.5], [16, 0], [26, 0], [26, 10], [16, 10], [16, 5.5], [10, 5.5], [10, 10], [0, 10], [0, 0]]]}},
{"type": "Feature", "id": 2, "properties": {"name": "parts"}, "geometry": {"type": "MultiPolygon", "coordinates": [
  [[[40, 0], [52, 0], [40, 9], [40, 0]]], [[[60, 0], [68, 0], [68, 2], [60, 2], [60, 0]]]]}},
{"type": "Feature", "id": 3, "properties": {"name": "bow tie"}, "geometry": {"type": "Polygon", "coordinates": [[
  [80, 0], [84, 4], [84, 0], [80, 4], [80, 0]]]}},
{"type": "Feature", "id": 4, "properties": {"name": "nothing"}, "geometry": null},
{"type": "Feature", "id": 5, "properties": {"name": "ignored"}, "geometry": {"type": "Polygon", "coordinates": [[
  [90, 0], [91, 0], [91, 1], [90, 1], [90, 0]]]}}]}
JSON
# sheet JSON [FILTER]: writes sheet.json with "legible": JSON
sheet() {
    jq -n --argjson legible "$1" '{scale: 2000, legible: $legible, layers: [{name: "f", source: "f.geojson", role: "move",
        ignore_where: "name = '\''ignored'\''"}]}' | jq "${2:-.}" >sheet.json
}
# found STATUS: the rows of check as FID KIND HAS
found() {
    expect "$1" check --spec sheet.json -q --id-field name "${@:2}"
    cut -f 1,7,9 out | tr '\t\n' ' ;'
}

# ---- Each measure, at its value and one unit in the last place above it
tie() { # KEY VALUE ABOVE ROWS
    sheet "{\"$1\": $2}"
    same "$(found 0)" '' "$1 $2:"
    sheet "{\"$1\": $3}"
    same "$(found 3)" "$4" "$1 $3:"
}
tie neck 1 1.0000000000000002 '1 neck 1;'
tie inner_gap 6 6.000000000000001 '1 inner_gap 6;'
tie area 4 4.000000000000001 '3 small 4;3 small 4;'
tie edge 2 2.0000000000000004 '2 short_edge 2;'
sheet '{"width": 2}' '.layers[0].legible.width = 1.5'
same "$(found 0)" '' 'a value of the layer overrides that of the sheet:'
sheet '{"width": 2, "edge": 0}'
same "$(found 3 | sed 's/1\.6568[0-9]*/1.6568/g')" '3 narrow 1.6568;3 narrow 1.6568;' 'widths of parts:'
sheet '{"width": 2.0000000000000004}'
same "$(found 3 | grep -o '2 narrow [0-9.]*')" '2 narrow 2' 'the rectangle is 2 wide:'
sheet '{"width": 6}' '.layers[0].ignore_where = "name in ('\''bow tie'\'', '\''ignored'\'')"'
same "$(found 3)" '2 narrow 2;' 'the triangle has a disc of the diameter 6:'
sheet '{"width": 6.000000000000001}' '.layers[0].ignore_where = "name in ('\''bow tie'\'', '\''ignored'\'')"'
same "$(found 3 | cut -c 1-16)" '2 narrow 5.99999' 'and none that is larger:'

# ---- Lengths and areas of the sheet: at 1:2000 1 mm is 2 m, and 1 mm2 is 4 m2
sheet '{"area": "1mm2", "neck": "0.5mm"}'
same "$(found 0)" '' 'lengths of the sheet:'
sheet '{"area": "4.1m2", "neck": "0.6mm"}'
same "$(found 3)" '1 neck 1;3 small 4;3 small 4;' 'and longer ones:'

# ---- Counts, columns, the layer
expect 3 check --spec sheet.json --stats stats.json --output found.gpkg
same "$(jq -c '[.legible, .features, .null, .invalid]' stats.json)" '[{"small":2,"neck":1},5,1,1]' 'statistics:'
same "$(tail -n 1 out)" 'legible: small 2, neck 1' 'the summary:'
ogr2ogr -f CSV found.csv found.gpkg f_conflicts -lco GEOMETRY=AS_WKT
same "$(sed 's/\.0//g' found.csv | head -n 2 | tail -n 1)" '"LINESTRING (10 4.5,10 5.5)","1",,,,,,neck,,1,,,1.2,,,,,' 'the layer:'
expect 0 check --spec sheet.json --allow-conflicts
ogr2ogr -q other.gpkg f.geojson -nln moved
expect 3 check --spec sheet.json other.gpkg -q
same "$(cut -f 7 out | sort | uniq -c | tr -s ' \n' ' ')" ' 1 neck 2 small ' 'a layer that another program wrote:'
sheet '{"area": "4.1m2"}'
expect 0 check --spec sheet.json --print-spec
same "$(jq -c .legible out)" '{"area":"4.1m2"}' 'the effective sheet:'

# ---- The page: the worst first, pictures of both features or of one, nothing from elsewhere
sheet '{"area": "4.1m2", "neck": "0.6mm"}' '.layers[0].gap = 15'
expect 3 check --spec sheet.json --report page.html -q
same "$(sed -n 's/.*<\/svg><\/td><td>\([a-z ]*\)<.*/\1/p' page.html | tr '\n' ';')" 'too close;neck;too close;too small;too small;' 'the page:'
same "$(grep -oE 'class="(shape|link)"' page.html | cut -c 8 | tr -d '\n')" sslslsslslsl 'pictures:'
grep -q 'layer f, FID 3' page.html || fail "the page does not name its features"
grep -qE 'src=|href=|url\(|<script' page.html && fail "the page loads something"
cp page.html first.html
expect 3 check --spec sheet.json --report page.html -q
cmp -s page.html first.html || fail "the page is not the same again"

# ---- Other commands pass it over; symbols have a size; lines have none
sheet '{"area": 100}'
expect 0 separate --spec sheet.json a.gpkg -q
sheet '{}' 'del(.legible)'
expect 0 separate --spec sheet.json b.gpkg -q
cmp -s a.gpkg b.gpkg || fail "separate does something else with least sizes"
cat >p.geojson <<'JSON'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}, "features": [
{"type": "Feature", "id": 1, "properties": {}, "geometry": {"type": "Point", "coordinates": [0, 0]}}]}
JSON
sheet '{"area": 6, "width": 2, "neck": 2}' '.layers[0] |= {source: "p.geojson", role: "move", symbol: "rectangle:3x2"}'
expect 0 check --spec sheet.json -q
sheet '{"area": 6.000000000000001, "width": 2.0000000000000004}' \
    '.layers[0] |= {source: "p.geojson", role: "move", symbol: "rectangle:3x2"}'
expect 3 check --spec sheet.json -q
same "$(cut -f 7,9 out | tr '\t\n' ' ;')" 'narrow 2;small 6;' 'a symbol that is too small:'

# ---- What is wrong
wrong() { # WORDS LEGIBLE [FILTER]
    sheet "$2" "${3:-.}"
    expect "${4:-2}" check --spec sheet.json
    grep -qF -- "$1" err || fail "$2: $(cat err)"
}
wrong 'legible: there is no key widht, did you mean width?' '{"widht": 1}'
wrong 'legible: must be an object' '3'
wrong 'legible.area: 3mm: not an area' '{"area": "3mm"}'
wrong 'legible.area: 3furlong2: unknown unit' '{"area": "3furlong2"}'
wrong 'legible.neck: -1: negative' '{"neck": -1}'
wrong 'layers[0].legible.edge: must be a text or a number' '{}' '.layers[0].legible.edge = [1]'
wrong 'legible.width: mm are measured on the sheet' '{"width": "1mm"}' 'del(.scale)' 1
finish
