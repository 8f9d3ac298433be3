"""Points and houses in parcels: each has to stay in its own parcel.

    python3 kept_sides.py write SEED              writes points.geojson, houses.geojson and parcels.geojson
    python3 kept_sides.py look IN.geojson OUT.gpkg LAYER   prints how many moved, and how many left their parcels
"""
import json
import random
import sqlite3
import sys

SIDE, ROWS = 100, 6


def collection(name, geometries):
    data = {"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
            "features": [{"type": "Feature", "properties": {"n": k}, "geometry": g} for k, g in enumerate(geometries)]}
    with open(name, "w", encoding="utf-8") as out:
        json.dump(data, out)


def box(x, y, w, h):
    return {"type": "Polygon", "coordinates": [[[x, y], [x + w, y], [x + w, y + h], [x, y + h], [x, y]]]}


def write(seed):
    r = random.Random(seed)
    parcels = [(SIDE * i, SIDE * k) for i in range(ROWS) for k in range(ROWS)]
    collection("parcels.geojson", [box(*p, SIDE, SIDE) for p in parcels])
    points, houses = [], []
    for x, y in parcels:
        for _ in range(r.randrange(1, 4)):
            at = [r.choice([r.randrange(1, 5), SIDE - r.randrange(1, 5), r.randrange(1, SIDE)]) for _ in range(2)]
            points.append({"type": "Point", "coordinates": [x + at[0], y + at[1]]})
        for _ in range(r.randrange(1, 4)):
            w, h = r.randrange(6, 16), r.randrange(6, 16)
            at = [r.choice([0.5, SIDE - s - 0.5, r.randrange(1, SIDE - s)]) for s in (w, h)]
            houses.append(box(x + at[0], y + at[1], w, h))
    collection("points.geojson", points)
    collection("houses.geojson", houses)


def place(geometry):
    if geometry["type"] == "Point":
        return geometry["coordinates"]
    corners = geometry["coordinates"][0][:4]
    return [sum(p[k] for p in corners) / 4 for k in range(2)]


def look(given, result, layer):
    was = [place(f["geometry"]) for f in json.load(open(given, encoding="utf-8"))["features"]]
    rows = sqlite3.connect(result).execute(f'SELECT n, sunder_dx, sunder_dy FROM "{layer}"').fetchall()
    moved = left = 0
    for n, dx, dy in rows:
        x, y = was[n]
        moved += dx != 0 or dy != 0
        left += not all(v // SIDE * SIDE < v + d < (v // SIDE + 1) * SIDE for v, d in ((x, dx), (y, dy)))
    print(f"{len(rows)} features, {moved} moved, {left} left")


if __name__ == "__main__":
    if sys.argv[1] == "write":
        write(int(sys.argv[2]))
    else:
        look(*sys.argv[2:])
