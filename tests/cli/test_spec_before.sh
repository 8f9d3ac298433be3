# shellcheck shell=bash disable=SC1091
# check --before with several layers that move: what separate made breaks no rule; what was changed by hand is found, with
# its layer, in the lines, the statistics and the page; blocks of several layers; the originals in one dataset or where the
# sheet says.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=0
worlds() { python3 "$SUNDER_SOURCE/tests/cli/spec_worlds.py" "$@" || fail "spec_worlds.py $1"; }
broken() { jq -c '.moves | [.matched, .worse, .limit, .side, .jump, .not_a_translate, .lost]' check.json; }

for seed in 21 22 23; do
    rm -f town.gpkg
    worlds make town.gpkg sheet.json $seed together
    expect 0 separate --spec sheet.json moved.gpkg --overwrite -q --allow-conflicts --stats stats.json
    for original in town.gpkg sheet.json; do
        expect 0 check --spec sheet.json moved.gpkg --before $original --allow-conflicts --stats check.json
        same "$(broken)" '[67,0,0,0,0,0,0]' "seed $seed, $original:"
        same "$(jq -c .conflicts.after stats.json)" "$(jq -c .conflicts check.json)" "seed $seed:"
    done
done

# ---- By hand: a mark far away, a house turned, a shed gone, a house on the other side of another one
cp moved.gpkg hand.gpkg
sql() { ogrinfo -q hand.gpkg -dialect SQLite -sql "$1" >/dev/null; }
sql "UPDATE marks SET geom = ST_Translate(geom, 40, 0, 0) WHERE fid = 2"
sql "UPDATE moved SET geom = RotateCoords(geom, 5) WHERE fid = 5"
sql "DELETE FROM sheds WHERE fid = 7"
expect 0 check --spec sheet.json hand.gpkg --before town.gpkg --allow-conflicts --stats check.json --report page.html found.gpkg
same "$(jq -c '.moves | [.matched, .limit, .not_a_translate, .lost]' check.json)" '[66,1,1,1]' 'by hand:'
list() { ogr2ogr -f CSV /vsistdout/ found.gpkg -dialect SQLite \
    -sql "SELECT kind, layer_a, fid_a FROM sheet_conflicts WHERE kind IN ('limit', 'not_a_translate', 'lost') ORDER BY kind" | tail -n +2 | tr -d '"' | tr '\n' ' '; }
same "$(list)" 'limit,marks,2 lost,sheds,7 not_a_translate,moved,5 ' 'found by hand:'
says out "since town.gpkg: 66 matched"
for kind in limit lost not_a_translate; do grep -q "<td>$kind</td>" page.html || fail "the page does not show $kind"; done
same "$(grep -o '<td>[a-z_]*</td>' page.html | head -3 | grep -cE 'limit|not_a_translate|worse|jump|lost')" 3 'first on the page:'

# ---- Blocks of houses and sheds, of two datasets, with keys
squares() { # FILE ID:LEFT:RIGHT ...
    rm -f "$1.gpkg"
    { echo id,WKT && for s in "${@:2}"; do
        IFS=: read -r id a b <<<"$s"
        echo "$id,\"POLYGON(($a 0,$b 0,$b 4,$a 4,$a 0))\""
    done; } | layer "$1.gpkg" "$1" Polygon
}
squares houses a:0:4 b:20:24 c:40:44
squares sheds a:4:6 b:18.5:19.5
cat >blocks.json <<'JSON'
{"defaults": {"gap": 2, "rows": "no", "max_shift": 3, "id_field": "id"},
 "layers": [{"name": "h", "source": "houses.gpkg", "role": "move"}, {"name": "s", "source": "sheds.gpkg", "role": "move"}]}
JSON
expect 0 separate --spec blocks.json blocks.gpkg -q
expect 0 check --spec blocks.json blocks.gpkg --before blocks.json --no-blocks --block-field sunder_blk --stats check.json
same "$(broken) $(jq -c '.conflicts | [.too_close, .inside_blocks]' check.json)" '[5,0,0,0,0,0,0] [0,1]' 'blocks:'
# Their sources are two datasets, and none of them has both layers.
refused 1 'both layers h and s of the sheet' check --spec blocks.json blocks.gpkg --before houses.gpkg
# Before it is separated the sheet stands as it is: nothing has moved.
expect 3 check --spec blocks.json --before blocks.json --stats check.json
same "$(broken)" '[5,0,0,0,0,0,0]' 'unmoved:'
# One layer in the sheet.
jq '.layers = [.layers[0]]' blocks.json >one.json
expect 0 separate --spec one.json one.gpkg -q
expect 0 check --spec one.json one.gpkg --before one.json --stats check.json
same "$(broken)" '[3,0,0,0,0,0,0]' 'one layer:'
# An operand is what is checked. If it does not exist, the message says how the findings are written.
refused 1 '--output' check --spec one.json found.gpkg.not_there
expect 3 check --spec blocks.json --output written.gpkg
same "$(ogrinfo -q written.gpkg | grep -c blocks_conflicts)" 1 'the findings in a file:'
finish
