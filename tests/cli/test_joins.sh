# shellcheck shell=bash disable=SC1091
# Which features form a block: those that touch, also interlocking ones; symbols only if a tolerance is given. The
# summary reports overlaps that a small tolerance would join. The number of a block is the FID of a member.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

# A house in the notch of another, drawn 1 mm too wide on all sides: they separate only when it has left the notch.
layer notch.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,30 0,30 40,20 40,20 10,10 10,10 40,0 40,0 0))"
2,"POLYGON((9.999 9.999,20.001 9.999,20.001 60,9.999 60,9.999 9.999))"
3,"POLYGON((0 90,9 90,9 99,0 99,0 90))"
X
expect 0 separate notch.gpkg o.gpkg --touch-tolerance 0.002 --stats s.json -q
same "$(jq -c '[.blocks,.moved,.conflicts.before.overlap,.conflicts.before.inside_blocks]' s.json)" '[1,0,0,1]'
same "$(value o.gpkg houses 1 sunder_blk) $(value o.gpkg houses 2 sunder_blk) $(value o.gpkg houses 3 sunder_blk)" '1 1 (null)'
expect 0 check notch.gpkg --touch-tolerance 0.002
expect 0 check o.gpkg -l houses --no-blocks --block-field sunder_blk --touch-tolerance 0.002 --gap 1
# in their corners the overlapping strips are wider than a disc of the tolerance
expect 3 check notch.gpkg --touch-tolerance 0.001
expect 0 separate notch.gpkg o.gpkg --overwrite --gap 0.02 -q # the default tolerance is a tenth of the gap
same "$(value o.gpkg houses_displacement 1 fid)" '' "no feature moves:"

# Members that overlap by more than the tolerance are listed, others only on request.
expect 0 check notch.gpkg --block-field id --touch-tolerance 0.002
layer both.gpkg houses POLYGON <<'X'
id,grp,WKT
1,a,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
2,a,"POLYGON((9.999 0,20 0,20 10,9.999 10,9.999 0))"
3,a,"POLYGON((19 0,30 0,30 10,19 10,19 0))"
X
expect 0 check both.gpkg --block-field grp --touch-tolerance 0.01
same "$(awk -F'\t' '$7 == "overlap" { print $1, $3, $8 }' out)" '2 3 same_block'
expect 0 check both.gpkg --block-field grp --touch-tolerance 0.01 --list-inside
same "$(awk -F'\t' '$7 == "overlap" { print $1, $3, $8 }' out | tr '\n' ' ')" '1 2 same_block 2 3 same_block '

# The summary at tolerance 0.
expect 3 separate notch.gpkg o.gpkg --overwrite --max-shift 5
same "$(grep -c 'touch-tolerance' out)" 1
says out '1 pair overlaps by no more than 0.01 metre; --touch-tolerance 0.01 would join it into one block'
expect 0 separate notch.gpkg o.gpkg --overwrite --touch-tolerance 0.01
same "$(grep -c 'touch-tolerance' out)" 0
layer feet.gpkg houses POLYGON EPSG:2263 <<'X'
id,WKT
1,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
2,"POLYGON((9.97 0,20 0,20 10,9.97 10,9.97 0))"
3,"POLYGON((19.99 0,30 0,30 10,19.99 10,19.99 0))"
4,"POLYGON((29.96 0,40 0,40 10,29.96 10,29.96 0))"
X
expect 0 separate feet.gpkg o.gpkg --overwrite
says out '2 pairs overlap by no more than 0.0328083 US survey foot; --touch-tolerance 0.0328083 would join them into blocks'
layer bare.gpkg houses POLYGON none <<'X'
id,WKT
1,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
2,"POLYGON((9.995 0,20 0,20 10,9.995 10,9.995 0))"
X
expect 0 separate bare.gpkg o.gpkg --overwrite
says out '1 pair overlaps by no more than 0.01 units; --touch-tolerance 0.01 would'
expect 0 separate bare.gpkg o.gpkg --overwrite --input-crs EPSG:4326
same "$(grep -c 'touch-tolerance' out)" 0 "a tolerance is not proposed in degrees:"
expect 0 separate bare.gpkg o.gpkg --overwrite --gap 0.005 --touch-tolerance 0
same "$(grep -c 'touch-tolerance' out)" 0 "the gap is less than the tolerance that would be proposed:"

# Symbols: fifty that overlap are fifty bodies, unless a tolerance is given.
{
    echo id,size,WKT
    for i in $(seq 50); do echo "$i,$((i % 3 + 1)),POINT($((i / 2)) 0)"; done
} | layer dots.gpkg dots POINT
expect 0 separate dots.gpkg o.gpkg --overwrite --symbol square:4 --stats s.json -q
same "$(jq -c '[.blocks,.conflicts.before.inside_blocks,(.conflicts.before.overlap > 100),.conflicts.after.overlap]' s.json)" \
    '[0,0,true,0]'
expect 3 check dots.gpkg --symbol square:4 --gap 1
expect 0 separate dots.gpkg o.gpkg --overwrite --symbol square:4 --touch-tolerance 4 --stats s.json -q
same "$(jq -c '[.blocks,.conflicts.before.overlap]' s.json)" '[1,0]'
expect 0 separate dots.gpkg o.gpkg --overwrite --symbol square:4 --block-field size --stats s.json -q
same "$(jq -c '.blocks' s.json)" 3
same "$(value o.gpkg dots 7 sunder_blk)" 1 "a block's number is its first member's FID:"

# --symbol-size-field
layer sizes.gpkg dots POINT <<'X'
id,k,sym,WKT
1,2,,POINT(0 0)
2,,disc:3,POINT(50 0)
3,0.5,square:8,POINT(100 0)
X
expect 0 separate sizes.gpkg o.gpkg --overwrite --symbol square:4 --symbol-field sym --symbol-size-field k -q
same "$(geometry o.gpkg dots_symbols 1)" '  POLYGON ((-4 -4,4 -4,4 4,-4 4,-4 -4))'
same "$(geometry o.gpkg dots_symbols 3)" '  POLYGON ((98 -2,102 -2,102 2,98 2,98 -2))'
expect 0 check sizes.gpkg --symbol square:4 --symbol-size-field k --gap 43
expect 3 check sizes.gpkg --symbol square:4 --symbol-size-field k --gap 45
for bad in 0 -2 inf nan big; do
    rm -f wrong.gpkg
    layer wrong.gpkg dots POINT <<X
id,k,WKT
1,1,POINT(0 0)
2,$bad,POINT(9 0)
X
    [ "$bad" = nan ] && is_null wrong.gpkg dots 2 k && continue
    refused 1 "FID 2: the size of the symbol in k is $bad" separate wrong.gpkg never.gpkg --symbol disc:1 \
        --symbol-size-field k
done
refused 1 'no field kk' separate sizes.gpkg never.gpkg --symbol disc:1 --symbol-size-field kk
refused 2 '--symbol-size-field needs --symbol or --symbol-field' separate sizes.gpkg never.gpkg --symbol-size-field k
finish
