"""Houses that a road cuts in half, each with another road on one side of it, near or far.

    sides_and_limits.py write SEED                 writes houses.geojson, roads.geojson
    sides_and_limits.py mirror RESULT OUT          the houses of RESULT, each moved in the opposite direction
    sides_and_limits.py sides RESULT               prints FID and side (-1, 0, 1) of each house that moves

The distance of the other road is 0.1 to 2.2 times the width plus height of the house, so for most houses that road
decides the side. Every other house is so narrow that a move of 1 takes it off the road.
"""
import json
import random
import sys


def collection(features):
    return {"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:25832"}}, "features": [
        {"type": "Feature", "id": k + 1, "properties": p, "geometry": g} for k, (p, g) in enumerate(features)]}


def point(upright, along, across):
    return [across, along] if upright else [along, across]


def write(seed):
    r = random.Random(seed)
    houses, roads = [], []
    for k in range(30):
        at, upright = 1000.0 * k, k % 2 == 1
        wide, deep = r.randrange(24, 200) / 8, r.randrange(8, 17) / 8 if k % 4 < 2 else r.randrange(24, 160) / 8
        far = round(8 * (wide + deep) * r.uniform(0.1, 2.2)) / 8 + deep / 2
        corners = [(at, -deep / 2), (at + wide, -deep / 2), (at + wide, deep / 2), (at, deep / 2), (at, -deep / 2)]
        houses.append(({"upright": upright}, {"type": "Polygon", "coordinates": [[point(upright, *c) for c in corners]]}))
        for across in (0.0, far * r.choice((-1, 1))):
            roads.append(({}, {"type": "LineString", "coordinates": [point(upright, at - 300, across),
                                                                     point(upright, at + 300, across)]}))
    for name, features in (("houses", houses), ("roads", roads)):
        with open(name + ".geojson", "w", encoding="utf-8") as out:
            json.dump(collection(features), out)


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)["features"]


def mirror(result, out):
    features = []
    for f in read(result):
        p = f["properties"]
        rings = [[[x - 2 * p["sunder_dx"], y - 2 * p["sunder_dy"]] for x, y in ring] for ring in f["geometry"]["coordinates"]]
        features.append(({"upright": p["upright"]}, {"type": "Polygon", "coordinates": rings}))
    with open(out, "w", encoding="utf-8") as file:
        json.dump(collection(features), file)


def sides(result):
    for k, f in enumerate(read(result)):
        p = f["properties"]
        step = p["sunder_dx"] if p["upright"] else p["sunder_dy"]
        if p["sunder_dx"] or p["sunder_dy"]:
            print(k + 1, (step > 0) - (step < 0))


if sys.argv[1] == "write":
    write(int(sys.argv[2]))
elif sys.argv[1] == "mirror":
    mirror(*sys.argv[2:4])
else:
    sides(sys.argv[2])
