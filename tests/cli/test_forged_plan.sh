# shellcheck shell=bash disable=SC1091
# Plans with one number changed and all checksums computed again (forged_plan.py): merge and shards end with a result or
# an error message. None crashes, allocates memory that the files of the plan do not account for, or runs without end.
#
#   SUNDER_SEED=N          replays a draw
#   SUNDER_TEST_SCALE=N    N times 60 forgeries; all: each of them (some 10,000)
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
[ -x "$SUNDER_BUILD/tests/calls" ] || { echo "skipped: tests/calls is not built"; exit 77; }
if grep -q '^SUNDER_SANITIZE:STRING=.' "$SUNDER_BUILD/CMakeCache.txt"; then
    echo "skipped: sanitizers take more memory than a limit allows"
    exit 77
fi
seed=${SUNDER_SEED:-$((RANDOM))}
scale=${SUNDER_TEST_SCALE:-1}
echo "SUNDER_SEED=$seed SUNDER_TEST_SCALE=$scale"

# Overlapping boxes for three shards, two that cannot be separated, a block, a road.
{
    echo 'id,block,WKT'
    for i in 0 1 2 3 4 5; do
        for j in 0 1; do
            x=$((i * 9 / 2 + (i > 2 ? 30 : 0))) y=$((j * 12))
            echo "$i$j,$((i < 5 ? i * 2 + j : 99)),\"POLYGON(($x $y,$((x + 5)) $y,$((x + 5)) $((y + 5)),$x $((y + 5)),$x $y))\""
        done
    done
    echo '90,90,"POLYGON((80 0,90 0,90 10,80 10,80 0))"'
    echo '91,91,"POLYGON((81 1,91 1,91 11,81 11,81 1))"'
} | layer in.gpkg houses POLYGON
layer in.gpkg roads LINESTRING <<<$'k,WKT\n1,"LINESTRING(-5 8,90 9)"'
# With every other seed pairs may stand between two gaps; there is no proof of that.
more=(--barrier in.gpkg,layer=roads --proof p.jsonl)
[ $((seed % 2)) = 0 ] || more=(--barrier in.gpkg,layer=roads,least=0.2 --least-gap 0.5)
expect 0 plan in.gpkg p --input-layer houses --id-field id --block-field block --gap 1 --max-shift 4 "${more[@]}" --shards 2 -q
for k in 1 2; do expect 0 separate --shard $k p -q; done
run merge p o.gpkg -q
same "$status" 3 "the honest plan"
mkdir scratch
count=()
[ "$scale" = all ] || count=($((60 * scale)) "$seed")
TMPDIR=$work python3 "$SUNDER_SOURCE/tests/cli/forged_plan.py" "$SUNDER_BUILD/tests/calls" p scratch "${count[@]}" >wrong 2>figures ||
    fail "$(cat figures)"
cat figures
[ ! -s wrong ] || fail "$(head -20 wrong)"
finish
