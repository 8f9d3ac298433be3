# shellcheck shell=bash disable=SC1091
# --ease: the bound of a large outline with many corners that lies over a net of streets. The outline overlaps each
# street, and the depth of this overlap is that in a union of dozens of convex pieces. Most pieces are far from the place
# of the outline. The bound comes within a percent of the cost, and an independent checker accepts its proof.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

python3 - <<'PY'
import math
import random

rng = random.Random(5)
ring = []
for k in range(26):
    angle, far = 2 * math.pi * k / 26, rng.uniform(90, 240)
    ring.append((round(1000 + far * math.cos(angle), 1), round(1000 + far * math.sin(angle), 1)))
with open("quarter.csv", "w") as out:
    print("WKT,w", file=out)
    print('"POLYGON((%s))",1' % ",".join("%.1f %.1f" % p for p in ring + ring[:1]), file=out)
with open("streets.csv", "w") as out:
    print("WKT,w", file=out)
    for k in range(-3, 4):
        for across in (False, True):
            line = [(-160, 45 * k), (rng.uniform(-9, 9), 45 * k + rng.uniform(-9, 9)), (160, 45 * k + rng.uniform(-20, 20))]
            line = [(1000 + p[across], 1000 + p[not across]) for p in line]
            print('"LINESTRING(%s)",1' % ",".join("%.1f %.1f" % p for p in line), file=out)
PY
layer quarter.gpkg quarter POLYGON <quarter.csv
layer streets.gpkg streets LINESTRING <streets.csv
rules=(--gap 3 --max-shift 10 --barrier streets.gpkg,width=5)

expect 3 separate quarter.gpkg o.gpkg --overwrite "${rules[@]}" --stats s.json
jq -e '.displacement | .cost > 2e6 and .lower_bound > 0.99 * .cost and .optimality_gap < 0.02' s.json >/dev/null ||
    fail "the bound: $(jq -c .displacement s.json)"

expect 3 separate quarter.gpkg o.gpkg --overwrite "${rules[@]}" --effort 0 --proof p.jsonl --stats s.json
jq -e '.displacement | .lower_bound > 0.9 * .cost and .lower_bound > 1.05 * .cost_alone' s.json >/dev/null ||
    fail "the bound without effort: $(jq -c .displacement s.json)"
/usr/bin/python3 "$SUNDER_SOURCE/tests/proof/check_proof.py" p.jsonl quarter.gpkg --result o.gpkg "${rules[@]}" --effort 0 \
    >checked 2>&1 || fail "the checker: $(tail -1 checked)"
finish
