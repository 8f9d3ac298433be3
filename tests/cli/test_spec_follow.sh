# shellcheck shell=bash disable=SC1091
# Layers of a sheet with the role follow: what sunder follow makes of the result, written in the same run; with several
# layers that move; of what is hidden; in parts; what is refused.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=0
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
ogr2ogr points.gpkg "$town" -nln points -dialect SQLite -sql "SELECT CAST(fid AS INTEGER) AS house, 'n' || fid AS note,
    ST_Translate(ST_PointOnSurface(geom), fid % 7 / 3, 0, 0) AS geom FROM buildings"
ogr2ogr fences.gpkg "$town" -nln fences -nlt PROMOTE_TO_MULTI -dialect SQLite \
    -sql "SELECT fid AS house, ST_Boundary(geom) AS geom FROM buildings WHERE fid % 3 = 0"
cat >sheet.json <<JSON
{"scale": 10000, "defaults": {"gap": "0.3mm", "max_shift": 7},
 "layers": [
  {"name": "moved", "source": "$town", "layer": "buildings", "role": "move"},
  {"name": "roads", "source": "$town", "layer": "roads", "role": "barrier", "width": 5},
  {"name": "inside", "source": "points.gpkg", "role": "follow"},
  {"name": "near", "source": "points.gpkg", "role": "follow", "by": "nearest:0.2mm", "of": "moved", "where": "house > 20"},
  {"name": "named", "source": "points.gpkg", "layer": "points", "role": "follow", "by": "field:house"},
  {"name": "fences", "source": "fences.gpkg", "role": "follow"}]}
JSON
all() { ogr2ogr -f CSV /vsistdout/ "$1" "$2" -lco GEOMETRY=AS_WKT -lco SEPARATOR=TAB; }
expect 0 separate --spec sheet.json result.gpkg --allow-conflicts --stats stats.json
says out 'inside: 280 features: moved'
while read -r name source by; do
    expect 0 follow result.gpkg "$source.gpkg" alone.gpkg --overwrite --by "$by" --output-layer "$name" --scale 10000 \
        --stats alone.json
    cmp -s <(all result.gpkg "$name") <(all alone.gpkg "$name") || fail "$name is not what follow makes"
    same "$(jq -c --arg n "$name" '.follow[] | select(.name == $n) | del(.name)' stats.json)" \
        "$(jq -c 'del(.command)' alone.json)" "$name:"
done <<'X'
inside points inside
named points field:house
fences fences inside
X
expect 0 follow result.gpkg points.gpkg alone.gpkg --overwrite --by nearest:2 --output-layer near --where 'house > 20'
cmp -s <(all result.gpkg near) <(all alone.gpkg near) || fail "near is not what follow makes"
# Judged without the program: what a field names has the move of its house.
ogrinfo -q result.gpkg -dialect SQLite -sql "SELECT count(*) AS wrong FROM named AS p JOIN moved AS h ON p.house = h.fid
    WHERE p.sunder_dx <> h.sunder_dx OR p.sunder_dy <> h.sunder_dy OR p.sunder_to <> h.fid" >wrong
says wrong 'wrong (Integer) = 0'
[ "$(jq '.follow[] | select(.name == "named") | .moved' stats.json)" -gt 100 ] || fail "hardly anything moved"
same "$(jq .verified stats.json)" true 'with what goes along:'
# The moves are those of the sheet without what goes along; in parts everything is the same, to the byte.
jq 'del(.layers[2:])' sheet.json >without.json
expect 0 separate --spec without.json without.gpkg -q --allow-conflicts
cmp -s <(all result.gpkg moved) <(all without.gpkg moved) || fail "what goes along changes moves"
expect 0 separate --spec sheet.json parts.gpkg -q --allow-conflicts --max-memory 110M
cmp -s result.gpkg parts.gpkg || fail "in parts: other bytes"
# Without the main layers nothing goes along; check passes these layers over.
expect 0 separate --spec sheet.json few.gpkg -q --allow-conflicts --layers conflicts
same "$(ogrinfo -q few.gpkg | grep -vc layer_styles)" 1 'layers without main:'
expect 0 check --spec sheet.json -q --allow-conflicts

# ---- Several layers that move: what goes along says which one
layer houses.gpkg houses Polygon <<'X'
key,WKT
a,"POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))"
b,"POLYGON ((8 0, 18 0, 18 10, 8 10, 8 0))"
X
layer sheds.gpkg sheds Polygon <<'X'
key,WKT
a,"POLYGON ((0 8, 4 8, 4 14, 0 14, 0 8))"
X
layer doors.gpkg doors Point <<'X'
n,key,WKT
1,a,"POINT (2 9)"
2,a,"POINT (6 2)"
3,b,"POINT (16 2)"
4,,"POINT (50 50)"
X
layer notes.gpkg sheds Polygon <<'X'
note,WKT
a,"POLYGON ((0 8, 4 8, 4 14, 0 14, 0 8))"
a,"POLYGON ((30 8, 34 8, 34 14, 30 14, 30 8))"
X
layer elsewhere.gpkg doors Point EPSG:25833 <<'X'
n,WKT
1,"POINT (2 9)"
X
cat >two.json <<'JSON'
{"defaults": {"gap": 1, "no_blocks": true, "contained": "separate"},
 "layers": [{"name": "h", "source": "houses.gpkg", "role": "move"}, {"name": "s", "source": "sheds.gpkg", "role": "move"},
            {"name": "any", "source": "doors.gpkg", "role": "follow"},
            {"name": "of_sheds", "source": "doors.gpkg", "role": "follow", "of": "s"},
            {"name": "by_key", "source": "doors.gpkg", "role": "follow", "of": "h", "by": "field:key", "id_field": "key"}]}
JSON
expect 0 separate --spec two.json two.gpkg
rows() { ogr2ogr -f CSV /vsistdout/ two.gpkg -dialect SQLite -sql "SELECT n, sunder_st, sunder_to, sunder_lay FROM $1 ORDER BY n" | tail -n +2 | tr -d '"' | tr '\n' ' '; }
same "$(rows any)" '1,moved,1,h 2,moved,1,h 3,moved,2,h 4,free,, ' 'of any layer:'
same "$(rows of_sheds)" '1,moved,1,s 2,free,, 3,free,, 4,free,, ' 'of sheds:'
same "$(rows by_key)" '1,moved,1,h 2,moved,1,h 3,moved,2,h 4,free,, ' 'by a key:'
moved_by() { ogr2ogr -f CSV /vsistdout/ two.gpkg -dialect SQLite -sql "SELECT sunder_dx, sunder_dy FROM $1 WHERE $2" | tail -n 1; }
same "$(moved_by of_sheds 'n = 1')" "$(moved_by s 'fid = 1')" 'the move of the shed:'
same "$(moved_by any 'n = 3')" "$(moved_by h 'fid = 2')" 'the move of house b:'

# ---- What is hidden, also if it is not written
for drop in false true; do
    jq ".layers[0] += {hide: true, drop_hidden: $drop, max_shift: 0.1} | .layers[1].max_shift = 0.1" two.json >hides.json
    expect 0 separate --spec hides.json two.gpkg --overwrite -q --allow-conflicts --stats stats.json
    [ "$(jq '.layers[0].hidden' stats.json)" -gt 0 ] || fail "nothing is hidden"
    [ "$(jq '.follow[2].hidden' stats.json)" -gt 0 ] || fail "drop_hidden $drop: what is hidden takes something along: $(jq -c .follow stats.json)"
done

# ---- What is refused
wrong() { # STATUS WORDS FILTER: of two.json
    jq "$3" two.json >wrong.json
    refused "$1" "$2" separate --spec wrong.json no.gpkg
}
wrong 2 'layers[2]: "of": no layer that moves has the name hh' '.layers[2].of = "hh"'
wrong 2 'layers[4]: "of" is missing' 'del(.layers[4].of)'
wrong 2 'layers[2]: there is no key max_shift' '.layers[2].max_shift = 3'
wrong 2 '--by near: expected inside' '.layers[2].by = "near"'
wrong 2 'id_field without' '.layers[2].id_field = "key"'
wrong 1 'has no field none' '.layers[4].id_field = "none"'
wrong 1 'has no field none' '.layers[4].by = "field:none"'
wrong 1 'two features that move have the key' '.layers[4].of = "s" | .layers[4].id_field = "note" | .layers[1].source = "notes.gpkg"'
wrong 2 'two layers of the output have the name s' '.layers[2].name = "s"'
wrong 2 'two layers of the output have the name any' '.layers[3].name = "any"'
wrong 1 'no such file' '.layers[2].source = "none.gpkg"'
wrong 1 'different CRSs' '.layers[2].source = "elsewhere.gpkg"'
wrong 2 'layers: none has the role move' '.layers = .layers[2:]'
refused 1 'holds one layer a file' separate --spec two.json no.shp
refused 2 'a plan takes no layer along' plan --spec two.json no.dir --shards 2
cp doors.gpkg doors_were.gpkg
expect 1 separate --spec two.json doors.gpkg --overwrite
cmp -s doors.gpkg doors_were.gpkg || fail "the output replaced what goes along"
refused 2 'input' separate --spec two.json no.gpkg --stats doors.gpkg
finish
