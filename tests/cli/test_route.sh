# shellcheck shell=bash disable=SC1091
# sunder route: keys, exact answers, ties, contact, lines and points, the gap, reasons, layers, wrong usage.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

wall='POLYGON ((2 -9, 4 -9, 4 3, 2 3))'
expect 0 route "$wall" --robot square:2 --from 0,0 --to 6,0
same "$(json keys_unsorted out | tr -d ' \n')" '["command","found","length","path","rounded_is_free","max_deviation","reason"]'
same "$(jq -c 'del(.command)' out)" '{"found":true,"length":12.246211251235321,"path":[[0,0],[1,4],[5,4],[6,0]],"rounded_is_free":true,"max_deviation":null,"reason":null}'
mv out plain
expect 0 route "$wall" --robot square:2 --from 0,0 --to 6,0 --stats s.json
cmp -s out plain && cmp -s s.json plain || fail "--stats changes something, or differs"
rm s.json
expect 0 route "$wall" --robot square:2 --from 0/7,0 --to 12/2,-0 --exact # fractions need not be in lowest terms
same "$(jq -c '[.length,.path]' out)" '[12.246211251235321,[["0","0"],["1","4"],["5","4"],["6","0"]]]'
# The boundary alone, as a line, is an obstacle like the polygon; but inside it the robot has room, and no way out.
fence='LINESTRING (2 -9, 4 -9, 4 3, 2 3, 2 -9)'
expect 0 route "$fence" --robot square:2 --from 0,0 --to 6,0
cmp -s out plain || fail "a line: $(cat out)"
expect 3 route "$fence" --robot square:2 --from 3,0 --to 6,0
same "$(json .reason out)" 'start and goal lie in different components of free space'
same "$(jq -c '[.found,.length,.path,.rounded_is_free]' out)" '[false,null,[],null]'
expect 0 route "$fence" --robot square:2 --from 3,0 --to 6,0 --allow-conflicts
expect 0 route "$fence" --robot square:2 --from 3,2 --to 3,-8 # an exact fit: the route is a degenerate segment
same "$(jq -c '[.length,.path]' out)" '[10,[[3,2],[3,-8]]]'
expect 3 route "$fence" --robot square:2.0000000000000004 --from 3,0 --to 3,-5
same "$(json .reason out)" "at the start the robot's interior meets OBSTACLES"
# A point that the robot's interior may not meet: the route goes around it; of two routes of equal length the
# lexicographically smaller is given.
expect 0 route 'POINT (0 0)' --robot square:2 --from=-5,0 --to=5,0
same "$(jq -c .path out)" '[[-5,0],[-1,-1],[1,-1],[5,0]]'
# an exact fit between two points
expect 0 route 'MULTIPOINT ((0 0), (0 2), (0 -2))' --robot square:2 --from=-5,1 --to=5,1
same "$(jq -c .path out)" '[[-5,1],[5,1]]'
expect 0 route 'GEOMETRYCOLLECTION (POINT (0 0), LINESTRING (0 2, 0 9), POLYGON ((-1 -9, 1 -9, 1 -2, -1 -2)))' --robot square:2 --from=-5,0 --to=5,0 --exact
# an exact fit between the point and the polygon
same "$(jq -c .path out)" '[["-5","0"],["-1","-1"],["1","-1"],["5","0"]]'
# A town of squares with streets exactly as wide as the robot: thousands of routes have the same length.
squares=''
for x in 0 20 40 60 80 100; do for y in 0 20 40 60 80 100; do squares="$squares, (($x $y, $((x + 10)) $y, $((x + 10)) $((y + 10)), $x $((y + 10))))"; done; done
expect 0 route "MULTIPOLYGON (${squares#, })" --robot square:10 --from=15,15 --to=95,95
same "$(jq -c '[.length,.path]' out)" '[160,[[15,15],[15,35],[35,35],[35,55],[55,55],[55,75],[75,75],[75,95],[95,95]]]'
expect 0 route "MULTIPOLYGON (${squares#, })" --robot square:10 --from=95,15 --to=15,95
same "$(jq -c '[.length,.path]' out)" '[160,[[95,15],[15,15],[15,95]]]'
# Distant obstacles do not reduce the precision near the origin, neither of the result nor of the search.
far=''
for x in 0 12 24 36; do
    for y in 1 10 25 35; do far="$far, POLYGON (($x $y, $((x + 7)) $y, $((x + 7)) $((y + 4)), $x $((y + 6))))"; done
done
expect 0 route "GEOMETRYCOLLECTION (${far#, })" --robot square:2 --from=-5,-5 --to 50,49 --exact
mv out near
for at in '1e16 -3e17' '1e300 5e-324'; do
    expect 0 route "GEOMETRYCOLLECTION (POINT ($at)$far)" --robot square:2 --from=-5,-5 --to 50,49 --exact
    cmp -s out near || fail "with a point at $at: $(cat out)"
done
# A file or standard input may contain any kind of geometry that a literal may be.
echo "GEOMETRYCOLLECTION (${far#, })" >far.wkt
expect 0 route @far.wkt --robot square:2 --from=-5,-5 --to 50,49 --exact
cmp -s out near || fail "from a file: $(cat out)"
run route @- --robot square:2 --from=-5,-5 --to 50,49 --exact <far.wkt
cmp -s out near || fail "from standard input: $(cat out)"
echo 'LINESTRING (0 0, 1' >bad.wkt
refused 1 'cannot be read' route @bad.wkt --robot square:2 --from 0,0 --to 1,1
# A robot with a hole: the pole stays inside the ring.
expect 0 route 'POINT (0 0)' --robot 'POLYGON ((-2 -2, 2 -2, 2 2, -2 2), (-1 -1, 1 -1, 1 1, -1 1))' --from=-1,0 --to=1,1
same "$(jq -c .path out)" '[[-1,0],[1,1]]'
expect 3 route 'POINT (0 0)' --robot 'POLYGON ((-2 -2, 2 -2, 2 2, -2 2), (-1 -1, 1 -1, 1 1, -1 1))' --from=0,0 --to=9,9
same "$(json .reason out)" 'start and goal lie in different components of free space'
# A gap: the length around a disc would be 13.6328; the polygon used for the gap contains the disc.
expect 0 route "$wall" --robot square:2 --from 0,0 --to 6,0 --gap 0.5
jq -e '.found and .length > 13.6327 and .length < 13.64 and ([.path[][1]] | max >= 4.5)' out >/dev/null || fail "gap: $(cat out)"
expect 3 route 'MULTIPOINT ((0 0), (0 2), (0 -2))' --robot square:1 --from=0,1 --to=5,1 --gap 0.5000001
expect 0 route "$wall" --robot square:2 --from 0,0 --to 0,0 # there is no free path
same "$(jq -c '[.found,.length,.path]' out)" '[true,0,[[0,0]]]'
expect 0 route 'POLYGON EMPTY' --robot square:2 --from 0,0 --to 3,4
same "$(jq -c '[.length,.path]' out)" '[5,[[0,0],[3,4]]]'

layer in.gpkg walls GEOMETRY <<'X'
id,WKT
7,"POLYGON((2 -9,4 -9,4 3,2 3,2 -9))"
8,"LINESTRING(2 5,4 5)"
9,"POINT(3 9)"
10,"MULTIPOLYGON(((20 0,22 0,22 2,20 2,20 0)),((20 4,22 4,22 6,20 6,20 4)))"
X
expect 3 route in.gpkg --robot square:2 --from 0,0 --to 3,9
same "$(json .reason out)" "at the goal the robot's interior meets layer walls, FID 3"
expect 0 route in.gpkg o.gpkg --robot square:2 --from 0,0 --to 6,0 --free-space --exact
same "$(jq -c '[.path,.max_deviation]' out)" '[[["0","0"],["1","4"],["5","4"],["6","0"]],0]'
same "$(count o.gpkg route) $(value o.gpkg route 2 leg) $(value o.gpkg route 2 len)" '3 2 4'
same "$(geometry o.gpkg route 2)" '  LINESTRING (1 4,5 4)'
[ "$(count o.gpkg route_placements)" -ge 4 ] || fail "only $(count o.gpkg route_placements) placements"
same "$(count o.gpkg route_obstacles) $(count o.gpkg route_free_space)" '3 1'
same "$(count o.gpkg route_degenerate_segments) $(count o.gpkg route_degenerate_points)" '2 0'
same "$(ogrinfo -q -ro o.gpkg -dialect sqlite -sql 'SELECT count(*) AS n FROM route_degenerate_segments WHERE st_astext(geom) IN ("LINESTRING(1 4, 5 4)", "LINESTRING(19 3, 23 3)")' | sed -n 's/.* n .*= //p')" 2
expect 0 route in.gpkg o2.gpkg --robot square:2 --from 0,0 --to 6,0 --where 'id <> 8' --quiet
same "$(ogrinfo -q -ro o2.gpkg | wc -l)" 2
expect 0 route 'POLYGON ((0 0, 1e308 0, 1e308 1e308, 0 1e308))' huge.gpkg --robot square:1e307 --from=-1e308,5e307 --to=1.7e308,5e307 --free-space
same "$(count huge.gpkg route) $(count huge.gpkg route_free_space)" '3 1' # a frame around the obstacles, limited by the greatest double
expect 3 route in.gpkg o3.gpkg --robot square:2 --from 0,0 --to 3,0
same "$(count o3.gpkg route)" 0
expect 0 route in.gpkg --robot square:1m --from 0,0 --to 6,0 --gap 1ft
expect 0 route in.gpkg /vsistdout/ --of GeoJSON --robot square:2 --from 0,0 --to 6,0
same "$(jq -c '.features | length' out)" 3
ogr2ogr -f GPKG -a_srs EPSG:3857 mercator.gpkg in.gpkg walls || fail "ogr2ogr"
expect 0 route mercator.gpkg --robot square:1 --from 0,0 --to 6,0
grep -q 'about 1 times those on the ground (at latitude 0.00)' err || fail "the message does not mention the scale: $(cat err)"
refused 1 'is an input' route in.gpkg in.gpkg --robot square:2 --from 0,0 --to 6,0 --overwrite

refused 2 '--from X,Y is missing' route "$wall" --robot square:2 --to 1,1
refused 2 '--to X,Y is missing' route "$wall" --robot square:2 --from 1,1
refused 2 '--robot SHAPE is missing' route "$wall" --from 0,0 --to 1,1
for at in 1 1, ,1 1,2,3 a,b 1/0,2 1/,2 /2,2 1.5/2,2 nan,1 inf,1 1e999,0 0x1,2 '1 ,2' 1/-2,3; do
    refused 2 'X,Y' route "$wall" --robot square:2 --from "$at" --to 1,1
done
refused 2 'needs OUTPUT' route "$wall" --robot square:2 --from 0,0 --to 1,1 --free-space
refused 2 'has no area' route "$wall" --robot 'POLYGON EMPTY' --from 0,0 --to 1,1
refused 2 'negative' route "$wall" --robot square:2 --from 0,0 --to 1,1 --gap -1
refused 2 'cannot be read' route 'LINESTRING (0 0, 1)' --robot square:2 --from 0,0 --to 1,1
refused 1 'no such file' route nothing.gpkg --robot square:2 --from 0,0 --to 1,1
refused 1 'the layer has no CRS' route "$wall" --robot square:1m --from 0,0 --to 1,1
finish
