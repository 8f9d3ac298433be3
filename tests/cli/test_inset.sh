# shellcheck shell=bash disable=SC1091
# --inset: blocks whose outlines are moved in, what is written about it, which calls are refused, and the check.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# Two houses with a common wall, and one opposite, 2 m apart where the gap is 3 m; none can move.
{
    echo "WKT,name"
    echo '"POLYGON((0 0,10 0,10 10,0 10,0 0))",left'
    echo '"POLYGON((10 0,20 0,20 10,10 10,10 0))",right'
    echo '"POLYGON((0 -12,20 -12,20 -2,0 -2,0 -12))",opposite'
} | layer h.gpkg houses POLYGON
words=(--gap 3 --max-shift 0 --rows no)

# The opposite house moves in by 1 m: its own outline loses less than the two together.
expect 0 separate h.gpkg o.gpkg "${words[@]}" --inset 1,2 --stats o.json
same "$(jq -c '[.shrunk.trimmed, .shrunk.inset, .shrunk.lower_bound == .shrunk.area_lost]' o.json)" '[0,1,true]' "inset:"
same "$(house o.gpkg opposite sunder_lvl),$(house o.gpkg left sunder_lvl)" "1,0" "the rungs:"
case $(house_wkt o.gpkg opposite) in *"19 -3"*) ;; *) fail "the shape: $(house_wkt o.gpkg opposite)" ;; esac
grep -q '^inset 1, weight times' out || fail "the summary: $(cat out)"

# If that one may not change, the two do, and their wall stays.
expect 0 separate h.gpkg r.gpkg "${words[@]}" --inset 1,2 --rigid-where "name = 'opposite'" --stats r.json
same "$(house r.gpkg left sunder_lvl),$(house r.gpkg right sunder_lvl)" "1,1" "a rigid house:"
case $(house_wkt r.gpkg left) in *"10 1"*"10 9"* | *"10 9"*"10 1"*) ;; *) fail "the wall: $(house_wkt r.gpkg left)" ;; esac

# A rung is not offered where the least size does not fit: 6 m by 18 m are left with 2 m.
expect 3 separate h.gpkg m.gpkg "${words[@]}" --inset 2 --min-size 6.5
expect 0 separate h.gpkg m.gpkg --overwrite "${words[@]}" --inset 2 --min-size 5.9

# The check makes the shapes again, with the blocks of the result. One that is none of them is altered.
checks=("${words[@]}" --no-blocks --block-field sunder_blk --before h.gpkg)
expect 0 check r.gpkg -l houses "${checks[@]}" --inset 1,2 --rigid-where "name = 'opposite'" --stats c.json
same "$(jq -c '[.moves.altered, .moves.not_a_translate]' c.json)" '[0,0]' "the check:"
expect 3 check r.gpkg -l houses "${checks[@]}" --inset 2 --stats c.json
same "$(jq -c '.moves.altered' c.json)" 2 "the check with another inset:"

# A house that is hidden and not written keeps the wall that it shared from being an outline. It is lost, and the other
# one of its block is what it may be.
{
    echo "WKT,name,class"
    echo '"POLYGON((0 0,10 0,10 10,0 10,0 0))",left,1'
    echo '"POLYGON((10 0,20 0,20 10,10 10,10 0))",right,1'
    echo '"POLYGON((0 -12,8 -12,8 -2,0 -2,0 -12))",rigid1,0'
    echo '"POLYGON((17 5,24 5,24 9,17 9,17 5))",rigid2,0'
} | layer d.gpkg houses POLYGON
rules=("${words[@]}" --touch-tolerance 0 --inset 1,2 --rigid-where "name LIKE 'rigid%'")
expect 0 separate d.gpkg dropped.gpkg "${rules[@]}" --hierarchy-field class --hide --drop-hidden
same "$(house dropped.gpkg left sunder_lvl),$(ogrinfo -q dropped.gpkg houses | grep -c 'right')" "1,0" "a dropped house:"
case $(house_wkt dropped.gpkg left) in *"10 1"*"10 9"* | *"10 9"*"10 1"*) ;; *) fail "its wall: $(house_wkt dropped.gpkg left)" ;; esac
expect 3 check dropped.gpkg -l houses "${rules[@]}" --no-blocks --block-field sunder_blk --before d.gpkg --stats c.json
same "$(jq -c '[.moves.altered, .moves.too_small, .moves.lost, .moves.not_a_translate]' c.json)" '[0,0,1,0]' "the check of a dropped house:"

# A close-up of a hidden house shows its neighbour as it was, and as it became: its front moves in by 1 m.
expect 0 separate d.gpkg page.gpkg "${rules[@]}" --hierarchy-field class --hide --report page.html
for when in before after; do
    sed -n "/<svg class=\"close-up\".*aria-label=\"$when\"/,/<\/svg>/p" page.html | grep -o 'M[^z"]*z' | sort -u >"$when"
done
[ -s before ] && [ "$(comm -13 before after | wc -l)" -eq 1 ] || fail "the close-ups: $(comm -3 before after)"

# The map of the page has the shape of the result, too; that of the house as given is another one.
ogr2ogr -f GeoJSON page.geojson page.gpkg houses || fail "no GeoJSON"
python3 - <<'P' || fail "the map of the page does not show the result"
import json, re
text = re.search('<script type="application/json"[^>]*>(.*?)</script>', open("page.html").read(), re.S).group(1)
data, letters = json.loads(text), "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"


def numbers(packed):
    value = place = 0
    for digit in map(letters.index, packed):
        value |= (digit & 31) << place
        place = place + 5 if digit & 32 else 0
        if place == 0:
            yield -(value >> 1) if value & 1 else value >> 1
            value = 0


def corners(packed):
    take, x, y = numbers(packed), 0, 0
    for n in take:
        found = set()
        while n:
            for _ in range(n):
                x, y = x + next(take), y + next(take)
                found.add((round(data["box"][0] + x * data["step"], 6), round(data["box"][1] + y * data["step"], 6)))
            n = next(take)
        yield found


before, after = list(corners(data["shape"])), list(corners(data["after"]))
rows = json.load(open("page.geojson"))["features"]
wanted = [{tuple(map(float, at)) for ring in row["geometry"]["coordinates"] for at in ring} for row in rows]
changed = [row["properties"]["sunder_lvl"] > 0 for row in rows]
assert sum(changed) == 1 and len(before) == len(after) == len(rows), (changed, after)
for now, then, result, other in zip(before, after, wanted, changed):
    assert then == (result if other else set()) and (now != result) == other, (now, then, result, other)
P

# Fifty rungs; the same bytes for any number of threads.
many=$(seq -s, 0.05 0.05 2.5)
expect 0 separate h.gpkg f.csv "${words[@]}" --inset "$many" --lco GEOMETRY=AS_WKT --layers main --threads 1 --stats f.json
same "$(jq -c '.shrunk.inset > 0 and .shrunk.inset <= 3' f.json)" true "fifty rungs:"
expect 0 separate h.gpkg f4.csv "${words[@]}" --inset "$many" --lco GEOMETRY=AS_WKT --layers main --threads 4
cmp -s f.csv f4.csv || fail "other threads, another result"

expect 0 separate h.gpkg f.gpkg "${words[@]}" --inset "$many"
expect 0 check f.gpkg -l houses "${checks[@]}" --inset "$many"

expect 2 separate h.gpkg x.gpkg "${words[@]}" --inset 2,1
grep -q -- '--inset 2,1: lengths are above 0' err || fail "the message: $(cat err)"
expect 2 separate h.gpkg x.gpkg "${words[@]}" --inset 0
expect 2 separate h.gpkg x.gpkg "${words[@]}" --inset 1,x
expect 2 check h.gpkg --inset 1
grep -q -- '--inset is a rule for moves' err || fail "the message: $(cat err)"

/usr/bin/python3 -c 'from osgeo import ogr; import shapely' 2>/dev/null || { echo "without GDAL's Python module or shapely: no terraces"; finish; exit 0; }
worlds=$((60 * ${SUNDER_TEST_SCALE:-1}))
for also in "" trim; do
    # shellcheck disable=SC2086
    /usr/bin/python3 "$SUNDER_SOURCE/tests/cli/inset_worlds.py" "$SUNDER" "${SUNDER_SEED:-3}" "$worlds" $also || fail "the terraces"
done
/usr/bin/python3 "$SUNDER_SOURCE/tests/cli/corner_worlds.py" "$SUNDER" "${SUNDER_SEED:-3}" "$((worlds / 2 + 1))" || fail "the corners"
finish
