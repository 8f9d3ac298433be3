# shellcheck shell=bash disable=SC1091
# The side of a feature that a road cuts in half does not depend on the limits of moves: separate chooses the same side
# with any limit, as a whole or in parts, and check --before uses the same one, too.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export PYTHONDONTWRITEBYTECODE=1
houses() { /usr/bin/python3 "$SUNDER_SOURCE/tests/cli/sides_and_limits.py" "$@" || fail "sides_and_limits.py $*"; }

houses write "${SUNDER_SEED:-1}"
same=(--gap 0 --barrier roads.geojson --effort 0)
out=(--lco SIGNIFICANT_FIGURES=25 -q) # 15 digits, since with 17 GDAL writes numbers like 0.30000000000000004
expect 0 separate houses.geojson far.geojson "${same[@]}" --max-shift 60 "${out[@]}"
houses sides far.geojson >far.sides
[ "$(wc -l <far.sides)" -eq 30 ] || fail "$(wc -l <far.sides) houses of 30 moved"
for limit in 1 3; do
    run separate houses.geojson $limit.geojson "${same[@]}" --max-shift $limit "${out[@]}"
    houses sides $limit.geojson >$limit.sides
    [ "$(wc -l <$limit.sides)" -ge 10 ] || fail "limit $limit: $(wc -l <$limit.sides) houses moved"
    [ -z "$(comm -23 <(sort $limit.sides) <(sort far.sides))" ] || fail "limit $limit: the sides differ: $(comm -23 <(sort $limit.sides) <(sort far.sides))"
done
expect 0 plan houses.geojson plan --shards 3 "${same[@]}" --max-shift 1 --output-layer houses --lco SIGNIFICANT_FIGURES=25
for shard in 1 2 3; do expect 0 separate --shard $shard plan -q; done
run merge plan parts.geojson -q
houses sides parts.geojson | sort | comm -23 - <(sort far.sides) >other
[ ! -s other ] || fail "in parts the sides differ: $(cat other)"

houses mirror far.geojson crossed.geojson
for limit in 0 1 3 15 60 1000; do
    run check far.geojson --before houses.geojson "${same[@]:0:4}" --max-shift $limit
    says out 'side 0,'
    run check crossed.geojson --before houses.geojson "${same[@]:0:4}" --max-shift $limit
    says out 'side 30,'
done
finish
