# shellcheck shell=bash disable=SC1091
# A layer that is separated in parts to save memory gives the same output as a whole one: the same bytes in every
# format, the same statistics. Its files on disk are removed, however the run ends.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=1700000000
mkdir scratch
export TMPDIR=$work/scratch

"$SUNDER_BUILD/sunder-town" --buildings 6000 --seed 5 town.gpkg >/dev/null || fail "no town is made"
# Adds blocks of two, some of which have houses streets apart.
ogr2ogr -q numbered.gpkg town.gpkg -nln buildings -dialect SQLite \
    -sql "select *, case when fid % 60 < 2 then fid / 60 when fid % 97 = 1 then 1000 + fid / 970 end as blk from buildings" &&
    mv numbered.gpkg town.gpkg || fail "blocks are not numbered"

# alike OUTPUT MEMORY ARGS: compares runs with and without --max-memory
page=() proof=(--proof at/proof.jsonl)
alike() {
    local output=$1 memory=$2 first second
    shift 2
    rm -rf whole parts at
    mkdir at
    run separate town.gpkg "at/$output" -l buildings "$@" --stats whole.json -q "${proof[@]}" "${page[@]}"
    first=$status
    mv at whole
    mkdir at
    run separate town.gpkg "at/$output" -l buildings "$@" --stats parts.json -q "${proof[@]}" \
        "${page[@]}" --max-memory "$memory"
    second=$status
    mv at parts
    same "$second" "$first" "$output in parts: status"
    diff -rq whole parts || fail "$output of $* differs in parts"
    same "$(jq -c 'del(.seconds, .peak_rss_bytes)' parts.json)" "$(jq -c 'del(.seconds, .peak_rss_bytes)' whole.json)" \
        "figures of $output in parts"
    same "$(ls -A scratch)" '' "left in the scratch directory:"
}

# The same with --report, which takes some memory.
drawn() {
    page=(--report at/page.html)
    alike "$@"
    page=()
}

alike o.gpkg 99M --gap 3 --effort 0 --max-shift 2
drawn o.gpkg 103M --gap 3 --effort 0 --max-shift 2
alike o.gpkg 98.5M --gap 3 --effort 0.05
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

# Pairs between a least gap and the gap.
alike o.gpkg 99M --gap 1.5 --least-gap 0.5 --effort 0 --rows auto --max-shift 0.3
proof=(--proof at/proof.jsonl)
jq -e '.shortfall.tight > 50' whole.json >/dev/null || fail "few are tight: $(jq -c .shortfall whole.json)"

# Barriers: roads through the whole layer with different widths, meadows, one that is near a feature only at one end,
# and one that is near none.
python3 - <<'PYTHON' || fail "no barriers are made"
import json, random, re, subprocess
random.seed(3)
told = subprocess.run(['ogrinfo', '-so', 'town.gpkg', 'buildings'], capture_output=True, text=True).stdout
x, y, X, Y = map(float, re.search(r'Extent: \((.*), (.*)\) - \((.*), (.*)\)', told).groups())
def write(name, features):
    json.dump({'type': 'FeatureCollection', 'name': name, 'features': features}, open(name + '.geojson', 'w'))
def feature(kind, at, **fields):
    return {'type': 'Feature', 'properties': fields, 'geometry': {'type': kind, 'coordinates': at}}
roads = [feature('LineString', [[x + (X - x) * t / 40, y + (Y - y) * ((t / 40 * k) % 1)] for t in range(41)], w=k * 2.0)
         for k in range(1, 4)]
for k in range(300):
    a, b = random.uniform(x, X), random.uniform(y, Y)
    roads.append(feature('LineString', [[a, b], [a + random.uniform(-30, 30), b + random.uniform(-30, 30)]], w=None if k % 3 else 1.5))
roads.append(feature('LineString', [[x + 50, y + 50], [x - 1e5, y - 1e5]], w=1.0))
roads.append(feature('LineString', [[x - 1e5, y - 2e5], [x - 2e5, y - 2e5]], w=70.0))
write('roads', roads)
meadows = []
for k in range(40):
    a, b, s = random.uniform(x, X), random.uniform(y, Y), random.uniform(5, 60)
    meadows.append(feature('Polygon', [[[a, b], [a + s, b], [a + s, b + s], [a, b + s], [a, b]]]))
write('meadows', meadows)
PYTHON
for name in roads meadows; do
    ogr2ogr -q -nln $name -a_srs EPSG:25832 $name.gpkg $name.geojson || fail "$name.gpkg is not made"
done
alike o.gpkg 99M --gap 1 --effort 0 --max-shift 2 --barrier roads.gpkg,width-field=w
drawn o.gpkg 103M --gap 1 --effort 0 --max-shift 2 --barrier roads.gpkg,width=5,gap=0,side=no \
    --barrier meadows.gpkg,gap=1 --barrier "roads.gpkg,where=w > 3" --id-field id
alike o.gpkg 99M --gap 1 --effort 0 --rows auto --max-shift 2 --barrier roads.gpkg,width-field=w --barrier meadows.gpkg
alike o.gpkg 99M --gap 1 --effort 0 --max-shift 2 --barrier meadows.gpkg,as=boundary,gap=0 --touch-tolerance 0.01
alike o.gpkg 99M --gap 1 --effort 0 --max-shift 2 --barrier "roads.gpkg,where=w > 60"

# Points, whose symbols are written to a layer of their own: squares; symbols with a kind and a size of their own;
# discs.
ogr2ogr -q points.gpkg town.gpkg -nln buildings -nlt POINT -dialect SQLite -sql "select st_centroid(geom) as geom,
        case when fid % 3 then 'square:6' else 'disc:4' end as drawn, 1 + (fid % 4) / 4.0 as larger, fid % 17 as kind
        from buildings" && mv points.gpkg town.gpkg || fail "no points are made"
alike o.gpkg 99M --symbol square:9 --effort 0
drawn o.gpkg 103M --symbol-field drawn --symbol-size-field larger --effort 0 --max-shift 5 \
    --barrier roads.gpkg,width=2,gap=0 --where 'kind < 9' --weight-field larger
alike o.geojson 99M --symbol disc:4 --effort 0 --layers symbols
alike o.shp 99M --symbol disc:4 --effort 0 --layers main,symbols

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
