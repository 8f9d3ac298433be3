# shellcheck shell=bash
# Features that are left out get a message and are counted, by separate, check and buffer, in text and in JSON: rings
# that enclose no area by the even-odd rule, coordinates that are not finite, null and empty geometries.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }

# ---- Rings that enclose no area: traced an even number of times from any vertex in either direction; a hole that is
# the outer ring, started elsewhere; there and back along a path. Each is one feature of an otherwise clean layer.
python3 - >nothing.csv <<'PY'
import random
draw = random.Random(7)
print("WKT,name")
text = lambda ring: "(" + ",".join(f"{x} {y}" for x, y in ring) + ")"
for i in range(24):
    x, y, n = 100 * i, 0, draw.randint(3, 6)
    path = [(x + draw.randint(0, 4) * k, y + (k * k if k < n - 1 else 7)) for k in range(n)]
    if abs(sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(path, path[1:] + path[:1]))) == 0:
        path = [(x, y), (x + 9, y), (x, y + 9)]
    start = draw.randrange(len(path))
    turned = path[start:] + path[:start]
    if draw.random() < 0.5:
        turned = turned[::-1]
    kind = i % 3
    if kind == 0:
        times = draw.choice([2, 4])
        rings = text(turned * times + turned[:1])
    elif kind == 1:
        rings = text(path + path[:1]) + "," + text(turned + turned[:1])
    else:
        rings = text(path + path[-2:0:-1] + path[:1])
    print(f'"POLYGON ({rings})",nothing')
print('"POLYGON ((0 1000,10 1000,10 1010,0 1010,0 1000))",a')
print('"POLYGON ((20 1000,30 1000,30 1010,20 1010,20 1000))",b')
print('"POLYGON EMPTY",empty')
PY
layer nothing.gpkg h POLYGON <nothing.csv
expect 0 check nothing.gpkg --stats check.json --log log
same "$(grep -c 'its rings enclose no area by the even-odd rule: skipped$' log)" 24 "warnings of check:"
same "$(cut -d';' -f1 out)" 'h: 27 features (skipped 25, invalid 24, null 1), 0 pairs tested'
same "$(jq -c '[.features, .skipped, .invalid, .null]' check.json)" '[27,25,24,1]'
expect 0 separate nothing.gpkg apart.gpkg --stats apart.json --log log
same "$(grep -c 'enclose no area' log)" 24 "warnings of separate:"
same "$(jq -c '[.skipped, .invalid, .null]' apart.json)" '[25,24,1]'
expect 0 check nothing.gpkg --quiet --invalid skip --stats check.json
same "$(jq -c '[.skipped, .invalid, .null]' check.json)" '[25,24,1]'
expect 0 buffer nothing.gpkg grown.gpkg --shape square:1 --stats buffer.json
same "$(jq -c '[.features, .empty, .invalid, .rounded_again, has("repaired")]' buffer.json)" '[27,25,24,0,false]'
says out '27 features (invalid 24, null 1)'
# A ring that crosses itself is used if it encloses an area by the even-odd rule, and then there is no message that it
# encloses none.
layer bow.gpkg h POLYGON <<'CSV'
WKT,name
"POLYGON ((0 0,10 10,10 0,0 10,0 0))",bow
CSV
expect 0 check bow.gpkg
says err 'read as the region that its rings enclose by the even-odd rule'
says out '(skipped 0, invalid 1, null 0)'

# ---- Coordinates that are not finite, at any vertex, of any kind: --invalid skip leaves the features out. Drivers do
# not write them: the bytes are put into a GeoPackage.
python3 - >sound.csv <<'PY'
print("WKT,name")
for i in range(12):
    print(f'"POLYGON (({15*i} 0,{15*i+16} 0,{15*i+16} 10,{15*i} 10,{15*i} 0))",{i}')
PY
layer broken.gpkg h POLYGON <sound.csv
python3 - <<'PY'
import sqlite3, struct
base = sqlite3.connect("broken.gpkg")
for (name,) in base.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
    base.execute(f'DROP TRIGGER "{name}"')
kinds = [float("nan"), float("inf"), float("-inf")]
for fid in (2, 3, 5, 8, 9, 12):
    (blob,) = base.execute("SELECT geom FROM h WHERE fid = ?", (fid,)).fetchone()
    at = len(blob) - 80 + 8 * (fid * 3 % 10)  # one coordinate of the ring's five points
    base.execute("UPDATE h SET geom = ? WHERE fid = ?", (blob[:at] + struct.pack("<d", kinds[fid % 3]) + blob[at + 8:], fid))
base.execute("DROP TABLE rtree_h_geom")
base.execute("DELETE FROM gpkg_extensions")
base.commit()
PY
for command in 'separate broken.gpkg no.gpkg' 'check broken.gpkg' 'buffer broken.gpkg no.gpkg --shape square:1' \
    'separate broken.gpkg no.gpkg --max-memory 200M' 'plan broken.gpkg no --shards 2'; do
    for policy in repair fail; do
        # shellcheck disable=SC2086
        refused 1 'FID 2: a coordinate is not a finite number; --invalid skip leaves such features out' $command --invalid $policy
    done
done
expect 0 separate broken.gpkg whole.gpkg --invalid skip --stats whole.json
same "$(grep -c 'a coordinate is not a finite number; skipped$' err)" 6 "warnings of separate:"
same "$(jq -c '[.features, .skipped, .invalid, .null, .verified]' whole.json)" '[12,6,6,0,true]'
same "$(jq -r '.losses[]' whole.json)" '6 features are written without geometry: a coordinate of each is not a finite number'
for fid in 1 2 4 8; do
    case $fid in 2 | 8) wanted=skipped ;; *) wanted=moved ;; esac
    [ "$(value whole.gpkg h $fid sunder_st)" != unmoved ] || wanted=unmoved
    same "$(value whole.gpkg h $fid sunder_st)" $wanted "FID $fid:"
done
same "$(value whole.gpkg h 3 name)" 2 'attributes of a skipped feature:'
refused 1 'written without geometry' separate broken.gpkg no.gpkg --invalid skip --strict --quiet
expect 3 check broken.gpkg --invalid skip --stats check.json
same "$(jq -c '[.features, .skipped, .invalid, .null, .conflicts.overlap]' check.json)" '[12,6,6,0,2]'
expect 0 buffer broken.gpkg grown.gpkg --overwrite --shape square:1 --invalid skip --stats buffer.json
same "$(jq -c '[.features, .empty, .invalid]' buffer.json)" '[12,0,6]'
# The same with --max-memory, in shards, in other formats, and as barrier, operand and obstacle.
rows() { ogrinfo -q -ro "$1" h | grep -v '^Layer\|^$'; }
rows whole.gpkg >whole.rows
expect 0 separate broken.gpkg memory.gpkg --invalid skip --max-memory 200M
rows memory.gpkg | cmp - whole.rows || fail "with --max-memory the layer differs"
expect 0 plan broken.gpkg cut --shards 2 --invalid skip
expect 0 separate --shard 1 cut
expect 0 separate --shard 2 cut
expect 0 merge cut merged.gpkg
rows merged.gpkg | cmp - whole.rows || fail "with shards the layer differs"
for each in shp geojson sqlite csv gml; do
    mkdir "$each"
    expect 0 separate broken.gpkg "$each/o.$each" --invalid skip --quiet --stats each.json
    same "$(jq -c '[.features, .skipped, .invalid]' each.json)" '[12,6,6]' "$each:"
done
expect 0 check whole.gpkg --before broken.gpkg --invalid skip --quiet
expect 0 separate bow.gpkg beside.gpkg --barrier broken.gpkg --invalid skip --max-shift 0 --allow-conflicts
same "$(grep -c 'a coordinate is not a finite number; skipped$' err)" 6 'warnings of a barrier:'
refused 1 'FID 2: a coordinate is not a finite number; --invalid skip' separate bow.gpkg no.gpkg --barrier broken.gpkg --quiet
expect 0 sum broken.gpkg square:1 --invalid skip --stats -
expect 0 route broken.gpkg --robot square:1 --from -20,-20 --to 300,40 --invalid skip
finish
