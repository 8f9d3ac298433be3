# shellcheck shell=bash disable=SC1091
# sunder separate: layers and their fields, status, weights, blocks, limits, summary, statistics, exit status.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

layer in.gpkg houses POLYGON <<'X'
id,w,grp,WKT
a,1,,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
b,3,,"POLYGON((8 0,18 0,18 10,8 10,8 0))"
c,1,1,"POLYGON((100 0,110 0,110 10,100 10,100 0))"
d,1,1,"POLYGON((120 0,130 0,130 10,120 10,120 0))"
e,1,,"POLYGON((128 0,138 0,138 10,128 10,128 0))"
f,1,,"POLYGON((200 0,210 0,210 10,200 10,200 0))"
X
fields() { ogrinfo -ro -so "$1" "$2" | sed -n '/^Geometry Column/,$ s/^\([a-z_]*\): \([A-Za-z0-9]*\).*/\1:\2/p' | tr '\n' ' '; }
moves() { ogrinfo -q -ro "$1" "$2" -dialect sqlite -sql "SELECT fid, round(sunder_dx, 6) AS dx, round(sunder_dy, 6) AS dy FROM $2" |
    sed -n 's/^  d[xy] .* = //p' | tr '\n' ' '; }

expect 0 separate in.gpkg o.gpkg --stats s.json
[ ! -s err ] || fail "stderr is not empty"
says out 'houses: 6 features, 24 vertices'
says out 'moved 4, blocked 0, skipped 0'
says out 'verified on the coordinates as written'
same "$(moves o.gpkg houses)" '-1 0 1 0 0 0 -1 0 1 0 0 0 '
same "$(fields o.gpkg houses)" 'id:String w:Integer grp:Integer sunder_dx:Real sunder_dy:Real sunder_len:Real sunder_st:String sunder_blk:Integer64 '
same "$(fields o.gpkg houses_displacement)" 'fid:Integer64 id:String dx:Real dy:Real len:Real block:Integer64 '
same "$(fields o.gpkg houses_conflicts)" 'fid_a:Integer64 id_a:String fid_b:Integer64 id_b:String barrier:String barr_fid:Integer64 kind:String reason:String distance:Real before:Real depth:Real required:Real missing:Real blocked_by:String need_shift:Real need_gap:Real need_gone:String by_row:Integer '
same "$(count o.gpkg houses) $(count o.gpkg houses_displacement) $(count o.gpkg houses_conflicts)" '6 4 0'
same "$(value o.gpkg houses 1 sunder_st) $(value o.gpkg houses 6 sunder_st) $(value o.gpkg houses 1 sunder_blk)" 'moved unmoved (null)'

same "$(jq -c keys_unsorted s.json)" '["command","layer","unit","features","vertices","blocks","clusters","clusters_optimal","conflicts","moved","blocked","skipped","invalid","null","rounded","displacement","rows","shortfall","verified","losses","seconds","peak_rss_bytes"]'
same "$(jq -c '.conflicts|keys_unsorted' s.json)" '["before","after"]'
same "$(jq -c '.conflicts.after|keys_unsorted' s.json)" '["overlap","too_close","barrier","barrier_drawn","barrier_near","contained","duplicate","inside_blocks"]'
same "$(jq -c '.displacement|keys_unsorted' s.json)" '["total","mean","max","max_fid","cost","cost_moves","cost_rows","cost_shortfall","cost_alone","lower_bound","optimality_gap"]'
same "$(jq -c '.seconds|keys_unsorted' s.json)" '["read","solve","explain","verify","write","total"]'
same "$(jq -c '[.command,.layer,.unit,.features,.vertices,.clusters_optimal,.moved,.null,.verified,.losses]' s.json)" '["separate","houses","metre",6,24,2,4,0,true,[]]'
same "$(jq -c '[.conflicts.before.overlap,.conflicts.after.overlap]' s.json)" '[2,0]'
# The bound is at most the cost; here they are equal up to rounding.
jq -e '.displacement | .cost >= .lower_bound and .lower_bound > 3.999999 and .cost < 4.000001 and .optimality_gap < 1e-6' s.json >/dev/null ||
    fail "cost and bound: $(jq -c .displacement s.json)"
expect 0 separate in.gpkg o2.gpkg --stats -
same "$(json .command out)" separate "--stats - alone on stdout:"

# Weights: b has three times the weight of a. A gap with its unit.
expect 0 separate in.gpkg w.gpkg --weight-field w --gap 2m -q
same "$(moves w.gpkg houses | cut -d' ' -f1,3)" '-3 1'
expect 0 separate in.gpkg w2.gpkg --weight area -q # all have the same area
same "$(moves w2.gpkg houses | cut -d' ' -f1,3)" '-1 1'
expect 0 separate in.gpkg w3.gpkg --weight sqrt-area --weight-field w -q
same "$(moves w3.gpkg houses | cut -d' ' -f1,3)" '-1.5 0.5'
for bad in 0 -1 nan inf heavy; do
    rm -f weights.gpkg
    layer weights.gpkg houses POLYGON <<X
id,w,WKT
a,,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
b,$bad,"POLYGON((8 0,18 0,18 10,8 10,8 0))"
X
    [ "$bad" = nan ] && is_null weights.gpkg houses 2 w && continue
    refused 1 'FID 2' separate weights.gpkg never.gpkg --weight-field w
    expect 0 separate weights.gpkg n.gpkg --weight-field w --ignore-where "id = 'b'" -q --overwrite # a null weight is 1
done
refused 1 'no field nothing' separate in.gpkg never.gpkg --weight-field nothing
for effort in x -1 inf nan ''; do refused 2 'not a number of 0 or more' separate in.gpkg never.gpkg --effort "$effort"; done
expect 0 separate in.gpkg e0.gpkg -q --effort 0 --seed 7 --stats 0.json
expect 0 separate in.gpkg e1.gpkg -q --effort 2.5 --stats 1.json # a greater effort does not raise the cost

# Features with the same value of the block field move together; so do features that touch, unless --no-blocks is given.
expect 0 separate in.gpkg b.gpkg --block-field grp -q
same "$(moves b.gpkg houses | cut -d' ' -f5,7)" "$(moves b.gpkg houses | cut -d' ' -f7,5)" "c and d have the same move"
same "$(value b.gpkg houses 3 sunder_blk) $(value b.gpkg houses 4 sunder_blk) $(value b.gpkg houses 1 sunder_blk)" '3 3 (null)'
refused 1 'no field nothing' separate in.gpkg never.gpkg --block-field nothing
layer row.gpkg row POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((4 0,8 0,8 4,4 4,4 0))"
3,"POLYGON((9 0,13 0,13 4,9 4,9 0))"
X
expect 0 separate row.gpkg r1.gpkg --gap 2 --stats s.json
same "$(jq -c '[.blocks,.conflicts.before.too_close,.conflicts.before.inside_blocks]' s.json)" '[1,1,1]'
same "$(value r1.gpkg row 1 sunder_dx)" "$(value r1.gpkg row 2 sunder_dx)" "a row moves as one:"
expect 0 separate row.gpkg r2.gpkg --gap 2 --stats s.json --no-blocks
same "$(jq -c '[.blocks,.conflicts.before.too_close,.conflicts.after.too_close]' s.json)" '[0,2,0]'
expect 0 separate row.gpkg r3.gpkg --gap 2 --stats s.json --touch-tolerance 1
same "$(jq -c '[.blocks,.moved]' s.json)" '[1,0]'
expect 0 separate row.gpkg r4.gpkg --gap 2 --list-inside -q
same "$(value r4.gpkg row_conflicts 1 kind) $(value r4.gpkg row_conflicts 1 reason)" 'too_close same_block'

# Fixed and ignored features; conflicts that cannot be resolved are listed, and the exit status shows that there are
# some.
expect 0 separate in.gpkg f.gpkg --fixed-where "id = 'a'" -q
same "$(value f.gpkg houses 1 sunder_st) $(moves f.gpkg houses | cut -d' ' -f3)" 'fixed 2'
expect 0 separate in.gpkg g.gpkg --ignore-where "id IN ('a', 'd')" --stats s.json
same "$(value g.gpkg houses 1 sunder_st) $(jq -c '[.moved,.skipped]' s.json)" 'skipped [0,2]'
refused 2 'where' separate in.gpkg never.gpkg --fixed-where 'id = = 3'
expect 3 separate in.gpkg stuck.gpkg --fixed-where "id IN ('a', 'b')" --id-field id --stats s.json
same "$(jq -c '[.conflicts.after.overlap,.moved]' s.json)" '[1,2]'
same "$(for f in fid_a id_a fid_b id_b kind reason; do value stuck.gpkg houses_conflicts 1 $f; done | tr '\n' ' ')" '1 a 2 b overlap fixed '
expect 0 separate in.gpkg stuck2.gpkg --fixed-where "id IN ('a', 'b')" --allow-conflicts -q
expect 3 separate in.gpkg short.gpkg --max-shift 0.25 --stats s.json
same "$(value short.gpkg houses_conflicts 1 reason) $(value short.gpkg houses 1 sunder_st)" 'max_shift blocked'
jq -e '.displacement.max <= 0.25' s.json >/dev/null || fail "a move is longer than --max-shift"
expect 0 separate in.gpkg long.gpkg --max-shift 1.0000001 -q

# Features that are not selected are neither written nor obstacles.
expect 0 separate in.gpkg sel.gpkg --where "id <> 'b'" --stats s.json
same "$(count sel.gpkg houses) $(jq -c .moved s.json)" '5 2'
expect 0 separate in.gpkg sel2.gpkg --bbox 199,0,220,10 -q
same "$(count sel2.gpkg houses)" 1
expect 0 separate in.gpkg sel3.gpkg --sql "SELECT * FROM houses WHERE id < 'c'" -q
same "$(count sel3.gpkg in)" 2 "with --sql the layer is named after the file:"

# Selection of layers; other formats; a pipe.
expect 0 separate in.gpkg l.gpkg --layers main,conflicts -q
same "$(count l.gpkg houses)$(count l.gpkg houses_displacement 2>/dev/null)" 6
expect 0 separate in.gpkg l2.gpkg --layers displacement -q
same "$(count l2.gpkg houses_displacement)" 4
expect 0 separate in.gpkg o.shp
for f in o.shp o_displacement.shp o_conflicts.shp; do [ -s $f ] || fail "no $f"; done
expect 0 separate in.gpkg /vsistdout/ --of GeoJSON
same "$(jq -r '.features|length' out)" 6
expect 0 separate in.gpkg p.gpkg --progress=plain -q --overwrite
[ ! -s err ] || fail "--quiet shows progress"
expect 0 separate in.gpkg p.gpkg --progress=plain --overwrite
cmp -s err <(seq 0 100) || fail "progress is not 0 to 100, a line each"
expect 0 separate in.gpkg p.gpkg --progress --overwrite
says err '100 - done.'
same "$(tr -cd 'a-z ' <err | xargs)" 'read solve explain verify write done' 'stages in the bar:'

# A second run on the result moves no feature, and reports the fields that it replaces.
expect 0 separate o.gpkg again.gpkg -l houses --stats s.json
same "$(jq -c .moved s.json)" 0
says err 'sunder_dx'
same "$(fields again.gpkg houses)" "$(fields o.gpkg houses)" "fields after a second run"

# A feature with a stray vertex can only move by multiples of the vertex's last place: it stays, and the others give
# way.
layer stray.gpkg houses POLYGON <<'X'
id,WKT
a,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
b,"POLYGON((1 1,6 1,6 6,1 6,1 1))"
c,"POLYGON((2 2,1e241 2,6 9,2 9,2 2))"
X
expect 0 separate stray.gpkg stray_out.gpkg --no-blocks --stats s.json
same "$(jq -c '.displacement.cost' s.json)" 21
same "$(jq -c '.conflicts.after.overlap' s.json)" 0
same "$(ogrinfo -q -al stray_out.gpkg houses | sed -n "s/^ *sunder_st (String) = //p" | xargs)" 'moved moved unmoved'
finish
