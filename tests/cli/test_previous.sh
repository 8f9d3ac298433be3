# shellcheck shell=bash disable=SC1091
# --previous: the same layer again gives the same bytes; next month only groups with a change move; a house beside one
# that is gone or was edited goes back, unless --previous-relax no. By key and by FID; for points, too. What was edited is
# found in all formats. What is wrong is refused.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=0
town() { python3 "$SUNDER_SOURCE/tests/cli/previous_town.py" "$@" || fail "previous_town.py $1"; }
make() { # FILE: from FILE.csv
    ogr2ogr "$1.gpkg" "$1.csv" -nln town -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=WKT -oo KEEP_GEOM_COLUMNS=NO \
        -oo AUTODETECT_TYPE=YES 2>/dev/null || fail "cannot make $1.gpkg"
}
previous() { python3 -c "import json,sys; print(*(json.load(open('$1'))['previous'][k] for k in sys.argv[1:]))" "${@:2}"; }
town make now.csv next.csv
make now
make next
options=(--gap 2 --id-field id --overwrite -q)

# There are no forces between houses that stand where they prefer to, so LAYER_pushes is left out.
expect 0 separate now.gpkg first.gpkg "${options[@]}" --layers main,displacement,conflicts
expect 0 separate now.gpkg again.gpkg "${options[@]}" --layers main,displacement,conflicts --previous first.gpkg --stats again.json
cmp -s first.gpkg again.gpkg || fail "the same layer again has other bytes"
same "$(previous again.json kept changed new gone relaxed)" "120 0 0 0 0" 'the same layer again:'

for more in "" "--rows no --max-shift 6" "--previous-relax no"; do
    # shellcheck disable=SC2086
    expect 0 separate next.gpkg later.gpkg "${options[@]}" --previous first.gpkg --stats later.json $more
    read -r houses moved outside < <(town compare now.gpkg next.gpkg first.gpkg later.gpkg 8)
    [ "$outside" = 0 ] || fail "$outside of $houses houses moved without a reason: $more"
    [ "$moved" -gt 0 ] && [ "$moved" -lt 40 ] || fail "$moved of $houses houses moved: $more"
    same "$(previous later.json new gone edited)" "2 3 6" "houses, $more:"
    # shellcheck disable=SC2086
    expect 0 separate next.gpkg settled.gpkg "${options[@]}" --previous later.gpkg $more
    [ "$(town compare next.gpkg next.gpkg later.gpkg settled.gpkg 0)" = "119 0 0" ] || fail "a result does not stay: $more"
done
expect 0 separate next.gpkg later.gpkg --gap 2 --id-field id --overwrite --previous first.gpkg
grep -q '^since the previous result: kept [0-9]*, changed [0-9]*, new 2, gone 3, edited 6; free to go back [1-9]' out || fail "$(cat out)"

# Three squares in a row. The middle one is deleted, so the others may go back. By FID.
pair() { # FILE WKT...
    printf 'id,WKT\n' >"$1.csv"
    for wkt in "${@:2}"; do printf '%s,"%s"\n' "${wkt%%:*}" "${wkt#*:}" >>"$1.csv"; done
    rm -f "$1.gpkg"
    make "$1"
}
left='1:POLYGON((0 0,4 0,4 4,0 4,0 0))' middle='3:POLYGON((4.5 0,8 0,8 4,4.5 4,4.5 0))' right='2:POLYGON((8.5 0,12 0,12 4,8.5 4,8.5 0))'
pair three "$left" "$right" "$middle"
pair two "$left" "$right"
expect 0 separate three.gpkg o.gpkg --gap 1 --rows no -q
same "$(value o.gpkg town 1 sunder_dx) $(value o.gpkg town 2 sunder_dx)" "-0.5 0.5" 'three:'
expect 0 separate two.gpkg p.gpkg --gap 1 --rows no -q --previous o.gpkg --stats p.json
same "$(value p.gpkg town 1 sunder_dx) $(value p.gpkg town 2 sunder_dx) $(previous p.json relaxed gone)" "0 0 2 1" 'two:'
expect 0 separate two.gpkg p.gpkg --gap 1 --rows no -q --overwrite --previous o.gpkg --previous-relax no --stats p.json
same "$(value p.gpkg town 1 sunder_dx) $(value p.gpkg town 2 sunder_dx) $(previous p.json relaxed kept)" "-0.5 0.5 0 2" \
    'two that stay:'

# The middle one is edited within its box. It has no former move then, with --previous-relax no either, and the others go
# back. With the left one in a block, that has none either.
pair edited "$left" "$right" '3:POLYGON((4.5 0,8 0,8 4,4.5 0))'
expect 0 separate edited.gpkg p.gpkg --gap 1 --rows no -q --overwrite --id-field id --previous o.gpkg --stats p.json
same "$(previous p.json edited relaxed gone new)" "1 2 0 0" 'one edited:'
expect 0 separate edited.gpkg p.gpkg --gap 1 --rows no -q --overwrite --previous o.gpkg --previous-relax no --stats p.json
same "$(previous p.json edited relaxed kept)" "1 0 3" 'one edited, the others stay:'
pair joined '1:POLYGON((0 0,4 0,4 4,0 4,0 0))' '3:POLYGON((4 0,8 0,8 4,4 4,4 0))' '2:POLYGON((8.5 0,12 0,12 4,8.5 4,8.5 0))'
pair apart '1:POLYGON((0 0,4 0,4 4,0 4,0 0))' '3:POLYGON((4 0,7 0,7 4,4 4,4 0))' '2:POLYGON((8.5 0,12 0,12 4,8.5 4,8.5 0))'
expect 0 separate joined.gpkg j.gpkg --gap 1 --rows no -q
expect 0 separate apart.gpkg p.gpkg --gap 1 --rows no -q --overwrite --previous j.gpkg --previous-relax no --stats p.json
same "$(value p.gpkg town 1 sunder_dx) $(previous p.json edited relaxed kept)" "0 1 1 1" 'an edited block:'

# Nothing was edited, whatever the format does to rings, and where vectors are not exact; then one house is, by the last
# bit of one coordinate.
town odd odd.csv odd_edited.csv
make odd
make odd_edited
for ending in shp fgb geojson; do
    expect 0 separate odd.gpkg "odd.$ending" --gap 2 -q --layers main --id-field id
    expect 0 separate odd.gpkg again.fgb --gap 2 -q --layers main --overwrite --id-field id --previous "odd.$ending" --stats odd.json
    same "$(previous odd.json edited relaxed)" "0 0" "written as $ending:"
done
expect 0 separate odd_edited.gpkg again.fgb --gap 2 -q --layers main --overwrite --id-field id --previous odd.shp --stats odd.json
same "$(previous odd.json edited)" 1 'edited by the last bit:'
# What was trimmed has another shape in the result, and counts as not edited.
printf 'id,WKT\n1,"LINESTRING(-5 -1,20 -1)"\n' | layer road.gpkg road LINESTRING
expect 0 separate three.gpkg t.gpkg --gap 1 --max-shift 0.6 --trim --barrier road.gpkg,width=3 --allow-conflicts -q
[ "$(value t.gpkg town 1 sunder_lvl)" = 1 ] || fail "nothing was trimmed"
expect 0 separate three.gpkg p.gpkg --gap 1 --max-shift 0.6 --trim --barrier road.gpkg,width=3 --allow-conflicts -q --overwrite \
    --previous t.gpkg --stats p.json
same "$(previous p.json edited relaxed changed)" "0 0 0" 'trimmed:'
# The result does not know its barriers: without the road the houses stay, except where 0 is preferred.
expect 0 separate two.gpkg b.gpkg --gap 1 --barrier road.gpkg,width=3 -q
expect 0 separate two.gpkg p.gpkg --gap 1 -q --overwrite --previous b.gpkg --stats p.json
same "$(value p.gpkg town 1 sunder_dy) $(previous p.json kept)" "1.5 2" 'without the road:'
ogr2ogr free.gpkg two.gpkg -sql 'SELECT *, CASE WHEN id = 1 THEN 0.0 END AS zero FROM town' -nln town -dialect sqlite 2>/dev/null || fail "cannot make free.gpkg"
expect 0 separate free.gpkg p.gpkg --gap 1 -q --overwrite --previous b.gpkg --prefer-dx zero --prefer-dy zero --stats p.json
same "$(value p.gpkg town 1 sunder_dy) $(previous p.json kept)" "0 1" 'without the road, one is free:'
# Another order of FIDs: each feature seems to be another one.
pair turned "$middle" "$left" "$right"
expect 0 separate turned.gpkg p.gpkg --gap 1 --overwrite --previous o.gpkg
grep -q 'warning: --previous: 3 of 3 features have another geometry .* --id-field' err || fail "no warning of other FIDs: $(cat err)"

# Symbols of points.
pair points '1:POINT(0 0)' '2:POINT(3 0)'
expect 0 separate points.gpkg q.gpkg --symbol square:4 -q
expect 0 separate points.gpkg r.gpkg --symbol square:4 -q --previous q.gpkg --stats r.json
same "$(previous r.json kept changed edited)" "2 0 0" 'points:'
pair points '1:POINT(0 0)' '2:POINT(3 0.5)'
expect 0 separate points.gpkg r.gpkg --symbol square:4 -q --overwrite --previous q.gpkg --stats r.json
same "$(previous r.json edited relaxed)" "1 1" 'points, one of them moved:'

refused 1 'no such file' separate two.gpkg never.gpkg --previous missing.gpkg
ogr2ogr -a_srs EPSG:25833 elsewhere.gpkg o.gpkg town 2>/dev/null || fail "cannot make elsewhere.gpkg"
refused 1 'in another CRS' separate two.gpkg never.gpkg --previous elsewhere.gpkg
refused 1 'has no field sunder_dx' separate two.gpkg never.gpkg --previous three.gpkg
refused 2 'needs --previous' separate two.gpkg never.gpkg --previous-relax no
refused 2 '--previous-relax' separate two.gpkg never.gpkg --previous o.gpkg --previous-relax maybe
refused 2 'not with --proof' separate two.gpkg never.gpkg --previous o.gpkg --proof p
refused 2 'not with --max-memory' separate two.gpkg never.gpkg --previous o.gpkg --max-memory 1G
cp o.gpkg twice.gpkg
ogr2ogr -append twice.gpkg o.gpkg town -nln town 2>/dev/null || fail "cannot make twice.gpkg"
refused 1 'another feature of' separate two.gpkg never.gpkg --previous twice.gpkg --id-field id
finish
