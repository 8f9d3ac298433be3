# shellcheck shell=bash disable=SC1091
# A layer whose features come in another order, with the same FIDs: every feature has the same move and status, and the
# figures are the same, with rows that are found, rows of a field, and eased pairs.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
for tool in python3 jq; do command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }; done
python3 "$SUNDER_SOURCE/tests/cli/shard_layouts.py" . || fail "no layouts"

# Writes LAYOUT.ORDER.geojson for each order, with the FIDs of the first one.
python3 - streets clusters <<'PYTHON' || fail "no other orders"
import json, random, sys
for name in sys.argv[1:]:
    with open(name + '.geojson') as file:
        layer = json.load(file)
    for number, feature in enumerate(layer['features']):
        feature['id'] = number
    shuffled = layer['features'][:]
    random.Random(7).shuffle(shuffled)
    for order, features in (('given', layer['features']), ('turned', layer['features'][::-1]), ('shuffled', shuffled)):
        with open(f'{name}.{order}.geojson', 'w') as file:
            json.dump({**layer, 'name': 'houses', 'features': features}, file)
PYTHON

# same_in_each_order LAYOUT OPTIONS
same_in_each_order() {
    local name=$1 order
    shift
    for order in given turned shuffled; do
        rm -f o.gpkg moves.csv
        run separate "$name.$order.geojson" o.gpkg "$@" --stats figures.json -q
        [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || fail "$name, $*, $order: status $status"
        ogr2ogr -q -f CSV moves.csv o.gpkg -dialect SQLite \
            -sql 'SELECT id, sunder_dx, sunder_dy, sunder_st FROM houses ORDER BY id' || fail "no moves"
        mv moves.csv $order.csv
        jq -c 'del(.seconds, .peak_rss_bytes, .layer, .displacement.max_fid)' figures.json >$order.json
    done
    for order in turned shuffled; do
        cmp -s given.csv $order.csv || fail "$name, $*: other moves if features are $order"
        same "$(cat $order.json)" "$(cat given.json)" "$name, $*: figures if features are $order"
    done
    jq -e '.moved + .blocked > 30' given.json >/dev/null || fail "$name, $*: few moves: $(cat given.json)"
}

roads=(--max-shift 6 --barrier line.geojson,width-field=width,gap=0.5)
same_in_each_order streets --gap 2 --effort 0.05 --rows auto
same_in_each_order streets --gap 3 --effort 0 --rows auto --ease 30 "${roads[@]}"
jq -e '.shortfall.pairs > 5 and .displacement.cost_rows > 1' given.json >/dev/null || fail "little is short: $(cat given.json)"
same_in_each_order streets --gap 2 --effort 0 --rows street --ease 5 "${roads[@]}"
same_in_each_order clusters --gap 4 --effort 0 --max-shift 3 --ease 30 --fixed-where 'height = 3'
finish
