# shellcheck shell=bash disable=SC1091
# --least-gap: a row that shares what it lacks, a barrier with a least gap of its own, what is listed and counted, and
# which calls are refused.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# Twelve houses of 10 m in a row, 1 m apart. The gap is 5 m, so 44 m are missing, and limits of 12.5 m give 25 m of them.
{
    echo "WKT,n"
    for ((k = 0; k < 12; k++)); do
        x=$((11 * k))
        echo "\"POLYGON(($x 0,$((x + 10)) 0,$((x + 10)) 10,$x 10,$x 0))\",$k"
    done
} | layer twelve.gpkg houses POLYGON
row=(separate twelve.gpkg o.gpkg --overwrite --gap 5 --rows auto --stats s.json)
between() { jq -e --argjson s "$1" -n "$2" >/dev/null || fail "$3: $1"; }
gaps() {
    ogr2ogr -q -f CSV /vsistdout/ o.gpkg -dialect sqlite -sql \
        "SELECT MAX(d) AS most, MIN(d) AS least FROM (SELECT b.sunder_dx - a.sunder_dx + 1 AS d FROM houses a, houses b WHERE b.n = a.n + 1)" |
        tail -1 | tr ',' ' '
}

# They share it: no conflict, eleven tight pairs, and gaps that differ by less than a third.
expect 0 "${row[@]}" --max-shift 12.5 --least-gap 1 --report r.html
grep -q '>11 more pairs are tight' r.html || fail "the page does not count tight pairs"
! grep -q 'id="blocked"' r.html || fail "the page calls tight pairs blocked"
styled() { ogr2ogr -q -f CSV /vsistdout/ o.gpkg layer_styles | grep -c "kind&quot; = 'tight'"; }
[ "$(styled)" -gt 0 ] || fail "no style of tight pairs"
between "$(cat s.json)" '$s | (.conflicts.before + .conflicts.after | add) == 0 and .blocked == 0 and .verified and
    .shortfall.pairs == 11 and .shortfall.tight == 11 and (.shortfall.sum - 19 | fabs) < 1e-6 and .rows.kink_mean == 0 and
    (.displacement | (.cost - .cost_moves - .cost_rows - .cost_shortfall | fabs) < 1e-6 and .lower_bound <= .cost and
        .lower_bound > .cost * (1 - 1e-6)) and .clusters_optimal == 1' "shared, and proved"
read -r most least < <(gaps)
awk -v most="$most" -v least="$least" 'BEGIN { exit !(least > 1 && most <= 1.3 * least) }' ||
    fail "the largest gap is $most, the least $least"
[ "$(ogr2ogr -q -f CSV /vsistdout/ o.gpkg houses_conflicts | cut -d, -f7,8 | sort | uniq -c | grep -c 'tight,"*$')" = 1 ] ||
    fail "kinds and reasons: $(ogr2ogr -q -f CSV /vsistdout/ o.gpkg houses_conflicts | cut -d, -f7,8)"
grep -q '; tight 11$' out || fail "the summary: $(cat out)"
expect 0 check o.gpkg --input-layer houses --gap 5 --least-gap 1 --no-blocks --stats c.json
[ "$(grep -c $'\ttight\t' out)" = 11 ] || fail "check lists $(cat out)"
[ "$(jq -c '[(.conflicts | add), .shortfall]' c.json)" = '[0,{"tight":11}]' ] || fail "check counts $(cat c.json)"
expect 3 check o.gpkg --input-layer houses --gap 5 --no-blocks
expect 0 check o.gpkg --input-layer houses --gap 5 --least-gap 1 --before twelve.gpkg --rows auto --max-shift 12.5

# Without a limit, and with a least gap or with none, a row stays a row; without a least gap nothing is short.
expect 0 "${row[@]}" --ease 30
between "$(cat s.json)" '$s | .shortfall.pairs == 0 and .displacement.cost_shortfall == 0' "no least gap"
[ "$(styled)" = 0 ] || fail "a style of tight pairs, without a least gap"
expect 0 "${row[@]}" --least-gap 5
between "$(cat s.json)" '$s | .shortfall.pairs == 0 and (.displacement.cost_moves - 2288 | fabs) < 1e-4' "equal gaps"
cp o.gpkg equal.gpkg
expect 0 "${row[@]}" --least-gap 1 --ease 300
between "$(cat s.json)" '$s | .shortfall.tight == 11 and .shortfall.sum < 9' "no limit, a high price"

# Threads do not matter.
expect 0 "${row[@]}" --max-shift 12.5 --least-gap 1 --threads 4
ogr2ogr -q -f CSV four.csv o.gpkg houses
expect 0 "${row[@]}" --max-shift 12.5 --least-gap 1 --threads 1
ogr2ogr -q -f CSV one.csv o.gpkg houses
cmp one.csv four.csv || fail "threads change the result"

# The same row where a house reaches x = 8192: from there on doubles have fewer digits after the point, and no move of
# this house is exact. It stays, and the others share what they lack.
awk 'BEGIN {
    print "WKT,n"
    for (k = 0; k < 12; k++) {
        x = 8115.7 + 11 * k
        printf "\"POLYGON((%.1f 0,%.1f 0,%.1f 10,%.1f 10,%.1f 0))\",%d\n", x, x + 10, x + 10, x, x, k
    }
}' | layer coarser.gpkg houses POLYGON
expect 0 separate coarser.gpkg o.gpkg --overwrite --gap 5 --rows no --stats s.json --max-shift 12.5 --least-gap 1
between "$(cat s.json)" '$s | .rounded == 0 and .verified and .displacement.cost < 2700 and .displacement.cost_moves > 100' "no exact move"

# A road 10 m wide and two houses 2 m from its line, which may move 12.8 m. With gap=10 they lack 0.2 m. With least=9.9
# that is still a conflict, with least=0 it is tight; the road has its own least gap, or takes the lesser of the two.
{
    echo "WKT,n"
    echo '"POLYGON((0 2,20 2,20 40,0 40,0 2))",1'
    echo '"POLYGON((100 2,120 2,120 40,100 40,100 2))",2'
} | layer houses.gpkg houses POLYGON
{ echo "WKT,n"; echo '"LINESTRING(-200 0,600 0)",1'; } | layer road.gpkg road LINESTRING
words=(separate houses.gpkg o.gpkg --overwrite --gap 10 --max-shift 12.8 --stats s.json)
expect 3 "${words[@]}" --barrier road.gpkg,width=10,least=9.9
between "$(cat s.json)" '$s | .conflicts.after.barrier_near == 2 and .blocked == 2 and .shortfall.tight == 0 and
    .shortfall.pairs == 2 and (.shortfall.sum - 0.4 | fabs) < 1e-6' "in conflict"
for more in "--barrier road.gpkg,width=10,least=0" "--barrier road.gpkg,width=10 --least-gap 3" \
    "--gap 1 --barrier road.gpkg,width=10,gap=10 --least-gap 0.5" "--gap 0 --barrier road.gpkg,width=10,gap=10,least=9"; do
    # shellcheck disable=SC2086
    expect 0 separate houses.gpkg o.gpkg --overwrite --max-shift 12.8 --stats s.json $([[ $more == *--gap* ]] || echo --gap 10) $more
    between "$(cat s.json)" '$s | (.conflicts.after | add) == 0 and .blocked == 0 and .shortfall.tight == 2 and
        (.shortfall.sum - 0.4 | fabs) < 1e-6 and (.displacement.cost_shortfall - 2 * (4 * 12.8 * 0.2 + 30 * 0.04) | fabs) < 1e-6' \
        "tight with $more"
done

# Refused: a least gap that is none, or has no price.
for length in -1 x nan inf '' 10.5 3furlongs; do expect 2 "${words[@]}" --least-gap="$length"; done
grep -q -e '--least-gap' err || fail "the message does not name the option: $(cat err)"
expect 2 "${words[@]}" --least-gap 10.5
grep -q 'must not be greater than the gap, 10' err || fail "the message: $(cat err)"
expect 2 separate houses.gpkg o.gpkg --overwrite --least-gap 1
grep -q 'there is no --gap' err || fail "the message: $(cat err)"
expect 2 separate houses.gpkg o.gpkg --overwrite --barrier road.gpkg,least=1
expect 2 "${words[@]}" --barrier road.gpkg,gap=2,least=3
grep -q 'least=3: must not be greater than the gap, 2' err || fail "the message: $(cat err)"
expect 2 "${words[@]}" --barrier road.gpkg,least=-3
expect 2 "${words[@]}" --least-gap 1 --ease no
finish
