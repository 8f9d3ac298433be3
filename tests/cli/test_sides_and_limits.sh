# shellcheck shell=bash disable=SC1091
# The side of a feature that a road cuts in half does not depend on the limits of moves: separate chooses the same side
# with any limit, as a whole or in parts, and check --before and the checker of proofs use the same one, too.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export PYTHONDONTWRITEBYTECODE=1
houses() { /usr/bin/python3 "$SUNDER_SOURCE/tests/cli/sides_and_limits.py" "$@" || fail "sides_and_limits.py $*"; }

houses write "${SUNDER_SEED:-1}"
same=(--gap 0 --barrier roads.geojson --effort 0 --ease no)
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

# Ten houses of which a road cuts off slightly less on one side than on the other, which counts as half: the limit lets
# them go only to the nearer side. Where another road is beyond that side, farther than four times the limit, the house
# has to go to the other side, and so it stays, with a proof about its side anchor.
awk 'BEGIN { print "id,WKT" > "h.csv"; print "id,WKT" > "r.csv"
    for (k = 0; k < 10; k++) {
        x = 1000 * k; side = k % 2 ? 1 : -1; far = side * (8 + 3 * k); shift = 0.015625
        printf "%d,\"POLYGON ((%d %f,%d %f,%d %f,%d %f,%d %f))\"\n", k, x, shift - 1, x + 20, shift - 1, x + 20,
            shift + 1, x, shift + 1, x, shift - 1 > "h.csv"
        printf "%d,\"LINESTRING (%d 0,%d 0)\"\n%d,\"LINESTRING (%d %f,%d %f)\"\n", k, x - 300, x + 300, k, x - 300, far,
            x + 300, far > "r.csv"
    } }'
layer h.gpkg h POLYGON <h.csv
layer r.gpkg r LINESTRING <r.csv
halves=(--gap 0.5 --barrier r.gpkg --max-shift 1.5)
expect 3 separate h.gpkg o.gpkg "${halves[@]}" -q --proof h.jsonl
same "$(grep -c '"reason": "side"' h.jsonl)" 5 'houses that stay on their side'
/usr/bin/python3 "$SUNDER_SOURCE/tests/proof/check_proof.py" h.jsonl h.gpkg --result o.gpkg "${halves[@]}" >checked 2>&1 ||
    fail "the proof of the sides: $(tail -n 1 checked)"
finish
