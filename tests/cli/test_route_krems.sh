# shellcheck shell=bash disable=SC1091
# A robot of 4 x 10 m through the old town of Krems: there is a route although the straight line crosses 27 buildings.
# The path is verified in rationals against every building, and repeated runs give the same layers.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
data=$SUNDER_SOURCE/../shared/data/krems_2013.gpkg
[ -f "$data" ] || { echo "skipped: no krems_2013.gpkg in ../shared/data"; exit 77; }
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }

expect 0 route "$data" -l buildings --robot rectangle:4x10 --from 544300,5362200 --to 544900,5362230 --exact
cp out path.json
ogr2ogr -f CSV -lco GEOMETRY=AS_WKT -lco SEPARATOR=SEMICOLON buildings.csv "$data" buildings -select building \
    --config OGR_WKT_PRECISION 17 || fail "no WKT of the buildings"
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$SUNDER_SOURCE/tests/cli" python3 - <<'X' || fail "the path is not free"
import json
import sys
from fractions import Fraction as F
from route_exact import collides, exact, rings_of

path = [tuple(map(F, p)) for p in json.load(open("path.json"))["path"]]
robot = [(F(x), F(y)) for x, y in ((-2, -5), (2, -5), (2, 5), (-2, 5))]
buildings = []
for line in open("buildings.csv").read().splitlines()[1:]:
    wkt = line.split(";")[0].strip('"')
    buildings.append([exact(r) for r in rings_of(wkt)])
if len(buildings) != 1195 or len(path) < 3 or path[0] != (544300, 5362200) or path[-1] != (544900, 5362230):
    sys.exit("%d buildings, %d vertices" % (len(buildings), len(path)))
crossed, asked = 0, 0
for rings in buildings:
    xs, ys = [x for r in rings for x, _ in r], [y for r in rings for _, y in r]
    for p, q in zip(path, path[1:]):
        low, high = [min(p[k], q[k]) - 6 for k in (0, 1)], [max(p[k], q[k]) + 6 for k in (0, 1)]
        if max(xs) < low[0] or min(xs) > high[0] or max(ys) < low[1] or min(ys) > high[1]:
            continue
        asked += 1
        if collides(rings, robot, p, q):
            sys.exit("a leg meets a building")
    crossed += collides(rings, robot, path[0], path[-1])
if crossed < 20 or asked < 50:
    sys.exit("the straight way crosses %d buildings only; %d were asked" % (crossed, asked))
X

for i in 1 2; do
    SOURCE_DATE_EPOCH=0 run route "$data" o$i.gpkg -l buildings --robot rectangle:4x10 --gap 0.25 --from 544300,5362200 \
        --to 544900,5362230 --free-space --threads $i
    same "$status" 0
    mv out out$i
done
cmp -s out1 out2 && cmp -s o1.gpkg o2.gpkg || fail "two runs differ"
jq -e '.length > 912 and .max_deviation < 1e-9' out1 >/dev/null || fail "with a gap: $(cut -c 1-300 out1)"
finish
