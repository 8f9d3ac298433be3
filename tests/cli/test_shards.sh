# shellcheck shell=bash disable=SC1091
# Layers that are hard to cut into shards (shard_layouts.py), in 1, 2, 7 and 64 shards, processed in another order and
# some of them twice: the output, statistics, proof and page are those of one process.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
for tool in python3 jq; do command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }; done
export SOURCE_DATE_EPOCH=1700000000
python3 "$SUNDER_SOURCE/tests/cli/shard_layouts.py" . || fail "no layouts"
figures() { jq -c 'del(.seconds, .peak_rss_bytes)' "$1"; }
# Replaces paths, which differ: a page contains the name of the output, and a plan has absolute paths.
page() { sed "s#$PWD/##g; s#parts/o#whole/o#g" "$1"; }

# Prints 1 .. n, first the odd numbers in descending order.
order() { seq 1 2 "$1" | tac; seq 2 2 "$1"; }

# alike LAYOUT "SHARDS..." OPTIONS
alike() {
    local name=$1 shards=$2 n k wanted=0
    shift 2
    [ -e "$name.gpkg" ] || ogr2ogr -q "$name.gpkg" "$name.geojson" -nln houses || fail "$name.gpkg"
    rm -rf whole parts plan-* whole.jsonl
    mkdir whole parts
    "$SUNDER" separate "$name.gpkg" whole/o.gpkg "$@" --stats whole.json --proof whole.jsonl --report whole.html -q 2>err || wanted=$?
    for n in $shards; do
        expect 0 plan "$name.gpkg" "plan-$n" "$@" --stats parts.json --proof parts.jsonl --report parts.html \
            -q --shards "$n"
        for k in $(order "$n"); do expect 0 separate --shard "$k" "plan-$n"; done
        expect 0 separate --shard 1 "plan-$n"
        rm -f parts/o.gpkg parts.json parts.jsonl parts.html
        expect "$wanted" merge "plan-$n" parts/o.gpkg
        cmp whole/o.gpkg parts/o.gpkg || fail "$name in $n shards, $*: the output differs"
        cmp <(page whole.html) <(page parts.html) || fail "$name in $n shards, $*: the page differs"
        cmp whole.jsonl parts.jsonl || fail "$name in $n shards, $*: the proof differs"
        same "$(figures parts.json)" "$(figures whole.json)" "$name in $n shards, $*: figures"
    done
}

for layout in chain block one_place few duplicates great clusters; do
    alike $layout '2 7' --gap 2 --effort 0.01
    alike $layout '3' --gap 1 --effort 0 --block-field blk --contained separate --max-shift 20
done
alike block '64' --gap 2 --effort 0.05
# Fixed features may stay in conflict, and obstruct features that move.
for layout in chain duplicates great clusters; do
    alike $layout '6' --gap 4 --effort 0 --max-shift 1 --fixed-where 'fid % 3 > 0'
done
# With a road and a river through all layouts.
for layout in chain block great; do
    alike $layout '5' --gap 1 --effort 0 --max-shift 15 --barrier line.geojson,width-field=width,gap=0.5
done
alike clusters '4' --gap 1 --effort 0 --max-shift 15 --no-blocks --allow-jumps --barrier line.geojson,side=no
# Rows go from shard to shard; beside roads, a line of which ends some of them.
alike streets '1 7' --gap 2 --effort 0.05 --rows auto
cp whole.json streets.json
alike streets '5' --gap 3 --effort 0 --rows auto --row-stiffness 10,1 --block-field blk --max-shift 20
alike streets '4' --gap 2 --effort 0 --rows auto --max-shift 6 --barrier line.geojson,width-field=width,gap=0.5
alike clusters '3' --gap 2 --effort 0.01 --rows auto --no-blocks
# Rows of a field, with blocks of far members, and among roads.
alike streets '7' --gap 2 --effort 0 --rows street --max-shift 20 --ease 5 --block-field ends
cp whole.json given.json
alike clusters '5' --gap 2 --effort 0 --rows street --no-blocks --barrier line.geojson,width-field=width,gap=0.5
jq -e '.rows.rows >= 8 and .rows.features > 200 and .displacement.cost_rows > 1' given.json >/dev/null ||
    fail "few rows of a field: $(jq -c .rows given.json)"
# Pairs that remain in conflict are eased, beside roads and within limits.
alike streets '7' --gap 3 --effort 0 --rows auto --ease 30 --max-shift 3 --barrier line.geojson,width-field=width,gap=0.5
cp whole.json eased.json
alike great '5' --gap 2 --effort 0.05 --ease 10 --max-shift 4 --barrier line.geojson,width-field=width,gap=0.5
alike chain '3' --gap 1 --effort 0 --ease 100 --block-field blk --contained separate --max-shift 2
jq -e '.shortfall.pairs > 10 and .displacement.cost_alone > 1' eased.json >/dev/null || fail "little is short: $(cat eased.json)"
# Pairs stand between a least gap and the gap: with room and without, where the least gap of the roads is another, where
# only the roads have one, and among features that may not move.
alike streets '7' --gap 4 --least-gap 1 --effort 0 --rows auto --max-shift 3 --barrier line.geojson,width-field=width,gap=0.5
cp whole.json tight.json
alike great '5' --gap 3 --least-gap 0.5 --effort 0.05 --max-shift 4 --barrier line.geojson,width-field=width,gap=2,least=0.1
# Features are hidden, become smaller or larger, of classes, in chains from shard to shard, in blocks of far members, and beside
# roads; the page and the proof say which.
alike chain '4' --gap 2 --effort 0 --max-shift 2 --hide --hierarchy-field class
cp whole.json chain.json
alike great '5' --gap 3 --effort 0 --max-shift 3 --hide --hierarchy-field class --drop-hidden --crossed hide \
    --barrier line.geojson,width-field=width,gap=0.5
cp whole.json hidden.json
alike streets '3' --gap 4 --effort 0 --max-shift 1 --hide --trim --inset 0.5,1 --min-size 2 --symbol-size 3 \
    --rigid-where 'fid % 7 = 0' --crossed trim --barrier line.geojson,width-field=width,gap=0.5
jq -e '.shrunk.trimmed > 3 and .shrunk.inset > 10 and .shrunk.scaled + .shrunk.symbols > 30' whole.json >/dev/null ||
    fail "few are smaller: $(jq -c .shrunk whole.json)"
alike clusters '6' --gap 4 --effort 0 --max-shift 1 --hide --block-field blk --fixed-where 'fid % 3 > 0' --rows auto \
    --enlarge --min-size 12
jq -e '.enlarged > 100' whole.json >/dev/null || fail "few are larger: $(jq -c .enlarged whole.json)"
jq -e '.hidden.clauses > 100 and (.hidden.by_class | has("0") | not)' chain.json >/dev/null &&
    jq -e '.hidden.count > 10 and .hidden.components > 10' hidden.json >/dev/null ||
    fail "little is hidden: $(jq -c .hidden chain.json hidden.json)"
alike chain '3' --gap 0 --effort 0 --max-shift 2 --barrier line.geojson,width-field=width,gap=3,least=1
alike clusters '6' --gap 4 --least-gap 2 --effort 0 --max-shift 1 --fixed-where 'fid % 3 > 0'
jq -e '.shortfall.tight > 20 and .blocked > 0' tight.json >/dev/null ||
    fail "few tight pairs: $(cat tight.json)"
jq -e '.rows.rows >= 8 and .rows.features > 200 and .displacement.cost_rows > 1' streets.json >/dev/null ||
    fail "few rows: $(jq -c .rows streets.json)"
finish
