# shellcheck shell=bash
# Limits of formats: names that differ in case only, 64-bit integers, lists, null, layers of unknown type, negative
# FIDs, features without geometry. Such data are written in another form with a message, or the run is refused before
# the computation.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
command -v jq >/dev/null && command -v python3 >/dev/null || { echo "skipped: jq or python3 is not installed"; exit 77; }
losses() { jq -r '.losses[]' "$1"; }
names() { ogrinfo -ro -so "$1" "$2" | sed -n 's/^\([A-Za-z0-9_]*\): [A-Z][A-Za-z0-9]*\(([A-Za-z0-9]*)\)* ([0-9.]*).*/\1/p'; }
# A layer of squares in GeoJSON; two of them overlap. $1 is a Python expression in i that gives the properties.
squares() {
    python3 -c "
import json, sys
features = []
for i in range(int(sys.argv[1])):
    x = 10.0 * i - (1 if i == 1 else 0) + (50 if i > 1 else 0)
    ring = [[x, 0.0], [x + 10, 0.0], [x + 10, 10.0], [x, 10.0], [x, 0.0]]
    kind, at = ('MultiPolygon', [[ring]]) if eval(sys.argv[3]) else ('Polygon', [ring])
    features.append({'type': 'Feature', 'properties': eval(sys.argv[2]), 'geometry': {'type': kind, 'coordinates': at}})
print(json.dumps({'type': 'FeatureCollection', 'crs': {'type': 'name', 'properties': {'name': 'urn:ogc:def:crs:EPSG::25832'}}, 'features': features}))" \
        "$1" "$2" "${3:-False}"
}

# ---- field names that differ in case only: each field keeps its values, new names are reported, and no two are the
# same
for seed in 1 2 3; do
    rm -f case.*
    python3 - $seed >case.names <<'PY'
import random, sys
draw, names = random.Random(int(sys.argv[1])), []
while len(names) < 9:
    word = draw.choice(["name", "name2", "name3", "fixme", "fid", "geom", "ogc_fid"])
    word = "".join(draw.choice([c.upper(), c]) for c in word)
    if word not in names:
        names.append(word)
print("\n".join(names))
PY
    squares 3 "{n: n + str(i) for n in $(jq -R . case.names | jq -sc .)}" >case.geojson
    for end in gpkg sqlite fgb geojson tab; do
        rm -rf o && mkdir o
        expect 0 separate case.geojson o/case.$end --layers main --quiet --stats s.json
        names o/case.$end case | grep -v '^sunder_' >got
        same "$(wc -l <got)" 9 "$end, seed $seed: fields"
        if [ $end = geojson ]; then same "$(cat got)" "$(cat case.names)" 'GeoJSON distinguishes them:'; continue; fi
        same "$(tr '[:upper:]' '[:lower:]' <got | sort | uniq -d)" '' "$end, seed $seed: the same twice:"
        paste case.names got >pairs
        ogrinfo -q -ro o/case.$end case >rows
        while read -r name as; do
            [ "$name" = "$as" ] || losses s.json | grep -q "^field $name: called $as" || fail "$end: $name is renamed to $as without a message"
            grep -q "^  $as (String) = ${name}1$" rows || fail "$end: the value of $name is not in $as"
        done <pairs
    done
done

# ---- 64-bit integers in formats without them: written as reals, with a message; those beyond 2^53 that no real equals
# are counted
squares 4 "{'bid': [12345678901, 9007199254740992, 9007199254740993, None][i]}" >wide.geojson
for end in tab gdb; do
    expect 0 separate wide.geojson wide.$end --layers main --quiet --stats s.json
    rows=$(ogrinfo -q -ro wide.$end wide)
    grep -q 'bid (Real) = 12345678901$' <<<"$rows" || fail "$end: the key is lost"
    wanted='field bid: Real instead of Integer64, 1 value cannot be held as it is (first: FID 2)'
    # the null value, too
    [ $end = gdb ] || wanted='field bid: Real instead of Integer64, 2 values cannot be held as they are (first: FID 2)'
    same "$(losses s.json | grep '^field bid')" "$wanted" "$end:"
done

# ---- lists: written as JSON text, with a message
squares 2 "{'tags': [['a', 'b\"c'], []][i], 'nums': [[1, 2], [3]][i], 'parts': [[0.5], [1.5, 2.5]][i]}" >list.geojson
for end in fgb shp tab gpkg gdb; do
    expect 0 separate list.geojson list.$end --layers main --quiet --stats s.json
    rows=$(ogrinfo -q -ro list.$end list)
    grep -q 'tags (String\((JSON)\)*) = \[ *"a", *"b\\"c" *\]' <<<"$rows" || fail "$end: the list is lost: $rows"
    grep -q 'nums (String\((JSON)\)*) = \[ *1, *2 *\]' <<<"$rows" || fail "$end: the list of integers is lost"
    same "$(losses s.json | grep -c 'String instead of .*List$')" 3 "$end: $(losses s.json)"
done

# ---- a layer of unknown type in a format that needs one: Multi Polygon if all features are polygons; -nlt requests it
# for any format
squares 3 "{'n': i}" 'i == 1' >mixed.geojson
expect 0 separate mixed.geojson mixed.gdb --quiet
ogrinfo -ro -so mixed.gdb mixed | grep -q '^Geometry: Multi Polygon' || fail "the type of the geodatabase's layer is not Multi Polygon"
expect 0 separate mixed.geojson plain.gpkg --quiet
same "$(ogrinfo -ro -so plain.gpkg mixed | sed -n 's/^Geometry: //p')" 'Unknown (any)'
for nlt in '-nlt PROMOTE_TO_MULTI' '--nlt=PROMOTE_TO_MULTI'; do
    # shellcheck disable=SC2086
    expect 0 separate mixed.geojson multi.gpkg --quiet --overwrite $nlt
    same "$(ogrinfo -ro -so multi.gpkg mixed | sed -n 's/^Geometry: //p')" 'Multi Polygon' "$nlt:"
    same "$(ogrinfo -q -ro multi.gpkg mixed | grep -c '^  MULTIPOLYGON')" 3 "$nlt: features"
done
expect 0 buffer mixed.geojson grown.gpkg --shape square:1 --quiet -nlt PROMOTE_TO_MULTI
same "$(ogrinfo -q -ro grown.gpkg mixed | grep -c '^  MULTIPOLYGON')" 3 'buffer -nlt:'
expect 3 check mixed.geojson found.gpkg --quiet -nlt PROMOTE_TO_MULTI
same "$(ogrinfo -q -ro found.gpkg mixed_conflicts | grep -c '^  MULTILINESTRING')" 1 'check -nlt:'
refused 2 'PROMOTE_TO_MULTI' separate mixed.geojson no.gpkg -nlt POLYGON
ogr2ogr both.gpkg mixed.geojson -nln mixed -nlt GEOMETRY
ogrinfo -q both.gpkg -dialect sqlite -sql "INSERT INTO mixed (geom, n) VALUES (ST_GeomFromText('POINT (1 1)', 25832), 9)" >/dev/null 2>&1
if [ "$(count both.gpkg mixed)" = 4 ]; then
    refused 1 'holds geometries of several kinds, and a layer of OpenFileGDB can hold only one kind' separate both.gpkg no.gdb --quiet
    expect 0 separate both.gpkg some.gdb --where 'n < 9' --quiet
fi

# ---- negative FIDs, which GeoJSON does not read as FIDs, are written to a field
ogr2ogr fids.gpkg mixed.geojson -nln fids -nlt MULTIPOLYGON
ogrinfo -q fids.gpkg -sql 'UPDATE fids SET fid = -5 WHERE n = 1' >/dev/null
expect 0 separate fids.gpkg fids.geojson --layers main
says err 'FIDs less than 0 do not read back from GeoJSON: all stand in sunder_fid'
same "$(ogrinfo -q -ro fids.geojson fids | sed -n 's/^  sunder_fid (.*) = //p' | sort -n | tr '\n' ' ')" '-5 1 3 '
expect 0 separate fids.gpkg kept.geojson --where 'fid > 0' --layers main --quiet
same "$(ogrinfo -q -ro kept.geojson fids | grep -c sunder_fid)" 0 'positive FIDs are kept:'

# ---- features without geometry in formats that cannot hold them
layer bare.gpkg bare POLYGON <<'CSV'
WKT,name
"POLYGON ((0 0,10 0,10 10,0 10,0 0))",a
"POLYGON EMPTY",b
,c
CSV
refused 1 'FlatGeobuf drops features without geometry, and 2 of layer bare have none' separate bare.gpkg no.fgb
refused 1 'FlatGeobuf drops features without geometry' buffer bare.gpkg no.fgb --shape square:1

# ---- formats without null: check reads the blocks that separate wrote, for a layer in one piece, in parts and in
# shards
python3 - >row.csv <<'PY'
print("WKT,id")
# pairs that overlap; in every third pair the second also touches a third square, so that these are a block of three
for i in range(12):
    for k in range(2):
        x, y = 100 * i + 8 * k, 0
        print(f'"POLYGON (({x} {y},{x+10} {y},{x+10} {y+10},{x} {y+10},{x} {y}))",{10*i+k}')
    if i % 3 == 0:
        print(f'"POLYGON (({100*i+18} 0,{100*i+28} 0,{100*i+28} 10,{100*i+18} 10,{100*i+18} 0))",{10*i+2}')
PY
layer row.gpkg row POLYGON <row.csv
counts() { jq -c "$1" "$2"; }
for end in tab mif csv shp geojson nc gmt jml; do
    rm -rf o && mkdir o
    case $end in mif) of=(--of 'MapInfo File') ;; nc) of=(--of netCDF) ;; gmt) of=(--of OGR_GMT) ;; *) of=() ;; esac
    ogrinfo --format "${of[1]:-GeoJSON}" >/dev/null 2>&1 || continue
    run separate row.gpkg o/row.$end "${of[@]}" --gap 1 --max-shift 0.1 --touch-tolerance 0.2 --quiet --stats s.json
    same $status 3 "$end:"
    [ $end != csv ] || rm o/row.csvt # without it all fields are text
    main=$(ogrinfo -ro -so -al o/row.$end 2>/dev/null | sed -n 's/^Layer name: //p' | head -1)
    run check o/row.$end --input-layer "$main" --gap 1 --no-blocks --block-field sunder_blk --quiet --stats c.json
    same "$(counts .conflicts c.json)" "$(counts .conflicts.after s.json)" "$end: conflicts"
    case $end in
        tab | mif | nc)
            losses s.json | grep -q 'no null: a feature in no block has its own FID in sunder_blk' || fail "$end: no message about sunder_blk"
            losses s.json | grep -q '_conflicts: null reads back as a value in .*barr_fid' || fail "$end: no message about barr_fid"
            ;;
    esac
done
[ "$(jq .conflicts.after.inside_blocks s.json)" -gt 0 ] || fail "there are no blocks"
rows() { ogrinfo -q -ro "$1" row | grep -v '^Layer'; }
mkdir whole memory shards
run separate row.gpkg whole/row.tab --gap 1 --max-shift 0.1 --touch-tolerance 0.2 --quiet
run separate row.gpkg memory/row.tab --gap 1 --max-shift 0.1 --touch-tolerance 0.2 --quiet --max-memory 200M
rows whole/row.tab | cmp - <(rows memory/row.tab) || fail "in parts the blocks have other numbers"
run plan row.gpkg cut --shards 2 --gap 1 --max-shift 0.1 --touch-tolerance 0.2 --quiet
for k in 1 2; do run separate --shard $k cut --quiet; done
run merge cut shards/row.tab --quiet
rows whole/row.tab | cmp - <(rows shards/row.tab) || fail "after merge the blocks have other numbers"
finish
