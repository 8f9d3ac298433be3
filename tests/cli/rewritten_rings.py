"""Layers whose rings are written in other ways, and results without what may depend on the way of writing.

    python3 rewritten_rings.py write TOWN.geojson SEED    writes given.geojson, reversed.geojson, ...
    python3 rewritten_rings.py show RESULT.gpkg           prints all rows but the geometries of the features
"""
import json
import random
import sqlite3
import sys
from fractions import Fraction


def on_grid(p):
    return [round(c * 1024) / 1024 for c in p[:2]]


def moved(ring, x, y):
    return [[p[0] + x, p[1] + y] for p in ring]


def box(x, y, w, h):
    return [[x, y], [x + w, y], [x + w, y + h], [x, y + h], [x, y]]


def extra_features(r, at):
    """Houses with several courtyards, separate members, rings that touch themselves, notches, arms of equal
    length."""
    found = []
    for k in range(24):
        x, y = at[0] + 26 * (k % 6) + r.randrange(8) / 4, at[1] + 26 * (k // 6) + r.randrange(8) / 4
        court = [box(x, y, 20, 20), box(x + 2, y + 2, 3, 3), box(x + 8, y + 2, 4, 9), box(x + 14, y + 11, 3, 3)]
        forked = [[x, y], [x + 21, y], [x + 21, y + 18], [x + 14, y + 18], [x + 14, y + 6], [x + 7, y + 6], [x + 7, y + 18],
                  [x, y + 18], [x, y]]
        pinched = [[x, y], [x + 10, y + 8], [x + 20, y], [x + 22, y + 16], [x + 10, y + 8], [x - 2, y + 16], [x, y]]
        crossed = [[x, y], [x + 21, y + 20], [x + 21, y], [x, y + 17], [x, y]]
        notched = [[x, y], [x + 22, y], [x + 20, y + 10], [x + 22, y + 20], [x + 11, y + 10], [x, y + 20], [x, y]]
        found.append([[court], [[forked]], [[pinched]], [[crossed]], [[notched]],
                      [[box(x, y, 8, 8)], [box(x + 9, y + 9, 11, 8), box(x + 12, y + 12, 2, 2)], [box(x + 14, y, 6, 5)]]][k % 6])
    return found


def turned(polygons, ring_of):
    return [[ring_of(ring) for ring in polygon] for polygon in polygons]


def rotated(r, ring):
    k = r.randrange(len(ring) - 1)
    return ring[k:-1] + ring[:k] + [ring[k]]


def with_middles(ring):
    out = [ring[0]]
    for p, q in zip(ring, ring[1:]):
        middle = [(a + b) / 2 for a, b in zip(p, q)]
        if all(2 * Fraction(m) == Fraction(a) + Fraction(b) for m, a, b in zip(middle, p, q)):
            out.append(middle)
        out.append(q)
    return out


def shuffled(r, polygons):
    out = [[polygon[0], *r.sample(polygon[1:], len(polygon) - 1)] for polygon in polygons]
    return r.sample(out, len(out))


WAYS = {
    "given": lambda r, s: s,
    "reversed": lambda r, s: turned(s, lambda ring: ring[::-1]),
    "rotated": lambda r, s: turned(s, lambda ring: rotated(r, ring)),
    "shuffled": shuffled,
    "closed_twice": lambda r, s: turned(s, lambda ring: ring + [ring[-1]]),
    "with_middles": lambda r, s: turned(s, with_middles),
    "all": lambda r, s: turned(shuffled(r, s), lambda ring: with_middles(rotated(r, ring)[::-1])),
}


def write(town, seed):
    r = random.Random(seed)
    data = json.load(open(town, encoding="utf-8"))
    shapes = []
    for f in data["features"]:
        g = f["geometry"]
        polygons = g["coordinates"] if g["type"] == "MultiPolygon" else [g["coordinates"]]
        shapes.append([[[on_grid(p) for p in ring] for ring in polygon] for polygon in polygons])
    corners = [p for s in shapes for polygon in s for ring in polygon for p in ring]
    shapes += extra_features(r, (float(int(max(p[0] for p in corners)) - 60), float(int(min(p[1] for p in corners)))))
    for way, rewrite in WAYS.items():
        features = [{"type": "Feature", "properties": {"n": k}, "geometry": {"type": "MultiPolygon",
                     "coordinates": rewrite(random.Random(seed + k), s)}} for k, s in enumerate(shapes)]
        with open(way + ".geojson", "w", encoding="utf-8") as out:
            json.dump({"type": "FeatureCollection", "crs": data["crs"], "features": features}, out)


def show(result):
    db = sqlite3.connect(result)
    main = "result"
    for (name,) in sorted(db.execute("SELECT table_name FROM gpkg_contents").fetchall()):
        for row in db.execute(f'SELECT * FROM "{name}" ORDER BY 1').fetchall():
            print(name, *(v for v in row if name != main or not isinstance(v, bytes)))


if __name__ == "__main__":
    if sys.argv[1] == "write":
        write(sys.argv[2], int(sys.argv[3]))
    else:
        show(sys.argv[2])
