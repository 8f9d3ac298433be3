# shellcheck shell=bash
# Layers of few features, each for one kind of line in a file of --proof; layer() is in tests/cli/lib.sh.

make_side() {
    printf 'WKT,w\n"LINESTRING(9.5 -3,9.5 13)",1\n' | layer side.gpkg side LINESTRING
    printf 'WKT,w\n"POLYGON((0 0,10 0,10 10,0 10))",1\n"POLYGON((-10 -30,0 -30,0 40,-10 40))",1\n' | layer wall.gpkg buildings POLYGON
    printf 'WKT,w\n"LINESTRING(1.5 -30,1.5 40)",1\n' | layer pressing.gpkg pressing LINESTRING
    printf 'WKT,w\n"POLYGON((0 0,2 0,2 2,0 2))",1\n"POLYGON((-10 -30,1 -30,1 40,-10 40))",1\n' | layer pressed.gpkg buildings POLYGON
}

make_corners() {
    printf 'WKT,w\n"POLYGON((1000.1 2000.2,1002.3 2000.4,1002.1 2002.6,999.9 2002.4))",1\n' | layer held.gpkg buildings POLYGON
    printf 'WKT,w\n"LINESTRING(%s)",1\n"LINESTRING(%s)",1\n"LINESTRING(%s)",1\n"LINESTRING(%s)",1\n' '940.3 2005.2,1001.37 2004.61' \
        '1001.37 2004.61,1060.4 2003.9' '940.3 1997.7,1000.83 1998.17' '1000.83 1998.17,1060.4 1998.9' | layer corners.gpkg corners LINESTRING
    printf 'WKT,w\n"LINESTRING(%s)",1\n"LINESTRING(%s)",1\n' '940.3 2005.2,1001.37 2004.61,1060.4 2003.9' \
        '940.3 1997.7,1000.83 1998.17,1060.4 1998.9' | layer bends.gpkg bends LINESTRING
}

make_bend() {
    printf 'WKT,w\n"LINESTRING(-20 8,8 8,8 -20)",1\n' | layer bend.gpkg bend LINESTRING
    printf 'WKT,w\n"LINESTRING(-0.4 -9,-0.4 19)",1\n' | layer edge.gpkg edge LINESTRING
    printf 'WKT,w\n"POLYGON((0 0,10 0,10 10,0 10))",1\n' | layer bent.gpkg buildings POLYGON
}

make_lane() {
    printf 'WKT,w\n"LINESTRING(600001.37 5000002.91,600032.77 5000027.43)",1\n' | layer lane.gpkg lane LINESTRING
    printf 'WKT,w,k\n"%s",1,1\n"%s",1,1\n"%s",2,2\n' \
        "POLYGON((600008.45 5000010.86,600012.74 5000015.01,600009.98 5000018.57,600005.25 5000014.87))" \
        "POLYGON((600011.48 5000008.98,600014.73 5000004.73,600020.64 5000009.35,600018.22 5000014.32))" \
        "POLYGON((600021.39 5000012.94,600024.95 5000008.41,600029.1 5000011.5,600024.8 5000016.9))" | layer lanes.gpkg buildings POLYGON
}

make_pierced() {
    printf 'WKT,w,k\n"%s",1,1\n"%s",1,1\n"%s",2,2\n' \
        "POLYGON((600009.69 5000006.87,600013.39 5000010.27,600010.64 5000010.53,600008.71 5000016.26,600004.65 5000013.34,600009.83 5000009.14))" \
        "POLYGON((600014.70 5000015.09,600017.38 5000014.90,600021.10 5000006.89,600028.02 5000011.03,600027.40 5000011.82,600020.04 5000018.00,600021.19 5000019.78))" \
        "POLYGON((600029.37 5000013.36,600033.23 5000015.73,600029.84 5000020.07,600025.90 5000016.99))" | layer pierced.gpkg buildings POLYGON
}

make_yard() {
    printf 'WKT,w\n"POLYGON((0 0,20 0,20 20,0 20),(2 2,18 2,18 18,2 18))",1\n"POLYGON((1 4,17 4,17 16,1 16))",1\n' |
        layer yard.gpkg buildings POLYGON
}

make_halves() {
    printf 'WKT,w\n"POLYGON((0 0,0 1,-19 1,-19 29,0 29,0 30,-20 30,-20 0))",1\n"POLYGON((0 0,20 0,20 30,0 30,0 29,19 29,19 1,0 1))",1\n%s\n%s\n' \
        '"POLYGON((-6 21,6 21,1 36,-1 36))",1' '"POLYGON((-9 3,9 3,9 20,-9 20))",1' |
        layer halves.gpkg buildings POLYGON
}

# COLUMNS ROWS: squares in a grid that lack a metre or two each.
make_squares() {
    python3 -c '
import sys
columns, rows = map(int, sys.argv[1:])
print("WKT,w")
for k in range(columns * rows):
    x, y = 12 * (k % columns) + k * 7 % 5 / 8, 12 * (k // columns) + k * 3 % 5 / 8
    print(f"\"POLYGON(({x} {y},{x + 10} {y},{x + 10} {y + 10},{x} {y + 10}))\",1")' "$@" | layer squares.gpkg buildings POLYGON
}

# NUMBER of points, nearly at one place; the extent of their random offsets, 2 by default.
make_pile() {
    python3 -c '
import sys
from random import Random
r, wide = Random(7), float(sys.argv[2])
print("WKT,w")
for k in range(int(sys.argv[1])):
    print(f"\"POINT({500000 + r.gauss(0, wide):.3f} {5000000 + r.gauss(0, wide):.3f})\",1")' "$1" "${2:-2}" | layer pile.gpkg buildings POINT
}

# NUMBER of buildings that overlap each other, some with a corner cut out, three of them one block by k.
make_lying() {
    python3 -c '
import sys
from math import cos, sin
from random import Random
r = Random(5)
print("WKT,k")
for k in range(int(sys.argv[1])):
    x, y, a, w, h = r.gauss(600000, 4), r.gauss(5000000, 4), r.uniform(0, 6), r.uniform(8, 12), r.uniform(6, 9)
    cut = [(w, h / 3), (w / 3, h / 3), (w / 3, h)] if k % 3 == 0 else [(w, h)]
    ring = ", ".join(f"{x + cos(a) * u - sin(a) * v:.2f} {y + sin(a) * u + cos(a) * v:.2f}" for u, v in [(0, 0), (w, 0)] + cut + [(0, h)])
    print(f"\"POLYGON(({ring}))\",{1 if k in (2, 3, 7) else 100 + k}")' "$1" | layer lying.gpkg buildings POLYGON
}

# Ten houses: one inside another, which --contained ignore allows; two fixed ones that overlap (w = 3); two of one block
# by k that overlap; one that stays inside another because of its limit m; three in a row that make room.
make_mixed() {
    printf '%s\n' WKT,w,k,m '"POLYGON((0 0,9 0,9 9,0 9))",1,,9' '"POLYGON((2 2,5 2,5 5,2 5))",1,,9' \
        '"POLYGON((30 0,36 0,36 6,30 6))",3,,9' '"POLYGON((34 3,40 3,40 9,34 9))",3,,9' \
        '"POLYGON((60 0,70 0,70 8,60 8))",1,1,9' '"POLYGON((67 2,76 2,76 6,67 6))",2,1,9' '"POLYGON((75.5 0,84 0,84 8,75.5 8))",1,,9' \
        '"POLYGON((100 0,108 0,108 7,100 7))",1,,0.5' '"POLYGON((104 1,112 1,112 6,104 6))",2,,0.25' \
        '"POLYGON((130 0,138 0,138 7,130 7))",1,,9' | layer mixed.gpkg buildings POLYGON
}

make_houses() {
    printf 'WKT,w\n"POLYGON((0 0,10 0,10 10,0 10))",1\n"POLYGON((0 10.5,10 10.5,10 20,0 20))",1\n' |
        layer houses.gpkg buildings POLYGON
}

# Five houses in a row, the last two turned a little; and one that never moves (w = 3) and pushes the third out of the row.
make_row() {
    printf 'WKT,w\n"%s",1\n"%s",2\n"%s",1\n"%s",1\n"%s",1\n"%s",3\n' "POLYGON((0 0,10 0,10 10,0 10))" "POLYGON((11 0,21 0,21 9.5,11 9.5))" \
        "POLYGON((23 0,33 0,33 10,23 10))" "POLYGON((36.5 0.2,46.5 0.5,46.2 10.5,36.2 10.2))" "POLYGON((48 0.6,58 0.9,57.7 10.9,47.7 10.6))" \
        "POLYGON((26 11,31 11,31 20,26 20))" | layer row.gpkg buildings POLYGON
}

# Two houses whose bays do not face each other, and a third one; and a house between two that never move (w = 3).
make_bays() {
    make_rings bays.gpkg '0 0,10 0,10 8,12 8,12 10,0 10' '14 0,26 0,26 10,16 10,16 2,14 2' '33 0,43 0,43 10,33 10'
    printf 'WKT,w\n"POLYGON((0 0,10 0,10 10,0 10))",3\n"POLYGON((12 0,22 0,22 10,12 10))",2\n"POLYGON((24 0,34 0,34 10,24 10))",3\n' |
        layer squeezed.gpkg buildings POLYGON
}

# Three houses at one place; three houses between walls that hold two, one of them of class 0, and one
# on a road; a block of two (by k), of which one is on the road, too, and its neighbour.
make_hidden() {
    printf '%s\n' WKT,class,k '"POLYGON((0 60,10 60,10 70,0 70))",2,' '"POLYGON((0.5 60,10.5 60,10.5 70,0.5 70))",2,' '"POLYGON((0 60.5,10 60.5,10 70.5,0 70.5))",2,' \
        '"POLYGON((0 0,10 0,10 10,0 10))",2,' '"POLYGON((9 0,19 0,19 10,9 10))",1,' '"POLYGON((18 0,28 0,28 10,18 10))",0,' \
        '"POLYGON((100 0,110 0,110 10,100 10))",,' '"POLYGON((100 20,110 20,110 30,100 30))",3,7' '"POLYGON((112 20,120 20,120 30,112 30))",3,7' \
        '"POLYGON((120.25 20,128 20,128 30,120.25 30))",3,' | layer hidden.gpkg buildings POLYGON
    printf '%s\n' WKT,w '"POLYGON((-9 -1,37 -1,37 -0.5,-9 -0.5))",1' '"POLYGON((-9 10.5,37 10.5,37 11,-9 11))",1' '"POLYGON((-1 -1,-0.5 -1,-0.5 11,-1 11))",1' \
        '"POLYGON((28.5 -1,29 -1,29 11,28.5 11))",1' '"LINESTRING(105 -50,105 50)"',1 | layer walls.gpkg walls GEOMETRY
}

# A terrace of four houses that a road covers by 1 m in front, with a wall behind; two houses beside a road, one on it,
# one above a footway; a pair of houses before a wall, of which one has to go even if the road cuts both back.
make_town() {
    {
        echo "WKT,class"
        printf '%s\n' '"POLYGON((0 0,8 0,8 10,0 10))",1' '"POLYGON((8 0,17 0,17 9,8 9))",2' '"POLYGON((17 0,25 0,25 10,17 10))",1' \
            '"POLYGON((25 0,32 1,32 11,25 10))",3'
        echo '"POLYGON((102 0,112 0,112 10,102 10))",1'
        echo '"POLYGON((88 0,98 0,98 10,88 10))",0'
        echo '"POLYGON((97 30,104 30,104 40,97 40))",1'
        echo '"POLYGON((102 60,112 60,112 70,102 70))",1'
        echo '"POLYGON((202 0,212 0,212 10,202 10))",1'
        echo '"POLYGON((206 3,216 3,216 13,206 13))",2'
    } | layer town.gpkg buildings POLYGON
    printf 'WKT,w\n"LINESTRING(-20 -2,50 -2)",5\n"LINESTRING(100 -50,100 180)",6\n"LINESTRING(200 -50,200 80)",6\n"LINESTRING(95 65,120 65)",1\n"LINESTRING(-20 12.5,50 12.5)",0.5\n"LINESTRING(216.5 -50,216.5 50)",0.5\n' |
        layer roads.gpkg roads LINESTRING
}

# Features below a least size of 10: a terrace that becomes deeper; sheds, one of them beside a line (which it would cover when it is larger);
# one turned, with two walls of a nearly common length; one of three wings; one of two parts that would meet; one of two that stay
# apart, a small and a large one; and one that is large enough.
make_sheds() {
    {
        echo "WKT,class"
        printf '%s\n' '"POLYGON((0 0,5 0,5 4,0 4))",1' '"POLYGON((5 0,22 0,22 4,5 4))",1'
        echo '"POLYGON((33 0,36 0,36 3,34 3,33 3))",1'
        echo '"POLYGON((41 1,45 1,45 5,41 5))",2'
        echo '"POLYGON((61 3,67 11,61 15.5,55 7.5))",1'
        echo '"POLYGON((80 0,110 0,110 30,102 30,102 8,80 8))",2'
        echo '"MULTIPOLYGON(((130 0,135 0,135 5,130 5)),((137 0,142 0,142 5,137 5)))",1'
        echo '"MULTIPOLYGON(((160 0,165 0,165 5,160 5)),((187 1,199 1,199 13,187 13,187 6)))",1'
        echo '"POLYGON((114 12,134 12,134 32,114 32))",2'
    } | layer sheds.gpkg buildings MULTIPOLYGON
    printf 'WKT,w\n"LINESTRING(46 -50,46 60)",2\n"LINESTRING(100 -4,210 -4)",4\n' | layer lanes_by.gpkg lanes_by LINESTRING
    printf 'WKT,w\n"LINESTRING(84 -50,84 60)",1\n"LINESTRING(34 -50,35 60)",1\n' | layer lanes_through.gpkg lanes_through LINESTRING
}

make_through() {
    printf 'WKT,w\n"LINESTRING(-30 3,40 3)",1\n' | layer through.gpkg through LINESTRING
}

# PLACE: pairs in which one lies in the other except for one corner. That corner is at a corner of the other one dilated
# by the tolerance (0.3), rounded to the nearest doubles (`at`), or `beyond` it by one unit in the last place.
make_hanging() {
    PYTHONPATH=$here python3 -c '
import sys
from math import cos, inf, nextafter, sin
from random import Random
from discs import within
r = Random(3)
print("WKT,w")
def put(ring): print("\"POLYGON((" + ", ".join(f"{u!r} {v!r}" for u, v in ring) + "))\",1")
for k in range(6):
    x, y, a = 600000 + 60 * k, 5000000, r.uniform(0, 6)
    big = [(x + 10 * cos(a) * u - 10 * sin(a) * v, y + 10 * sin(a) * u + 10 * cos(a) * v) for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    cx, cy = big[k % 4]
    dx, dy = max(within(0.3), key=lambda d: d[0] * (cx - x) + d[1] * (cy - y))
    at = cx + dx, cy + dy
    if sys.argv[1] == "beyond":
        at = tuple(nextafter(v, inf if d > 0 else -inf) for v, d in zip(at, (dx, dy)))
    put(big)
    put([at] + [(x + 0.6 * (u - x), y + 0.6 * (v - y)) for u, v in (big[(k + 1) % 4], big[k % 4 - 1])])' "$1" | layer "$1.gpkg" buildings POLYGON
}

# NUMBER MEMBERS FILE: buildings of at most MEMBERS members, which overlap each other or share walls; half of the
# buildings are rotated.
make_members() {
    python3 -c '
import sys
from math import cos, sin
from random import Random
r = Random(1)
KINDS = [[(0, 0, 9, 6), (6, 3, 12, 10)], [(0, 0, 6, 6), (6, 0, 11, 6)], [(0, 4, 12, 7), (4, 0, 7, 11), (5, 5, 6, 6)], [(0, 0, 9, 9)]]
def ring(x, y, a, box):
    corners = [(box[0], box[1]), (box[2], box[1]), (box[2], box[3]), (box[0], box[3])]
    return "((" + ", ".join(f"{x + cos(a) * u - sin(a) * v:.2f} {y + sin(a) * u + cos(a) * v:.2f}" for u, v in corners) + "))"
print("WKT,w")
for k in range(int(sys.argv[1])):
    x, y, a = 600000 + 13 * (k % 4) + r.uniform(-2, 2), 5000000 + 13 * (k // 4) + r.uniform(-2, 2), r.choice([0, r.uniform(0, 6)])
    print("\"MULTIPOLYGON(" + ", ".join(ring(x, y, a, box) for box in KINDS[k % 4][:int(sys.argv[2])]) + f")\",{1 + k % 3}")' "$1" "$2" |
        layer "$3.gpkg" buildings MULTIPOLYGON
}

# The barriers near them: a road, and an area of two members that overlap.
make_among_members() {
    printf 'WKT,w\n"LINESTRING(599990 5000019,600060 5000021)",1\n' | layer street.gpkg street LINESTRING
    printf 'WKT,w\n"MULTIPOLYGON(((600051 4999990,600060 4999990,600060 5000010,600051 5000010,600051 4999990)),((600053 5000005,600070 5000005,600070 5000040,600053 5000040,600053 5000005)))",1\n' |
        layer woods.gpkg woods MULTIPOLYGON
}

# Houses beside a street in a CRS of degrees, the same street in the CRS of the houses, and the houses in US feet.
make_abroad() {
    printf 'WKT,w\n"%s",1\n"%s",2\n"%s",1\n' "POLYGON((600000 5400000,600010 5400000,600010 5400010,600000 5400010))" \
        "POLYGON((600011 5400001,600021 5400001,600021 5400009,600011 5400009))" \
        "POLYGON((600000 5400011,600009 5400011,600009 5400020,600000 5400020))" >abroad.csv
    layer abroad.gpkg buildings POLYGON <abroad.csv
    layer feet.gpkg buildings POLYGON EPSG:2263 <abroad.csv
    printf 'WKT,w\n"LINESTRING(599980 5399998.9,600015 5399998.7,600040 5399999.5)",1\n' | layer near.gpkg street LINESTRING
    ogr2ogr far.gpkg near.gpkg -t_srs EPSG:4326 2>/dev/null || fail "ogr2ogr: near.gpkg"
}

# Points with a symbol of their own (s), or none, and a factor of its size (f); one feature has two points, one is a
# line.
make_symbols() {
    printf '%s\n' WKT,s,f,k '"POINT(0 0)",square:4,,1' '"POINT(3 1)",disc:2m,1.3,2' '"POINT(1.5 3.1)",,0.7,3' '"MULTIPOINT(40 0,42 1)",,2,4' \
        '"POINT(44.25 0.5)","MULTIPOLYGON(((0 0,4 0,4 4,2 2,1.1 1.3,0 0)),((3 3,6 3,6 6,3 6),(4 4,5 4,5 5)))",1.1,1' \
        '"LINESTRING(0 0,3 3)",,1,1' | layer symbols.gpkg buildings GEOMETRY
}

# Houses between the two arms of one road, each arm of a dozen segments.
make_hairpin() {
    python3 -c '
print("WKT,w")
arm = [(4 * k, -0.8 + k % 2 / 8) for k in range(-4, 9)]
road = arm + [(45, 5)] + [(x, 11.8 - y) for x, y in reversed(arm)]
print("\"LINESTRING(" + ",".join(f"{x} {y}" for x, y in road) + ")\",1")' | layer hairpin.gpkg hairpin LINESTRING
    printf 'WKT,w\n"POLYGON((0 0,10 0,10 6,0 6))",1\n"POLYGON((2 5.5,12 5.5,12 11.5,2 11.5))",1\n' | layer between.gpkg buildings POLYGON
}

# NAME OUTER_TOP INNER_TOP OUTER_BOTTOM INNER_BOTTOM: a house in the narrow passage between two lines with a bend, given
# by their heights.
make_wedge() {
    printf 'WKT,w\n"LINESTRING(%s)",1\n"LINESTRING(%s)",1\n' "940 $2,1001.1 $3,1060 $2" "940 $4,1001.1 $5,1060 $4" |
        layer "$1.gpkg" "$1" LINESTRING
    [ -f wedged.gpkg ] || make_rings wedged.gpkg '1000.1 2000.2,1002.3 2000.4,1002.1 2002.6,999.9 2002.4'
}

# Two houses; one moves by exactly its limit.
make_short() {
    printf 'WKT,m\n"POLYGON((0 0,10 0,10 10,0 10))",0.1\n"POLYGON((3 10.5,9 10.5,6 20))",9\n' | layer short.gpkg buildings POLYGON
}

# A triangle that has no room in the hole of another, and can leave it only by a jump.
make_well() {
    printf 'WKT,w\n"POLYGON((0 40,-34.64 -20,34.64 -20),(0 8,-6.93 -4,6.93 -4))",1\n"POLYGON((0 -12,10.39 6,-10.39 6))",1\n' |
        layer well.gpkg buildings POLYGON
}

# FILE RING...: polygons of one ring each.
make_rings() {
    local file=$1
    shift
    { echo WKT,w && printf '"POLYGON((%s))",1\n' "$@"; } | layer "$file" buildings POLYGON
}

# Seven triangles. Three of them have no joint solution, though each two of these have one.
make_crowd() {
    make_rings crowd.gpkg '599994.2 5000007.3,599993.9 4999994.2,600005.4 5000000.5' \
        '600004.8 5000003.8,599997 4999997.6,600006.3 4999993.9' '599996.1 4999990.5,600005 4999995.8,599996 5000000.9' \
        '599991.4 5000000.8,599995.1 4999990.5,600002.2 4999998.8' '600005.4 5000004,599994.5 5000008.5,599996.1 4999996.8' \
        '599995.9 4999998.4,600004.4 5000001.6,599997.3 5000007.3' '599995.5 5000005.2,599995.2 4999993.3,600005.7 4999999'
}

# Three triangles that overlap each other.
make_three() {
    make_rings three.gpkg '600001.8 5000002.9,600007.3 4999996.5,600010.1 5000004.5' \
        '600000.1 5000005.6,600001.1 4999994.4,600010.3 5000000.8' '599999.5 4999988.9,600005.3 4999998.2,599994.3 4999998.5'
}

# Five houses beside a street, two of them with rings that cross themselves; in three formats.
make_formats() {
    printf 'WKT,w\n"%s",1\n"%s",2\n"%s",1\n"%s",4\n"%s",5\n' "POLYGON((600000 5400000,600010 5400000,600010 5400010,600000 5400010))" \
        "POLYGON((600011 5400001,600021 5400001,600021 5400009,600011 5400009))" \
        "POLYGON((600000 5400011,600009 5400011,600009 5400020,600000 5400020))" \
        "POLYGON((600022 5400000,600032 5400010,600032 5400000,600022 5400010))" \
        "POLYGON((600033 5400001,600041 5400001,600041 5400008,600033 5400008),(600050 5400001,600051 5400001,600051 5400002))" |
        layer formats.gpkg buildings POLYGON
    printf 'WKT,w\n"LINESTRING(599980 5399998.9,600015 5399998.7,600040 5399999.5)",1\n' | layer alley.gpkg alley LINESTRING
    ogr2ogr buildings.shp formats.gpkg 2>/dev/null && ogr2ogr -f GeoJSON buildings.geojson formats.gpkg 2>/dev/null &&
        ogr2ogr -f FlatGeobuf alley.fgb alley.gpkg 2>/dev/null || fail "ogr2ogr: formats.gpkg"
}

# Buildings and a street with arcs: of a ring, of a part of a ring, of a member; one curve polygon has none. The street is once with
# the arc, once with the chords that it is taken as.
make_arcs() {
    printf '%s\n' WKT,w '"CURVEPOLYGON(COMPOUNDCURVE(CIRCULARSTRING(0 0,1.5 3.5,5 5),(5 5,5 -5,0 0)))",1' '"POLYGON((4 -3,11 -3,11 3,4 3))",2' \
        '"CURVEPOLYGON(COMPOUNDCURVE((10.5 -3,17 -3),CIRCULARSTRING(17 -3,20 0,17 3),(17 3,10.5 3,10.5 -3)))",1' \
        '"CURVEPOLYGON((25 0,29 0,29 4,25 4,25 0))",1' '"CURVEPOLYGON(CIRCULARSTRING(5 -12,5 -8,5 -12))",1' \
        '"MULTISURFACE(CURVEPOLYGON(COMPOUNDCURVE(CIRCULARSTRING(28 -3,29 -1,31 0),(31 0,31 -3,28 -3))),((28 6,30 6,30 8,28 8,28 6)))",1' |
        layer arcs.gpkg buildings GEOMETRY
    printf 'WKT,w\n"COMPOUNDCURVE((-10 4,0 4),CIRCULARSTRING(0 4,10 7,20 4))",1\n' | layer bow_street.gpkg street GEOMETRY
    ogr2ogr chords.gpkg bow_street.gpkg -nlt CONVERT_TO_LINEAR 2>/dev/null || fail "ogr2ogr: bow_street.gpkg"
}

# A house without a limit, in an area that it does not leave, and between lines and another area, which leave it no room.
# The conflict with one of them has a solution that makes the others no worse.
make_shut() {
    make_rings shut.gpkg '0 -3,3 0,0 3,-3 0'
    printf 'WKT,w\n"POLYGON((2 -13,2 13,9 13,9 20,-9 20,-9 13,-2 13,-2 -13))",1\n' | layer shut_in.gpkg shut_in POLYGON
    printf 'WKT,w\n"LINESTRING(1 -6,1 4,-3 1,-4 -5)",1\n"LINESTRING(11 7,-11 -4)",1\n' | layer shut_by.gpkg shut_by LINESTRING
    printf 'WKT,w\n"POLYGON((1 0,-10 3,-5 -14,4 -14))",1\n' | layer shut_off.gpkg shut_off POLYGON
}

# Three houses of a row beside a drawn road; the one in the middle stands on it, and lacks half a metre of what the limit allows.
make_front() {
    printf 'WKT,w\n"LINESTRING(-30 0,110 0)",1\n' | layer drawn.gpkg road LINESTRING
    printf 'WKT,w\n"POLYGON((0 8,20 8,20 28,0 28))",1\n"POLYGON((25 2,45 2,45 22,25 22))",1\n"POLYGON((50 8,70 8,70 28,50 28))",1\n' |
        layer front.gpkg buildings POLYGON
}
