# shellcheck shell=bash disable=SC1091
# --rows: the layer of rows, the statistics, and which calls are refused.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

{
    echo "WKT,w"
    for k in 0 1 2 3 4; do
        x=$((12 * k))
        echo "\"POLYGON(($x 0,$((x + 10)) 0,$((x + 10)) 10,$x 10,$x 0))\",1"
    done
} | layer street.gpkg street POLYGON

expect 0 separate street.gpkg o.gpkg --gap 3 --rows auto --stats o.json
grep -q '^rows 1, features in them 5$' out || fail "the summary: $(cat out)"
for figure in 'change of spacing in rows (.*): mean 1, 95 % at most 1' 'turn of the lines between neighbours (degrees): mean 0,'; do
    grep -q "^$figure" out || fail "the summary has no line \"$figure\": $(cat out)"
done
[ "$(jq -c '.rows | [.rows, .features, .kink_share]' o.json)" = '[1,5,0]' ] || fail "the figures: $(jq -c .rows o.json)"
row=$(ogrinfo -q -al o.gpkg street_rows | tr -d '\n')
case $row in *'row (Integer64) = 1 '*'houses (Integer64) = 5 '*'kink_bef (Real) = 0 '*'kink_aft (Real) = '*LINESTRING*) ;; *) fail "the row: $row" ;; esac
[ "$(ogrinfo -q -sql 'SELECT count(*) AS n FROM layer_styles WHERE f_table_name = "street_rows"' o.gpkg | grep -c 'n (Integer) = 1')" = 1 ] ||
    fail "the layer of rows has no style"

# With --rows no there is no layer of rows, and no statistics about them. The default is auto.
expect 0 separate street.gpkg plain.gpkg --gap 3 --rows no --stats plain.json
ogrinfo -q plain.gpkg | grep -q rows && fail "rows, though none are wanted"
[ "$(jq .rows plain.json)" = null ] || fail "figures of rows, though none are wanted"
expect 0 separate street.gpkg usual.gpkg --gap 3 --stats usual.json
same "$(jq -c .displacement usual.json)" "$(jq -c .displacement o.json)" "without the option:"
expect 0 separate street.gpkg main.gpkg --gap 3 --rows auto --layers main
ogrinfo -q main.gpkg | grep -q rows && fail "a layer of rows, though only the main layer was requested"

# Five huts 11 m apart, with a line halfway between the third and the fourth. It ends the row, however short the moves
# are, and so does it in parts: a barrier is read as far from features as a link of a row may be.
{
    echo "WKT,w"
    for x in 0 12 24 36 48; do echo "\"POLYGON(($x 0,$((x + 1)) 0,$((x + 1)) 1,$x 1,$x 0))\",1"; done
} | layer huts.gpkg huts POLYGON
printf 'WKT,k\n"LINESTRING(30.5 -3,30.5 4)",1\n' | layer between.gpkg between LINESTRING
for words in '' '--max-shift 0.1' '--max-shift 0.1 --max-memory 1G'; do
    # shellcheck disable=SC2086
    expect 0 separate huts.gpkg h.gpkg --overwrite --gap 3 --rows auto --barrier between.gpkg,gap=0 $words --stats huts.json
    [ "$(jq -c '.rows | [.rows, .features]' huts.json)" = '[1,3]' ] || fail "huts, $words: $(jq -c .rows huts.json)"
done

# Twelve houses 1 m apart have to be 5 m apart. With --rows no they move to alternating sides; otherwise they stay a row.
{
    echo "WKT,w"
    for k in {0..11}; do
        x=$((11 * k))
        echo "\"POLYGON(($x 0,$((x + 10)) 0,$((x + 10)) 10,$x 10,$x 0))\",1"
    done
} | layer twelve.gpkg twelve POLYGON
expect 0 separate twelve.gpkg row.gpkg --gap 5 --rows auto --stats row.json
expect 0 separate twelve.gpkg free.gpkg --gap 5 --rows no --stats free.json
# Each gap has to grow by e = 4 m: the cost is e^2 n (n^2 - 1) / 12 = 2288, the outermost houses move 22 m, and each of
# eleven springs costs 0.3 e^2.
jq -e '(.displacement.cost_moves - 2288 | fabs) < 1e-6 and (.displacement.cost_rows - 52.8 | fabs) < 1e-6 and
    (.displacement.max - 22 | fabs) < 1e-6 and .rows.kink_p95 == 0 and .displacement.optimality_gap < 1e-5' row.json \
    >/dev/null || fail "twelve houses: $(jq -c '.displacement, .rows' row.json)"
# What an eye sees of a row is measured: kinks, spacing, and the turn of the lines between neighbours.
jq -e '.rows | ([.spacing_mean, .spacing_p95 | . - 4 | fabs < 1e-6] | all) and .turn_mean == 0 and .turn_p95 == 0' row.json \
    >/dev/null || fail "spacing and turn: $(jq -c .rows row.json)"
# Houses with wings, in a row that is turned by 22.6 degrees. Along the row they are less than the gap apart, though
# nowhere nearer than the gap, so the rule of rows forbids that they come nearer to each other along it, even by rounding.
# The first is too near to a fixed house, and has to push the others ahead of it.
awk 'function add(x, y) { p = p sprintf("%s%.3f %.3f", p ? "," : "", 3000 + (12 * x - 5 * y) / 13, 5000 + (5 * x + 12 * y) / 13) }
    function put(w) { printf "\"POLYGON((%s))\",%d\n", p, w; p = "" }
    BEGIN {
        print "WKT,w"
        for (k = 0; k < 5; k++) {
            x = 14 * k; y = 3 * k
            add(x, y); add(x + 3, y); add(x + 3, y - 5); add(x + 12, y - 5); add(x + 12, y)
            add(x + 10, y); add(x + 10, y + 10); add(x, y + 10); add(x, y)
            put(1)
        }
        add(-9, 0); add(-2, 0); add(-2, 9); add(-9, 9); add(-9, 0)
        put(0)
    }' | layer wings.gpkg wings POLYGON
expect 0 separate wings.gpkg w.gpkg --gap 3 --fixed-where 'w = 0' --rows auto --stats wings.json
jq -e '.displacement.cost > 4 and .displacement.cost < 6 and .displacement.optimality_gap < 1e-5' wings.json >/dev/null ||
    fail "houses with wings: $(jq -c .displacement wings.json)"

# Houses in rows and columns, in one contact group. grid COLUMNS LINES APART JITTER SEED MOST
grid() {
    rm -f grid.gpkg grid_out.gpkg
    awk -v nx="$1" -v ny="$2" -v apart="$3" -v j="$4" -v s="$5" '
        function r() { s = s * 16807 % 2147483647; return s / 2147483647 }
        BEGIN {
            print "WKT,w"
            for (a = 0; a < nx; a++) for (b = 0; b < ny; b++) {
                x = 3000 + 11 * a + j * (2 * r() - 1); y = 5000 + (8 + apart) * b + j * (2 * r() - 1)
                w = 10 - r(); h = 8 - r()
                printf "\"POLYGON((%.3f %.3f,%.3f %.3f,%.3f %.3f,%.3f %.3f,%.3f %.3f))\",1\n",
                    x, y, x + w, y, x + w, y + h, x, y + h, x, y
            }
        }' | layer grid.gpkg grid POLYGON
    expect 0 separate grid.gpkg grid_out.gpkg --gap 4 --max-shift 50 --effort 0.1 --rows auto --stats grid.json
    jq -e --argjson most "$6" '.displacement.lower_bound <= .displacement.cost and .displacement.optimality_gap < $most' \
        grid.json >/dev/null || fail "houses in a grid: $(jq -c .displacement grid.json)"
}
grid 6 6 1 0.5 3 0.25 # the bound comes from blocks, which have the springs between their houses
grid 8 6 2 0.8 13 0.01 # the group is perturbed in one round, and proved in the next

# A house is pushed out of its row by a fixed one: with stiffer rows its neighbours follow farther.
{
    echo "WKT,w"
    for k in {0..8}; do
        x=$((14 * k))
        echo "\"POLYGON(($x 0,$((x + 10)) 0,$((x + 10)) 10,$x 10,$x 0))\",1"
    done
    echo '"POLYGON((57 11,65 11,65 40,57 40,57 11))",0'
} | layer pushed.gpkg pushed POLYGON
last=100
for k in 0.01,0.01 1 3 10; do
    expect 0 separate pushed.gpkg bent.gpkg --overwrite --gap 4 --fixed-where 'w = 0' --rows auto --row-stiffness $k --stats bent.json
    jq -e --argjson last "$last" '.rows.kink_p95 < $last and .displacement.optimality_gap < 0.01 and .displacement.cost_rows > 0' \
        bent.json >/dev/null || fail "stiffness $k: $(jq -c '.displacement, .rows' bent.json)"
    last=$(jq .rows.kink_p95 bent.json)
done
for k in 0 -1 x 3, 3,0 3,1,1 nan; do
    expect 2 separate street.gpkg p.gpkg --gap 3 --rows auto --row-stiffness=$k
done
expect 0 check row.gpkg --no-blocks --block-field sunder_blk --gap 5 --rows auto --before twelve.gpkg --stats check.json
[ "$(jq .moves.row check.json)" = 0 ] || fail "the row is broken: $(cat out)"
expect 3 check free.gpkg --no-blocks --block-field sunder_blk --gap 5 --rows auto --before twelve.gpkg --stats check.json
[ "$(jq .moves.row check.json)" -gt 3 ] || fail "broken rows are not found: $(cat out)"
expect 0 check free.gpkg --no-blocks --block-field sunder_blk --gap 5 --rows no --before twelve.gpkg
expect 3 check free.gpkg --no-blocks --block-field sunder_blk --gap 5 --before twelve.gpkg
expect 2 check free.gpkg --gap 5 --rows auto

# A row that cannot become longer, between a fixed house and one that may move 1 m: the run ends.
{
    echo "WKT,most"
    echo '"POLYGON((0 0,10 0,10 8,0 8,0 0))",0'
    echo '"POLYGON((11 0,21 0,21 8,11 8,11 0))",100'
    echo '"POLYGON((22 0,32 0,32 8,22 8,22 0))",1'
} | layer tight.gpkg tight POLYGON
expect 3 separate tight.gpkg t.gpkg --gap 5 --max-shift-field most --rows auto --stats tight.json
[ "$(jq .conflicts.after.too_close tight.json)" -ge 1 ] || fail "a tight row: $(cat out)"

# Refused: points, the layer of rows without the option, proofs.
printf 'WKT,w\n"POINT(0 0)",1\n' | layer points.gpkg points POINT
expect 2 separate points.gpkg p.gpkg --symbol square:1 --rows auto
expect 2 separate street.gpkg p.gpkg --gap 3 --rows no --layers rows
expect 0 separate street.gpkg proved.gpkg --gap 3 --rows auto --proof p.jsonl
[ "$(grep -c '^{"row":' p.jsonl)" = 4 ] || fail "the proof does not name the four pairs of neighbours"
[ ! -e p.gpkg ] || fail "an output of a refused run"
finish
