# shellcheck shell=bash disable=SC1091
# Tests --barrier: the syntax of its argument, which features are read, and which distances are kept. Each case has a
# distance of its own, so that the conflicts show which one was applied.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

# Two houses, 3 and 20 above a road along the x axis.
layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 3,10 3,10 13,0 13,0 3))"
2,"POLYGON((40 20,50 20,50 30,40 30,40 20))"
X
layer roads.gpkg roads LINESTRING <<'X'
id,w,t,kind,WKT
7,4,4m,"a,b","LINESTRING(-100 0,100 0)"
8,-1,,c,"LINESTRING(-100 500,100 500)"
9,,wide,c,"LINESTRING(-100 900,100 900)"
X
found() { # WANTED ARGS: kinds, layers, FIDs and required distances of what check lists
    local wanted=$1
    shift
    run check in.gpkg -l houses "$@"
    [ "$status" -le 3 ] && [ "$status" -ne 1 ] && [ "$status" -ne 2 ] || fail "status $status: check $*"
    same "$(awk -F'\t' 'NF > 5 { print $1, $5 ":" $6, $7, $12 }' out | tr '\n' ';')" "$wanted" "check $*:"
}

# ---- Width and gap ----
found '' --barrier roads.gpkg
found '' --barrier roads.gpkg,width=6
found '1 roads:1 barrier_drawn 3.25;' --barrier roads.gpkg,width=6.5
found '1 roads:1 barrier_near 4;' --barrier roads.gpkg --gap 4
found '1 roads:1 barrier_near 5;' --barrier roads.gpkg,width=2 --gap 4
found '' --barrier roads.gpkg,width=6,gap=0 --gap 4
found '1 roads:1 barrier_near 3.5;' --barrier roads.gpkg,gap=3.5
found '1 roads:1 barrier_near 3.048;' --barrier roads.gpkg,gap=10ft
found '1 roads:1 barrier_drawn 3.125;' --barrier roads.gpkg,width=0.25mm --scale 25000
found '' --barrier roads.gpkg,width-field=w,gap=1
found '1 roads:1 barrier_near 3.25;' --barrier roads.gpkg,width-field=w,gap=1.25
found '1 roads:1 barrier_drawn 3.25;' --barrier roads.gpkg,width=6.5,side=no
found '1 roads:1 barrier_drawn 3.25;1 roads:1 barrier_near 3.5;' --barrier roads.gpkg,width=6.5 --barrier roads.gpkg,gap=3.5
says out 'barrier drawn 1, barrier near 1'

# ---- Selection ----
found '' --barrier "roads.gpkg,width=9,where=kind = 'c'"
found '1 roads:1 barrier_drawn 4.5;' --barrier "roads.gpkg,width=9,where=kind in ('a,b', 'width=3')"
cp roads.gpkg 'r,1.gpkg'
found '1 roads:1 barrier_drawn 4.5;' --barrier 'r\,1.gpkg,layer=roads,width=9'
ogr2ogr -update roads.gpkg roads.gpkg roads -nln 'main, old' 2>/dev/null
found '1 main, old:1 barrier_drawn 4.5;' --barrier 'roads.gpkg,layer=main\, old,width=9'
refused 1 'choose one with layer=: roads' check in.gpkg --barrier roads.gpkg
ogr2ogr -update in.gpkg roads.gpkg roads 2>/dev/null # a dataset that is also the input
found '1 roads:1 barrier_drawn 4.5;' --barrier 'in.gpkg,layer=roads,width=9'

# ---- Kinds of geometry ----
kinds() { # WKT OPTIONS WANTED
    rm -f k.gpkg
    printf 'id,WKT\n1,"%s"\n' "$1" | layer k.gpkg k GEOMETRY
    found "$3" --barrier "k.gpkg$2"
}
kinds 'POINT(5 0)' ,width=7 '1 k:1 barrier_drawn 3.5;'
kinds 'POINT(12 0)' ,width=7 ''                         # the corner of the square is farther away than 3.5
kinds 'MULTIPOINT Z((5 0 1),(45 19 2))' ,width=7 '1 k:1 barrier_drawn 3.5;2 k:1 barrier_drawn 3.5;'
kinds 'MULTILINESTRING M((0 0 1,9 0 1),(40 18 1,45 18 1))' ,gap=3.5 '1 k:1 barrier_near 3.5;2 k:1 barrier_near 3.5;'
kinds 'POLYGON((0 -9,9 -9,9 0,0 0,0 -9))' ,width=7 '1 k:1 barrier_drawn 3.5;'
kinds 'POLYGON((0 -9,9 -9,9 4,0 4,0 -9))' '' '1 k:1 barrier 0;'
kinds 'POLYGON((-9 -9,99 -9,99 99,-9 99,-9 -9))' '' '1 k:1 barrier 0;2 k:1 barrier 0;'
kinds 'POLYGON((-9 -9,99 -9,99 99,-9 99,-9 -9))' ,as=boundary ''
kinds 'POLYGON((-9 -9,99 -9,99 99,-9 99,-9 -9))' ,as=area '1 k:1 barrier 0;2 k:1 barrier 0;'
kinds 'POLYGON((-9 -9,99 -9,99 99,-9 99,-9 -9),(-1 2,11 2,11 14,-1 14,-1 2))' ,as=boundary,gap=1.5 '1 k:1 barrier_near 1.5;'
kinds 'LINESTRING(5 0,5 5)' '' '1 k:1 barrier 0;'
kinds 'LINESTRING(-5 3,15 3)' '' '' # the line runs along the wall
kinds 'GEOMETRYCOLLECTION(POINT(45 19),LINESTRING(0 1,9 1),POLYGON((60 60,61 60,61 61,60 60)))' ,gap=2.5 \
    '1 k:1 barrier_near 2.5;2 k:1 barrier_near 2.5;'
kinds 'CIRCULARSTRING(0 0,5 2,10 0)' ,gap=2 '1 k:1 barrier_near 2;'
says err 'arcs'
kinds 'CURVEPOLYGON(CIRCULARSTRING(0 0,5 2,10 0,5 -9,0 0))' ,gap=2 '1 k:1 barrier_near 2;'
kinds 'POINT EMPTY' ,width=99 ''
kinds 'POLYGON((0 -9,9 4,9 -9,0 4,0 -9))' ,gap=0 '1 k:1 barrier 0;' # a ring that crosses itself
says err 'barrier k.gpkg, layer k, FID 1: invalid'
run check in.gpkg -l houses --barrier k.gpkg --invalid skip
same "$status" 0 "skipped:"
refused 1 'barrier k.gpkg, layer k, FID 1' check in.gpkg -l houses --barrier k.gpkg --invalid fail

# ---- Another CRS ----
ogr2ogr -t_srs EPSG:4326 -f GeoJSON far.geojson roads.gpkg roads
ogr2ogr -a_srs EPSG:25832 here.gpkg roads.gpkg roads
ogr2ogr -t_srs EPSG:3035 laea.gpkg here.gpkg
found '1 roads:1 barrier_drawn 4.5;' --barrier laea.gpkg,width=9
found '1 roads:7 barrier_drawn 4.5;' --barrier far.geojson,width=9 # its FIDs are the values of id
run check in.gpkg -l houses --barrier laea.gpkg,width=9
awk -F'\t' 'NF > 5 && ($9 - 3 > 1e-3 || 3 - $9 > 1e-3) { exit 1 }' out || fail "transformed by more than a millimetre"
layer none.gpkg none LINESTRING none <<'X'
id,WKT
1,"LINESTRING(-100 0,100 0)"
X
found '1 none:1 barrier_drawn 4.5;' --barrier none.gpkg,width=9
says err 'it has no CRS'

# ---- Reach: barriers out of reach are not read, which an invalid one with --invalid fail shows ----
rm -f tie.gpkg
printf 'id,WKT\n1,"POLYGON((0 100,9 113,9 100,0 113,0 100))"\n' | layer tie.gpkg tie POLYGON
expect 0 check in.gpkg -l houses --barrier tie.gpkg,width=8,gap=1 --invalid fail
refused 1 'layer tie, FID 1' check in.gpkg -l houses --barrier tie.gpkg,gap=71 --invalid fail
# Barriers are read up to four limits away, since the program also computes which longer limit would resolve a conflict.
expect 0 separate in.gpkg o.gpkg -l houses -q --barrier tie.gpkg,gap=1 --max-shift 15 --invalid fail
refused 1 'layer tie, FID 1' separate in.gpkg never.gpkg -l houses --barrier tie.gpkg,gap=1 --max-shift 17.5 --invalid fail
refused 1 'layer tie, FID 1' separate in.gpkg never.gpkg -l houses --barrier tie.gpkg --invalid fail
# The barriers are in the bounding box of all features, but not near any of them. The search radius is that of the
# widest barrier.
layer apart.gpkg a POLYGON <<'X'
id,WKT
1,"POLYGON((-200 0,-190 0,-190 10,-200 10,-200 0))"
2,"POLYGON((200 300,210 300,210 310,200 310,200 300))"
X
expect 0 check apart.gpkg --barrier tie.gpkg,gap=149 --invalid fail
refused 1 'layer tie, FID 1' check apart.gpkg --barrier tie.gpkg,gap=220 --invalid fail
layer wide.gpkg w GEOMETRY <<'X'
id,w,WKT
1,8,"POLYGON((0 100,9 113,9 100,0 113,0 100))"
2,9,"LINESTRING(0 1000,9 1000)"
X
expect 0 check in.gpkg -l houses --barrier wide.gpkg,width-field=w,gap=1 --invalid fail
refused 1 'layer w, FID 1' check in.gpkg -l houses --barrier wide.gpkg,width-field=w,gap=71 --invalid fail
# A longer limit is not proposed if a barrier beyond the limit blocks the solution.
layer shut.gpkg s POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
2,"POLYGON((5 -40,30 -40,30 50,5 50,5 -40))"
X
layer wall.gpkg w LINESTRING <<'X'
id,WKT
1,"LINESTRING(-3 -500,-3 500)"
X
for barrier in '' '--barrier wall.gpkg'; do
    # shellcheck disable=SC2086
    expect 3 separate shut.gpkg o.gpkg -q --overwrite --no-blocks --fixed-where 'id = 2' --max-shift 1 $barrier
    same "$(value o.gpkg s_conflicts 1 reason)" max_shift
    value o.gpkg s_conflicts 1 need_shift >"need$((${#barrier} > 0))"
done
awk '{ exit !($1 >= 5 && $1 < 5.1) }' need0 || fail "need_shift is $(cat need0) without the other barrier"
same "$(cat need1)" '(null)' "need_shift, with a wall in the way"

# ---- Separate ----
expect 0 separate in.gpkg o.gpkg -l houses -q --overwrite --barrier roads.gpkg,layer=roads,width=4,gap=2 --stats s.json
same "$(jq -c '[.conflicts.before.barrier_near,.conflicts.after.barrier_near,.moved,.verified]' s.json)" '[1,0,1,true]'
value o.gpkg houses 1 sunder_dy | awk '{ exit !($1 >= 1 && $1 < 1.0001) }' || fail "moved by $(value o.gpkg houses 1 sunder_dy)"
expect 0 check o.gpkg -l houses --barrier roads.gpkg,layer=roads,width=4,gap=2
expect 3 separate in.gpkg o.gpkg -l houses -q --overwrite --max-shift 0.5 --barrier roads.gpkg,layer=roads,width=4,gap=2
same "$(value o.gpkg houses_conflicts 1 barrier) $(value o.gpkg houses_conflicts 1 barr_fid)" 'roads 1'
same "$(value o.gpkg houses_conflicts 1 kind) $(value o.gpkg houses_conflicts 1 reason)" 'barrier_near max_shift'
same "$(value o.gpkg houses_conflicts 1 fid_b)" '(null)'
# There is no room between a road and a fixed house; the conflict lists what blocks it.
layer squeeze.gpkg s POLYGON <<'X'
id,WKT
1,"POLYGON((0 1,10 1,10 9,0 9,0 1))"
2,"POLYGON((-50 9.5,60 9.5,60 20,-50 20,-50 9.5))"
X
expect 3 separate squeeze.gpkg o.gpkg -q --overwrite --fixed-where 'id = 2' --max-shift 2 --gap 1 \
    --barrier roads.gpkg,layer=roads,width=1
same "$(value o.gpkg s 1 sunder_st)" blocked
grep -q 'roads:1' <<<"$(value o.gpkg s_conflicts 1 blocked_by) $(value o.gpkg s_conflicts 2 blocked_by)" ||
    fail "blocked_by names no barrier"

# ---- No barrier, barriers at every feature, barriers everywhere: the result is verified in each case ----
layer three.gpkg t POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
2,"POLYGON((12 0,22 0,22 10,12 10,12 0))"
3,"POLYGON((0 14,10 14,10 24,0 24,0 14))"
X
beside() { # WKT KEYS STATUS WITH LIMIT [STATUS WITHOUT]: without a limit there is a solution unless a status is given
    local limit status=${4:-0}
    rm -f k.gpkg
    printf 'id,WKT\n1,"%s"\n' "$1" | layer k.gpkg k GEOMETRY
    for limit in '' '--max-shift 8'; do
        [ -z "$limit" ] || status=$3
        # shellcheck disable=SC2086
        expect "$status" separate three.gpkg o.gpkg -q --overwrite --gap 1 $limit --barrier "k.gpkg$2" --stats s.json
        same "$(jq .verified s.json)" true "$1 $limit: verified"
    done
}
beside 'LINESTRING EMPTY' ,width=9 0
beside 'GEOMETRYCOLLECTION EMPTY' ,width=9 0
beside 'MULTILINESTRING((5 5,5 5),(11 5,11 5,11 5))' ,width=3 0          # segments of length zero
# far in both directions, but treated like any line
beside 'LINESTRING(-1e300 0,1e300 1)' ,width=3 0
beside 'POLYGON((-1e15 -1e15,1e15 -1e15,1e15 1e15,-1e15 1e15,-1e15 -1e15))' '' 3
beside 'POLYGON((0 0,10 0,10 10,0 10,0 0))' '' 3                         # the same geometry as a feature
beside 'LINESTRING(-5 12,50 12)' ,width=0,gap=0 0                        # near no feature
beside 'LINESTRING(11 -20,11 40)' ,width=1e9 3
beside 'MULTIPOINT((5 5),(5 5.0000000001),(5 5.000000000000001))' '' 0   # nearly identical points
for ((k = 0; k < 60; k++)); do printf '%s5 %s,15 5.%03d' "$([ $k = 0 ] || echo '),(')" 5 $k; done >fan
beside "MULTILINESTRING(($(cat fan)))" ,width=1 0                        # many lines that start at one point
# A line across the layer costs the same if one or both of its ends are far away, near the origin and in UTM
# coordinates, and the lower bound is at least half of that cost. A road with one corrupt vertex is a line that goes
# there and comes back.
layer utm.gpkg t POLYGON <<'X'
id,WKT
1,"POLYGON((500000 5300000,500010 5300000,500010 5300010,500000 5300010,500000 5300000))"
2,"POLYGON((500030 5300000,500040 5300000,500040 5300010,500030 5300010,500030 5300000))"
3,"POLYGON((500036 5300002,500046 5300002,500046 5300012,500036 5300012,500036 5300002))"
X
across() { # WKT: the cost of the result, rounded, and whether the bound is more than half of it
    rm -f k.gpkg
    printf 'id,WKT\n1,"%s"\n' "$1" | layer k.gpkg k GEOMETRY
    expect 0 separate utm.gpkg o.gpkg -q --overwrite --gap 1 --max-shift 20 --barrier k.gpkg --stats s.json
    jq -r '.displacement | "\(.cost * 100 | round) \(.lower_bound > .cost / 2)"' s.json
}
level=$(across 'LINESTRING(400000 5300003.5,600000 5300003.5)')
upright=$(across 'LINESTRING(500004 5200000,500004 5400000)')
corner=$(across 'LINESTRING(400000 5300003,500003 5300003,500003 5200000)')
for far in 1e15 1e17 1e20 1e100 1e300 1.7976931348623157e308; do
    same "$(across "LINESTRING(-$far 5300003.5,$far 5300003.5)")" "$level" "a line from -$far to $far"
    same "$(across "LINESTRING(500004 -$far,500004 $far)")" "$upright" "a line up from -$far to $far"
    same "$(across "LINESTRING(-$far 5300003,500003 5300003,500003 -$far)")" "$corner" "a corner, its ends at -$far"
done
same "$(across 'LINESTRING(400000 5300003.5,490000 5300003.5,1e20 5300003.5,490000 5300003.5)')" "$level" "a corrupt vertex"

refused 2 'too much for a double' separate three.gpkg never.gpkg --barrier k.gpkg,width=1e308,gap=1.7e308

# ---- Wrong arguments ----
wrong() { refused 2 "$1" check in.gpkg -l houses --barrier "$2"; }
wrong 'roads is none of layer=' roads.gpkg,roads
wrong 'did you mean width=?' roads.gpkg,wdth=3
wrong 'given twice' roads.gpkg,width=3,width=4
wrong 'give one of them' roads.gpkg,width=3,width-field=w
wrong 'name of the dataset is missing' ,width=3
wrong 'must be yes or no' roads.gpkg,side=maybe
wrong 'must be area or boundary' roads.gpkg,as=line
wrong 'negative' roads.gpkg,gap=-1
wrong 'negative' roads.gpkg,width=-1
wrong 'unknown unit' roads.gpkg,width=3parsec
wrong 'where= is empty' roads.gpkg,where=
wrong 'layer= is empty' roads.gpkg,layer=,width=3
wrong 'where= "nonsense = 3"' 'roads.gpkg,layer=roads,where=nonsense = 3'
refused 1 'nofile.gpkg: no such file' check in.gpkg -l houses --barrier nofile.gpkg
refused 1 'has no layer paths; its layers: roads' check in.gpkg -l houses --barrier roads.gpkg,layer=paths
refused 1 'width-field=: layer roads has no field ww' check in.gpkg -l houses \
    --barrier roads.gpkg,layer=roads,width-field=ww
refused 1 'barrier roads.gpkg, layer roads, FID 1: the width in t is 4m' check in.gpkg -l houses \
    --barrier roads.gpkg,layer=roads,width-field=t
refused 2 'roads.gpkg: that is an input' check in.gpkg -l houses --barrier roads.gpkg,layer=roads --stats roads.gpkg
refused 1 'roads.gpkg is an input' separate in.gpkg roads.gpkg -l houses --overwrite --barrier roads.gpkg,layer=roads
expect 1 check in.gpkg -l houses --input-crs EPSG:4326 --barrier roads.gpkg,layer=roads,width=3
says err 'reproject'
expect 0 check in.gpkg -l houses --barrier roads.gpkg,layer=roads -q # with all of these options together
finish
