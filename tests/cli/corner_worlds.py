"""Corners, slivers and arms of smaller shapes, beside GEOS: corner_worlds.py SUNDER SEED WORLDS.

Each world has a terrace whose walls lean and whose fronts step, or fold, cut by an oblique road, a terrace behind it that is too
near, and a block around a courtyard with a house in it. Walls meet, or gape by some centimetres; some houses keep their
shapes. All lines that meet form angles of 35 degrees or more. So what --trim and --inset leave has no corner below 25
degrees, and nothing as thin as some millimetres. Beside another road are houses with wings along it, and one with an
acute corner: what is cut so that it is thinner than the least size is not much longer than wide."""

import json
import math
import random
import subprocess
import sys

from osgeo import ogr
from shapely import wkb
from shapely.geometry import LineString, Point, Polygon
from shapely.ops import linemerge
from shapely.affinity import translate

from inset_worlds import write_layers
from trim_worlds import demand_kept, fail, turned

GAP, LIMIT, INSETS, TOLERANCE = 3, 0.1, (0.5, 1, 1.5), 0.1
GAPE = 0.05  # walls gape by less
LEAST_ANGLE = 25
THIN, LONG = 0.004, 0.3  # what is thinner is a sliver if it is longer
LEAST = 3
LONGER = 1.6  # an arm is longer than its width by this factor, 1.5 in the program


def at_height(wall, y):
    """The point of a wall (its foot, its slope) at a height."""
    return wall[0] + wall[1] * y, y


def make_terrace(rng, gape):
    """Houses between leaning walls. Where fronts or backs step, the wall of the one is longer."""
    n = rng.randint(3, 6)
    walls = [(0, rng.uniform(-0.4, 0.4))]
    for _ in range(n):
        walls.append((walls[-1][0] + rng.uniform(9, 12), max(walls[-1][1] - 0.2, min(0.4, rng.uniform(-0.4, 0.4)))))
    houses = []
    for a, b in zip(walls, walls[1:]):
        low, high = rng.choice([0, 0, rng.uniform(0.5, 2)]), 12 + rng.choice([0, 0, rng.uniform(0.5, 2)])
        ring = [at_height(a, low), at_height(b, low), at_height(b, high), at_height(a, high)]
        off = rng.uniform(0, gape)
        houses.append([(x + off, y + off / 2) for x, y in ring])
    return houses


def make_folded(rng, gape):
    """Houses whose fronts rise and fall by one slope, so that walls halve the angles between them."""
    xs, y, houses, slope = [0], 0, [], rng.uniform(0.05, 0.2)
    for k in range(rng.randint(3, 6)):
        xs.append(xs[-1] + rng.uniform(9, 12))
        above = y + (1 if k % 2 else -1) * slope * (xs[-1] - xs[-2])
        off = rng.uniform(0, gape)
        houses.append([(x + off, z) for x, z in ((xs[-2], y), (xs[-1], above), (xs[-1], 12), (xs[-2], 12))])
        y = above
    return houses


def make_yard(rng, at, gape):
    """Four wings around a courtyard, whose joints are oblique or straight, and a house in it."""
    w, h, deep = rng.uniform(26, 32), rng.uniform(26, 32), rng.uniform(6, 8)
    outer = [(0, 0), (w, 0), (w, h), (0, h)]
    inner = [(deep, deep), (w - deep, deep), (w - deep, h - deep), (deep, h - deep)]
    wings = [[outer[k], outer[k - 3], inner[k - 3], inner[k]] for k in range(4)]
    if rng.random() < 0.5:
        wings = [[(0, 0), (w, 0), (w, deep), (0, deep)], [(w - deep, deep), (w, deep), (w, h), (w - deep, h)],
                 [(0, h - deep), (w - deep, h - deep), (w - deep, h), (0, h)],
                 [(0, deep), (deep, deep), (deep, h - deep), (0, h - deep)]]
    x, y = deep + rng.uniform(1, 2.5), deep + rng.uniform(1, 2.5)
    far = w - deep - rng.uniform(1, 2.5), h - deep - rng.uniform(1, 2.5)
    house = [(x, y), (far[0], y), far, (x, far[1])]
    shifted = []
    for ring in wings:
        off = rng.uniform(0, gape), rng.uniform(0, gape)
        shifted.append([(px + off[0], py + off[1]) for px, py in ring])
    return [[(px + at[0], py + at[1]) for px, py in ring] for ring in shifted + [house]]


def make_wings(rng, at):
    """Houses along the x axis, and a road: one with a wing that another house stands behind, one with a wing between its halves,
    and one whose back meets the front at an acute angle."""
    x, y = at
    w, d, t = rng.uniform(9, 12), rng.uniform(9, 12), rng.uniform(3.1, 4.5)
    far = w + rng.uniform(8, 14)
    houses = [[(0, 0), (far, 0), (far, t), (w, t), (w, d), (0, d)], [(w, t), (far, t), (far, d), (w, d)]]
    x1 = far + 8
    x2 = x1 + w + rng.uniform(8, 14)
    houses.append([(x1, 0), (x2 + w, 0), (x2 + w, d), (x2, d), (x2, t), (x1 + w, t), (x1 + w, d - 1), (x1, d - 1)])
    x3 = x2 + w + 8
    houses.append([(x3, 0), (x3 + 1.7 * d, 0), (x3, d)])
    front, slope = rng.uniform(-0.5, 1), rng.uniform(-0.02, 0.02)
    road = [(-20, front - slope * 20), (x3 + 50, front + slope * (x3 + 50))]
    return [[(px + x, py + y) for px, py in ring] for ring in houses], [(px + x, py + y) for px, py in road]


def make_world(rng, at):
    """Returns houses and roads, turned."""
    gape, angle = rng.choice([0, 0.8 * GAPE]), rng.choice([0, rng.uniform(0.1, 3)])
    front = rng.choice([make_terrace, make_terrace, make_folded])(rng, gape)
    top = max(y for ring in front for _, y in ring) + rng.uniform(0.5, 2)
    behind = [[(x, y + top) for x, y in ring] for ring in make_terrace(rng, gape)]
    houses = front + behind + make_yard(rng, (0, 45), gape)
    slope, middle = rng.choice([-1, 1]) * rng.uniform(0.05, 0.12), rng.uniform(-2, 1)
    wings, lane = make_wings(rng, (-20, 120))
    roads = [[(-60, middle - slope * 80), (120, middle + slope * 100)], lane]
    return [[turned(ring, angle, at) for ring in lines] for lines in (houses + wings, roads)]


def corner_angles(ring):
    """The angles of the corners that turn outwards, in degrees, where both edges are longer than walls gape."""
    for k, q in enumerate(ring):
        p, r = ring[k - 1], ring[(k + 1) % len(ring)]
        u, v = (p[0] - q[0], p[1] - q[1]), (r[0] - q[0], r[1] - q[1])
        turn = math.degrees(math.atan2(v[0] * u[1] - v[1] * u[0], u[0] * v[0] + u[1] * v[1])) % 360
        if turn < 180 and min(math.hypot(*u), math.hypot(*v)) > GAPE:
            yield turn, q


def rings_of(shape):
    """The rings, the inside on their left."""
    for ring, left in [(shape.exterior, True)] + [(hole, False) for hole in shape.interiors]:
        points = list(ring.coords)[:-1]
        yield points if ring.is_ccw == left else points[::-1]


def longest_sliver(shape):
    """How long is what disappears when the shape is opened by a disc, except at its corners?"""
    opened = shape.buffer(-THIN / 2, join_style=2).buffer(THIN, join_style=2, mitre_limit=2)
    rest = shape.difference(opened)
    return max((part.length / 2 for part in getattr(rest, "geoms", [rest]) if not part.is_empty), default=0)


def longest_arm(shape, given):
    """The greatest length, as a multiple of the width, of what the discs in a shape leave uncovered between walls that are not
    those of the shape as given, but for an end. Both are measured from the chords of the arcs at which it begins."""
    opened = shape.buffer(1e-6 - LEAST / 2, resolution=32).buffer(LEAST / 2, resolution=32)
    rest, longest = shape.difference(opened.buffer(1e-4)), 0
    for part in getattr(rest, "geoms", [rest]):
        if part.area < 0.01:
            continue
        mouth = opened.boundary.intersection(part.buffer(2e-4))
        mouth = linemerge(mouth) if mouth.geom_type != "LineString" else mouth
        chords = [LineString([arc.coords[0], arc.coords[-1]]) for arc in getattr(mouth, "geoms", [mouth]) if arc.length > 1e-2]
        width = min(chord.length for chord in chords)
        made = part.boundary.difference(opened.boundary.buffer(1e-3)).difference(given.boundary.buffer(1e-3)).length
        length = max(min(chord.distance(Point(p)) for chord in chords) for p in part.exterior.coords)
        if length > LEAST / 4 and made > 1.1 * width:
            longest = max(longest, length / width)
    return longest


def demand_whole(row, shape):
    """Fails if a shape has a needle or a sliver."""
    sharp, where = min((turn for ring in rings_of(shape) for turn in corner_angles(ring)), default=(180, None))
    if sharp < LEAST_ANGLE:
        fail(f"{row}: a corner of {sharp:.3g} degrees at {where}: {shape.wkt}")
    if longest_sliver(shape) > LONG:
        fail(f"{row}: a sliver of {longest_sliver(shape):.3g}: {shape.wkt}")


def main():
    sunder, seed, worlds = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    rng = random.Random(seed)
    houses, roads = [], []
    for k in range(worlds):
        own, lanes = make_world(rng, (1000.0 * k, 5e6 + 700.0 * (k % 7)))
        houses += own
        roads += lanes
    for ring in houses:
        demand_whole("as made", Polygon(ring))
    write_layers(houses, roads)
    rules = ["--gap", str(GAP), "--max-shift", str(LIMIT), "--rows", "no", "--touch-tolerance", str(TOLERANCE), "--trim",
             "--trim-keep", "0.3", "--min-size", str(LEAST), "--inset", ",".join(map(str, INSETS)), "--rigid-where", "n % 9 = 4",
             "--crossed", "trim", "--barrier", "inset_roads.gpkg,width-field=w,gap=0.5"]
    run = [sunder, "separate", "inset_houses.gpkg", "inset_o.gpkg", "--overwrite", "--hide", "--hide-weight", "1", "-q"]
    subprocess.run(run + rules + ["--stats", "inset.json"], check=True)
    counted = [0] * (2 + len(INSETS))
    source = ogr.Open("inset_o.gpkg")
    for item in source.GetLayer("inset_houses"):
        row = item.items()
        if row["sunder_inv"]:
            continue
        shape = translate(wkb.loads(bytes(item.GetGeometryRef().ExportToWkb())), -row["sunder_dx"], -row["sunder_dy"])
        counted[row["sunder_lvl"]] += 1
        demand_whole(row, shape)
        if row["sunder_lvl"] and longest_arm(shape, Polygon(houses[row["n"]])) > LONGER:
            fail(f"{row}: an arm {longest_arm(shape, Polygon(houses[row['n']])):.3g} times as long as wide: {shape.wkt}")
    if min(counted[:4]) < worlds / 4:
        fail(f"too few houses became smaller: {counted}")
    demand_kept(sunder, "inset_houses", "inset_o", rules)
    stats = json.load(open("inset.json"))
    print(f"{worlds} worlds, houses by rung {counted}, {stats['hidden']['count']} hidden: no corner below "
          f"{LEAST_ANGLE} degrees, no sliver")


if __name__ == "__main__":
    main()
