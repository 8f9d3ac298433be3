# shellcheck shell=bash disable=SC1091
# --proof: a checker that shares no code with the program (check_proof.py) verifies the file, on towns with barriers,
# sides, limits, fixed features and jumps, and on maps if they are beside the repository. Every false statement is
# refused (mutations.py). SUNDER_LAWS=all tests more towns.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
here=$SUNDER_SOURCE/tests/proof
python=$(command -v python3)
. "$here/layers.sh"

# of NAME OPTIONS...: sets the options that select the layer, unless --sql selects it
of() {
    named=(--layer "$1")
    [[ " $* " != *" --sql "* ]] || named=()
}

# least_moves OPTIONS...: sets `asked` to these, with --rows no and --ease no unless they say what rows and prices there are
least_moves() {
    asked=("$@")
    [[ " $* " == *" --rows "* ]] || asked+=(--rows no)
    [[ " $* " == *" --ease "* ]] || asked+=(--ease no)
}

# proved NAME SOURCE OPTIONS...: separates and checks the proof, with --layer buildings
proved() {
    local name=$1 source=$2
    shift 2
    least_moves "$@"
    set -- "${asked[@]}"
    of buildings "$@"
    "$SUNDER" separate "$source" o.gpkg --overwrite -q "${named[@]}" --layers main,displacement,conflicts --proof "$name.jsonl" "$@" 2>err
    case $? in 0 | 3) ;; *) fail "$name: status $?" ;; esac
    python3 "$here/check_proof.py" "$name.jsonl" "$source" "${named[@]}" --result o.gpkg "$@" >said 2>&1 || fail "$name, $*: $(tail -1 said)"
    echo "$name $*: $(tail -1 said)"
}

# refuted NAME SOURCE [--need KIND ...] OPTIONS...: each changed proof is refused
refuted() {
    local name=$1 source=$2
    shift 2
    least_moves "$@"
    set -- "${asked[@]}"
    python3 "$here/mutations.py" "$name.jsonl" "$source" --layer buildings "$@" >said 2>kinds || fail "$name: $(cat said)"
    cat kinds
}

# strange NAME SOURCE OPTIONS...: the proof of another layer, or for other options, is refused
strange() {
    local name=$1 source=$2
    shift 2
    least_moves "$@"
    set -- "${asked[@]}"
    of buildings "$@"
    python3 "$here/check_proof.py" "$name.jsonl" "$source" "${named[@]}" "$@" >said 2>&1
    [ $? = 1 ] && grep -q '^refused: ' said || fail "$name for $source $*: $(cat said)"
}

# not_asked WORDS NAME SOURCE OPTIONS...: a case that the checker does not handle, or for which the program writes no
# proof
not_asked() {
    local words=$1 name=$2 source=$3
    shift 3
    least_moves "$@"
    set -- "${asked[@]}"
    "$python" "$here/check_proof.py" "$name.jsonl" "$source" --layer buildings "$@" >said 2>&1
    [ $? = 2 ] && [[ $(<said) == "not asked about: "*"$words"* ]] || fail "$name for $source $*: $(cat said)"
}

town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
monuments="kind = 'monument'"
roads="$town,layer=roads,width=5"
proved town "$town" --gap 3
proved roads "$town" --gap 3 --max-shift 10 --barrier "$roads"
refuted roads "$town" --gap 3 --max-shift 10 --barrier "$roads" --need hull --need disc --need cone --need part --need child \
    --need twice --need bound --need elsewhere --need shadow --need anchor --need raised
proved tight "$town" --gap 3 --no-blocks --max-shift 2 --fixed-where "$monuments"
refuted tight "$town" --gap 3 --no-blocks --max-shift 2 --fixed-where "$monuments" --need limit --need leaf --need way \
    --need clearance --need blamed
proved jumps "$town" --gap 2 --allow-jumps --contained separate

# A grid of squares that lack a metre each, with limits that are together three metres for two squares. No single pair
# is infeasible, but the pairs of a few cannot all be solved.
make_squares 8 8
crowd=(--gap 3 --no-blocks --max-shift 1.5)
proved squares squares.gpkg "${crowd[@]}"
grep -q '"crowded": true' squares.jsonl || fail "no pair of a grid is crowded"
refuted squares squares.gpkg "${crowd[@]}" --need leaf --need way --need clearance --need blamed --need reason \
    --need crowd
proved width "$town" --gap 1 --max-shift 4 --barrier "$town,layer=roads,width-field=width,gap=0"

# Without effort, or if conflicts remain, pairs alone may prove more than groups: then the file has trees of pairs.
"$SUNDER" separate "$town" o.gpkg --overwrite -q -l buildings --gap 3 --effort 0 --allow-conflicts --proof pairs.jsonl || fail "effort 0"
python3 "$here/check_proof.py" pairs.jsonl "$town" --layer buildings --gap 3 --result o.gpkg >said || fail "effort 0: $(cat said)"
grep -q ' [1-9][0-9]* trees' said || fail "effort 0: $(cat said)"
# The tree of a pair can use all parts of a long barrier.
beside=(--gap 3 --max-shift 10 --barrier "$roads")
"$SUNDER" separate "$town" o.gpkg --overwrite -q -l buildings "${beside[@]}" --effort 0 --allow-conflicts --proof parts.jsonl || fail "effort 0, roads"
python3 "$here/check_proof.py" parts.jsonl "$town" --layer buildings "${beside[@]}" --result o.gpkg >said || fail "effort 0, roads: $(cat said)"
grep -q ' [1-9][0-9]* trees' said || fail "effort 0, roads: $(cat said)"
proved pairs "$town" --gap 5 --max-shift 1 --barrier "$roads"
# Two of these parts may be in one tree.
make_hairpin
proved hairpin between.gpkg --no-blocks --max-shift 10 --barrier hairpin.gpkg,width=1,side=no,gap=0.1
grep -q '"barrier": "hairpin:1".*"barrier": "hairpin:1"' hairpin.jsonl || fail "no tree has two parts of a road"

# The printed bound is the proved one, and the same number is printed without --proof.
same_bound() { # NAME SOURCE OPTIONS...
    local name=$1 source=$2 told=lower_bound
    shift 2
    "$SUNDER" separate "$source" without.gpkg --overwrite -q -l buildings --stats without.json "$@" 2>err
    "$SUNDER" separate "$source" with.gpkg --overwrite -q -l buildings --stats with.json --proof "$name.jsonl" "$@" 2>err
    python3 "$here/check_proof.py" "$name.jsonl" "$source" --layer buildings --result with.gpkg "$@" >said 2>&1 || fail "$name, $*: $(tail -1 said)"
    for which in with without; do ogr2ogr -q -f CSV $which.csv $which.gpkg buildings -lco GEOMETRY=AS_WKT; done
    cmp with.csv without.csv || fail "the result of $name depends on whether a proof is written"
    set -- $(for file in with.json without.json "$name.jsonl"; do grep -Eo "\"$told\": [^,]*" $file | head -1 | cut -d ' ' -f 2; done)
    [ "$1" != 0 ] && [ "$1" = "$2" ] && [ "$1" = "$3" ] || fail "the bound of $name with a proof, without one, and in it: $*"
}
printf 'WKT,w\n"POLYGON((0 0,4 0,4 4,0 4))",1\n"POLYGON((3 0,7 0,7 4,3 4))",1\n' | layer pair.gpkg buildings POLYGON
same_bound pair pair.gpkg --no-blocks
printf 'WKT,w\n"POLYGON((0 0,4 0,4 4,0 4))",1\n"POLYGON((3 0,9 0,9 2,3 2))",1\n"POLYGON((0 5,3 5,3 8,0 8))",1\n' | layer ignored.gpkg buildings POLYGON
same_bound ignored ignored.gpkg --no-blocks --contained ignore --gap 2
# A line with sides through the anchor itself of a house that is shut in by a neighbour: the bound of trees that take
# the side into account stays at 0.
printf 'WKT,w\n"LINESTRING(10 3,6 5)",1\n"LINESTRING(20 -5,2 -7)",1\n' | layer across.gpkg across LINESTRING
printf 'WKT,w\n"POLYGON((0 0,5 0,5 9,0 9))",1\n"POLYGON((6 2,10 2,10 6,6 6))",1\n"POLYGON((-7 0,-2 0,-2 9,-7 9))",1\n' | layer through_anchor.gpkg buildings POLYGON
for effort in 0 1; do
    same_bound through_anchor through_anchor.gpkg --gap 2 --no-blocks --max-shift 3 --barrier across.gpkg,width=1 --allow-jumps --effort $effort
done

# A road runs through a house and comes back below it. The pair is listed, so the house need not keep a distance from
# the lower part of the road, even if the house above needs room.
printf 'WKT,w\n"LINESTRING(%s)",1\n' "-30 5,40 5,44 4,40 3,44 2,40 1,44 0,40 -1,44 -2,40 -3,44 -4,40 -5,44 -6,40 -1.1,-10 -1.1" | layer road.gpkg road LINESTRING
make_houses
proved back houses.gpkg --gap 1 --max-shift 1 --no-blocks --barrier road.gpkg
grep -q 'bound 0.12' said || fail "a listed road owes: $(cat said)"

# A road through a house, 3 above its lower edge. The upper house may not push it deeper into the road, so the upper
# house makes the whole move itself.
make_through
through=(--gap 1 --max-shift 1 --no-blocks --barrier through.gpkg)
proved through houses.gpkg "${through[@]}"
grep -Eq 'bound 0.(25|24999)' said || fail "a house goes deeper into a road: $(cat said)"
refuted through houses.gpkg "${through[@]}" --need depth --need "in it"
proved parted "$town" --gap 3 --max-shift 1 --barrier "$roads"
refuted parted "$town" --gap 3 --max-shift 1 --barrier "$roads" --need kind --need held

# Invalid polygons, whose edges cross and share a length, at points that are not doubles: corners are the nearest
# doubles.
printf 'WKT,w\n"POLYGON((0 0,10 3,10 0.5,0.3 10.1,0 0))",1\n"POLYGON((9 0,20 0,20 10,13 -1,9.5 10,9 0))",1\n"POLYGON((8 9,15 8,15 12,11 8.2,9 12,8 9),(14 10,18 10,18 13,14 13,18 13,14 10))",1\n' |
    layer crossed.gpkg buildings POLYGON
proved crossed crossed.gpkg --gap 0.7 --no-blocks

# A group that is too large to be proved as a whole: its parts have trees, and the file contains all of them.
{
    echo "WKT,w"
    for i in {0..195}; do
        a=$((i / 14)) b=$((i % 14))
        x=$((120 * a + (7 * a + 3 * b) % 5)) y=$((120 * b + (3 * a + 5 * b) % 7))
        echo "\"POLYGON(($x $y,$((x + 100)) $y,$((x + 100)) $((y + 100)),$x $((y + 100))))\",1"
    done
} | layer crowd.gpkg buildings POLYGON
"$SUNDER" separate crowd.gpkg o.gpkg --overwrite -q -l buildings --gap 30 --effort 0.1 --proof crowd.jsonl || fail "a crowd"
python3 "$here/check_proof.py" crowd.jsonl crowd.gpkg --layer buildings --gap 30 --result o.gpkg >said || fail "a crowd: $(cat said)"
grep -Eq 'bound [1-9].* [1-9][0-9]* trees' said || fail "a group in parts: $(cat said)"

# A house between a fixed wall and a line that it overlaps: the shortest way out would lead across the line, but the
# house has to stay on its side.
make_side
proved side wall.gpkg --no-blocks --fixed-where 'w = 1 AND fid = 2' --barrier side.gpkg
grep -q 'bound 16[89]' said || fail "through the line: $(cat said)"
refuted side wall.gpkg --no-blocks --fixed-where 'w = 1 AND fid = 2' --barrier side.gpkg --need side --need "side anchor"

# A house between two walls that need all the room between them. Each wall has two lines, or one line with a bend where
# the house would have to pass. No single line of either wall excludes that; a chord across both does.
corners() { # NAME FILE
    proved "$1" held.gpkg --gap 3 --max-shift 10 --barrier "$2"
    grep -q '"reason": "no_room".*"side_c"' "$1.jsonl" || fail "a corner of $2 has no chord: $(cat "$1.jsonl")"
    refuted "$1" held.gpkg --gap 3 --max-shift 10 --barrier "$2" --need "pulled chord" --need "half a chord" --need "parted sides" \
        --need "side twice" --need "chord as side"
}
make_corners
corners corners corners.gpkg
corners bends bends.gpkg

# A house on the bend of a road, beside an edge that pushes it east. Each leg of the road by itself allows the move, but
# no translation as short as the first least one separates it from both.
make_bend
bend=(--gap 1 --max-shift 1 --barrier bend.gpkg,side=no --barrier edge.gpkg,side=no)
proved bend bent.gpkg "${bend[@]}"
grep -q '"reason": "no_room"' bend.jsonl || fail "a house on a bend has no proof: $(cat bend.jsonl)"
refuted bend bent.gpkg "${bend[@]}" --need slack --need "claimed slack" --need "short slack"

# A block on both sides of a road, and a house that is too near to it at one end. In real numbers the block could slide
# along the road, but not with the coordinates that doubles allow.
make_lane
lane=(--gap 3 --max-shift 2 --no-blocks --block-field k --fixed-where 'w = 2' --allow-jumps --barrier lane.gpkg,width=5,gap=0,side=no)
proved lane lanes.gpkg "${lane[@]}"
grep -q '"still": ' lane.jsonl || fail "a block beside a road has no lattice: $(cat lane.jsonl)"
refuted lane lanes.gpkg "${lane[@]}" --need "let go" --need "one line" --need "pushed line" --need "turned lines" \
    --need "held roughly" --need "held itself"
# The same for houses that the road cuts, at the narrow part of one: no part of it is as deep in the road as the whole.
make_pierced
proved pierced pierced.gpkg "${lane[@]}"
grep -q '"slack": true, "held": true' pierced.jsonl || fail "a block that a road runs through: $(cat pierced.jsonl)"
refuted pierced pierced.gpkg "${lane[@]}" --need "let go" --need "one line" --need "pushed line" --need "turned lines" \
    --need "held roughly" --need "reached line"

# A house too wide for its courtyard: without a limit it would have to jump; and a limit may be too short by itself.
make_yard
yard=(--gap 3 --no-blocks --contained separate)
proved yard yard.gpkg "${yard[@]}"
grep -q '"reason": "jump".*"within": ' yard.jsonl || fail "a house in a yard: $(cat yard.jsonl)"
refuted yard yard.gpkg "${yard[@]}" --need within --need reason
proved short yard.gpkg "${yard[@]}" --max-shift 0.5
grep -q '"reason": "max_shift".*"proof": ' short.jsonl || fail "a limit by itself: $(cat short.jsonl)"
refuted short yard.gpkg "${yard[@]}" --max-shift 0.5 --need leaf

# A house whose anchor is in a courtyard, near the way out; another house blocks the way further in. Along the common
# wall of the two halves of the courtyard the anchor could pass between the shadows of both halves, for less than half
# of the true cost. The pieces that cover that wall lie in the union of both halves, but in neither of them.
make_halves
proved halves halves.gpkg --gap 1 --max-shift 25
grep -q 'bound 172.7' said || fail "along a shared wall: $(cat said)"
refuted halves halves.gpkg --gap 1 --max-shift 25 --need shade
PYTHONPATH=$here python3 - <<'END' || fail "what lies in what"
from problem import in_union, plane
def boxes(*sides): return [plane.Outline([[(a, b), (c, b), (c, d), (a, d)]]) for a, b, c, d in sides]
part = [(0, 0), (8, 2), (10, 10), (2, 8)]
assert in_union(part, boxes((0, 0, 5, 10), (5, 0, 10, 10)))  # with a common wall
assert in_union(part, boxes((0, 0, 7, 10), (3, 0, 10, 10)))  # overlapping
assert in_union(part, boxes((0, 0, 5, 5), (5, 0, 10, 5), (0, 5, 5, 10), (5, 5, 10, 10)))
assert not in_union(part, boxes((0, 0, 5, 10)))
assert not in_union(part, boxes((0, 0, 5, 10), (5, 0, 10, 9)))
assert not in_union(part, boxes((0, 0, 4, 10), (5, 0, 10, 10)))  # with a slit between
assert not in_union(part, boxes((0, 0, 5, 5), (5, 0, 10, 5), (0, 5, 5, 10)))
yard = plane.Outline([[(0, 0), (10, 0), (10, 10), (0, 10)], [(4, 4), (4, 6), (6, 6), (6, 4)]])
assert not in_union(part, [yard])
assert in_union(part, [yard] + boxes((4, 4, 6, 6)))

from nearly_in import lies_in_grown
wide, = boxes((0, 0, 1000, 1000))
# its points are up to 94.9 away from the sides
dent = plane.Outline([[(0, 0), (1000, 0), (1000, 1000), (600, 1000), (500, 700), (400, 1000), (0, 1000)]])
assert [lies_in_grown(wide, dent, d, d, 1) for d in (97, 96, 95, 94, 40)] == [True, True, False, False, False]
assert lies_in_grown(dent, wide, 0, 0.0, 1)
from unions import union_polygons
def corners_of(*sides): return [[len(ring) for ring in rings] for rings in union_polygons(boxes(*sides))]
assert corners_of((0, 0, 3, 3), (2, 2, 5, 5)) == [[8]]
assert corners_of((0, 0, 3, 3), (3, 0, 5, 3)) == [[4]]  # with a common wall
assert corners_of((0, 0, 3, 3), (3, 3, 5, 5)) == [[4], [4]]  # with a common corner
assert corners_of((0, 0, 3, 1), (0, 0, 1, 3), (2, 0, 3, 3), (0, 2, 3, 3)) == [[4, 4]]  # around a courtyard
END

# The decision whether an overlap is thin is the same if impossible positions of the disc are removed in advance.
PYTHONPATH=$here python3 - <<'END' || fail "thin overlaps"
from math import cos, sin
from random import Random
import blocks, check_proof
from drafts import ring, write_layer
r, told, fits = Random(4), set(), blocks.Blocks.disc_fits_at_a_corner
def both(*asked):
    found = []
    for blocks.MANY_PLACES in (0, 1500): found.append(fits(*asked))
    assert found[0] == found[1]
    told.add(found[0])
    return found[0]
def quarters(x, y): return ring(*[(x + 6 * cos(a), y + 6 * sin(a)) for a in sorted(r.uniform(0, 6.28) for _ in range(4))])
blocks.Blocks.disc_fits_at_a_corner, blocks.proposed = both, lambda *_: ()
for k in range(12):
    write_layer("thin.gpkg", "buildings", {1: quarters(0, 0), 2: quarters(r.uniform(3, 8), r.uniform(-4, 4))})
    check_proof.Checker(check_proof.read_options(["x", "thin.gpkg", "--gap", "19", "--touch-tolerance", str(r.choice([0.7, 1.2, 2.5]))]))
assert told == {False, True}
END

# Containment up to the tolerance that depends on the last digit of a corner of the dilated polygon: at that corner, and
# one unit beyond.
make_hanging at
make_hanging beyond
proved beyond beyond.gpkg --gap 3
proved at at.gpkg --gap 3
[ "$(grep -c '^{"block"' at.jsonl),$(grep -c '^{"block"' beyond.jsonl)" = 6,0 ] || fail "what hangs over: $(grep -c '^{"block"' at.jsonl beyond.jsonl)"
strange at beyond.gpkg --gap 3
strange beyond at.gpkg --gap 3

# Buildings whose members overlap or share walls count as their union; so do areas of a barrier.
make_members 12 3 members
make_among_members
members=(--gap 2 --no-blocks --max-shift 3 --barrier street.gpkg,width=2 --barrier woods.gpkg)
proved members members.gpkg "${members[@]}"
make_members 12 1 first
strange members first.gpkg "${members[@]}"
strange members members.gpkg --gap 2 --no-blocks --max-shift 3 --barrier street.gpkg,width=1 --barrier woods.gpkg
proved apart members.gpkg --gap 1.5 --max-shift 3 --no-blocks --weight area
refuted apart members.gpkg --gap 1.5 --max-shift 3 --no-blocks --weight area --need part --need hull --need disc --need heavier

# Symbols of points: five within each other's reach, one of which is too deep in another for its limit.
printf 'WKT,w\n"POINT(0 0)",1\n"POINT(3 1)",1\n"POINT(1.5 3.1)",1\n"POINT(40 0)",1\n"POINT(40.25 0.5)",1\n' |
    layer points.gpkg buildings POINT
for symbol in square:4 rectangle:5x3 disc:2.3 inside-disc:2.5:24 'POLYGON ((-2 -1,2 -2,1 3,-2 -1))'; do
    proved points points.gpkg --gap 0.5 --symbol "$symbol"
    proved points points.gpkg --gap 0.5 --symbol "$symbol" --max-shift 1.25
    grep -q '"reason": "max_shift".*"proof": ' points.jsonl || fail "symbols: $(cat points.jsonl)"
done

# Symbols of single points, from fields: with units, of several polygons, with a hole, at several points of one feature.
make_symbols
own=(--gap 0.5 --symbol square:3 --symbol-field s --symbol-size-field F)
proved symbols symbols.gpkg "${own[@]}"
strange symbols symbols.gpkg --gap 0.5 --symbol square:3 --symbol-field s
strange symbols symbols.gpkg --gap 0.5 --symbol square:3 --symbol-size-field f
strange symbols symbols.gpkg --gap 0.5 --symbol square:2.9 --symbol-field s --symbol-size-field f
proved symbols symbols.gpkg --gap 0.5 --symbol disc:1.5:8 --symbol-field s --symbol-size-field f --max-shift 1 --touch-tolerance 0.2
refuted symbols symbols.gpkg --gap 0.5 --symbol disc:1.5:8 --symbol-field s --symbol-size-field f --max-shift 1 --touch-tolerance 0.2 --need part --need way
proved symbols symbols.gpkg --gap 0.5 --symbol square:3 --symbol-size-field f --contained block --weight sqrt-area

# A barrier in another CRS, with the doubles that ogr2ogr writes; the street from which it was made differs in the last
# digits.
make_abroad
abroad=(--gap 2 --max-shift 4 --no-blocks --barrier)
proved abroad abroad.gpkg "${abroad[@]}" far.gpkg,width=3
grep -q '"street:1"' abroad.jsonl || fail "no line of a proof names the street"
ogr2ogr back.gpkg far.gpkg -t_srs EPSG:25832 2>/dev/null || fail "ogr2ogr: far.gpkg"
python3 "$here/check_proof.py" abroad.jsonl abroad.gpkg --layer buildings "${abroad[@]}" back.gpkg,width=3 --rows no --ease no >said || fail "brought back: $(cat said)"
strange abroad abroad.gpkg "${abroad[@]}" near.gpkg,width=3
PATH=$here not_asked 'ogr2ogr, which does not run' abroad abroad.gpkg "${abroad[@]}" far.gpkg,width=3

# Lengths with units: on the ground, on paper, for a layer in feet.
proved units abroad.gpkg --gap 2.1m --max-shift 0.004km --no-blocks --barrier near.gpkg,width=0.12mm,gap=3ft --scale 1:25000
strange units abroad.gpkg --gap 2.1m --max-shift 0.004km --no-blocks --barrier near.gpkg,width=0.12mm,gap=3ft --scale 1:20000
strange units abroad.gpkg --gap 2.1ft --max-shift 0.004km --no-blocks --barrier near.gpkg,width=0.12mm,gap=3ft --scale 1:25000
for gap in 1m 3ft 3us-ft 0.03mm; do
    proved feet feet.gpkg --gap "$gap" --max-shift 1m --no-blocks --scale 30000
done
not_asked 'there is no --scale' feet feet.gpkg --gap 0.03mm
ogr2ogr degrees.gpkg abroad.gpkg buildings -t_srs EPSG:4326 2>/dev/null || fail "ogr2ogr: abroad.gpkg"
proved degrees degrees.gpkg --gap 0m
not_asked 'coordinates are degrees' degrees degrees.gpkg --gap 1m
not_asked 'has no layer' degrees degrees.gpkg --layer nowhere
not_asked 'there is no field' degrees degrees.gpkg --weight-field nothing
not_asked 'no such column' degrees degrees.gpkg --where 'colour = 1'
not_asked 'No such file' symbols symbols.gpkg --symbol @nowhere.wkt

# Other formats, and selections of a source.
make_formats
formats=(--gap 2 --no-blocks)
proved shp buildings.shp "${formats[@]}" --where 'w < 5' --fixed-where 'w = 2' --barrier alley.fgb,width=3
proved geojson buildings.geojson "${formats[@]}" --sql 'SELECT * FROM buildings WHERE w < 5' --max-shift 3
strange geojson buildings.geojson "${formats[@]}" --sql 'SELECT * FROM buildings WHERE w <> 2' --max-shift 3
proved bbox formats.gpkg "${formats[@]}" --bbox 600000,5400000,600020,5400025
strange bbox formats.gpkg "${formats[@]}" --bbox 600000,5400010.5,600009,5400025
proved feet_told formats.gpkg "${formats[@]}" --input-crs EPSG:2263 --max-shift 3m
proved skip formats.gpkg "${formats[@]}" --invalid skip
proved repaired formats.gpkg "${formats[@]}"
strange repaired formats.gpkg "${formats[@]}" --invalid skip
not_asked 'No such file' skip nowhere.shp

# Arcs: polylines, as ogr2ogr makes them; buildings are enlarged by as much as these may be off.
make_arcs
arcs=(--gap 1 --max-shift 3 --no-blocks --weight area)
proved arcs arcs.gpkg "${arcs[@]}" --barrier bow_street.gpkg,width=1
grep -q '"street:1"' arcs.jsonl || fail "no line of a proof names the street with the arc"
python3 "$here/check_proof.py" arcs.jsonl arcs.gpkg --layer buildings "${arcs[@]}" --barrier chords.gpkg,width=1 --rows no --ease no >said || fail "chords: $(cat said)"
ogr2ogr drawn.gpkg arcs.gpkg -nlt CONVERT_TO_LINEAR 2>/dev/null || fail "ogr2ogr: arcs.gpkg"
strange arcs drawn.gpkg "${arcs[@]}" --barrier chords.gpkg,width=1
ogr2ogr abroad_bow.gpkg bow_street.gpkg -t_srs EPSG:4326 2>/dev/null || fail "ogr2ogr: bow_street.gpkg"
proved abroad_arcs arcs.gpkg "${arcs[@]}" --barrier abroad_bow.gpkg,width=1
grep -q '"street:1"' abroad_arcs.jsonl || fail "no line of a proof names the street with the arc in another CRS"
strange abroad_arcs arcs.gpkg "${arcs[@]}" --barrier bow_street.gpkg,width=1

# With --contained ignore a pair is decided by itself only if neither feature fits into the other within the limits. Here one nearly does,
# by the two boxes; the sides of the larger one leave no room.
make_rings askew.gpkg '1.8 0.4,3.2 -5.4,10 -3.8,8.5 2' '4.2 2.5,0.3 -0.9,7.5 -5.2'
proved askew askew.gpkg --gap 2 --max-shift 1 --contained ignore
grep -q '"max_shift", "blocked_by"' askew.jsonl || fail "a verdict that --max-shift decides is missing"
proved askew askew.gpkg --gap 2 --max-shift 1 --contained separate
make_rings enters.gpkg '0 0,10 0,10 10,0 10' '-0.5 4,1.5 4,1.5 6,-0.5 6'
proved enters enters.gpkg --gap 2 --max-shift 1 --contained ignore
sed -i 's/"unresolved"/"max_shift"/' enters.jsonl
strange enters enters.gpkg --gap 2 --max-shift 1 --contained ignore

# A crowd at one place, for which prices of area prove more than trees do: symbols; and buildings on top of each other,
# some with a corner cut out, three of them one block, some pairs given up.
make_pile 14
proved pile pile.gpkg --symbol square:10
refuted pile pile.gpkg --symbol square:10 --need price --need "price below 0" \
    --need "raised prices" --need "raised unit" --need "odd side" --need "halved side" --need "moved grid" --need "payer twice" \
    --need "left out" --need "shifted payer" --need listed --need heavier --need nailed --need joined --need twice --need bound
make_lying 15
lying=(--effort 0.1 --gap 2 --no-blocks --block-field k --contained separate)
proved lying lying.gpkg "${lying[@]}"
refuted lying lying.gpkg "${lying[@]}" --need price --need "parted block" --need listed --need joined
proved limited pile.gpkg --symbol square:10 --max-shift 14
for name in pile lying limited; do grep -q '"prices": ' $name.jsonl || fail "$name: no prices"; done
PYTHONPATH=$here python3 - <<'END' || fail "what is occupied of squares"
from array import array
from fractions import Fraction
import prices, occupied
class Own(occupied.Lattice):
    def __init__(self, gap): self.shift, self.side, self.disc = 0, S, occupied.polygon_in_disc(gap * S // 2)
S = 1 << 44
def ring(*corners): return [[(int(Fraction(x) * S), int(Fraction(y) * S)) for x, y in corners]]
def total(gap, *polygons):
    lattice = Own(Fraction(gap))
    _, hats, areas = occupied.masses(occupied.in_squares(polygons, lattice), lattice)
    least, most = sum(map(sum, hats)) / 2**20, sum(map(sum, areas)) / 2**20
    assert least <= most < least + 1e-3
    return round(least, 3)
def box(a, b, c, d): return ring((a, b), (c, b), (c, d), (a, d))
assert total(0, box("0.3", "0.2", "3.8", "2.1")) == 6.65
# the common area of members counts once
assert total(0, box(0, 0, 3, 3), box(2, 2, 5, 5), box("2.5", "0.5", "3.5", "2.5")) == 17.75
assert total(0, box(0, 0, 9, 9) + box(2, 2, 5, 4)) == 75  # a hole
assert total(0, ring((0, 0), (4, 1), (1, 3)), ring((0, 3), (3, 0), (4, 2))) == 7.158  # edges that cross
# a square of 4 by 4, a border of width 1, and 16 sin(pi / 16) for the corners
assert total(2, box(0, 0, 4, 4)) == 35.121
_, hats, _ = occupied.masses(occupied.in_squares([box(0, 0, 1, 1)], Own(0)), Own(0))
assert hats == [[1 << 18] * 2] * 2
class Rows(prices.Payer):
    def __init__(self): self.at = 1, 1
for size in (1, 2000):  # digits of 64 bits, and of 128
    most = [array("Q", [2**32 - 1 - k for k in range(size + 1)])] * 3
    assert [row[0] for row in Rows().sums(most, [[size << 20] * size] * 2, 0)] == [(size << 21) * sum(most[0][1:])]
assert prices.find_kinks([[0] * 6, [0] * 6, [0, 0, 5, 0, 0, 0], [0] * 6, [0] * 6]) == [[10, 5, 10, 0], [5, 0, 5, 0], [10, 5, 10, 0]]
END

# Every call writes the same bytes, with any number of threads.
cp roads.jsonl first.jsonl
proved roads "$town" --gap 3 --max-shift 10 --barrier "$roads"
cmp roads.jsonl first.jsonl || fail "another proof"
"$SUNDER" separate "$town" o.gpkg --overwrite -q -l buildings --gap 3 --max-shift 10 --rows no --ease no \
    --barrier "$roads" --threads 3 --proof three.jsonl
cmp roads.jsonl three.jsonl || fail "another proof on three threads"
refused 2 'goes to a file' separate "$town" p.gpkg -l buildings --gap 3 --proof -
refused 2 'that is an input' separate "$town" p.gpkg -l buildings --gap 3 --proof "$town"
refused 2 'that is the file of' separate "$town" p.gpkg -l buildings --gap 3 --proof p.json --stats p.json

if [ "${SUNDER_LAWS:-}" = all ] && [ -x "$SUNDER_BUILD/sunder-town" ]; then
    for seed in 1 2 3 4 5 6; do
        "$SUNDER_BUILD/sunder-town" --buildings 250 --seed $seed --trouble 0.6 town$seed.gpkg >/dev/null || fail "sunder-town"
        for gap in 1 3 5; do
            proved "town$seed" town$seed.gpkg --gap $gap
            proved "town$seed" town$seed.gpkg --gap $gap --max-shift 2 --barrier "town$seed.gpkg,layer=roads,width=4"
            proved "town$seed" town$seed.gpkg --gap $gap --no-blocks --max-shift 1 --allow-jumps
        done
    done
fi
data=$SUNDER_SOURCE/../shared/data
if [ ! -d "$data" ]; then
    echo "without $data: towns alone"
else
    for name in krems_2013 saint_jean_la_poterie; do proved $name "$data/$name.gpkg" --gap 3; done
    ogr2ogr baltimore.gpkg "/vsizip/$data/baltimore_2015_shp.zip" buildings -nln buildings 2>/dev/null || fail "ogr2ogr"
    proved baltimore baltimore.gpkg --gap 3
    # Blocks that share a budget: a conflict with a real solution, whose question about the lattice is expensive, leaves
    # enough budget for the last of them.
    paris=$data/paris_cite_2014.gpkg
    "$SUNDER" separate "$paris" o.gpkg --overwrite -q --input-layer buildings --output-layer main --layers main,conflicts \
        --bbox 652450,6862380,652940,6862830 --barrier "$paris,layer=roads,width=5" --max-shift 10 --effort 0 --proof paris.jsonl 2>err
    for pair in '"a": 1734, "b": 4095,' '"a": 4098, "b": 1832,'; do
        grep "$pair" paris.jsonl | grep -q '"reason": "no_room"' || fail "beside Paris's roads $pair is left open"
    done
    # House 345 beside road 353: that pair alone has a solution, found at the default effort.
    neuss=$data/neuss_2026.gpkg
    for effort in 0 1; do
        "$SUNDER" separate "$neuss" o.gpkg --overwrite -q --input-layer buildings --output-layer main --layers main,conflicts --gap 3 \
            --rows no --ease no --bbox 337737,5674438,337877,5674572 --barrier "$neuss,layer=roads,width=5" --max-shift 10 --effort $effort 2>err
        ogrinfo -q o.gpkg -sql "SELECT COUNT(*) AS n FROM main_conflicts WHERE reason = 'unresolved' AND fid_a = 345 AND barr_fid = 353" |
            grep -q "n (Integer) = $((1 - effort))" ||
            fail "beside Neuss's roads at effort $effort"
    done
fi
finish
