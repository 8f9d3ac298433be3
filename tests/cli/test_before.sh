# shellcheck shell=bash disable=SC1091
# check --before: finds each violation of a rule since the original, whichever program made the changes.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

layer in.gpkg houses POLYGON <<'X'
id,far,WKT
10,,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
20,,"POLYGON((8 0,18 0,18 10,8 10,8 0))"
30,2,"POLYGON((30 0,40 0,40 10,30 10,30 0))"
40,,"POLYGON((60 0,70 0,70 10,60 10,60 0))"
50,0,"POLYGON((90 0,100 0,100 10,90 10,90 0))"
X
found() { # WANTED FILE ARGS: kinds and FIDs of the violations that --before lists, besides conflicts
    local wanted=$1 file=$2
    shift 2
    run check "$file" --before in.gpkg "$@"
    [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || fail "status $status: check $file --before in.gpkg $*"
    same "$(awk -F'\t' 'NF > 5 && $7 ~ /^(worse|limit|side|jump|not_a_translate|lost)$/ { print $7, $1, $3 }' out |
        sed 's/ $//' | LC_ALL=C sort | tr '\n' ';')" "$wanted" "$file $*:"
}
# The output of separate violates none.
for options in '--gap 1' '--gap 1 --max-shift 0.2' '--gap 3 --max-shift-field far'; do
    # shellcheck disable=SC2086
    run separate in.gpkg o.gpkg -q --overwrite $options
    # shellcheck disable=SC2086
    found '' o.gpkg -l houses --no-blocks --block-field sunder_blk $options
    # shellcheck disable=SC2086
    expect 0 check in.gpkg --before in.gpkg $options --allow-conflicts
done

# Each rule, violated once.
layer moved.gpkg houses POLYGON <<'X'
id,far,WKT
10,,"POLYGON((1 0,11 0,11 10,1 10,1 0))"
20,,"POLYGON((8 0,18 0,18 10,8 10,8 0))"
30,2,"POLYGON((33 0,43 0,43 10,33 10,33 0))"
40,,"POLYGON((60 0,70 0,70.5 10,60 10,60 0))"
50,0,"POLYGON((90.25 0,100.25 0,100.25 10,90.25 10,90.25 0))"
X
found 'limit 3;limit 5;not_a_translate 4;worse 1 2;' moved.gpkg --max-shift-field far
same "$status" 3
found 'limit 1;limit 3;limit 5;not_a_translate 4;worse 1 2;' moved.gpkg --max-shift 0.125
found 'limit 3;not_a_translate 4;worse 1 2;' moved.gpkg --fixed-where 'id = 30'
found 'not_a_translate 4;worse 1 2;' moved.gpkg
found 'not_a_translate 4;' moved.gpkg --ignore-where 'id < 25'
expect 0 check moved.gpkg --before in.gpkg --allow-conflicts
# Rows, columns, layer and counts.
expect 3 check moved.gpkg rows.gpkg --before in.gpkg --max-shift-field far --id-field id --stats s.json
same "$(awk -F'\t' '$7 == "limit" { printf "%s %s %.6g %s\n", $1, $2, $9, $12 }' out | tr '\n' ';')" '3 30 3 2;5 50 0.25 0;'
same "$(count rows.gpkg houses_conflicts)" 5
same "$(jq -c '.moves' s.json)" \
    '{"matched":5,"worse":1,"limit":2,"side":0,"jump":0,"not_a_translate":1,"row":0,"lost":0}'
says out 'since in.gpkg: 5 matched, worse 1'
expect 3 check moved.gpkg --stats s.json
same "$(jq -c 'has("moves")' s.json)" false

# A jump: the last house moves across its neighbour.
layer over.gpkg houses POLYGON <<'X'
id,far,WKT
10,,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
20,,"POLYGON((8 0,18 0,18 10,8 10,8 0))"
30,2,"POLYGON((75 0,85 0,85 10,75 10,75 0))"
40,,"POLYGON((60 0,70 0,70 10,60 10,60 0))"
50,0,"POLYGON((90 0,100 0,100 10,90 10,90 0))"
X
found 'jump 3 4;jump 4 3;' over.gpkg
found '' over.gpkg --allow-jumps

# Arcs: the control points are moved, while the polylines that stand for the moved arcs are no exact translates.
python3 - >arcs.csv <<'X'
import random
r = random.Random(5)
print("id,WKT")
for k in range(40):
    x, y = ((0, 0), (451000.123, 5411000.7), (524287.9, 4194303.8), (-8.25e5, 3e5))[k % 4]
    x, y, a = x + 60 * (k // 8) + (k // 4 % 2) * r.uniform(3, 9), y + r.uniform(-2, 2), r.uniform(3, 6)
    bulge = f"CIRCULARSTRING({x!r} {y!r},{x + a!r} {y + a!r},{x + 2 * a!r} {y!r})"
    rest = f"({x + 2 * a!r} {y!r},{x + a!r} {y - a!r},{x!r} {y!r})"
    print(f'{k},"CURVEPOLYGON(COMPOUNDCURVE({bulge},{rest if k % 3 else "CIRCULARSTRING" + rest}))"')
X
layer arcs.gpkg houses CURVEPOLYGON <arcs.csv
run separate arcs.gpkg round.gpkg -q --overwrite --gap 1 --no-blocks --layers main --stats s.json
[ "$(jq .moved s.json)" -gt 20 ] || fail "arcs: $(jq .moved s.json) moved"
cp round.gpkg bent.gpkg
run check round.gpkg --before arcs.gpkg --gap 1 --no-blocks --stats s.json
same "$(jq -c '[.moves | .matched, .worse, .limit, .side, .jump, .not_a_translate]' s.json)" '[40,0,0,0,0,0]' 'arcs:'
python3 - <<'X'
import math, sqlite3, struct
base = sqlite3.connect("bent.gpkg")
for name, in base.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
    base.execute(f'DROP TRIGGER "{name}"')
shape = bytearray(base.execute("SELECT geom FROM houses WHERE id = 7").fetchone()[0])
at = shape.rindex(struct.pack("<II", 8, 3)) + 8 + 16  # the second point of the arc of three
shape[at:at + 8] = struct.pack("<d", math.nextafter(*struct.unpack("<d", shape[at:at + 8]), math.inf))
base.execute("UPDATE houses SET geom = ? WHERE id = 7", (bytes(shape),))
base.commit()
X
run check bent.gpkg --before arcs.gpkg --gap 1 --no-blocks
same "$(awk -F'\t' 'NF > 5 && $7 == "not_a_translate" { print $1 }' out)" 8 'an arc bent by a unit in the last place:'

# A lost feature; features matched by a key if their FIDs changed.
ogr2ogr -where 'id <> 40' -sql 'SELECT * FROM houses WHERE id <> 40 ORDER BY id DESC' fewer.gpkg in.gpkg -nln houses 2>/dev/null
found 'lost 4;' fewer.gpkg --id-field id
expect 3 check fewer.gpkg --before in.gpkg --id-field id
ogr2ogr twice.gpkg in.gpkg -nln houses && ogr2ogr -append twice.gpkg in.gpkg -nln houses
refused 1 'the key 10 too' check twice.gpkg --before in.gpkg --id-field id
run check in.gpkg --before fewer.gpkg --id-field id
says err '1 features of houses are not in fewer.gpkg'
# FIDs of a Shapefile start at 0, and separate writes those that it cannot keep to a field.
expect 3 separate in.gpkg o.shp -q --gap 1 --max-shift 0.2 --layers main
found '' o.shp --gap 1 --max-shift 0.2
# If ORIGINAL has several layers, the one of the same name is used.
ogr2ogr -update in.gpkg over.gpkg houses -nln others
found 'jump 3 4;jump 4 3;' over.gpkg

refused 2 'belongs to other commands' separate in.gpkg o.gpkg --before in.gpkg
refused 2 '--max-shift is a rule for moves' check over.gpkg --max-shift 3
refused 2 '--allow-jumps is a rule for moves' check over.gpkg --allow-jumps
refused 2 'the same selection of the original is not known' check over.gpkg --before in.gpkg --bbox 0,0,9,9
refused 1 'nofile.gpkg: no such file' check over.gpkg --before nofile.gpkg
refused 1 'has no layer of polygons' check in.gpkg -l houses --before rows.gpkg
refused 1 'in.gpkg is an input' check over.gpkg in.gpkg --overwrite --before in.gpkg
refused 2 'a part of the input' check over.gpkg --before in.gpkg --stats in.gpkg
finish
