"""Houses that are cut back, beside GEOS: trim_worlds.py SUNDER SEED WORLDS.

Each world has a terrace and some houses alone, turned by a random angle, beside and on roads of random widths; hardly
anything can move. Of each feature that became smaller it is asked, in rationals, whether it lies in what it was; by
GEOS, whether it is as far from the roads as it has to be, and whether it is nearly as large as what GEOS leaves of it;
and of neighbours in a terrace, whether their common wall remains one up to a millionth of a metre."""

import json
import math
import random
import subprocess
import sys
from fractions import Fraction

from osgeo import ogr

GAP, KEEP, LIMIT = 1, 0.3, 0.25


def turned(points, angle, at):
    c, s = math.cos(angle), math.sin(angle)
    return [(at[0] + c * x - s * y, at[1] + s * x + c * y) for x, y in points]


def make_world(rng, at):
    """Returns houses, the pairs of neighbours among them, and roads with their widths."""
    angle = rng.choice([0, rng.uniform(0, 3)])
    n = rng.randint(3, 6)
    walls = [0]
    for _ in range(n):
        walls.append(walls[-1] + rng.uniform(5, 9))
    deep = rng.uniform(8, 12)
    corner = [turned([(x, 0), (x, deep)], angle, at) for x in walls]
    houses = [[corner[k][0], corner[k + 1][0], corner[k + 1][1], corner[k][1]] for k in range(n)]
    pairs = [(k, k + 1) for k in range(n - 1)]
    for _ in range(2):
        x, y, w, h = rng.uniform(-30, 60), rng.uniform(25, 45), rng.uniform(6, 12), rng.uniform(6, 12)
        notch = [(0, 0), (w, 0), (w, h / 2), (w / 2, h / 2), (w / 2, h), (0, h)]
        houses.append(turned(notch, rng.uniform(0, 6), (at[0] + x, at[1] + y)))
    front = rng.uniform(-3, -0.5)
    roads = [(turned([(-60, front), (walls[-1] / 2, front + rng.uniform(-1, 1)), (walls[-1] + 60, front)], angle, at),
              rng.uniform(2, 6))]
    roads.append((turned([(-60, 20), (80, 40 + rng.uniform(-9, 9))], angle, at), rng.uniform(2, 6)))
    return houses, pairs, roads


def orient(a, b, p):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def lies_in(inner, outer):
    """Does one simple ring lie in another, exactly? Each corner does, and no edges cross."""
    inner, outer = ([tuple(map(Fraction, p)) for p in ring] for ring in (inner, outer))
    edges = list(zip(outer, outer[1:] + outer[:1]))
    for p in inner:
        odd = False
        for a, b in edges:
            side = orient(a, b, p)
            if side == 0 and min(a, b) <= p <= max(a, b):
                odd = True
                break
            if (a[1] > p[1]) != (b[1] > p[1]) and (side > 0) == (b[1] > a[1]):
                odd = not odd
        if not odd:
            return False
    for p, q in zip(inner, inner[1:] + inner[:1]):
        for a, b in edges:
            if orient(a, b, p) * orient(a, b, q) < 0 and orient(p, q, a) * orient(p, q, b) < 0:
                return False
    return True


def geometry(kind, points):
    made = ogr.Geometry(kind)
    for x, y in points:
        made.AddPoint_2D(float(x), float(y))
    if kind != ogr.wkbLinearRing:
        return made
    polygon = ogr.Geometry(ogr.wkbPolygon)
    made.CloseRings()
    polygon.AddGeometry(made)
    return polygon


def area(shape):
    return shape.Area() if shape.GetDimension() == 2 else 0


def collection(items):
    return {"type": "FeatureCollection", "features": items}


def feature(kind, coordinates, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}


def fail(text):
    print(text)
    sys.exit(1)


def demand_kept(sunder, before, after, rules):
    """Runs check --before on a result with hidden features; it must find nothing."""
    found = subprocess.run([sunder, "check", f"{after}.gpkg", "--input-layer", before, "--before", f"{before}.gpkg",
                            "--no-blocks", "--block-field", "sunder_blk", "--hidden-field", "sunder_inv"] + rules,
                           capture_output=True, text=True)
    if found.returncode:
        fail(f"the check: {found.stdout[-2000:]}{found.stderr}")


def check(house, road, row, moved):
    """Checks one feature that became smaller; `moved` is its ring as written, back at its place."""
    if not lies_in(moved, house):
        fail(f"{row}: does not lie in what it was")
    now, left = geometry(ogr.wkbLinearRing, moved).Area(), geometry(ogr.wkbLinearRing, house)
    if now < KEEP * left.Area():
        fail(f"{row}: keeps {now / left.Area()}")
    for line, width in road:
        left = left.Difference(geometry(ogr.wkbLineString, line).Buffer(width / 2 + GAP, 64))
    several = left.GetGeometryType() != ogr.wkbPolygon
    parts = [left.GetGeometryRef(i) for i in range(left.GetGeometryCount())] if several else [left]
    largest = max(part.Area() for part in parts)
    along = 0.1 * (geometry(ogr.wkbLinearRing, house).Area() - largest)  # what a cut along a wall may cost more
    if now > largest * (1 + 1e-3) or now < largest * 0.97 - 0.1 - along:
        fail(f"{row}: area {now}, and GEOS leaves {largest}")


def main():
    sunder, seed, worlds = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    rng = random.Random(seed)
    houses, pairs, roads = [], [], []
    for k in range(worlds):
        own, own_pairs, own_roads = make_world(rng, (1000.0 * k, 5e6 + 700.0 * (k % 7)))
        pairs += [(a + len(houses), b + len(houses)) for a, b in own_pairs]
        roads += [(line, width, k) for line, width in own_roads]
        houses += [(ring, k) for ring in own]
    with open("trim_houses.json", "w") as out:
        json.dump(collection([feature("Polygon", [ring + ring[:1]], n=i) for i, (ring, _) in enumerate(houses)]), out)
    with open("trim_roads.json", "w") as out:
        json.dump(collection([feature("LineString", line, w=width) for line, width, _ in roads]), out)
    for name in ("trim_houses", "trim_roads"):
        subprocess.run(["ogr2ogr", "-f", "GPKG", "-a_srs", "EPSG:25833", f"{name}.gpkg", f"{name}.json"], check=True)
    rules = ["--gap", str(GAP), "--max-shift", str(LIMIT), "--barrier", "trim_roads.gpkg,width-field=w", "--trim",
             "--trim-keep", str(KEEP), "--crossed", rng.choice(["trim", "hide"])]
    run = [sunder, "separate", "trim_houses.gpkg", "trim_o.gpkg", "--overwrite", "--hide", "--hide-weight", "1", "-q"]
    subprocess.run(run + rules + ["--stats", "trim.json"], check=True)
    stats = json.load(open("trim.json"))
    smaller, now = 0, {}
    source = ogr.Open("trim_o.gpkg")
    for item in source.GetLayer("trim_houses"):
        row = item.items()
        ring, k = houses[row["n"]]
        if row["sunder_inv"]:
            continue
        written = item.GetGeometryRef().Clone()
        now[row["n"]] = written
        for line, width, world in roads:
            if world == k and written.Distance(geometry(ogr.wkbLineString, line)) < width / 2 + GAP - 1e-9:
                fail(f"{row}: too near to a road")
        if not row["sunder_lvl"]:
            continue
        smaller += 1
        dx, dy = row["sunder_dx"], row["sunder_dy"]
        points = written.GetGeometryRef(0).GetPoints()[:-1]
        moved = [(Fraction(x) - Fraction(dx), Fraction(y) - Fraction(dy)) for x, y, *_ in points]
        check(ring, [(line, width) for line, width, world in roads if world == k], row, moved)
    if smaller < worlds or smaller != stats["shrunk"]["trimmed"] or any(stats["conflicts"]["after"][kind] for kind in (
            "overlap", "too_close", "barrier", "barrier_drawn", "barrier_near")):
        fail(f"{smaller} became smaller: {stats['shrunk']}, {stats['conflicts']}")
    for a, b in pairs:
        if a in now and b in now and (now[a].Distance(now[b]) > 1e-6 or area(now[a].Intersection(now[b])) > 1e-6):
            fail(f"houses {a} and {b}: the common wall is gone")
    demand_kept(sunder, "trim_houses", "trim_o", rules)
    print(f"{worlds} worlds, {smaller} houses became smaller, {stats['hidden']['count']} hidden")


if __name__ == "__main__":
    main()
