"""Towns of slanted houses between slanted roads that have too little room, and what easing leaves of them to pay.

crowded_towns.py PROGRAM SEED...: prints the sum of the costs of these towns, each separated by itself.
"""

import json
import math
import random
import subprocess
import sys

EAST, NORTH = 2758000, 1219000  # coordinates of a national grid, so that moves are rounded as on a map


def town(seed):
    """Returns the rings of the houses and the lines of the roads of a town."""
    draw = random.Random(seed)

    def between(low, high):
        return low + (high - low) * draw.random()

    def point(x, y):
        return [round(x * 1024) / 1024 + EAST, round(y * 1024) / 1024 + NORTH]

    wanted, size = draw.randint(10, 24), between(55, 85)
    centres, houses, roads = [], [], []
    for _ in range(400):
        if len(houses) == wanted:
            break
        x, y = between(0, size), between(0, size)
        if any(math.hypot(x - a, y - b) < 12.5 for a, b in centres):
            continue
        width, depth, angle = between(8, 11), between(7, 10), between(0, math.pi)
        u = (width / 2 * math.cos(angle), width / 2 * math.sin(angle))
        v = (-depth / 2 * math.sin(angle), depth / 2 * math.cos(angle))
        corners = ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))
        centres.append((x, y))
        houses.append([point(x + s * u[0] + t * v[0], y + s * u[1] + t * v[1]) for s, t in corners])
    for _ in range(draw.randint(2, 4)):
        angle, x, y = between(0, math.pi), between(0, size), between(0, size)
        away = (100 * math.cos(angle), 100 * math.sin(angle))
        bend = point(x + between(-5, 5), y + between(-5, 5))
        roads.append([point(x - away[0], y - away[1]), bend, point(x + away[0], y + away[1])])
    return houses, roads


def write(name, kind, items):
    features = [
        {
            "type": "Feature",
            "id": k + 1,
            "properties": {},
            "geometry": {"type": kind, "coordinates": [item] if kind == "Polygon" else item},
        }
        for k, item in enumerate(items)
    ]
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::2056"}}
    with open(name, "w", encoding="utf-8") as file:
        json.dump({"type": "FeatureCollection", "crs": crs, "features": features}, file)


def cost_of(program, seed):
    """Separates a town and returns its cost."""
    houses, roads = town(seed)
    write("houses.geojson", "Polygon", houses)
    write("roads.geojson", "LineString", roads)
    words = "separate --overwrite -q --gap 5 --max-shift 12.5 --no-blocks --rows no --ease 30 --effort 0"
    words += " --allow-conflicts"
    files = ["--barrier", "roads.geojson,width=12.5", "houses.geojson", "town.gpkg", "--stats", "town.json"]
    subprocess.run([program, *words.split(), *files], check=True)
    with open("town.json", encoding="utf-8") as file:
        stats = json.load(file)
    if not stats["verified"]:
        sys.exit(f"town {seed} is not verified")
    return stats["displacement"]["cost"]


if __name__ == "__main__":
    print(sum(cost_of(sys.argv[1], int(seed)) for seed in sys.argv[2:]))
