# shellcheck shell=bash disable=SC1091
# A layer that is separated in parts to save memory gives the same output as a whole one: the same bytes in every
# format, the same statistics. Its files on disk are removed, however the run ends.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
. "$SUNDER_SOURCE/tests/cli/parts.sh" || exit 1

alike o.gpkg 99M --gap 3 --effort 0 --max-shift 2
drawn o.gpkg 103M --gap 3 --effort 0 --max-shift 2
alike o.gpkg 98M --gap 2 --effort 0 --no-blocks --allow-jumps --id-field id
drawn o.gpkg 103M --gap 0.5 --effort 0 --weight sqrt-area --fixed-where 'fid % 9 = 0' --ignore-where 'fid % 11 = 0'
alike o.shp 99M --gap 3 --effort 0
alike o.gpkg 98.5M --gap 3 --effort 0 --block-field blk
alike o.geojson 99M --gap 3 --effort 0 --layers main,conflicts
drawn o.fgb 2G --gap 3 --effort 0

# Rows of houses.
alike o.gpkg 99M --gap 3 --effort 0.05 --rows auto
drawn o.gpkg 103M --gap 2 --effort 0 --rows auto --row-stiffness 10,1 --block-field blk --max-shift 3 --id-field id
jq -e '.rows.rows > 50 and .displacement.cost_rows > 1' whole.json >/dev/null || fail "few rows: $(jq -c .rows whole.json)"

# Pairs that are eased.
proof=()
alike o.gpkg 99M --gap 1.5 --effort 0 --rows auto --max-shift 0.3 --ease 30
jq -e '.shortfall.pairs > 50' whole.json >/dev/null || fail "few are short: $(jq -c .shortfall whole.json)"

# Hidden, smaller and larger features.
drawn o.shp 103M --gap 1.5 --effort 0 --max-shift 0.3 --hide --hide-weight 1 --id-field id --inset 0.3 --enlarge \
    --min-size 5
jq -e '.hidden.count > 50 and .shrunk.inset > 40 and .enlarged > 50' whole.json >/dev/null ||
    fail "few are hidden or smaller: $(jq -c '.hidden, .shrunk' whole.json)"

# Pairs between a least gap and the gap.
alike o.gpkg 99M --gap 1.5 --least-gap 0.5 --effort 0 --rows auto --max-shift 0.3
proof=(--proof at/proof.jsonl)
jq -e '.shortfall.tight > 50' whole.json >/dev/null || fail "few are tight: $(jq -c .shortfall whole.json)"

# A connected group is processed as one part, and a warning is printed if it is too large.
"$SUNDER_BUILD/sunder-town" --buildings 30000 --seed 6 large.gpkg >/dev/null || fail "no town is made"
run separate large.gpkg o.gpkg -l buildings --effort 0 --rows no --max-memory 99M --overwrite
grep -q 'as one piece' err && fail "a town is reported as one piece"
ogrinfo -q large.gpkg -sql 'alter table buildings add column one integer default 1' >/dev/null || fail "no block is made"
run separate large.gpkg o.gpkg -l buildings --effort 0 --rows no --max-memory 99M --overwrite --block-field one
grep -q '30000 features may depend on each other and are separated as one piece: it takes about' err ||
    fail "no message about a block of 30000 features"
# The warning comes before the separation, and `plan` prints it, too.
grep -q '30000 features form one connected group, from (.*) to (.*), which is separated as one piece' err ||
    fail "no warning about a block of 30000 features before the separation"
expect 0 plan large.gpkg one.plan -l buildings --shards 3 --rows no --max-memory 99M --block-field one
grep -q '30000 features form one connected group' err || fail "plan does not warn about a block of 30000 features"
same "$(jq '.largest_group.features' one.plan/plan.json)" 30000 'largest_group of plan.json'
jq -e '.largest_group.memory_bytes > 1.5 * .max_memory_bytes and .merge.memory_bytes >= .largest_group.memory_bytes' one.plan/plan.json >/dev/null ||
    fail "the merge is not estimated by what it has to hold"
for k in 1 2 3; do run separate --shard $k one.plan -q; done
rm -f o.gpkg
run merge one.plan o.gpkg
same "$(grep -c 'form one connected group' err)" 1 'number of warnings of merge about a block of 30000 features'
expect 0 plan large.gpkg none.plan -l buildings --shards 3 --rows no --max-memory 99M
grep -q "one connected group" err && fail "plan reports a town as one connected group"
# Long diagonal houses in rows: nearly all bounding boxes overlap, but no two houses do, so that shapes decide.
ogr2ogr -q aslant.gpkg large.gpkg -nln buildings -dialect SQLite -sql "select st_translate(st_geomfromtext(
        'POLYGON((0 0,30 30,28 32,-2 2,0 0))', 25832), 400000 + 9 * (fid % 200) + 31 * (fid / 200), 5500000 + 31 * (fid / 200), 0) as geom from buildings" ||
    fail "the diagonal houses cannot be made"
expect 0 plan aslant.gpkg aslant.plan -l buildings --shards 3 --rows no --max-memory 99M --gap 1
grep -q "one connected group" err && fail "houses of which only the boxes overlap are reported as one group"
same "$(jq '.largest_group.features' aslant.plan/plan.json)" 1 'largest_group of diagonal houses'
rm -rf o.gpkg ./*.plan aslant.gpkg

# Too little memory.
refused 1 'need' separate town.gpkg o.gpkg -l buildings --gap 3 --max-memory 20M
same "$(ls -A scratch)" '' "left of what was refused:"
TMPDIR=$work/nowhere refused 1 'cannot be made' separate town.gpkg o.gpkg -l buildings --max-memory 1G

for delay in 0.02 0.05 0.1 0.2; do
    "$SUNDER" separate town.gpkg o.gpkg -l buildings --gap 3 --effort 0 --max-memory 98.5M >out 2>err &
    process=$!
    sleep $delay
    kill -TERM $process 2>/dev/null
    wait $process
    same "$(ls -A scratch)" '' "left by a run that was ended after $delay s:"
    rm -f o.gpkg
done
finish
