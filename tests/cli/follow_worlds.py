"""Points that go along with houses: follow_worlds.py make LAYER.gpkg NAME POINTS.gpkg SEED N
                                       follow_worlds.py ask MOVED.gpkg NAME POINTS.gpkg FOLLOWED.gpkg
                                       follow_worlds.py corners LAYER.gpkg NAME CORNERS.gpkg
                                       follow_worlds.py ask_corners MOVED.gpkg NAME CORNERS.gpkg FOLLOWED.gpkg

`make` puts N points into and onto the houses of a layer: anywhere inside, on their corners, at the doubles about a
point of a wall, and beside houses. `ask` decides in rationals, for the houses before and after, which points lie where,
and demands of the layer that follow wrote: what was inside (on the boundary) of a house is inside (inside or on the
boundary) of it now, and within a few doubles of its exact place; all others did not move; points at one place that go
with one house are at one place. What the rounded move takes to a corner of a house was this corner. `corners` makes a
point of each corner, and `ask_corners` demands that each is the same corner of the moved house, to the bit."""

import math
import random
import sys
from fractions import Fraction

from osgeo import ogr, osr

STEPS = 20  # how many doubles, along each axis, a point may be off its exact place


def rings_of(geometry):
    """Lists the rings of all polygons as lists of points without the closing one."""
    if geometry.GetGeometryName() == "LINEARRING":
        return [geometry.GetPoints()[:-1]]
    return [ring for i in range(geometry.GetGeometryCount()) for ring in rings_of(geometry.GetGeometryRef(i))]


def houses_of(path, name):
    data = ogr.Open(path)
    houses = {}
    for feature in data.GetLayerByName(name):
        rings = [[(Fraction(p[0]), Fraction(p[1])) for p in ring] for ring in rings_of(feature.GetGeometryRef())]
        move = [Fraction(0), Fraction(0)]
        if feature.GetFieldIndex("sunder_dx") >= 0:
            move = [Fraction(feature.GetField(k) or 0) for k in ("sunder_dx", "sunder_dy")]
        houses[feature.GetFID()] = (rings, move)
    return houses


def side(rings, at):
    """1: inside by the even-odd rule, 0: on a ring, -1: outside; in rationals, by where the ray upwards is crossed."""
    inside = False
    for ring in rings:
        for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
            if min(ax, bx) <= at[0] <= max(ax, bx) and min(ay, by) <= at[1] <= max(ay, by):
                if (bx - ax) * (at[1] - ay) == (by - ay) * (at[0] - ax):
                    return 0
            if (ax > at[0]) != (bx > at[0]):
                inside ^= ay + (at[0] - ax) / (bx - ax) * (by - ay) > at[1]
    return 1 if inside else -1


def is_corner(house, at):
    rings, move = house
    to = tuple(Fraction(at[k] + float(move[k])) for k in (0, 1))
    return any(to == corner for ring in rings for corner in ring)


def corners_of(path, name):
    data = ogr.Open(path)
    layer = data.GetLayerByName(name)
    found = [p[:2] for feature in layer for ring in rings_of(feature.GetGeometryRef()) for p in ring]
    return found, layer.GetSpatialRef().ExportToWkt()


def make_corners(path, name, out):
    found, crs = corners_of(path, name)
    made = ogr.GetDriverByName("GPKG").CreateDataSource(out)
    points = made.CreateLayer("points", osr.SpatialReference(crs), ogr.wkbPoint)
    made.StartTransaction()
    for x, y in found:
        feature, point = ogr.Feature(points.GetLayerDefn()), ogr.Geometry(ogr.wkbPoint)
        point.AddPoint_2D(x, y)
        feature.SetGeometry(point)
        points.CreateFeature(feature)
    made.CommitTransaction()


def ask_corners(moved, name, _, after):
    wanted, _ = corners_of(moved, name)
    data = ogr.Open(after)
    got = [f.GetGeometryRef().GetPoint_2D() for f in data.GetLayer(0)]
    print(len(got), "corners,", sum(a != b for a, b in zip(wanted, got)) + abs(len(wanted) - len(got)), "wrong")


def make(path, name, out, seed, n):
    rng = random.Random(seed)
    data = ogr.Open(path)
    layer = data.GetLayerByName(name)
    rings = [rings_of(feature.GetGeometryRef()) for feature in layer]
    made = ogr.GetDriverByName("GPKG").CreateDataSource(out)
    points = made.CreateLayer("points", layer.GetSpatialRef() or osr.SpatialReference(), ogr.wkbPoint)
    made.StartTransaction()
    for _ in range(n):
        ring = rng.choice(rng.choice(rings))
        kind = rng.randrange(4)
        k = rng.randrange(len(ring))
        (ax, ay), (bx, by) = ring[k][:2], ring[(k + 1) % len(ring)][:2]
        x, y = ax, ay
        if kind == 0:
            x = rng.uniform(min(p[0] for p in ring), max(p[0] for p in ring))
            y = rng.uniform(min(p[1] for p in ring), max(p[1] for p in ring))
        elif kind > 1:
            along = rng.random()
            x, y = ax + along * (bx - ax), ay + along * (by - ay)
            for _ in range(rng.randrange(3)):
                x, y = math.nextafter(x, rng.choice([-1, 1]) * math.inf), math.nextafter(y, rng.choice([-1, 1]) * math.inf)
        for _ in range(rng.choice([1, 1, 1, 2])):
            feature = ogr.Feature(points.GetLayerDefn())
            point = ogr.Geometry(ogr.wkbPoint)
            point.AddPoint_2D(x, y)
            feature.SetGeometry(point)
            points.CreateFeature(feature)
    made.CommitTransaction()


def ask(moved, name, before, after):
    houses = houses_of(moved, name)
    boxes = {}
    homes = {}
    for fid, (rings, move) in houses.items():
        homes[fid] = [[(x - move[0], y - move[1]) for x, y in ring] for ring in rings]
        flat = [p for ring in homes[fid] for p in ring]
        box = [float(f(p[k] for p in flat)) for f in (min, max) for k in (0, 1)]
        for cx in range(math.floor(box[0] / 20), math.floor(box[2] / 20) + 1):
            for cy in range(math.floor(box[1] / 20), math.floor(box[3] / 20) + 1):
                boxes.setdefault((cx, cy), []).append(fid)
    old, new = ogr.Open(before), ogr.Open(after)
    was = {f.GetFID(): f.GetGeometryRef().GetPoint_2D() for f in old.GetLayer(0)}
    count, wrong, places = {1: 0, 0: 0, -1: 0}, 0, {}
    for feature in new.GetLayer(0):
        p, q = was.pop(feature.GetFID()), feature.GetGeometryRef().GetPoint_2D()
        at, to = [Fraction(c) for c in p], [Fraction(c) for c in q]
        near = boxes.get((math.floor(p[0] / 20), math.floor(p[1] / 20)), [])
        sides = {fid: 0 if is_corner(houses[fid], p) else side(homes[fid], at) for fid in near}
        best = max(sides.values(), default=-1)
        owner, status = feature.GetField("sunder_to"), feature.GetField("sunder_st")
        count[best] += 1
        if best < 0:
            good = owner is None and status == "free" and p == q
        else:
            rings, move = houses[owner]
            off = [abs(to[k] - at[k] - move[k]) / Fraction(math.ulp(q[k])) for k in (0, 1)]
            holders = [fid for fid, s in sides.items() if s == best and houses[fid][1] == move]
            good = sides.get(owner) == best and any(side(houses[fid][0], to) >= best for fid in holders)
            good = good and max(off) <= STEPS and status == ("moved" if any(move) else "unmoved")
        if not good and wrong < 5:
            print("point", feature.GetFID(), p, q, "side", best, "goes with", owner, status)
        wrong += not good
        if places.setdefault((p, owner), q) != q:
            print("points at one place are at two:", p, owner)
            wrong += 1
    print(count[1], "inside,", count[0], "on the boundary,", count[-1], "outside,", wrong, "wrong,", len(was), "lost")
    sys.exit(1 if wrong or was or not min(count.values()) else 0)


if sys.argv[1] == "make":
    make(sys.argv[2], sys.argv[3], sys.argv[4], int(sys.argv[5]), int(sys.argv[6]))
else:
    {"ask": ask, "corners": make_corners, "ask_corners": ask_corners}[sys.argv[1]](*sys.argv[2:])
