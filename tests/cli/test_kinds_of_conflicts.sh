# shellcheck shell=bash disable=SC1091
# Kinds of conflicts with barriers: on the stored line, within the drawn width, near it; the column `missing`; the
# counts of the summary are those of the layers.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

# A road along the x axis, drawn 10 wide, and a gap of 2: the required distance is 7. House 4 is nearer to the line than
# half the width by one unit in the last place, house 3 is exactly at the drawn edge.
layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 -2,10 -2,10 8,0 8,0 -2))"
2,"POLYGON((100 2,110 2,110 12,100 12,100 2))"
3,"POLYGON((200 5,210 5,210 15,200 15,200 5))"
4,"POLYGON((300 4.999999999999999,310 4.999999999999999,310 15,300 15,300 4.999999999999999))"
5,"POLYGON((400 7,410 7,410 17,400 17,400 7))"
6,"POLYGON((500 0,510 0,510 10,500 10,500 0))"
X
layer roads.gpkg roads LINESTRING <<'X'
id,WKT
1,"LINESTRING(-100 0,1000 0)"
X
road=(--barrier roads.gpkg,width=10,gap=2)
kinds='1 barrier 7 9;2 barrier_drawn 7 5;3 barrier_near 7 2;4 barrier_drawn 7 2;6 barrier_drawn 7 7;'
expect 3 check in.gpkg "${road[@]}" --stats s.json
same "$(awk -F'\t' 'NF > 5 { printf "%s %s %s %.15g;", $1, $7, $12, $13 }' out)" "$kinds" "check:"
says out 'barrier 1, barrier drawn 3, barrier near 1,'
counts='{"overlap":0,"too_close":0,"barrier":1,"barrier_drawn":3,"barrier_near":1,"contained":0,"duplicate":0,"inside_blocks":0}'
same "$(jq -c .conflicts s.json)" "$counts"

# With a width and no gap, features that are too near are within the drawn width.
expect 3 check in.gpkg --barrier roads.gpkg,width=14
says out 'barrier 1, barrier drawn 4, barrier near 0,'
# With a gap and no width, there is no drawn width.
expect 3 check in.gpkg --barrier roads.gpkg,gap=7
says out 'barrier 1, barrier drawn 0, barrier near 4,'

# The layer, the summary and the style of a separation that can resolve nothing.
expect 3 separate in.gpkg o.gpkg "${road[@]}" --fixed-where 'fid > 0' --stats s.json
same "$(jq -c '[.conflicts.before,.conflicts.after]' s.json)" "[$counts,$counts]"
for k in 1 2 3 4 5; do
    printf '%s %s %s %.15g;' "$(value o.gpkg houses_conflicts $k fid_a)" "$(value o.gpkg houses_conflicts $k kind)" \
        "$(value o.gpkg houses_conflicts $k required)" "$(value o.gpkg houses_conflicts $k missing)"
done >listed
same "$(cat listed)" "$kinds" "the layer of conflicts:"
says out 'barrier drawn          3          3  meets its drawn width only'
same "$(ogrinfo -q o.gpkg -sql "SELECT COUNT(*) AS n FROM layer_styles WHERE f_table_name = 'houses_conflicts' AND
    styleQML LIKE '%barrier_drawn%' AND styleQML LIKE '%missing%'" | sed -n 's/.*= //p')" 1 "styles that know the kind:"

# The same in parts.
expect 0 plan in.gpkg plan "${road[@]}" --fixed-where 'fid > 0' --shards 2 -q
for k in 1 2; do expect 0 separate --shard $k plan -q; done
expect 3 merge plan parts.gpkg --stats p.json -q
same "$(jq -c .conflicts p.json)" "$(jq -c .conflicts s.json)" "in parts:"

# The column `missing` for pairs of features; members of a block owe each other no distance.
layer pairs.gpkg houses POLYGON <<'X'
id,grp,WKT
a,,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
b,,"POLYGON((8 0,18 0,18 10,8 10,8 0))"
c,,"POLYGON((100 0,110 0,110 10,100 10,100 0))"
d,,"POLYGON((112 0,122 0,122 10,112 10,112 0))"
e,1,"POLYGON((200 0,210 0,210 10,200 10,200 0))"
f,1,"POLYGON((207 0,217 0,217 10,207 10,207 0))"
X
expect 3 check pairs.gpkg --gap 3 --block-field grp
same "$(awk -F'\t' 'NF > 5 { printf "%s %s %s;", $7, $8, $13 }' out)" 'overlap  5;too_close  1;overlap same_block ;'
says out 'overlap 1, too close 1,'
says out 'inside blocks 1 (1 of them listed: it overlaps)'
expect 0 separate pairs.gpkg p.gpkg --gap 3 --block-field grp
says out 'overlap                1          0'
says out 'inside blocks          1          1  1 listed: it overlaps, reason same_block'

# House b moves away from the fixed house a, and keeps its conflict with the fixed house c above, so it is blocked: the
# summary counts it as sunder_st does.
layer jam.gpkg houses POLYGON <<'X'
id,WKT
a,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
b,"POLYGON((9 0,19 0,19 10,9 10,9 0))"
c,"POLYGON((5 8,100 8,100 60,5 60,5 8))"
d,"POLYGON((500 0,510 0,510 10,500 10,500 0))"
e,"POLYGON((509 0,519 0,519 10,509 10,509 0))"
X
expect 3 separate jam.gpkg j.gpkg --max-shift 1.5 --no-blocks --fixed-where "id in ('a','c')" --stats s.json
states() { ogrinfo -q j.gpkg -sql "SELECT COUNT(*) AS n FROM houses WHERE sunder_st = '$1'" | sed -n 's/.*= //p'; }
same "$(value j.gpkg houses 2 sunder_st) $(printf %.6g "$(value j.gpkg houses 2 sunder_dx)")" 'blocked 1'
same "$(jq -c '[.moved,.blocked]' s.json)" "[$(states moved),$(states blocked)]"
says out 'moved 2, blocked 1 (1 of them moved, too), skipped 0'
# ogrinfo prints 15 digits, so 14 are compared.
mean=$(ogrinfo -q j.gpkg -sql 'SELECT AVG(sunder_len) AS m FROM houses WHERE sunder_len > 0' | sed -n 's/.*= //p')
same "$(printf %.14g "$(jq .displacement.mean s.json)")" "$(printf %.14g "$mean")" 'the mean of all that moved:'
finish
