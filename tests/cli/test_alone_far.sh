# shellcheck shell=bash disable=SC1091
# One symbol without a limit on its move, in a long arm of an area whose outline it may not cross. Its nearest free
# place is at the end of the arm, at any distance. Arms have many lengths and widths, and four directions; the expected
# place is computed from the end of the arm. If even the room at the end is too narrow, there is no free place: the
# symbol does not move, and the reason is `side`, with a proof that an independent checker verifies.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

cat >arms.py <<'PY'
import random
import sys

random.seed(int(sys.argv[1]))
out = {"room": open("room.csv", "w"), "far": open("far.csv", "w"), "near": open("near.csv", "w")}
for name in out:
    print("id,WKT", file=out[name])
for k in range(12):
    none = k in (2, 7, 9, 11)
    long, half, size = random.randint(40, 300), random.randint(1, 8), 9 if none else random.randint(25, 60)
    room = [(-size, 0), (-size, -2 * size), (size, -2 * size), (size, 0), (half, 0), (half, long), (-half, long), (-half, 0), (-size, 0)]
    if none:
        room = [(x, y / 2) if y < 0 else (x, y) for x, y in room]
    turn = [lambda x, y: (x, y), lambda x, y: (-y, x), lambda x, y: (-x, -y), lambda x, y: (y, -x)][k % 4]
    place = lambda x, y: "%r %r" % (1000 * k + turn(x, y)[0], turn(x, y)[1])
    print('%d,"POLYGON ((%s))"' % (k, ", ".join(place(*p) for p in room)), file=out["room"])
    print('%d,"POINT (%s)"' % (k, place(0, random.randint(long // 2, long - 1))), file=out["far"])
    print('%d,"POINT (%s)"' % (k, place(0, 1)), file=out["near"])
PY
python3 arms.py "${SUNDER_SEED:-1}" || fail "arms.py"
for name in room far near; do
    ogr2ogr -q $name.gpkg $name.csv -nln $name -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=WKT -oo KEEP_GEOM_COLUMNS=NO || fail "ogr2ogr $name"
done
for name in far near; do
    expect 3 separate $name.gpkg $name.out.gpkg -q --output-layer l --symbol disc:10 --ease no --barrier room.gpkg,as=boundary --proof $name.jsonl
    ogr2ogr -q -f CSV $name.out.csv $name.out.gpkg l -lco GEOMETRY=AS_WKT
    ogr2ogr -q -f CSV $name.why.csv $name.out.gpkg l_conflicts
    python3 "$SUNDER_SOURCE/tests/proof/check_proof.py" $name.jsonl $name.gpkg --symbol disc:10 --ease no --barrier room.gpkg,as=boundary \
        >$name.checked 2>&1 || fail "the proofs of $name: $(tail -n 1 $name.checked)"
done
python3 - <<'PY' || fail "places"
import csv
import sys

def places(name):
    return {row["id"]: (tuple(float(v) for v in row["WKT"][7:-1].split()), row["sunder_st"]) for row in csv.DictReader(open(name))}

def reasons(name):
    return [row["reason"] for row in csv.DictReader(open(name))]

far, near = places("far.out.csv"), places("near.out.csv")
why = [reasons("far.why.csv"), reasons("near.why.csv")]
none = ("2", "7", "9", "11")
bad = [k for k in far if (k not in none) != (far[k][1] == "moved") or near[k][1] != far[k][1] or
       (k not in none and max(abs(a - b) for a, b in zip(far[k][0], near[k][0])) > 1e-6)]
if why != 2 * [len(none) * ["side"]]:
    print("reasons", why)
    bad.append(none[0])
for k in bad:
    print(k, far[k], near[k])
sys.exit(bool(bad))
PY
finish
