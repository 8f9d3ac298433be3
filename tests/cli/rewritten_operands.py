"""Operands whose rings, members and lines are written in other ways: every answer is the same.

    rewritten_operands.py PROGRAM SCENES SEED

A scene has polygonal sets (courts with several holes, members that overlap, touch or lie in each other's holes, rings
that cross or touch themselves, spurs), lines and points. `sum`, `pair`, `route` and `buffer` are run with the
original set, and with the set as rewritten_rings.py rewrites it. The printed results are compared without times and
memory, layers byte by byte. Only the number of warnings is compared, since they name a vertex by its index in the
ring.
"""
import json
import random
import subprocess
import sys

from rewritten_rings import WAYS, box

PROGRAM, SCENES, SEED = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
ROADS = [("--algorithm", algorithm, "--decomposition", decomposition, "--order", order)
         for algorithm in ("arrangement", "incremental", "divide")
         for decomposition in ("angle-bisector", "vertical", "triangulation", "hertel-mehlhorn", "optimal", "mixed")
         for order in ("random", "fat", "given")]
wrong = asked = 0


def quarter(r, n):
    return r.randrange(n) / 4


def court(r, x, y, w, h):
    return [box(x, y, 20, 20), *[box(x + 1 + 6 * i, y + 2 + quarter(r, 32), 1 + quarter(r, 21), 1 + quarter(r, 24))
                                 for i in range(3)]]


def crossed(r, x, y, w, h):
    return [[[x, y], [x + w, y + h], [x + w, y], [x, y + h / 2], [x, y]]]


def pinched(r, x, y, w, h):
    return [[[x, y], [x + w, y + h], [x + 2 * w, y], [x + 2 * w, y + 2 * h], [x + w, y + h], [x, y + 2 * h], [x, y]]]


def two_arms(r, x, y, w, h):
    return [[[x, y], [x + 3 * w, y], [x + 3 * w, y + 9], [x + 2 * w, y + 9], [x + 2 * w, y + 2], [x + w, y + 2],
             [x + w, y + 9], [x, y + 9], [x, y]]]


def hole_over_the_wall(r, x, y, w, h):
    return [box(x, y, w + 4, h + 4), box(x - 1, y + 1, w, h)]


def spur(r, x, y, w, h):
    return [[[x, y], [x + w, y], [x + w, y + h], [x + w + 3, y + h + 1], [x + w, y + h], [x, y + h], [x, y]]]


def scribble(r, x, y, w, h):
    ring = [[x + quarter(r, 40), y + quarter(r, 40)] for _ in range(r.randrange(3, 9))]
    return [ring + ring[:1]]


KINDS = [lambda r, *at: [box(*at)], court, crossed, pinched, two_arms, hole_over_the_wall, spur, scribble, scribble]


def polygon(r, reach=80):
    """Rings, each with one closing vertex, the outer one first."""
    return r.choice(KINDS)(r, quarter(r, reach), quarter(r, reach), 2 + quarter(r, 24), 2 + quarter(r, 24))


def figure(r, most):
    return [polygon(r) for _ in range(r.randrange(1, most + 1))]


def points_text(points):
    return "(" + ", ".join(f"{x!r} {y!r}" for x, y in points) + ")"


def text(polygons):
    return "MULTIPOLYGON (" + ", ".join("(" + ", ".join(map(points_text, rings)) + ")" for rings in polygons) + ")"


def anew(way, polygons, seed):
    return WAYS[way](random.Random(seed), polygons)


def obstacles_anew(way, polygons, lines, points, seed):
    """A collection; with rewritten rings its lines are reversed, and lines and points are shuffled with the
    members."""
    if way in ("reversed", "all"):
        lines = [line[::-1] for line in lines]
    if way in ("shuffled", "all"):
        lines, points = lines[::-1], points[::-1]
    parts = [text(anew(way, polygons, seed)), *["LINESTRING " + points_text(line) for line in lines],
             "MULTIPOINT " + points_text(points)]
    return "GEOMETRYCOLLECTION (" + ", ".join(parts) + ")"


def answer(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        sys.exit(f"{arguments}: status {done.returncode}: {done.stderr}")
    found = json.loads(done.stdout)
    for key in ("seconds", "peak_rss_bytes"):
        found.pop(key, None)
    return {"status": done.returncode, "warnings": done.stderr.count("\n"), **found}


def compare(what, of_way):
    global wrong, asked
    given = of_way("given")
    for way in WAYS:
        if way == "given":
            continue
        asked += 1
        other = of_way(way)
        # Vertices in the middle of edges make the lattice of a repaired set finer: operation counts may differ.
        differ = [key for key in given if given[key] != other.get(key)
                  and not (key == "operations" and way in ("with_middles", "all"))]
        if differ:
            wrong += 1
            for key in differ[:3]:
                print(f"seed {SEED}, {what}, {way}: {key}: {str(other.get(key))[:300]}, as drawn {str(given[key])[:300]}")


def buffer(way, features, seed, *options):
    with open("in.geojson", "w", encoding="utf-8") as file:
        json.dump({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:25832"}}, "features": [
            {"type": "Feature", "properties": {"n": k}, "geometry": {
                "type": "MultiPolygon", "coordinates": anew(way, f, seed + k)}} for k, f in enumerate(features)]}, file)
    said = answer("buffer", "in.geojson", "out.geojson", "--overwrite", "--stats", "-", *options)
    with open("out.geojson", encoding="utf-8") as file:
        return {**said, "layer": file.read()}


def scene(k):
    seed = SEED * 1000 + k
    r = random.Random(seed)
    p, q, robot = figure(r, 4), figure(r, 2), [polygon(r, 1)]
    for options in ((), r.choice(ROADS)):
        compare(f"scene {k}: sum {' '.join(options)}", lambda way, options=options: answer(
            "sum", text(anew(way, p, seed)), text(anew(way, q, seed)), "--exact", *options))
    for gap in ("0", "1.5"):
        compare(f"scene {k}: pair, gap {gap}", lambda way, gap=gap: answer(
            "pair", text(anew(way, p, seed)), text(anew(way, q, seed)), "--gap", gap))
    lines = [[[quarter(r, 100), quarter(r, 100)] for _ in range(r.randrange(2, 5))] for _ in range(2)]
    points = [[quarter(r, 100), quarter(r, 100)] for _ in range(3)]
    compare(f"scene {k}: route", lambda way: answer(
        "route", obstacles_anew(way, p, lines, points, seed), "--robot", text(anew(way, robot, seed)), "--from=-40,-40",
        "--to", "70,70", "--exact"))
    features = [figure(r, 2) for _ in range(4)]
    for options in (("--operation", r.choice(("dilate", "erode", "open", "close"))), ("--align",), ("--dissolve",)):
        shape = r.choice(("disc:1.25:12", "square:1.5", "rectangle:3x1"))
        compare(f"scene {k}: buffer {' '.join(options)} {shape}", lambda way, options=options, shape=shape: buffer(
            way, features, seed, *options, "--shape", shape))


for number in range(SCENES):
    scene(number)
print(asked, file=sys.stderr)
sys.exit(1 if wrong else 0)
