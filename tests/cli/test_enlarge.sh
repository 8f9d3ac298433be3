# shellcheck shell=bash disable=SC1091
# --enlarge with --min-size: what becomes larger and what does not, what is written about it, and which calls are
# refused.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# Two houses with a common wall, 4 m deep; a shed of 3 m; a large house; a feature of two squares of 5 m, 2 m apart; a
# house with a yard whose walls are 4 m thick.
{
    echo "WKT,name,class"
    echo '"POLYGON((0 0,5 0,5 4,0 4,0 0))",left,1'
    echo '"POLYGON((5 0,22 0,22 4,5 4,5 0))",right,1'
    echo '"POLYGON((40 0,43 0,43 3,40 3,40 0))",shed,2'
    echo '"POLYGON((60 0,80 0,80 20,60 20,60 0))",large,1'
    echo '"MULTIPOLYGON(((100 0,105 0,105 5,100 5,100 0)),((107 0,112 0,112 5,107 5,107 0)))",two,1'
    echo '"POLYGON((200 0,230 0,230 30,200 30,200 0),(204 4,204 26,226 26,226 4,204 4))",yard,1'
} | layer h.gpkg houses MULTIPOLYGON
words=(--gap 3 --max-shift 10 --rows no)

# box FILE NAME: the box of a house
box() {
    ogr2ogr -f CSV /vsistdout/ "$1" -dialect SQLite -sql \
        "select round(MbrMinX(geom),4)||' '||round(MbrMinY(geom),4)||' '||round(MbrMaxX(geom),4)||' '||round(MbrMaxY(geom),4) b from houses where name = '$2'" |
        tail -n 1 | tr -d '"'
}

expect 0 separate h.gpkg o.gpkg "${words[@]}" --enlarge --min-size 10 --stats o.json --report o.html
grep -q '^enlarged 5$' out || fail "the summary: $(cat out)"
grep -q '5 features were made larger first, so that 10' o.html || fail "the page has no word of it"
same "$(jq -c '[.enlarged, .hidden.count, .shrunk.trimmed, .verified]' o.json)" '[5,0,0,true]' "the figures:"
same "$(box o.gpkg left) / $(box o.gpkg right)" "0.0 -3.0 5.0 7.0 / 5.0 -3.0 22.0 7.0" "a terrace becomes deeper, and not longer:"
same "$(box o.gpkg shed)" "36.5 -3.5 46.5 6.5" "a shed:"
same "$(box o.gpkg large)" "60.0 0.0 80.0 20.0" "a large house:"
same "$(box o.gpkg two)" "94.0 -2.5 118.0 7.5" "two squares that would meet grow as one:"
# A square ring of 4 m has room for a disc of 4 m * 2 sqrt 2 / (1 + sqrt 2) = 4.6863 m in each corner.
read -r x0 y0 x1 y1 <<<"$(box o.gpkg yard)"
awk -v w="$(echo "$x1 $x0" | awk '{print $1 - $2}')" 'BEGIN { exit !(w > 30 * 10 / 4.6863 * 0.999 && w < 30 * 10 / 4.6863 * 1.02) }' ||
    fail "a house with a yard: $x0 $y0 $x1 $y1"
same "$(house o.gpkg left sunder_lvl),$(house o.gpkg left sunder_cut),$(house o.gpkg large sunder_cut)" "0,-1.5,0" "the columns:"
awk -v is="$(house o.gpkg shed sunder_siz)" 'BEGIN { exit !(is > 9.98 && is <= 10) }' || fail "the size: $(house o.gpkg shed sunder_siz)"
awk -v is="$(house o.gpkg yard sunder_siz)" 'BEGIN { exit !(is > 9.95 && is < 10.1) }' || fail "the size: $(house o.gpkg yard sunder_siz)"
same "$(house o.gpkg left sunder_blk),$(house o.gpkg right sunder_blk),$(house o.gpkg shed sunder_blk | tr -d ,)" "1,1," "the blocks:"

# A rigid feature and its block keep their shapes. A fixed feature grows, and an ignored one does not.
expect 0 separate h.gpkg r.gpkg "${words[@]}" --enlarge --min-size 10 --rigid-where "name = 'left'" --stats r.json \
    --fixed-where "name = 'shed'" --ignore-where "name = 'yard'"
same "$(box r.gpkg right) / $(box r.gpkg shed) / $(box r.gpkg yard)" "5.0 0.0 22.0 4.0 / 36.5 -3.5 46.5 6.5 / 200.0 0.0 230.0 30.0" "rigid, fixed, ignored:"
same "$(jq -c '.enlarged' r.json)" 2 "their number:"

# Nothing changes where none is too small.
expect 0 separate h.gpkg n.csv "${words[@]}" --lco GEOMETRY=AS_WKT --layers main
expect 0 separate h.gpkg n.gpkg "${words[@]}"
expect 0 separate h.gpkg z.csv "${words[@]}" --lco GEOMETRY=AS_WKT --layers main --min-size 0.5 --enlarge
cmp -s <(cut -d'"' -f2 n.csv | tail -n +2) <(cut -d'"' -f2 z.csv | tail -n +2) || fail "a shape changes, though none is too small"

# Larger houses need more room: 3 m between sheds of 10 m that stood 4 m apart. Hidden ones are written as given.
{
    echo "WKT,name"
    echo '"POLYGON((0 0,3 0,3 3,0 3,0 0))",a'
    echo '"POLYGON((7 0,10 0,10 3,7 3,7 0))",b'
} | layer p.gpkg houses POLYGON
expect 0 separate p.gpkg q.gpkg "${words[@]}" --enlarge --min-size 10 --stats q.json
same "$(jq -c '[.conflicts.before.overlap, .moved]' q.json)" '[1,2]' "two sheds:"
expect 0 separate p.gpkg q.gpkg --overwrite --gap 3 --max-shift 1 --enlarge --min-size 10 --hide --stats q.json
same "$(jq -c '[.hidden.count, .hidden.weight, .enlarged]' q.json)" '[1,3,2]' "one of them has to go, and weighs what it did:"
for name in a b; do
    case $(house q.gpkg "$name" sunder_inv) in
    1)
        same "$(house q.gpkg "$name" sunder_siz | cut -c1-4),$(house q.gpkg "$name" sunder_cut)" "3,0" "hidden:"
        same "$(box q.gpkg "$name")" "$(box p.gpkg "$name")" "hidden, and written as given:"
        same "$(ogrinfo -q q.gpkg -dialect SQLite -sql 'SELECT ST_Area(geom) AS a FROM houses_hidden' | sed -n 's/.*a (Real) = //p')" 9 "its area:"
        ;;
    *) same "$(house q.gpkg "$name" sunder_lvl)" 0 "visible:" ;;
    esac
done

# A house 1 m beside the line of a road covers it when it is larger. It owes the road its distance all the same, on its
# own side, and is not one that the road crosses.
echo '"POLYGON((0 1,4 1,4 5,0 5,0 1))",beside' | cat <(echo WKT,name) - | layer b.gpkg houses POLYGON
echo '"LINESTRING(-50 0,50 0)",1' | cat <(echo WKT,w) - | layer road.gpkg roads LINESTRING
expect 0 separate b.gpkg c.gpkg --gap 1 --barrier road.gpkg,width=2 --max-shift 10 --enlarge --min-size 12 --hide --stats c.json
same "$(box c.gpkg beside)" "-4.0 2.0 8.0 14.0" "beside a road:"

# The check makes the larger shapes again, with the blocks of the result. A feature that kept its shape is too small, and
# one that was changed otherwise is altered.
checks=("${words[@]}" --no-blocks --block-field sunder_blk --before h.gpkg)
expect 0 check o.gpkg -l houses "${checks[@]}" --enlarge --min-size 10 --stats k.json
same "$(jq -c '[.moves.altered, .moves.too_small, .moves.lost, .moves.worse]' k.json)" '[0,0,0,0]' "the check:"
expect 3 check o.gpkg -l houses "${checks[@]}" --stats k.json
same "$(jq -c '[.moves.altered, .moves.not_a_translate]' k.json)" '[null,5]' "the check without --enlarge:"
expect 3 check o.gpkg -l houses "${checks[@]}" --enlarge --min-size 9 --stats k.json
# By itself the house of 5 m has no room for the disc.
same "$(jq -c '[.moves.altered, .moves.too_small]' k.json)" '[4,1]' "the check with another size:"
expect 3 check n.gpkg -l houses "${checks[@]}" --enlarge --min-size 10 --stats k.json
same "$(jq -c '[.moves.altered, .moves.too_small]' k.json)" '[0,5]' "features that are not larger:"

# The same bytes for any number of threads; with a huge least size the block of two is left.
for threads in 1 4; do
    expect 0 separate h.gpkg "t$threads.csv" "${words[@]}" --lco GEOMETRY=AS_WKT --layers main --threads "$threads" --enlarge --min-size 9.3
done
cmp -s t1.csv t4.csv || fail "other threads, another result"
expect 0 separate h.gpkg g.gpkg --gap 3 --max-shift 10 --enlarge --min-size 1e6 --hide --stats g.json
same "$(jq -c '[.enlarged, .hidden.count]' g.json)" '[6,4]' "a huge least size:"

expect 2 separate h.gpkg x.gpkg --enlarge
grep -q -- '--enlarge needs --min-size' err || fail "the message: $(cat err)"
expect 2 separate h.gpkg x.gpkg --enlarge --min-size 0
grep -q -- '--enlarge: --min-size 0 must be above 0' err || fail "the message: $(cat err)"
expect 2 separate h.gpkg x.gpkg --enlarge --min-size=-1
expect 2 separate h.gpkg x.gpkg --enlarge --min-size 3 --symbol disc:1
expect 2 check h.gpkg --enlarge --min-size 3
grep -q -- 'is a rule for moves' err || fail "the message: $(cat err)"
[[ ! -e x.gpkg ]] || fail "a refused call wrote something"
finish
