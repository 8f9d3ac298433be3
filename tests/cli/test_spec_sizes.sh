# shellcheck shell=bash disable=SC1091
# Several layers that move, each with rules of its own for what becomes smaller: houses are trimmed, sheds moved in, scaled
# and squares at last, in whatever order the sheet has them; points keep their symbols. Judged by GEOS and in rationals.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=0
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
worlds() { python3 "$SUNDER_SOURCE/tests/cli/spec_worlds.py" "$@" || fail "spec_worlds.py $1"; }
make() { ogr2ogr -update all.gpkg "$town" -nln "$1" -nlt "$2" -dialect SQLite -sql "$3" 2>/dev/null || ogr2ogr all.gpkg "$town" -nln "$1" -nlt "$2" -dialect SQLite -sql "$3"; }
make houses POLYGON "SELECT fid AS key, geom FROM buildings WHERE fid % 3 > 0"
make sheds POLYGON "SELECT fid AS key, geom FROM buildings WHERE fid % 3 = 0"
make marks POINT "SELECT fid AS key, ST_PointOnSurface(geom) AS geom FROM buildings WHERE fid % 20 = 0"
make roads LINESTRING "SELECT geom FROM roads"
cat >sheet.json <<'JSON'
{"defaults": {"max_shift": 1.5, "no_blocks": true, "contained": "separate", "effort": 0.2, "rows": "no"},
 "layers": [
  {"name": "houses", "source": "all.gpkg", "layer": "houses", "role": "move", "hide": true, "trim": true, "min_size": 2, "rigid_where": "key < 100"},
  {"name": "sheds", "source": "all.gpkg", "layer": "sheds", "role": "move", "hide": true, "inset": [0.5, 1], "symbol_size": 3, "min_size": 1},
  {"name": "marks", "source": "all.gpkg", "layer": "marks", "role": "move", "symbol": "square:1", "max_shift": 20},
  {"name": "roads", "source": "all.gpkg", "layer": "roads", "role": "barrier", "width": 8, "class": "roads"}],
 "gaps": [{"between": ["*", "*"], "gap": 3}, {"between": ["marks", "*"], "gap": 0.5}]}
JSON
shapes() { ogr2ogr -f CSV /vsistdout/ "$1" -dialect SQLite -sql "SELECT DISTINCT sunder_lvl AS l FROM $2 WHERE sunder_inv = 0 ORDER BY l" | tail -n +2 | tr -d '"' | tr '\n' ' '; }
judged() { # RESULT SHEET
    read -r pairs near found listed < <(worlds judge "$1" all.gpkg "$2")
    [ "$near" = "$found" ] && [ "$listed" = "$found" ] || fail "$2: $near of $pairs pairs are too near, $listed are listed"
    worlds smaller "$1" all.gpkg "$2"
}
expect 0 separate --spec sheet.json first.gpkg -q --allow-conflicts --stats stats.json --report page.html
same "$(shapes first.gpkg houses)|$(shapes first.gpkg sheds)|$(shapes first.gpkg marks)" '0 1 |0 2 3 4 5 6 |0 ' 'rungs:'
judged first.gpkg sheet.json
[ "$(jq '.shrunk | [.trimmed, .inset, .symbols] | min' stats.json)" -gt 2 ] || fail "hardly anything is smaller: $(jq -c .shrunk stats.json)"
same "$(jq -c '[.verified, .hidden.lower_bound <= .hidden.weight, .shrunk.lower_bound <= .shrunk.area_lost]' stats.json)" '[true,true,true]' 'bounds:'
same "$(ogr2ogr -f CSV /vsistdout/ first.gpkg -dialect SQLite -sql 'SELECT count(*) FROM houses WHERE key < 100 AND sunder_lvl > 0' | tail -n 1 | tr -d '"')" 0 'rigid:'
# The other order: the rules are those of each layer still.
jq '.layers |= [.[1], .[0], .[2], .[3]]' sheet.json >other.json
expect 0 separate --spec other.json other.gpkg -q --allow-conflicts
same "$(shapes other.gpkg sheds)|$(shapes other.gpkg houses)" '0 1 2 3 4 5 |0 6 ' 'rungs in the other order:'
judged other.gpkg other.json
# Without the rule in any layer nothing is smaller, and there are no columns about it.
jq 'del(.layers[].trim, .layers[].inset, .layers[].symbol_size, .layers[].min_size, .layers[].rigid_where)' sheet.json >none.json
expect 0 separate --spec none.json none.gpkg -q --allow-conflicts --stats none.stats
ogrinfo -so none.gpkg houses | grep -q sunder_lvl && fail "columns about smaller shapes"
[ "$(jq .hidden.weight none.stats)" != "$(jq .hidden.weight stats.json)" ] || fail "smaller shapes spare nothing"
# The rule in the defaults holds for both, and for no symbol. One layer of all gives as much as two of its halves.
jq '.defaults += {hide: true, trim: true} | del(.layers[2]) | del(.layers[].trim, .layers[].hide, .layers[].inset, .layers[].symbol_size,
    .layers[].min_size, .layers[].rigid_where) | .gaps = .gaps[:1]' sheet.json >both.json
expect 0 separate --spec both.json both.gpkg -q --allow-conflicts --stats both.stats
judged both.gpkg both.json
make whole POLYGON "SELECT fid AS key, geom FROM buildings"
jq '.layers = [{name: "whole", source: "all.gpkg", layer: "whole", role: "move"}, .layers[2]]' both.json >whole.json
expect 0 separate --spec whole.json whole.gpkg -q --allow-conflicts --stats whole.stats
same "$(jq -c '[.shrunk.trimmed, .hidden.count, .conflicts.before]' both.stats)" "$(jq -c '[.shrunk.trimmed, .hidden.count, .conflicts.before]' whole.stats)" 'halves:'
# check passes these rules over, unless it compares.
expect 0 check --spec sheet.json -q --allow-conflicts
refused 2 '--before: not with several layers that move: --trim' check --spec sheet.json first.gpkg --before sheet.json
jq '.layers[0].enlarge = true' sheet.json >wrong.json
refused 2 'not with several layers that move: --enlarge' separate --spec wrong.json no.gpkg
jq '.layers |= .[:3]' sheet.json >wrong.json
refused 2 '--trim: features are cut back at barriers' separate --spec wrong.json no.gpkg
finish
