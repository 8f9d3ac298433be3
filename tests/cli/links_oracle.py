"""Links between old and new places, places about them, and the moves that they should have, by the definition, in
rationals: a triangle of starts counts if no other start is within its circle.

    links_oracle.py make WORLD          writes links.geojson, places.geojson and prints the radius (no: none)
    links_oracle.py compare WORLD OUT.gpkg RADIUS   prints what differs from OUT, the places moved by the program
"""
import itertools
import json
import random
import sqlite3
import sys
from fractions import Fraction

CRS = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}


def world(number):
    """Links as (start, move), and places; the first worlds are degenerate."""
    rng = random.Random(number)
    size = (4, 8, 100)[number % 3]
    n = number if number < 4 else rng.randint(4, 9)
    starts = set()
    while len(starts) < n:
        u, v = rng.randint(0, size + 6), rng.randint(0, size)
        starts.add((u, 2 * u + 1) if number % 5 == 2 else (u, v))
    links = [(s, (rng.randint(-9, 9) / 4, rng.randint(-9, 9) / 4)) for s in sorted(starts)]
    rng.shuffle(links)
    links += links[:2]  # the same ones twice
    places = {links[0][0]} if links else set()
    while len(places) < 60:
        places.add((rng.randint(-8 * size, 16 * size) / 8, rng.randint(-8 * size, 16 * size) / 8))
    return links, sorted(places), None if number % 2 else size * rng.choice((0.5, 1, 2))


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def in_circle(a, b, c, d):
    m = [(p[0] - d[0], p[1] - d[1]) for p in (a, b, c)]
    (ax, ay), (bx, by), (cx, cy) = m
    at, bt, ct = (p[0] ** 2 + p[1] ** 2 for p in m)
    return at * (bx * cy - by * cx) - bt * (ax * cy - ay * cx) + ct * (ax * by - ay * bx) > 0


def mix(parts):
    return tuple(sum(share * move[c] for share, move in parts) for c in (0, 1))


def squared(a, b):
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2


def inside(links, x):
    """The moves at x by all triangles that count and contain it: several of four points on a circle."""
    for p, q, r in itertools.combinations(links, 3):
        if cross(p[0], q[0], r[0]) < 0:
            q, r = r, q
        whole = cross(p[0], q[0], r[0])
        shares = [cross(x, q[0], r[0]), cross(x, r[0], p[0]), cross(x, p[0], q[0])]
        if whole > 0 and min(shares) >= 0 and not any(in_circle(p[0], q[0], r[0], o[0]) for o in links):
            yield mix([(s / whole, link[1]) for s, link in zip(shares, (p, q, r))])


def beyond(links, x):
    """The move of the nearest point of the boundary: of all segments between starts without another one on them."""
    best = None
    for p, q in itertools.combinations_with_replacement(links, 2):
        u = (q[0][0] - p[0][0], q[0][1] - p[0][1])
        length = u[0] ** 2 + u[1] ** 2
        s = min(1, max(0, (u[0] * (x[0] - p[0][0]) + u[1] * (x[1] - p[0][1])) / length)) if length else Fraction(0)
        at = (p[0][0] + s * u[0], p[0][1] + s * u[1])
        if any(o is not p and o is not q and cross(p[0], q[0], o[0]) == 0 and squared(p[0], o[0]) < length and
               squared(q[0], o[0]) < length for o in links):
            continue
        if best is None or squared(at, x) < best[0]:
            best = squared(at, x), mix([(1 - s, p[1]), (s, q[1])])
    return best[1]


def moves(links, x, radius):
    if not links:
        return [(0, 0)]
    found = list(inside(links, x)) or [beyond(links, x)]
    off = float(min(squared(s, x) for s, _ in links)) ** 0.5
    factor = 1 if radius is None else max(0, min(1, 2 - 2 * off / radius))
    return [(factor * float(m[0]), factor * float(m[1])) for m in found]


def write(path, geometries):
    features = [{"type": "Feature", "properties": {}, "geometry": g} for g in geometries]
    with open(path, "w") as out:
        json.dump({"type": "FeatureCollection", "crs": CRS, "features": features}, out)


def make(number):
    links, places, radius = world(number)
    lines = [[s, (s[0] + m[0] / 2, s[1] + 99), (s[0] + m[0], s[1] + m[1])] for s, m in links]
    half = len(lines) // 2
    geometries = [{"type": "LineString", "coordinates": line} for line in lines[:half]]
    geometries += [{"type": "MultiLineString", "coordinates": lines[half:]}] if lines[half:] else []
    write("links.geojson", [None] + geometries)
    write("places.geojson", [{"type": "Point", "coordinates": p} for p in places])
    print("no" if radius is None else radius)


def compare(number, path, radius):
    links, places, _ = world(number)
    exact = {tuple(map(Fraction, s)): tuple(map(Fraction, m)) for s, m in links}
    with sqlite3.connect(path) as db:
        found = db.execute("SELECT sunder_dx, sunder_dy FROM places ORDER BY fid").fetchall()
    if len(found) != len(places):
        print("places", len(found))
    for x, move in zip(places, found):
        wanted = moves(list(exact.items()), tuple(map(Fraction, x)), None if radius == "no" else float(radius))
        # Shares and their sum are rounded in doubles; moves are below 4.
        if not any(abs(w[0] - move[0]) + abs(w[1] - move[1]) < 1e-13 for w in wanted):
            print("place", x, "has the move", move, "not", wanted)


if sys.argv[1] == "make":
    make(int(sys.argv[2]))
else:
    compare(int(sys.argv[2]), *sys.argv[3:])
