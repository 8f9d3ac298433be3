# shellcheck shell=bash disable=SC1091
# --rows FIELD: features with equal values that are not null are one row, whatever stands between them.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# box X Y WIDTH HEIGHT VALUE: a feature; VALUE may be empty, which is null
box() { echo "\"POLYGON(($1 $2,$(($1 + $3)) $2,$(($1 + $3)) $(($2 + $4)),$1 $(($2 + $4)),$1 $2))\",$5,0"; }

# Eight houses of one street in mixed order, 1 m apart, of which the fifth is turned into a narrow one that is no
# neighbour of the others by the rules of --rows auto; a house of another street, and one without a street.
{
    echo "WKT,street,w"
    for k in 3 0 6 1 7 4 2 5; do
        [ $k = 4 ] && box 44 4 10 2 A && continue
        box $((11 * k)) 0 10 10 A
    done
    box 0 40 10 10 B
    box 30 40 10 10 ""
} | layer street.gpkg street POLYGON
expect 0 separate street.gpkg o.gpkg --gap 3 --rows street --stats o.json
# e = 2 m in each of 7 gaps: e^2 n (n^2 - 1) / 12 = 168.
jq -e '(.displacement.cost_moves - 168 | fabs) < 1e-6 and .displacement.optimality_gap < 1e-5 and
    ([.rows.rows, .rows.features, .rows.kink_share] == [1, 8, 0])' o.json >/dev/null ||
    fail "a street: $(jq -c '.displacement, .rows' o.json)"
[ "$(ogrinfo -q -al o.gpkg street_rows | grep -c 'houses (Integer64) = 8')" = 1 ] || fail "LAYER_rows has not one row of 8"
# The row begins at the end with the lower FID: the first house is FID 2, the last one FID 5.
ogrinfo -q -al o.gpkg street_rows | grep -q 'LINESTRING (-' || fail "the row begins at the wrong end: $(ogrinfo -q -al o.gpkg street_rows)"
expect 0 separate street.gpkg auto.gpkg --gap 3 --rows auto --stats auto.json
[ "$(jq .rows.features auto.json)" -lt 8 ] || fail "--rows auto has the narrow house in a row, too"

# check takes the rows from the original, also where the result has no such field.
expect 0 separate street.gpkg free.gpkg --gap 3 --rows no --stats free.json
ogr2ogr bare.gpkg free.gpkg street -nln street -select sunder_blk
expect 3 check bare.gpkg --no-blocks --block-field sunder_blk --gap 3 --rows street --before street.gpkg --stats check.json
[ "$(jq .moves.row check.json)" -ge 1 ] || fail "broken rows are not found: $(cat out)"
ogr2ogr kept.gpkg o.gpkg street -nln street -select sunder_blk
expect 0 check kept.gpkg --no-blocks --block-field sunder_blk --gap 3 --rows street --before street.gpkg

# Two houses that share a wall are one block, which counts once; a value on one of the two is enough.
{
    echo "WKT,street,w"
    box 0 0 5 10 A
    box 5 0 5 10 ""
    box 11 0 10 10 A
    box 22 0 10 10 A
} | layer terrace.gpkg terrace POLYGON
expect 0 separate terrace.gpkg t.gpkg --gap 3 --rows street --stats t.json
[ "$(jq -c '[.rows.rows, .rows.features]' t.json)" = '[1,3]' ] || fail "a block in a row: $(jq -c .rows t.json)"

# Two values in one block: an error that names the feature.
{
    echo "WKT,street,w"
    box 0 0 5 10 A
    box 5 0 5 10 B
    box 11 0 10 10 A
} | layer torn.gpkg torn POLYGON
expect 1 separate torn.gpkg x.gpkg --gap 3 --rows street
grep -q 'FID 2: --rows: its row is not that of another feature of its block' err || fail "two rows in a block: $(cat err)"
cp err whole.err
expect 1 separate torn.gpkg x.gpkg --gap 3 --rows street --max-memory 1G
cmp whole.err err || fail "in parts: $(cat err)"
expect 0 separate torn.gpkg split.gpkg --gap 3 --rows street --no-blocks

# A barrier's line between two neighbours: the springs act, and there is no rule of order.
{
    echo "WKT,street,w"
    for k in 0 1 2; do box $((20 * k)) 0 10 10 A; done
    echo '"POLYGON((13 30,17 30,17 40,13 40,13 30))",,0'
} | layer crossed.gpkg crossed POLYGON
printf 'WKT,k\n"LINESTRING(15 -20,15 25)",1\n' | layer line.gpkg line LINESTRING
expect 0 separate crossed.gpkg c.gpkg --gap 6 --rows street --barrier line.gpkg,gap=6 --stats c.json
jq -e '.rows.rows == 1 and .displacement.cost_rows > 0' c.json >/dev/null || fail "a row across a line: $(jq -c '.displacement, .rows' c.json)"

# A field that does not exist is named; null everywhere is no row; one value each is none either.
expect 1 separate street.gpkg x.gpkg --gap 3 --rows avenue
grep -q avenue err || fail "the field is not named: $(cat err)"
expect 0 separate street.gpkg nulls.gpkg --gap 3 --rows w --where "street IS NULL" --stats nulls.json
[ "$(jq .rows.rows nulls.json)" = 0 ] || fail "a row of one: $(jq -c .rows nulls.json)"

# The same rows for any order of features and any number of threads.
ogr2ogr -sql "SELECT * FROM street ORDER BY ST_MinX(geom) DESC" -nln street mixed.gpkg street.gpkg 2>/dev/null || cp street.gpkg mixed.gpkg
expect 0 separate mixed.gpkg m.gpkg --gap 3 --rows street --threads 4 --stats m.json
jq -e --argjson c "$(jq .displacement.cost o.json)" '(.displacement.cost - $c | fabs) < 1e-9' m.json >/dev/null ||
    fail "another order: $(jq -c .displacement m.json)"
finish
