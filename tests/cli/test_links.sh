# shellcheck shell=bash disable=SC1091
# --links: moves between links are those of the definition, computed by a script that shares nothing; links of several
# parts, without length, in another CRS, twice, or contradictory; a block has one move; what goes before links.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
oracle() { python3 "$SUNDER_SOURCE/tests/cli/links_oracle.py" "$@" || fail "links_oracle.py $*"; }
places=(--symbol square:0.001 --allow-jumps -q --overwrite --no-styles --layers main)

for world in $(seq 0 $((10 * ${SUNDER_TEST_SCALE:-1}))); do
    radius=$(oracle make "$world")
    within=(--links-radius "$radius")
    [ "$radius" != no ] || within=()
    expect 0 separate places.geojson out.gpkg "${places[@]}" --links links.geojson "${within[@]}" --allow-inexact-output
    same "$(oracle compare "$world" out.gpkg "$radius")" '' "world $world, radius $radius:"
done

lines() { # FILE WKT...
    rm -f "$1"
    { echo id,WKT && for wkt in "${@:2}"; do echo "1,\"$wkt\""; done; } | layer "$1" links LINESTRING 2>/dev/null
}
moves() { python3 -c "import sqlite3,sys
print(*('%.9g,%.9g' % row for row in sqlite3.connect(sys.argv[1]).execute('SELECT sunder_dx, sunder_dy FROM houses')))" "$1"; }
printf 'id,px,WKT\n1,,"POLYGON((0 0,2 0,2 2,0 2,0 0))"\n2,0.5,"POLYGON((40 0,42 0,42 2,40 2,40 0))"\n3,,"POLYGON((42 0,44 0,44 2,42 2,42 0))"\n' |
    layer houses.gpkg houses POLYGON
# 2 and 3 are a block, which has the mean of what its houses prefer, 5.0 and 5.2.
lines links.gpkg 'LINESTRING(1 1,1 2)' 'LINESTRING(101 1,101 12)'
expect 0 separate houses.gpkg out.gpkg -q --overwrite --links links.gpkg
same "$(moves out.gpkg)" '0,1 0,5.1 0,5.1' 'a block:'
expect 0 separate houses.gpkg out.gpkg -q --overwrite --links links.gpkg --links-radius 50m
same "$(moves out.gpkg)" '0,1 0,1.832 0,1.832' 'a block beside the radius:'
# A field goes before links, and so does an earlier result.
expect 0 separate houses.gpkg out.gpkg -q --overwrite --links links.gpkg --prefer-dx px --prefer-dy px
same "$(moves out.gpkg)" '0,1 0.25,2.85 0.25,2.85' 'a field and links:'
expect 0 separate houses.gpkg before.gpkg -q --prefer-dx px --prefer-dy px --where 'id = 1'
expect 0 separate houses.gpkg out.gpkg -q --overwrite --links links.gpkg --previous before.gpkg
same "$(moves out.gpkg)" '0,0 0,5.1 0,5.1' 'an earlier result and links:'
# The moves of a result are links themselves.
expect 0 separate houses.gpkg again.gpkg -q --links links.gpkg
expect 0 separate houses.gpkg out.gpkg -q --overwrite --links again.gpkg,layer=houses_displacement
same "$(moves out.gpkg)" '0,1 0,5.1 0,5.1' 'links of a result:'
# In another CRS, to a millimetre.
ogr2ogr -t_srs EPSG:4326 far.gpkg links.gpkg links -nln far 2>/dev/null || fail "cannot make far.gpkg"
expect 0 separate houses.gpkg out.gpkg -q --overwrite --links far.gpkg
python3 -c "import sys; assert all(abs(float(a) - b) < 0.001 for a, b in zip(' '.join(sys.argv[1:]).replace(',', ' ').split(), (0, 1, 0, 5.1, 0, 5.1)))" \
    "$(moves out.gpkg)" || fail "links in another CRS: $(moves out.gpkg)"

lines none.gpkg
expect 0 separate houses.gpkg out.gpkg --overwrite --links none.gpkg
says err 'it has no lines, so nothing prefers another place'
lines torn.gpkg 'LINESTRING(1 1,1 2)' 'LINESTRING(5 5,6 6)' 'LINESTRING(1 1,1 3)'
refused 1 'FID 1 and FID 3 start at one place and end at different ones' separate houses.gpkg never.gpkg --links torn.gpkg
refused 1 'no such file' separate houses.gpkg never.gpkg --links missing.gpkg
refused 1 'choose one with --links DATASET,layer=NAME' separate houses.gpkg never.gpkg --links again.gpkg
refused 1 'layer' separate houses.gpkg never.gpkg --links again.gpkg,layer=nothing
refused 2 'must be above 0' separate houses.gpkg never.gpkg --links links.gpkg --links-radius 0
refused 2 'needs --links' separate houses.gpkg never.gpkg --links-radius 5
refused 2 'not with --proof' separate houses.gpkg never.gpkg --links links.gpkg --proof p
refused 1 '' separate houses.gpkg links.gpkg --links links.gpkg --overwrite
finish
