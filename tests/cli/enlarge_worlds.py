"""Terraces that are made larger, cut back and moved in, beside an oracle: enlarge_worlds.py SUNDER SEED WORLDS.

Each world has two terraces on both sides of a road, some of them too shallow or too short for the least size, and a
house alone that overlaps one of them when it is larger; half of the worlds are turned. A first run makes features
larger and moves nothing. Its shapes are compared, up to a thousandth of the width, with those known by hand in the
frame of each terrace: a side below the least size is stretched to it about its middle. In a second run features may be
cut back at the road, moved in and hidden. Rationals show that each visible feature lies in its shape of the first run,
and GEOS that a disc of the least size fits into each smaller shape. Neighbours on one rung have to share the corners of
their wall: to the bit where they are as large as in the first run, or where the wall runs along an axis and nothing
moved."""

import json
import random
import subprocess
import sys
from fractions import Fraction

from osgeo import ogr
from shapely.geometry import Polygon
from shapely.ops import unary_union

from trim_worlds import collection, demand_kept, fail, feature, lies_in, turned

GAP, LIMIT, LEAST, ROAD, INSETS, MANY = 2, 1, 6, 4, (0.5, 1), 500


def make_terrace(rng, side, houses=None):
    """Houses of one depth between common walls, on one side of the road: their rings, walls, and front and back."""
    n = houses or rng.randint(1, 6)
    near = side * (7 if houses else ROAD / 2 + rng.uniform(-1, 3))
    far = near + side * (5 if houses else rng.choice([rng.uniform(3, 5.9), rng.uniform(6.1, 9), rng.uniform(10, 14)]))
    walls = [rng.uniform(0, 3)]
    for _ in range(n):
        walls.append(walls[-1] + (4 if houses else rng.choice([rng.uniform(4, 5.9), rng.uniform(6.1, 12)])))
    rings = []
    for a, b in zip(walls, walls[1:]):
        ring = [(a, near), (b, near), (b, far), (a, far)]
        rings.append(ring if side > 0 else ring[::-1])
    return rings, walls, (min(near, far), max(near, far))


def stretched(low, high):
    """The map of an interval that is stretched about its middle, if it is below the least size."""
    factor, middle = max(1, LEAST / (high - low)), (low + high) / 2
    return lambda x: middle + factor * (x - middle)


def make_world(rng, k, add):
    angle = rng.choice([0, rng.uniform(0.1, 3)]) if k else 0
    at = (3000.0 * k, 5e6 + 700.0 * (k % 7))
    for side in (1, -1):
        rings, walls, (low, high) = make_terrace(rng, side, MANY if k == 0 and side > 0 else None)
        x, y = stretched(walls[0], walls[-1]), stretched(low, high)
        add([(turned(ring, angle, at), turned([(x(p), y(q)) for p, q in ring], angle, at)) for ring in rings],
            [turned([(x(w), y(low)), (x(w), y(high))], angle, at) for w in walls[1:-1]], angle)
    left, right, back = x(walls[0]) - 1, x(walls[-1]) + 1, y(low) + rng.uniform(0.4, 0.9)
    if abs(back - low) < 0.3:  # it would touch the terrace as given, and be in its block
        back = low - 0.3
    ring = turned([(left, back - 12), (right, back - 12), (right, back), (left, back)], angle, at)
    add([(ring, ring)], [], angle)
    return turned([(-60, 0), (2600 if k == 0 else 120, 0)], angle, at)


def write_layer(name, items):
    with open(f"{name}.json", "w") as out:
        json.dump(collection(items), out)
    subprocess.run(["ogr2ogr", "-f", "GPKG", "-a_srs", "EPSG:25833", f"{name}.gpkg", f"{name}.json"], check=True)


def read(path):
    """The rings of a result with their columns; each at its old place, by rationals, too."""
    found = {}
    source = ogr.Open(path)
    for item in source.GetLayer("larger_houses"):
        row = item.items()
        ring = [p[:2] for p in item.GetGeometryRef().GetGeometryRef(0).GetPoints()[:-1]]
        back = [(Fraction(x) - Fraction(row["sunder_dx"]), Fraction(y) - Fraction(row["sunder_dy"])) for x, y in ring]
        found[row["n"]] = ring, back, row
    return found


def on_wall(ring, wall):
    """The corners of a ring on a wall, up to a millionth of a metre."""
    (ax, ay), (bx, by) = wall
    long = ((bx - ax) ** 2 + (by - ay) ** 2) ** 0.5
    return sorted(p for p in ring if abs((bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax)) < 1e-6 * long)


def check_larger(first, houses):
    """Compares the first run with what is known by hand. Returns the number of features that became larger."""
    larger = 0
    for n, (given, wanted) in enumerate(houses):
        ring, _, row = first[n]
        grows = max(abs(a - b) for p, q in zip(given, wanted) for a, b in zip(p, q)) > 0.02
        larger += grows
        off = max(min(max(abs(p[0] - q[0]), abs(p[1] - q[1])) for q in ring) for p in wanted)
        if off > (1e-6 if grows else 0.02) or (not grows and row["sunder_cut"] != 0 and off == 0):
            fail(f"{row}: {ring} is not {wanted}, by {off}")
    return larger


def check_smaller(first, second, houses):
    """Of each visible feature: does it lie in its larger shape, and does the disc fit? Counts features by rung."""
    counted = {}
    for n in range(len(houses)):
        _, back, row = second[n]
        if row["sunder_inv"]:
            continue
        rung = row["sunder_lvl"]
        counted[rung] = counted.get(rung, 0) + 1
        if rung and not lies_in(back, first[n][0]):
            fail(f"{row}: does not lie in its larger shape")
        if rung and Polygon([tuple(map(float, p)) for p in back]).buffer(-LEAST / 2 * (1 - 1e-9)).is_empty:
            fail(f"{row}: is below the least size")
    return counted


def check_walls(found, pairs):
    """Do neighbours on one rung share the corners of their wall? Returns the number of walls."""
    shared = 0
    for a, b, wall, angle in pairs:
        (ring, back, row), (other, its_back, its_row) = found[a], found[b]
        if row["sunder_inv"] or its_row["sunder_inv"] or row["sunder_lvl"] != its_row["sunder_lvl"]:
            continue
        near = [[tuple(map(float, p)) for p in one] for one in (back, its_back)]
        mine, its = on_wall(near[0], wall), on_wall(near[1], wall)
        if len(mine) < 2 or len(its) < 2:
            fail(f"{row} and {its_row}: no common wall is left")
        ends = [(p, q) for p in mine for q in its if max(abs(p[0] - q[0]), abs(p[1] - q[1])) < 1e-4]
        exact = row["sunder_lvl"] == 0 or (angle == 0 and row["sunder_dx"] == row["sunder_dy"] == 0)
        if len(ends) < 2 or any(max(abs(p[0] - q[0]), abs(p[1] - q[1])) > (0 if exact else 1e-8) for p, q in ends):
            fail(f"{row} and {its_row}: the corners of their wall differ: {mine}, {its}")
        if row["sunder_lvl"] == 0 and len(set(ring) & set(other)) < 2:
            fail(f"{row} and {its_row}: their wall is not the same to the bit as written")
        shared += 1
    return shared


def run(sunder, *words):
    return subprocess.run([sunder, *words], capture_output=True, text=True)


def main():
    sunder, seed, worlds = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    rng = random.Random(seed)
    houses, pairs, roads, blocks = [], [], [], []

    def add(shapes, walls, angle):
        pairs.extend((len(houses) + m, len(houses) + m + 1, wall, angle) for m, wall in enumerate(walls))
        blocks.append(range(len(houses), len(houses) + len(shapes)))
        houses.extend(shapes)

    for k in range(worlds):
        roads.append(make_world(rng, k, add))
    write_layer("larger_houses", [feature("Polygon", [ring + ring[:1]], n=i) for i, (ring, _) in enumerate(houses)])
    write_layer("larger_roads", [feature("LineString", line, w=ROAD) for line in roads])
    least = ["--gap", str(GAP), "--rows", "no", "--enlarge", "--min-size", str(LEAST)]
    found = run(sunder, "separate", "larger_houses.gpkg", "first.gpkg", "--overwrite", *least, "--max-shift", "0", "--effort", "0",
                "--allow-conflicts", "--stats", "first.json")
    if found.returncode:
        fail(found.stderr)
    first = read("first.gpkg")
    larger = check_larger(first, houses)
    if larger != json.load(open("first.json"))["enlarged"] or larger < worlds:
        fail(f"{larger} became larger: {json.load(open('first.json'))['enlarged']}")
    for block in blocks:
        whole = unary_union([Polygon(first[n][0]).buffer(1e-6, join_style=2) for n in block])
        if whole.buffer(-LEAST / 2 * (1 - 2e-3)).is_empty:
            fail(f"houses {block}: no disc of the least size fits")
    walls = check_walls(first, pairs)
    if walls != len(pairs):
        fail(f"{walls} of {len(pairs)} walls")

    rules = least + ["--max-shift", str(LIMIT), "--barrier", f"larger_roads.gpkg,width={ROAD}", "--crossed", "hide",
                     "--trim", "--trim-keep", "0.3", "--inset", ",".join(map(str, INSETS))]
    found = run(sunder, "separate", "larger_houses.gpkg", "second.gpkg", "--overwrite", *rules, "--hide", "--effort", "0", "--stats",
                "second.json")
    stats = json.load(open("second.json")) if found.returncode in (0, 3) else fail(found.stderr)
    if found.returncode == 3 or not stats["verified"]:
        fail(f"conflicts remain: {stats['conflicts']}")
    second = read("second.gpkg")
    counted = check_smaller(first, second, houses)
    smaller = sum(number for rung, number in counted.items() if rung)
    if smaller != sum(stats["shrunk"][kind] for kind in ("trimmed", "inset")) or smaller < worlds / 4:
        fail(f"rungs {counted}: {stats['shrunk']}")
    shared = check_walls(second, pairs)
    demand_kept(sunder, "larger_houses", "second", rules)
    print(f"{worlds} worlds, {len(houses)} houses, {larger} larger, on rungs {dict(sorted(counted.items()))}, "
          f"{stats['hidden']['count']} hidden, {walls} walls shared at first, {shared} in the end")


if __name__ == "__main__":
    main()
