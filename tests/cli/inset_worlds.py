"""Terraces whose outlines are moved in, beside GEOS: inset_worlds.py SUNDER SEED WORLDS [trim].

Each world has two terraces that face each other too near, and a house with a notch; nothing can move far. Half of the
worlds are turned by a random angle. Of each feature that became smaller it is asked, in rationals, whether it lies in
what it was; by GEOS, whether its area is that of the block moved in, without trim; and of neighbours on one rung,
whether they share the corners of their common wall: to the bit where the wall runs along an axis."""

import json
import random
import subprocess
import sys
from fractions import Fraction

from osgeo import ogr
from shapely.geometry import Polygon
from shapely.ops import unary_union

from trim_worlds import collection, demand_kept, fail, feature, lies_in, turned

GAP, LIMIT, INSETS = 3, 0.1, (0.5, 1, 1.5, 2)


def make_terrace(rng, side, front):
    """Houses between common walls, their fronts on y = `front`, on one side of it; fronts and backs may step."""
    walls = [rng.uniform(0, 3)]
    for _ in range(rng.randint(2, 5)):
        walls.append(walls[-1] + rng.uniform(6, 9))
    step, deep = rng.choice([0, rng.uniform(0.5, 2)]), rng.uniform(9, 12)
    houses = []
    for k in range(len(walls) - 1):
        near, far = front + side * step * (k % 2), front + side * (deep + step * (k % 2))
        ring = [(walls[k], near), (walls[k + 1], near), (walls[k + 1], far), (walls[k], far)]
        houses.append(ring if side > 0 else ring[::-1])
    return houses, walls


def make_world(rng, at):
    """Returns blocks of houses with their walls, and the angle."""
    angle = rng.choice([0, rng.uniform(0.1, 3)])
    blocks = [make_terrace(rng, 1, rng.uniform(0.3, 1)), make_terrace(rng, -1, rng.uniform(-1, -0.3))]
    w, h = rng.uniform(10, 14), rng.uniform(10, 14)
    x, y = max(blocks[0][1][-1], blocks[1][1][-1]) + rng.uniform(0.5, 2), rng.uniform(-9, 5)
    blocks.append(([[(x, y), (x + w, y), (x + w, y + h / 2), (x + w / 2, y + h / 2), (x + w / 2, y + h), (x, y + h)]], []))
    return [([turned(ring, angle, at) for ring in houses], walls) for houses, walls in blocks], angle


def largest_part(shape):
    return max((part.area for part in getattr(shape, "geoms", [shape])), default=0)


def wall_corners(ring, wall):
    """The corners of a ring that are on a wall through two points, up to a millionth of a metre."""
    (ax, ay), (bx, by) = wall
    long = ((bx - ax) ** 2 + (by - ay) ** 2) ** 0.5
    return sorted(p for p in ring if abs((bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax)) < 1e-6 * long)


def check_area(block, member, rung, now, row):
    """Is the area that of the member within its block moved in?"""
    whole = unary_union([Polygon(ring).buffer(1e-6, join_style=2) for ring in block])
    inner = whole.buffer(-INSETS[rung - 1] - 1e-6, join_style=2, mitre_limit=5)
    left = largest_part(inner.intersection(Polygon(block[member]).buffer(1e-9)))
    if abs(now - left) > 1e-3 * left + 1e-3:
        fail(f"{row}: area {now}, and GEOS leaves {left}")


def write_layers(houses, roads):
    layers = {"inset_houses": [feature("Polygon", [ring + ring[:1]], n=i) for i, ring in enumerate(houses)],
              "inset_roads": [feature("LineString", line, w=1) for line in roads]}
    for name, items in layers.items():
        with open(f"{name}.json", "w") as out:
            json.dump(collection(items), out)
        subprocess.run(["ogr2ogr", "-f", "GPKG", "-a_srs", "EPSG:25833", f"{name}.gpkg", f"{name}.json"], check=True)


def main():
    sunder, seed, worlds, trim = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), len(sys.argv) > 4
    rng = random.Random(seed)
    houses, place, pairs, roads = [], [], [], []
    for k in range(worlds):
        at = (1000.0 * k, 5e6 + 700.0 * (k % 7))
        blocks, angle = make_world(rng, at)
        roads.append(turned([(-40, 0.1), (80, -0.1)], angle, at))
        for block, walls in blocks:
            for m in range(len(block)):
                if m:
                    top, bottom = 30, -30
                    pairs.append((len(houses) - 1, len(houses), turned([(walls[m], bottom), (walls[m], top)], angle, at), angle))
                place.append((block, m))
                houses.append(block[m])
    write_layers(houses, roads)
    rules = ["--gap", str(GAP), "--max-shift", str(LIMIT), "--rows", "no", "--inset", ",".join(map(str, INSETS))]
    if trim:
        rules += ["--barrier", "inset_roads.gpkg,width-field=w,gap=0.5", "--trim", "--crossed", "trim"]
    run = [sunder, "separate", "inset_houses.gpkg", "inset_o.gpkg", "--overwrite", "--hide", "--hide-weight", "1", "-q"]
    subprocess.run(run + rules + ["--stats", "inset.json"], check=True)
    stats = json.load(open("inset.json"))
    now, counted = {}, [0, 0]
    source = ogr.Open("inset_o.gpkg")
    for item in source.GetLayer("inset_houses"):
        row = item.items()
        if row["sunder_inv"]:
            continue
        ring = [p[:2] for p in item.GetGeometryRef().GetGeometryRef(0).GetPoints()[:-1]]
        moved = [(Fraction(x) - Fraction(row["sunder_dx"]), Fraction(y) - Fraction(row["sunder_dy"])) for x, y in ring]
        now[row["n"]] = [tuple(map(float, p)) for p in moved], row["sunder_lvl"], row["sunder_dx"] == row["sunder_dy"] == 0
        if not row["sunder_lvl"]:
            continue
        counted[0 if trim and row["sunder_lvl"] == 1 else 1] += 1
        if not lies_in(moved, houses[row["n"]]):
            fail(f"{row}: does not lie in what it was")
        if not trim:
            check_area(*place[row["n"]], row["sunder_lvl"], item.GetGeometryRef().Area(), row)
    if counted != [stats["shrunk"]["trimmed"], stats["shrunk"]["inset"]] or sum(counted) < worlds:
        fail(f"{counted} became smaller: {stats['shrunk']}")
    if any(stats["conflicts"]["after"][kind] for kind in ("overlap", "too_close", "barrier", "barrier_near")):
        fail(f"conflicts remain: {stats['conflicts']}")
    shared = 0
    for a, b, wall, angle in pairs:
        if a not in now or b not in now or not now[a][1] == now[b][1] > 0:
            continue
        mine, its = (wall_corners(now[k][0], wall) for k in (a, b))
        if len(mine) < 2 or len(its) < 2:
            fail(f"houses {a} and {b}: no common wall is left")
        straight = now[a][2] and now[b][2] and angle == 0
        apart = 0 if straight else 1e-8
        inner = [(p, q) for p in mine for q in its if max(abs(p[0] - q[0]), abs(p[1] - q[1])) < 1e-4]
        if not inner or any(max(abs(p[0] - q[0]), abs(p[1] - q[1])) > apart for p, q in inner):
            fail(f"houses {a} and {b}: the corners of their wall differ: {mine}, {its}")
        shared += 1
    demand_kept(sunder, "inset_houses", "inset_o", rules)
    print(f"{worlds} worlds, {counted[0]} houses trimmed, {counted[1]} inset, {shared} walls between smaller houses, "
          f"{stats['hidden']['count']} hidden")


if __name__ == "__main__":
    main()
