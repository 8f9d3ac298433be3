# shellcheck shell=bash disable=SC1091
# --ease: what the statistics say of a house that lacks little, and which calls are refused.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# A road 10 m wide, and houses that have to be 15 m from its line. The first two stand 2 m from it and may move 12.8 m:
# they lack 0.2 m. The third may not move, the fourth reaches the gap.
{
    echo "WKT,most"
    echo '"POLYGON((0 2,20 2,20 40,0 40,0 2))",12.8'
    echo '"POLYGON((100 2,120 2,120 40,100 40,100 2))",12.8'
    echo '"POLYGON((200 2,220 2,220 40,200 40,200 2))",0'
    echo '"POLYGON((300 3,320 3,320 40,300 40,300 3))",12.8'
} | layer houses.gpkg houses POLYGON
{ echo "WKT,w"; echo '"LINESTRING(-200 0,600 0)",10'; } | layer road.gpkg road LINESTRING
words=(separate houses.gpkg o.gpkg --overwrite --gap 10 --max-shift-field most --barrier road.gpkg,width-field=w)

expect 3 "${words[@]}" --rows no --ease no --stats plain.json
[ "$(jq -c '[.conflicts.after.barrier_drawn, .displacement.cost_shortfall, .shortfall]' plain.json)" = '[3,null,null]' ] ||
    fail "--ease no: $(cat plain.json)"

# Each of the two goes as far as it may, for the price of 0.2 m. Both have to pay that in any case, so the result is
# proved to be the best.
expect 3 "${words[@]}" --ease 30 --stats eased.json
grep -q '^pairs that lack a part of their distance 2, which is 0.4 in sum' out || fail "the summary: $(cat out)"
jq -e '(.displacement | (.cost_moves - 2 * 12.8 * 12.8 - 144 | fabs) < 1e-6 and
    (.cost_shortfall - 2 * (4 * 12.8 * 0.2 + 30 * 0.04) | fabs) < 1e-6 and
    (.cost - .cost_moves - .cost_shortfall | fabs) < 1e-6 and (.cost_alone - .cost_shortfall | fabs) < 1e-6) and
    .conflicts.after.barrier_near == 2 and .conflicts.after.barrier_drawn == 1 and
    .shortfall.pairs == 2 and (.shortfall.sum - 0.4 | fabs) < 1e-6 and .shortfall.tight == 0 and .verified' eased.json \
    >/dev/null || fail "eased: $(cat eased.json)"

# Two houses in a row whose bays do not face each other have 2 m less than the gap along the row, which their limits do
# not allow, though 1 m would take them the gap apart. Easing does not solve the pair against the rule of rows.
printf '%s\n' WKT,w '"POLYGON((0 0,10 0,10 8,12 8,12 10,0 10,0 0))",1' '"POLYGON((14 0,26 0,26 10,16 10,16 2,14 2,14 0))",1' \
    '"POLYGON((33 0,43 0,43 10,33 10,33 0))",1' | layer bays.gpkg bays POLYGON
expect 3 separate bays.gpkg b.gpkg --gap 5 --max-shift 1 --rows auto --ease 30
expect 3 check b.gpkg --input-layer bays --no-blocks --block-field sunder_blk --gap 5 --max-shift 1 --rows auto --before bays.gpkg \
    --stats bays.json
[ "$(jq -c '[.moves.row, .conflicts.too_close]' bays.json)" = '[0,1]' ] || fail "bays: $(cat out)"

# Three houses of a row, of which the one in the middle stands on the road and lacks half a metre: its neighbours follow
# it, each by 10 / 11 of its move, and do not hold it back. F is the sum of 4.5^2 + 4 * 4.5 * 0.5 + 30 * 0.5^2 and of
# 4.5^2 * 10 / 11 for each neighbour.
{
    echo "WKT,w"
    echo '"POLYGON((0 8,20 8,20 28,0 28,0 8))",1'
    echo '"POLYGON((25 2,45 2,45 22,25 22,25 2))",1'
    echo '"POLYGON((50 8,70 8,70 28,50 28,50 8))",1'
} | layer front.gpkg front POLYGON
expect 3 separate front.gpkg follow.gpkg --gap 4 --max-shift 4.5 --rows auto --row-stiffness 10,1 --ease 30 \
    --barrier road.gpkg,width=6 --stats follow.json
jq -e '.rows.rows == 1 and (.displacement.cost - (20.25 + 9 + 7.5 + 2 * 20.25 * 10 / 11) | fabs) < 1e-6 and
    (.rows.kink_p95 - 4.5 / 11 | fabs) < 1e-6' follow.json >/dev/null ||
    fail "neighbours in a row do not follow: $(jq -c '.displacement, .rows' follow.json)"

# A house stands on one end of a road that returns 16 m farther on, and has to be 8 m from both ends. The nearest place
# with that distance is 16 m on the left. But the pair lacks its distance and the length of the least translation, which
# is 2 m to the right: half-way between the two ends it lacks only 5 m. F is 5^2 + 4 * 6 * 5 + 30 * 5^2.
printf '%s\n' WKT,most '"POLYGON((-2 0,8 0,8 20,-2 20,-2 0))",6' | layer bend.gpkg bend POLYGON
printf '%s\n' WKT,w '"LINESTRING(0 -50,0 100,16 100,16 -50)",0' | layer bent_road.gpkg bent_road LINESTRING
expect 3 separate bend.gpkg eased_bend.gpkg --rows no --gap 8 --max-shift-field most --barrier bent_road.gpkg,side=no --stats bend.json
jq -e '(.displacement | (.cost - 895 | fabs) < 1e-6 and (.cost - .lower_bound) < 1e-5 * .cost) and
    (.shortfall.sum - 5 | fabs) < 1e-6' bend.json >/dev/null ||
    fail "between two ends of a road: $(jq -c '.displacement, .shortfall' bend.json)"

# A house among three bent roads, from whose place every small move costs more: the tree of the house finds a layout on
# other sides, and the house is eased from there. The cost, 2,864 in place of 5,540, is proved to be the least.
printf '%s\n' WKT,most '"POLYGON((0 0,10 0,10 17,0 17,0 0))",8' | layer stuck.gpkg stuck POLYGON
printf '%s\n' WKT,w '"LINESTRING(-3 16,-14 3,8 1)",0' '"LINESTRING(6 16,17 13,-9 28)",0' '"LINESTRING(-5 5,10 -11,-9 22)",0' |
    layer bent_roads.gpkg bent_roads LINESTRING
expect 3 separate stuck.gpkg unstuck.gpkg --rows no --gap 5 --max-shift-field most --allow-jumps --barrier bent_roads.gpkg,side=no \
    --stats stuck.json
jq -e '.displacement | .cost - .lower_bound < 1e-4 * .cost' stuck.json >/dev/null || fail "stuck: $(jq -c .displacement stuck.json)"

# The default is 30, also with --proof.
mv o.gpkg eased.gpkg
expect 3 "${words[@]}"
ogr2ogr -q -f CSV eased.csv eased.gpkg houses -lco GEOMETRY=AS_WKT && ogr2ogr -q -f CSV usual.csv o.gpkg houses -lco GEOMETRY=AS_WKT
cmp usual.csv eased.csv || fail "--ease 30 differs from no option"
expect 3 "${words[@]}" --proof p.jsonl
ogr2ogr -q -f CSV proved.csv o.gpkg houses -lco GEOMETRY=AS_WKT
cmp proved.csv eased.csv || fail "a proof changes the result"

# Refused: no price.
for kappa in 0 -1 x nan inf 3, ''; do
    expect 2 "${words[@]}" --ease="$kappa"
done
expect 2 check houses.gpkg --ease 30
finish
